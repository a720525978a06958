//! Motions that have a closed form.

use super::{TRACTORS, hiding, last, near, short};
use crate::simulator::{Hidden, Parameters, Profile, Scenario, Signal, Tractor, Vehicle};

#[test]
fn a_constant_twist_drives_a_circle() {
    for tractor in TRACTORS {
        let (speed, turn) = (1.2_f64, 0.3_f64);
        let wheelbase = Parameters::usual(tractor).wheelbase;
        let (v, yaw) = match tractor {
            Tractor::Unicycle | Tractor::DifferentialDrive => (speed, turn),
            Tractor::Tricycle => (speed * turn.cos(), speed * turn.sin() / wheelbase),
            Tractor::Car | Tractor::FourWheelCar => (speed, speed * turn.tan() / wheelbase),
        };
        let profile = Profile::constant(speed, turn);
        let run = Scenario { profile, ..short(tractor, 1) }.run();
        for truth in &run.truth {
            near(truth.x, v / yaw * (yaw * truth.t).sin(), 1e-11);
            near(truth.y, v / yaw * (1.0 - (yaw * truth.t).cos()), 1e-11);
        }
    }
}

#[test]
fn constant_creep_turns_and_scales_the_path() {
    // THEORY section 3: z_c = κ·z_i with κ = (1 − e_rc)(1 + i·e_tc), whatever the inputs.
    for tractor in [Tractor::Unicycle, Tractor::DifferentialDrive] {
        let (e_rc, e_tc) = (0.07, -0.11);
        let scenario = short(tractor, 2);
        let ideal = scenario.run();
        // The yaw rate of a differential drive creeps with its wheels unless its track does too.
        let mut hidden = vec![Hidden::RotationCreep { e_rc }, Hidden::TraverseCreep { e_tc }];
        hidden.push(Hidden::TrackWidth { scale: -e_rc });
        let creeping = hiding(&scenario, &hidden);
        for (i, c) in ideal.truth.iter().zip(&creeping.truth) {
            near(c.x, (1.0 - e_rc) * (i.x - e_tc * i.y), 1e-11);
            near(c.y, (1.0 - e_rc) * (i.y + e_tc * i.x), 1e-11);
            near(c.heading, i.heading, 1e-11);
        }
    }
}

/// Gain and lag (rad) of `time·y' + y = sin(rate·t)` once settled.
fn low_pass(time: f64, period: f64) -> (f64, f64) {
    let phase = std::f64::consts::TAU / period * time;
    (1.0 / phase.hypot(1.0), phase.atan())
}

#[test]
fn side_viscosity_is_a_low_pass_of_the_centrifugal_pull() {
    let (time, period, speed) = (0.2, 3.0, 1.5);
    let profile = Profile { speed: Signal::constant(speed), turn: Signal::wave(0.8, period, 0.0) };
    let scenario = Scenario { profile, ..short(Tractor::Unicycle, 3) };
    let run = hiding(&scenario, &[Hidden::CorneringCreep { mass_over_bt: time }]);
    let (gain, lag) = low_pass(time, period);
    for truth in &run.truth {
        let pull = 0.8 * (std::f64::consts::TAU / period * truth.t - lag).sin();
        near(truth.v_t, -time * speed * gain * pull, 1e-9);
        near(truth.v_l, speed, 1e-12);
    }
}

#[test]
fn drive_viscosity_is_a_low_pass_of_the_wheel_speed() {
    let (time, period) = (0.3, 4.0);
    let profile =
        Profile { speed: Signal::constant(1.0) + Signal::wave(0.4, period, 0.0), turn: Signal::constant(0.0) };
    for tractor in TRACTORS {
        let scenario = Scenario { profile: profile.clone(), ..short(tractor, 4) };
        let run = hiding(&scenario, &[Hidden::TractionCreep { mass_over_br: time }]);
        let (gain, lag) = low_pass(time, period);
        for truth in &run.truth {
            let wave = (std::f64::consts::TAU / period * truth.t - lag).sin();
            near(truth.v_l, 1.0 + 0.4 * gain * wave, 1e-9);
        }
    }
}

