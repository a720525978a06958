//! `[effect.parameters.…]`: a parameter of an effect, with its unit, the range and the starts of its fit.

use crate::effects::Parameter;
use crate::error::{Error, Result};
use crate::files::toml::spanned_table::{Section, Value};
use crate::formula::Unit;
use std::f64::consts::PI;

/// The most starts of the fit of one parameter: each costs a pass over the data.
const MAX_STARTS: usize = 8;

/// Reads a parameter.
pub(crate) fn read_parameter(value: &Value, heading: &str) -> Result<Parameter> {
    let section = value.section(heading.into())?;
    section.only(&["unit", "range", "size", "start", "positive", "periodic"])?;
    let flag = |key: &str| section.get(key).map_or(Ok(false), |v| v.truth());
    let (positive, periodic) = (flag("positive")?, flag("periodic")?);
    let parameter = Parameter {
        unit: read_unit(&section)?,
        range: range(&section, positive)?,
        size: section.need("size", "size = 0.03, a plausible magnitude")?.positive()?,
        start: starts(&section)?,
        positive,
        periodic,
    };
    check_size(&section, &parameter)?;
    check_starts(&section, &parameter)?;
    if periodic {
        check_period(&section, &parameter)?;
    }
    Ok(parameter)
}

/// Reads a unit.
pub(crate) fn read_unit(section: &Section) -> Result<String> {
    let value = section.need("unit", "unit = \"m/s\", or \"1\" for a number")?;
    let text = value.text()?;
    match Unit::parse(text) {
        Some(_) => Ok(text.to_string()),
        None => Err(value
            .error(format!("\"{}\" is no unit", crate::files::toml::suggestions::shown(text)))
            .help("write m, s, kg, rad or 1 with * / ^, such as \"s^2/m\"")),
    }
}

fn numbers(value: &Value, example: &str) -> Result<Vec<f64>> {
    value.list(example)?.iter().map(Value::number).collect()
}

fn range(section: &Section, positive: bool) -> Result<[f64; 2]> {
    let example = "range = [-1.0, 1.0], what may stand in a model file";
    let value = section.need("range", example)?;
    let found = numbers(&value, example)?;
    let range: [f64; 2] =
        found.try_into().map_err(|_| value.error("range needs 2 numbers").help(format!("write {example}")))?;
    let [low, high] = range;
    let refuse = |why: String, advice: &str| Err(value.error(why).help(advice.to_string()));
    if low >= high {
        return refuse(format!("range from {low:?} to {high:?} is empty"), "write the smaller number first");
    }
    match positive {
        true if low < 0.0 => {
            refuse(format!("range of a positive parameter begins at {low:?}"), "begin it at 0 or above")
        }
        false if low > 0.0 || high < 0.0 => refuse(
            format!("range from {low:?} to {high:?} lacks 0, where the effect vanishes"),
            "widen it, or write positive = true if 0 has no meaning",
        ),
        _ => Ok(range),
    }
}

fn starts(section: &Section) -> Result<Vec<f64>> {
    let Some(value) = section.get("start") else { return Ok(vec![0.0]) };
    let found = numbers(&value, "start = [0.1]")?;
    match found.len() {
        1..=MAX_STARTS => Ok(found),
        n => Err(value.error(format!("start has {n} numbers")).help(format!("give 1 to {MAX_STARTS}"))),
    }
}

/// An error at a key, or at the whole section where the key is left out.
fn at(section: &Section, key: &str, message: String) -> Error {
    section.get(key).map_or_else(|| section.error(message.clone()), |v| v.error(message.clone()))
}

fn check_size(section: &Section, p: &Parameter) -> Result<()> {
    if p.admits(p.size) || p.admits(-p.size) {
        return Ok(());
    }
    let [low, high] = p.range;
    Err(at(section, "size", format!("size = {:?} lies outside of the range {low:?} to {high:?}", p.size))
        .help("give a plausible magnitude within the range"))
}

fn check_starts(section: &Section, p: &Parameter) -> Result<()> {
    let [low, high] = p.range;
    for start in &p.start {
        if p.positive && *start <= 0.0 {
            return Err(at(section, "start", format!("a fit of a positive parameter cannot start at {start:?}"))
                .help("write start = [0.1], a number above 0"));
        }
        if !p.admits(*start) {
            return Err(at(section, "start", format!("start {start:?} lies outside of the range {low:?} to {high:?}"))
                .help("start within the range"));
        }
    }
    Ok(())
}

/// A fit wraps a periodic value into (−π, π], which must then be allowed in a model file.
fn check_period(section: &Section, p: &Parameter) -> Result<()> {
    if p.positive {
        return Err(at(section, "periodic", "a parameter cannot be both positive and periodic".into())
            .help("remove one of the two"));
    }
    if p.unit != "rad" {
        return Err(at(section, "unit", format!("a periodic parameter is an angle, not of unit {}", p.unit))
            .help("write unit = \"rad\", or remove periodic"));
    }
    if p.range[0] > -PI || p.range[1] < PI {
        return Err(at(section, "range", "the range of a periodic parameter must hold a whole turn".into())
            .help("write range = [-3.2, 3.2]"));
    }
    Ok(())
}
