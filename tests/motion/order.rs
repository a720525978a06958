//! The measured order of every integrator on right-hand sides that depend on time, and what it does with bad ones.

use creepage::Result;
use creepage::energy_rule::{Reading, fig7_case};
use creepage::motion::{Drive, Integrator, Method};
use std::f64::consts::TAU;

/// y′ = cos(t)·y, y(0) = 1: y = exp(sin t).
fn swing(t: f64, y: &[f64], dy: &mut [f64]) {
    dy[0] = t.cos() * y[0];
}

/// The largest error at some times on y′ = cos(t)·y, and how often the right-hand side was evaluated.
fn run_swing(integrator: &Integrator, times: &[f64]) -> (f64, usize) {
    let mut evaluations = 0;
    let rhs = |t: f64, y: &[f64], dy: &mut [f64]| {
        evaluations += 1;
        swing(t, y, dy);
    };
    let rows = integrator.solve(rhs, 0.0, &[1.0], times).unwrap();
    let errors = rows.iter().zip(times).map(|(y, t)| (y[0] - t.sin().exp()).abs());
    (errors.fold(0.0, f64::max), evaluations)
}

/// The error at the end of Fig. 7's wheel under reading A, whose rates depend on time, and evaluations.
fn run_wheel(integrator: &Integrator) -> (f64, usize) {
    let rates = Reading::A.rates(-0.1, -0.2).unwrap();
    let mut evaluations = 0;
    let rhs = |t: f64, y: &[f64], dy: &mut [f64]| {
        evaluations += 1;
        let (mut rate, mut slope) = ([0.0; 2], [0.0; 2]);
        rates.at(t, &mut rate, &mut slope);
        let (forward, left) = (0.5 * 1.1 * rate[1], -0.2 * 0.5 * 1.1 * rate[1]);
        dy[0] = forward * y[2].cos() - left * y[2].sin();
        dy[1] = forward * y[2].sin() + left * y[2].cos();
        dy[2] = rate[0];
    };
    let end = integrator.solve(rhs, 0.0, &[0.0; 3], &[TAU]).unwrap().remove(0);
    let exact = fig7_case(-0.1, -0.2, Reading::A).unwrap();
    ((end[0] - exact.x).hypot(end[1] - exact.y), evaluations)
}

fn with(method: Method, tolerance: f64) -> Integrator {
    Integrator { method, rtol: tolerance, atol: tolerance, ..Integrator::default() }
}

fn order(coarse: f64, fine: f64) -> f64 {
    (coarse / fine).log2()
}

#[test]
fn rk4_has_order_four() {
    let rk4 = |step| Integrator { method: Method::Rk4 { step }, ..Integrator::default() };
    let swing = order(run_swing(&rk4(0.02), &[4.0]).0, run_swing(&rk4(0.01), &[4.0]).0);
    let wheel = order(run_wheel(&rk4(TAU / 100.0)).0, run_wheel(&rk4(TAU / 200.0)).0);
    println!("Rk4: order {swing:.3} on y' = cos(t) y, {wheel:.3} on the wheel");
    assert!((swing - 4.0).abs() < 0.1 && (wheel - 4.0).abs() < 0.1, "{swing} {wheel}");
}

/// Tolerances so loose that every step is accepted leave one step between two times: the order of the formula.
#[test]
fn the_adaptive_formulas_have_their_order_at_equal_steps() {
    let grid = |n: usize| -> Vec<f64> { (1..=n).map(|i| 4.0 * i as f64 / n as f64).collect() };
    for (method, expected, n, stages) in [(Method::Dopri5, 5.0, 40, 7), (Method::Dop853, 8.0, 10, 13)] {
        let loose = with(method, 1e6);
        let ((coarse, _), (fine, evaluations)) = (run_swing(&loose, &grid(n)), run_swing(&loose, &grid(2 * n)));
        let measured = order(coarse, fine);
        println!("{method:?}: order {measured:.3}, {evaluations} evaluations for {} spans", 2 * n);
        assert!((measured - expected).abs() < 0.4, "{method:?}: order {measured}, errors {coarse:e} {fine:e}");
        assert!(evaluations < 2 * n * (stages + 1) + 200, "{method:?}: {evaluations} evaluations");
    }
}

