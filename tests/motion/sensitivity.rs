//! Sensitivities of trajectories, against central differences and against dual numbers pushed through another integrator.

use creepage::effects::{self, Applied};
use creepage::formula::{Dual, Expr, Graph, Program, Scalar, Symbol};
use creepage::model::{Equations, Model, Trailer};
use creepage::motion::{
    Drive, Formulas, Integrator, Signals, Stepper, Timing, initial_hidden, simulate, with_sensitivities,
};
use nalgebra::DMatrix;
use num_dual::Dual64;

fn effect(id: &str, values: &[f64]) -> Applied {
    Applied::new(effects::named(id).unwrap(), None, values.to_vec())
}

fn on_trailer(id: &str, trailer: usize, values: &[f64]) -> Applied {
    Applied::new(effects::named(id).unwrap(), Some(trailer), values.to_vec())
}

/// Vehicles with effects on every kind of place: constraints, inputs, sensor, hitch, ground, clock, added states.
/// Values stand in the alphabetical order of the parameters' names.
fn models() -> Vec<Model> {
    let unicycle = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    let drive = Model::new("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.4)]).unwrap();
    let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
    let trailers = [Trailer { length: 2.0, hitch: 0.4 }, Trailer { length: 1.5, hitch: 0.0 }];
    let with = |model: &Model, effects: Vec<Applied>| effects.into_iter().fold(model.clone(), Model::with_effect);
    vec![
        with(
            &unicycle,
            vec![
                effect("rotation-creep", &[0.05]),
                effect("cornering-creep", &[0.2]),
                effect("input-delay", &[0.13]),
                effect("lever-arm", &[0.3, -0.1]),
            ],
        ),
        with(
            &unicycle,
            vec![
                effect("traction-creep", &[0.15]),
                effect("relaxation-length", &[0.06, 0.4]),
                effect("side-slope", &[0.7, 0.05]),
                effect("yaw-rate-bias", &[0.02]),
            ],
        ),
        with(
            &drive,
            vec![
                effect("unequal-rotation-creep", &[0.02, -0.03]),
                effect("track-width", &[0.04]),
                effect("load-dependent-creep", &[0.03]),
                effect("input-delay", &[-0.08]),
            ],
        ),
        with(
            &car,
            vec![
                effect("traverse-creep", &[0.04]),
                effect("front-traverse-creep", &[-0.02]),
                effect("understeer", &[0.004]),
                effect("steering-offset", &[0.01]),
                effect("cornering-creep", &[0.1]),
                effect("drift", &[0.02, -0.01]),
            ],
        ),
        with(
            &car.clone().with_trailers(&trailers),
            vec![
                effect("input-delay", &[0.05]),
                effect("traverse-creep", &[0.03]),
                on_trailer("trailer-traverse-creep", 1, &[0.05]),
                on_trailer("trailer-length", 2, &[0.1]),
                on_trailer("hitch-offset", 1, &[0.07]),
            ],
        ),
    ]
}

/// A model's free parameters are those of its effects, at their values.
fn free(model: &Model) -> (Vec<Symbol>, Vec<f64>) {
    let pairs = model.effects.iter().flat_map(|e| e.parameters().into_iter().zip(e.values.iter().copied()));
    pairs.unzip()
}

/// A lively drive: the input of a name as level, swing and phase of a sine of 1.3 rad/s.
fn shape(input: &Symbol) -> (f64, f64, f64) {
    match input.as_str() {
        "wheel_rate" | "wheel_rate_right" => (6.0, 1.5, 0.0),
        "wheel_rate_left" => (5.8, 1.2, 1.0),
        _ => (0.2, 0.25, 1.0),
    }
}

/// Samples of it every 0.1 s.
fn signals(equations: &Equations, timing: Timing) -> Signals {
    let t: Vec<f64> = (0..=40).map(|i| 0.1 * f64::from(i)).collect();
    let column = |input| {
        let (level, swing, phase) = shape(input);
        t.iter().map(|t| level + swing * (1.3 * t + phase).sin()).collect()
    };
    Signals::new(&t, &equations.inputs.iter().map(column).collect::<Vec<_>>(), timing)
}

/// The same as formulas.
fn formulas(inputs: &[Symbol]) -> Vec<Expr> {
    let formula = |input| {
        let (level, swing, phase) = shape(input);
        Expr::parse(&format!("{level} + {swing}*sin(1.3*t + {phase})")).unwrap()
    };
    inputs.iter().map(formula).collect()
}

fn start(model: &Model, equations: &Equations, p: &[f64]) -> Vec<f64> {
    let mut z: Vec<f64> = vec![0.4, -0.2, 0.3];
    z.extend((0..model.trailers.len()).map(|i| 0.2 - 0.3 * i as f64));
    let u: Vec<f64> = equations.inputs.iter().map(|i| shape(i).0).collect();
    let hidden = initial_hidden(equations, p, &u, &z);
    z.extend(hidden);
    z
}

const TIGHT: Integrator =
    Integrator { method: creepage::motion::Method::Dop853, rtol: 1e-12, atol: 1e-13, max_steps: 1_000_000 };
const TIMES: [f64; 4] = [0.25, 1.0, 2.37, 3.6];

fn compare(found: &DMatrix<f64>, wanted: &DMatrix<f64>, tolerance: f64, what: &str) {
    assert_eq!(found.shape(), wanted.shape());
    for ((i, f), w) in found.iter().enumerate().zip(wanted.iter()) {
        let (row, column) = (i % found.nrows(), i / found.nrows());
        assert!((f - w).abs() <= tolerance * (1.0 + w.abs()), "{what}: row {row}, column {column}: {f} and not {w}");
    }
}

#[test]
fn they_are_the_differences_of_the_trajectory() {
    for timing in [Timing::Sample, Timing::IntervalMean] {
        for model in models() {
            let (names, p) = free(&model);
            let equations = model.equations(&names).unwrap();
            let inputs = signals(&equations, timing);
            let z0 = start(&model, &equations, &p);
            let rows = with_sensitivities(&equations, &p, &inputs, &z0, &TIMES, &TIGHT).unwrap();
            let base = [&z0[..], &p].concat();
            let end = |x: &[f64]| {
                let (z0, p) = x.split_at(z0.len());
                simulate(&equations, p, &inputs, z0, &TIMES, &TIGHT).unwrap()
            };
            let moved = |k: usize, by: f64| {
                let mut x = base.clone();
                x[k] += by;
                end(&x)
            };
            let plain = end(&base);
            for (i, (z, s)) in rows.iter().enumerate() {
                z.iter().zip(&plain[i]).for_each(|(a, b)| assert!((a - b).abs() < 1e-10, "{a} {b}"));
                let h = 1e-4;
                let columns: Vec<f64> = (0..base.len())
                    .flat_map(|k| {
                        let (a, b, c, d) = (moved(k, -2.0 * h), moved(k, -h), moved(k, h), moved(k, 2.0 * h));
                        (0..z.len())
                            .map(|j| (a[i][j] - 8.0 * b[i][j] + 8.0 * c[i][j] - d[i][j]) / (12.0 * h))
                            .collect::<Vec<f64>>()
                    })
                    .collect();
                let wanted = DMatrix::from_column_slice(z.len(), base.len(), &columns);
                compare(s, &wanted, 3e-7, &format!("{} {timing:?} at {}", model.vehicle.id, TIMES[i]));
            }
        }
    }
}

/// Inputs and rates read in dual numbers from the model's definitions, compiled here and not by `Equations`.
struct Other {
    rates: Program,
    delay: Program,
    inputs: Program,
    values: Vec<(Symbol, f64)>,
    states: usize,
}

impl Other {
    fn new(model: &Model) -> Self {
        let mut graph = Graph::default();
        model.definitions().unwrap().insert_into(&mut graph).unwrap();
        let states = model.states();
        let mut rates: Vec<_> =
            states[..3 + model.trailers.len()].iter().map(|s| graph.definition(&s.rate()).unwrap()).collect();
        for (_, rate) in model.effects.iter().flat_map(Applied::states) {
            rates.push(graph.insert(&rate));
        }
        let values: Vec<(Symbol, f64)> = model.values().into_iter().collect();
        let inputs: Vec<Symbol> = model.inputs.iter().map(|i| Symbol::new(i)).collect();
        let names: Vec<Symbol> = values.iter().map(|(s, _)| s.clone()).collect();
        let delay = graph.definition(&"delay".into()).unwrap();
        let mut own = Graph::default();
        let formulas: Vec<_> = formulas(&inputs).iter().map(|f| own.insert(f)).collect();
        Self {
            rates: Program::compile(&graph, &[&states[..], &inputs, &names].concat(), &rates).unwrap(),
            delay: Program::compile(&graph, &names, &[delay]).unwrap(),
            inputs: Program::compile(&own, &["t".into()], &formulas).unwrap(),
            values,
            states: states.len(),
        }
    }

    /// The trajectory by the classical Runge–Kutta method in dual numbers, with one of (z0, p) varied.
    fn column(&self, z0: &[f64], varied: &Symbol, state: Option<usize>, end: f64, steps: usize) -> Vec<Dual64> {
        let seed = |v: f64, on: bool| Dual(Dual64::new(v, if on { 1.0 } else { 0.0 }));
        let values: Vec<Dual<Dual64>> =
            self.values.iter().map(|(s, v)| seed(*v, state.is_none() && s == varied)).collect();
        let delay = self.delay.run_in(&values).remove(0);
        let f = |t: f64, z: &[Dual<Dual64>]| -> Vec<Dual<Dual64>> {
            let u = self.inputs.run_in(&[seed(t, false).sub(&delay)]);
            self.rates.run_in(&[z, &u, &values].concat())
        };
        let scaled = |k: &[Dual<Dual64>], z: &[Dual<Dual64>], h: f64| -> Vec<Dual<Dual64>> {
            z.iter().zip(k).map(|(z, k)| Dual(z.0 + k.0 * h)).collect()
        };
        let mut z: Vec<Dual<Dual64>> = z0.iter().enumerate().map(|(i, v)| seed(*v, state == Some(i))).collect();
        let h = end / steps as f64;
        for i in 0..steps {
            let t = h * i as f64;
            let k1 = f(t, &z);
            let k2 = f(t + h / 2.0, &scaled(&k1, &z, h / 2.0));
            let k3 = f(t + h / 2.0, &scaled(&k2, &z, h / 2.0));
            let k4 = f(t + h, &scaled(&k3, &z, h));
            for j in 0..self.states {
                z[j] = Dual(z[j].0 + (k1[j].0 + k2[j].0 * 2.0 + k3[j].0 * 2.0 + k4[j].0) * (h / 6.0));
            }
        }
        z.into_iter().map(|z| z.0).collect()
    }
}

#[test]
fn they_are_what_dual_numbers_carry_through_another_integrator() {
    for model in models() {
        let (names, p) = free(&model);
        let equations = model.equations(&names).unwrap();
        let inputs = Formulas::new(&formulas(&equations.inputs), &[]).unwrap();
        let z0 = start(&model, &equations, &p);
        let end = 2.0;
        let rows = with_sensitivities(&equations, &p, &inputs, &z0, &[0.0, end], &TIGHT).unwrap();
        let other = Other::new(&model);
        let columns: Vec<Vec<Dual64>> = (0..z0.len())
            .map(|i| (Some(i), "".into()))
            .chain(names.iter().map(|s| (None, s.clone())))
            .map(|(state, name): (Option<usize>, Symbol)| other.column(&z0, &name, state, end, 2000))
            .collect();
        let (z, s) = &rows[1];
        z.iter().zip(&columns[0]).for_each(|(a, b)| assert!((a - b.re).abs() < 1e-9, "{a} {}", b.re));
        let wanted: Vec<f64> = columns.iter().flatten().map(|d| d.eps).collect();
        let wanted = DMatrix::from_column_slice(z.len(), columns.len(), &wanted);
        compare(s, &wanted, 1e-9, &model.vehicle.id);
    }
}

/// At the first time they are the identity and nothing else, and back at it they are so again.
#[test]
fn they_start_and_return_as_the_identity() {
    for model in models() {
        let (names, p) = free(&model);
        let equations = model.equations(&names).unwrap();
        let inputs = signals(&equations, Timing::Sample);
        let z0 = start(&model, &equations, &p);
        let rows = with_sensitivities(&equations, &p, &inputs, &z0, &[1.0, 1.6, 1.0], &TIGHT).unwrap();
        let identity = DMatrix::identity(z0.len(), z0.len() + p.len());
        compare(&rows[0].1, &identity, 0.0, "at the start");
        compare(&rows[2].1, &identity, 1e-7, "there and back");
    }
}

/// A delay that reaches over the ends of the log: the inputs stand still there, and their slope is zero.
#[test]
fn a_delay_over_the_ends_of_the_log_is_differentiated_on_the_right_side() {
    let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    let model = model.with_effect(effect("input-delay", &[0.5]));
    let equations = model.equations(&["input_delay.delay".into()]).unwrap();
    // wheel_rate 2 + 4t on [0, 1], constant outside; straight on. Delayed by 1/2 it acts on [1/2, 3/2].
    let inputs = Signals::new(&[0.0, 0.5, 1.0], &[vec![2.0, 4.0, 6.0], vec![0.0; 3]], Timing::Sample);
    let times = [0.0, 0.5, 1.0, 1.5, 2.5];
    for delay in [0.5, 0.1 + 0.2, 0.7] {
        let rows = with_sensitivities(&equations, &[delay], &inputs, &[0.0; 3], &times, &TIGHT).unwrap();
        for ((z, s), t) in rows.iter().zip(times) {
            let ramp = (t - delay).clamp(0.0, 1.0);
            let x = 0.5 * (2.0 * t + 2.0 * ramp * ramp + 4.0 * (t - delay - ramp).max(0.0));
            let by_delay = -0.5 * 4.0 * ramp;
            assert!((z[0] - x).abs() < 1e-10, "x at {t}, delay {delay}: {} {x}", z[0]);
            assert!((s[(0, 3)] - by_delay).abs() < 1e-10, "at {t}, delay {delay}: {} {by_delay}", s[(0, 3)]);
        }
    }
}

/// The work at the ends of a log stays what it is elsewhere: no look across the knot makes steps collapse.
#[test]
fn knots_cost_a_few_evaluations_each() {
    struct Counted<'a>(&'a Signals, std::cell::Cell<usize>);
    impl Drive for Counted<'_> {
        fn at(&self, t: f64, value: &mut [f64], slope: &mut [f64]) {
            self.1.set(self.1.get() + 1);
            self.0.at(t, value, slope);
        }
        fn knots(&self) -> &[f64] {
            self.0.knots()
        }
        fn channels(&self) -> usize {
            self.0.channels()
        }
    }
    let model = models().remove(0);
    let (names, p) = free(&model);
    let equations = model.equations(&names).unwrap();
    for timing in [Timing::Sample, Timing::IntervalMean] {
        let signals = signals(&equations, timing);
        let inputs = Counted(&signals, 0.into());
        let z0 = start(&model, &equations, &p);
        with_sensitivities(&equations, &p, &inputs, &z0, &[-1.0, 5.0], &Integrator::default()).unwrap();
        let spans = signals.knots().len() + 1;
        println!("{timing:?}: {} evaluations for {spans} spans", inputs.1.get());
        assert!(inputs.1.get() < 60 * spans, "{timing:?}: {} evaluations for {spans} spans", inputs.1.get());
    }
}

