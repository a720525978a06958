//! A stepper for one trajectory at a time: the lane stepper with a single lane.

use super::lane_stepper::LaneStepper;
use super::states::StateSensitivity;
use crate::model::Equations;
use crate::motion::Signals;

/// Advances a state and its sensitivities S = ∂z/∂(visible start, p) along [`Signals`] in fixed steps of order four that
/// adapt to the motion.
///
/// S′ = J_z·S + [0 | J_p − J_u·u̇·∂delay/∂p]
///
/// | symbol | meaning |
/// |---|---|
/// | J_z, J_u, J_p | derivatives of the rates z′ = f(z, u, p) of [`Equations`] by states, inputs and free parameters |
/// | u̇ | slopes of the inputs, s⁻¹; a delay that is free moves the time at which they are looked up |
pub struct Stepper<'a> {
    equations: &'a Equations,
    lanes: LaneStepper<'a, 1>,
}

impl<'a> Stepper<'a> {
    /// Equations at parameters p along signals.
    pub fn new(equations: &'a Equations, signals: &'a Signals, p: &[f64]) -> Self {
        Self { equations, lanes: LaneStepper::new(equations, signals, [p]) }
    }

    /// Columns of the sensitivities.
    pub fn columns(&self) -> usize {
        self.lanes.columns()
    }

    /// The inputs that act at a time.
    pub fn inputs(&mut self, t: f64) -> &[f64] {
        self.lanes.inputs(&[t]).as_flattened()
    }

    /// An arc that starts at a state; the sensitivities of hidden states are carried over, those with respect to p, and of
    /// states that follow speeds to these, too.
    pub fn start(&self, z: &[f64], hidden_s: Option<&[f64]>) -> StateSensitivity {
        let (n, k, visible) = (self.equations.n(), self.columns(), self.equations.visible);
        let mut s = vec![0.0; n * k];
        (0..visible).for_each(|i| s[i * k + i] = 1.0);
        if let Some(old) = hidden_s {
            let first = self.equations.first_of_hidden();
            for i in visible..n {
                s[i * k + first..(i + 1) * k].copy_from_slice(&old[i * k + first..(i + 1) * k]);
            }
        }
        StateSensitivity { z: z.to_vec(), s }
    }

    /// Advances an arc from one time to another.
    pub fn advance(&mut self, arc: &mut StateSensitivity, from: f64, to: f64) {
        self.lanes.advance(arc.z.as_chunks_mut().0, arc.s.as_chunks_mut().0, &[from], &[to]);
    }

    /// What is measured beside the pose at a state and a time, one after another, each with its derivatives by the columns of
    /// the sensitivities.
    pub fn quantities(&mut self, arc: &StateSensitivity, t: f64) -> Vec<(f64, Vec<f64>)> {
        let (z, s, k) = (arc.z.as_chunks().0, arc.s.as_chunks().0, self.columns());
        self.lanes.evaluate_quantities(z, &[t]);
        let one = |i: usize| {
            let mut slopes = vec![[0.0]; k];
            let [value] = self.lanes.quantity(i, z.len(), s, &mut slopes);
            (value, slopes.into_flattened())
        };
        (0..self.equations.quantity_count).map(|i| one(i)).collect()
    }

    /// What the sensor measures at a state, and the rows of its derivatives with respect to (visible z, p).
    pub fn outputs(&mut self, z: &[f64]) -> &[f64] {
        self.lanes.outputs_here(z.as_chunks().0).as_flattened()
    }
}