/// The error follows the tolerance, and evaluations grow as tolerance^(-1/order) and not faster: an order that
/// fell to one would need thousands of times as many.
#[test]
fn the_error_follows_the_tolerance_and_the_work_its_root() {
    type Run<'a> = &'a dyn Fn(&Integrator) -> (f64, usize);
    let problems: [(&str, Run); 2] = [("y' = cos(t) y", &|i| run_swing(i, &[TAU])), ("wheel", &run_wheel)];
    for (method, order, most) in [(Method::Dopri5, 5.0, 1500), (Method::Dop853, 8.0, 600)] {
        for (problem, run) in problems {
            let tolerances = [1e-4, 1e-6, 1e-8, 1e-10];
            let results = tolerances.map(|tolerance| run(&with(method, tolerance)));
            println!("{method:?}, {problem}: {results:?}");
            for ((error, _), tolerance) in results.iter().zip(tolerances) {
                assert!(*error < 10.0 * tolerance, "{method:?} {problem}: error {error:e} at {tolerance:e}");
            }
            let growth = (results[3].1 as f64 / results[0].1 as f64).log10() / 6.0;
            assert!(growth < 1.3 / order, "{method:?} {problem}: work grows as tolerance^-{growth:.3}");
            assert!(results[3].1 < most, "{method:?} {problem}: {} evaluations", results[3].1);
        }
    }
}

#[test]
fn backward_and_across_zero_it_retraces_its_steps() {
    let times = [-1.0f64, 2.0, 2.0, -3.0, -4.0, 0.0];
    for method in [Method::Dopri5, Method::Dop853, Method::Radau5, Method::Rk4 { step: 0.003 }] {
        let rows = with(method, 1e-11).solve(swing, -3.0, &[(-3f64).sin().exp()], &times).unwrap();
        for (y, t) in rows.iter().zip(times) {
            assert!((y[0] - t.sin().exp()).abs() < 1e-9, "{method:?} at {t}: {}", y[0]);
        }
        assert_eq!(rows[1], rows[2], "a span of no length changes nothing");
    }
}

/// y₀′ = cos(t)·y₀ beside y₁, which follows y₀² within a microsecond; the errors of both, and how many steps were tried.
fn run_stiff(integrator: &Integrator, exact: bool) -> ([f64; 2], usize) {
    let mut steps = 0;
    let rhs = |t: f64, y: &[f64], dy: &mut [f64]| {
        dy[0] = t.cos() * y[0];
        dy[1] = -1e6 * (y[1] - y[0] * y[0]);
    };
    let slopes = |t: f64, y: &[f64], j: &mut [f64]| {
        steps += 1;
        j.copy_from_slice(&[t.cos(), 0.0, 2e6 * y[0], -1e6]);
    };
    let start = [1.0, 1.0 - 2e-6];
    let end = match exact {
        true => integrator.solve_with_slopes(rhs, slopes, 0.0, &start, &[4.0]),
        false => integrator.solve(rhs, 0.0, &start, &[4.0]),
    };
    let (end, y) = (end.unwrap().remove(0), 4f64.sin().exp());
    // On the slow manifold y₁ = y₀² − 2·cos(t)·y₀²/1e6 + …
    ([(end[0] - y).abs(), (end[1] - y * y * (1.0 - 2e-6 * 4f64.cos())).abs()], steps)
}

/// Order 5 on a right side that depends on time, at equal steps: between two times the tolerance needs no more than one.
#[test]
fn radau_has_order_five_at_equal_steps() {
    let run = |n: usize| {
        let times: Vec<f64> = (1..=n).map(|i| 4.0 * i as f64 / n as f64).collect();
        let mut steps = 0;
        let slopes = |t: f64, _: &[f64], j: &mut [f64]| {
            steps += 1;
            j[0] = t.cos();
        };
        let rows = with(Method::Radau5, 1e-8).solve_with_slopes(swing, slopes, 0.0, &[1.0], &times).unwrap();
        let errors = rows.iter().zip(&times).map(|(y, t)| (y[0] - t.sin().exp()).abs());
        (errors.fold(0.0, f64::max), steps)
    };
    let ((coarse, few), (fine, many)) = (run(80), run(160));
    println!("Radau5: errors {coarse:e} in {few} steps, {fine:e} in {many}");
    // One more look at the slopes chooses the first step.
    assert!(few < 90 && many < 170, "{few} and {many} steps");
    assert!((order(coarse, fine) - 5.0).abs() < 0.5, "order {}", order(coarse, fine));
}

