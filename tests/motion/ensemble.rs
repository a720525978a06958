//! Many cases at once against one at a time, by an integrator that shares nothing with it but the formulas.

use creepage::effects::{self, Applied};
use creepage::formula::{Expr, Isa, Symbol};
use creepage::model::{Model, Trailer};
use creepage::motion::{Ensemble, EnsembleInputs, Formulas, Integrator, Signals, Timing, Varied, simulate_model};

const EXACT: f64 = 2e-10;

fn with(model: Model, id: &str, trailer: Option<usize>, values: &[f64]) -> Model {
    model.with_effect(Applied::new(effects::named(id).unwrap(), trailer, values.to_vec()))
}

fn formulas(texts: &[&str]) -> Vec<Expr> {
    texts.iter().map(|t| Expr::parse(t).unwrap()).collect()
}

/// A model, its inputs as formulas of t, and a start.
struct Subject {
    name: &'static str,
    model: Model,
    inputs: Vec<&'static str>,
    start: Vec<f64>,
}

fn subjects() -> Vec<Subject> {
    let wheel = || Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    let car = || Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.0)]).unwrap();
    let trailers = [Trailer { length: 2.0, hitch: 0.3 }, Trailer { length: 1.5, hitch: 0.0 }];
    let mut antenna = with(wheel(), "lever-arm", None, &[0.1, -0.2]);
    antenna.sensor.lever_arm = [0.3, 0.1];
    let wheel_inputs = || vec!["2 + sin(t)", "cos(t/2)"];
    let car_inputs = || vec!["0.3*sin(t)", "3 + cos(t)"];
    let plain = |name, model, inputs, n| Subject { name, model, inputs, start: vec![0.1; n] };
    vec![
        plain("wheel", wheel(), wheel_inputs(), 3),
        plain("antenna", antenna, wheel_inputs(), 3),
        plain("slide", with(wheel(), "cornering-creep", None, &[0.2]), wheel_inputs(), 3),
        plain("late", with(wheel(), "input-delay", None, &[0.25]), wheel_inputs(), 3),
        plain("car", with(car(), "understeer", None, &[0.01]), car_inputs(), 3),
        plain(
            "train",
            with(car().with_trailers(&trailers), "trailer-traverse-creep", Some(2), &[0.05]),
            car_inputs(),
            5,
        ),
    ]
}

/// The inputs of a subject: formulas of t alone, and the same for one case at a time.
fn inputs(s: &Subject) -> (EnsembleInputs, Formulas) {
    let formulas = formulas(&s.inputs);
    let alone = Formulas::new(&formulas, &[]).unwrap();
    (EnsembleInputs { formulas, ..EnsembleInputs::default() }, alone)
}

fn exact() -> Integrator {
    Integrator::default().with_tolerance(1e-13, 1e-14)
}

fn worst(found: &[f64], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    found.iter().zip(expected).map(|(a, b)| (a - b).abs() / b.abs().max(1.0)).fold(0.0, f64::max)
}

#[test]
fn every_kind_of_model_moves_as_it_does_alone() {
    let times = [0.0, 0.4, 1.7, 3.0];
    for s in subjects() {
        let (inputs, alone) = inputs(&s);
        let varied = [Varied::Model("wheel_radius".into()), Varied::Initial(2)];
        let e = Ensemble::new(&s.model, &inputs, &varied, &s.start, 0.0, &times, 1e-10).unwrap();
        let cases: Vec<[f64; 2]> = (0..40).map(|i| [0.2 + 0.01 * f64::from(i), 0.1 * f64::from(i)]).collect();
        let given: Vec<&[f64]> = cases.iter().map(|c| c.as_slice()).collect();
        let plan = e.plan(|i| cases[i].to_vec(), cases.len()).unwrap();
        let found = e.run(&plan, &given).unwrap();
        for (values, case) in cases.iter().zip(&found).step_by(13) {
            let mut model = s.model.clone();
            model.parameters.insert("wheel_radius".into(), values[0]);
            let mut start = s.start.clone();
            start[2] = values[1];
            let table = simulate_model(&model, &alone, &times, &start, &exact()).unwrap();
            assert_eq!(e.columns(), table.names, "{}", s.name);
            assert!(case.converged && case.error.unwrap() <= 1e-10, "{}: {:?}", s.name, case.error);
            for (i, time) in times.iter().enumerate() {
                let expected: Vec<f64> = table.columns[1..].iter().map(|c| c[i]).collect();
                let error = worst(case.row(i), &expected);
                assert!(error < EXACT, "{} at {time}: {error:e}", s.name);
            }
        }
    }
}

#[test]
fn a_plan_is_made_on_cases_from_the_first_on_spread_evenly() {
    let s = subjects().swap_remove(0);
    let e = Ensemble::new(&s.model, &inputs(&s).0, &[Varied::Initial(2)], &s.start, 0.0, &[0.0, 1.0], 1e-8).unwrap();
    for total in [1, 3, 1000] {
        let asked = std::sync::Mutex::new(vec![]);
        let case = |i: usize| {
            asked.lock().unwrap().push(i);
            vec![0.1]
        };
        e.plan(case, total).unwrap();
        let asked = asked.into_inner().unwrap();
        let n = asked.len();
        assert!(n == total.min(32), "{n} of {total}");
        assert_eq!(asked, (0..n).map(|k| k * total / n).collect::<Vec<_>>());
    }
}

