//! Effects: neutral at zero, felt elsewhere, each different from every other except where stated.

use crate::models::{library, machines, machines_with_effects};
use creepage::effects::{self, Applied, Effect};
use creepage::formula::Symbol;
use creepage::model::{Equations, Model};
use nalgebra::{DMatrix, DVector};

/// Situations to compare motions in: state and inputs from a fixed sequence of numbers within −1 … 1.
fn numbers() -> impl Iterator<Item = f64> {
    (1..).map(|k: i32| (f64::from(k) * 0.618_033_988_749_894_9).fract() * 2.0 - 1.0)
}

/// A model with compiled equations and its hidden states at rest or anywhere.
struct Compiled {
    equations: Equations,
    hidden: Vec<Symbol>,
}

impl Compiled {
    fn of(model: &Model, free: &[Symbol]) -> Self {
        let equations = model.equations(free).unwrap();
        let hidden = equations.states[equations.visible..].to_vec();
        Self { equations, hidden }
    }

    /// Rates, outputs and delay in many situations; hidden states as `hidden` gives them.
    fn motion(&self, p: &[f64], hidden: Hidden) -> Vec<f64> {
        let mut all = Vec::new();
        let mut next = numbers();
        let e = &self.equations;
        for _ in 0..12 {
            let mut w = e.workspace(p);
            let mut z: Vec<f64> = next.by_ref().take(e.visible).map(|x| 3.2 * x).collect();
            let size = |s: &Symbol| if s.as_str().starts_with("steering_angle") { 0.9 } else { 4.0 };
            let u: Vec<f64> = e.inputs.iter().zip(next.by_ref()).map(|(s, x)| size(s) * x).collect();
            let other: Vec<f64> = next.by_ref().take(2).collect();
            z.extend(self.hidden.iter().zip(&other).map(|(_, x)| if hidden == Hidden::Zero { 0.0 } else { *x }));
            let mut rates = vec![0.0; e.n()];
            e.rates(&mut w, &z, &u, &mut rates);
            if hidden == Hidden::Settled {
                settle(e, &mut z, &u, p);
                e.rates(&mut w, &z, &u, &mut rates);
                rates.truncate(e.visible);
            }
            all.extend(rates);
            all.extend(&e.outputs(&mut w, &z)[..e.visible]);
            all.push(e.delay(&mut w)[0]);
        }
        all
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Hidden {
    Zero,
    Anywhere,
    /// Where its rate is zero.
    Settled,
}

/// Newton's method on the rates of the hidden states, one after the other.
fn settle(e: &Equations, z: &mut [f64], u: &[f64], p: &[f64]) {
    let (n, m) = (e.n(), e.n() + e.inputs.len() + e.free.len());
    for _ in 0..20 {
        for k in e.visible..n {
            let mut w = e.workspace(p);
            let values = e.rates_and_jacobian(&mut w, z, u);
            z[k] -= values[k] / values[n + k * m + k];
        }
    }
}

fn with(model: &Model, e: &Effect, trailer: Option<usize>, values: Vec<f64>) -> Model {
    model.clone().with_effect(Applied::new(e, trailer, values))
}

fn sizes(e: &Effect) -> Vec<f64> {
    e.parameters.values().map(|p| p.size).collect()
}

fn greatest_difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, |m, d| if d.is_nan() { f64::INFINITY } else { m.max(d) })
}

/// Visible rates, outputs and delay.
fn visible(model: &Model, hidden: Hidden) -> Vec<f64> {
    let c = Compiled::of(model, &[]);
    let (n, all, seen) = (c.equations.n(), c.motion(&[], hidden), c.equations.visible);
    let block = if hidden == Hidden::Settled { 2 * seen + 1 } else { n + seen + 1 };
    all.chunks(block).flat_map(|b| [&b[..seen], &b[block - seen - 1..]].concat()).collect()
}

#[test]
fn every_effect_vanishes_where_its_parameters_are_neutral() {
    for (model, e, trailer) in machines_with_effects() {
        // A divisor stays where it is: an effect with a state vanishes as another parameter, or in the limit.
        let over = |name: &str| e.changes.values().any(|f| f.to_string().contains(&format!("/{name}")));
        let divides = |name: &str| over(name) || e.states.values().any(|s| s.rate.mentions(&name.into()));
        let values = e.parameters.iter().map(|(n, p)| if p.positive && divides(n) { p.size } else { 0.0 }).collect();
        if e.parameters.iter().all(|(n, p)| p.positive && divides(n)) {
            continue;
        }
        let ideal = visible(&model, Hidden::Zero);
        let neutral = visible(&with(&model, e, trailer, values), Hidden::Zero);
        assert_eq!(greatest_difference(&ideal, &neutral), 0.0, "{} on {}", e.id, model.vehicle.id);
    }
}

#[test]
fn effects_with_a_relaxation_approach_their_limit() {
    let mut seen = 0;
    for (model, e, trailer) in machines_with_effects() {
        let limit = match e.id.as_str() {
            "cornering-creep" | "traction-creep" => model.clone(),
            "relaxation-length" => with(&model, effects::named("traverse-creep").unwrap(), None, vec![0.03]),
            _ => continue,
        };
        seen += 1;
        let limit = visible(&limit, Hidden::Settled);
        let distance = |small: f64| {
            let values = e.parameters.values().map(|p| if p.positive { small } else { 0.03 }).collect();
            greatest_difference(&visible(&with(&model, e, trailer, values), Hidden::Settled), &limit)
        };
        let (far, near) = (distance(1e-4), distance(1e-6));
        assert!(near < 1e-3 && near <= 0.02 * far + 1e-12, "{} on {}: {far}, {near}", e.id, model.vehicle.id);
    }
    // A disk has no sideways motion, and a synchro drive's forward speed is not that of its wheels.
    let expected = |m: &Model| match m.vehicle.id.as_str() {
        "disk" => 1,
        "synchro-drive" | "hopper" | "mecanum" => 0,
        // Across the body is not across its rear wheels.
        "four-wheel-steering" => 2,
        _ => 3,
    };
    assert_eq!(seen, machines().iter().map(expected).sum::<usize>());
}

