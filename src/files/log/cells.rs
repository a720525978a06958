//! Quantities read from the cells of a log.

use super::column_entry::{ColumnEntry, Kind, Reading};
use super::csv_table::Numbers;
use super::place::{Form, Place};
use super::quaternion::yaw;
use super::{counts, row_order};
use crate::error::{Error, Result};
use crate::files::toml::suggestions;

/// Where a quantity stands in a row, and how it is read.
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    /// Places in the header, from zero.
    pub places: Vec<usize>,
    /// How the quantity follows from them.
    pub reading: Reading,
    /// Whether it is a heading, which may be wrapped.
    pub wraps: bool,
}

/// What stands before the name of a quantity of `[measured]` where it is a role.
pub(crate) const MEASURED: &str = "measured.";
/// A standard deviation that a row does not have, among finite numbers.
const ABSENT: f64 = -1.0;
/// What stands between the name of a quaternion and its four letters.
const JOINTS: [&str; 4] = [".", "_", "/", ""];

impl Cells {
    /// The cells of a role in the header of a log; errors do not know the file yet.
    pub(crate) fn find(header: &[String], role: &str, column: &str, entry: Option<&ColumnEntry>) -> Result<Self> {
        let Some(entry) = entry else {
            return Ok(Self {
                places: vec![find(header, role, column)?],
                reading: Reading::plain(Kind::Number),
                wraps: false,
            });
        };
        let places = match entry.columns.as_slice() {
            [name] if entry.reading.kind == Kind::Quaternion => quaternion(header, role, name)?,
            names => names.iter().map(|name| find(header, role, name)).collect::<Result<_>>()?,
        };
        Ok(Self { places, reading: entry.reading, wraps: false })
    }

    pub(crate) fn places(&self) -> impl Iterator<Item = Place> {
        let kind = self.reading.kind;
        self.places.iter().enumerate().map(move |(i, &index)| {
            let form = match (kind, i) {
                (Kind::Time, _) => Form::Time,
                (Kind::Stamp(digits), _) => Form::Stamp(digits),
                (Kind::SecondsAndNanoseconds, 0) => Form::Stamp(0),
                _ => Form::Number,
            };
            Place { index, form }
        })
    }

    /// The quantity from its cells; of counts and positions these themselves.
    fn joined(&self, cells: &[Vec<f64>]) -> Vec<f64> {
        let Reading { kind, scale, offset } = self.reading;
        let linear = |v: f64| if scale == 1.0 && offset == 0.0 { v } else { scale * v + offset };
        match (kind, cells) {
            (Kind::SecondsAndNanoseconds, [seconds, nano]) => {
                seconds.iter().zip(nano).map(|(s, n)| s + 1e-9 * n).collect()
            }
            (Kind::Quaternion, [x, y, z, w]) => (0..x.len()).map(|i| linear(yaw([x[i], y[i], z[i], w[i]]))).collect(),
            (Kind::Number, [column]) => column.iter().map(|v| linear(*v)).collect(),
            _ => cells.first().cloned().unwrap_or_default(),
        }
    }

    /// Counts or positions of sorted rows as one that goes on, in SI units; any other quantity as it is.
    pub(crate) fn positions(&self, column: Vec<f64>) -> Vec<f64> {
        let scaled = |column: Vec<f64>| column.iter().map(|v| self.reading.scale * v).collect::<Vec<f64>>();
        match self.reading.kind {
            Kind::Ticks(bits) => scaled(counts::unrolled(&column, bits)),
            Kind::Angle(turn) => counts::unwound(scaled(column), turn),
            _ => column,
        }
    }

    /// Headings, counts or positions without their jumps, in the unit of their cells.
    pub(crate) fn continued(&self, column: Vec<f64>) -> Vec<f64> {
        if self.wraps {
            return unwrapped(column);
        }
        if !self.reading.is_difference() {
            return column;
        }
        self.positions(column).iter().map(|p| p / self.reading.scale).collect()
    }