/// Its work does not follow the time constant, and its error follows the tolerance; an explicit method needs millions of
/// steps.
#[test]
fn radau_steps_over_short_time_constants() {
    for exact in [true, false] {
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            let bounded = Integrator { max_steps: 1000, ..with(Method::Radau5, tolerance) };
            let (errors, _) = run_stiff(&bounded, exact);
            println!("Radau5, slopes exact {exact}, {tolerance:e}: {errors:?}");
            assert!(errors[0] < 10.0 * tolerance && errors[1] < 20.0 * tolerance + 1e-9, "{errors:?} at {tolerance:e}");
        }
    }
    let explicit = Integrator { max_steps: 10_000, ..with(Method::Dop853, 1e-6) };
    fails(explicit.solve(|t, y, dy| dy[0] = -1e6 * (y[0] - t.cos()), 0.0, &[1.0], &[TAU]), "steps were not enough");
}

#[test]
fn rk4_ends_where_it_is_asked_to() {
    // Lengths that the step does not divide, or divides up to rounding: y′ = 1.
    for (length, step) in
        [(1.0, 0.3), (0.3, 0.1), (0.7, 0.1), (1.0, 0.1), (0.05, 0.1), (2.1, 0.3), (1.1, 1.1 / 15.0), (1e6, 1e3)]
    {
        let rk4 = Integrator { method: Method::Rk4 { step }, ..Integrator::default() };
        let mut count = 0;
        let rhs = |_: f64, _: &[f64], dy: &mut [f64]| {
            count += 1;
            dy[0] = 1.0;
        };
        let end = rk4.solve(rhs, 0.0, &[0.0], &[length]).unwrap();
        assert!((end[0][0] - length).abs() < 1e-12 * (1.0 + length), "{length} in steps of {step}: {}", end[0][0]);
        let steps = (length / step - 1e-9).ceil() as usize;
        assert_eq!(count, 4 * steps + 1, "{length} in steps of {step}");
    }
}

fn fails(result: Result<Vec<Vec<f64>>>, why: &str) {
    let e = result.unwrap_err();
    assert!(e.message().contains(why), "{e}");
}

#[test]
fn what_cannot_be_integrated_is_an_error() {
    for method in [Method::Dopri5, Method::Dop853, Method::Radau5, Method::Rk4 { step: 0.01 }] {
        let i = with(method, 1e-9);
        let nan = |t: f64, _: &[f64], dy: &mut [f64]| dy[0] = if t < 1.0 { 1.0 } else { f64::NAN };
        fails(i.solve(nan, 0.0, &[0.0], &[2.0]), "undefined");
        fails(i.solve(nan, 2.0, &[0.0], &[3.0]), "undefined at t = 2");
        // y′ = y² has no solution beyond t = 1.
        let explosion = i.solve(|_, y, dy| dy[0] = y[0] * y[0], 0.0, &[1.0], &[3.0]).unwrap_err();
        assert_eq!(explosion.exit_code(), 1, "{explosion}");
        let short = Integrator { max_steps: 5, ..i };
        fails(short.solve(swing, 0.0, &[1.0], &[100.0]), "5 steps were not enough");
        fails(i.solve(swing, 0.0, &[f64::NAN], &[1.0]), "finite");
        fails(i.solve(swing, 0.0, &[1.0], &[f64::INFINITY]), "finite");
    }
    for bad in [0.0, -1.0, f64::NAN] {
        fails(with(Method::Dop853, bad).solve(swing, 0.0, &[1.0], &[1.0]), "positive");
        let rk4 = Integrator { method: Method::Rk4 { step: bad }, ..Integrator::default() };
        fails(rk4.solve(swing, 0.0, &[1.0], &[1.0]), "positive");
    }
}