#[test]
fn every_effect_is_felt_away_from_neutral() {
    for (model, e, trailer) in machines_with_effects() {
        let ideal = visible(&model, Hidden::Zero);
        let changed = visible(&with(&model, e, trailer, sizes(e)), Hidden::Anywhere);
        assert!(greatest_difference(&ideal, &changed) > 1e-5, "{} on {}", e.id, model.vehicle.id);
    }
}

/// Effects that are the same under a change of parameter.
///
/// A steering offset and a front traverse creep are not among them: they differ on the tricycle.
const EQUIVALENT: [[&str; 2]; 1] = [["rotation-creep", "wheel-radius"]];

#[test]
fn two_effects_differ_on_some_vehicle_or_are_listed_as_the_same() {
    // An effect on one input is one of a vehicle only once the input is named.
    let all: Vec<Effect> = library().iter().filter(|e| !e.per_input).cloned().collect();
    // Those of forces are told apart in tests/dynamics/lowered.rs.
    let all: Vec<Effect> = all.into_iter().filter(|e| machines().iter().any(|m| applies(m, e))).collect();
    for (i, a) in all.iter().enumerate() {
        for b in &all[..i] {
            let listed = EQUIVALENT.iter().any(|pair| pair.contains(&a.id.as_str()) && pair.contains(&b.id.as_str()));
            let same = imitated(a, b) && imitated(b, a);
            assert_eq!(same, listed, "{} and {}", a.id, b.id);
        }
    }
}

/// Whether some parameters of `b` give the motion of `a` on every vehicle that `a` applies to.
fn imitated(a: &Effect, b: &Effect) -> bool {
    let trailer = |e: &Effect| e.per_trailer.then_some(2);
    machines().iter().filter(|m| applies(m, a)).all(|m| {
        applies(m, b) && {
            let target = Compiled::of(&with(m, a, trailer(a), sizes(a)), &[]).motion(&[], Hidden::Anywhere);
            let applied = Applied::new(b, trailer(b), sizes(b));
            let free = applied.parameters();
            let other = Compiled::of(&m.clone().with_effect(applied), &free);
            starts(b).into_iter().any(|start| fits(&other, start, &target))
        }
    })
}

fn applies(model: &Model, e: &Effect) -> bool {
    !model.applicable(std::slice::from_ref(e)).is_empty()
}

fn starts(e: &Effect) -> Vec<Vec<f64>> {
    [e.starts(), vec![sizes(e), sizes(e).iter().map(|x| -x).collect()]].concat()
}

/// Gauss–Newton by differences, from a start near the solution if there is one.
fn fits(model: &Compiled, start: Vec<f64>, target: &[f64]) -> bool {
    let residual = |p: &[f64]| -> Option<DVector<f64>> {
        let found = model.motion(p, Hidden::Anywhere);
        let same_size = found.len() == target.len();
        let r =
            same_size.then(|| DVector::from_iterator(target.len(), found.iter().zip(target).map(|(a, b)| a - b)))?;
        r.iter().all(|x| x.is_finite()).then_some(r)
    };
    let mut p = start;
    for _ in 0..25 {
        let Some(r) = residual(&p) else { return false };
        if r.amax() < 1e-9 {
            return true;
        }
        let mut j = DMatrix::zeros(r.len(), p.len());
        for k in 0..p.len() {
            let moved = |h: f64| {
                residual(&p.iter().enumerate().map(|(i, x)| x + if i == k { h } else { 0.0 }).collect::<Vec<_>>())
            };
            let (Some(up), Some(down)) = (moved(1e-6), moved(-1e-6)) else { return false };
            j.set_column(k, &((up - down) / 2e-6));
        }
        let Ok(step) = j.svd(true, true).solve(&r, 1e-12) else { return false };
        p.iter_mut().zip(step.iter()).for_each(|(x, s)| *x -= s);
    }
    residual(&p).is_some_and(|r| r.amax() < 1e-9)
}

#[test]
fn listed_equivalences_hold_with_the_change_of_parameter_stated() {
    // The hopper has no wheel.
    for model in machines().into_iter().filter(|m| m.vehicle.id != "hopper") {
        let all = |id: &str, v: f64| with(&model, effects::named(id).unwrap(), None, vec![v]);
        let steered = |id: &str| applies(&model, effects::named(id).unwrap());
        assert_eq!(steered("steering-offset"), steered("front-traverse-creep") || model.vehicle.id == "synchro-drive");
        if steered("front-traverse-creep") {
            let [a, b] = [all("front-traverse-creep", 0.2), all("steering-offset", 0.2f64.atan())]
                .map(|m| visible(&m, Hidden::Zero));
            // The tricycle's steered wheel also drives: v_l is r·θ̇·(cos δ − e·sin δ), not r·θ̇·cos(δ + arctan e).
            let same = greatest_difference(&a, &b) < 1e-12;
            assert_eq!(same, model.vehicle.id != "tricycle", "{}", model.vehicle.id);
        }
        let [a, b] = [all("rotation-creep", 0.03), all("wheel-radius", -0.03)].map(|m| visible(&m, Hidden::Zero));
        assert!(greatest_difference(&a, &b) < 1e-12, "{}", model.vehicle.id);
    }
}
