//! The estimates of chapter 7: how far creep can put a vehicle from where it would be without.

use creepage::effects::{self, Applied};
use creepage::formula::Expr;
use creepage::model::{Model, Trailer};
use creepage::motion::{Formulas, Integrator, simulate};
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

/// Pieces into which a drive is cut: in each the coefficients are others.
const PIECES: usize = 6;
/// Length of a piece, s.
const PIECE: f64 = 0.5;
/// Steps in which an integral over a piece is taken.
const STEPS: usize = 200;

fn cases(n: u32) -> TestRunner {
    TestRunner::new(Config { cases: n, failure_persistence: None, ..Config::default() })
}

fn effect(id: &str, values: &[f64]) -> Applied {
    Applied::new(effects::named(id).unwrap(), None, values.to_vec())
}

/// The states at the ends of all pieces of a drive whose model changes from piece to piece.
fn pieces(models: &[Model], inputs: &Formulas, start: &[f64]) -> Vec<Vec<f64>> {
    let exact = Integrator::default().with_tolerance(1e-12, 1e-13);
    let mut states = vec![start.to_vec()];
    for (k, model) in models.iter().enumerate() {
        let span = [k as f64 * PIECE, (k + 1) as f64 * PIECE];
        let equations = model.equations(&[]).unwrap();
        let path = simulate(&equations, &[], inputs, &states[k], &span, &exact).unwrap();
        states.push(path[1].clone());
    }
    states
}

