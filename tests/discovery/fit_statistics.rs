//! The fit's linear algebra against plain least squares, its Jacobians against differences.

use crate::read_back::read_back;
use crate::simulator::{Hidden, Noise, Scenario, Tractor};
use creepage::discrepancy::estimation::elimination::eliminate;
use creepage::discrepancy::estimation::fit::Effort;
use creepage::discrepancy::estimation::noise_model::NoiseModel;
use creepage::discrepancy::estimation::problem::Problem;
use creepage::discrepancy::estimation::variance_components;
use creepage::discrepancy::initial_state::hidden_states;
use creepage::discrepancy::initial_state::pose::pose_of;
use creepage::discrepancy::record::run_record::Record;
use creepage::discrepancy::shooting::linearised_window::LinearisedWindow;
use creepage::discrepancy::shooting::window_integration::linearise;
use creepage::discrepancy::shooting::windows::WindowStates;
use creepage::effects::{self, Applied};
use creepage::formula::{Expr, Symbol};
use creepage::model::{Equations, Model};
use creepage::motion::{StateSensitivity, Stepper};
use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen};
use std::f64::consts::TAU;

/// A run, a model with free effects, and where it is linearised.
struct Case {
    problem: Problem,
    model: Model,
    equations: Equations,
    p: Vec<f64>,
    starts: WindowStates,
}

impl Case {
    /// Effects by id with the values the model is linearised at.
    fn new(scenario: &Scenario, effects: &[(&str, &[f64])]) -> Self {
        let (file, run) = read_back(&scenario.model_toml(), &scenario.run().to_csv(9));
        let mut model = Model::from_file(&file, effects::all(), &run.roles).unwrap();
        for (id, values) in effects {
            model = model.with_effect(Applied::new(effects::named(id).unwrap(), None, values.to_vec()).freed());
        }
        let problem = Problem::new(vec![Record::of_run(&run, file.input_timing, 0)], None, None);
        let free: Vec<_> = model.effects.iter().flat_map(|e| e.parameters()).collect();
        let p: Vec<f64> = model.effects.iter().flat_map(|e| e.values.clone()).collect();
        let equations = model.equations(&free).unwrap();
        let mut starts = problem.starts(&model).unwrap();
        // A little beside what was measured, so that no residual is small by accident.
        for (k, z) in starts.iter_mut().flatten().enumerate() {
            let k = k as f64;
            z[0] += 0.01 * (2.0 * k).sin();
            z[1] += 0.01 * (3.0 * k).cos();
            z[2] += 0.01 * (5.0 * k).sin();
        }
        Self { problem, model, equations, p, starts }
    }

    fn record(&self) -> &Record {
        &self.problem.records[0]
    }

    fn linear(&self) -> Vec<Vec<LinearisedWindow>> {
        linearise(&self.equations, &self.p, &self.problem.records, &self.problem.plan, &self.starts).unwrap()
    }

    /// Times at which a window begins and ends.
    fn span(&self, k: usize) -> (f64, f64) {
        let windows = &self.problem.plan[0].windows;
        let end = if k + 1 < windows.len() { windows[k].end } else { windows[k].end - 1 };
        (self.record().time[windows[k].start], self.record().time[end])
    }

