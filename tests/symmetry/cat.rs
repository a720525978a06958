//! The falling cat: its momentum is zero, its curvature that of small loops, its turn that of a closed form.

use crate::support::check;
use creepage::connection::{Axis, Matrix, Path, Rotation, RotationConnection, turned};
use creepage::formula::{Expr, Symbol};
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn bent() -> Matrix {
    let [gamma, tau] = ["gamma", "tau"].map(Expr::sym);
    turned(&[(Axis::Z, tau.clone()), (Axis::Y, gamma), (Axis::Z, -&tau)])
}

fn shape() -> [Symbol; 2] {
    ["gamma", "tau"].map(Symbol::from)
}

fn body(moments: [&str; 3]) -> [Expr; 3] {
    moments.map(|m| Expr::parse(m).unwrap())
}

/// Two different bodies, neither of them round.
fn uneven(q: &Matrix) -> RotationConnection {
    RotationConnection::of_two_bodies(&body(["1", "3/2", "1/4"]), &body(["2/3", "1/2", "1"]), q, &shape())
}

fn cat() -> RotationConnection {
    RotationConnection::of_two_bodies(&body(["1", "1", "1/4"]), &body(["1", "1", "1/4"]), &bent(), &shape())
}

fn number(e: &Expr, at: [f64; 2]) -> f64 {
    e.eval(&|s: &Symbol| if s.as_str() == "gamma" { at[0] } else { at[1] }).unwrap()
}

fn vector(v: &[Expr; 3], at: [f64; 2]) -> Vector3<f64> {
    Vector3::from_fn(|i, _| number(&v[i], at))
}

/// The orientation of the second body, by nalgebra's rotations.
fn relative([gamma, tau]: [f64; 2]) -> Matrix3<f64> {
    let about = |axis, angle| *Rotation3::from_axis_angle(&axis, angle).matrix();
    about(Vector3::z_axis(), tau) * about(Vector3::y_axis(), gamma) * about(Vector3::z_axis(), -tau)
}

#[test]
fn turns_are_those_of_rotation_matrices() {
    check(30, [-3.0..3.0f64, -3.0..3.0f64], |at| {
        let q = bent();
        let found = Matrix3::from_fn(|i, j| number(&q[i][j], at));
        prop_assert!((found - relative(at)).norm() < 1e-14);
        let x = turned(&[(Axis::X, Expr::sym("tau"))]);
        let wanted = *Rotation3::from_axis_angle(&Vector3::x_axis(), at[1]).matrix();
        prop_assert!((Matrix3::from_fn(|i, j| number(&x[i][j], at)) - wanted).norm() < 1e-14);
        Ok(())
    });
    assert!(turned(&[])[0][0].is_one() && turned(&[])[0][1].is_zero());
}

#[test]
fn the_momentum_of_both_bodies_is_zero() {
    let connection = uneven(&bent());
    let diagonal = |d: [f64; 3]| Matrix3::from_diagonal(&Vector3::from(d));
    let (first, second) = (diagonal([1.0, 1.5, 0.25]), diagonal([2.0 / 3.0, 0.5, 1.0]));
    check(30, (prop::array::uniform2(-2.0..2.0f64), prop::array::uniform2(-1.0..1.0f64)), |(at, rate)| {
        let q = relative(at);
        let h = 1e-5;
        let ahead = |s: f64| relative([at[0] + s * rate[0], at[1] + s * rate[1]]);
        let spin = (ahead(h) - ahead(-h)) / (2.0 * h) * q.transpose();
        let other = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
        let omega = vector(&connection.form[0], at) * rate[0] + vector(&connection.form[1], at) * rate[1];
        let carried = q * second * q.transpose();
        let momentum = first * omega + carried * (omega + other);
        prop_assert!(momentum.norm() < 1e-8, "{}", momentum);
        prop_assert!(omega.norm() > 1e-3 || other.norm() < 1e-2);
        Ok(())
    });
}

#[test]
fn small_loops_turn_by_area_times_curvature() {
    let connection = uneven(&bent());
    let round = Path::new(&[("gamma", "u + r*cos(t)"), ("tau", "v + r*sin(t)")], [0.0, TAU]).unwrap();
    check(6, [0.3..1.5f64, -2.0..2.0f64], |at| {
        let r = 1e-2;
        let turn = connection.holonomy(&round, &[("u", at[0]), ("v", at[1]), ("r", r)]).unwrap().vector();
        let curvature = vector(&connection.curvature(0, 1), at);
        let found = Vector3::from(turn) / (TAU / 2.0 * r * r);
        // The loop begins beside the middle: its turn is seen from there, to first order in r.
        prop_assert!((found - curvature).norm() < 2e-2 * (1.0 + curvature.norm()), "{} {}", found, curvature);
        prop_assert!(curvature.norm() > 1e-2);
        Ok(())
    });
}

/// In a frame that goes round with the bend the motion repeats itself: R(2π) = exp(2π·[w + e_z]).
#[test]
fn once_round_is_one_turn_about_a_fixed_axis() {
    let once = Path::new(&[("gamma", "g"), ("tau", "t")], [0.0, TAU]).unwrap();
    check(12, 0.05..1.5f64, |gamma| {
        let found = cat().holonomy(&once, &[("g", gamma)]).unwrap();
        let axis = vector(&cat().form[1], [gamma, 0.0]) + Vector3::z();
        let wanted = Rotation3::from_scaled_axis(axis * TAU);
        let error = Matrix3::from_fn(|i, j| found.0[i][j]) - wanted.matrix();
        prop_assert!(error.norm() < 1e-10, "{}", error);
        prop_assert!((found.angle() - wanted.angle()).abs() < 1e-9);
        Ok(())
    });
    let turn = |g: f64| cat().holonomy(&once, &[("g", g)]).unwrap();
    assert!((turn(0.05).vector()[2] / 0.0025 + 5.48476).abs() < 1e-5, "{:?}", turn(0.05).vector());
    assert!((turn(1.0).angle() - 3.019_579_526).abs() < 1e-8);
    // -7/4·pi·gamma^2 as the bend vanishes.
    assert!((turn(1e-3).vector()[2] / 1e-6 + 1.75 * TAU / 2.0).abs() < 1e-4);
}

#[test]
fn angle_and_axis_of_a_rotation() {
    let of = |v: [f64; 3]| {
        let m = *Rotation3::from_scaled_axis(Vector3::from(v)).matrix();
        Rotation(std::array::from_fn(|i| std::array::from_fn(|j| m[(i, j)])))
    };
    check(50, prop::array::uniform3(-1.7..1.7f64), |v| {
        let found = of(v).vector();
        (0..3).try_for_each(|i| {
            prop_assert!((found[i] - v[i]).abs() < 1e-12);
            Ok(())
        })
    });
    assert_eq!((of([0.0; 3]).angle(), of([0.0; 3]).vector()), (0.0, [0.0; 3]));
    let half = Rotation([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]);
    assert!(half.angle() == std::f64::consts::PI && half.vector().iter().any(|v| !v.is_finite()));
}
