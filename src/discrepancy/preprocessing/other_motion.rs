//! Stretches in which something else moves the vehicle, or nothing does: it is lifted, or carried.

use super::path_pair::{Moved, PathPair};
use super::row_defects::{DefectKind, stretches};

/// Windows that are asked one by one, s, and how many in a row make a stretch.
const WINDOW: f64 = 1.0;
const IN_A_ROW: usize = 2;
/// A motion counts that is so large a share of the usual one, and so many times the noise of a position.
const MOVES: f64 = 0.3;
const OUT_OF_NOISE: f64 = 30.0;
/// Shares of the other's way that are none.
const STANDS: f64 = 0.1;
const IDLE: f64 = 0.02;
/// Turns that are none: a share of the other's, and in deviations of a heading; rad of what is reckoned from idle inputs.
const NO_TURN: (f64, f64) = (0.1, 5.0);
const IDLE_TURN: f64 = 0.05;
/// More than this share of a run is no exception in it.
const MOST: f64 = 0.3;

/// Stretches in which the measured pose stands still although the inputs say motion, or moves although they say none; each
/// with a window on either side, in which it begins or ends.
pub(super) fn found(pair: PathPair) -> Vec<DefectKind> {
    let windows = pair.windows(WINDOW);
    let each: Vec<[Moved; 2]> = windows.iter().map(|w| [pair.measured(w.0, w.1), pair.reckoned(w.0, w.1)]).collect();
    let noise = pair.noise();
    let usual = [0, 1].map(|k| rms(&each, k));
    let far = |way: f64, k: usize| way > (MOVES * usual[k]).max(OUT_OF_NOISE * noise[0]).max(1e-6);
    let turned = |m: Moved| m.turn.unwrap_or(0.0).abs();
    let stands = |i: usize| {
        let [measured, reckoned] = each[i];
        let turns = turned(measured) > NO_TURN.0 * turned(reckoned) + NO_TURN.1 * noise[1] + 1e-6;
        far(reckoned.way, 1) && measured.way < STANDS * reckoned.way && !turns
    };
    let idle = |i: usize| each[i][1].way < IDLE * usual[1] && turned(each[i][1]) < IDLE_TURN;
    // What rolls out behind a drive is not carried.
    let carried = |i: usize| idle(i) && far(each[i][0].way, 0) && (i == 0 || idle(i - 1));
    let time = &pair.run.time;
    let lasts = time[time.len() - 1] - time[0];
    let spans = |is_one: &dyn Fn(usize) -> bool| -> Vec<[f64; 2]> {
        let long = stretches(windows.len(), is_one).into_iter().filter(|rows| rows.len() >= IN_A_ROW);
        let span = |rows: std::ops::Range<usize>| {
            let (from, to) = (time[windows[rows.start].0], time[windows[rows.end - 1].1]);
            [(from - WINDOW).max(time[0]), (to + WINDOW).min(time[time.len() - 1])]
        };
        let all: Vec<[f64; 2]> = long.map(span).collect();
        let lost: f64 = all.iter().map(|[from, to]| to - from).sum();
        if lost > MOST * lasts { vec![] } else { all }
    };
    let stood = spans(&stands).into_iter().map(DefectKind::Stands);
    stood.chain(spans(&carried).into_iter().map(DefectKind::Carried)).collect()
}

fn rms(each: &[[Moved; 2]], k: usize) -> f64 {
    (each.iter().map(|m| m[k].way * m[k].way).sum::<f64>() / each.len().max(1) as f64).sqrt()
}
