//! Section 4, last paragraph: constraints that are symmetries, and their geometry; the hopper.

use crate::claims::count_check::compare_with;
use crate::claims::counted::Counted;
use crate::claims::simulated::{model, undefined};
use crate::claims::{
    Claim, DerivedFormulas, Fault, Outcome, Sampling, Statement, Status, Verdict, proving, value_said,
};
use crate::connection::{Connection, Path};
use crate::formula::{Exact, Expr, Symbol};
use crate::mechanism::{Momentum, Point};
use crate::motion::driven;
use crate::vehicles;
use proptest::prelude::*;
use std::f64::consts::TAU;

const CHAPTER: &str = "09b-symmetry";
const PLACE: &str = "section 4, last paragraph";
const MOMENTUM: &str = "src/mechanism/momentum.rs";
pub(super) const CONNECTION: &str = "src/connection/abelian.rs";

pub(crate) fn claims() -> Vec<Claim> {
    vec![hopper(), curvature(), phase()]
}

pub(crate) fn base(id: &str, status: Status, says: &str) -> Claim {
    Claim::new(id, status, says).at(PLACE).chapter(CHAPTER)
}

/// The energy that the catalogue's hopper is described by.
const ENERGY: &str = "I*psi'^2/2 + m*(l + d)^2*(psi' + theta')^2/2 + m*l'^2/2";

/// Body and leg turn together.
pub(crate) fn turn() -> [(Symbol, Expr); 1] {
    [("psi".into(), Expr::int(1))]
}

/// The momentum of the hopper, and its shape.
pub(crate) fn hopping() -> Option<(Momentum, [Symbol; 2])> {
    let momentum = Momentum::of(&super::blade::formula(ENERGY), &turn()).ok()?;
    Some((momentum, ["l", "theta"].map(Symbol::from)))
}

fn hopper() -> Claim {
    let slot = |name: &str| {
        let constraint = vehicles::named("hopper").and_then(|v| v.constraints.first());
        constraint.and_then(|c| c.form.slot(name)).map(crate::mechanism::Part::expr).unwrap_or_default()
    };
    let derived = DerivedFormulas::of("hopper").with("sigma", slot("sigma")).with("s", slot("s")).with("h", slot("h"));
    base(
        "eq-20-hopper",
        Status::Proved,
        "the angular momentum of a hopper in flight is a constraint of form (20) with (q₁, q₂, q₃) = (ψ, l, θ)",
    )
    .about(&[20])
    .under("no moment acts in flight; the momentum is zero at take-off")
    .code(&[MOMENTUM, "src/model/own.rs", "src/vehicles/catalogue.toml"])
    .tests(&["tests/symmetry/hopper.rs", "tests/symmetry/momentum.rs"])
    .proof(
        "σ(l), derived from the kinetic energy and the turn that leaves it unchanged, and the motion of the vehicle",
        &[
            ("s", "I + m*(l + d)^2"),
            ("h", "m*(l + d)^2*theta'"),
            ("sigma", "-(1 - e_sc)*m*(l + d)^2/(I + m*(l + d)^2)"),
            ("psi'", "-(1 - e_sc)*m*(l + d)^2/(I + m*(l + d)^2)*theta'"),
        ],
        proving(derived),
    )
}

fn curvature() -> Claim {
    let connection = hopping().and_then(|(momentum, shape)| Connection::of(&momentum, &shape).ok());
    let bent = connection.map(|c| c.curvature(0, 1)).unwrap_or_default();
    let point = || {
        let lengths = [("I", 3, 2), ("m", 2, 5), ("d", 3, 5), ("l", 1, 2)];
        lengths.iter().fold(Point::default(), |p, (name, n, d)| p.with(*name, Exact::ratio(*n, *d)))
    };
    let counts = move |s: &Statement, _: &Sampling| {
        let hopper = vehicles::named("hopper").map(|v| crate::model::mechanism(v, 0));
        compare_with(s, hopper.and_then(|m| Counted::of("hopper", m, point(), 5)))
    };
    base("hopper-curvature", Status::Proved, "the hopper's constraint is nonholonomic: its curvature dσ/dl is not zero")
        .under("I > 0, m > 0, l + d > 0")
        .code(&[CONNECTION, "src/mechanism/growth_vector.rs"])
        .tests(&["tests/symmetry/connection.rs"])
        .proof(
            "by exact derivatives of the local form",
            &[("curvature", "-2*I*m*(l + d)/(I + m*(l + d)^2)^2")],
            proving(DerivedFormulas::default().with("curvature", bent)),
        )
        .proof("by brackets, a vector (2, 3) written 23", &[("growth", "23"), ("nonholonomic", "1")], counts)
}

/// A loop of the hopper's leg: mean length, swing in length and angle, phase between them; I, m, d.
type Hop = ([f64; 4], [f64; 3]);

