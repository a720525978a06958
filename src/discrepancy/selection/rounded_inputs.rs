//! Whether an input that comes in steps is a rounded signal: its course between the steps, by linear interpolation of its
//! level crossings, explains the data better than any effect does beside the steps.
//!
//! Few levels may be commands as well, which a robot follows as they are; of those the course between steps explains nothing.

use super::choice::Selected;
use crate::discrepancy::estimation::fit::Effort;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::unexplained::remains;
use crate::discrepancy::evidence::information_criterion::delta_bic;
use crate::discrepancy::preprocessing::quantisation::CoarseInput;
use crate::discrepancy::record::run_record::Record;
use crate::error::Result;
use crate::model::Model;

/// A difference of BIC that is very strong evidence (Kass & Raftery, 1995).
const DECISIVE: f64 = 10.0;

/// The inputs that are rounded, where what was chosen leaves a rest and the model as given explains the data better by the
/// smooth course between the steps; none where commands explain as much.
pub(crate) fn rounded_inputs(problem: &Problem, model: &Model, choice: &Selected) -> Result<Vec<CoarseInput>> {
    if !remains(&choice.after) {
        return Ok(vec![]);
    }
    let between = problem.with_rounded_inputs().and_then(|rounded| rounded.with_smoothed_inputs());
    let Some(between) = between else { return Ok(vec![]) };
    let starts = between.starts(model)?;
    let Some(smooth) = between.fit(model, &starts, &between.variances, Effort::FULL)? else { return Ok(vec![]) };
    let n = smooth.sample_size.max(choice.after.sample_size);
    if delta_bic(&smooth, &choice.after, n) <= DECISIVE {
        return Ok(vec![]);
    }
    Ok(problem.records.iter().flat_map(|r| steps(r, model)).collect())
}

/// The inputs of a run that may be rounded.
fn steps<'a>(run: &'a Record, model: &'a Model) -> impl Iterator<Item = CoarseInput> + 'a {
    let each = model.inputs.iter().zip(run.input_noise.suspected());
    each.filter_map(|(role, step)| {
        let unit = model.vehicle.unit_of(role).into();
        Some(CoarseInput { run: run.name.clone(), role: role.clone(), step: (*step)?, unit })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{equations, logged, unicycle};
    use crate::motion::Timing;

    /// The yaw rate in steps of 0.3 rad/s.
    fn in_steps(f: impl Fn(f64) -> f64) -> impl Fn(f64) -> f64 {
        move |t| (f(t) / 0.3).round() * 0.3
    }

    /// What is made of a yaw rate that is driven and another that is logged.
    fn taken_as_rounded(driven: &dyn Fn(f64) -> f64, logged_as: &dyn Fn(f64) -> f64) -> Vec<CoarseInput> {
        let (equations, p) = equations(&[]);
        let time: Vec<f64> = (0..1200).map(|i| 0.05 * f64::from(i)).collect();
        let speed = |t: f64| 2.0 + (0.7 * t).sin();
        let exact = logged((&equations, &p), time.clone(), [&speed, driven], &[0.0; 3], 1e-3);
        let inputs =
            [&speed as &dyn Fn(f64) -> f64, logged_as].map(|f| time.iter().map(|t| f(*t)).collect::<Vec<f64>>());
        let run = Record::new("run.csv", time, exact.columns, true, &inputs, Timing::Sample);
        let problem = Problem::new(vec![run], Some(1e-3), Some(1e-3));
        let model = unicycle(&[]);
        let starts = problem.starts(&model).unwrap();
        let bare = problem.fit(&model, &starts, &problem.variances, Effort::FULL).unwrap().unwrap();
        let choice = Selected {
            before: bare.clone(),
            after: bare,
            chosen: vec![],
            steps: vec![],
            candidates: vec![],
            inconsistent: vec![],
            sampling_sensitive: vec![],
            refused: vec![],
            missed: vec![],
        };
        rounded_inputs(&problem, &model, &choice).unwrap()
    }

    #[test]
    fn a_smooth_signal_is_told_from_commands_by_the_motion() {
        let wave = |t: f64| 0.25 * (0.3 * t).sin() + 0.12 * (0.77 * t).cos();
        let found = taken_as_rounded(&wave, &in_steps(wave));
        let [CoarseInput { run, role, step, unit }] = &found[..] else { panic!("{found:?}") };
        assert_eq!((run.as_str(), role.as_str(), unit.as_str()), ("run.csv", "yaw_rate", "rad/s"));
        assert!((step - 0.3).abs() < 1e-9);
        // The robot does what it is told, and a slope of the ground comes and goes beside it.
        let commands = |t: f64| [0.0, 0.3, 0.0, -0.3][(0.2 * t) as usize % 4];
        assert_eq!(taken_as_rounded(&|t| commands(t) + 0.05 * (0.3 * t).sin(), &commands), vec![]);
        assert_eq!(taken_as_rounded(&commands, &commands), vec![]);
    }
}
