//! Where the cases of a block begin: the sensor inverted, hidden states at rest.

use super::equations::{LaneEquations, Varied};
use super::lanes::{LANES, Lane};
use super::model_ensemble::Ensemble;
use crate::error::Result;
use crate::formula::{Isa, Memory};
use crate::motion::{initial_hidden, visible_state};

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
            let measured: Vec<f64> = z[..e.visible].iter().map(|lane| lane[l]).collect();
            let mut found = visible_state(&start.equations, &p, &measured)?;
            let inputs: Vec<f64> = u.iter().map(|lane| lane[l]).collect();
            found.extend(initial_hidden(&start.equations, &p, &inputs, &found));
            found.into_iter().enumerate().for_each(|(i, value)| z[i][l] = value);
        }
        Ok(z)
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