#[test]
fn logged_inputs_and_their_delays_are_followed() {
    let time: Vec<f64> = (0..40).map(|i| 0.1 * f64::from(i)).collect();
    let column = |f: &dyn Fn(f64) -> f64| time.iter().map(|t| f(*t)).collect::<Vec<f64>>();
    let log = Signals::new(&time, &[column(&|t| 2.0 + t.sin()), column(&f64::cos)], Timing::Sample);
    let wheel = with(Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap(), "input-delay", None, &[0.05]);
    let names = || ["wheel_rate", "yaw_rate"].map(String::from).to_vec();
    let inputs = EnsembleInputs {
        formulas: formulas(&["log.wheel_rate*gain", "log.yaw_rate"]),
        log: Some((names(), log.clone())),
        ..EnsembleInputs::default()
    };
    let times = [0.0, 1.234, 3.9];
    let gain = || Varied::Input("gain".into());
    for varied in [vec![gain()], vec![gain(), Varied::Model("input_delay.delay".into())]] {
        let e = Ensemble::new(&wheel, &inputs, &varied, &[0.0; 3], 0.0, &times[1..], 1e-10).unwrap();
        let cases: Vec<Vec<f64>> =
            (0..3).map(|i| vec![1.0, 0.05 + 0.03 * f64::from(i)][..varied.len()].to_vec()).collect();
        let given: Vec<&[f64]> = cases.iter().map(Vec::as_slice).collect();
        let found = e.run(&e.plan(|i| cases[i].clone(), 3).unwrap(), &given).unwrap();
        for (case, found) in cases.iter().zip(&found) {
            let delay = case.get(1).copied().unwrap_or(0.05);
            let alone = with(wheel.clone(), "input-delay", None, &[delay]);
            let table = simulate_model(&alone, &log, &times, &[0.0; 3], &exact()).unwrap();
            let expected: Vec<f64> = table.columns[1..].iter().map(|c| c[2]).collect();
            let error = worst(found.row(1), &expected);
            assert!(found.converged && error < EXACT, "{error:e}");
        }
    }
}

fn wheels() -> (Ensemble, Vec<Vec<f64>>) {
    let (s, _) = (subjects().remove(0), ());
    let varied = [Varied::Model("wheel_radius".into()), Varied::Initial(0)];
    let e = Ensemble::new(&s.model, &inputs(&s).0, &varied, &s.start, 0.0, &[3.0], 1e-10).unwrap();
    (e, (0..100).map(|i| vec![0.1 + 0.01 * f64::from(i), f64::from(i)]).collect())
}

#[test]
fn a_case_is_the_same_bits_whatever_is_beside_it_and_whatever_the_processor() {
    let (e, cases) = wheels();
    let plan = e.plan(|i| cases[i].clone(), cases.len()).unwrap();
    let given: Vec<&[f64]> = cases.iter().map(Vec::as_slice).collect();
    let all = e.run(&plan, &given).unwrap();
    let reversed: Vec<&[f64]> = given.iter().rev().copied().collect();
    let mut back = e.run(&plan, &reversed).unwrap();
    back.reverse();
    assert_eq!(all, back);
    let alone: Vec<_> = given.iter().map(|c| e.run(&plan, &[c]).unwrap().remove(0)).collect();
    assert_eq!(all, alone);
    for isa in Isa::available() {
        let (e, _) = wheels();
        assert_eq!(all, e.with_instructions(isa).run(&plan, &given).unwrap(), "{}", isa.name());
    }
}

#[test]
fn the_estimate_is_not_below_the_error() {
    let s = subjects().remove(4);
    let (inputs, alone) = inputs(&s);
    let expected = simulate_model(&s.model, &alone, &[0.0, 3.0], &s.start, &exact()).unwrap();
    let expected: Vec<f64> = expected.columns[1..4].iter().map(|c| c[1]).collect();
    for tolerance in [1e-3, 1e-5, 1e-7, 1e-9] {
        let e = Ensemble::new(&s.model, &inputs, &[], &s.start, 0.0, &[3.0], tolerance).unwrap();
        let case = e.run(&e.plan(|_| vec![], 1).unwrap(), &[&[]]).unwrap().remove(0);
        let (error, estimate) = (worst(&case.row(0)[..3], &expected), case.error.unwrap());
        assert!(error <= estimate.max(1e-13) && estimate <= tolerance, "{tolerance:e}: {error:e}, {estimate:e}");
    }
}

