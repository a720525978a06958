//! Momentum maps: conserved along free motion, and refused where nothing is conserved.

use crate::support::check;
use creepage::connection::{PlanarBody, floating_energy};
use creepage::formula::{Expr, Symbol, identical};
use creepage::mechanism::Momentum;
use proptest::prelude::*;

fn parse(text: &str) -> Expr {
    Expr::parse(text).unwrap()
}

fn of(energy: &str, generator: &[(&str, &str)]) -> creepage::Result<Momentum> {
    let generator: Vec<(Symbol, Expr)> = generator.iter().map(|(q, x)| ((*q).into(), parse(x))).collect();
    Momentum::of(&parse(energy), &generator)
}

fn same(a: &Expr, b: &str) -> bool {
    identical(a, &parse(b)) == Some(true)
}

#[test]
fn the_parts_add_up_to_the_momentum() {
    let found = of("I*psi'^2/2 + m*(l + d)^2*(psi' + theta')^2/2 + m*l'^2/2", &[("psi", "1")]).unwrap();
    assert!(same(&found.map.expr(), "I*psi' + m*(l + d)^2*(psi' + theta')"));
    assert!(same(&found.locked, "I + m*(l + d)^2") && same(&found.shape.expr(), "m*(l + d)^2*theta'"));
    assert_eq!(found.along.as_str(), "psi");
}

/// Turned about the origin, with the angle of a body of its own: the generator has more than one component.
#[test]
fn a_symmetry_may_move_several_coordinates() {
    let energy = "m*(x'^2 + y'^2)/2 + I*phi'^2/2";
    let found = of(energy, &[("phi", "1"), ("x", "-y"), ("y", "x")]).unwrap();
    assert!(same(&found.map.expr(), "m*(x*y' - y*x') + I*phi'"));
    assert!(same(&found.locked, "m*(x^2 + y^2) + I"));
    // What is left moves with the body turned back: h = J - s*phi'.
    assert!(same(&found.shape.expr(), "m*(x*y' - y*x') - m*(x^2 + y^2)*phi'"));
    // Without the body's own angle it is the same symmetry, with no coordinate that measures it.
    assert!(of("m*(x'^2 + y'^2)/2", &[("x", "-y"), ("y", "x")]).unwrap_err().to_string().contains("no component"));
    // A generator of two coordinates, under which both the energy's places and its rates move.
    let sheared = "m*(x'*(y + z) - x*(y' + z'))^2/2 + y'^2 + z'^2 + I*phi'^2/2";
    let found = of(sheared, &[("phi", "1"), ("x", "y + z")]).unwrap();
    assert!(same(&found.map.expr(), "I*phi' + m*(y + z)^2*(x'*(y + z) - x*(y' + z'))"));
    // A translation conserves a linear momentum.
    assert!(same(&of(energy, &[("x", "1")]).unwrap().map.expr(), "m*x'"));
}

#[test]
fn what_is_no_symmetry_conserves_nothing() {
    let said = |energy: &str, generator: &[(&str, &str)]| of(energy, generator).unwrap_err().to_string();
    assert!(said("m*x^2*x'^2", &[("x", "1")]).contains("changes the kinetic energy"));
    assert!(
        said("m*(x'^2 + 2*y'^2)/2 + phi'^2", &[("phi", "1"), ("x", "-y"), ("y", "x")]).contains("along it the energy")
    );
    assert!(said("m*x'", &[("x", "1")]).contains("quadratic in the rates"));
    assert!(said("m*x'^2 + g*x", &[("x", "1")]).contains("quadratic in the rates"));
    assert!(said("I", &[("x", "1")]).contains("quadratic in the rates"));
    assert!(said("x'^2", &[("x", "2")]).contains("no component of the generator is 1"));
    // The momentum of an angle that the energy does not know is always zero.
    let nothing = of("x'^2", &[("phi", "1")]).unwrap();
    assert_eq!((same(&nothing.map.expr(), "0"), same(&nothing.locked, "0")), (true, true), "{nothing:?}");
    let error = nothing.constraint("idle", "e").unwrap_err().to_string();
    assert!(error.contains("the momentum of \"idle\" is zero in every motion"), "{error}");
}

/// Along a free motion, whose accelerations are found from the energy by differences, the momentum stays.
#[test]
fn the_momentum_of_hinged_bodies_is_conserved() {
    let shape: Vec<Symbol> = ["a", "b"].map(Symbol::from).to_vec();
    let body = |x: &str, y: &str, angle: &str| PlanarBody::new("7/5", "1/5", [x, y], angle).unwrap();
    let bodies = [body("0", "0", "0"), body("1 + cos(a)", "sin(a)", "a"), body("b", "-1", "0")];
    let energy = floating_energy("phi", &shape, &bodies).unwrap();
    let momentum = Momentum::of(&energy, &[("phi".into(), Expr::int(1))]).unwrap();
    let names = ["phi", "a", "b", "phi'", "a'", "b'"];
    let at = |e: &Expr, q: [f64; 3], v: [f64; 3]| {
        let all = [q, v].concat();
        e.eval(&|s: &Symbol| all[names.iter().position(|n| *n == s.as_str()).unwrap()]).unwrap()
    };
    check(20, (prop::array::uniform3(-1.0..1.0f64), prop::array::uniform3(-1.0..1.0f64)), |(q, v)| {
        // M(q)·q̈ = ∂T/∂q − Ṁ·q̇, with T = q̇ᵀMq̇/2: all by differences of T alone.
        let h = 1e-3;
        let unit = |i: usize| std::array::from_fn::<f64, 3, _>(|k| f64::from(u8::from(i == k)));
        let t = |q: [f64; 3], v: [f64; 3]| at(&energy, q, v);
        let plus = |a: [f64; 3], s: f64, b: [f64; 3]| std::array::from_fn::<f64, 3, _>(|k| a[k] + s * b[k]);
        let p = |q: [f64; 3], v: [f64; 3], i: usize| (t(q, plus(v, 1.0, unit(i))) - t(q, plus(v, -1.0, unit(i)))) / 2.0;
        let mass = |i: usize, j: usize| p(q, unit(j), i);
        let side = |i: usize| {
            let slope = |d: [f64; 3], f: &dyn Fn([f64; 3]) -> f64| {
                (8.0 * (f(plus(q, h, d)) - f(plus(q, -h, d))) - f(plus(q, 2.0 * h, d)) + f(plus(q, -2.0 * h, d)))
                    / (12.0 * h)
            };
            slope(unit(i), &|q| t(q, v)) - slope(v, &|q| p(q, v, i))
        };
        let m = nalgebra::Matrix3::from_fn(mass);
        let acceleration = m.lu().solve(&nalgebra::Vector3::from_fn(|i, _| side(i))).unwrap();
        let j = |q: [f64; 3], v: [f64; 3]| at(&momentum.map.expr(), q, v);
        let change = |s: f64| j(plus(q, s, v), plus(v, s, acceleration.into()));
        let rate = (8.0 * (change(h) - change(-h)) - change(2.0 * h) + change(-2.0 * h)) / (12.0 * h);
        prop_assert!(rate.abs() < 1e-7, "{}", rate);
        // And it is not conserved by chance: it changes under other accelerations.
        let other = |s: f64| j(plus(q, s, v), plus(v, s, [1.0, 0.0, 0.0]));
        prop_assert!(((other(h) - other(-h)) / (2.0 * h)).abs() > 1e-3);
        Ok(())
    });
}
