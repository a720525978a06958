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
        (0..self.equations.quantity_count).map(one).collect()
    }

    /// What the sensor measures at a state, and the rows of its derivatives with respect to (visible z, p).
    pub fn outputs(&mut self, z: &[f64]) -> &[f64] {
        self.lanes.outputs_here(z.as_chunks().0).as_flattened()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{self, Applied};
    use crate::formula::Expr;
    use crate::model::Model;
    use crate::model::measured::MeasuredQuantity;
    use crate::motion::Timing;

    fn quantity(formula: &str) -> MeasuredQuantity {
        let formula = Expr::parse(formula).unwrap();
        MeasuredQuantity { name: format!("{formula}"), formula, unit: String::new(), noise: None }
    }

    /// Quantities of hidden states, inputs, their rates and a delay have the derivatives that differences have.
    #[test]
    fn quantities_have_the_derivatives_of_what_they_say() {
        let mut model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        model.measured = ["v_t' + v_l*phi'", "v_l'", "theta'*v_t + x"].map(quantity).to_vec();
        for (id, value) in [("cornering-creep", 0.3), ("input-delay", 0.07), ("wheel-radius", 0.02)] {
            model = model.with_effect(Applied::new(effects::named(id).unwrap(), None, vec![value]).freed());
        }
        let equations = model.free_equations().unwrap();
        let time: Vec<f64> = (0..=30).map(|i| 0.1 * f64::from(i)).collect();
        let column = |w: f64| time.iter().map(|t| 2.0 + (w * t).sin()).collect::<Vec<f64>>();
        let signals = Signals::new(&time, &[column(1.0), column(1.7)], Timing::Sample);
        // Within a piece of the inputs: at a knot their rates jump.
        let (begin, end) = (0.33, 1.345);
        let after = |z: &[f64], p: &[f64]| {
            let mut stepper = Stepper::new(&equations, &signals, p);
            let mut arc = stepper.start(z, None);
            stepper.advance(&mut arc, begin, end);
            stepper.quantities(&arc, end)
        };
        let (z, p) = (vec![0.1, 0.2, 0.3, 0.05], model.free_values());
        let exact = after(&z, &p);
        assert_eq!((exact.len(), exact[0].1.len()), (3, equations.visible + p.len()));
        for c in 0..equations.visible + p.len() {
            let moved = |by: f64| {
                let (mut z, mut p) = (z.clone(), p.clone());
                *(if c < equations.visible { &mut z[c] } else { &mut p[c - equations.visible] }) += by;
                after(&z, &p)
            };
            for (k, (more, less)) in moved(1e-5).iter().zip(&moved(-1e-5)).enumerate() {
                let (said, slope) = ((more.0 - less.0) / 2e-5, exact[k].1[c]);
                assert!((slope - said).abs() < 1e-5 * (1.0 + said.abs()), "{k} by {c}: {slope}, not {said}");
            }
        }
    }
}
