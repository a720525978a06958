//! What reaches the log: means, noise, lost rows, text.

use super::{TRACTORS, last, near, short};
use crate::simulator::{Hidden, InputLog, Noise, Outliers, Profile, Scenario, Signal, Timing, Tractor};

#[test]
fn interval_means_add_up_to_the_distance_even_over_lost_rows() {
    let scenario = Scenario {
        timing: Timing::IntervalMean,
        gaps: vec![(3.0, 4.5)],
        dropouts: 0.1,
        jitter: 0.5,
        profile: Profile {
            speed: Signal::constant(1.0) + Signal::wave(0.3, 5.0, 1.0),
            turn: Signal::pulse(0.7, 2.0, 5.0, 0.3),
        },
        ..short(Tractor::DifferentialDrive, 19)
    };
    let log = scenario.run();
    let (t, left) = (log.column("t"), log.column("omega_left"));
    assert!(log.rows.len() < 280 && log.rows.len() > 200, "{}", log.rows.len());
    assert!(!t.iter().any(|t| (3.0..4.5).contains(t)));
    let rolled: f64 = (1..t.len()).map(|i| 0.1 * left[i] * (t[i] - t[i - 1])).sum();
    // The left wheel runs half a track inside the path of the middle.
    let middle: f64 = 0.3 * 5.0 / std::f64::consts::TAU;
    let phase = |t: f64| (std::f64::consts::TAU * t / 5.0 + 1.0).cos();
    let (from, to) = (t[0], t[t.len() - 1]);
    let middle = to - from + middle * (phase(from) - phase(to));
    let turned = last(&log).heading - log.truth[0].heading;
    near(rolled, middle - 0.2 * turned, 1e-9);
}

/// Counts add up to the angle within a tick, whatever the rows.
#[test]
fn ticks_lose_nothing_and_steps_are_steps() {
    let tick = 0.3;
    let inputs = InputLog { tick, step: 0.01, noise: 0.0 };
    let exact = Scenario { timing: Timing::IntervalMean, jitter: 0.4, ..short(Tractor::Unicycle, 19) };
    let coarse = Scenario { inputs, ..exact.clone() };
    let (exact, coarse) = (exact.run(), coarse.run());
    let t = exact.column("t");
    let (fine, counted) = (exact.column("theta_dot"), coarse.column("theta_dot"));
    let mut angles = [0.0; 2];
    for i in 1..t.len() {
        let dt = t[i] - t[i - 1];
        angles = [angles[0] + fine[i] * dt, angles[1] + counted[i] * dt];
        assert!((angles[0] - angles[1]).abs() < tick + 1e-9, "{angles:?}");
        near((counted[i] * dt / tick).fract().abs().min(1.0 - (counted[i] * dt / tick).fract().abs()), 0.0, 1e-6);
    }
    for (a, b) in exact.column("phi_dot").iter().zip(coarse.column("phi_dot")) {
        assert!((a - b).abs() < 0.005 + 1e-9);
        near((b / 0.01).round() * 0.01, b, 1e-12);
    }
}

#[test]
fn noise_has_its_sigma_and_the_seed_its_bytes() {
    let exact = Scenario { duration: 200.0, ..Scenario::new(Tractor::Unicycle, 20) };
    let noisy = Scenario { noise: Noise::RTK, ..exact.clone() };
    let (clean, noisy_log) = (exact.run(), noisy.run());
    let spread = |column: &str| {
        let pairs = clean.column(column).into_iter().zip(noisy_log.column(column));
        let squares: f64 = pairs.map(|(a, b)| (a - b).powi(2)).sum();
        (squares / clean.rows.len() as f64).sqrt()
    };
    near(spread("x") / 0.02, 1.0, 0.05);
    near(spread("y") / 0.02, 1.0, 0.05);
    near(spread("phi") / 0.01, 1.0, 0.05);
    assert_eq!(spread("phi_dot"), 0.0);
    assert_eq!(noisy_log.to_csv(9), noisy.run().to_csv(9));
    let other = Scenario { seed: 21, ..noisy };
    assert_ne!(noisy_log.to_csv(9), other.run().to_csv(9));
}

