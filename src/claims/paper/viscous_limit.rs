//! The limit b → ∞: the free motion with friction tends to the ideally constrained one, measured.

use super::viscous::CHAPTER;
use crate::claims::generated_forced::{Pushed, pushed};
use crate::claims::simulated::{column, undefined};
use crate::claims::{Claim, Fault, Outcome, Statement, Status, Verdict, near, value_said};
use crate::dynamics::{Dynamics, Masses, Start, simulate_dynamics};
use crate::error::Result;
use crate::model::Model;
use crate::motion::{Formulas, Integrator, Method, Table};
use std::sync::LazyLock;

pub(crate) fn claims() -> Vec<Claim> {
    vec![order(), sleigh(), emerging(), not_uniform()]
}

fn base(id: &str, says: &str) -> Claim {
    Claim::new(id, Status::Sampled, says)
        .at("introduction and section 2: the realization of constraints by viscous friction [6]; corrected theorem (e)")
        .about(&[11, 18])
        .chapter(CHAPTER)
        .code(&["src/dynamics/system.rs", "src/motion/integrators/radau.rs"])
        .tests(&["tests/dynamics/sleigh.rs", "tests/dynamics/vehicles.rs"])
}

fn order() -> Claim {
    base("viscous-limit", "as b → ∞ the motion with friction tends to the ideal one with error of order 1/b")
        .under("disk, sleigh, single wheel, differential drive, car, each with up to two trailers where it pulls; any masses; a start without slip; a fixed time")
        .remark("Why: the slips are fast variables with rates of order b; on the slow manifold they are of order 1/b, and so is what they do to the rest.")
        .sample("order measured between b = 1e4 and 1e5", &[("order", "1")], |s, sampling| {
            sampling.one_in(20).cases(pushed(), Pushed::shown, |p| measured_order(s, p))
        })
}

fn measured_order(s: &Statement, p: &Pushed) -> Verdict {
    let times = [0.0, 0.4, 0.7, 1.0];
    let run = |b: Option<f64>| p.run(b, &times).map_err(|e| undefined(&e));
    let ideal = run(None)?;
    let gap = |b: f64| Ok::<f64, Fault>(apart(&run(Some(b))?, &ideal));
    let order = (gap(1e4)? / gap(1e5)?).log10();
    near("the order", order, value_said(s, "order", &|_| None)?, 0.02)
}

/// The largest difference in what a motion is: the columns of pose and speeds.
fn apart(a: &Table, b: &Table) -> f64 {
    let moving = |name: &String| !["slip", "force", "energy", "input", "friction"].iter().any(|p| name.starts_with(p));
    let columns = a.names.iter().zip(a.columns.iter().zip(&b.columns)).filter(|(name, _)| moving(name));
    let gaps = columns.flat_map(|(_, (a, b))| a.iter().zip(b).map(|(a, b)| (a - b).abs()));
    gaps.fold(0.0, f64::max)
}

/// The sleigh with its mass, inertia and centre of mass, from a forward speed and a yaw rate.
fn run(body: [f64; 3], friction: Option<f64>, speed: f64, yaw_rate: f64, times: &[f64]) -> Result<Table> {
    let [mass, inertia, mass_offset] = body;
    let model = Model::new("sleigh", &[("mass", mass), ("inertia", inertia), ("mass_offset", mass_offset)])?;
    let free = Dynamics::new(&model, &Masses { mass, inertia, mass_offset, ..Masses::default() })?;
    let (sleigh, method) = match friction {
        Some(b) => (free.with_law("blade-direction", "viscous", &[b])?, Method::Radau5),
        None => (free, Method::Dop853),
    };
    let start = Start { pose: vec![0.0; 3], speed, yaw_rate: Some(yaw_rate), ..Start::default() };
    let by = Integrator { method, ..Integrator::default() };
    simulate_dynamics(&sleigh, &Formulas::new(&[], &[])?, times, &start, &by)
}

/// b times the largest errors within 4 s at b = 1e4, with the names of the statement.
static CONSTANTS: LazyLock<Result<[(&'static str, f64); 4]>> = LazyLock::new(|| {
    let times: Vec<f64> = (0..=200).map(|i| f64::from(i) * 0.02).collect();
    let (b, body) = (1e4, [1.0, 0.5, 0.3]);
    let (ideal, free) = (run(body, None, 0.5, 1.2, &times)?, run(body, Some(b), 0.5, 1.2, &times)?);
    let gaps = |name: &str| -> Result<Vec<f64>> {
        Ok(column(&free, name)?.iter().zip(column(&ideal, name)?).map(|(a, b)| (a - b).abs()).collect())
    };
    let largest = |gaps: Vec<f64>| b * gaps.into_iter().fold(0.0, f64::max);
    let place = gaps("x")?.into_iter().zip(gaps("y")?).map(|(x, y)| x.hypot(y)).collect();
    Ok([
        ("u", largest(gaps("speed")?)),
        ("omega", largest(gaps("yaw_rate")?)),
        ("phi", largest(gaps("heading")?)),
        ("place", largest(place)),
    ])
});

