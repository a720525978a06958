//! The two generic forms: the pair (s, p), its σ, and the derivatives of the rows.

use crate::models::{Values, anywhere, at, random_described as random, value};
use crate::support::{Outcome, check};
use creepage::describe::Jacobian;
use creepage::formula::{Dual, Expr, Symbol};
use creepage::mechanism::{Constraint, Direction, Heading, Row, Velocity, sigma_closed_form};
use num_dual::Dual64;
use proptest::prelude::*;
use std::f64::consts::PI;

fn near(a: f64, b: f64, tolerance: f64) -> Outcome {
    prop_assert!((a - b).abs() <= tolerance * (1.0 + a.abs().max(b.abs())), "{} is not {}", a, b);
    Ok(())
}

/// A wheel at the reference point.
fn wheel() -> Direction {
    Direction::new(&Velocity::of_reference_point(), &Heading::along("phi"), &Expr::sym("e"))
}

/// What stands in a slot of a constraint.
fn slot(c: &Constraint, name: &str, v: &Values) -> f64 {
    value(&c.form.slot(name).unwrap().expr(), v)
}

fn point(phi: f64, e: f64, rates: [f64; 2]) -> Values {
    [("phi", phi), ("e", e), ("x'", rates[0]), ("y'", rates[1])].map(|(n, v)| (n.into(), v)).into()
}

/// Headings, those where cot φ does not exist among them.
fn headings() -> impl Strategy<Value = f64> {
    prop_oneof![(-4i32..5).prop_map(|k| f64::from(k) * PI), -7.0..7.0f64]
}

fn creeps() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), -2.0..2.0f64]
}

#[test]
fn the_pair_is_the_row_and_its_length_never_vanishes() {
    check(150, (random(), headings()), |(r, phi)| {
        let mut v = anywhere(&r.model, &r.numbers);
        v.insert("phi".into(), phi);
        for c in r.model.constraints() {
            if c.letter() != 'T' {
                continue;
            }
            let [s, p, q1, q3] = ["s", "p", "q1'", "q3'"].map(|name| slot(&c, name, &v));
            let (pair, e) = (s * q1 - p * q3, at(&v)(&c.creep));
            near(value(&c.row().expr(), &v), pair, 1e-12)?;
            near(value(&c.generic(), &v), pair, 1e-12)?;
            near(s * s + p * p, 1.0 + e * e, 1e-13)?;
        }
        Ok(())
    });
}

#[test]
fn the_pair_is_that_of_the_heading_of_the_wheel() {
    check(150, random(), |r| {
        let v = anywhere(&r.model, &r.numbers);
        for c in r.model.constraints() {
            if c.letter() != 'T' {
                continue;
            }
            let read = |n: &str| at(&v)(&n.into());
            let psi = match c.name.split(',').next().unwrap() {
                "castor" => read("phi") + read("gamma"),
                name if r.model.vehicle.id == "synchro-drive" && name.ends_with("wheel") => read("phi") + read("delta"),
                "front axle" if r.model.vehicle.id == "skid-steer" => read("phi"),
                "rear axle" if r.model.vehicle.id == "four-wheel-steering" => read("phi") + read("delta_r"),
                name if name.starts_with("front") => read("phi") + read("delta"),
                name if name.starts_with("trailer") => read(&name.replace("trailer ", "phi_")),
                _ => read("phi"),
            };
            let e = at(&v)(&c.creep);
            near(slot(&c, "s", &v), psi.sin() + e * psi.cos(), 1e-14)?;
            near(slot(&c, "p", &v), psi.cos() - e * psi.sin(), 1e-14)?;
        }
        Ok(())
    });
}

#[test]
fn sigma_is_undefined_exactly_where_s_is_zero() {
    let t = wheel();
    check(4000, (headings(), creeps()), |(phi, e)| {
        let v = point(phi, e, [0.0; 2]);
        let s = value(&t.s, &v);
        prop_assert_eq!(t.sigma().eval(&at(&v)).is_none(), s == 0.0);
        if s.abs() > 1e-3 {
            let closed = sigma_closed_form(&Expr::sym("phi"), &Expr::sym("e"));
            near(value(&t.sigma(), &v), value(&closed, &v), 1e-9)?;
        }
        Ok(())
    });
    assert!(t.sigma().eval(&at(&point(0.0, 0.0, [1.0, 1.0]))).is_none());
}

#[test]
fn the_ideal_row_is_that_of_no_creep() {
    check(100, random(), |r| {
        let mut v = anywhere(&r.model, &r.numbers);
        for c in r.model.constraints() {
            v.insert(c.creep.clone(), 0.0);
            near(value(&c.row().expr(), &v), value(&c.ideal_row().expr(), &v), 1e-13)?;
            prop_assert!(!c.ideal_row().expr().mentions(&c.creep));
        }
        Ok(())
    });
}

