//! Effects that are each other in disguise, and the sign of every effect.

use super::{TRACTORS, apart, hiding, last, near, same_path, short};
use crate::simulator::{Hidden, Log, Profile, Scenario, Tractor, Vehicle};

#[test]
fn equivalent_effects_give_the_same_run() {
    let car = short(Tractor::Car, 11);
    let offset = hiding(&car, &[Hidden::SteeringOffset { offset: 0.03 }]);
    let e_tc = 0.03_f64.tan();
    same_path(&offset, &hiding(&car, &[Hidden::FrontTraverseCreep { e_tc }]), 1e-10);

    for tractor in TRACTORS {
        let scenario = short(tractor, 12);
        let radius = hiding(&scenario, &[Hidden::WheelRadius { scale: -0.04 }]);
        let creep = hiding(&scenario, &[Hidden::RotationCreep { e_rc: 0.04 }]);
        same_path(&radius, &creep, 1e-11);
    }

    let drive = short(Tractor::DifferentialDrive, 13);
    let mismatch = hiding(&drive, &[Hidden::WheelRadiusMismatch { scale: 0.02 }]);
    let unequal = Hidden::UnequalRotationCreep { e_left: -0.02, e_right: 0.0 };
    same_path(&mismatch, &hiding(&drive, &[unequal]), 1e-11);
}

#[test]
fn a_misaligned_heading_is_a_traverse_creep_with_a_rotation_creep() {
    let offset: f64 = 0.2;
    let scenario = short(Tractor::Unicycle, 14);
    let log = hiding(&scenario, &[Hidden::HeadingMisalignment { offset }]);
    let turned = Scenario { start: [0.0, 0.0, offset], ..scenario };
    let e_rc = 1.0 - offset.cos();
    let e_tc = -offset.tan();
    let creeping = hiding(&turned, &[Hidden::TraverseCreep { e_tc }, Hidden::RotationCreep { e_rc }]);
    for column in ["x", "y", "phi"] {
        for (a, b) in log.column(column).iter().zip(creeping.column(column)) {
            near(*a, b, 1e-10);
        }
    }
}

#[test]
fn every_lateral_effect_pushes_to_its_side() {
    // A left turn at 1 m/s and 0.5 rad/s.
    let scenario = Scenario { profile: Profile::constant(1.0, 0.5), ..short(Tractor::Unicycle, 15) };
    let v_t = |hidden: Hidden| hiding(&scenario, &[hidden]).truth[0].v_t;
    near(v_t(Hidden::TraverseCreep { e_tc: 0.1 }), 0.1, 1e-12);
    near(v_t(Hidden::CorneringCreep { mass_over_bt: 0.1 }), -0.05, 1e-11);
    near(v_t(Hidden::LoadDependentCreep { c: 0.1 }), -0.05, 1e-12);
    near(v_t(Hidden::YawSquareSlip { q: 0.1 }), -0.025, 1e-12);
    near(v_t(Hidden::LeftTurnSlip { q: 0.1 }), -0.05, 1e-12);
    let left = std::f64::consts::FRAC_PI_2;
    let slope = Hidden::SideSlope { rate: 0.1, direction: left };
    near(v_t(slope), 0.1, 1e-12);
    near(v_t(Hidden::SaturatingCreep { c: 0.1, limit: 0.02 }), -0.02 * 2.5_f64.tanh(), 1e-12);
}

#[test]
fn what_stands_behind_an_odometry_and_what_pulls_along_the_way() {
    let scenario = Scenario { profile: Profile::constant(1.0, 0.5), ..short(Tractor::Unicycle, 15) };
    let first = |hidden: Hidden| {
        let log = hiding(&scenario, &[hidden]);
        (log.truth[0].v_l, log.truth[0].yaw)
    };
    let (v, w) = first(Hidden::OdometryYawPerSpeed { k: 0.1 });
    near(v, 1.0, 1e-12);
    near(w, 0.6, 1e-12);
    let (v, w) = first(Hidden::OdometrySpeedPerYaw { k: 0.1 });
    near(v, 1.05, 1e-12);
    near(w, 0.5, 1e-12);
    let (v, _) = first(Hidden::Grade { rate: 0.1, direction: std::f64::consts::FRAC_PI_3 });
    near(v, 1.05, 1e-12);
}

#[test]
fn what_holds_for_a_time_holds_then_and_at_no_other() {
    let scenario =
        Scenario { span: Some([3.0, 5.0]), profile: Profile::constant(1.0, 0.0), ..short(Tractor::Unicycle, 15) };
    let log = hiding(&scenario, &[Hidden::RotationCreep { e_rc: 0.1 }]);
    for truth in &log.truth {
        let slipped = 0.1 * (truth.t.clamp(3.0, 5.0) - 3.0);
        near(truth.x, truth.t - slipped, 1e-9);
    }
}

