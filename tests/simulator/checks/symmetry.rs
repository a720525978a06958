//! Time reversal and mirror image.

use super::{TRACTORS, hiding, last, near, short};
use crate::simulator::{Hidden, Scenario, Tractor, Truth};

/// One effect of every kind that survives a time reversal of the motion, for the tractor.
fn kinematic(tractor: Tractor) -> Vec<Hidden> {
    let mut hidden = vec![
        Hidden::RotationCreep { e_rc: 0.04 },
        Hidden::TraverseCreep { e_tc: 0.06 },
        Hidden::LoadDependentCreep { c: 0.02 },
        Hidden::Understeer { gradient: 0.01 },
    ];
    match tractor {
        Tractor::Unicycle => hidden.push(Hidden::YawRateScale { scale: 0.03 }),
        Tractor::DifferentialDrive => hidden.push(Hidden::TrackWidth { scale: 0.03 }),
        _ => hidden.push(Hidden::FrontTraverseCreep { e_tc: -0.03 }),
    }
    hidden
}

#[test]
fn driven_backwards_the_path_is_retraced() {
    for tractor in TRACTORS {
        let scenario = short(tractor, 9);
        let there = hiding(&scenario, &kinematic(tractor));
        let Truth { x, y, heading, .. } = *last(&there);
        let end = scenario.duration;
        let back = Scenario {
            profile: scenario.profile.reversed(end, tractor.is_steered()),
            start: [x, y, heading],
            ..scenario.clone()
        };
        let back = hiding(&back, &kinematic(tractor));
        for (there, back) in there.truth.iter().rev().zip(&back.truth) {
            near(back.x, there.x, 1e-9);
            near(back.y, there.y, 1e-9);
        }
    }
}

#[test]
fn the_mirrored_drive_is_the_mirror_image() {
    for tractor in TRACTORS {
        let scenario = short(tractor, 10);
        let mirrored = Scenario { profile: scenario.profile.mirrored(), ..scenario.clone() };
        let odd = |sign: f64| {
            vec![
                Hidden::CorneringCreep { mass_over_bt: 0.1 },
                Hidden::TractionCreep { mass_over_br: 0.1 },
                Hidden::LoadDependentCreep { c: 0.01 },
                Hidden::YawSquareSlip { q: 0.05 },
                Hidden::Understeer { gradient: 0.01 },
                Hidden::TraverseCreep { e_tc: sign * 0.05 },
                Hidden::FrontTraverseCreep { e_tc: sign * 0.03 },
                Hidden::RelaxationLength { length: 0.7, e_tc: sign * 0.04 },
                Hidden::YawRateBias { bias: sign * 0.02 },
                Hidden::SteeringOffset { offset: sign * 0.02 },
                Hidden::Drift { vx: 0.03, vy: sign * 0.02 },
                Hidden::SideSlope { rate: 0.05, direction: sign * 1.1 },
                Hidden::UnequalRotationCreep { e_left: 0.03 + 0.01 * sign, e_right: 0.03 - 0.01 * sign },
            ]
        };
        let one = hiding(&scenario, &odd(1.0));
        let other = hiding(&mirrored, &odd(-1.0));
        for (one, other) in one.truth.iter().zip(&other.truth) {
            near(other.x, one.x, 1e-10);
            near(other.y, -one.y, 1e-10);
            near(other.heading, -one.heading, 1e-10);
        }
    }
}
