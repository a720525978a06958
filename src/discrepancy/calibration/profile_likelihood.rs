//! Intervals by profile likelihood (Cox, 1970; Venzon and Moolgavkar, 1988): where the curvature at the fitted value says little of
//! how far it may be off, all other values are fitted anew beside a given one.

use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::estimation::priors::Priors;
use crate::discrepancy::estimation::problem::Problem;
use crate::error::Result;
use crate::formula::Symbol;
use nalgebra::DVector;

/// χ² of one value at 95 %.
const LEVEL: f64 = 3.841_458_820_694_124;
/// A given value is held by a prior of this share of the first step.
const HELD: f64 = 1e-4;
/// Steps outwards at most, each as long as all before.
const OUTWARD: usize = 12;
/// Halvings of the step that holds an end.
const HALVINGS: usize = 6;
/// A gain of so much deviance is as good as none.
const SLACK: f64 = 0.05;

/// A value whose interval is asked for: its number among all, its name, where it is, and the ends of its range.
pub(super) struct Value<'a> {
    pub i: usize,
    pub name: &'a Symbol,
    pub at: f64,
    pub range: [f64; 2],
}

/// The values of a parameter at which the deviance has risen by χ² of 95 %; `None` for an end that is not reached within
/// the parameter's range.
pub(super) fn interval(problem: &Problem, fit: &Fit, value: &Value) -> Result<[Option<f64>; 2]> {
    let step = fit.variance(value.i).map_or(0.0, f64::sqrt);
    let step = if step > 0.0 && step.is_finite() { step } else { 0.1 * value.at.abs().max(1e-6) };
    let mut scan = Scan::of(problem, fit, value, step);
    Ok([scan.end(value.at, -step, value.range)?, scan.end(value.at, step, value.range)?])
}

/// The upper end alone, of a value at the lower end of its range, from where a fit without it is.
pub(super) fn upper_end(problem: &Problem, fit: &Fit, value: &Value) -> Result<Option<f64>> {
    Scan::of(problem, fit, value, value.at).end(value.at, value.at, value.range)
}

struct Scan<'a> {
    /// Its priors are those of the scan, `priors` those that it came with.
    problem: Problem,
    priors: &'a Priors,
    fit: &'a Fit,
    name: &'a Symbol,
    i: usize,
    level: f64,
    held: f64,
}

impl<'a> Scan<'a> {
    fn of(problem: &'a Problem, fit: &'a Fit, value: &Value<'a>, step: f64) -> Self {
        let level = LEVEL * fit.inflation_of(value.i);
        Self {
            problem: problem.clone(),
            priors: &problem.priors,
            fit,
            name: value.name,
            i: value.i,
            level,
            held: HELD * step,
        }
    }

    /// Goes outwards in growing steps, and back by halves and by the parabola through what was found.
    fn end(&mut self, at: f64, mut step: f64, range: [f64; 2]) -> Result<Option<f64>> {
        let (mut inside, mut outside) = ((at, 0.0), None);
        for _ in 0..OUTWARD {
            let next = (inside.0 + step).clamp(range[0], range[1]);
            if next == inside.0 {
                return Ok(None);
            }
            match self.rise(next)? {
                Some(rise) if rise < self.level => inside = (next, rise),
                rise => {
                    outside = Some((next, rise));
                    break;
                }
            }
            step *= 2.0;
        }
        let Some(mut outside) = outside else { return Ok(None) };
        for _ in 0..HALVINGS {
            // The square root of the rise is nearly a line.
            let share = match outside.1 {
                Some(rise) => (self.level.sqrt() - f64::sqrt(inside.1)) / (f64::sqrt(rise) - f64::sqrt(inside.1)),
                None => 0.5,
            };
            let next = inside.0 + share.clamp(0.05, 0.95) * (outside.0 - inside.0);
            match self.rise(next)? {
                Some(rise) if (rise - self.level).abs() < SLACK => return Ok(Some(next)),
                Some(rise) if rise < self.level => inside = (next, rise),
                rise => outside = (next, rise),
            }
        }
        Ok(Some(0.5 * (inside.0 + outside.0)))
    }

    /// By how much the deviance is above that of the fit where the value is given; `None` where the motion is undefined.
    fn rise(&mut self, value: f64) -> Result<Option<f64>> {
        // The prior that the value has of its own is a part of what rises.
        let own = self.priors.cost(std::slice::from_ref(self.name), &DVector::from_element(1, value));
        self.problem.priors = self.priors.clone().with(self.name.clone(), [value, self.held]);
        let mut model = self.fit.model.clone();
        let mut at = 0;
        for e in model.effects.iter_mut().filter(|e| e.free) {
            let k = e.values.len();
            if (at..at + k).contains(&self.i) {
                e.values[self.i - at] = value;
            }
            at += k;
        }
        let effort = Effort { variances: false, ..Effort::FULL };
        let found = self.problem.fit(&model, &self.fit.window_states, &self.fit.variances, effort)?;
        Ok(found.map(|f| (f.deviance + own - self.fit.deviance).max(0.0)))
    }
}