/// Where an integration ended is said in the time of who asked, forward and back.
#[test]
fn the_place_of_a_failure_is_a_time() {
    for method in [Method::Dopri5, Method::Dop853, Method::Radau5, Method::Rk4 { step: 0.01 }] {
        let short = Integrator { max_steps: 5, ..with(method, 1e-9) };
        for (from, to) in [(-1.0, 100.0), (1.0, -100.0), (3.0, 100.0)] {
            let e = short.solve(swing, from, &[1.0], &[to]).unwrap_err();
            let place = e.message().rsplit("t = ").next().and_then(|t| t.parse::<f64>().ok());
            let way = place.map(|t| (t - from) / (to - from));
            assert!(way.is_some_and(|s| (0.0..0.5).contains(&s)), "{method:?} from {from}: {e}");
        }
    }
}

/// The bound on steps is for the whole call and not for each span.
#[test]
fn steps_of_all_spans_are_counted() {
    let times: Vec<f64> = (1..100).map(f64::from).collect();
    for method in [Method::Dopri5, Method::Dop853, Method::Radau5, Method::Rk4 { step: 0.5 }] {
        let i = Integrator { max_steps: 50, ..with(method, 1e-6) };
        fails(i.solve(swing, 0.0, &[1.0], &times), "50 steps were not enough");
    }
    // As many as are allowed are enough.
    let all = |max_steps| Integrator { method: Method::Rk4 { step: 0.25 }, max_steps, ..Integrator::default() };
    assert!(all(4).solve(swing, 0.0, &[1.0], &[1.0]).is_ok());
    fails(all(3).solve(swing, 0.0, &[1.0], &[1.0]), "3 steps were not enough");
}

/// A trial step may leave the domain where a shorter one does not: y′ = −2√y from 1 is (1 − t)².
#[test]
fn a_trial_step_may_leave_the_domain() {
    for method in [Method::Dopri5, Method::Dop853, Method::Radau5] {
        let rows = with(method, 1e-9).solve(|_, y, dy| dy[0] = -2.0 * y[0].sqrt(), 0.0, &[1.0], &[0.99]).unwrap();
        assert!((rows[0][0] - 1e-4).abs() < 1e-8, "{method:?}: {}", rows[0][0]);
    }
}

/// y′ = cos(t)·y for the crate itself.
struct Swing;

impl ode_solvers::System<f64, ode_solvers::SVector<f64, 1>> for Swing {
    fn system(&self, t: f64, y: &ode_solvers::SVector<f64, 1>, dy: &mut ode_solvers::SVector<f64, 1>) {
        swing(t, y.as_slice(), dy.as_mut_slice());
    }
}

/// Why the integrator of order 8 is not the crate's: with c₁₂ = 0 in its table, where 1 belongs, the last stage sees the time of
/// the first, and the error falls with the first power of the step. When this test fails the crate has mended it.
#[test]
fn the_dop853_of_the_crate_has_order_one_where_the_rate_reads_the_time() {
    let error = |h: f64| {
        let start = ode_solvers::SVector::<f64, 1>::new(1.0);
        // One step after another: tolerances so loose that none is refused, and none longer than h.
        let (loose, sparse) = (1e6, ode_solvers::OutputType::Sparse);
        let mut s = ode_solvers::Dop853::from_param(
            Swing,
            0.0,
            2.0,
            h,
            start,
            loose,
            loose,
            0.9,
            0.0,
            0.333,
            6.0,
            h,
            h,
            100_000,
            u32::MAX,
            sparse,
        );
        s.integrate().unwrap();
        (s.y_out().last().unwrap()[0] - 2f64.sin().exp()).abs()
    };
    let (coarse, fine) = (error(0.02), error(0.01));
    println!("the crate's Dop853: {coarse:.2e} at steps of 0.02, {fine:.2e} at 0.01, order {:.2}", order(coarse, fine));
    assert!(order(coarse, fine) < 1.5 && fine > 1e-6, "{coarse} {fine}");
    // Ours, at steps as long.
    let ours = with(Method::Dop853, 1e6);
    let times: Vec<f64> = (1..=100).map(|i| 0.02 * f64::from(i)).collect();
    assert!(run_swing(&ours, &times).0 < 1e-13);
}