#[test]
fn both_viscosities_settle_where_the_forces_balance() {
    // Steady turn: −yaw·v_t = (u − v_l)/R and yaw·v_l = −v_t/T, hence v_l = u/(1 + R·T·yaw²).
    let (r, t, speed, yaw) = (0.2, 0.3, 1.1, 0.7);
    let scenario = Scenario { profile: Profile::constant(speed, yaw), ..short(Tractor::Unicycle, 5) };
    let traction = Hidden::TractionCreep { mass_over_br: r };
    let cornering = Hidden::CorneringCreep { mass_over_bt: t };
    let run = hiding(&scenario, &[traction, cornering]);
    let v_l = speed / (1.0 + r * t * yaw * yaw);
    near(last(&run).v_l, v_l, 1e-12);
    near(last(&run).v_t, -t * yaw * v_l, 1e-12);
}

#[test]
fn relaxed_creep_builds_up_over_the_distance() {
    // The forward speed steps; in the metre, not the second, the approach is one exponential.
    let (length, e_tc) = (1.5, 0.1);
    let hidden = [Hidden::RelaxationLength { length, e_tc }];
    let scenario = Scenario {
        profile: Profile { speed: Signal::constant(1.0) + Signal::step(0.5, 4.0, 0.2), turn: Signal::constant(0.0) },
        ..short(Tractor::Unicycle, 6)
    };
    let run = hiding(&scenario, &hidden);
    let settled = |i: usize| e_tc * run.truth[i].v_l - run.truth[i].v_t;
    // Row 150 is at 6 s, when the speed is steady again.
    let travelled = run.truth[200].x - run.truth[150].x;
    near(settled(200) / settled(150), (-travelled / length).exp(), 1e-6);
    near(last(&run).v_t, e_tc * last(&run).v_l, 1e-3);
}

#[test]
fn a_towed_trailer_swings_in_as_the_half_angle_tangent_says() {
    // THEORY section 4c: tan(γ/2) decays at k = v/(d·cos α₁), γ = β − α₁.
    let (d, e_tc, v) = (2.0, 0.08, 1.3);
    let vehicle = Vehicle::NTrailer { tractor: Tractor::Unicycle, lengths: vec![d], hitch_offsets: vec![0.4] };
    let scenario =
        Scenario { profile: Profile::constant(v, 0.0), lead_in: 0.0, articulation: vec![0.9], ..short(vehicle, 7) };
    let run = hiding(&scenario, &[Hidden::TrailerTraverseCreep { trailer: 1, e_tc }]);
    let course = e_tc.atan();
    let half = |beta: f64| (0.5 * (beta - course)).tan();
    for truth in &run.truth {
        let decay = (-v * truth.t / (d * course.cos())).exp();
        near(half(truth.heading - truth.trailers[0]), half(0.9) * decay, 1e-10);
    }
}

#[test]
fn a_trailer_in_a_steady_turn_rides_on_its_own_circle() {
    // The hitch is on a circle of radius² R² + c², the axle on one of radius² R² + c² − d².
    let (speed, yaw, c, d) = (1.0, 0.25, 0.5, 1.4);
    for tractor in [Tractor::Unicycle, Tractor::DifferentialDrive] {
        let vehicle = Vehicle::NTrailer { tractor, lengths: vec![d], hitch_offsets: vec![c] };
        let scenario = Scenario { profile: Profile::constant(speed, yaw), lead_in: 90.0, ..short(vehicle, 8) };
        let run = scenario.run();
        let radius = speed / yaw;
        let trailer = (radius * radius + c * c - d * d).sqrt();
        let bend = (c / radius).atan() + (d / trailer).atan();
        near(last(&run).heading - last(&run).trailers[0], bend, 1e-10);
        let stretched =
            [Hidden::TrailerLength { trailer: 1, scale: 0.5 }, Hidden::HitchOffset { trailer: 1, offset: 0.2 }];
        let run = hiding(&scenario, &stretched);
        let (c, d) = (0.7_f64, 2.1_f64);
        let trailer = (radius * radius + c * c - d * d).sqrt();
        let bend = (c / radius).atan() + (d / trailer).atan();
        near(last(&run).heading - last(&run).trailers[0], bend, 1e-9);
    }
}

