//! An entry of `[columns]` that says more than the name of a column: unit, scale, quaternion, counts.

use super::unit::Dimension;
use crate::error::{Error, Result};
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions::{advice, shown};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The columns of a quantity, and how it is read from them.
#[derive(Clone, Debug, PartialEq)]
pub struct ColumnEntry {
    /// Names of columns; of a quaternion its four, or what stands before `.x .y .z .w`.
    pub columns: Vec<String>,
    /// How the quantity follows from their cells.
    pub reading: Reading,
}

/// How a quantity follows from cells: `scale`·(what [`Kind`] gives) + `offset`, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// What the cells hold.
    pub kind: Kind,
    /// SI units in one unit of the cells.
    pub scale: f64,
    /// In SI units.
    pub offset: f64,
}

/// What the cells of a quantity hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number.
    Number,
    /// Seconds, or a date and a time of day of ISO 8601.
    Time,
    /// Time as a number of units of 10 to this negative power of a second, exactly.
    Stamp(u32),
    /// Whole seconds, and nanoseconds beyond them.
    SecondsAndNanoseconds,
    /// Four numbers x, y, z, w, whose turn about z is meant.
    Quaternion,
    /// A cumulative count, whose differences are meant; bits after which it rolls over.
    Ticks(Option<u32>),
    /// A cumulative position, whose differences are meant; what a whole turn of its cells is in SI units.
    Angle(f64),
}

impl Reading {
    /// Cells as they are.
    pub(crate) fn plain(kind: Kind) -> Self {
        Self { kind, scale: 1.0, offset: 0.0 }
    }

    /// Whether differences from row to row are meant, which are means since the row before.
    pub fn is_difference(&self) -> bool {
        matches!(self.kind, Kind::Ticks(_) | Kind::Angle(_))
    }

    /// The least difference that the cells can hold, in SI units; zero where it is not known.
    pub fn resolution(&self) -> f64 {
        if matches!(self.kind, Kind::Ticks(_)) { self.scale.abs() } else { 0.0 }
    }
}

/// The name of a column: a text, or its place from one in a log without a header.
pub(crate) fn name(value: &Value) -> Result<String> {
    match value.is_number() {
        true => Ok(value.count()?.to_string()),
        false => value.text().map(str::to_string),
    }
}

/// An entry of a role whose quantity has this dimension.
pub(crate) fn read(value: &Value, dimension: Option<Dimension>) -> Result<ColumnEntry> {
    read_with(value, dimension, &[])
}

