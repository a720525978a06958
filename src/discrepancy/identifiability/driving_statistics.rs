//! How a run was driven: speeds, turns and standstill by the model.

use super::check_report::RunHealth;
use crate::discrepancy::preprocessing::motion_ratios::{Ratios, STRAIGHT, Step, steps};
use crate::discrepancy::record::run_record::Record;
use crate::error::Result;
use crate::model::Model;

/// Slower than this share of the usual speed, or turning by less than this share of the usual turn, is none.
const LITTLE: f64 = 0.1;

/// What a run says of its driving, beside what its rows say.
pub(crate) fn driving(model: &Model, record: &Record, health: RunHealth, noise: f64) -> Result<RunHealth> {
    let steps = steps(model, record)?;
    if steps.is_empty() {
        return Ok(health);
    }
    let n = steps.len() as f64;
    let share = |f: &dyn Fn(&Step) -> bool| steps.iter().filter(|s| f(s)).count() as f64 / n;
    let typical = |f: &dyn Fn(&Step) -> f64| quantile(steps.iter().map(f).collect(), 0.9).unwrap_or(0.0);
    let usual = typical(&|s| s.way.abs());
    let turning = (LITTLE * typical(&|s| s.turn.abs())).max(STRAIGHT);
    let moves = |s: &Step| s.way.abs() > LITTLE * usual || s.turn.abs() > turning;
    let speeds: Vec<f64> =
        steps.iter().filter(|s| s.way.abs() > LITTLE * usual).map(|s| s.way.abs() / s.seconds).collect();
    let speed = [0.05, 0.5, 0.95].map(|q| quantile(speeds.clone(), q));
    let ratios = Ratios::of(&steps, record, noise);
    Ok(RunHealth {
        speed: match speed {
            [Some(a), Some(b), Some(c)] => Some([a, b, c]),
            _ => None,
        },
        left: share(&|s| s.turn > turning),
        right: share(&|s| s.turn < -turning),
        standing: share(&|s| !moves(s)),
        backwards: share(&|s| s.way < -LITTLE * usual),
        way_ratio: ratios.way,
        turn_ratio: ratios.turn,
        ..health
    })
}

/// A quantile, the nearest value.
pub(crate) fn quantile(mut values: Vec<f64>, q: f64) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(((values.len() as f64 - 1.0).max(0.0) * q).round() as usize).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{equations, logged, unicycle};

    /// Ten seconds straight on, five at rest, ten to the left, five straight back, ten to the right; of the windows of a
    /// second one at each border is neither.
    #[test]
    fn shares_are_those_of_the_time_that_was_driven_so() {
        let part = |t: f64| [10.0, 15.0, 25.0, 30.0].iter().filter(|from| t >= **from).count();
        let wheel = |t: f64| [1.0, 0.0, 3.0, -1.0, 2.0][part(t)];
        let turn = |t: f64| [0.0, 0.0, 0.5, 0.0, -0.3][part(t)];
        let (equations, p) = equations(&[]);
        let time = (0..=640).map(|i| f64::from(i) / 16.0).collect();
        let record = logged((&equations, &p), time, [&wheel, &turn], &[0.0; 3], 0.0);
        let told = driving(&unicycle(&[]), &record, RunHealth { rows: 7, ..RunHealth::default() }, 1e-6).unwrap();
        for (share, expected) in
            [(told.left, 0.25), (told.right, 0.25), (told.standing, 0.125), (told.backwards, 0.125)]
        {
            assert!((share - expected).abs() < 0.035, "{told:?}");
        }
        for (speed, expected) in told.speed.unwrap().into_iter().zip([0.5, 1.0, 1.5]) {
            assert!((speed - expected).abs() < 0.08, "{told:?}");
        }
        assert!((told.way_ratio.unwrap() - 1.0).abs() < 1e-3 && (told.turn_ratio.unwrap() - 1.0).abs() < 1e-3);
        assert_eq!(told.rows, 7);
    }
}
