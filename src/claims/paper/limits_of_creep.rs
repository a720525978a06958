//! Beyond sections 2 and 3: the limits e_rc1, e_rc2, e_tc1, e_tc2 between creep and slip, by forces that a contact holds.

use super::creep_dynamics::CHAPTER;
use crate::claims::simulated::{column, undefined};
use crate::claims::{Claim, Outcome, Sampling, Statement, Status, Verdict, near, value_said};
use crate::dynamics::{Dynamics, Masses};
use crate::effects::{self, Applied};
use crate::error::{Error, Result};
use crate::files::{DynamicsEntry, StartEntry};
use crate::model::Model;
use crate::motion::{Integrator, Signals, Table, Timing, simulate_model};
use proptest::prelude::Strategy;

pub(crate) fn claims() -> Vec<Claim> {
    vec![rotation(), traverse()]
}

/// How long a force acts before the slip is looked at, in times that a small slip settles in; and as long again. Just below
/// the limit it settles some hundred times later.
const SETTLING: f64 = 2000.0;
/// A slip that has grown by half of itself again grows on.
const GROWS: f64 = 1.5;
/// Halvings of the interval in which the limit lies.
const HALVINGS: usize = 10;
/// The share of the limit at which the coefficient is measured: there a law with a limit is linear to a part in 10⁴.
const SMALL: f64 = 0.02;

fn base(id: &str, says: &str) -> Claim {
    Claim::new(id, Status::Sampled, says)
        .chapter(CHAPTER)
        .code(&[
            "src/mechanism/regime/rotation.rs",
            "src/mechanism/regime/traverse.rs",
            "src/effects/forces.toml",
            "src/model/forces/contact.rs",
        ])
        .tests(&["tests/mechanism/regime.rs"])
}

fn rotation() -> Claim {
    base("limits-R", "a wheel whose contact holds no more than F_max creeps for |e_rc| < e_rc1 = -e_rc2 = F_max/(b_R·r·|ω|) and slips beyond")
        .at("section 2, remark on limit values, which the paper names and does not determine; (11)")
        .about(&[8, 11])
        .under("the viscous law of (11) up to a greatest force F_max, μ·N of dry ground; a wheel with its load driven by a constant torque; the limit is the coefficient that the linear law has at the torque beyond which the slip grows without end")
        .remark(
            "The limits are symmetric. They are constants \"in the vicinity of the origin\", as the paper says, for no law whose \
             force is a viscosity times a slip speed: e_rc1 falls as 1/|ω|, and the slip speed e_rc1·r·|ω| = F_max/b_R is the \
             constant. The torque at the limit is F_max·(m·r² + J)/(m·r).",
        )
        .sample(
            "generated wheels on a line: the coefficient at the limit, and the torque there",
            &[("e_rc1", "F_max/(b*r*omega)"), ("torque", "F_max*(m*r^2 + J)/(m*r)")],
            |s, sampling| over(s, sampling, rotation_limits),
        )
}

fn traverse() -> Claim {
    base("limits-T", "a blade that holds no more than F_max creeps for |e_tc| < e_tc1 = -e_tc2, F_max/(b_T·|v_l|) of a viscous contact and F_max/k_r of Rocard's, and slips beyond")
        .at("section 3, remark on the working region, whose limits the paper names and does not determine; (18), (22)-(23)")
        .about(&[17, 18, 22, 23])
        .under("a law up to a greatest force F_max; a constant force to the left at a constant speed v_l")
        .remark(
            "In a turn the force asked for is m·v_l·φ', so a creeping turn needs v_l·|φ'| < F_max/m whatever the law. The limits \
             are constants, as the paper says, under Rocard's law, which knows the slip angle alone; under viscous friction \
             they fall as 1/|v_l|.",
        )
        .sample(
            "generated sleighs pushed aside: the coefficients at the limit, and the force there",
            &[("e_tc1", "F_max/(b*v)"), ("e_tc1_rocard", "F_max/k"), ("force", "F_max")],
            |s, sampling| over(s, sampling, traverse_limits),
        )
}

/// Mass, another inertia, radius or speed, F_max, coefficient of the law.
type Drawn = [f64; 5];

fn over(s: &Statement, sampling: &Sampling, limits: fn(&Statement, &Drawn) -> Verdict) -> Outcome {
    let drawn = (0.5..3.0f64, 0.02..0.3f64, 0.2..1.5f64, 1.0..8.0f64, 40.0..200.0f64);
    let drawn = drawn.prop_map(|(m, j, r, f, b)| [m, j, r, f, b]);
    let show = |d: &Drawn| vec![("m, J, r or v_l, F_max, b or k".to_string(), format!("{d:?}"))];
    sampling.one_in(20).cases(drawn, show, |d| limits(s, d))
}