fn hops() -> impl Strategy<Value = Hop> {
    let swing = (0.3..0.8f64, 0.05..0.25f64, -1.0..1.0f64, -3.0..3.0f64);
    let body = [0.3..3.0f64, 0.1..1.0f64, 0.2..0.9f64];
    (swing, body).prop_map(|((l, a, b, lag), body)| ([l, a, b, lag], body))
}

fn shown((swing, body): &Hop) -> Vec<(String, String)> {
    let list = |name: &str, v: &[f64]| (name.to_string(), format!("{v:?}"));
    vec![list("l, swings, lag", swing), list("I, m, d", body)]
}

/// The phase as ∮ σ dθ, as ∬ dσ/dl dl dθ, and by simulating the vehicle.
fn three_ways((swing, [i, m, d]): &Hop) -> Result<[f64; 3], Fault> {
    let [l, a, b, lag] = swing;
    let missing = || Fault::Undefined("the hopper has no connection".into());
    let (momentum, shape) = hopping().ok_or_else(missing)?;
    let connection = Connection::of(&momentum, &shape).map_err(|e| undefined(&e))?;
    let (length, angle) = ("l_0 + a*cos(t)", "b*sin(t + lag)");
    let path = Path::new(&[("l", length), ("theta", angle)], [0.0, TAU]).map_err(|e| undefined(&e))?;
    let values = [("I", *i), ("m", *m), ("d", *d), ("l_0", *l), ("a", *a), ("b", *b), ("lag", *lag)];
    let line = connection.phase(&path, &values).map_err(|e| undefined(&e))?;
    let area = connection.phase_by_area(&path, &values).map_err(|e| undefined(&e))?;
    let body = [("body_inertia", *i), ("leg_mass", *m), ("leg_offset", *d)];
    let hopper = model("hopper", &body, &[], &[]).map_err(|e| undefined(&e))?;
    let inputs = [("leg_length", "c_0 + c_1*cos(t)"), ("leg_angle_rate", "c_2*cos(t + c_3)")];
    let motion = driven(&hopper, &inputs, swing, &[0.0; 3], &[0.0, TAU]).map_err(|e| undefined(&e))?;
    Ok([line, area, motion[1][2]])
}

/// Within so much of each other without regard to size.
pub(crate) fn within(what: &str, found: f64, said: f64, tolerance: f64) -> Verdict {
    match (found - said).abs() <= tolerance {
        true => Ok(()),
        false => Err(Fault::False(format!("{what} is {found:.14}, the statement says {said:.14}"))),
    }
}

/// What became of checks of numbers that stand by themselves.
pub(crate) fn all_of(checks: impl IntoIterator<Item = Verdict>) -> Outcome {
    Outcome::all(checks.into_iter().map(|check| match check {
        Ok(()) => Outcome::Holds { cases: 1 },
        Err(Fault::False(says)) => Outcome::failure(says),
        Err(Fault::Undefined(why)) => Outcome::Undefined(why),
        Err(Fault::Outside) => Outcome::Undefined("a number lies outside the hypotheses".into()),
    }))
}

fn phase() -> Claim {
    base(
        "hopper-phase",
        Status::Sampled,
        "the angle by which a loop of the leg turns the body is ∮ σ dθ = ∬ dσ/dl dl dθ",
    )
    .under("momentum zero; smooth closed loops")
    .code(&[CONNECTION, "src/connection/quadrature.rs", "src/motion/simulate.rs"])
    .tests(&["tests/symmetry/hopper.rs", "tests/symmetry/connection.rs"])
    .sample(
        "l = 1/2 + 3/10·cos t, θ = 4/5·sin t, I = 1, m = 2/5, d = 3/5: both integrals to 1e-12",
        &[("line", "-0.29741719748508"), ("area", "-0.29741719748508")],
        |s, _| {
            let said = |name: &str| s.number(name).unwrap_or(f64::NAN);
            all_of([three_ways(&([0.5, 0.3, 0.8, 0.0], [1.0, 0.4, 0.6])).and_then(|[line, area, _]| {
                within("line", line, said("line"), 1e-12)?;
                within("area", area, said("area"), 1e-12)
            })])
        },
    )
    .sample(
        "generated bodies and loops: line integral, surface integral and the simulated vehicle",
        &[("area", "line"), ("simulated", "line")],
        |s, sampling| {
            sampling.at_most(8).cases(hops(), shown, |hop| {
                let [line, area, simulated] = three_ways(hop)?;
                let at = |name: &str| (name == "line").then_some(line);
                within("area", area, value_said(s, "area", &at)?, 1e-12)?;
                within("simulated", simulated, value_said(s, "simulated", &at)?, 1e-10)
            })
        },
    )
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_hop_is_shown_with_all_its_numbers() {
        let shown = super::shown(&([0.5, 0.25, -1.0, 2.0], [1.0, 0.4, 0.6]));
        let said: Vec<(&str, &str)> = shown.iter().map(|(n, t)| (n.as_str(), t.as_str())).collect();
        assert_eq!(said, [("l, swings, lag", "[0.5, 0.25, -1.0, 2.0]"), ("I, m, d", "[1.0, 0.4, 0.6]")]);
    }
}