#[test]
fn derivatives_by_rules_by_dual_numbers_and_by_differences_are_the_same() {
    check(60, random(), |r| {
        let v = anywhere(&r.model, &r.numbers);
        let coordinates = r.model.coordinates();
        for c in r.model.constraints() {
            let (g, jacobian) = (c.row().expr(), Jacobian::of(&c, &coordinates));
            for q in &coordinates {
                let by_rule = jacobian.q.iter().find(|(n, _)| n == q).map_or(0.0, |(_, d)| value(&d.expr(), &v));
                derivative_is(&g, q, &v, by_rule)?;
                let by_rule = jacobian.rates.iter().find(|(n, _)| *n == q.rate()).map_or(0.0, |(_, d)| value(d, &v));
                derivative_is(&g, &q.rate(), &v, by_rule)?;
            }
            derivative_is(&g, &c.creep, &v, value(&jacobian.e.expr(), &v))?;
        }
        Ok(())
    });
}

fn derivative_is(g: &Expr, by: &Symbol, v: &Values, expected: f64) -> Outcome {
    let dual = g.eval(&|s| Dual(Dual64::new(at(v)(s), f64::from(u8::from(s == by))))).unwrap().0.eps;
    near(dual, expected, 1e-11)?;
    let step = |h: f64| {
        let mut w = v.clone();
        *w.entry(by.clone()).or_insert(0.0) += h;
        value(g, &w)
    };
    near((step(1e-5) - step(-1e-5)) / 2e-5, expected, 1e-6)
}

#[test]
fn derivatives_of_a_wheel_have_their_closed_forms() {
    let contact = Velocity::of_reference_point();
    let direction = wheel().constraint("wheel", &"e".into());
    let rolling = creepage::mechanism::Rolling::new(
        &contact,
        &Heading::along("phi"),
        &Expr::sym("r"),
        &"theta'".into(),
        &Expr::sym("e"),
    );
    let rolling = rolling.constraint("wheel", &"e".into());
    let q = ["x", "y", "phi", "theta"].map(Symbol::from);
    let (t, r) = (Jacobian::of(&direction, &q), Jacobian::of(&rolling, &q));
    let d = |j: &Jacobian, n: &str| j.q.iter().find(|(q, _)| q.as_str() == n).map(|(_, d)| d.expr()).unwrap();
    let rate = |j: &Jacobian, n: &str| j.rates.iter().find(|(q, _)| q.as_str() == n).map(|(_, d)| d.clone()).unwrap();
    check(2000, (headings(), creeps(), -3.0..3.0f64, -3.0..3.0f64), |(phi, e, x, y)| {
        let mut v = point(phi, e, [x, y]);
        v.extend([("r".into(), 0.7), ("theta'".into(), x - y)]);
        let (sin, cos) = phi.sin_cos();
        let [v_l, v_t] = [x * cos + y * sin, -x * sin + y * cos];
        near(value(&direction.row().expr(), &v), -(v_t - e * v_l), 1e-13)?;
        near(value(&d(&t, "phi"), &v), v_l + e * v_t, 1e-13)?;
        near(value(&t.e.expr(), &v), v_l, 1e-13)?;
        near(value(&rate(&t, "x'"), &v), sin + e * cos, 1e-13)?;
        near(value(&rate(&t, "y'"), &v), -(cos - e * sin), 1e-13)?;
        near(value(&rolling.row().expr(), &v), v_l - 0.7 * (1.0 - e) * (x - y), 1e-13)?;
        near(value(&r.e.expr(), &v), 0.7 * (x - y), 1e-13)?;
        near(value(&rate(&r, "theta'"), &v), -0.7 * (1.0 - e), 1e-13)?;
        near(value(&d(&r, "phi"), &v), v_t, 1e-13)
    });
}

#[test]
fn derivatives_of_sigma_have_their_closed_forms() {
    let sigma = wheel().sigma();
    let [by_phi, by_e] = ["phi", "e"].map(|n| sigma.derivative(&n.into()));
    check(2000, (headings(), creeps()), |(phi, e)| {
        let v = point(phi, e, [0.0; 2]);
        let s = phi.sin() + e * phi.cos();
        if s.abs() < 1e-2 {
            return Ok(());
        }
        near(value(&by_phi, &v), -(1.0 + e * e) / (s * s), 1e-9)?;
        near(value(&by_e, &v), -1.0 / (s * s), 1e-9)
    });
}

#[test]
fn a_row_keeps_nothing_that_cancels() {
    let mut row = Row::default();
    row.add("x'", &Expr::parse("a + b").unwrap());
    row.add("x'", &Expr::parse("-b - a").unwrap());
    assert!(row.terms().is_empty());
}
