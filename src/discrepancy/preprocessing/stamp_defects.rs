//! Times of arrival in the place of times of measuring: rows that come in bursts.

use super::unit_errors::{Slip, SlipKind};
use crate::discrepancy::record::local_polynomial::{self, median};
use crate::files::Run;

/// Steps shorter than this share of the mean one lie within a burst, longer than so many times behind one.
const WITHIN: f64 = 0.25;
const BEHIND: f64 = 2.0;
/// Rows within bursts, and time behind them, as shares.
const BURSTS: [f64; 2] = [0.3, 0.5];
/// Rows that tell anything.
const FEWEST: usize = 40;
/// Rates within bursts over those behind them, that the same motion does not have.
const UNLIKE: f64 = 3.0;
/// Pauses that are no part of the rhythm, in mean steps.
const PAUSE: f64 = 20.0;

/// The first run whose rows come in bursts and whose rates belie its times.
///
/// Within a burst times lie close, and behind it there is a long one. Where rows are those of measuring, rates in both are
/// alike; where a rate is a way over a wrong time, or ways from row to row are alike whatever the time between, they are not.
pub fn bursts<'a>(runs: impl IntoIterator<Item = &'a Run>) -> Option<Slip> {
    runs.into_iter().find_map(|run| of_run(run).map(|kind| Slip { run: run.name.clone(), kind }))
}

fn of_run(run: &Run) -> Option<SlipKind> {
    let time = run.input_time();
    let all: Vec<f64> = time.windows(2).map(|w| w[1] - w[0]).collect();
    let overall = all.iter().sum::<f64>() / all.len().max(1) as f64;
    let rhythm = |i: &usize| all[*i] < PAUSE * overall;
    let rows: Vec<usize> = (0..all.len()).filter(rhythm).collect();
    let total = rows.iter().map(|i| all[*i]).sum::<f64>();
    let mean = total / rows.len().max(1) as f64;
    let within: Vec<usize> = rows.iter().copied().filter(|i| all[*i] < WITHIN * mean).collect();
    let behind: Vec<usize> = rows.iter().copied().filter(|i| all[*i] > BEHIND * mean).collect();
    let lasts = behind.iter().map(|i| all[*i]).sum::<f64>();
    let is_bursts = within.len() as f64 > BURSTS[0] * rows.len() as f64 && lasts > BURSTS[1] * total;
    if rows.len() < FEWEST || !is_bursts {
        return None;
    }
    let usual =
        |rows: &[usize], of: &dyn Fn(usize) -> f64| median(&mut rows.iter().map(|i| of(*i)).collect::<Vec<_>>());
    let ratio = |of: &dyn Fn(usize) -> f64| {
        let (a, b) = (usual(&within, of)?, usual(&behind, of)?);
        Some(a / b).filter(|r| r.is_finite())
    };
    // The rate that closes a step, and the measured speed over it.
    let of_inputs = run.inputs.iter().filter_map(|column| ratio(&|i| column[i + 1].abs()));
    let speed = |i: usize| (run.x[i + 1] - run.x[i]).hypot(run.y[i + 1] - run.y[i]) / all[i];
    let of_pose = if run.apart.is_none() && fast(run, &within) { ratio(&speed) } else { None };
    let rates = of_inputs.chain(of_pose).find(|r| *r > UNLIKE)?;
    let steps = [&within, &behind].map(|rows| usual(rows, &|i| all[i]).unwrap_or(f64::NAN));
    Some(SlipKind::Bursts { steps, rates })
}

/// Whether what moves within a burst is more than the noise of a position.
fn fast(run: &Run, within: &[usize]) -> bool {
    let noise = |column: &[f64]| local_polynomial::noise(&run.time, column).unwrap_or(0.0);
    let noise = noise(&run.x).max(noise(&run.y));
    let way = |i: &usize| (run.x[i + 1] - run.x[*i]).hypot(run.y[i + 1] - run.y[*i]);
    let mean = within.iter().map(way).sum::<f64>() / within.len().max(1) as f64;
    mean > 20.0 * noise
}
