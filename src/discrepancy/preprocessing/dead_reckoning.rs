//! Dead reckoning: the path that the inputs alone drive, from the origin on.

use crate::files::{InputTiming, Run};
use crate::model::{Equations, Model};
use crate::motion::initial_hidden;

/// What turns inputs into a path; none for a vehicle with states that no sensor sees, and for a single row. Effects that add
/// such states are left out: what they add dies away.
pub(crate) struct DeadReckoning<'a> {
    equations: Equations,
    timing: InputTiming,
    run: &'a Run,
}

impl<'a> DeadReckoning<'a> {
    /// Of a model along a run.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn of(model: &Model, timing: InputTiming, run: &'a Run) -> crate::error::Result<Option<Self>> {
        let mut equations = model.equations(&[])?;
        if equations.n() != equations.visible {
            let mut ideal = model.clone();
            ideal.effects.retain(|applied| applied.effect.states.is_empty());
            equations = ideal.equations(&[])?;
        }
        let is_whole = equations.n() == equations.visible && equations.visible >= 3;
        Ok((is_whole && run.input_time().len() > 1).then_some(Self { equations, timing, run }))
    }

    /// x, y and heading as the sensor would measure them at the times of the poses, if these were the inputs.
    pub fn path(&self, inputs: &[Vec<f64>]) -> [Vec<f64>; 3] {
        let time = self.run.input_time();
        let body = body_rates(&self.equations, inputs, time.len());
        let mut at = vec![[0.0; 3]; time.len()];
        for i in 1..time.len() {
            let step = time[i] - time[i - 1];
            let rate = |k: usize| match self.timing {
                InputTiming::Sample => 0.5 * (body[i - 1][k] + body[i][k]),
                InputTiming::IntervalMean => body[i][k],
            };
            let [x, y, heading] = at[i - 1];
            let (sin, cos) = (heading + 0.5 * step * rate(2)).sin_cos();
            let [ahead, left] = [step * rate(0), step * rate(1)];
            at[i] = [x + ahead * cos - left * sin, y + ahead * sin + left * cos, heading + step * rate(2)];
        }
        self.measured(time, &at)
    }

    /// What the sensor measures at the times of the poses.
    fn measured(&self, time: &[f64], at: &[[f64; 3]]) -> [Vec<f64>; 3] {
        let (mut memory, mut z) = (self.equations.workspace(&[]), vec![0.0; self.equations.n()]);
        let mut found = [const { Vec::new() }; 3];
        for t in &self.run.time {
            let next = time.partition_point(|s| s < t).clamp(1, time.len() - 1);
            let share = ((t - time[next - 1]) / (time[next] - time[next - 1])).clamp(0.0, 1.0);
            let value = |k: usize| at[next - 1][k] + share * (at[next][k] - at[next - 1][k]);
            z.iter_mut().enumerate().for_each(|(k, z)| *z = value(k.min(2)));
            let outputs = self.equations.outputs(&mut memory, &z);
            found.iter_mut().zip(outputs).for_each(|(column, y)| column.push(*y));
        }
        found
    }
}

/// Rates of a body that points along x, row by row, its hidden states at rest; an undefined motion is none.
pub(crate) fn body_rates(equations: &Equations, inputs: &[Vec<f64>], rows: usize) -> Vec<[f64; 3]> {
    let (mut memory, visible) = (equations.workspace(&[]), vec![0.0; equations.visible]);
    let (mut u, mut rates) = (vec![0.0; inputs.len()], vec![0.0; equations.n()]);
    let one = |i: usize| {
        u.iter_mut().zip(inputs).for_each(|(u, column)| *u = column[i]);
        let hidden = initial_hidden(equations, &[], &u, &visible);
        equations.rates(&mut memory, &[visible.as_slice(), &hidden].concat(), &u, &mut rates);
        [0, 1, 2].map(|k| if rates[k].is_finite() { rates[k] } else { 0.0 })
    };
    (0..rows).map(one).collect()
}