fn sleigh() -> Claim {
    base("viscous-limit-sleigh", "m = 1, I = 0.5, a = 0.3, u = 0.5, ω = 1.2: within 4 s the sleigh with friction is off by 0.7727/b in u, 0.3076/b in ω, 1.0385/b in φ and 3.000/b in place")
        .under("b from 1e4 on; below, terms of 1/b² are seen")
        .sample(
            "b times the largest errors at b = 1e4",
            &[("u", "0.77265"), ("omega", "0.30759"), ("phi", "1.03845"), ("place", "2.99997")],
            |s, _| match CONSTANTS.as_ref() {
                Err(e) => Outcome::Undefined(e.to_string()),
                Ok(found) => Outcome::all(found.iter().map(|(name, found)| agrees(s, name, *found, 2e-3))),
            },
        )
}

fn agrees(s: &Statement, name: &str, found: f64, tolerance: f64) -> Outcome {
    match s.said_of(name).and_then(|e| e.eval(&|_| f64::NAN)) {
        None => Outcome::Undefined(format!("nothing is said of {name}")),
        Some(said) if (found / said - 1.0).abs() <= tolerance => Outcome::PROVED,
        Some(said) => Outcome::failure(format!("{name} is {found:.6}, the statement says {said}")),
    }
}

fn emerging() -> Claim {
    let bodies = ([0.5..2.0f64, 0.2..1.0f64, -0.3..0.4f64], [0.5..2.0f64, 0.3..1.5f64]);
    let show = |(body, start): &([f64; 3], [f64; 2])| {
        vec![("m, I, a".to_string(), format!("{body:?}")), ("u, omega".to_string(), format!("{start:?}"))]
    };
    base(
        "creep-coefficient-measured",
        "simulated sleighs creep by e_tc = −m·I/((I + m·a²)·b)·φ̇ once the first instant is over",
    )
    .at("section 3, (18)–(19); corrected theorem (e)")
    .about(&[18, 19])
    .under("b = 1e5, after 0.2 s")
    .sample("b times v_t/v_l of generated sleighs", &[("creep", "-m*I/(I + m*a^2)*omega")], move |s, sampling| {
        sampling.one_in(10).cases(bodies.clone(), show, |(body, [u, omega])| {
            let b = 1e5;
            let table = run(*body, Some(b), *u, *omega, &[0.0, 0.2]).map_err(|e| undefined(&e))?;
            let at = |name: &str| column(&table, name).map(|c| c[1]).map_err(|e| undefined(&e));
            let (v_l, v_t, omega) = (at("speed")?, at("lateral_speed")?, at("yaw_rate")?);
            let value = |name: &str| match name {
                "m" => Some(body[0]),
                "I" => Some(body[1]),
                "a" => Some(body[2]),
                "omega" => Some(omega),
                _ => None,
            };
            near("b·e_tc", b * v_t / v_l, value_said(s, "creep", &value)?, 1e-3)
        })
    })
}

/// u after the time b/(m·ω²) at b = 100, m = 1, ω = 1, with friction and without.
static LATE: LazyLock<Result<[f64; 2]>> = LazyLock::new(|| {
    let b = 100.0;
    let late = |friction| run([1.0, 0.5, 0.0], friction, 1.0, 1.0, &[0.0, b]);
    let (free, ideal) = (late(Some(b))?, late(None)?);
    Ok([column(&free, "speed")?[1], column(&ideal, "speed")?[1]])
});

fn not_uniform() -> Claim {
    base("viscous-limit-not-uniform", "the limit is not uniform in time: with the mass centre on the axle, after b/(m·ω²) seconds the speed has fallen to 1/e of what the ideal sleigh keeps, however large b is")
        .under("a = 0, ω constant; measured at b = 100·m·|ω|")
        .remark("On the slow manifold u' = ω·w = −(m·ω²/b)·u. Friction does little each second, but for as many seconds as b is large.")
        .sample("u after b/(m·ω²), from 1", &[("u", "exp(-1)"), ("u_ideal", "1")], |s, _| match LATE.as_ref() {
            Err(e) => Outcome::Undefined(e.to_string()),
            Ok([free, ideal]) => Outcome::all([agrees(s, "u", *free, 1e-3), agrees(s, "u_ideal", *ideal, 1e-6)]),
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn motions_are_apart_by_their_largest_difference() {
        let table = |columns: [[f64; 2]; 2]| Table {
            names: vec!["x".into(), "energy".into()],
            columns: columns.map(Vec::from).into(),
        };
        let (a, b) = (table([[1.0, 4.0], [9.0, 9.0]]), table([[1.5, 2.0], [0.0, 0.0]]));
        assert_eq!((apart(&a, &b), apart(&b, &a)), (2.0, 2.0));
    }
}
