//! Measured poses in the files of benchmarks: TUM, EuRoC and KITTI.

use super::cells::{Cells, is_without_names};
use super::column_entry::{Kind, Reading};
use super::columns::Resolved;
use super::csv_table::Numbers;
use super::log_file::Log;
use super::reading;
use super::time_stamp::Origin;
use crate::error::{Error, Result};
use std::path::Path;

/// Numbers in a row of TUM: time, place, quaternion.
const TUM: usize = 8;
/// Numbers in a row of KITTI: three rows of a rotation with a place behind each.
const KITTI: usize = 12;

/// The cells of a trajectory, where the header is that of one.
///
/// | format | columns |
/// |---|---|
/// | TUM | time in s, x, y, z, and a quaternion x, y, z, w; no header |
/// | EuRoC | time in ns, `p_RS_R_x`, …, `q_RS_w`, `q_RS_x`, … |
pub(crate) fn recognised(header: &[String], origin: Origin) -> Option<Resolved> {
    let cells = |places: Vec<usize>, kind| Cells { places, reading: Reading::plain(kind), wraps: false };
    let trajectory = |time, x, y, turn: Vec<usize>| Resolved {
        time,
        x: cells(vec![x], Kind::Number),
        y: Some(cells(vec![y], Kind::Number)),
        geographic: false,
        heading: Some(cells(turn, Kind::Quaternion)),
        trailer_headings: vec![],
        measured: vec![],
        deviations: [None, None, None],
        inputs: vec![],
    };
    let at = |name: &str| header.iter().position(|h| h.starts_with(name));
    if let (Some(x), Some(y), Some(w)) = (at("p_RS_R_x"), at("p_RS_R_y"), at("q_RS_w")) {
        let time = cells(vec![at("timestamp")?], Kind::Stamp(9));
        return Some(trajectory(time, x, y, vec![at("q_RS_x")?, at("q_RS_y")?, at("q_RS_z")?, w]));
    }
    let named = ["tx", "ty", "tz", "qx", "qy", "qz", "qw"]
        .iter()
        .enumerate()
        .all(|(i, n)| header.get(i + 1).is_some_and(|h| h == n));
    if header.len() == TUM && (named || is_without_names(header)) {
        let kind = if origin.0.is_some_and(|second| second > 0) { Kind::Stamp(0) } else { Kind::Time };
        return Some(trajectory(cells(vec![0], kind), 1, 2, vec![4, 5, 6, 7]));
    }
    None
}

/// Whether a header is that of KITTI.
pub(crate) fn is_kitti(header: &[String]) -> bool {
    header.len() == KITTI && is_without_names(header)
}

/// The poses of KITTI, whose times stand in `times.txt` beside them.
///
/// The camera looks along z, x points to the right and y down; where z is what changes least, the poses are those of a
/// body, which looks along x.
///
/// # Errors
/// When there is no such file, or it has another number of rows.
pub(crate) fn kitti(log: Log, path: &Path) -> Result<(Resolved, Numbers)> {
    let places: Vec<Cells> =
        (0..KITTI).map(|i| Cells { places: vec![i], reading: Reading::plain(Kind::Number), wraps: false }).collect();
    let wanted: Vec<&Cells> = places.iter().collect();
    let numbers = reading::read(log, &wanted, &[])?;
    let beside = path.with_file_name("times.txt");
    if !beside.is_file() {
        return Err(Error::input("has poses of KITTI without times")
            .at_file(path)
            .help("put times.txt beside it, a time in seconds for every row"));
    }
    let time = times(&beside)?;
    let c = &numbers.columns;
    if time.len() != c[0].len() {
        let message = format!("has {} times where {} has {} poses", time.len(), path.display(), c[0].len());
        return Err(Error::input(message).at_file(&beside).help("give one time for every pose"));
    }
    let spread = |column: &[f64]| {
        let (a, b) = column.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
        b - a
    };
    let camera = spread(&c[7]) < spread(&c[11]);
    let rows = 0..time.len();
    let (x, y, heading): (Vec<f64>, Vec<f64>, Vec<f64>) = match camera {
        true => (c[11].clone(), c[3].iter().map(|v| -v).collect(), rows.map(|i| (-c[2][i]).atan2(c[10][i])).collect()),
        false => (c[3].clone(), c[7].clone(), rows.map(|i| c[4][i].atan2(c[0][i])).collect()),
    };
    let one = |index: usize| Cells { places: vec![index], reading: Reading::plain(Kind::Number), wraps: false };
    let found = Resolved {
        time: one(0),
        x: one(1),
        y: Some(one(2)),
        geographic: false,
        heading: Some(one(3)),
        trailer_headings: vec![],
        measured: vec![],
        deviations: [None, None, None],
        inputs: vec![],
    };
    Ok((found, Numbers { columns: vec![time, x, y, heading], ..numbers }))
}

/// One number a line.
fn times(path: &Path) -> Result<Vec<f64>> {
    let text = crate::files::read_text(path)?;
    let number = |(i, line): (usize, &str)| {
        let value = line.trim().parse::<f64>().ok().filter(|v| v.is_finite());
        value.ok_or_else(|| {
            Error::input("is not a time in seconds").at_file(path).at(i + 1, 1).help("write one number a line")
        })
    };
    text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()).map(number).collect()
}