#[test]
fn every_turning_effect_turns_to_its_side() {
    let yaw = |tractor: Tractor, turn: f64, hidden: Hidden| {
        let scenario = Scenario { profile: Profile::constant(1.3, turn), ..short(tractor, 16) };
        hiding(&scenario, &[hidden]).truth[0].yaw
    };
    let unicycle = |hidden| yaw(Tractor::Unicycle, 0.5, hidden);
    near(unicycle(Hidden::YawRateBias { bias: 0.02 }), 0.52, 1e-12);
    near(unicycle(Hidden::YawRateScale { scale: 0.1 }), 0.55, 1e-12);
    near(unicycle(Hidden::CorneringCreep { mass_over_bt: 0.2 }), 0.5, 1e-12);

    let drive = |hidden| yaw(Tractor::DifferentialDrive, 0.5, hidden);
    near(drive(Hidden::TrackWidth { scale: 0.25 }), 0.4, 1e-12);
    near(drive(Hidden::RotationCreep { e_rc: 0.1 }), 0.45, 1e-12);
    // Left rim 1.2 m/s, right rim 1.4 m/s, track 0.4 m.
    let faster_left = Hidden::WheelRadiusMismatch { scale: 0.1 };
    near(drive(faster_left), (1.4 - 1.32) / 0.4, 1e-12);

    let car = |hidden| yaw(Tractor::Car, 0.1, hidden);
    let (v, base, tan) = (1.3, 2.6, 0.1_f64.tan());
    near(car(Hidden::TraverseCreep { e_tc: 0.03 }), v / base * (tan - 0.03), 1e-12);
    let front = v / base * (tan + 0.03) / (1.0 - 0.03 * tan);
    near(car(Hidden::FrontTraverseCreep { e_tc: 0.03 }), front, 1e-12);
    let gained = v / base * 0.12_f64.tan();
    near(car(Hidden::SteeringGain { scale: 0.2 }), gained, 1e-12);
    near(car(Hidden::SteeringOffset { offset: 0.02 }), gained, 1e-12);
    near(car(Hidden::SteeringCubic { cubic: 20.0 }), gained, 1e-12);
    near(car(Hidden::Wheelbase { scale: 0.25 }), v / (1.25 * base) * tan, 1e-12);
    let understeered = v / base * tan / (1.0 + 0.1 * v * v);
    near(car(Hidden::Understeer { gradient: 0.1 }), understeered, 1e-12);
}

#[test]
fn sensor_ground_and_clock_effects_move_the_log_as_told() {
    let scenario = short(Tractor::Unicycle, 17);
    let ideal = scenario.run();
    let lever = hiding(&scenario, &[Hidden::LeverArm { a: 0.3, b: -0.1 }]);
    let drift = hiding(&scenario, &[Hidden::Drift { vx: 0.02, vy: -0.05 }]);
    for (i, truth) in ideal.truth.iter().enumerate() {
        let (sin, cos) = truth.heading.sin_cos();
        near(lever.rows[i][1], truth.x + 0.3 * cos + 0.1 * sin, 1e-12);
        near(lever.rows[i][2], truth.y + 0.3 * sin - 0.1 * cos, 1e-12);
        near(drift.rows[i][1], truth.x + 0.02 * truth.t, 1e-10);
        near(drift.rows[i][2], truth.y - 0.05 * truth.t, 1e-10);
    }
    // A delay of one second is 25 rows: the vehicle does later what the log says now.
    let delayed = hiding(&scenario, &[Hidden::InputDelay { delay: 1.0 }]);
    let logged = ideal.column("phi_dot");
    for (i, yaw) in logged.iter().enumerate().take(250) {
        near(delayed.truth[i + 25].yaw, *yaw, 1e-12);
    }
    assert_eq!(logged, delayed.column("phi_dot"));
}

#[test]
fn no_effect_is_idle_and_every_neutral_effect_is() {
    let vehicle = Vehicle::NTrailer { tractor: Tractor::Car, lengths: vec![3.0, 2.0], hitch_offsets: vec![0.3, 0.0] };
    let scenario = short(vehicle, 18);
    let ideal = scenario.run();
    let of = |k: f64| {
        [
            Hidden::SpeedRotationCreep { per_speed: 0.01 * k },
            Hidden::TrailerTraverseCreep { trailer: 2, e_tc: k },
            Hidden::TrailerLength { trailer: 2, scale: k },
            Hidden::HitchOffset { trailer: 2, offset: k },
        ]
    };
    for (moving, neutral) in of(0.1).into_iter().zip(of(0.0)) {
        let moved = hiding(&scenario, &[moving]);
        let tail = |log: &Log| last(log).trailers[1];
        assert!((tail(&moved) - tail(&ideal)).abs() > 1e-4, "{moving:?} is idle");
        assert_eq!(hiding(&scenario, &[neutral]), ideal, "{neutral:?} is not neutral");
    }
    // The viscous effects vanish with their time constants, at first order.
    let car = short(Tractor::Car, 18);
    let gap = |t: f64| {
        let traction = Hidden::TractionCreep { mass_over_br: t };
        let cornering = Hidden::CorneringCreep { mass_over_bt: t };
        apart(&hiding(&car, &[traction, cornering]), &car.run())
    };
    let ratio = gap(0.02) / gap(0.01);
    assert!((1.8..2.2).contains(&ratio), "ratio {ratio}");
}