#[test]
fn what_is_undefined_or_rough_is_said_to_be() {
    let wheel = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    let inputs = |speed: &str| EnsembleInputs { formulas: formulas(&[speed, "1"]), ..EnsembleInputs::default() };
    let varied = [Varied::Input(Symbol::from("c"))];
    let run = |speed: &str, knots: &[f64]| {
        let inputs = EnsembleInputs { knots: knots.to_vec(), ..inputs(speed) };
        let e = Ensemble::new(&wheel, &inputs, &varied, &[0.0; 3], 0.0, &[3.0], 1e-10).unwrap();
        e.run(&e.plan(|_| vec![4.0], 2).unwrap(), &[&[4.0], &[1.0]]).unwrap()
    };
    // √(c − t) ends at t = 1 for the second case, and only for it.
    let found = run("sqrt(c - t)", &[]);
    assert!(found[0].converged && found[1].values.is_empty() && !found[1].is_defined() && !found[1].converged);
    // A jump is no smooth motion, unless it is given as a knot.
    let jump = run("2 + sign(t - 1.1)*c/c", &[]);
    assert!(jump.iter().all(|c| !c.converged && c.error.is_some()));
    assert!(run("2 + sign(t - 1.1)*c/c", &[1.1]).iter().all(|c| c.converged));
}

/// The worst row of a circle of one metre driven at 0.1 m/s, against what it is; and the case.
fn circle(times: &[f64], tolerance: f64) -> (f64, creepage::motion::Case) {
    let wheel = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    let inputs = EnsembleInputs { formulas: formulas(&["0.2", "0.1"]), ..EnsembleInputs::default() };
    let e = Ensemble::new(&wheel, &inputs, &[], &[0.0; 3], 0.0, times, tolerance).unwrap();
    let case = e.run(&e.plan(|_| vec![], 1).unwrap(), &[&[]]).unwrap().remove(0);
    let row = |(i, t): (usize, &f64)| {
        let turned = 0.1 * t;
        worst(&case.row(i)[..3], &[turned.sin(), 1.0 - turned.cos(), turned])
    };
    (times.iter().enumerate().map(row).fold(0.0, f64::max), case)
}

/// Thousands of rows: the sums of their steps are as exact as one step is.
#[test]
fn rounding_does_not_grow_with_the_steps() {
    let times: Vec<f64> = (1..=5000).map(|i| f64::from(i) / 10.0).collect();
    let (error, case) = circle(&times, 1e-12);
    assert!(error <= case.error.unwrap() && case.converged, "{error:e}, said {:?}", case.error);
}

/// More digits than a number has: told with what there is, and not sought for ever.
#[test]
fn an_error_that_rounding_forbids_is_not_sought_for_ever() {
    let began = std::time::Instant::now();
    let (error, case) = circle(&[100.0], 1e-17);
    let said = case.error.unwrap();
    assert!(!case.converged && error <= said && said < 1e-13, "{error:e}, said {said:e}");
    assert!(began.elapsed().as_secs() < 20, "{:?}", began.elapsed());
}

#[test]
fn what_does_not_fit_is_refused() {
    let s = subjects().remove(0);
    let (good, _) = inputs(&s);
    let new = |inputs: &EnsembleInputs, start: &[f64], times: &[f64], tolerance| {
        Ensemble::new(&s.model, inputs, &[], start, 0.0, times, tolerance).map(drop)
    };
    assert!(new(&good, &s.start, &[0.0, 1.0], 1e-10).is_ok());
    assert!(new(&good, &[0.0; 2], &[0.0, 1.0], 1e-10).is_err());
    assert!(new(&good, &s.start, &[1.0, 0.5], 1e-10).is_err());
    assert!(new(&good, &s.start, &[-1.0, 0.5], 1e-10).is_err());
    assert!(new(&good, &s.start, &[], 1e-10).is_err());
    assert!(new(&good, &s.start, &[0.0, f64::NAN], 1e-10).is_err());
    assert!(new(&good, &s.start, &[0.0, 1.0], 0.0).is_err());
    for (varied, name) in [
        (Varied::Model("trailer_length_1".into()), "trailer_length_1"),
        (Varied::Initial(3), "component 3 of the initial pose"),
    ] {
        let error = Ensemble::new(&s.model, &good, &[varied], &s.start, 0.0, &[1.0], 1e-10).map(drop).unwrap_err();
        assert!(error.to_string().contains(&format!("the model has no {name} that could vary")), "{error}");
    }
    for name in ["t", "wheel_radius"] {
        let constants = [(Symbol::from(name), 1.0)].into();
        assert!(new(&EnsembleInputs { constants, ..good.clone() }, &s.start, &[0.0, 1.0], 1e-10).is_err(), "{name}");
        let varied = [Varied::Input(name.into())];
        assert!(Ensemble::new(&s.model, &good, &varied, &s.start, 0.0, &[1.0], 1e-10).is_err(), "{name}");
    }
    let stranger = EnsembleInputs { formulas: formulas(&["a", "1"]), ..EnsembleInputs::default() };
    let error = new(&stranger, &s.start, &[0.0, 1.0], 1e-10).unwrap_err();
    assert!(error.exit_code() == 2 && error.to_string().contains("a formula uses a,"), "{error}");
}