    /// An input from its positions at the times of its rows.
    pub(crate) fn rates(&self, time: &[f64], positions: Vec<f64>) -> Vec<f64> {
        if self.reading.is_difference() { counts::mean_rates(time, &positions) } else { positions }
    }

    /// A rate at the times of its rows; of counts and positions by what lies on either side of a row.
    pub(crate) fn central_rates(&self, time: &[f64], positions: Vec<f64>) -> Vec<f64> {
        if self.reading.is_difference() { counts::central_rates(time, &positions) } else { positions }
    }
}

/// A column for every quantity.
pub(crate) fn joined(numbers: Numbers, all: &[&Cells]) -> Numbers {
    let mut at = 0;
    let columns = all.iter().map(|cells| {
        let from = at;
        at += cells.places.len();
        cells.joined(&numbers.columns[from..at])
    });
    Numbers { columns: columns.collect(), ..numbers }
}

/// Drops rows in which a quantity cannot be made of finite cells: a quaternion of zeros is no heading.
pub(crate) fn drop_rows_without(numbers: &mut Numbers, names: &[String]) {
    let rows = numbers.columns.first().map_or(0, Vec::len);
    let lacks = |i: usize| numbers.columns.iter().take(names.len()).position(|c| !c[i].is_finite());
    let found: Vec<(usize, usize)> = (0..rows).filter_map(|i| Some((i, lacks(i)?))).collect();
    if found.is_empty() {
        return;
    }
    for (_, c) in &found {
        *numbers.dropped.entry(format!("value that is no number in column \"{}\"", names[*c])).or_default() += 1;
    }
    let lost: std::collections::BTreeSet<usize> = found.iter().map(|(i, _)| *i).collect();
    for column in &mut numbers.columns {
        let mut i = 0;
        column.retain(|_| {
            i += 1;
            !lost.contains(&(i - 1))
        });
    }
}

/// Marks what a row lacks of the columns behind the first `needed` ones, so that rows can be compared.
pub(crate) fn mark_absent(numbers: &mut Numbers, needed: usize) {
    numbers.columns.iter_mut().skip(needed).flatten().filter(|v| !v.is_finite()).for_each(|v| *v = ABSENT);
}

/// A column of standard deviations, NaN where a row has none.
pub(crate) fn deviations(column: Vec<f64>) -> Vec<f64> {
    column.into_iter().map(|v| if v > 0.0 { v } else { f64::NAN }).collect()
}

/// Angles without jumps.
pub(crate) fn unwrapped(mut angles: Vec<f64>) -> Vec<f64> {
    row_order::unwrap(&mut angles);
    angles
}

fn quaternion(header: &[String], role: &str, name: &str) -> Result<Vec<usize>> {
    let names = |joint: &str| ["x", "y", "z", "w"].map(|letter| format!("{name}{joint}{letter}"));
    let joint = JOINTS.iter().find(|joint| names(joint).iter().all(|n| header.contains(n))).unwrap_or(&".");
    names(joint).iter().map(|column| find(header, role, column)).collect()
}

/// The only place of a column in the header.
fn find(header: &[String], role: &str, column: &str) -> Result<usize> {
    let mut places = header.iter().enumerate().filter(|(_, name)| *name == column).map(|(i, _)| i);
    match (places.next(), places.next()) {
        (Some(index), None) => Ok(index),
        (Some(first), Some(second)) => Err(Error::input(format!(
            "column \"{column}\" stands twice in the header, as cell {} and cell {}",
            first + 1,
            second + 1
        ))
        .help("rename or remove one of them")),
        // A comment that names the columns begins with its mark.
        (None, _) if column.starts_with('#') && column.len() > 1 => {
            find(header, role, column.trim_start_matches('#').trim())
        }
        (None, _) => Err(missing(header, role, column, None)),
    }
}

