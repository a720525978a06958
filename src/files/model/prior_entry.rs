//! `prior` and `bounds` of an effect: what is known of its parameters before any run.

use super::known::KnownEffect;
use crate::error::Result;
use crate::files::toml::spanned_table::{Section, Value};
use std::collections::BTreeMap;

/// What is known of a parameter before any run.
///
/// ```
/// use creepage::files::KnownBefore;
/// let measured = KnownBefore { prior: Some([0.02, 0.005]), bounds: None };
/// assert_ne!(measured, KnownBefore::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KnownBefore {
    /// Mean and standard deviation of a normal prior.
    pub prior: Option<[f64; 2]>,
    /// The least and the greatest value.
    pub bounds: Option<[f64; 2]>,
}

/// Reads `prior` and `bounds` of an entry; where an effect has several parameters each stands under its name.
pub(super) fn read_known(section: &Section, effect: &KnownEffect) -> Result<BTreeMap<String, KnownBefore>> {
    let mut found: BTreeMap<String, KnownBefore> = BTreeMap::new();
    let prior_of = |value: &Value| value.section_like("prior".into(), PRIOR).is_ok_and(|s| s.get("mean").is_some());
    for (name, prior) in of_each(section, effect, "prior", PRIOR, &prior_of)? {
        found.entry(name).or_default().prior = Some(read_prior(&prior)?);
    }
    for (name, bounds) in of_each(section, effect, "bounds", BOUNDS, &|value| !value.is_table())? {
        found.entry(name).or_default().bounds = Some(read_bounds(&bounds)?);
    }
    Ok(found)
}

const PRIOR: &str = "prior = { mean = 0.0, std = 0.01 }";
const BOUNDS: &str = "bounds = [-0.05, 0.05]";

/// What an entry says of each parameter under a key: of the only one at once, of several by their names.
fn of_each<'a, 'd>(
    section: &Section<'a, 'd>,
    effect: &KnownEffect,
    key: &str,
    example: &str,
    is_of_one: &impl Fn(&Value<'a, 'd>) -> bool,
) -> Result<Vec<(String, Value<'a, 'd>)>> {
    let Some(value) = section.get(key) else { return Ok(vec![]) };
    let names: Vec<&str> = effect.parameters.iter().map(|p| p.name.as_str()).collect();
    let by_name =
        || format!("write {key} = {{ {} = {} }}", names[0], example.trim_start_matches(key).trim_start_matches(" = "));
    match (&names[..], is_of_one(&value)) {
        ([only], true) => Ok(vec![((*only).to_string(), value)]),
        (_, true) => Err(value
            .error(format!("{} has the parameters {}: {key} does not say which it is of", effect.id, names.join(", ")))
            .help(by_name())),
        (_, false) => {
            let table = value.section_like(key.into(), example)?;
            table.only(&names)?;
            Ok(names.iter().filter_map(|name| Some(((*name).to_string(), table.get(name)?))).collect())
        }
    }
}

fn read_prior(value: &Value) -> Result<[f64; 2]> {
    let table = value.section_like("prior".into(), PRIOR)?;
    table.only(&["mean", "std"])?;
    Ok([table.need("mean", PRIOR)?.number()?, table.need("std", PRIOR)?.positive()?])
}

fn read_bounds(value: &Value) -> Result<[f64; 2]> {
    let ends: Vec<f64> = value.list(BOUNDS)?.iter().map(Value::number).collect::<Result<_>>()?;
    match ends[..] {
        [least, most] if least < most => Ok([least, most]),
        [_, _] => Err(value.error("the bounds end before they begin").help(format!("write {BOUNDS}"))),
        _ => Err(value.error("bounds are a list of two numbers").help(format!("write {BOUNDS}"))),
    }
}
