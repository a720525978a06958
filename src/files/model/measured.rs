//! `[measured]`: what a log measures of the motion beside the pose, such as rates of wheels and of the body.

use super::known::KnownInput;
use super::parameters::Machine;
use crate::error::{Error, Result};
use crate::files::log::cells::MEASURED;
use crate::files::log::column_entry::{self, ColumnEntry};
use crate::files::log::unit::Dimension;
use crate::files::toml::formula_text::FormulaText;
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions::{advice, shown};
use crate::formula::Expr;

/// A quantity that a column of a log measures in every row.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredEntry {
    /// Its name in the model file.
    pub name: String,
    /// Its column, and how it is read from there.
    pub column: ColumnEntry,
    /// The formula of the motion that it measures; none where the name is that of an input, which the vehicle defines.
    pub formula: Option<Expr>,
    /// Its SI unit; empty where the file names none.
    pub unit: String,
    /// Its standard deviation in SI units, where the file knows it.
    pub noise: Option<f64>,
    /// Line and column of its entry.
    pub place: (usize, usize),
}

/// Quantities that need no formula: name, formula, unit.
///
/// | name | formula | unit | meaning |
/// |---|---|---|---|
/// | `yaw_rate` | φ' | rad/s | a gyro |
/// | `speed`, `lateral_speed` | v_l, v_t | m/s | of the reference point, forward and to the left |
/// | `acceleration`, `lateral_acceleration` | v_l' − v_t·φ', v_t' + v_l·φ' | m/s² | of the reference point, in the axes of the body |
const KNOWN: [(&str, &str, &str); 5] = [
    ("yaw_rate", "phi'", "rad/s"),
    ("speed", "v_l", "m/s"),
    ("lateral_speed", "v_t", "m/s"),
    ("acceleration", "v_l' - v_t*phi'", "m/s^2"),
    ("lateral_acceleration", "v_t' + v_l*phi'", "m/s^2"),
];
/// The most quantities beside the pose.
const MAX_MEASURED: usize = 12;

impl MeasuredEntry {
    /// The entries of a model file whose inputs are these.
    pub(crate) fn read(top: &Section, machine: &Machine, driven: &[&str]) -> Result<Vec<Self>> {
        let Some(section) = top.section("measured")? else { return Ok(vec![]) };
        let inputs: Vec<&KnownInput> = machine.parts().flat_map(|v| &v.inputs).collect();
        let entries = section.entries();
        if let Some(beyond) = entries.get(MAX_MEASURED) {
            let message = format!("[measured] has {} entries, and {MAX_MEASURED} are the most", entries.len());
            return Err(beyond.key_error(message).help("leave out what says least"));
        }
        entries.iter().map(|value| Self::one(value, &inputs, driven)).collect()
    }

    fn one(value: &Value, inputs: &[&KnownInput], driven: &[&str]) -> Result<Self> {
        let name = value.name.as_str();
        if driven.contains(&name) {
            return Err(value
                .key_error(format!("{name} is an input of this model, and not measured beside the pose"))
                .help("give a second sensor of it a name of its own and a formula"));
        }
        let example = format!("{name} = {{ column = \"…\", formula = \"…\" }}");
        let table = value.is_table().then(|| value.section_like(format!("[measured.{name}]"), &example)).transpose()?;
        let get = |key: &str| table.as_ref().and_then(|table| table.get(key));
        let own = get("formula").map(|v| FormulaText::read(&v)).transpose()?;
        let known = KNOWN.iter().find(|(known, _, _)| *known == name);
        let input = inputs.iter().find(|i| i.role == name);
        let (formula, unit) = match (own, known, input) {
            (Some(own), _, _) => (Some(own.formula), own_unit(&get)?),
            (None, _, Some(input)) => (None, input.unit.clone()),
            (None, Some((_, formula, unit)), None) => (Expr::parse(formula).ok(), (*unit).to_string()),
            (None, None, None) => return Err(unknown(value, inputs, driven)),
        };
        let column = column_entry::read_with(value, Dimension::of_si(&unit), &["formula", "noise"])?;
        let noise = get("noise").map(|v| v.positive()).transpose()?;
        Ok(Self { name: name.into(), column, formula, unit, noise, place: value.source.line_and_column(value.key_at) })
    }

    /// The key of its column among the entries of `[columns]`, and what it is called in errors.
    pub(crate) fn role(&self) -> String {
        format!("{MEASURED}{}", self.name)
    }
}

/// The SI unit of what the unit of an entry's column measures; counts and positions are read as rates.
fn own_unit<'a: 'd, 'd>(get: &impl Fn(&str) -> Option<Value<'a, 'd>>) -> Result<String> {
    if get("ticks").is_some() || get("angle").is_some() {
        return Ok("rad/s".into());
    }
    let Some(unit) = get("unit") else { return Ok(String::new()) };
    let text = unit.text()?;
    let dimension = Dimension::of(text).ok_or_else(|| {
        let message = format!("unknown unit \"{}\"", shown(text));
        unit.error(message).help("leave the unit out and give scale = … in its place")
    })?;
    Ok(dimension.units()[0].to_string())
}

fn unknown(value: &Value, inputs: &[&KnownInput], driven: &[&str]) -> Error {
    let roles = inputs.iter().map(|i| i.role.as_str()).filter(|role| !driven.contains(role));
    let all: Vec<&str> = KNOWN.iter().map(|(name, _, _)| *name).chain(roles).collect();
    let message = format!("nothing says which motion {} is", value.name);
    value.key_error(message).help(format!(
        "give its formula, such as {} = {{ column = \"…\", formula = \"phi'\" }}; {}",
        value.name,
        advice(&value.name, "without one it may be", &all)
    ))
}
