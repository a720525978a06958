//! `[grid]` and `[sample.of]`: the axes of a sweep, as listed values, even steps or distributions.

use crate::error::Result;
use crate::files::toml::location::Spot;
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions;
use std::collections::BTreeSet;

/// The most values of one axis: they are held in memory, 80 MB of them.
const MAX_VALUES: usize = 10_000_000;

/// A quantity that takes each of some values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Its name, such as `rotation-creep.e_rc`.
    pub name: String,
    /// Where it stands.
    pub spot: Spot,
    /// Its values, in their order.
    pub values: AxisValues,
}

/// The values of an axis.
#[derive(Clone, Debug, PartialEq)]
pub enum AxisValues {
    /// One by one.
    List(Vec<f64>),
    /// From one bound to the other in even steps.
    Even {
        /// The first.
        from: f64,
        /// The last.
        to: f64,
        /// How many, at least one.
        count: usize,
    },
}

impl AxisValues {
    /// How many there are.
    pub fn count(&self) -> usize {
        match self {
            Self::List(values) => values.len(),
            Self::Even { count, .. } => *count,
        }
    }

    /// The i-th from zero, both bounds exactly.
    ///
    /// # Panics
    /// When there is no such value in a list: a fault of the caller.
    pub fn at(&self, i: usize) -> f64 {
        match self {
            Self::List(values) => values[i],
            Self::Even { from, count: 1, .. } => *from,
            Self::Even { from, to, count } => {
                let s = i as f64 / (count - 1) as f64;
                from * (1.0 - s) + to * s
            }
        }
    }
}

/// A quantity that is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    /// Its name.
    pub name: String,
    /// Where it stands.
    pub spot: Spot,
    /// What it is drawn from.
    pub from: Distribution,
}

/// What a value is drawn from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Distribution {
    /// Between two bounds, evenly.
    Uniform(f64, f64),
    /// Between two positive bounds, evenly in the logarithm.
    LogUniform(f64, f64),
    /// Mean and standard deviation.
    Normal(f64, f64),
}

/// Every axis of `[grid]`, in the order of the file.
pub(crate) fn read_grid(section: &Section) -> Result<Vec<Axis>> {
    let leaves = each_once(leaves(section, &["from", "to", "count"])?)?;
    leaves.into_iter().map(|(name, value)| Ok(Axis { name, spot: spot(&value), values: axis(&value)? })).collect()
}

/// Every quantity of `[sample.of]`, in the order of the file.
pub(crate) fn read_sampled(section: &Section) -> Result<Vec<Sampled>> {
    let leaves = each_once(leaves(section, &KINDS)?)?;
    leaves
        .into_iter()
        .map(|(name, value)| Ok(Sampled { name, spot: spot(&value), from: distribution(&value)? }))
        .collect()
}

/// Refuses a name that comes twice: `a.b` and `"a.b"` are one name and two keys.
fn each_once<'a, 'd>(leaves: Vec<(String, Value<'a, 'd>)>) -> Result<Vec<(String, Value<'a, 'd>)>> {
    let mut seen = BTreeSet::new();
    match leaves.iter().find(|(name, _)| !seen.insert(name)) {
        Some((name, value)) => {
            Err(value.key_error(format!("{} is named twice", suggestions::shown(name))).help("name it once"))
        }
        None => Ok(leaves),
    }
}

fn spot(value: &Value) -> Spot {
    Spot::at(value.source, value.key_at)
}

/// Values with their full names: a dotted key is a table in a table.
fn leaves<'a, 'd>(section: &Section<'a, 'd>, own_keys: &[&str]) -> Result<Vec<(String, Value<'a, 'd>)>> {
    let mut found = Vec::new();
    for value in section.entries() {
        let inner = if value.is_table() { Some(value.section(value.name.clone())?) } else { None };
        match inner.filter(|t| !own_keys.iter().any(|k| t.get(k).is_some())) {
            Some(table) => {
                let below = leaves(&table, own_keys)?;
                found.extend(below.into_iter().map(|(name, v)| (format!("{}.{name}", value.name), v)));
            }
            None => found.push((value.name.clone(), value)),
        }
    }
    Ok(found)
}

fn axis(value: &Value) -> Result<AxisValues> {
    let example = format!("{} = [0.0, 0.1] or {{ from = 0.0, to = 0.1, count = 11 }}", value.name);
    if !value.is_table() {
        let values: Vec<f64> = value.list(&example)?.iter().map(Value::number).collect::<Result<_>>()?;
        return match values.is_empty() {
            true => Err(value.error(format!("{} has no value", value.name)).help(format!("write {example}"))),
            false => Ok(AxisValues::List(values)),
        };
    }
    let table = value.section(value.name.clone())?;
    table.only(&["from", "to", "count"])?;
    let number = |key: &str| table.need(key, &example)?.number();
    let (from, to) = (number("from")?, number("to")?);
    let count = table.need("count", &example)?;
    match count.count()? {
        1 if from != to => {
            Err(count.error("one value cannot reach from one bound to the other").help("write count = 2"))
        }
        n if n > MAX_VALUES => {
            Err(count.error(format!("count = {n} is more than {MAX_VALUES}")).help("give fewer values"))
        }
        count => Ok(AxisValues::Even { from, to, count }),
    }
}

const KINDS: [&str; 3] = ["uniform", "log_uniform", "normal"];

fn distribution(value: &Value) -> Result<Distribution> {
    let example = format!("{} = {{ uniform = [0.0, 0.1] }}", value.name);
    if !value.is_table() {
        let error = value.key_error(format!("\"{}\" is no distribution", suggestions::shown(&value.name)));
        return Err(error.help("write e = { uniform = [0.0, 0.1] }, or log_uniform, or normal = [mean, deviation]"));
    }
    let table = value.section(value.name.clone())?;
    table.only(&KINDS)?;
    let given: Vec<Value> = table.entries();
    let [kind] = given.as_slice() else {
        return Err(value.error(format!("{} has two distributions", value.name)).help(format!("write {example}")));
    };
    let numbers: Vec<f64> = kind.list(&example)?.iter().map(Value::number).collect::<Result<_>>()?;
    let [a, b] = numbers[..] else {
        return Err(kind.error(format!("{} needs 2 numbers, not {}", kind.name, numbers.len())).help(example));
    };
    let refuse =
        |why: &str| Err(kind.error(format!("{} [{a:?}, {b:?}] {why}", kind.name)).help(format!("write {example}")));
    match kind.name.as_str() {
        "normal" if b < 0.0 => refuse("has a negative standard deviation"),
        "normal" => Ok(Distribution::Normal(a, b)),
        _ if a > b => refuse("begins above its end"),
        "uniform" => Ok(Distribution::Uniform(a, b)),
        _ if a <= 0.0 => refuse("has a bound that is not positive"),
        _ => Ok(Distribution::LogUniform(a, b)),
    }
}