#[test]
fn sizes_that_do_not_fit_are_an_error() {
    let model = models().remove(0);
    let (names, p) = free(&model);
    let equations = model.equations(&names).unwrap();
    let inputs = signals(&equations, Timing::Sample);
    let one = Formulas::new(&[Expr::int(1)], &[]).unwrap();
    let z0 = vec![0.0; equations.n()];
    let i = Integrator::default();
    assert!(simulate(&equations, &p, &inputs, &z0, &[0.0, 1.0], &i).is_ok());
    for e in [
        simulate(&equations, &p, &inputs, &z0[1..], &[0.0, 1.0], &i).unwrap_err(),
        simulate(&equations, &p[1..], &inputs, &z0, &[0.0, 1.0], &i).unwrap_err(),
        simulate(&equations, &p, &one, &z0, &[0.0, 1.0], &i).unwrap_err(),
    ] {
        assert!(e.message().contains("are given, the model has"), "{e}");
    }
}

/// The quasi-static start: hidden rates vanish there.
#[test]
fn hidden_states_begin_where_their_rates_vanish() {
    for model in models() {
        let (names, p) = free(&model);
        let equations = model.equations(&names).unwrap();
        let u: Vec<f64> = equations.inputs.iter().map(|i| shape(i).0).collect();
        let mut z = vec![0.1, 0.2, 0.3];
        z.extend(vec![0.4; model.trailers.len()]);
        z.extend(initial_hidden(&equations, &p, &u, &z));
        let mut rates = vec![0.0; z.len()];
        equations.rates(&mut equations.workspace(&p), &z, &u, &mut rates);
        rates[equations.visible..].iter().for_each(|r| assert!(r.abs() < 1e-10, "{}: {rates:?}", model.vehicle.id));
    }
    // At standstill a relaxed slip may stand anywhere: it begins at zero.
    let wheel = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    let relaxed = wheel.with_effect(effect("relaxation-length", &[0.06, 0.4])).equations(&[]).unwrap();
    assert_eq!(initial_hidden(&relaxed, &[], &[0.0, 0.0], &[0.0; 3]), vec![0.0]);
    let moving = initial_hidden(&relaxed, &[], &[4.0, 0.0], &[0.0; 3]);
    assert!((moving[0] - 0.12).abs() < 1e-12, "{moving:?}");
}