/// The same of an entry that may have further keys, which its reader knows.
pub(crate) fn read_with(value: &Value, dimension: Option<Dimension>, more: &[&'static str]) -> Result<ColumnEntry> {
    let time = dimension == Some(Dimension::Time);
    if value.is_table() {
        return table(value, dimension, more);
    }
    if time && !value.is_text() && !value.is_number() {
        return pair(value);
    }
    let kind = if time { Kind::Time } else { Kind::Number };
    Ok(ColumnEntry { columns: vec![name(value)?], reading: Reading::plain(kind) })
}

/// `position = { latitude = "…", longitude = "…" }`
pub(crate) fn position(value: &Value) -> Result<[String; 2]> {
    let example = "position = { latitude = \"lat\", longitude = \"lon\" }";
    let section = value.section_like("position".into(), example)?;
    section.only(&["latitude", "longitude"])?;
    Ok([name(&section.need("latitude", example)?)?, name(&section.need("longitude", example)?)?])
}

fn pair(value: &Value) -> Result<ColumnEntry> {
    let example = "time = [\"header.stamp.sec\", \"header.stamp.nanosec\"]";
    let columns: Vec<String> = value.list(example)?.iter().map(name).collect::<Result<_>>()?;
    match columns.len() {
        2 => Ok(ColumnEntry { columns, reading: Reading::plain(Kind::SecondsAndNanoseconds) }),
        n => Err(value
            .error(format!("{} needs 2 columns, seconds and nanoseconds, not {n}", value.name))
            .help(format!("write {example}"))),
    }
}

fn table(value: &Value, dimension: Option<Dimension>, more: &[&'static str]) -> Result<ColumnEntry> {
    let role = &value.name;
    let section = value.section_like(role.clone(), &format!("{role} = {{ column = \"…\", unit = \"…\" }}"))?;
    section.only(&[&keys(dimension)[..], more].concat())?;
    let sources: Vec<&str> =
        ["column", "quaternion", "ticks", "angle"].into_iter().filter(|key| section.get(key).is_some()).collect();
    let example = format!("{role} = {{ column = \"…\" }}");
    match sources.as_slice() {
        ["column"] if dimension == Some(Dimension::Time) => stamp(&section),
        ["column"] => Ok(ColumnEntry {
            columns: vec![name(&section.need("column", &example)?)?],
            reading: number(&section, dimension)?,
        }),
        ["quaternion"] => quaternion(&section),
        ["ticks"] => ticks(&section, role),
        ["angle"] => angle(&section),
        [_] | [] => Err(value.error(format!("{role} names no column")).help(format!("write {example}"))),
        [first, second, ..] => {
            Err(value.error(format!("{role} is read from {first} and {second} at once")).help("leave one of them"))
        }
    }
}

fn keys(dimension: Option<Dimension>) -> Vec<&'static str> {
    let more: &[&str] = match dimension {
        Some(Dimension::Time) => return vec!["column", "unit"],
        Some(Dimension::Angle) => &["quaternion", "zero", "turn"],
        Some(Dimension::Rate) => &["ticks", "ticks_per_turn", "gear", "bits", "angle"],
        _ => &[],
    };
    [&["column", "unit", "scale", "offset"], more].concat()
}

/// A time in a unit of its own.
fn stamp(section: &Section) -> Result<ColumnEntry> {
    let digits = match unit(section, Dimension::Time)? {
        1e-3 => Kind::Stamp(3),
        1e-6 => Kind::Stamp(6),
        1e-9 => Kind::Stamp(9),
        _ => Kind::Time,
    };
    Ok(ColumnEntry {
        columns: vec![name(&section.need("column", "column = \"stamp\"")?)?],
        reading: Reading::plain(digits),
    })
}

/// The unit of the cells in SI units; one where none is named.
fn unit(section: &Section, dimension: Dimension) -> Result<f64> {
    let Some(value) = section.get("unit") else { return Ok(1.0) };
    let text = value.text()?;
    dimension.factor(text).ok_or_else(|| unknown(&value, text, dimension))
}

fn unknown(value: &Value, text: &str, dimension: Dimension) -> Error {
    let help = advice(text, &format!("units of {}", dimension.noun()), &dimension.units());
    value.error(format!("\"{}\" is no unit of {}", shown(text), dimension.noun())).help(help)
}

/// A number in a unit, about a zero of its own.
fn number(section: &Section, dimension: Option<Dimension>) -> Result<Reading> {
    let factor = match (dimension, section.get("unit")) {
        (Some(dimension), _) => unit(section, dimension)?,
        (None, None) => 1.0,
        (None, Some(value)) => {
            return Err(value
                .error(format!("no other unit of {} is known than that of the vehicle", section.heading))
                .help("give scale = … in its place"));
        }
    };
    let get = |key: &str, usual: f64| section.get(key).map_or(Ok(usual), |v| v.number());
    let (scale, offset) = (get("scale", 1.0)?, get("offset", 0.0)?);
    if scale == 0.0 {
        return Err(section.error("scale = 0 leaves nothing of the column").help("write scale = 1.0"));
    }
    compass(section, Reading { kind: Kind::Number, scale: factor * scale, offset: factor * offset })
}

/// An angle from north in place of x, clockwise in place of counter-clockwise.
fn compass(section: &Section, reading: Reading) -> Result<Reading> {
    let north = choice(section, "zero", ["east", "north"])?;
    let clockwise = choice(section, "turn", ["counter-clockwise", "clockwise"])?;
    let sign = if clockwise { -1.0 } else { 1.0 };
    let from = if north { FRAC_PI_2 } else { 0.0 };
    Ok(Reading { scale: sign * reading.scale, offset: sign * reading.offset + from, ..reading })
}

/// Whether a key has the second of two values; the first is meant where it is left out.
fn choice(section: &Section, key: &str, values: [&str; 2]) -> Result<bool> {
    let Some(value) = section.get(key) else { return Ok(false) };
    let text = value.text()?;
    match values.iter().position(|v| *v == text) {
        Some(at) => Ok(at == 1),
        None => {
            Err(value.error(format!("unknown {key} \"{}\"", shown(text))).help(advice(text, "it is one of", &values)))
        }
    }
}

fn quaternion(section: &Section) -> Result<ColumnEntry> {
    let example = "quaternion = \"pose.orientation\", for columns pose.orientation.x .y .z .w";
    let value = section.need("quaternion", example)?;
    let columns = match value.is_text() {
        true => vec![name(&value)?],
        false => value.list(example)?.iter().map(name).collect::<Result<Vec<_>>>()?,
    };
    if !matches!(columns.len(), 1 | 4) {
        let message = format!("a quaternion has 4 columns x, y, z, w, not {}", columns.len());
        return Err(value.error(message).help(format!("write {example}")));
    }
    let reading = compass(section, Reading::plain(Kind::Quaternion))?;
    if let Some(stray) = ["unit", "scale", "offset"].iter().find_map(|key| section.get(key)) {
        return Err(stray.key_error(format!("{} has no place beside a quaternion", stray.name)).help("remove it"));
    }
    Ok(ColumnEntry { columns, reading })
}

fn ticks(section: &Section, role: &str) -> Result<ColumnEntry> {
    let example = format!("{role} = {{ ticks = \"…\", ticks_per_turn = 4096 }}");
    if let Some(stray) = ["unit", "scale", "offset"].iter().find_map(|key| section.get(key)) {
        return Err(stray
            .key_error(format!("{} has no place beside ticks", stray.name))
            .help(format!("write {example}")));
    }
    let per_turn = section.need("ticks_per_turn", &example)?.number()?;
    let gear = section.get("gear").map_or(Ok(1.0), |v| v.number())?;
    if per_turn == 0.0 || gear == 0.0 {
        return Err(section.error("ticks_per_turn and gear must not be zero").help(format!("write {example}")));
    }
    let bits = section.get("bits").map(|v| bits(&v)).transpose()?;
    let columns = vec![name(&section.need("ticks", &example)?)?];
    Ok(ColumnEntry {
        columns,
        reading: Reading { kind: Kind::Ticks(bits), scale: TAU / (per_turn * gear), offset: 0.0 },
    })
}

fn bits(value: &Value) -> Result<u32> {
    match value.number()? {
        16.0 => Ok(16),
        32.0 => Ok(32),
        _ => Err(value.error("bits must be 16 or 32").help("leave it out, and it is told from the values")),
    }
}

fn angle(section: &Section) -> Result<ColumnEntry> {
    let example = "{ angle = \"right_position\" }";
    if let Some(stray) = ["ticks_per_turn", "bits", "offset"].iter().find_map(|key| section.get(key)) {
        return Err(stray
            .key_error(format!("{} has no place beside an angle", stray.name))
            .help(format!("write {example}")));
    }
    let get = |key: &str| section.get(key).map_or(Ok(1.0), |v| v.number());
    let (scale, gear) = (get("scale")?, get("gear")?);
    if scale == 0.0 || gear == 0.0 {
        return Err(section.error("scale and gear must not be zero").help(format!("write {example}")));
    }
    let kind = Kind::Angle(TAU * (scale / gear).abs());
    let reading = Reading { kind, scale: unit(section, Dimension::Angle)? * scale / gear, offset: 0.0 };
    Ok(ColumnEntry { columns: vec![name(&section.need("angle", example)?)?], reading })
}
