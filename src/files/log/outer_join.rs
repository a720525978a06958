//! Inputs and poses in one file on rows of their own, as an outer merge writes them.

use super::cells::{self, Cells};
use super::columns::Resolved;
use super::csv_table::Numbers;
use super::log_file::Log;
use super::own_times::at_times;
use super::reading;
use super::row_order;
use super::run::{Apart, Run, arrange, difference, enough};
use super::two_clocks::Clock;
use crate::error::Result;
use std::path::Path;

/// Why a row is left out that has neither a pose nor an input.
const BLANK: &str = "row without a pose and without an input (blank or NaN cells)";

impl Run {
    /// A run whose poses, and perhaps inputs, stand on rows of their own; none where at least half of the poses stand on rows
    /// with inputs, of which there are `whole`.
    ///
    /// Inputs that do not stand on the rows of one another are interpolated to the rows of the one that has the most.
    pub(crate) fn read_outer_join(path: &Path, log: Log, found: &Resolved, whole: usize) -> Result<Option<Self>> {
        let pose = found.pose();
        let driven: Vec<&Cells> = found.inputs.iter().map(|input| &input.cells).collect();
        let numbers = reading::read_all_rows(log, &found.time, &[&pose[..], &driven, &found.spare()].concat())?;
        let has = |i: usize, from: usize, n: usize| numbers.columns[from..from + n].iter().all(|c| c[i].is_finite());
        let rows = numbers.columns[0].len();
        let posed: Vec<usize> = (0..rows).filter(|i| has(*i, 1, pose.len())).collect();
        let first_input = 1 + pose.len();
        let fewest =
            (0..driven.len()).map(|k| numbers.columns[first_input + k].iter().filter(|v| v.is_finite()).count()).min();
        if posed.len() <= 2 * whole || fewest.unwrap_or(0) < 2 || driven.is_empty() {
            return Ok(None);
        }
        let any = |i: usize| {
            has(i, 1, pose.len()) || (0..driven.len()).any(|k| numbers.columns[first_input + k][i].is_finite())
        };
        let blank = (0..rows).filter(|i| !any(*i)).count();
        let (time, columns) = signals(&numbers, first_input, &driven);
        let pick = |c: &Vec<f64>| posed.iter().map(|i| c[*i]).collect::<Vec<f64>>();
        let poses = numbers.columns[..first_input].iter().map(pick);
        let spare = numbers.columns[first_input + driven.len()..].iter().map(pick);
        let mut dropped = numbers.dropped.clone();
        if blank > 0 {
            dropped.insert(BLANK.into(), blank);
        }
        let mut measured = Numbers {
            columns: poses.chain(spare).collect(),
            rows: numbers.rows,
            dropped,
            sha256: numbers.sha256.clone(),
            ..numbers
        };
        cells::mark_absent(&mut measured, first_input);
        let warnings = arrange(&mut measured);
        enough(&measured).map_err(|e| e.at_file(path))?;
        let sha256 = measured.sha256.clone();
        let apart = Apart { time, truth: path.to_path_buf(), truth_sha256: sha256, one_clock: true };
        let run = Run::build(path, Resolved { inputs: vec![], ..found.clone() }, measured, warnings);
        let run = Run {
            roles: found.inputs.iter().map(|input| input.role.clone()).collect(),
            differences: driven.iter().map(|cells| difference(cells)).collect(),
            inputs: inputs_of(&apart.time, columns, &driven),
            apart: Some(apart),
            ..run
        };
        Ok(Some(run.aligned(&Clock { offset: 0.0, drift: 0.0, at: 0.0 })).filter(|run| run.time.len() > 1))
    }
}

/// Times and positions of all inputs: those of the input with the most rows, to which others are interpolated.
fn signals(numbers: &Numbers, first: usize, driven: &[&Cells]) -> (Vec<f64>, Vec<Vec<f64>>) {
    let own: Vec<(Vec<f64>, Vec<f64>)> = driven
        .iter()
        .enumerate()
        .map(|(k, cells)| own_rows(&numbers.columns[0], &numbers.columns[first + k], cells))
        .collect();
    let longest = own.iter().map(|(time, _)| time).max_by_key(|time| time.len()).cloned().unwrap_or_default();
    let columns: Vec<Vec<f64>> = own
        .iter()
        .map(|(time, column)| if *time == longest { column.clone() } else { at_times(time, column, &longest) })
        .collect();
    let kept: Vec<usize> = (0..longest.len()).filter(|i| columns.iter().all(|c| c[*i].is_finite())).collect();
    let pick = |c: &Vec<f64>| kept.iter().map(|i| c[*i]).collect::<Vec<f64>>();
    (pick(&longest), columns.iter().map(pick).collect())
}

/// The rows of one input, in the order of time, each time once.
fn own_rows(time: &[f64], column: &[f64], cells: &Cells) -> (Vec<f64>, Vec<f64>) {
    let rows: Vec<usize> = (0..time.len()).filter(|i| column[*i].is_finite()).collect();
    let mut own = [time, column].map(|c| rows.iter().map(|i| c[*i]).collect::<Vec<f64>>());
    row_order::sort(&mut own);
    row_order::merge(&mut own);
    let [time, column] = own;
    (time, cells.positions(column))
}

fn inputs_of(time: &[f64], positions: Vec<Vec<f64>>, driven: &[&Cells]) -> Vec<Vec<f64>> {
    driven.iter().zip(positions).map(|(cells, column)| cells.rates(time, column)).collect()
}