/// The time derivative of row values at row `i`, five points, for rows 10 ms apart.
fn slope_at(values: &[f64], i: usize) -> f64 {
    (8.0 * (values[i + 1] - values[i - 1]) - (values[i + 2] - values[i - 2])) / 0.12
}

#[test]
fn newton_can_be_read_off_the_motion_whatever_else_is_hidden() {
    let (r, t, e_tc) = (0.15, 0.25, 0.08);
    let traction = Hidden::TractionCreep { mass_over_br: r };
    let cornering = Hidden::CorneringCreep { mass_over_bt: t };
    let turned = Hidden::TraverseCreep { e_tc };
    let sliding = Hidden::LoadDependentCreep { c: 0.1 };
    let relaxing = Hidden::RelaxationLength { length: 0.6, e_tc: 0.05 };
    let cases: [(&[Hidden], bool, bool); 5] = [
        (&[traction, cornering], true, true),
        (&[traction, sliding], true, false),
        (&[traction, turned, relaxing], true, false),
        (&[cornering, turned], false, true),
        (&[traction, cornering, turned], true, true),
    ];
    for tractor in [Tractor::Unicycle, Tractor::DifferentialDrive, Tractor::Car] {
        let scenario = Scenario { rate: 100.0, ..short(tractor, 24) };
        for (hidden, drive_slips, side_slips) in cases {
            let run = hiding(&scenario, hidden);
            let v_l: Vec<f64> = run.truth.iter().map(|truth| truth.v_l).collect();
            let v_t: Vec<f64> = run.truth.iter().map(|truth| truth.v_t).collect();
            let free = if hidden.contains(&turned) { e_tc } else { 0.0 };
            for (i, truth) in run.truth.iter().enumerate().skip(2).take(1190) {
                let asked = scenario.profile.speed.value(truth.t);
                if drive_slips {
                    let along = slope_at(&v_l, i) - truth.yaw * v_t[i];
                    near(along, (asked - v_l[i]) / r, 1e-6);
                } else {
                    near(v_l[i], asked, 1e-12);
                }
                if side_slips {
                    let across = slope_at(&v_t, i) + truth.yaw * v_l[i];
                    near(across, -(v_t[i] - free * v_l[i]) / t, 1e-6);
                }
            }
        }
    }
}

#[test]
fn a_train_in_a_steady_turn_rides_on_shrinking_circles() {
    // The same triangle again for each trailer: radius₂² = radius₁² + c₂² − d₂².
    let (speed, yaw) = (1.0, 0.2);
    let (lengths, hitch_offsets) = (vec![1.5, 1.2, 0.9], vec![0.3, 0.0, 0.4]);
    let vehicle = Vehicle::NTrailer {
        tractor: Tractor::Unicycle,
        lengths: lengths.clone(),
        hitch_offsets: hitch_offsets.clone(),
    };
    let run = Scenario { profile: Profile::constant(speed, yaw), lead_in: 120.0, ..short(vehicle, 25) }.run();
    let end = last(&run);
    let mut radius: f64 = speed / yaw;
    let mut ahead = end.heading;
    for ((d, c), heading) in lengths.iter().zip(&hitch_offsets).zip(&end.trailers) {
        let behind = (radius * radius + c * c - d * d).sqrt();
        near(ahead - heading, (c / radius).atan() + (d / behind).atan(), 1e-9);
        (radius, ahead) = (behind, *heading);
    }
}

#[test]
fn relaxed_creep_and_the_centrifugal_pull_add_up_in_a_steady_turn() {
    let (speed, yaw, e_tc, time) = (1.2, 0.4, 0.06, 0.2);
    let scenario = Scenario { profile: Profile::constant(speed, yaw), ..short(Tractor::Unicycle, 26) };
    let relaxing = Hidden::RelaxationLength { length: 0.8, e_tc };
    let cornering = Hidden::CorneringCreep { mass_over_bt: time };
    let run = hiding(&scenario, &[relaxing, cornering]);
    near(last(&run).v_t, speed * (e_tc - time * yaw), 1e-10);
}
