//! The initial state of a trajectory: hidden states in equilibrium, visible ones from a measurement, by Newton's
//! method.

use crate::error::{Error, Result};
use crate::model::Equations;
use nalgebra::{DMatrix, DVector};

/// The most steps of Newton's method, and what counts as arrived.
const MAX_NEWTON_STEPS: usize = 50;
const NEWTON_TOLERANCE: f64 = 1e-13;

/// The hidden states at which their own rates vanish under constant inputs: the quasi-static values.
///
/// | symbol | meaning |
/// |---|---|
/// | u0 | inputs, in the order of [`Equations::inputs`] |
/// | pose | visible states: x, y, phi, trailer headings |
///
/// Newton's method on the hidden rates with their exact Jacobian, from zero, else from 1 and −1, since a law
/// with |v| has no derivative at standstill, else from 1 or −1 for each state, to the side to which it moves from zero. Of states that are not isolated the one that these steps come to first,
/// as within the play of an input; zero for all of them where there is none or they come to none, as for a vehicle at
/// standstill whose creep builds up over a distance. Source: the quasi-static values of the effects, −mass_over_bT·v_l·φ̇ and
/// others.
///
/// ```
/// use creepage::effects::{self, Applied};
/// use creepage::model::Model;
/// use creepage::motion::initial_hidden;
/// let slide = Applied::new(effects::named("cornering-creep").unwrap(), None, vec![0.2]);
/// let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_effect(slide);
/// let hidden = initial_hidden(&model.equations(&[]).unwrap(), &[], &[4.0, 1.0], &[0.0; 3]);
/// assert!((hidden[0] + 0.4).abs() < 1e-12); // −0.2 s · 2 m/s · 1 rad/s
/// ```
pub fn initial_hidden(equations: &Equations, p: &[f64], u0: &[f64], pose: &[f64]) -> Vec<f64> {
    let (n, visible) = (equations.n(), equations.visible);
    let mut w = equations.workspace(p);
    let mut hidden_rates = |z: &[f64]| {
        let all = equations.rates_and_jacobian(&mut w, z, u0);
        let width = (all.len() - n) / n;
        let by_hidden = |i: usize, k: usize| all[n + i * width + k];
        let hidden = n - visible;
        let jacobian = DMatrix::from_fn(hidden, hidden, |i, k| by_hidden(visible + i, visible + k));
        (DVector::from_column_slice(&all[visible..n]), jacobian)
    };
    let hidden = n - visible;
    let from_zero: Vec<f64> =
        hidden_rates(&[pose, &vec![0.0; hidden]].concat()).0.iter().map(|rate| side(*rate)).collect();
    let starts = [vec![0.0; hidden], vec![1.0; hidden], vec![-1.0; hidden], from_zero];
    let mut found = starts.into_iter().filter_map(|start| {
        let mut z = [pose, &start].concat();
        newton(&mut z, visible, &mut hidden_rates).then(|| z.split_off(visible))
    });
    found.next().unwrap_or_else(|| vec![0.0; hidden])
}

/// The visible states of which the sensor would measure these values.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | measured | m, rad | x, y, heading and trailer headings as the sensor sees them |
///
/// Undoes lever arm, heading offset and whatever else the outputs of [`Equations`] hold, by Newton's method
/// with their exact Jacobian.
///
/// # Errors
/// When no visible state gives these values, or a value is not finite.
///
/// ```
/// use creepage::model::Model;
/// use creepage::motion::visible_state;
/// let mut model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
/// model.sensor.lever_arm = [0.3, 0.0];
/// let half_turn = std::f64::consts::PI;
/// let z = visible_state(&model.equations(&[]).unwrap(), &[], &[1.0, 0.0, half_turn]).unwrap();
/// assert!((z[0] - 1.3).abs() < 1e-12); // the antenna looks back
/// ```
pub fn visible_state(equations: &Equations, p: &[f64], measured: &[f64]) -> Result<Vec<f64>> {
    let n = equations.visible;
    if measured.len() != n {
        return Err(Error::input(format!("{} measured values are given, the model has {n}", measured.len())));
    }
    let mut w = equations.workspace(p);
    let mut z = measured.to_vec();
    let found = newton(&mut z, 0, |z| {
        let all = equations.outputs(&mut w, z);
        let width = (all.len() - n) / n;
        let error = DVector::from_fn(n, |i, _| all[i] - measured[i]);
        (error, DMatrix::from_fn(n, n, |i, k| all[n + i * width + k]))
    });
    if found { Ok(z) } else { Err(Error::run("no pose of the vehicle gives the measured initial pose")) }
}