/// ∫ f dt over a piece by Simpson's rule.
fn integral(k: usize, f: impl Fn(f64) -> f64) -> f64 {
    let h = PIECE / STEPS as f64;
    let weight = |i: usize| if i == 0 || i == STEPS { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
    (0..=STEPS).map(|i| h / 3.0 * weight(i) * f(k as f64 * PIECE + h * i as f64)).sum()
}

fn formulas(texts: &[&str], c: &[f64]) -> Formulas {
    let constants: Vec<_> = c.iter().enumerate().map(|(i, v)| (format!("c_{i}").as_str().into(), *v)).collect();
    let parsed: Vec<Expr> = texts.iter().map(|t| Expr::parse(t).unwrap()).collect();
    Formulas::new(&parsed, &constants).unwrap()
}

/// |z_c − z_i| ≤ r·∫|θ̇|·|κ − 1| dt for coefficients that change, |κ − 1|² = e_rc² + (1 − e_rc)²·e_tc²; where a piece
/// goes straight on and nothing changes both sides are equal.
#[test]
fn a_wheel_whose_creep_changes_stays_within_its_bound() {
    let (r, creep) = (0.5, || proptest::collection::vec((-0.3..0.3f64, -0.3..0.3f64), PIECES));
    let mut closest: f64 = 0.0;
    let drives = (proptest::collection::vec(-2.0..2.0f64, 4), creep());
    let checked = std::cell::RefCell::new(&mut closest);
    cases(50)
        .run(&drives, |(c, creeps)| {
            let wheel = |(e_rc, e_tc): &(f64, f64)| {
                let wheel = Model::new("unicycle", &[("wheel_radius", r)]).unwrap();
                wheel.with_effect(effect("rotation-creep", &[*e_rc])).with_effect(effect("traverse-creep", &[*e_tc]))
            };
            let inputs = formulas(&["c_0 + c_1*sin(2*t)", "c_2 + c_3*cos(t)"], &c);
            let crept = pieces(&creeps.iter().map(wheel).collect::<Vec<_>>(), &inputs, &[0.0; 3]);
            let ideal = pieces(&vec![wheel(&(0.0, 0.0)); PIECES], &inputs, &[0.0; 3]);
            let mut bound = 0.0;
            for k in 0..PIECES {
                let (e_rc, e_tc) = creeps[k];
                let off = e_rc.hypot((1.0 - e_rc) * e_tc);
                bound += integral(k, |t| r * (c[0] + c[1] * (2.0 * t).sin()).abs() * off);
                let (z, z_i) = (&crept[k + 1], &ideal[k + 1]);
                let apart = (z[0] - z_i[0]).hypot(z[1] - z_i[1]);
                prop_assert!(apart <= bound * (1.0 + 1e-6), "{apart} > {bound}");
                let mut closest = checked.borrow_mut();
                **closest = closest.max(apart / bound);
            }
            Ok(())
        })
        .unwrap();
    assert!(closest > 0.9, "no case comes near its bound: {closest}");
}

/// |Δφ| ≤ (r/a)·∫(|e₁·θ̇₁| + |e₂·θ̇₂|) dt and |Δz| ≤ ∫(|ΔV| + |V_i|·|Δφ|) dt, V = v_l + i·v_t.
#[test]
fn a_differential_drive_stays_within_its_bounds() {
    let (r, a) = (0.1, 0.4);
    let drives = (proptest::collection::vec(-4.0..4.0f64, 4), [-0.2..0.2f64, -0.2..0.2], -0.2..0.2f64);
    cases(50)
        .run(&drives, |(c, [e_2, e_1], e_tc)| {
            let robot = |[left, right]: [f64; 2], e_tc: f64| {
                let robot = Model::new("differential-drive", &[("wheel_radius", r), ("track_width", a)]).unwrap();
                let robot = robot.with_effect(effect("unequal-rotation-creep", &[left, right]));
                robot.with_effect(effect("traverse-creep", &[e_tc]))
            };
            let inputs = formulas(&["c_0 + c_1*cos(2*t)", "c_2 + c_3*t"], &c);
            let rate = |t: f64| [c[0] + c[1] * (2.0 * t).cos(), c[2] + c[3] * t];
            let crept = pieces(&vec![robot([e_2, e_1], e_tc); PIECES], &inputs, &[0.0; 3]);
            let ideal = pieces(&vec![robot([0.0; 2], 0.0); PIECES], &inputs, &[0.0; 3]);
            let (mut turned, mut gone) = (0.0, 0.0);
            for k in 0..PIECES {
                let slip = |t: f64| {
                    let [left, right] = rate(t);
                    r / a * ((e_2 * left).abs() + (e_1 * right).abs())
                };
                let before = turned;
                turned += integral(k, slip);
                // |Δφ| within the piece is at most what it is at its end at most.
                gone += integral(k, |t| {
                    let [left, right] = rate(t);
                    let speed = |l: f64, s: f64| r * (left * (1.0 - l) + right * (1.0 - s)) / 2.0;
                    let (v, v_i) = (speed(e_2, e_1), speed(0.0, 0.0));
                    (v - v_i).hypot(e_tc * v) + v_i.abs() * turned.max(before)
                });
                let (z, z_i) = (&crept[k + 1], &ideal[k + 1]);
                prop_assert!((z[2] - z_i[2]).abs() <= turned * (1.0 + 1e-6), "heading: {} > {turned}", z[2] - z_i[2]);
                let apart = (z[0] - z_i[0]).hypot(z[1] - z_i[1]);
                prop_assert!(apart <= gone * (1.0 + 1e-6), "place: {apart} > {gone}");
            }
            Ok(())
        })
        .unwrap();
}

/// A tenth of every creep makes a tenth of the gap: for a differential drive and for a wheel with three trailers the
/// ratio tends to ten, its own error a tenth each time.
#[test]
fn gaps_are_of_the_first_order_in_the_creeps() {
    let bar = |length| Trailer { length, hitch: 0.0 };
    let drive = |scale: f64| {
        let robot = Model::new("differential-drive", &[("wheel_radius", 0.5), ("track_width", 1.0)]).unwrap();
        let robot = robot.with_effect(effect("unequal-rotation-creep", &[0.1 * scale, -0.05 * scale]));
        robot.with_effect(effect("traverse-creep", &[0.1 * scale]))
    };
    let train = |scale: f64| {
        let wheel = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        let train = wheel.with_trailers(&[bar(1.0), bar(1.2), bar(0.8)]);
        let creeps = (1..=3).map(|i| {
            let effect = effects::named("trailer-traverse-creep").unwrap();
            Applied::new(effect, Some(i), vec![0.05 * scale * i as f64])
        });
        let train = train.with_effect(effect("rotation-creep", &[0.1 * scale]));
        creeps.fold(train, Model::with_effect)
    };
    let exact = Integrator::default().with_tolerance(1e-13, 1e-14);
    let inputs = formulas(&["2 + sin(3*t)", "cos(t) + 1"], &[]);
    type Build<'a> = &'a dyn Fn(f64) -> Model;
    for (name, build) in [("differential drive", &drive as Build), ("three trailers", &train)] {
        let end = |scale: f64| {
            let model = build(scale);
            let start = vec![0.0; 3 + model.trailer_count()];
            simulate(&model.equations(&[]).unwrap(), &[], &inputs, &start, &[0.0, 2.0], &exact).unwrap().pop().unwrap()
        };
        let ideal = end(0.0);
        let gap = |scale: f64| end(scale).iter().zip(&ideal).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        let gaps: Vec<f64> = [1.0, 0.1, 0.01, 0.001].into_iter().map(gap).collect();
        let off: Vec<f64> = gaps.windows(2).map(|g| (g[0] / g[1] - 10.0).abs()).collect();
        assert!(off[2] < 0.01 && off[0] > 1e-3, "{name}: {off:?}");
        assert!((off[1] / off[2] - 10.0).abs() < 1.0, "{name}: {off:?}");
    }
}
