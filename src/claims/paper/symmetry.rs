//! Section 4, last paragraph: constraints that are symmetries, and their geometry.

use crate::claims::simulated::{model, undefined};
use crate::claims::{
    Claim, DerivedFormulas, Fault, Outcome, Sampling, Statement, Status, Verdict, near, proving, value_said,
};
use crate::connection::{Axis, Connection, Matrix, Path, PlanarBody, RotationConnection, floating_energy, turned};
use crate::formula::{Exact, Expr, Symbol};
use crate::mechanism::{Mechanism, Momentum, Nonholonomy, Point};
use crate::motion::driven;
use crate::vehicles;
use proptest::prelude::*;
use std::f64::consts::TAU;

const CHAPTER: &str = "09b-symmetry";
const PLACE: &str = "section 4, last paragraph";
const MOMENTUM: &str = "src/mechanism/momentum.rs";
const CONNECTION: &str = "src/connection/abelian.rs";
const ROTATION: &str = "src/connection/rotation.rs";

pub(crate) fn claims() -> Vec<Claim> {
    vec![hopper(), curvature(), phase(), one_hinge(), two_hinges(), cat(), cat_loop()]
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
        numbers(s, hopper.and_then(|m| m.nonholonomy(&point(), 5).ok()))
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

/// Numbers of what a mechanism's constraints leave.
fn numbers(s: &Statement, found: Option<Nonholonomy>) -> Outcome {
    let Some(found) = found.filter(|f| f.growth.is_final && f.counts_agree()) else {
        return Outcome::Undefined("the numbers are not proved".into());
    };
    let digits = found.growth.dimensions.iter().fold(0, |n, d| 10 * n + d);
    let value = |name: &str| match name {
        "growth" => Some(digits),
        "holonomic" => Some(found.holonomic),
        "nonholonomic" => Some(found.nonholonomic),
        _ => None,
    };
    Outcome::all(s.in_question().iter().map(|e| match value(&e.left.to_string()) {
        None => Outcome::Undefined(format!("{} is not counted", e.left)),
        Some(n) if e.right.as_number() == Expr::int(n as i64).as_number() => Outcome::PROVED,
        Some(n) => Outcome::failure(format!("{} is {n}, the statement says {}", e.left, e.right)),
    }))
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

/// A chain of uniform rods of mass 1 and length 1, each at an angle from the one before; momentum, shape.
fn chain(links: usize) -> crate::Result<(Momentum, Vec<Symbol>)> {
    let shape: Vec<Symbol> = (1..links).map(|k| Symbol::new(&format!("r_{k}"))).collect();
    let heading = |k: usize| shape[..k].iter().fold(Expr::int(0), |sum, r| &sum + &Expr::sym(r.clone()));
    let half = &Expr::int(1) / &Expr::int(2);
    let along = |k: usize| {
        let f = |f, zero: i64| if k == 0 { Expr::int(zero) } else { Expr::call(f, &heading(k)) };
        [f(crate::formula::Fun::Cos, 1), f(crate::formula::Fun::Sin, 0)]
    };
    let place = |k: usize, c: usize| {
        let before = (0..k).fold(Expr::int(0), |sum, j| &sum + &along(j)[c]);
        &before + &(&half * &along(k)[c])
    };
    let body = |k: usize| PlanarBody {
        mass: Expr::int(1),
        inertia: &Expr::int(1) / &Expr::int(12),
        place: [place(k, 0), place(k, 1)],
        angle: heading(k),
    };
    let bodies: Vec<PlanarBody> = (0..links).map(body).collect();
    let energy = floating_energy("phi", &shape, &bodies)?;
    Ok((Momentum::of(&energy, &[("phi".into(), Expr::int(1))])?, shape))
}

/// The chain as a mechanism, looked at where every sine is rational.
fn counted(links: usize) -> Option<Nonholonomy> {
    let (momentum, shape) = chain(links).ok()?;
    let constraint = momentum.constraint("angular momentum", "e_sc").ok()?;
    let coordinates = std::iter::once(Symbol::from("phi")).chain(shape.iter().cloned()).collect();
    let angles = [Exact::direction(4.into(), 3.into()), Exact::direction(12.into(), (-5).into())];
    let at = shape.iter().zip(angles).fold(Point::default(), |p, (r, angle)| p.with(r.clone(), angle));
    Mechanism { coordinates, constraints: vec![constraint] }.nonholonomy(&at, 5).ok()
}

fn one_hinge() -> Claim {
    base("two-link", Status::Sampled, "two bodies on one hinge, floating freely, are holonomic: a closed loop of the hinge brings both back")
        .under("angular momentum zero; one shape variable")
        .remark("Any form in one variable is closed, so that this needs no particular masses; the loop is a check of the program.")
        .code(&["src/connection/bodies.rs", CONNECTION])
        .tests(&["tests/symmetry/bodies.rs"])
        .proof("brackets: none, so one constraint of one", &[("growth", "1"), ("holonomic", "1"), ("nonholonomic", "0")], |s, _| {
            numbers(s, counted(2))
        })
        .sample("drift after generated closed loops of the hinge, under 1e-12", &[("drift", "0")], |s, sampling| {
            let Ok((momentum, shape)) = chain(2) else { return Outcome::Undefined("there is no chain".into()) };
            let connection = Connection::of(&momentum, &shape);
            let loops = prop::array::uniform4(-1.5..1.5f64);
            sampling.at_most(10).cases(loops, |c| vec![("c".into(), format!("{c:?}"))], |c| {
                let path = Path::new(&[("r_1", "c_0 + c_1*sin(t) + c_2*cos(2*t + c_3)")], [0.0, TAU]);
                let names = ["c_0", "c_1", "c_2", "c_3"];
                let values: Vec<(&str, f64)> = names.into_iter().zip(*c).collect();
                let found = connection.clone().and_then(|a| a.phase(&path?, &values)).map_err(|e| undefined(&e))?;
                within("drift", found, value_said(s, "drift", &|_| None)?, 1e-12)
            })
        })
}

fn two_hinges() -> Claim {
    base("three-link", Status::Sampled, "three bodies on two hinges, floating freely, are not holonomic: the phase of a small loop is its area times the curvature")
        .under("uniform rods of mass 1 and length 1, angular momentum zero; angles of each hinge from straight")
        .remark(
            "A curvature of −0.00609466 at (0.7, −0.4) is on record, without the masses it is for; for equal uniform \
             rods it is −0.00676934.",
        )
        .code(&["src/connection/bodies.rs", CONNECTION])
        .tests(&["tests/symmetry/bodies.rs"])
        .proof("by brackets", &[("growth", "23"), ("nonholonomic", "1")], |s, _| numbers(s, counted(3)))
        .sample(
            "circles of radius 0.04 and 0.02 about (0.7, −0.4): the error of phase/area falls with the square of the radius",
            &[("curvature", "-0.00676934"), ("order", "2")],
            small_loops,
        )
}

/// The curvature of the chain of three at a point, and the order at which phase/area tends to it.
fn small_loops(s: &Statement, _: &Sampling) -> Outcome {
    let found = || -> crate::Result<[f64; 2]> {
        let (momentum, shape) = chain(3)?;
        let connection = Connection::of(&momentum, &shape)?;
        let at = |name: &Symbol| if name.as_str() == "r_1" { 0.7 } else { -0.4 };
        let curvature = connection.curvature(0, 1).eval(&at).unwrap_or(f64::NAN);
        let circle = Path::new(&[("r_1", "0.7 + b*cos(t)"), ("r_2", "-0.4 + b*sin(t)")], [0.0, TAU])?;
        let error = |b: f64| -> crate::Result<f64> {
            let phase = connection.phase(&circle, &[("b", b)])?;
            Ok(phase / (TAU / 2.0 * b * b) - curvature)
        };
        Ok([curvature, (error(0.04)? / error(0.02)?).log2()])
    };
    let Ok([curvature, order]) = found() else { return Outcome::Undefined("there is no chain".into()) };
    let said = |name: &str| s.number(name).unwrap_or(f64::NAN);
    all_of([within("curvature", curvature, said("curvature"), 6e-9), within("order", order, said("order"), 0.02)])
}

/// Bent by γ towards τ, without twist.
fn bent() -> Matrix {
    let [gamma, tau] = ["gamma", "tau"].map(Expr::sym);
    turned(&[(Axis::Z, tau.clone()), (Axis::Y, gamma), (Axis::Z, -&tau)])
}

/// Two halves with moments a, a, c of either.
fn halves(moments: [&str; 3]) -> RotationConnection {
    let half = moments.map(|m| Expr::parse(m).unwrap_or_default());
    RotationConnection::of_two_bodies(&half, &half, &bent(), &["gamma".into(), "tau".into()])
}

fn cat() -> Claim {
    let cat = halves(["a", "a", "c"]);
    // On the plane tau = 0 every direction of bending is met: the cat has no preferred one.
    let ahead = |e: &Expr| e.substitute(&|s| (s.as_str() == "tau").then(|| Expr::int(0)));
    let derived = ["x", "y", "z"].iter().enumerate().fold(DerivedFormulas::default(), |m, (k, axis)| {
        m.with(&format!("bend_{axis}"), ahead(&cat.form[0][k])).with(&format!("round_{axis}"), ahead(&cat.form[1][k]))
    });
    let curve = cat.curvature(0, 1)[2].derivative(&"gamma".into());
    let small = DerivedFormulas::default().with("curvature_z", curve).with_text("gamma", "0").with_text("tau", "0");
    base(
        "falling-cat",
        Status::Proved,
        "two axisymmetric halves without twist, J·ω + Q·J·Qᵀ·(ω + ω_Q) = 0: a falling cat turns by going round with its bend",
    )
    .under("equal halves with moments a, a, c; bent by γ towards τ, here at τ = 0; angular momentum zero")
    .code(&[ROTATION, "src/connection/space.rs"])
    .tests(&["tests/symmetry/cat.rs"])
    .proof(
        "local form in the frame of the first half, bending and going round",
        &[
            ("bend_x", "0"),
            ("bend_y", "-1/2"),
            ("bend_z", "0"),
            ("round_x", "(1/2 + (c - a)*(1 - cos(gamma))/(2*(a*(1 - cos(gamma)) + c*(1 + cos(gamma)))))*sin(gamma)"),
            ("round_y", "0"),
            (
                "round_z",
                "(c - a)*(1 - cos(gamma))*(1 + cos(gamma))/(2*(a*(1 - cos(gamma)) + c*(1 + cos(gamma)))) - (1 - cos(gamma))/2",
            ),
        ],
        proving(derived),
    )
    .proof(
        "the slope of the curvature where the bend begins: a small loop turns the cat by (1/4 − a/(2c))·π·γ², −7/4·π·γ² for c = a/4",
        &[("curvature_z", "1/4 - a/(2*c)")],
        proving(small),
    )
}

fn cat_loop() -> Claim {
    base("falling-cat-loop", Status::Sampled, "once round with the bend γ turns the cat by −5.4848·γ² about its axis at γ = 0.05 and by 3.0196 in all at γ = 1")
        .under("J = diag(1, 1, 1/4)")
        .code(&[ROTATION])
        .tests(&["tests/symmetry/cat.rs"])
        .sample(
            "orientation integrated along the loop",
            &[("about_z", "-5.4848"), ("angle", "3.0196")],
            |s, _| {
                let cat = halves(["1", "1", "1/4"]);
                let turned = |gamma: f64| {
                    let path = Path::new(&[("gamma", "g"), ("tau", "t")], [0.0, TAU]);
                    path.and_then(|path| cat.holonomy(&path, &[("g", gamma)]))
                };
                let (Ok(small), Ok(large)) = (turned(0.05), turned(1.0)) else {
                    return Outcome::Undefined("the cat cannot be turned".into());
                };
                let said = |name: &str| s.number(name).unwrap_or(f64::NAN);
                all_of([
                    within("about_z", small.vector()[2] / 0.0025, said("about_z"), 5e-5),
                    within("angle", large.angle(), said("angle"), 5e-5),
                ])
            },
        )
        .sample(
            "the same as one turn about a fixed axis, because going round repeats itself in a frame that goes round too",
            &[("angle", "2*pi*(1 - sqrt(w_x^2 + (1 + w_z)^2))")],
            |s, sampling| {
                let cat = halves(["a", "a", "c"]);
                let bodies = (0.1..1.2f64, 0.5..2.0f64, 0.2..1.0f64);
                let show = |(g, a, c): &(f64, f64, f64)| vec![("gamma, a, c".into(), format!("{g}, {a}, {c}"))];
                sampling.at_most(4).cases(bodies, show, |(gamma, a, c)| {
                    let values = [("g", *gamma), ("a", *a), ("c", *c)];
                    let path = Path::new(&[("gamma", "g"), ("tau", "t")], [0.0, TAU]);
                    let found = path.and_then(|path| cat.holonomy(&path, &values)).map_err(|e| undefined(&e))?;
                    let at_start = |name: &Symbol| match name.as_str() {
                        "gamma" => *gamma,
                        "a" => *a,
                        "c" => *c,
                        _ => 0.0,
                    };
                    let w = |k: usize| cat.form[1][k].eval(&at_start);
                    let at = |name: &str| match name {
                        "pi" => Some(std::f64::consts::PI),
                        "w_x" => w(0),
                        "w_z" => w(2),
                        _ => None,
                    };
                    near("angle", found.angle(), value_said(s, "angle", &at)?, 1e-10)
                })
            },
        )
        .sabotaged_by(&[
            &[("angle", "2*pi*(1 + sqrt(w_x^2 + (1 + w_z)^2))")],
            &[("angle", "2*pi*(1 - sqrt(w_x^2 + (1 - w_z)^2))")],
            &[("angle", "2*pi*(1 - sqrt(w_x^2 - (1 + w_z)^2))")],
            &[("angle", "2*pi*(1 - sqrt((1 + w_z)^2))")],
            &[("angle", "pi*(1 - sqrt(w_x^2 + (1 + w_z)^2))")],
        ])
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