/// Rows far apart against what the vehicle forgets in: the speed v lags behind the wheel's v_d as v′ = (v_d − v)/T, so from
/// rest the way is ∫v_d dt − T·v, and v = v_d − T·v_d′ at the end where v_d is a line. The fixed steps of the fit find what
/// the lag costs, and how it hangs on T; they do not blow up.
#[test]
fn short_time_constants_are_followed_through_rows_far_apart() {
    let (r, lag) = (0.5, Symbol::from("traction_creep.mass_over_bR"));
    let plain = Model::new("unicycle", &[("wheel_radius", r)]).unwrap();
    let slips = plain.clone().with_effect(effect("traction-creep", &[0.1]));
    for apart in [1.0, 3600.0] {
        let time: Vec<f64> = (0..7).map(|i| apart * f64::from(i)).collect();
        let signals = Signals::new(&time, &[(2..9).map(f64::from).collect(), vec![0.0; 7]], Timing::Sample);
        let driven = |model: &Model, free: &[Symbol], p: &[f64]| {
            let equations = model.equations(free).unwrap();
            let mut stepper = Stepper::new(&equations, &signals, p);
            let mut arc = stepper.start(&vec![0.0; equations.n()], None);
            time.windows(2).for_each(|t| stepper.advance(&mut arc, t[0], t[1]));
            arc
        };
        let meant = driven(&plain, &[], &[]).z[0];
        for tau in [0.05, 0.02, 0.005, 1e-3, 1e-5, 1e-7, 1e-12].map(|share| share * apart) {
            let arc = driven(&slips, std::slice::from_ref(&lag), &[tau]);
            let (end, slope) = (r * 8.0, r / apart);
            let (lost, by_lag) = (tau * (end - tau * slope), 2.0 * tau * slope - end);
            let (found, case) = (meant - arc.z[0], format!("rows {apart} s apart, lag {tau} s"));
            assert!((found - lost).abs() < 1e-3 * lost + 1e-7 * meant, "{case}: {found} m lost and not {lost}");
            // A lag of a ten-millionth of the time between rows is as good as none, and not resolved.
            let resolved = tau > 1e-6 * apart;
            assert!(!resolved || (arc.s[3] - by_lag).abs() < 1e-3 * by_lag.abs(), "{case}: {} {by_lag}", arc.s[3]);
        }
    }
}

