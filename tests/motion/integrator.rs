//! What an integrator is told and what it says, method by method.

use creepage::effects::{self, Applied};
use creepage::formula::Expr;
use creepage::model::Model;
use creepage::motion::{Drive, Formulas, Integrator, Method, Signals, Stepper, Timing};
use std::cell::Cell;

fn with(method: Method) -> Integrator {
    Integrator { method, max_steps: 100_000, ..Integrator::default() }
}

fn message<T: std::fmt::Debug>(found: creepage::Result<T>) -> String {
    found.unwrap_err().to_string()
}

#[test]
fn tolerances_are_taken_over() {
    let other = with(Method::Dopri5).with_tolerance(1e-5, 1e-7);
    assert_eq!((other.rtol, other.atol, other.method, other.max_steps), (1e-5, 1e-7, Method::Dopri5, 100_000));
}

/// The stiff method has a bound of states, which the others do not have.
#[test]
fn the_stiff_method_takes_so_many_states() {
    let decay = |_: f64, y: &[f64], dy: &mut [f64]| dy.iter_mut().zip(y).for_each(|(d, y)| *d = -y);
    let solve = |method, n: usize| with(method).with_tolerance(1e-6, 1e-6).solve(decay, 0.0, &vec![1.0; n], &[1.0]);
    for (method, n) in [(Method::Radau5, 256), (Method::Dop853, 257), (Method::Dopri5, 257)] {
        let end = solve(method, n).unwrap();
        assert!(end[0].iter().all(|y| (y - (-1f64).exp()).abs() < 1e-5), "{method:?}");
    }
    assert!(message(solve(Method::Radau5, 257)).contains("257 states are more than the 256 of the stiff method"));
}

/// Slopes that are given are used: without them each is found by moving each state.
#[test]
fn slopes_save_evaluations() {
    let count = Cell::new(0);
    let rates = |t: f64, y: &[f64], dy: &mut [f64]| {
        count.set(count.get() + 1);
        (0..6).for_each(|i| dy[i] = -100.0 * (i as f64 + 1.0) * (y[i] - t.cos()));
    };
    let slopes = |_: f64, _: &[f64], j: &mut [f64]| {
        j.fill(0.0);
        (0..6).for_each(|i| j[7 * i] = -100.0 * (i as f64 + 1.0));
    };
    for (from, to) in [(0.0, 3.0), (1.0, 2.0)] {
        let stiff = with(Method::Radau5).with_tolerance(1e-8, 1e-8);
        let told = stiff.solve_with_slopes(rates, slopes, from, &[1.0; 6], &[to]).unwrap();
        let with_slopes = count.replace(0);
        let found = stiff.solve(rates, from, &[1.0; 6], &[to]).unwrap();
        let without = count.replace(0);
        assert!(4 * with_slopes < 3 * without, "{with_slopes} {without}");
        told[0].iter().zip(&found[0]).for_each(|(a, b)| assert!((a - b).abs() < 1e-6));
    }
}

/// Where a solution ends or is undefined is told in the time of the caller, forwards and back, by every method.
#[test]
fn the_time_of_a_failure_is_that_of_the_caller() {
    for method in [Method::Dop853, Method::Dopri5, Method::Radau5] {
        // y = 1/(t₀ + s − t) grows beyond bounds a second after its start, y = −1/… a second before.
        for (start, end, wall) in [(3.0, 6.0, 4.0), (3.0, 0.0, 2.0)] {
            let sign = f64::signum(end - start);
            let blow_up = |_: f64, y: &[f64], dy: &mut [f64]| dy[0] = y[0] * y[0];
            let said = message(with(method).solve(blow_up, start, &[sign], &[end]));
            let near =
                said.split("near t = ").nth(1).and_then(|rest| rest.split(';').next()).and_then(|t| t.parse().ok());
            let near: f64 = near.unwrap_or_else(|| panic!("{method:?}: {said}"));
            assert!((near - wall).abs() < 1e-2, "{method:?}: {said}");
            let undefined = |t: f64, _: &[f64], dy: &mut [f64]| {
                dy[0] = if (t - start).abs() < 1.0 { 1.0 } else { f64::NAN };
            };
            let said = message(with(method).solve(undefined, start, &[0.0], &[end]));
            assert!(said.contains("equations of motion are undefined"), "{method:?}: {said}");
        }
    }
}

#[test]
fn formulas_know_their_knots() {
    let formulas = Formulas::new(&[Expr::parse("abs(t - 1)").unwrap()], &[]).unwrap();
    assert_eq!(formulas.knots(), &[0.0; 0]);
    assert_eq!(formulas.with_knots(&[1.0, 2.5]).knots(), [1.0, 2.5]);
}

/// The inputs that act are those of as much earlier as they are late.
#[test]
fn a_stepper_tells_the_inputs_that_act() {
    let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    let late = model.clone().with_effect(Applied::new(effects::named("input-delay").unwrap(), None, vec![0.25]));
    let time: Vec<f64> = (0..9).map(f64::from).collect();
    let columns = [time.clone(), time.iter().map(|t| 3.0 - 2.0 * t).collect()];
    let signals = Signals::new(&time, &columns, Timing::Sample);
    for (model, delay) in [(&model, 0.0), (&late, 0.25)] {
        let equations = model.equations(&[]).unwrap();
        let mut stepper = Stepper::new(&equations, &signals, &[]);
        for t in [1.0, 2.75, 6.5] {
            let (found, acts) = (stepper.inputs(t).to_vec(), t - delay);
            let wanted = [acts, 3.0 - 2.0 * acts];
            assert!(found.len() == 2 && found.iter().zip(wanted).all(|(f, w)| (f - w).abs() < 1e-12), "{t}: {found:?}");
        }
    }
}
