//! Hidden effects by the library's names: sizes drawn, amplitudes changed, small ones to feel for rivals.

use super::make::Target;
use crate::simulator::{Hidden, Tractor};
use creepage::effects;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::{FRAC_PI_2, PI};

/// Share of the plausible size that counts as infinitesimal.
const SMALL: f64 = 1e-3;

/// The hidden effect of that name with its parameters in the order of [`Hidden::parameters`], the trailer's
/// number left out.
pub fn made((id, trailer): Target, values: &[f64]) -> Hidden {
    let v = values[0];
    let second = values.get(1).copied().unwrap_or(0.0);
    let trailer = trailer.unwrap_or(0);
    match id {
        "rotation-creep" => Hidden::RotationCreep { e_rc: v },
        "wheel-radius" => Hidden::WheelRadius { scale: v },
        "traction-creep" => Hidden::TractionCreep { mass_over_br: v },
        "traverse-creep" => Hidden::TraverseCreep { e_tc: v },
        "front-traverse-creep" => Hidden::FrontTraverseCreep { e_tc: v },
        "heading-misalignment" => Hidden::HeadingMisalignment { offset: v },
        "cornering-creep" => Hidden::CorneringCreep { mass_over_bt: v },
        "load-dependent-creep" => Hidden::LoadDependentCreep { c: v },
        "relaxation-length" => Hidden::RelaxationLength { length: v, e_tc: second },
        "yaw-rate-bias" => Hidden::YawRateBias { bias: v },
        "yaw-rate-scale" => Hidden::YawRateScale { scale: v },
        "track-width" => Hidden::TrackWidth { scale: v },
        "wheel-radius-mismatch" => Hidden::WheelRadiusMismatch { scale: v },
        "unequal-rotation-creep" => Hidden::UnequalRotationCreep { e_left: v, e_right: second },
        "steering-offset" => Hidden::SteeringOffset { offset: v },
        "steering-gain" => Hidden::SteeringGain { scale: v },
        "understeer" => Hidden::Understeer { gradient: v },
        "wheelbase" => Hidden::Wheelbase { scale: v },
        "input-delay" => Hidden::InputDelay { delay: v },
        "lever-arm" => Hidden::LeverArm { a: v, b: second },
        "drift" => Hidden::Drift { vx: v, vy: second },
        "side-slope" => Hidden::SideSlope { rate: v, direction: second },
        "odometry-yaw-per-speed" => Hidden::OdometryYawPerSpeed { k: v },
        "odometry-speed-per-yaw" => Hidden::OdometrySpeedPerYaw { k: v },
        "grade" => Hidden::Grade { rate: v, direction: second },
        "saturating-creep" => Hidden::SaturatingCreep { c: v, limit: second },
        "trailer-traverse-creep" => Hidden::TrailerTraverseCreep { trailer, e_tc: v },
        "trailer-length" => Hidden::TrailerLength { trailer, scale: v },
        "hitch-offset" => Hidden::HitchOffset { trailer, offset: v },
        other => panic!("the simulator has no law for {other}: add it to `secret.rs`"),
    }
}

/// Effects of the library that the simulator has no law for yet.
const WITHOUT_LAW: [&str; 1] = ["castor-swing"];

/// Whether the simulator can hide an effect, and the library is asked for it.
pub fn has_law(id: &str) -> bool {
    !WITHOUT_LAW.contains(&id) && effects::named(id).is_none_or(|e| !e.unsought || e.per_input)
}

/// The name and trailer of a hidden effect of the library.
pub fn target(hidden: &Hidden) -> Target {
    let trailer = hidden.parameters().iter().find(|(name, _)| *name == "trailer").map(|(_, i)| *i as usize);
    (hidden.id().expect("cases hide effects of the library"), trailer)
}

/// Its parameters by the contract's names, the trailer's number left out.
pub fn parameters(hidden: &Hidden) -> Vec<(&'static str, f64)> {
    hidden.parameters().into_iter().filter(|(name, _)| *name != "trailer").collect()
}

/// The effect with a size of 0.5 to 4 times the plausible one, equally often in every octave.
pub fn drawn(at: Target, tractor: Tractor, random: &mut ChaCha8Rng) -> Hidden {
    let effect = effects::named(at.0).expect("targets come from the library");
    let names = parameters(&made(at, &[0.0, 0.0]));
    let values: Vec<f64> = names
        .iter()
        .map(|(name, _)| {
            let p = &effect.parameters[*name];
            if p.periodic {
                return random.random_range(-PI..PI);
            }
            let size = p.size * 2f64.powf(random.random_range(-1.0..2.0));
            let negative = random.random::<bool>() && !p.positive && p.range[0] < 0.0;
            if negative { -size } else { size }
        })
        .collect();
    made(at, &tame(at.0, tractor, values))
}

/// Sizes that would turn the vehicle into another one are held back: a car at 7 m/s that turns faster the faster
/// it goes, or slides further out than it rolls.
fn tame(id: &str, tractor: Tractor, mut values: Vec<f64>) -> Vec<f64> {
    let fast = matches!(tractor, Tractor::Car | Tractor::FourWheelCar);
    match id {
        "understeer" => values[0] = values[0].max(-0.005),
        "load-dependent-creep" if fast => values[0] *= 0.4,
        _ => {}
    }
    values
}

/// The effect with its amplitude multiplied; lengths and directions stay.
pub fn amplified(hidden: &Hidden, factor: f64) -> Hidden {
    let values = parameters(hidden).into_iter();
    let values: Vec<f64> =
        values.map(|(name, v)| if ["length", "direction"].contains(&name) { v } else { v * factor }).collect();
    made(target(hidden), &values)
}

/// Small effects of that name that together span what it can do to first order, each with the same the other way round where
/// there is one.
pub fn probes(at: Target) -> Vec<(Hidden, Option<Hidden>)> {
    let effect = effects::named(at.0).expect("targets come from the library");
    let sizes: Vec<f64> =
        parameters(&made(at, &[0.0, 0.0])).iter().map(|(name, _)| effect.parameters[*name].size).collect();
    let small = SMALL * sizes[0];
    // What the values are multiplied by the other way round. Time constants and lengths are not less than nothing, and a limit
    // or a direction means nothing by itself.
    let (values, mirror): (Vec<Vec<f64>>, Option<[f64; 2]>) = match at.0 {
        // Their states follow at once or not at all; a plausible one is nearly linear, as it moves no heading.
        "traction-creep" | "cornering-creep" => (vec![vec![sizes[0]]], None),
        "relaxation-length" => {
            (vec![vec![0.5 * sizes[0], SMALL * sizes[1]], vec![2.0 * sizes[0], SMALL * sizes[1]]], None)
        }
        "saturating-creep" => (vec![vec![small, sizes[1]]], Some([-1.0, 1.0])),
        "side-slope" | "grade" => (vec![vec![small, 0.0], vec![small, FRAC_PI_2]], Some([-1.0, 1.0])),
        _ if sizes.len() == 2 => (vec![vec![small, 0.0], vec![0.0, SMALL * sizes[1]]], Some([-1.0, -1.0])),
        _ => (vec![vec![small]], Some([-1.0, -1.0])),
    };
    let mirrored =
        |v: &[f64], signs: [f64; 2]| made(at, &v.iter().zip(signs).map(|(v, s)| s * v).collect::<Vec<f64>>());
    values.iter().map(|v| (made(at, v), mirror.map(|signs| mirrored(v, signs)))).collect()
}
