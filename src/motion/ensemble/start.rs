//! Where the cases of a block begin.

use super::equations::LaneEquations;
use super::steps::Lane;
use super::{Ensemble, LANES, Varied};
use crate::error::Result;
use crate::formula::{Isa, Memory, Symbol};
use crate::model::{Equations, Model};
use crate::motion::{initial_hidden, visible_state};

/// What finding a start needs beside the lanes: the equations one case at a time.
pub(crate) struct Start {
    equations: Equations,
    /// Which of the varied quantities are parameters of the equations.
    free: Vec<usize>,
}

impl Start {
    pub fn new(model: &Model, varied: &[Varied]) -> Result<Self> {
        let of_model = |v: &Varied| matches!(v, Varied::Model(_));
        let free: Vec<usize> = (0..varied.len()).filter(|i| of_model(&varied[*i])).collect();
        let symbols: Vec<Symbol> = varied
            .iter()
            .filter_map(|v| match v {
                Varied::Model(s) => Some(s.clone()),
                _ => None,
            })
            .collect();
        Ok(Self { equations: model.equations(&symbols)?, free })
    }
}

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