    /// Residuals of each channel in a window and its end, by plain integration at parameters p; hidden states come
    /// from the windows before at the given starts, then the window's start is moved.
    fn plain(&self, p: &[f64], window: usize, moved: [f64; 3]) -> ([Vec<f64>; 2], Vec<f64>) {
        let (record, segment) = (self.record(), &self.problem.plan[0]);
        let mut stepper = Stepper::new(&self.equations, &record.signals, p);
        // From rest at the log's first row to the first window, without sensitivities.
        let first = segment.windows[0].start;
        let pose = &self.starts[0][0];
        let mut hidden = hidden_states::at_rest(&self.equations, p, &mut stepper, record.time[0], pose).z;
        for i in 0..first {
            let mut arc = StateSensitivity { z: [pose.clone(), hidden].concat(), s: vec![] };
            stepper.advance(&mut arc, record.time[i], record.time[i + 1]);
            hidden = arc.z[3..].to_vec();
        }
        for (k, rows) in segment.windows.iter().enumerate() {
            let mut z = self.starts[0][k].clone();
            if k == window {
                (0..3).for_each(|i| z[i] += moved[i]);
            }
            let mut arc = StateSensitivity { z: [z, hidden].concat(), s: vec![] };
            let mut residuals = [vec![], vec![]];
            for i in rows.clone() {
                let y = stepper.outputs(&arc.z)[..3].to_vec();
                for (c, channel) in record.channels().into_iter().enumerate() {
                    let r = y[channel.output] - record.columns[c][i];
                    let whole = if channel.is_angle { TAU * (r / TAU).round() } else { 0.0 };
                    residuals[channel.noise].push(r - whole);
                }
                if i + 1 < rows.end || k + 1 < segment.windows.len() {
                    stepper.advance(&mut arc, record.time[i], record.time[i + 1]);
                }
            }
            if k == window {
                return (residuals, arc.z[..3].to_vec());
            }
            hidden = arc.z[3..].to_vec();
        }
        unreachable!("no such window")
    }
}

fn unicycle() -> Scenario {
    let hidden = vec![Hidden::TraverseCreep { e_tc: 0.05 }];
    Scenario { hidden, duration: 12.0, noise: Noise::MOCAP, ..Scenario::new(Tractor::Unicycle, 1) }
}

fn car() -> Scenario {
    let hidden = vec![Hidden::SteeringOffset { offset: 0.02 }];
    Scenario { hidden, duration: 8.0, rate: 20.0, noise: Noise::RTK, ..Scenario::new(Tractor::Car, 2) }
}

/// What plain least squares makes of all windows: unknowns are the first start, one standard normal number for each
/// axis and jump, and the parameters.
struct Dense {
    /// Cost at δp = 0, everything else at its best.
    cost: f64,
    information: DMatrix<f64>,
    gradient: DVector<f64>,
    /// ln det of the information of the first start and the jumps.
    log_determinant: f64,
    /// Corrections of the starts at a δp.
    corrections: Vec<DVector<f64>>,
}

