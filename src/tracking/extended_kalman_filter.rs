//! The extended Kalman filter (Jazwinski 1970, chapter 8) of a model whose coefficients of creep are states that walk at random.

use super::commands::Commands;
use crate::error::Result;
use crate::model::Equations;
use crate::motion::{Integrator, with_sensitivities};
use crate::planning::nearest;
use nalgebra::{DMatrix, DVector};

/// States and coefficients with their covariance.
#[derive(Clone, Debug)]
pub struct ExtendedKalmanFilter<'a> {
    /// The model; its free parameters are estimated.
    pub equations: &'a Equations,
    /// States of the model.
    pub states: Vec<f64>,
    /// Values of the free parameters.
    pub parameters: Vec<f64>,
    /// Of states and parameters.
    pub covariance: DMatrix<f64>,
    /// What states and parameters walk, as a variance a second.
    pub walk: Vec<f64>,
    /// What the parameters may be.
    pub ranges: Vec<[f64; 2]>,
    /// The variance of each measured value.
    pub noise: Vec<f64>,
    /// How states and their sensitivities are integrated.
    pub integrator: Integrator,
}

impl ExtendedKalmanFilter<'_> {
    /// Ahead from a time to another under commands.
    ///
    /// # Errors
    /// When the motion is undefined on the way.
    pub fn predict(&mut self, commands: &Commands, from: f64, to: f64) -> Result<()> {
        let (n, p) = (self.states.len(), self.parameters.len());
        let mut rows = with_sensitivities(
            self.equations,
            &self.parameters,
            commands,
            &self.states,
            &[from, to],
            &self.integrator,
        )?;
        let Some((states, slopes)) = rows.pop() else { return Ok(()) };
        self.states = states;
        let mut transition = DMatrix::identity(n + p, n + p);
        transition.view_mut((0, 0), (n, n + p)).copy_from(&slopes);
        let walked = DVector::from_column_slice(&self.walk) * (to - from);
        self.covariance = &transition * &self.covariance * transition.transpose() + DMatrix::from_diagonal(&walked);
        Ok(())
    }

    /// Takes in what the sensor measures: x, y, then angles, which are compared without whole turns.
    pub fn update(&mut self, measured: &[f64]) {
        let (n, p, visible) = (self.states.len(), self.parameters.len(), self.equations.visible);
        let mut w = self.equations.workspace(&self.parameters);
        let found = self.equations.outputs(&mut w, &self.states).to_vec();
        let m = measured.len();
        let width = visible + p;
        // Hidden states are not seen.
        let slopes = DMatrix::from_fn(m, n + p, |i, k| match k {
            k if k < visible => found[m + i * width + k],
            k if k < n => 0.0,
            k => found[m + i * width + visible + k - n],
        });
        let surprise = DVector::from_fn(m, |i, _| {
            let off = measured[i] - found[i];
            if i < 2 { off } else { nearest(off, 0.0) }
        });
        let noise = DMatrix::from_diagonal(&DVector::from_column_slice(&self.noise));
        let expected = &slopes * &self.covariance * slopes.transpose() + &noise;
        let Some(inverse) = expected.try_inverse() else { return };
        let gain = &self.covariance * slopes.transpose() * inverse;
        let step = &gain * surprise;
        self.states.iter_mut().zip(step.iter()).for_each(|(z, d)| *z += d);
        for (i, value) in self.parameters.iter_mut().enumerate() {
            *value = (*value + step[n + i]).clamp(self.ranges[i][0], self.ranges[i][1]);
        }
        // Joseph's form stays positive.
        let left = DMatrix::identity(n + p, n + p) - &gain * &slopes;
        self.covariance = &left * &self.covariance * left.transpose() + &gain * noise * gain.transpose();
    }

    /// The deviation of a parameter.
    pub fn deviation(&self, parameter: usize) -> f64 {
        let k = self.states.len() + parameter;
        self.covariance[(k, k)].max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Applied, named};
    use crate::model::Model;

    fn filter(equations: &Equations) -> ExtendedKalmanFilter<'_> {
        ExtendedKalmanFilter {
            equations,
            states: vec![0.0, 0.0, 3.0],
            parameters: vec![0.0],
            covariance: DMatrix::from_diagonal(&DVector::from_vec(vec![1e-4, 1e-4, 1e-4, 0.04])),
            walk: vec![0.0; 4],
            ranges: vec![[-1.0, 1.0]],
            noise: vec![1e-4; 3],
            integrator: Integrator::default(),
        }
    }

    fn wheel() -> Equations {
        let creep = Applied::new(named("rotation-creep").unwrap(), None, vec![0.0]);
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_effect(creep);
        model.equations(&["rotation_creep.e_rc".into()]).unwrap()
    }

    /// Straight on at 1 m/s for a second: x tells of e as −1 m for each unit, so that the posterior is that of one line of
    /// regression.
    #[test]
    fn a_coefficient_is_found_as_a_regression_finds_it() {
        let equations = wheel();
        let mut filter = filter(&equations);
        filter.states[2] = 0.0;
        let commands = Commands::from(0.0, vec![2.0, 0.0]);
        filter.predict(&commands, 0.0, 1.0).unwrap();
        assert!((filter.states[0] - 1.0).abs() < 1e-9 && (filter.deviation(0) - 0.2).abs() < 1e-12);
        // 5 cm short.
        filter.update(&[0.95, 0.0, 0.0]);
        let (prior, noise) = (0.04, 2e-4);
        let posterior = 1.0 / (1.0 / prior + 1.0 / noise);
        assert!((filter.parameters[0] - 0.05 * posterior / noise).abs() < 1e-9, "{:?}", filter.parameters);
        assert!((filter.deviation(0) - f64::sqrt(posterior)).abs() < 1e-9);
    }

    #[test]
    fn whole_turns_are_no_surprise_and_values_stay_in_range() {
        let equations = wheel();
        let mut filter = filter(&equations);
        filter.update(&[0.0, 0.0, 3.0 - std::f64::consts::TAU]);
        assert!((filter.states[2] - 3.0).abs() < 1e-12, "{:?}", filter.states);
        filter.ranges = vec![[-0.01, 0.01]];
        filter.predict(&Commands::from(0.0, vec![2.0, 0.0]), 0.0, 1.0).unwrap();
        filter.update(&[2.0, 0.0, 3.0]);
        assert_eq!(filter.parameters[0].abs(), 0.01);
    }
}
