//! How a run was driven: speeds and turns by the model, beside what was measured.

use super::outcome::RunHealth;
use crate::discrepancy::angle::wrapped;
use crate::discrepancy::course::measured_at;
use crate::discrepancy::gap::Predictor;
use crate::discrepancy::record::Record;
use crate::error::Result;
use crate::model::Model;

/// Windows over which speeds and turns are told, s.
const WINDOW: f64 = 1.0;
/// Slower than this share of the usual speed, or turning by less than this share of the usual turn, is none.
const LITTLE: f64 = 0.1;
/// Turns within a window that are no turns, rad.
const STRAIGHT: f64 = 0.01;

/// A window by the model and by the measurements: forward way, m, and turn, rad.
struct Step {
    way: f64,
    turn: f64,
    measured_way: f64,
    measured_turn: f64,
    seconds: f64,
}

/// What a run says of its driving, beside what its rows say.
pub(super) fn driving(model: &Model, record: &Record, health: RunHealth, noise: f64) -> Result<RunHealth> {
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
    let far = |s: &&Step| s.way.abs().max(s.measured_way.abs()) > 20.0 * noise;
    let sum = |f: &dyn Fn(&Step) -> f64| steps.iter().filter(far).map(f).sum::<f64>();
    let ways = [sum(&|s| s.measured_way.abs()), sum(&|s| s.way.abs())];
    let squares = steps.iter().map(|s| s.turn * s.turn).sum::<f64>();
    let turned = squares > n * STRAIGHT * STRAIGHT;
    Ok(RunHealth {
        speed: match speed {
            [Some(a), Some(b), Some(c)] => Some([a, b, c]),
            _ => None,
        },
        left: share(&|s| s.turn > turning),
        right: share(&|s| s.turn < -turning),
        standing: share(&|s| !moves(s)),
        backwards: share(&|s| s.way < -LITTLE * usual),
        way_ratio: (ways[1] > 0.0).then(|| ways[0] / ways[1]).filter(|r| r.is_finite()),
        turn_ratio: (turned && record.has_heading)
            .then(|| steps.iter().map(|s| s.turn * s.measured_turn).sum::<f64>() / squares),
        ..health
    })
}

fn steps(model: &Model, record: &Record) -> Result<Vec<Step>> {
    let equations = model.equations(&[])?;
    let predictor = Predictor::new(model, record)?;
    let step = |(from, to): (usize, usize)| {
        let y = predictor.outputs(from, to);
        let last = y.last()?;
        let (a, b) = (measured_at(&equations, record, from), measured_at(&equations, record, to));
        let way = |p: &[f64], q: &[f64], heading: f64| (q[0] - p[0]) * heading.cos() + (q[1] - p[1]) * heading.sin();
        let chord = |p: &[f64], q: &[f64]| {
            let length = (q[0] - p[0]).hypot(q[1] - p[1]);
            let middle = p[2] + 0.5 * wrapped(q[2] - p[2]);
            length.copysign(way(p, q, middle))
        };
        let step = Step {
            way: chord(&y[0], last),
            turn: last[2] - y[0][2],
            measured_way: chord(&a, &b),
            measured_turn: b[2] - a[2],
            seconds: record.time[to] - record.time[from],
        };
        [step.way, step.turn, step.measured_way].iter().all(|x| x.is_finite()).then_some(step)
    };
    Ok(predictor.windows(WINDOW).into_iter().filter_map(step).collect())
}

/// A quantile, the nearest value.
pub(super) fn quantile(mut values: Vec<f64>, q: f64) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(((values.len() as f64 - 1.0).max(0.0) * q).round() as usize).copied()
}
