//! Forecasts: where the model as given and the patched one would be some seconds ahead, from many places of every run.

use super::before_after::{ModelComparison, Rollouts};
use super::scope_spans::Gates;
use crate::discrepancy::report::{Forecast, Gap};
use crate::discrepancy::shooting::rollout::Rollout;
use crate::model::observation::{BODY_HEADING, PLACE};
use rayon::prelude::*;

/// Places in all runs together, and in each run at least.
const PLACES: [usize; 2] = [900, 60];
/// Places of one run: more are not told apart on a map.
const MOST_PLACES: usize = 400;
/// Places of one run where each begins with a fit of the speeds there.
const FITTED_PLACES: usize = 150;
/// Points of a forecast, its first and its last among them.
const POINTS: usize = 11;

/// The forecasts of every run as far ahead as a gap, the one first of which the patched model leaves most.
pub(crate) fn forecasts(of: &ModelComparison, gap: Option<&Gap>, gates: &Gates) -> Vec<Forecast> {
    let Some(gap) = gap else { return vec![] };
    let runs = of.fitted[0].each().len() + of.held_out[0].each().len();
    let places = (PLACES[0] / runs.max(1)).clamp(PLACES[1], MOST_PLACES);
    let each = |[before, after]: &[Rollouts; 2]| -> Vec<Forecast> {
        let both: Vec<_> = before.each().iter().zip(after.each()).collect();
        both.par_iter().filter_map(|(b, a)| forecast([b, a], gap, places, gates)).collect()
    };
    let held_out = each(&of.held_out).into_iter().map(|f| Forecast { held_out_from: f64::NEG_INFINITY, ..f });
    let mut found = joined(each(&of.fitted), held_out);
    found.sort_by(|a, b| remaining(b).total_cmp(&remaining(a)));
    found
}

/// Runs with the parts of them that were held out behind what was fitted.
fn joined(fitted: Vec<Forecast>, held_out: impl Iterator<Item = Forecast>) -> Vec<Forecast> {
    let mut found = fitted;
    for part in held_out {
        let begins = part.time[0];
        let before = found.iter_mut().find(|f| f.run == part.run && f.time.last().is_some_and(|t| *t <= begins));
        match before {
            Some(run) => {
                run.held_out_from = begins;
                run.scoped.extend(part.scoped);
                run.time.extend(part.time);
                run.pose.extend(part.pose);
                run.paths.extend(part.paths);
                run.error.extend(part.error);
            }
            None => found.push(part),
        }
    }
    found
}

/// The root mean square of what the patched model leaves.
fn remaining(of: &Forecast) -> f64 {
    let known: Vec<f64> = of.error.iter().map(|e| e[1]).filter(|e| e.is_finite()).collect();
    (known.iter().map(|e| e * e).sum::<f64>() / known.len().max(1) as f64).sqrt()
}

/// Forecasts of both models along a run; none of a run that is no longer than they look ahead.
fn forecast(both: [&Rollout; 2], gap: &Gap, places: usize, gates: &Gates) -> Option<Forecast> {
    let (rows, time) = both[0].rows();
    let places = if both[0].fits_speeds() { places.min(FITTED_PLACES) } else { places };
    let every = (time[rows.end - 1] - time[rows.start]) / places as f64;
    let mut next = time[rows.start];
    let mut is_due = |i: &usize| {
        let due = time[*i] >= next;
        if due {
            next = time[*i] + 0.999 * every;
        }
        due
    };
    let at: Vec<usize> = rows.filter(|i| is_due(i)).collect();
    let windows = both[0].windows_from(&at, gap.horizon_s);
    let within: Vec<(usize, usize)> = windows.iter().copied().flatten().collect();
    if within.len() < 2 {
        return None;
    }
    let mut paths = both.map(|rollout| rollout.paths::<POINTS>(&within).into_iter());
    let mut found = Forecast {
        run: both[0].name().into(),
        held_out_from: f64::INFINITY,
        ahead: gap.horizon_s,
        floor: gap.noise_floor.position_rms,
        scoped: gates.spans(both[0], &at),
        ..Forecast::default()
    };
    let place = |y: &Vec<f64>| PLACE.map(|c| y[c]);
    for (i, window) in at.into_iter().zip(windows) {
        let here = both[0].measured(i);
        found.time.push(time[i]);
        found.pose.push([here[PLACE[0]], here[PLACE[1]], here[BODY_HEADING]]);
        let ahead = paths.each_mut().map(|of| window.and_then(|_| of.next()));
        let error = ahead.each_ref().map(|path| {
            let ([.., end], (_, to)) = (path.as_ref()?, window?);
            let ([x, y], [there_x, there_y]) = (place(end), place(&both[0].measured(to)));
            Some((x - there_x).hypot(y - there_y)).filter(|e| e.is_finite())
        });
        found.paths.push(ahead.map(|path| path.iter().flatten().map(place).collect()));
        found.error.push(match error {
            [Some(before), Some(after)] => [before, after],
            _ => [f64::NAN; 2],
        });
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(run: &str, from: f64, error: f64) -> Forecast {
        Forecast {
            run: run.into(),
            held_out_from: f64::INFINITY,
            time: vec![from, from + 1.0],
            pose: vec![[0.0; 3]; 2],
            paths: vec![[vec![], vec![]]; 2],
            error: vec![[1.0, error], [f64::NAN; 2]],
            ..Forecast::default()
        }
    }

    #[test]
    fn a_run_cut_in_two_is_one_run_again() {
        let all = joined(
            vec![part("a", 0.0, 0.1), part("b", 0.0, 0.2)],
            [part("a", 5.0, 0.3), part("c", 9.0, 0.4)].into_iter(),
        );
        let names: Vec<(&str, usize)> = all.iter().map(|f| (f.run.as_str(), f.time.len())).collect();
        assert_eq!(names, [("a", 4), ("b", 2), ("c", 2)]);
        assert_eq!(all[0].held_out_from, 5.0);
        // What has no forecast does not count.
        assert!((remaining(&all[0]) - (0.05f64).sqrt()).abs() < 1e-12);
        // A held-out run that only shares its name stays by itself.
        assert_eq!(joined(vec![part("a", 3.0, 0.1)], [part("a", 0.0, 0.3)].into_iter()).len(), 2);
    }
}