fn rotation_limits(s: &Statement, drawn: &Drawn) -> Verdict {
    let [m, j, r, most, b] = *drawn;
    let wheel = || -> Result<Model> {
        let masses = Masses { mass: m, wheels: [("theta'".into(), j)].into(), ..Masses::default() };
        let disk = Dynamics::new(&Model::new("disk", &[("wheel_radius", r)])?, &masses)?;
        Ok(limited(
            &disk.driven_by(&["wheel_torque"])?.with_laws("viscous", &[b])?.model()?,
            "traction-limit",
            m / most,
        ))
    };
    let model = wheel().map_err(|e| undefined(&e))?;
    let slip = |torque: f64| -> Result<[f64; 3]> {
        let table = pushed(&model, torque, 0.0, 1.0 / (b * (1.0 / m + r * r / j)))?;
        let (rate, speed) = (column(&table, "theta.omega")?, column(&table, "speed")?);
        Ok([r * rate[1] - speed[1], r * rate[2] - speed[2], rate[1]])
    };
    let (found, [at, _, rate]) = limit(slip, most * (r + j / (m * r))).map_err(|e| undefined(&e))?;
    let value = |name: &str| match name {
        "m" => Some(m),
        "J" => Some(j),
        "r" => Some(r),
        "F_max" => Some(most),
        "b" => Some(b),
        "omega" => Some(rate),
        _ => None,
    };
    near("the torque at the limit", found.force / value_said(s, "torque", &value)?, 1.0, 0.01)?;
    near("e_rc1", at / (r * rate) * found.times / value_said(s, "e_rc1", &value)?, 1.0, 0.02)
}

fn traverse_limits(s: &Statement, drawn: &Drawn) -> Verdict {
    let [m, inertia, speed, most, b] = *drawn;
    for (law, name) in [("viscous", "e_tc1"), ("rocard", "e_tc1_rocard")] {
        let sleigh = || -> Result<Model> {
            let masses = Masses { mass: m, inertia, ..Masses::default() };
            let parameters = [("mass", m), ("inertia", inertia), ("mass_offset", 0.0)];
            let free = Dynamics::new(&Model::new("sleigh", &parameters)?, &masses)?.driven_by(&["lateral_force"])?;
            Ok(limited(&free.with_laws(law, &[b])?.model()?, "side-grip-limit", m / most))
        };
        let model = sleigh().map_err(|e| undefined(&e))?;
        let slip = |force: f64| -> Result<[f64; 3]> {
            let table = pushed(&model, force, speed, m / if law == "viscous" { b } else { b / speed })?;
            let aside = column(&table, "lateral_speed")?;
            Ok([aside[1], aside[2], column(&table, "speed")?[1]])
        };
        let (found, [at, _, ahead]) = limit(slip, most).map_err(|e| undefined(&e))?;
        let value = |name: &str| match name {
            "F_max" => Some(most),
            "b" | "k" => Some(b),
            "v" => Some(ahead),
            _ => None,
        };
        near("the force at the limit", found.force / value_said(s, "force", &value)?, 1.0, 0.01)?;
        near(name, at / ahead * found.times / value_said(s, name, &value)?, 1.0, 0.02)?;
    }
    Ok(())
}

/// The model with an effect that limits the force of its contact.
fn limited(model: &Model, id: &str, softness: f64) -> Model {
    let effect = effects::named(id).unwrap_or_else(|| unreachable!("the catalogue has {id}"));
    model.clone().with_effect(Applied::new(effect, None, vec![softness]))
}

/// A motion from a speed under a constant input: its begin, after it has settled, and as long again.
fn pushed(model: &Model, by: f64, speed: f64, settles: f64) -> Result<Table> {
    let times = [0.0, 1.0, 2.0].map(|t| t * SETTLING * settles);
    let entry = DynamicsEntry { start: StartEntry { speed, ..StartEntry::default() }, ..DynamicsEntry::default() };
    let start = [vec![0.0; 3], model.speeds_at_start(Some(&entry))].concat();
    let input = Signals::new(&times, &[vec![by; 3]], Timing::Sample);
    simulate_model(model, &input, &times, &start, &Integrator::default().for_friction(true))
}

/// The force beyond which a slip grows on, and how many times the small one it is.
struct Limit {
    force: f64,
    times: f64,
}

/// The limit by bisection within a factor of two either way of a guess, and the slips at a small share of it: after a while,
/// after as long again, and what the motion is there.
fn limit(slip: impl Fn(f64) -> Result<[f64; 3]>, guess: f64) -> Result<(Limit, [f64; 3])> {
    let grows = |force: f64| slip(force).map(|[once, twice, _]| twice > GROWS * once);
    let (mut below, mut above) = (guess / 2.0, 2.0 * guess);
    if grows(below)? || !grows(above)? {
        return Err(Error::run(format!("no limit lies between {below} and {above}")));
    }
    for _ in 0..HALVINGS {
        let middle = (below + above) / 2.0;
        *(if grows(middle)? { &mut above } else { &mut below }) = middle;
    }
    let (force, small) = ((below + above) / 2.0, SMALL * guess);
    Ok((Limit { force, times: force / small }, slip(small)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slip that settles below 3 and grows above.
    #[test]
    fn a_limit_is_where_a_slip_begins_to_grow() {
        let slip = |f: f64| Ok(if f < 3.0 { [0.1 * f, 0.1 * f, 1.0] } else { [f, 2.0 * f, 1.0] });
        let (found, [once, _, _]) = limit(slip, 2.0).unwrap();
        assert!((found.force - 3.0).abs() < 0.01 && (once * found.times - 0.3).abs() < 1e-3);
        assert!(limit(slip, 0.5).is_err());
    }
}
