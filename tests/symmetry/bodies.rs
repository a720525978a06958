//! Bodies that float freely: their energy against sums over points of mass, two links and three.

use crate::support::check;
use creepage::connection::{Connection, Path, PlanarBody, floating_energy};
use creepage::formula::{Expr, Symbol};
use creepage::mechanism::Momentum;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// Links of mass m_k, inertia i_k and length 2·a_k, hinged end to end, each at an angle from the one before.
fn chain(links: usize) -> (Expr, Vec<Symbol>) {
    let shape: Vec<Symbol> = (1..links).map(|k| Symbol::new(&format!("r_{k}"))).collect();
    let heading = |k: usize| {
        if k == 0 { "0".to_string() } else { (1..=k).map(|j| format!("r_{j}")).collect::<Vec<_>>().join(" + ") }
    };
    let place = |f: &str, k: usize| {
        let before = (0..k).map(|j| format!("2*a_{j}*{f}({}) + ", heading(j))).collect::<String>();
        format!("{before}a_{k}*{f}({})", heading(k))
    };
    let body = |k: usize| {
        PlanarBody::new(&format!("m_{k}"), &format!("i_{k}"), [&place("cos", k), &place("sin", k)], &heading(k))
            .unwrap()
    };
    let bodies: Vec<PlanarBody> = (0..links).map(body).collect();
    (floating_energy("phi", &shape, &bodies).unwrap(), shape)
}

fn values(links: usize) -> Vec<(String, f64)> {
    let number = |stem: &str, k: usize, v: f64| (format!("{stem}_{k}"), v + 0.3 * k as f64 - 0.1 * (k * k) as f64);
    (0..links).flat_map(|k| [number("m", k, 1.1), number("i", k, 0.2), number("a", k, 0.7)]).collect()
}

fn named(all: &[(String, f64)]) -> Vec<(&str, f64)> {
    all.iter().map(|(n, v)| (n.as_str(), *v)).collect()
}

fn turning(links: usize) -> Connection {
    let (energy, shape) = chain(links);
    let momentum = Momentum::of(&energy, &[("phi".into(), Expr::int(1))]).unwrap();
    Connection::of(&momentum, &shape).unwrap()
}

/// König: the energy about the centre of mass is Σ mᵢ·mⱼ·|vᵢ − vⱼ|²/(2·Σ m) over pairs, with the spins.
#[test]
fn the_energy_is_that_of_all_pairs() {
    let (energy, _) = chain(3);
    let known = values(3);
    check(50, (prop::array::uniform3(-2.0..2.0f64), prop::array::uniform3(-2.0..2.0f64)), |(angles, rates)| {
        let get = |n: &str| known.iter().find(|(name, _)| name == n).unwrap().1;
        let found = energy
            .eval(&|s: &Symbol| match s.as_str() {
                "phi'" => rates[0],
                "r_1" => angles[1],
                "r_2" => angles[2],
                "r_1'" => rates[1],
                "r_2'" => rates[2],
                other => get(other),
            })
            .unwrap();
        // In the world, by absolute angles.
        let (mut heading, mut spin, mut hinge) = (angles[0], rates[0], [0.0, 0.0]);
        let mut seen = Vec::new();
        for k in 0..3 {
            if k > 0 {
                (heading, spin) = (heading + angles[k], spin + rates[k]);
            }
            let a = get(&format!("a_{k}"));
            let step = [-heading.sin() * spin * a, heading.cos() * spin * a];
            seen.push((
                get(&format!("m_{k}")),
                get(&format!("i_{k}")) * spin * spin,
                [hinge[0] + step[0], hinge[1] + step[1]],
            ));
            hinge = [hinge[0] + 2.0 * step[0], hinge[1] + 2.0 * step[1]];
        }
        let total: f64 = seen.iter().map(|s| s.0).sum();
        let pair = |(i, j): (usize, usize)| {
            let (p, q) = (&seen[i], &seen[j]);
            p.0 * q.0 * ((p.2[0] - q.2[0]).powi(2) + (p.2[1] - q.2[1]).powi(2)) / total
        };
        let wanted =
            ([(0, 1), (0, 2), (1, 2)].map(pair).iter().sum::<f64>() + seen.iter().map(|s| s.1).sum::<f64>()) / 2.0;
        prop_assert!((found - wanted).abs() < 1e-12 * (1.0 + wanted), "{} {}", found, wanted);
        Ok(())
    });
    assert!(floating_energy("phi", &[], &[]).is_err());
}

#[test]
fn two_links_come_back_and_three_do_not() {
    let two = turning(2);
    assert_eq!(two.is_flat(), Some(true));
    let loops = [("r_1", "1/2 + sin(t) + cos(2*t)/3"), ("r_2", "cos(t)")];
    let known = values(3);
    let drift = two.phase(&Path::new(&loops[..1], [0.0, TAU]).unwrap(), &named(&known)).unwrap();
    assert!(drift.abs() < 1e-12, "{drift}");
    let turned = turning(3).phase(&Path::new(&loops, [0.0, TAU]).unwrap(), &named(&known)).unwrap();
    assert!(turned.abs() > 1e-2, "{turned}");
}

#[test]
fn small_loops_of_three_links_turn_by_area_times_curvature() {
    let three = turning(3);
    let known = values(3);
    check(5, [-1.5..1.5f64, -1.5..1.5f64], |[a, b]| {
        let at = |s: &Symbol| match s.as_str() {
            "r_1" => a,
            "r_2" => b,
            other => known.iter().find(|(n, _)| n == other).unwrap().1,
        };
        let curvature = three.curvature(0, 1).eval(&at).unwrap();
        let circle = Path::new(&[("r_1", "u + c*cos(t)"), ("r_2", "v + c*sin(t)")], [0.0, TAU]).unwrap();
        let error = |c: f64| {
            let all = [named(&known), vec![("u", a), ("v", b), ("c", c)]].concat();
            three.phase(&circle, &all).unwrap() / (PI * c * c) - curvature
        };
        prop_assert!(error(0.01).abs() < 1e-4, "{}", error(0.01));
        // Of second order, unless the coefficient of that order happens to be small.
        let order = (error(0.1) / error(0.05)).log2();
        prop_assert!((order - 2.0).abs() < 0.1 || error(0.1).abs() < 1e-4, "{}", order);
        Ok(())
    });
}
