//! Section 4, last paragraph: a chain of hinged rods that floats, and the phase of its loops.

use super::symmetry::{CONNECTION, all_of, base, within};
use crate::claims::count_check::compare_with;
use crate::claims::counted::Counted;
use crate::claims::simulated::undefined;
use crate::claims::{Claim, Outcome, Sampling, Statement, Status, value_said};
use crate::connection::{Connection, Path, PlanarBody, floating_energy};
use crate::formula::{Exact, Expr, Symbol};
use crate::mechanism::{Mechanism, Momentum, Point};
use proptest::prelude::*;
use std::f64::consts::TAU;

pub(crate) fn claims() -> Vec<Claim> {
    vec![one_hinge(), two_hinges()]
}

/// A rod with its centre of mass in its middle.
#[derive(Clone, Copy)]
struct Rod {
    mass: (i64, i64),
    length: (i64, i64),
    inertia: (i64, i64),
}

const UNIFORM: Rod = Rod { mass: (1, 1), length: (1, 1), inertia: (1, 12) };

/// Three rods, no two alike.
const UNEQUAL: [Rod; 3] = [
    Rod { mass: (1, 1), length: (1, 1), inertia: (1, 10) },
    Rod { mass: (4, 5), length: (7, 10), inertia: (1, 20) },
    Rod { mass: (1, 2), length: (9, 10), inertia: (3, 50) },
];

fn quotient((above, below): (i64, i64)) -> Expr {
    &Expr::int(above) / &Expr::int(below)
}

/// A chain of uniform rods of mass 1 and length 1, each at an angle from the one before; momentum, shape.
fn chain(links: usize) -> crate::Result<(Momentum, Vec<Symbol>)> {
    chain_of(&vec![UNIFORM; links])
}

/// The same of given rods.
fn chain_of(rods: &[Rod]) -> crate::Result<(Momentum, Vec<Symbol>)> {
    let shape: Vec<Symbol> = (1..rods.len()).map(|k| Symbol::new(&format!("r_{k}"))).collect();
    let heading = |k: usize| shape[..k].iter().fold(Expr::int(0), |sum, r| &sum + &Expr::sym(r.clone()));
    let half = &Expr::int(1) / &Expr::int(2);
    let along = |k: usize| {
        let f = |f, zero: i64| if k == 0 { Expr::int(zero) } else { Expr::call(f, &heading(k)) };
        let length = quotient(rods[k].length);
        [f(crate::formula::Fun::Cos, 1), f(crate::formula::Fun::Sin, 0)].map(|part| &length * &part)
    };
    let place = |k: usize, c: usize| {
        let before = (0..k).fold(Expr::int(0), |sum, j| &sum + &along(j)[c]);
        &before + &(&half * &along(k)[c])
    };
    let body = |k: usize| PlanarBody {
        mass: quotient(rods[k].mass),
        inertia: quotient(rods[k].inertia),
        place: [place(k, 0), place(k, 1)],
        angle: heading(k),
    };
    let bodies: Vec<PlanarBody> = (0..rods.len()).map(body).collect();
    let energy = floating_energy("phi", &shape, &bodies)?;
    Ok((Momentum::of(&energy, &[("phi".into(), Expr::int(1))])?, shape))
}

/// The chain as a mechanism, looked at where every sine is rational.
fn counted(links: usize) -> Option<Counted> {
    let (momentum, shape) = chain(links).ok()?;
    let constraint = momentum.constraint("angular momentum", "e_sc").ok()?;
    let coordinates = std::iter::once(Symbol::from("phi")).chain(shape.iter().cloned()).collect();
    let angles = [Exact::direction(4.into(), 3.into()), Exact::direction(12.into(), (-5).into())];
    let at = shape.iter().zip(angles).fold(Point::default(), |p, (r, angle)| p.with(r.clone(), angle));
    Counted::of(&format!("links_{links}"), Mechanism { coordinates, constraints: vec![constraint] }, at, 5)
}

fn one_hinge() -> Claim {
    base("two-link", Status::Sampled, "two bodies on one hinge, floating freely, are holonomic: a closed loop of the hinge brings both back")
        .under("angular momentum zero; one shape variable")
        .remark("Any form in one variable is closed, so that this needs no particular masses; the loop is a check of the program.")
        .code(&["src/connection/bodies.rs", CONNECTION])
        .tests(&["tests/symmetry/bodies.rs"])
        .proof("brackets: none, so one constraint of one", &[("growth", "1"), ("holonomic", "1"), ("nonholonomic", "0")], |s, _| {
            compare_with(s, counted(2))
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
            "The masses, lengths and moments decide the number: for rods of masses 1, 0.8, 0.5 kg, lengths 1, 0.7, 0.9 m and \
             moments 0.1, 0.05, 0.06 kg·m² it is −0.00609466.",
        )
        .code(&["src/connection/bodies.rs", CONNECTION])
        .tests(&["tests/symmetry/bodies.rs"])
        .proof("by brackets", &[("growth", "23"), ("nonholonomic", "1")], |s, _| compare_with(s, counted(3)))
        .sample(
            "circles of radius 0.04 and 0.02 about (0.7, −0.4): the error of phase/area falls with the square of the radius",
            &[("curvature", "-0.00676934"), ("order", "2")],
            small_loops,
        )
        .sample("the curvature there of three rods of which no two are alike", &[("curvature", "-0.00609466")], |s, _| {
            let found = chain_of(&UNEQUAL).and_then(|(momentum, shape)| Connection::of(&momentum, &shape));
            let said = s.number("curvature").unwrap_or(f64::NAN);
            all_of([found
                .map_err(|e| undefined(&e))
                .and_then(|found| within("curvature", curvature_there(&found), said, 6e-9))])
        })
}

/// The curvature at the angles 0.7 and −0.4.
fn curvature_there(connection: &Connection) -> f64 {
    let at = |name: &Symbol| if name.as_str() == "r_1" { 0.7 } else { -0.4 };
    connection.curvature(0, 1).eval(&at).unwrap_or(f64::NAN)
}

/// The curvature of the chain of three at a point, and the order at which phase/area tends to it.
fn small_loops(s: &Statement, _: &Sampling) -> Outcome {
    let found = || -> crate::Result<[f64; 2]> {
        let (momentum, shape) = chain(3)?;
        let connection = Connection::of(&momentum, &shape)?;
        let curvature = curvature_there(&connection);
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