/// The same while turning, where both parts of the speed lag: against the integrator, which takes as many steps as it needs.
#[test]
fn what_is_forgotten_between_rows_is_what_the_integrator_finds() {
    let time: Vec<f64> = (0..=12).map(f64::from).collect();
    let unicycle = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    for lag in [0.019, 0.004, 0.0007] {
        let model = unicycle.clone().with_effect(effect("traction-creep", &[lag]));
        let model = model.with_effect(effect("cornering-creep", &[2.0 * lag]));
        let (names, p) = free(&model);
        let equations = model.equations(&names).unwrap();
        let column = |input: &Symbol| {
            let (level, swing, phase) = shape(input);
            time.iter().map(|t| level + swing * (1.3 * t + phase).sin()).collect()
        };
        for timing in [Timing::Sample, Timing::IntervalMean] {
            let inputs = Signals::new(&time, &equations.inputs.iter().map(column).collect::<Vec<_>>(), timing);
            let z0 = start(&model, &equations, &p);
            let rows = with_sensitivities(&equations, &p, &inputs, &z0, &time, &TIGHT).unwrap();
            let mut stepper = Stepper::new(&equations, &inputs, &p);
            let mut arc = stepper.start(&z0, None);
            // What is not the start of a hidden state.
            let columns: Vec<usize> = (0..3).chain(z0.len()..z0.len() + p.len()).collect();
            for (span, (z, s)) in time.windows(2).zip(&rows[1..]) {
                stepper.advance(&mut arc, span[0], span[1]);
                for i in 0..3 {
                    assert!((arc.z[i] - z[i]).abs() < 3e-6, "{timing:?}, {lag} s, state {i}: {} {}", arc.z[i], z[i]);
                    let found = &arc.s[i * columns.len()..(i + 1) * columns.len()];
                    for (found, wanted) in found.iter().zip(columns.iter().map(|c| s[(i, *c)])) {
                        let far = (found - wanted).abs() / (1.0 + wanted.abs());
                        assert!(far < 3e-4, "{timing:?}, {lag} s, slope of state {i}: {found} {wanted}");
                    }
                }
            }
        }
    }
}
