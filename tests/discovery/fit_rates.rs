//! Free effects fitted to samples of rates: the values are found, as exactly as the samples have them.

use creepage::discrepancy::estimation::rate_regression::{RateFit, RateSamples};
use creepage::effects::{self, Applied};
use creepage::model::Model;

const R: f64 = 0.5;

fn creeps(values: [f64; 2]) -> Model {
    let creep = |id: &str, v: f64| Applied::new(effects::named(id).unwrap(), None, vec![v]).freed();
    let model = Model::new("unicycle", &[("wheel_radius", R)]).unwrap();
    model.with_effect(creep("rotation-creep", values[0])).with_effect(creep("traverse-creep", values[1]))
}

/// A wheel with creeps (e_rc, e_tc), by hand; what is added to x' and y'.
fn samples(rows: usize, [e_rc, e_tc]: [f64; 2], noise: impl Fn(usize) -> [f64; 2]) -> RateSamples {
    let at = |i: usize| {
        let t = 0.03 * i as f64;
        let (phi, u) = (0.4 * t + t.sin(), 2.0 + t.cos());
        let forward = (1.0 - e_rc) * R * u;
        let (s, c) = phi.sin_cos();
        [phi, u, forward * (c - e_tc * s) + noise(i)[0], forward * (s + e_tc * c) + noise(i)[1]]
    };
    let column = |k: usize| (0..rows).map(|i| at(i)[k]).collect::<Vec<f64>>();
    let none = vec![0.0; rows];
    RateSamples {
        states: vec![none.clone(), none.clone(), column(0)],
        inputs: vec![column(1), none],
        rates: vec![column(2), column(3), vec![f64::NAN; rows]],
        deviations: vec![1.0; 3],
    }
}

#[test]
fn exact_samples_give_the_values_to_rounding_whatever_their_number() {
    for rows in [2, 31, 32, 33, 64, 1000] {
        let truth = [0.13, -0.21];
        let found = RateFit::of(&creeps([0.0; 2])).unwrap().to(&samples(rows, truth, |_| [0.0; 2])).unwrap();
        for (p, truth) in found.p.iter().zip(truth) {
            assert!((p - truth).abs() < 1e-13, "{rows} rows: {p} and {truth}");
        }
        assert!(found.squares < 1e-24 && found.evaluations < 10);
    }
}

/// By nested intervals in e_tc, with the best e_rc of each in closed form: no derivative is used.
fn least_squares_by_search(s: &RateSamples) -> [f64; 2] {
    let at = |e_tc: f64| {
        let (mut along, mut square, mut all) = (0.0, 0.0, 0.0);
        for i in 0..s.rates[0].len() {
            let (sine, cosine) = s.states[2][i].sin_cos();
            let v = R * s.inputs[0][i];
            let f = [v * (cosine - e_tc * sine), v * (sine + e_tc * cosine)];
            for (f, rates) in f.iter().zip(&s.rates) {
                along += f * rates[i];
                square += f * f;
                all += rates[i] * rates[i];
            }
        }
        (all - along * along / square, 1.0 - along / square)
    };
    let (mut low, mut high) = (-1.0, 1.0);
    for _ in 0..200 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(a).0 < at(b).0 { high = b } else { low = a }
    }
    [at(low).1, low]
}

#[test]
fn noisy_samples_give_the_least_squares() {
    let noise = |i: usize| [0, 1].map(|k| 0.05 * ((((i + 7 * k) * 7919) % 997) as f64 / 498.0 - 1.0));
    let data = samples(500, [0.1, 0.2], noise);
    let found = RateFit::of(&creeps([0.0; 2])).unwrap().to(&data).unwrap();
    let wanted = least_squares_by_search(&data);
    // A sum of squares tells its minimum to the root of rounding.
    assert!(found.p.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-7), "{:?} and {wanted:?}", found.p);
    // By hand: (JᵀJ)⁻¹ = [1, t; t, (1 + e_tc²)/(1 − e_rc)²]/Σv² with t = e_tc/(1 − e_rc).
    let v2: f64 = data.inputs[0].iter().map(|u| (R * u) * (R * u)).sum();
    let (c, kept, t) = (found.covariance.unwrap() * v2, 1.0 - found.p[0], found.p[1]);
    let wanted = [1.0, t / kept, t / kept, (1.0 + t * t) / (kept * kept)];
    assert!(c.iter().zip(wanted).all(|(c, wanted)| (c - wanted).abs() < 1e-9), "{c} and {wanted:?}");
}

#[test]
fn what_is_not_measured_or_does_not_count_changes_nothing() {
    let clean = samples(200, [0.1, 0.2], |_| [0.0; 2]);
    let fit = RateFit::of(&creeps([0.0; 2])).unwrap();
    let mut holes = clean.clone();
    holes.rates[0].iter_mut().step_by(3).for_each(|v| *v = f64::NAN);
    // Rates of the heading that are wrong, without weight.
    holes.rates[2] = vec![1e3; 200];
    holes.deviations[2] = f64::INFINITY;
    let found = fit.to(&holes).unwrap();
    assert!((found.p[0] - 0.1).abs() < 1e-13 && (found.p[1] - 0.2).abs() < 1e-13, "{:?}", found.p);
    // A large deviation lets a wrong rate count little, but not nothing.
    let mut wrong = clean.clone();
    wrong.rates[0].iter_mut().for_each(|v| *v += 0.5);
    let counted = |deviation: f64| {
        wrong.deviations[0] = deviation;
        (fit.to(&wrong).unwrap().p[0] - 0.1).abs()
    };
    let off = [1.0, 10.0, 100.0].map(counted);
    assert!(off[0] > 10.0 * off[1] && off[1] > 50.0 * off[2] && off[2] > 0.0, "{off:?}");
}

#[test]
fn a_direction_left_open_is_said_and_bad_samples_are_refused() {
    // At a standstill nothing is learned.
    let mut still = samples(10, [0.1, 0.2], |_| [0.0; 2]);
    still.inputs[0] = vec![0.0; 10];
    still.rates[0] = vec![0.0; 10];
    still.rates[1] = vec![0.0; 10];
    let fit = RateFit::of(&creeps([0.05, 0.0])).unwrap();
    let found = fit.to(&still).unwrap();
    assert!(found.covariance.is_none() && found.p == [0.05, 0.0]);
    let refused = |change: fn(&mut RateSamples)| {
        let mut bad = samples(10, [0.1, 0.2], |_| [0.0; 2]);
        change(&mut bad);
        fit.to(&bad).unwrap_err().exit_code() == 2
    };
    assert!(refused(|s| s.states[0][3] = f64::NAN));
    assert!(refused(|s| s.inputs[0].truncate(9)));
    assert!(refused(|s| s.deviations[1] = 0.0));
    assert!(refused(|s| s.rates[1][0] = f64::INFINITY));
    assert!(refused(|s| s.rates.iter_mut().for_each(Vec::clear)));
    let fixed = Model::new("unicycle", &[("wheel_radius", R)]).unwrap();
    assert!(RateFit::of(&fixed).err().is_some_and(|e| e.exit_code() == 2));
}
