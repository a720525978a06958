//! States that no sensor sees: carried along from the start of a log, as far as they hang on it by what the poses show.

use super::hidden_state_fit::PropagatedState;
use super::slow_manifold::{self, FastDynamics, following};
use crate::discrepancy::record::run_record::Record;
use crate::model::Equations;
use crate::motion::{StateSensitivity, Stepper};
use nalgebra::DMatrix;

/// How long before the first window hidden states are carried from rest, s.
const LEAD: f64 = 3.0;

/// Hidden states and all sensitivities at a row, carried there from rest through what the log says before it; as far as
/// they still hang on how they began, by what the rows after it show.
pub fn before(equations: &Equations, p: &[f64], record: &Record, row: usize, visible: &[f64]) -> StateSensitivity {
    asked(equations, p, record, row, visible).0
}

/// As [`before`], and how many numbers the rows after it were asked for.
pub(crate) fn asked(
    equations: &Equations,
    p: &[f64],
    record: &Record,
    row: usize,
    visible: &[f64],
) -> (StateSensitivity, f64) {
    if equations.n() == equations.visible {
        return (StateSensitivity::default(), 0.0);
    }
    if equations.has_speeds() {
        return (following(equations, p, record, row, visible), 0.0);
    }
    let way = LeadIn::to(equations, p, record, row, visible);
    let rest = way.at_rest();
    let arc = way.along(rest.clone());
    let elsewhere = StateSensitivity { z: rest.z.iter().map(|z| z + 1.0).collect(), s: vec![] };
    let memory = way.along(elsewhere).z.iter().zip(&arc.z).map(|(a, b)| (a - b).abs()).collect();
    PropagatedState { arc, pose: visible, memory }.settled(equations, p, record, row)
}

/// As [`before`], without a look at the rows after it.
pub fn carried(equations: &Equations, p: &[f64], record: &Record, row: usize, visible: &[f64]) -> StateSensitivity {
    if equations.n() == equations.visible {
        return StateSensitivity::default();
    }
    if equations.has_speeds() {
        return following(equations, p, record, row, visible);
    }
    let way = LeadIn::to(equations, p, record, row, visible);
    way.along(way.at_rest())
}

/// Hidden states at the first row of a log, by what the rows after it show.
pub fn at_start(equations: &Equations, record: &Record, pose: &[f64]) -> Vec<f64> {
    if equations.has_speeds() {
        return following(equations, &[], record, 0, pose).z;
    }
    let way = LeadIn::to(equations, &[], record, 0, pose);
    let memory = vec![1.0; equations.n() - equations.visible];
    PropagatedState { arc: way.at_rest(), pose, memory }.settled(equations, &[], record, 0).0.z
}

/// The rows that hidden states are carried through to one.
struct LeadIn<'a> {
    equations: &'a Equations,
    p: &'a [f64],
    record: &'a Record,
    visible: &'a [f64],
    first: usize,
    row: usize,
}

impl<'a> LeadIn<'a> {
    fn to(equations: &'a Equations, p: &'a [f64], record: &'a Record, row: usize, visible: &'a [f64]) -> Self {
        let time = &record.time;
        let gap = record.gap();
        let joined = |i: &usize| time[i + 1] - time[*i] <= gap && time[row] - time[*i] <= LEAD;
        let first = (0..row).rev().take_while(joined).last().unwrap_or(row);
        Self { equations, p, record, visible, first, row }
    }

    fn stepper(&self) -> Stepper<'a> {
        Stepper::new(self.equations, &self.record.signals, self.p)
    }

    fn at_rest(&self) -> StateSensitivity {
        at_rest(self.equations, self.p, &mut self.stepper(), self.record.time[self.first], self.visible)
    }

    fn along(&self, mut hidden: StateSensitivity) -> StateSensitivity {
        let (mut stepper, time) = (self.stepper(), &self.record.time);
        for i in self.first..self.row {
            // The pose a hidden state sees is the measured one; only the hidden states are carried.
            let z = [self.visible, &hidden.z].concat();
            let mut arc = match hidden.s.is_empty() {
                true => StateSensitivity { z, s: vec![] },
                false => stepper.start(&z, Some(&hidden.s)),
            };
            stepper.advance(&mut arc, time[i], time[i + 1]);
            hidden = StateSensitivity { z: arc.z[self.equations.visible..].to_vec(), s: arc.s };
        }
        hidden
    }
}

/// Hidden states and all sensitivities at a time, the hidden ones in their equilibrium under the inputs there.
///
/// A state that forgets is soon where its inputs drive it; its equilibrium is the best guess of where it is at
/// the start of a log, and depends on p: ∂h/∂p = −(∂h′/∂h)⁻¹·∂h′/∂p. Where there is no equilibrium, it is zero.
pub fn at_rest(equations: &Equations, p: &[f64], stepper: &mut Stepper, t: f64, visible: &[f64]) -> StateSensitivity {
    let (n, m) = (equations.n(), equations.visible);
    if n == m {
        return StateSensitivity { z: vec![], s: vec![0.0; n * stepper.columns()] };
    }
    let u = stepper.inputs(t).to_vec();
    let rest = FastDynamics::in_equilibrium(equations, p, visible, &u);
    let none = |columns: usize| DMatrix::zeros(n - m, columns);
    let by_p = rest.by_parameters().unwrap_or_else(|| none(p.len()));
    slow_manifold::arc(rest.h, &none(m), &by_p)
}
