//! The accelerations of Kane's equations in quasi-velocities beside those of Lagrange's equations with multipliers.

use super::Dynamics;
use crate::error::{Error, Result};
use crate::formula::Symbol;

/// An acceleration by name, in quasi-velocities and by Lagrange's equations.
pub type Pair = (Symbol, f64, f64);

impl Dynamics {
    /// Every rate of a state by both formulations at a state of [`Dynamics::model`], with logged inputs and their slopes, given
    /// by position.
    ///
    /// ```
    /// use creepage::dynamics::{Dynamics, Masses};
    /// use creepage::model::Model;
    /// let disk = Model::new("disk", &[("wheel_radius", 0.5)]).unwrap();
    /// let disk = Dynamics::new(&disk, &Masses { mass: 2.0, ..Masses::default() }).unwrap();
    /// let pairs = disk.driven_by(&["force"]).unwrap().both_formulations(|_| 0.0, |_| 3.0, |_| 0.0).unwrap();
    /// assert!(pairs.iter().all(|(name, a, b)| (name.as_str() != "body.u" || (a - 1.5).abs() < 1e-12) && (a - b).abs() < 1e-12));
    /// ```
    ///
    /// # Errors
    /// When either formulation refuses the vehicle.
    pub fn both_formulations(
        &self,
        state: impl Fn(usize) -> f64,
        logged: impl Fn(usize) -> f64,
        slope: impl Fn(usize) -> f64,
    ) -> Result<Vec<Pair>> {
        let model = self.model()?;
        let (system, equations) = (self.compile()?, model.equations(&[])?);
        let z: Vec<f64> = (0..equations.n()).map(state).collect();
        let logged: Vec<f64> = (0..equations.logged()).map(logged).collect();
        let slopes: Vec<f64> = (0..equations.logged()).map(slope).collect();
        let slope_of = |rate: &Symbol| {
            (0..logged.len()).find(|i| equations.inputs[*i].rate() == *rate).map_or(f64::NAN, |i| slopes[i])
        };
        let input = |i: usize| logged.get(i).copied().unwrap_or_else(|| slope_of(&equations.inputs[i]));
        let u: Vec<f64> = (0..equations.inputs.len()).map(input).collect();
        let mut rates = vec![0.0; equations.n()];
        equations.rates(&mut equations.workspace(&[]), &z, &u, &mut rates);
        let stated = model.values();
        let given = |s: &Symbol| {
            let of = |names: &[Symbol], values: &[f64]| names.iter().position(|n| n == s).map(|i| values[i]);
            of(&equations.states, &z).or_else(|| of(&equations.inputs, &u)).or_else(|| stated.get(s).copied())
        };
        let values = model.definitions()?.evaluate(&given)?;
        // Angles of wheels that roll and the way along a line are no states here, and nothing depends on them.
        let value = |s: &Symbol| values.get(s).copied().or_else(|| given(s)).unwrap_or(0.0);
        let named = |s: &str| value(&s.into());
        let there: Vec<f64> =
            system.states.iter().map(|s| if s.as_str() == "s'" { named("v_l") } else { value(s) }).collect();
        let said = system.rates(&there, &logged, &slopes);
        let of = |s: &str| system.states.iter().position(|n| n.as_str() == s).map(|i| said[i]);
        let ((sin, cos), yaw) = (named("phi").sin_cos(), named("phi'"));
        let along = || Some(of("x'")? * cos + of("y'")? * sin + yaw * named("v_t"));
        let across = || Some(of("y'")? * cos - of("x'")? * sin - yaw * named("v_l"));
        let other = |name: &Symbol| match name.as_str() {
            "body.u" => of("s'").or_else(along),
            "body.w" => across(),
            "body.omega" => of("phi'"),
            other => match other.strip_suffix(".omega") {
                Some(turns) => of(&format!("{}'", turns.replace("trailer_", "phi_"))),
                None => of(other).or_else(|| values.get(&name.rate()).copied()),
            },
        };
        let pair = |(name, rate): (&Symbol, &f64)| {
            let other = other(name).ok_or_else(|| Error::run(format!("Lagrange's equations have no {name}")))?;
            Ok((name.clone(), *rate, other))
        };
        equations.states.iter().zip(&rates).map(pair).collect()
    }
}
