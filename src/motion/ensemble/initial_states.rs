//! Where the cases of a block begin: the sensor inverted, hidden states at rest.

use super::equations::{LaneEquations, Varied};
use super::lanes::{LANES, Lane};
use super::model_ensemble::Ensemble;
use crate::error::Result;
use crate::formula::{Isa, Memory};
use crate::motion::{initial_hidden, visible_state};

/// A step times a rate at which an explicit method of order four or eight is stable.
const STABLE: f64 = 2.5;
/// Contacts that are stiffer than so many steps are simulated one by one.
const MOST_STABLE: f64 = 1e6;

impl Ensemble {
    /// The states at the first time, lane by lane; lanes beyond the cases repeat the last one.
    pub(crate) fn start(
        &self,
        e: &LaneEquations,
        readings: &mut Memory<LANES>,
        cases: &[&[f64]],
        isa: Isa,
    ) -> Result<Vec<Lane>> {
        let mut z = vec![[0.0; LANES]; e.n];
        for l in 0..LANES {
            let case = cases[l.min(cases.len() - 1)];
            (0..e.visible).for_each(|i| z[i][l] = self.measured(case, i));
        }
        let Some(start) = &self.start else { return Ok(z) };
        let u = self.first_inputs(e, readings, &z, isa);
        for (l, case) in cases.iter().enumerate() {
            let p: Vec<f64> = start.free.iter().map(|i| case[*i]).collect();
            let measured: Vec<f64> = (0..self.initial.len()).map(|i| self.measured(case, i)).collect();
            let mut found = visible_state(&start.equations, &p, &measured)?;
            let inputs: Vec<f64> = u.iter().map(|lane| lane[l]).collect();
            found.extend(initial_hidden(&start.equations, &p, &inputs, &found));
            found.into_iter().enumerate().for_each(|(i, value)| z[i][l] = value);
        }
        Ok(z)
    }

    /// As many steps as an explicit method needs for its stability under forces, by the largest sum of a row of the Jacobian
    /// where the first case begins; one of a vehicle that inputs move.
    pub(crate) fn stable_steps(
        &self,
        e: &LaneEquations,
        readings: &mut Memory<LANES>,
        z: &[Lane],
        cases: &[&[f64]],
    ) -> f64 {
        let Some(start) = self.start.as_ref().filter(|_| self.model.forced.is_some()) else { return 1.0 };
        let first = |lanes: &[Lane]| lanes.iter().map(|lane| lane[0]).collect::<Vec<f64>>();
        let p: Vec<f64> = start.free.iter().map(|i| cases[0][*i]).collect();
        let u = first(&self.first_inputs(e, readings, z, self.isa));
        let mut workspace = start.equations.workspace(&p);
        let f = start.equations.rates_and_jacobian(&mut workspace, &first(z), &u);
        let width = e.n + u.len() + p.len();
        let rows = f[e.n..].chunks(width).map(|row| row[..e.n].iter().map(|v| v.abs()).sum::<f64>());
        let fastest = rows.filter(|sum| sum.is_finite()).fold(0.0, f64::max);
        ((self.times[self.times.len() - 1] - self.from) * fastest / STABLE).clamp(1.0, MOST_STABLE)
    }

    /// A component of the measured pose a case begins with.
    fn measured(&self, case: &[f64], i: usize) -> f64 {
        let own = self.varied.iter().position(|v| *v == Varied::Initial(i));
        own.map_or(self.initial[i], |k| case[k])
    }

    fn first_inputs(&self, e: &LaneEquations, memory: &mut Memory<LANES>, z: &[Lane], isa: Isa) -> Vec<Lane> {
        e.read(self.from, z, memory, isa);
        let first = e.visible + 3;
        (first..e.readings.outputs()).map(|k| *e.readings.output(memory, k)).collect()
    }
}