fn dense(case: &Case, windows: &[LinearisedWindow], v: &NoiseModel, delta: &DVector<f64>) -> Dense {
    let (p, jumps) = (delta.len(), windows.len() - 1);
    let poses = 3 + 3 * jumps;
    let size = poses + p + 1;
    // δz of the start of a window as a function of all unknowns and 1.
    let mut z = DMatrix::<f64>::zeros(3, size);
    z.fill_diagonal(1.0);
    let mut starts = vec![];
    let mut rows: Vec<DMatrix<f64>> = vec![];
    let mut log_determinant = 0.0;
    for (k, window) in windows.iter().enumerate() {
        starts.push(z.clone());
        let mut here = DMatrix::zeros(3 + p + 1, size);
        here.rows_mut(0, 3).copy_from(&z);
        (0..=p).for_each(|i| here[(3 + i, poses + i)] = 1.0);
        for (gram, noise) in window.gram.iter().zip(v.measurement()) {
            // Rows whose squares add up to the window's.
            let SymmetricEigen { eigenvectors, eigenvalues } = gram.clone().symmetric_eigen();
            let root = DMatrix::from_diagonal(&eigenvalues.map(|e| e.max(0.0).sqrt())) * eigenvectors.transpose();
            rows.push(root * &here / noise.variance.sqrt());
        }
        let Some(back) = &window.back else { continue };
        // back = F⁻¹(1, −B, −c) is turned round: δz̃ = F·δz + B·δp + c.
        let f = Matrix3::from_fn(|i, j| back[(i, j)]).try_inverse().unwrap();
        log_determinant -= 2.0 * f.determinant().abs().ln();
        let rest = f * back.columns(3, p + 1);
        let mut next = DMatrix::from_fn(3, size, |i, j| (0..3).map(|l| f[(i, l)] * z[(l, j)]).sum::<f64>());
        for i in 0..=p {
            let mut column = next.column_mut(poses + i);
            column -= rest.column(i);
        }
        let heading = case.starts[0][k + 1][2] + window.mismatch[2];
        let (sin, cos) = heading.sin_cos();
        let axes = Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
        let (from, to) = case.span(k);
        for i in 0..3 {
            let deviation = (v.jump(i) * (to - from)).sqrt();
            let mut prior = DMatrix::zeros(1, size);
            prior[(0, 3 + 3 * k + i)] = 1.0;
            rows.push(prior);
            for row in 0..3 {
                next[(row, 3 + 3 * k + i)] += axes[(row, i)] * deviation;
            }
        }
        z = next;
    }
    let form = rows.iter().fold(DMatrix::zeros(size, size), |sum, r| sum + r.tr_mul(r));
    let of_poses = form.view((0, 0), (poses, poses)).into_owned().cholesky().unwrap();
    log_determinant += 2.0 * of_poses.l().diagonal().map(f64::ln).sum();
    let right = form.view((0, poses), (poses, p + 1)).into_owned();
    let solved = of_poses.solve(&right);
    let left = form.view((poses, poses), (p + 1, p + 1)) - right.tr_mul(&solved);
    let unknowns = -&solved * delta.clone().push(1.0);
    let all = DVector::from_iterator(size, unknowns.iter().chain(delta.iter()).copied().chain([1.0]));
    Dense {
        cost: left[(p, p)],
        information: left.view((0, 0), (p, p)).into_owned(),
        gradient: left.view((0, p), (p, 1)).column(0).into_owned(),
        log_determinant,
        corrections: starts.iter().map(|s| s * &all).collect(),
    }
}

#[track_caller]
fn near(what: &str, found: f64, expected: f64, scale: f64) {
    assert!((found - expected).abs() <= 2e-6 * scale, "{what}: {found} instead of {expected}");
}

#[track_caller]
fn as_dense(case: &Case) {
    let linear = case.linear();
    assert!(linear.len() == 1 && linear[0].len() >= 6, "{} windows", linear[0].len());
    let p = case.p.len();
    let delta = DVector::from_fn(p, |i, _| 0.01 * (i as f64 + 1.0));
    for size in [1e-12, 1e-6, 1e-2, 10.0] {
        let mut v = case.problem.variances.clone();
        v.process_mut().iter_mut().zip([size, 0.3 * size, 2.0 * size]).for_each(|(jump, size)| jump.variance = size);
        let e = eliminate(&linear, &v, p).unwrap();
        let expected = dense(case, &linear[0], &v, &delta);
        near("cost", e.cost(), expected.cost, expected.cost);
        let (information, gradient) = e.normal();
        let scale = |i: usize| expected.information[(i, i)].sqrt();
        for i in 0..p {
            near("gradient", gradient[i], expected.gradient[i], scale(i) * expected.cost.sqrt());
            for j in 0..p {
                near("information", information[(i, j)], expected.information[(i, j)], scale(i) * scale(j));
            }
        }
        near("ln det", e.log_determinant, expected.log_determinant, expected.log_determinant.abs().max(1.0));
        for (found, expected) in e.corrections(&linear, &delta)[0].iter().zip(&expected.corrections) {
            (0..3).for_each(|i| near("correction", found[i], expected[i], expected.amax().max(0.01)));
        }
        // −2 ln of the likelihood, constants left out.
        let gain = expected.gradient.dot(&expected.information.clone().cholesky().unwrap().solve(&expected.gradient));
        let values = linear[0].iter().map(|w| &w.count).fold([0; 2], |n, c| [n[0] + c[0], n[1] + c[1]]);
        let noise = |k: usize| v.measurement()[k].variance.ln();
        let of_noise = values[0] as f64 * noise(0) + values[1] as f64 * noise(1);
        let deviance = expected.cost - gain + expected.log_determinant + of_noise;
        near("deviance", variance_components::deviance(&linear, &v, &e), deviance, deviance.abs());
    }
}