/// Newton's method on the components of z from `first` on; whether it arrived.
/// One, to the side to which a state moves; zero for one that stands, or has no rate.
fn side(rate: f64) -> f64 {
    if rate > 0.0 {
        1.0
    } else if rate < 0.0 {
        -1.0
    } else {
        0.0
    }
}

fn newton(z: &mut [f64], first: usize, mut f: impl FnMut(&[f64]) -> (DVector<f64>, DMatrix<f64>)) -> bool {
    if first == z.len() {
        return true;
    }
    for _ in 0..MAX_NEWTON_STEPS {
        let (value, jacobian) = f(z);
        // Where equilibria are not isolated, as within the play of an input, the one that was come to first stands.
        let Some(step) = jacobian.lu().solve(&value) else { return value.amax() <= NEWTON_TOLERANCE };
        if !step.iter().all(|v| v.is_finite()) {
            return false;
        }
        z[first..].iter_mut().zip(&step).for_each(|(z, s)| *z -= s);
        if z[first..].iter().zip(&step).all(|(z, s)| s.abs() <= NEWTON_TOLERANCE * (1.0 + z.abs())) {
            return true;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Applied, named};
    use crate::model::Model;
    use crate::model::forces::{Dynamics, Masses};

    /// Wheels that are driven to different sides each rest on the flank to which they are driven.
    #[test]
    fn every_gear_begins_at_a_flank_of_its_own() {
        let robot = Model::new("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.5)]).unwrap();
        let wheels = [("theta_1'".into(), 0.05), ("theta_2'".into(), 0.05)].into();
        let masses = Masses { mass: 20.0, inertia: 1.0, wheels, ..Masses::default() };
        let robot = Dynamics::new(&robot, &masses).unwrap();
        let robot = robot.driven_by(&["wheel_torque_left", "wheel_torque_right"]).unwrap().model().unwrap();
        let play = Applied::new(named("gear-backlash").unwrap(), None, vec![0.05]);
        let equations = robot.with_effect(play).equations(&[]).unwrap();
        let nodes = vec![0.1; equations.visible];
        for [left, right] in [[0.4, 0.6], [0.4, -0.6], [-0.4, 0.6], [-0.4, -0.6]] {
            // The right wheel is the first.
            let flanks = [right, left].map(f64::signum);
            assert_eq!(initial_hidden(&equations, &[], &[left, right], &nodes), flanks);
        }
    }

    /// Everything within the play of an input is at rest: what follows it begins at the edge that it comes to from zero.
    #[test]
    fn what_follows_with_play_begins_at_its_edge() {
        let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.0)]).unwrap();
        let play = named("input-backlash").unwrap().on_input("steering_angle", "rad", 0.6);
        let car = car.with_effect(Applied::new(&play, None, vec![0.03]));
        let equations = car.equations(&[]).unwrap();
        let at = equations.inputs.iter().position(|i| i.as_str() == "steering_angle").unwrap();
        for (steering, begins) in [(0.1, 0.07), (0.088_494_735_81, 0.058_494_735_81), (-0.2, -0.17), (0.02, 0.0)] {
            let mut inputs = vec![0.0; equations.inputs.len()];
            inputs[at] = steering;
            let hidden = initial_hidden(&equations, &[], &inputs, &[0.0; 3]);
            assert!((hidden[0] - begins).abs() < 1e-12, "{steering}: {hidden:?}");
        }
    }
}
