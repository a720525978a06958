//! An angle that was logged as the command of a servo: a straight line of what is wanted.

use super::repair_trial::{Trial, accepts};
use super::repairs::{Change, InputRepair, Repair, Unit};
use super::signed_ratios::{Motion, SignedRatios};
use crate::model::Model;
use crate::numerics::levenberg_marquardt::{Damping, LeastSquares, minimise};
use nalgebra::{DMatrix, DVector, dvector};

/// Scales that the search begins with; each with the offset that makes the mean angle zero.
const SCALES: [f64; 8] = [-2.0, -1.0, -0.5, -0.1, 0.1, 0.5, 1.0, 2.0];
/// Steps of Gauss and Newton that are evaluated; one more is taken.
const MOST_STEPS: usize = 7;
/// Change that shows what a scale or an offset does.
const TRIED: f64 = 1e-4;
/// Scales and offsets, rad, that a gain and an offset of the steering explain.
const USUAL: ([f64; 2], f64) = ([0.6, 1.6], 0.2);

/// The line of one angle that brings the turning to the measured one.
pub(crate) fn repair(trial: &Trial, model: &Model, before: &SignedRatios) -> Option<Repair> {
    let is_angle = |role: &&String| model.vehicle.inputs.get(*role).is_some_and(|input| input.unit == "rad");
    let role = trial.run.roles.iter().find(is_angle)?;
    let column = &trial.run.inputs[trial.run.roles.iter().position(|r| r == role)?];
    let mean = column.iter().sum::<f64>() / column.len() as f64;
    let repair = |[scale, offset]: [f64; 2]| trial.repair(role, role, Change::Line([scale, offset]));
    let starts = SCALES.map(|scale| [scale, -scale * mean]);
    let misfits = starts.map(|line| (misfit(trial, &turns(trial, repair(line))), line));
    let (_, line) = misfits.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
    let fit = LineFit { trial, repair: &repair };
    let found = minimise(&fit, fit.at(line)?, &Damping::NONE, MOST_STEPS);
    let line = plus(found.here.line, &found.step?);
    let ([low, high], offset) = USUAL;
    let is_usual = |scale: f64| (low..high).contains(&scale) && line[1].abs() < offset;
    let found = vec![repair(line)];
    if is_usual(line[0]) || !accepts(before, &trial.with(&found), false) {
        return None;
    }
    // Beside the wrong sign a gain and an offset of the steering are effects, as ever.
    let is_reversed = is_usual(-line[0]);
    Some(Repair::Inputs(if is_reversed {
        vec![trial.repair(role, role, Change::Scale(-1.0, Unit::Sign))]
    } else {
        found
    }))
}

fn turns(trial: &Trial, repair: InputRepair) -> Vec<Motion> {
    let inputs = super::repairs::inputs(trial.run, trial.file.input_timing, &[repair]);
    trial.reckoned(&inputs)
}

/// The mean square that the reckoned turns miss of the measured ones.
fn misfit(trial: &Trial, reckoned: &[Motion]) -> f64 {
    let squares: Vec<f64> = Motion::turned(reckoned, &trial.measured).map(|[r, m]| (m - r) * (m - r)).collect();
    if squares.is_empty() { f64::INFINITY } else { squares.iter().sum::<f64>() / squares.len() as f64 }
}

/// The line that turns as much as was measured.
struct LineFit<'a> {
    trial: &'a Trial<'a>,
    repair: &'a dyn Fn([f64; 2]) -> InputRepair,
}

/// A line, and the normal equations of the turns that it misses.
struct Line {
    line: [f64; 2],
    normal: DMatrix<f64>,
    gradient: DVector<f64>,
}

fn plus(line: [f64; 2], step: &DVector<f64>) -> [f64; 2] {
    [line[0] + step[0], line[1] + step[1]]
}

impl LineFit<'_> {
    /// The slopes at a line, by differences; `None` where scale or offset do nothing.
    fn at(&self, line: [f64; 2]) -> Option<Line> {
        let Self { trial, repair } = self;
        let here = turns(trial, repair(line));
        let beside = [0, 1].map(|k| {
            let mut other = line;
            other[k] += TRIED;
            turns(trial, repair(other))
        });
        // The windows in which all of them turn.
        let windows = here.iter().zip(&beside[0]).zip(&beside[1]).zip(&trial.measured);
        let turns = windows.filter_map(|(((h, a), b), m)| Some([h.turn?, a.turn?, b.turn?, m.turn?]));
        let (mut normal, mut gradient) = (DMatrix::zeros(2, 2), DVector::zeros(2));
        for [here, scaled, shifted, measured] in turns {
            let row = dvector![(scaled - here) / TRIED, (shifted - here) / TRIED];
            normal += &row * row.transpose();
            gradient -= (measured - here) * row;
        }
        let is_told = normal.diagonal().iter().all(|d| *d > 0.0);
        is_told.then_some(Line { line, normal, gradient })
    }
}

impl LeastSquares for LineFit<'_> {
    type Point = Line;

    fn normal(&self, here: &Line) -> (DMatrix<f64>, DVector<f64>) {
        (here.normal.clone(), here.gradient.clone())
    }

    fn next(&self, here: &Line, step: &DVector<f64>, _: f64) -> Option<Line> {
        self.at(plus(here.line, step))
    }
}