#[test]
fn elimination_is_least_squares_for_a_unicycle() {
    as_dense(&Case::new(&unicycle(), &[("rotation-creep", &[0.01]), ("traverse-creep", &[0.02])]));
}

#[test]
fn elimination_is_least_squares_for_a_car() {
    as_dense(&Case::new(&car(), &[("steering-offset", &[0.01]), ("input-delay", &[0.03]), ("wheelbase", &[0.02])]));
}

#[test]
fn elimination_is_least_squares_with_a_hidden_state() {
    as_dense(&Case::new(&unicycle(), &[("cornering-creep", &[0.1]), ("lever-arm", &[0.1, -0.05])]));
}

/// Every number of every window's linearisation against central differences of plain integration.
#[track_caller]
fn as_differences(case: &Case) {
    const STEP: f64 = 1e-5;
    let linear = case.linear().remove(0);
    let (p, last) = (case.p.len(), linear.len() - 1);
    for (k, window) in linear.iter().enumerate() {
        let (residuals, end) = case.plain(&case.p, k, [0.0; 3]);
        let moved = |i: usize, by: f64| {
            let (mut start, mut p) = ([0.0; 3], case.p.clone());
            if i < 3 {
                start[i] = by
            } else {
                p[i - 3] += by
            }
            case.plain(&p, k, start)
        };
        let sides: Vec<_> = (0..3 + p).map(|i| (moved(i, STEP), moved(i, -STEP))).collect();
        for (channel, plain) in residuals.iter().enumerate() {
            let rows = plain.len();
            assert_eq!(window.count[channel], rows);
            let line = |r: usize, c: usize| match sides.get(c) {
                Some((up, down)) => (up.0[channel][r] - down.0[channel][r]) / (2.0 * STEP),
                None => plain[r],
            };
            let j = DMatrix::from_fn(rows, 3 + p + 1, line);
            let gram = j.tr_mul(&j);
            for a in 0..gram.nrows() {
                for b in 0..gram.nrows() {
                    let scale = (gram[(a, a)] * gram[(b, b)]).sqrt() + 1e-6;
                    near(
                        &format!("gram {channel} ({a}, {b}) of {k}"),
                        window.gram[channel][(a, b)],
                        gram[(a, b)],
                        5.0 * scale,
                    );
                }
            }
        }
        assert_eq!(window.count.len(), 2);
        let (from, to) = case.span(k);
        assert_eq!(window.duration, to - from);
        let (sin, cos) = end[2].sin_cos();
        for (at, value) in [((0, 0), cos), ((1, 0), sin), ((0, 1), -sin), ((1, 1), cos), ((2, 2), 1.0), ((2, 0), 0.0)] {
            near("axes", window.axes[at], value, 1.0);
        }
        assert_eq!(window.back.is_some(), k < last);
        let Some(back) = &window.back else { continue };
        let next = &case.starts[0][k + 1];
        let c: Vec<f64> = (0..3).map(|i| end[i] - next[i]).collect();
        let turns = TAU * (c[2] / TAU).round();
        let c = [c[0], c[1], c[2] - turns];
        for (i, along) in [cos * c[0] + sin * c[1], -sin * c[0] + cos * c[1], c[2]].into_iter().enumerate() {
            near("mismatch", window.mismatch[i], along, 1.0);
        }
        // Whatever the start and p are moved by, `back` finds the start again from the end.
        let slope = |i: usize, j: usize| (sides[j].0.1[i] - sides[j].1.1[i]) / (2.0 * STEP);
        for j in 0..3 + p {
            let mut columns = DVector::zeros(3 + p + 1);
            (0..3).for_each(|i| columns[i] = slope(i, j) + c[i]);
            if j >= 3 {
                columns[j] = 1.0;
            }
            columns[3 + p] = 1.0;
            let found = back * columns;
            for i in 0..3 {
                near(&format!("back {i} of {j} in {k}"), found[i], f64::from(u8::from(i == j)), 10.0);
            }
        }
    }
}

