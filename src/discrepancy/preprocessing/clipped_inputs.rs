//! Inputs that were cut off at an end of their range before they were logged.

use super::path_pair::{Moved, PathPair};
use super::row_defects::{DefectKind, stretches};
use std::ops::Range;

/// Rows that pile up at an end: so many, and this share of all.
const FEWEST: usize = 10;
const SHARE: f64 = 0.02;
/// Stretches, and the rows of each.
const STRETCHES: usize = 3;
const LONG: usize = 3;
/// Any other value comes less often by this share.
const OTHERS: f64 = 0.2;
/// The vehicle does so many times as much through most of the stretches as its inputs say, beside what it does elsewhere.
const MORE: f64 = 1.05;
const MOSTLY: f64 = 0.7;
/// Windows elsewhere, s.
const ELSEWHERE: f64 = 0.5;
/// Ways and turns so many times their noise tell a ratio, and this share of the usual ones.
const OUT_OF_NOISE: f64 = 20.0;
const MOVES: f64 = 0.3;

/// The ends at which an input stands while the vehicle does more.
pub(super) fn found(pair: PathPair) -> Vec<DefectKind> {
    let run = pair.run;
    let noise = pair.noise();
    let mut found = vec![];
    for (role, column) in run.roles.iter().zip(&run.inputs) {
        let ends = [f64::total_cmp, |a: &f64, b: &f64| b.total_cmp(a)].map(|o| column.iter().copied().max_by(o));
        let [Some(most), Some(least)] = ends else { continue };
        for value in [most, least] {
            let at = piled_up(column, value, if value == most { least } else { most });
            let at_an_end = stretches(column.len(), |i| column[i] == most || column[i] == least);
            if at.len() >= STRETCHES && does_more(pair, noise, [&at, &at_an_end]) {
                let rows = at.iter().map(ExactSizeIterator::len).sum();
                found.push(DefectKind::Clipped { role: role.clone(), value, rows, times: at.len() });
            }
        }
    }
    found
}

/// Stretches of a column that stand at one end of its range, where no other value but the other end comes as often.
fn piled_up(column: &[f64], value: f64, other: f64) -> Vec<Range<usize>> {
    let long = stretches(column.len(), |i| column[i] == value).into_iter().filter(|rows| rows.len() >= LONG);
    let long: Vec<Range<usize>> = long.collect();
    let rows: usize = long.iter().map(ExactSizeIterator::len).sum();
    if value == other || rows < FEWEST || (rows as f64) < SHARE * column.len() as f64 {
        return vec![];
    }
    let mut rest: Vec<f64> = column.iter().copied().filter(|u| *u != value && *u != other).collect();
    rest.sort_by(f64::total_cmp);
    let often = rest.chunk_by(|a, b| a == b).map(<[f64]>::len).max().unwrap_or(0);
    if often as f64 > OTHERS * rows as f64 { vec![] } else { long }
}

/// Whether the vehicle moves, or turns, more than is reckoned in most of some stretches of the inputs, beside what it does
/// outside of others.
fn does_more(pair: PathPair, noise: [f64; 2], [at, at_an_end]: [&[Range<usize>]; 2]) -> bool {
    let time = pair.run.input_time();
    let pose = &pair.run.time;
    let rows = |inputs: &Range<usize>| {
        let (from, to) = (time[inputs.start], time[inputs.end - 1]);
        let rows = (pose.partition_point(|t| *t < from), pose.partition_point(|t| *t <= to).saturating_sub(1));
        (rows.0 < rows.1).then_some(rows)
    };
    let inside: Vec<(usize, usize)> = at.iter().filter_map(rows).collect();
    let ends_within = |w: &(usize, usize)| {
        let next = at_an_end.partition_point(|rows| time[rows.end - 1] < pose[w.0]);
        at_an_end.get(next).is_some_and(|rows| time[rows.start] <= pose[w.1])
    };
    let outside: Vec<(usize, usize)> = pair.windows(ELSEWHERE).into_iter().filter(|w| !ends_within(w)).collect();
    let way = |m: Moved| m.way;
    let turn = |m: Moved| m.turn.unwrap_or(0.0).abs();
    let quantities: [(&dyn Fn(Moved) -> f64, f64); 2] = [(&way, noise[0]), (&turn, noise[1])];
    quantities.into_iter().any(|(of, noise)| {
        let lasts = |w: &(usize, usize)| pose[w.1] - pose[w.0];
        let rate = |w: &(usize, usize)| of(pair.reckoned(w.0, w.1)) / lasts(w);
        let squares = outside.iter().chain(&inside).map(|w| rate(w) * rate(w) * lasts(w)).sum::<f64>();
        let usual = (squares / outside.iter().chain(&inside).map(lasts).sum::<f64>().max(f64::MIN_POSITIVE)).sqrt();
        let ratios = |rows: &[(usize, usize)]| -> Vec<(f64, f64)> {
            let tells = |w: &&(usize, usize)| {
                of(pair.reckoned(w.0, w.1)) > OUT_OF_NOISE * noise && rate(w) > (MOVES * usual).max(1e-6)
            };
            let ratio = |w: &(usize, usize)| of(pair.measured(w.0, w.1)) / of(pair.reckoned(w.0, w.1));
            rows.iter().filter(tells).map(|w| (lasts(w), ratio(w))).collect()
        };
        let (here, mut there) = (ratios(&inside), ratios(&outside));
        there.sort_by(|a, b| a.1.total_cmp(&b.1));
        // Above three in four elsewhere: a vehicle whose ratio varies everywhere says nothing.
        let Some((_, bar)) = there.get(there.len() * 3 / 4) else { return false };
        let total = here.iter().map(|h| h.0).sum::<f64>();
        let more = here.iter().filter(|h| h.1 > MORE * bar).map(|h| h.0).sum::<f64>();
        here.len() >= STRETCHES && more >= MOSTLY * total
    })
}