#[test]
fn outliers_hit_their_share_and_wrapping_keeps_the_direction() {
    let scenario = Scenario {
        outliers: Outliers { share: 0.05, size: 100.0 },
        wrap_heading: true,
        ..Scenario::new(Tractor::Unicycle, 22)
    };
    let log = scenario.run();
    let mut hit = 0;
    for (row, truth) in log.rows.iter().zip(&log.truth) {
        hit += usize::from((row[1] - truth.x).hypot(row[2] - truth.y) > 1.0);
        assert!(row[3] > -std::f64::consts::PI && row[3] <= std::f64::consts::PI);
        near(row[3].sin(), truth.heading.sin(), 1e-12);
        near(row[3].cos(), truth.heading.cos(), 1e-12);
    }
    assert!((45..110).contains(&hit), "{hit} outliers");
}

#[test]
fn drives_are_varied_turn_both_ways_and_stay_in_range() {
    for tractor in TRACTORS {
        for seed in 0..6 {
            let log = Scenario::new(tractor, seed).run();
            let yaw = || log.truth.iter().map(|truth| truth.yaw);
            let speed = || log.truth.iter().map(|truth| truth.v_l);
            let most = yaw().fold(0.0, f64::max);
            let least = yaw().fold(0.0, f64::min);
            let fastest = speed().fold(0.0, f64::max);
            let slowest = speed().fold(f64::MAX, f64::min);
            assert!(most > 0.1 && least < -0.1, "{tractor:?} {seed} turns one way");
            assert!(slowest > 0.2 && fastest > 1.3 * slowest, "{tractor:?} {seed}");
        }
    }
}

#[test]
fn csv_holds_nine_digits_and_the_columns_of_the_model() {
    let scenario = Scenario { logs_speed: true, logs_heading: false, ..short(Tractor::Unicycle, 23) };
    let text = scenario.run().to_csv(9);
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("t,x,y,speed,phi_dot"));
    let digits = |cell: &str| {
        let bare = cell.replace(['-', '.'], "");
        bare.trim_start_matches('0').len()
    };
    assert!(lines.flat_map(|line| line.split(',')).all(|cell| digits(cell) <= 9));
    let model: toml::Table = toml::from_str(&scenario.model_toml()).expect("TOML");
    assert_eq!(model["columns"]["speed"].as_str(), Some("speed"));
    assert!(model["columns"].get("heading").is_none());
}

#[test]
fn the_answer_names_what_is_hidden_in_the_words_of_the_contract() {
    let hiding = |hidden: &[Hidden]| Scenario { hidden: hidden.to_vec(), ..short(Tractor::Unicycle, 27) };
    let creep = Hidden::RotationCreep { e_rc: 0.03 };
    let cornering = Hidden::CorneringCreep { mass_over_bt: 0.1 };
    let answer = hiding(&[creep, cornering]).answer();
    assert_eq!(answer["verdict"], "missing-effect");
    assert_eq!(answer["effects"][0]["id"], "rotation-creep");
    assert_eq!(answer["effects"][0]["parameters"]["e_rc"], 0.03);
    assert_eq!(answer["effects"][1]["id"], "cornering-creep");
    assert_eq!(answer["effects"][1]["parameters"]["mass_over_bT"], 0.1);
    assert_eq!(hiding(&[]).answer()["verdict"], "no-missing-effect");
    let beyond = hiding(&[creep, Hidden::YawSquareSlip { q: 0.1 }]).answer();
    assert_eq!(beyond["verdict"], "unnamed-effect");
    assert_eq!(beyond["effects"].as_array().map(Vec::len), Some(1));
}