/// Whether columns have no names of their own: they are called by their numbers.
pub(crate) fn is_without_names(header: &[String]) -> bool {
    !header.is_empty() && header.iter().enumerate().all(|(i, name)| *name == (i + 1).to_string())
}

pub(crate) fn missing(header: &[String], role: &str, column: &str, instead: Option<&str>) -> Error {
    let names: Vec<&str> = header.iter().map(String::as_str).collect();
    let advice = suggestions::advice(column, "the file has", &names);
    let or = instead.map(|other| format!(" or \"{other}\"")).unwrap_or_default();
    let (table, key) = match role.strip_prefix(MEASURED) {
        Some(name) => ("[measured]", name),
        None => ("[columns]", role),
    };
    let purpose = if role == column { String::new() } else { format!(" for {role}") };
    let error = Error::input(format!("column \"{column}\"{or}{purpose} is missing"));
    if is_without_names(header) {
        let n = names.len();
        return error.help(format!(
            "the file has no names of columns: they are called 1 to {n}; name the right one under {table} of the model \
             file: {key} = 1"
        ));
    }
    error.help(format!("{advice}; name the right one under {table} of the model file: {key} = \"…\""))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn cells(kind: Kind, scale: f64, offset: f64) -> Cells {
        Cells { places: vec![0], reading: Reading { kind, scale, offset }, wraps: false }
    }

    #[test]
    fn quantities_are_made_of_their_cells() {
        assert_eq!(cells(Kind::Number, -2.0, 1.0).joined(&[vec![3.0]]), [-5.0]);
        let pair = cells(Kind::SecondsAndNanoseconds, 1.0, 0.0);
        assert_eq!(pair.joined(&[vec![2.0], vec![250_000_000.0]]), [2.25]);
        let half = 0.5f64.sqrt();
        let turned = cells(Kind::Quaternion, -1.0, 1.0).joined(&[vec![0.0], vec![0.0], vec![half], vec![half]]);
        assert!((turned[0] - (1.0 - TAU / 4.0)).abs() < 1e-12);
    }

    #[test]
    fn counts_become_rates() {
        let ticks = cells(Kind::Ticks(None), TAU / 100.0, 0.0);
        let positions = ticks.positions(vec![65_530.0, 4.0, 14.0]);
        let rates = ticks.rates(&[0.0, 0.5, 1.0], positions);
        assert!((rates[1] - TAU * 0.2).abs() < 1e-9 && (rates[2] - TAU * 0.2).abs() < 1e-9, "{rates:?}");
        assert_eq!(cells(Kind::Number, 2.0, 0.0).rates(&[0.0, 1.0], vec![3.0, 4.0]), [3.0, 4.0]);
    }

    #[test]
    fn a_quaternion_of_zeros_drops_its_row() {
        let columns = vec![vec![0.0, 1.0, 2.0], vec![0.5, f64::NAN, 0.6]];
        let mut numbers = Numbers {
            columns,
            rows: 3,
            dropped: Default::default(),
            sha256: String::new(),
            origin: Default::default(),
        };
        drop_rows_without(&mut numbers, &["t".to_string(), "q".into()]);
        assert_eq!(numbers.columns, [[0.0, 2.0], [0.5, 0.6]]);
        assert_eq!(numbers.dropped["value that is no number in column \"q\""], 1);
    }

    #[test]
    fn a_quaternion_is_found_by_what_stands_before_its_letters() {
        let header = |text: &str| text.split(',').map(str::to_string).collect::<Vec<_>>();
        assert_eq!(quaternion(&header("t,q.x,q.y,q.z,q.w"), "heading", "q").unwrap(), [1, 2, 3, 4]);
        assert_eq!(quaternion(&header("qw,qx,qy,qz"), "heading", "q").unwrap(), [1, 2, 3, 0]);
        let error = quaternion(&header("q.x,q.y,q.z"), "heading", "q").unwrap_err().to_string();
        assert!(error.contains("\"q.w\" for heading is missing"), "{error}");
    }
}