#[test]
fn jacobians_of_a_unicycle_are_differences() {
    as_differences(&Case::new(&unicycle(), &[("rotation-creep", &[0.01]), ("yaw-rate-bias", &[0.02])]));
}

#[test]
fn jacobians_of_a_delayed_car_are_differences() {
    as_differences(&Case::new(&car(), &[("steering-offset", &[0.01]), ("input-delay", &[0.03])]));
}

#[test]
fn jacobians_through_a_hidden_state_are_differences() {
    as_differences(&Case::new(&unicycle(), &[("cornering-creep", &[0.1]), ("lever-arm", &[0.1, -0.05])]));
}

#[test]
fn a_heading_counts_to_full_turns() {
    let mut case = Case::new(&unicycle(), &[("rotation-creep", &[0.01])]);
    let here = case.linear().remove(0);
    case.starts[0].iter_mut().enumerate().for_each(|(k, z)| z[2] += TAU * (k % 3) as f64);
    for (turned, window) in case.linear()[0].iter().zip(&here) {
        assert!((&turned.gram[1] - &window.gram[1]).amax() < 1e-9);
        for (a, b) in turned.mismatch.iter().zip(&window.mismatch) {
            near("mismatch", *a, *b, 1e-3);
        }
    }
}

#[test]
fn a_pose_is_found_from_what_the_sensor_measures() {
    let case = Case::new(&car(), &[("lever-arm", &[0.7, -0.4]), ("heading-misalignment", &[0.3])]);
    let fixed = case.model.equations(&[]).unwrap();
    let mut w = fixed.workspace(&[]);
    for z in [[1.0, -2.0, 0.5], [-30.0, 4.0, 9.0]] {
        let measured = fixed.outputs(&mut w, &z)[..3].to_vec();
        let found = pose_of(&fixed, &measured);
        (0..3).for_each(|i| near("pose", found[i], z[i], 1e-3));
    }
}

/// How much noise there is does not hang on the unit of a parameter.
#[test]
fn variances_are_the_same_in_any_unit() {
    let scenario = unicycle();
    let (file, run) = read_back(&scenario.model_toml(), &scenario.run().to_csv(9));
    let model = Model::from_file(&file, effects::all(), &run.roles).unwrap();
    let problem = Problem::new(vec![Record::of_run(&run, file.input_timing, 0)], None, None);
    let fitted = |unit: f64| {
        let mut effect = effects::named("traverse-creep").unwrap().clone();
        let smaller = |f: &mut Expr| {
            *f = f.substitute(&|s: &Symbol| {
                (s.as_str() == "e_tc").then(|| Expr::parse(&format!("e_tc*{unit:e}")).unwrap())
            });
        };
        effect.changes.values_mut().for_each(smaller);
        let parameter = effect.parameters.get_mut("e_tc").unwrap();
        (parameter.range, parameter.size) = (parameter.range.map(|r| r / unit), parameter.size / unit);
        let model = model.clone().with_effect(Applied::new(&effect, None, vec![0.0]).freed());
        let effort = Effort { passes: 30, enough: 1e-9, ..Effort::FULL };
        problem.fit(&model, &problem.starts(&model).unwrap(), &problem.variances, effort).unwrap().unwrap()
    };
    let [usual, tiny] = [1.0, 1e-9].map(fitted);
    assert!((tiny.p[0] * 1e-9 / usual.p[0] - 1.0).abs() < 1e-4, "{:?} {:?}", usual.p, tiny.p);
    let of = |v: &NoiseModel| v.components().iter().map(|c| c.variance).collect::<Vec<f64>>();
    for (a, b) in of(&usual.variances).into_iter().zip(of(&tiny.variances)) {
        assert!((a / b - 1.0).abs() < 1e-4, "{:?} {:?}", usual.variances, tiny.variances);
    }
}
