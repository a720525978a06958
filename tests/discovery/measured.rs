//! What is measured beside the pose: a gyro, encoders of wheels, an accelerometer.

use crate::forces_simulator::{Drive, Make, Secret};
use crate::hidden_forces::{self, parse};
use creepage::discrepancy::report::{Estimate, Named, Report, Verdict};
use creepage::files::{ModelFile, Run};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;

/// What `discover` says of a run, and the model that it patched.
fn asked(file: &ModelFile, run: &Run) -> (Report, ModelFile) {
    let discovery = hidden_forces::asked(file, run);
    let patched = parse(&discovery.patched(file));
    (discovery.report, patched)
}

fn ids(report: &Report) -> Vec<&str> {
    report.effects.iter().map(|e| e.id.as_str()).collect()
}

/// A robot by its torques, logged with a gyro and encoders by a simulator of its own, and by its pose alone.
fn robot(secret: Option<Secret>) -> [(ModelFile, Run); 2] {
    let drive = Drive { make: Make::DifferentialDrive, seed: 12, seconds: 24.0, secret, sensors: true };
    let run = drive.runs(1).remove(0);
    let bare = run.model.split("[measured]").next().unwrap().to_string();
    [run.model.clone(), bare].map(|model| {
        let file = parse(&model);
        let run = Run::parse("run.csv", &run.csv, &file).unwrap();
        (file, run)
    })
}

/// How far wheels slip under a torque is seen by encoders; by the pose alone it is as good as nothing.
#[test]
fn encoders_tell_what_the_pose_does_not() {
    let secret = Secret { id: "traction", trailer: None, values: vec![("scale", 0.4)] };
    let [with, alone] = robot(Some(secret)).map(|(file, run)| asked(&file, &run).0);
    assert_eq!(ids(&with), ["traction"], "{}", with.summary);
    let scale = &with.effects[0].parameters["scale"];
    assert!((scale.value - 0.4).abs() < 4.0 * scale.std.unwrap() + 4e-3, "{scale:?}");
    assert!(alone.effects.iter().all(|e| e.id != "traction"), "{}", alone.summary);
}

/// A skid steer has no kinematic model for its encoders to drive: its log is read by its forces alone.
#[test]
fn a_skid_steer_with_encoders_is_read_by_its_forces() {
    let secret = Secret { id: "mass", trailer: None, values: vec![("scale", 0.3)] };
    let drive = Drive { make: Make::SkidSteer, seed: 7, seconds: 24.0, secret: Some(secret), sensors: true };
    let run = drive.runs(1).remove(0);
    let file = parse(&run.model);
    let (report, _) = asked(&file, &Run::parse("run.csv", &run.csv, &file).unwrap());
    assert!(ids(&report) == ["mass"] && report.kinematic.is_none(), "{}", report.summary);
}

/// Nothing is hidden and nothing named; a bias that the gyro is given is, with its size.
#[test]
fn a_bias_of_the_gyro_is_named_as_the_sensor_s() {
    let [(file, run), _] = robot(None);
    let (report, _) = asked(&file, &run);
    assert_eq!(report.verdict, Verdict::NoMissingEffect, "{}", report.summary);
    let sensors = &report.remaining.as_ref().unwrap().sensors;
    assert_eq!(
        sensors.iter().map(|s| s.name.as_str()).collect::<Vec<_>>(),
        ["yaw_rate", "wheel_rate_right", "wheel_rate_left"]
    );
    assert!(sensors.iter().zip([0.01, 0.05, 0.05]).all(|(s, noise)| (s.rms / noise - 1.0).abs() < 0.1), "{sensors:?}");
    let mut biased = run.clone();
    biased.measured[0].iter_mut().for_each(|rate| *rate += 0.03);
    let (report, patched) = asked(&file, &biased);
    assert_eq!(ids(&report), ["sensor-bias"], "{}", report.summary);
    assert_eq!(report.effects[0].on.as_deref(), Some("yaw_rate"));
    let bias = &report.effects[0].parameters["bias"];
    assert!((bias.value - 0.03).abs() < 4.0 * bias.std.unwrap(), "{bias:?}");
    // The patched file says so, and with it nothing is missing.
    assert!(patched.text.contains("measured = \"yaw_rate\""), "{}", patched.text);
    assert_eq!(asked(&patched, &biased).0.verdict, Verdict::NoMissingEffect);
}

/// A sensor that no effect explains is not passed over: the poses alone would have been explained.
#[test]
fn a_sensor_that_disagrees_is_said() {
    let [(file, run), _] = robot(None);
    let mut late = run.clone();
    late.measured[0] = [vec![run.measured[0][0]; 8], run.measured[0][..run.time.len() - 8].to_vec()].concat();
    let (report, _) = asked(&file, &late);
    assert_ne!(report.verdict, Verdict::NoMissingEffect, "{}", report.summary);
    assert!(report.data.warnings.iter().any(|w| w.contains("yaw_rate")), "{:?}", report.data.warnings);
    let gyro = &report.remaining.as_ref().unwrap().sensors[0];
    assert!(gyro.rms > 2.0 * gyro.noise, "{gyro:?}");
}

/// A few wild cells of a sensor drop their rows, and change no verdict.
#[test]
fn wild_cells_of_a_sensor_go_with_their_rows() {
    let [(file, run), _] = robot(None);
    let mut wild = run.clone();
    [100, 101, 330].into_iter().for_each(|i| wild.measured[0][i] += 40.0);
    let (report, _) = asked(&file, &wild);
    assert_eq!(report.verdict, Verdict::NoMissingEffect, "{}", report.summary);
    assert_eq!(report.data.rows_dropped, 3, "{:?}", report.data.why_dropped);
}

/// A kinematic vehicle: a gyro of its own beside the logged yaw rate, and the sideways acceleration, whose formulas read the
/// inputs, their rates and hidden states.
#[test]
fn a_kinematic_vehicle_is_measured_by_formulas_of_its_motion() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let mut noise = |sigma: f64| sigma * random.sample::<f64, _>(StandardNormal);
    let (dt, creep) = (0.02, 0.06);
    let mut csv = "time,wheel_rate,yaw_rate,x,y,heading,gyro,a_x,a_y\n".to_string();
    let rate = |t: f64| 4.0 + 2.0 * (0.7 * t).sin();
    let turn = |t: f64| 0.6 * (0.9 * t).sin() + 0.3;
    let [mut x, mut y, mut heading, mut w] = [0.0; 4];
    for i in 0..1500 {
        let t = dt * f64::from(i);
        let om = turn(t);
        // w' = -phi'*v_l - w/creep; a_x = v' - w·phi', a_y = w' + v·phi'.
        let (a_x, a_y) = (0.7 * (0.7 * t).cos() - w * om, -w / creep);
        let row = [t, rate(t), om, x + noise(5e-3), y + noise(5e-3), heading + noise(0.01)];
        let row = row.into_iter().chain([om + noise(0.02), a_x + noise(0.05), a_y + noise(0.05)]);
        csv += &(row.map(|v| format!("{v:.7}")).collect::<Vec<_>>().join(",") + "\n");
        for k in 0..40 {
            let (h, s) = (dt / 40.0, t + dt / 40.0 * (f64::from(k) + 0.5));
            let (v, om) = (0.5 * rate(s), turn(s));
            heading += 0.5 * h * om;
            x += h * (v * heading.cos() - w * heading.sin());
            y += h * (v * heading.sin() + w * heading.cos());
            heading += 0.5 * h * om;
            w = (w + om * v * creep) * (-h / creep).exp() - om * v * creep;
        }
    }
    let text = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n[measured]\n\
                gyro = { column = \"gyro\", formula = \"phi'\", unit = \"rad/s\" }\n\
                acceleration = \"a_x\"\nlateral_acceleration = { column = \"a_y\", noise = 0.05 }\n";
    let file = parse(text);
    let run = Run::parse("run.csv", &csv, &file).unwrap();
    let (report, _) = asked(&file, &run);
    assert_eq!(ids(&report), ["cornering-creep"], "{}", report.summary);
    let value = &report.effects[0].parameters["mass_over_bT"];
    assert!((value.value - creep).abs() < 4.0 * value.std.unwrap() + 2e-4, "{value:?}");
    for (sensor, noise) in report.remaining.as_ref().unwrap().sensors.iter().zip([0.02, 0.05, 0.05]) {
        assert!((sensor.rms / noise - 1.0).abs() < 0.15, "{sensor:?}");
    }
}

/// The kinematic model of the same log stands beside the one with forces, and its coefficients are what the forces predict.
#[test]
fn creep_that_wheels_show_is_what_forces_predict() {
    let [(file, run), (bare, alone)] = robot(None);
    let (report, _) = asked(&file, &run);
    let beside = report.kinematic.as_ref().unwrap();
    let quasi_static = ["input-delay", "cornering-creep", "load-dependent-creep"];
    let found = beside.report.effects.iter().enumerate().filter(|(_, e)| quasi_static.contains(&e.id.as_str()));
    let pairs = |(i, e): (usize, &Named)| {
        let pair = |(name, of): (&String, &Estimate)| (of.value, beside.predicted(i, name).unwrap());
        e.parameters.iter().map(pair).collect::<Vec<(f64, f64)>>()
    };
    let predicted: Vec<(f64, f64)> = found.flat_map(pairs).collect();
    assert!(!predicted.is_empty(), "{}", beside.report.summary);
    assert!(predicted.iter().all(|(a, b)| (a / b - 1.0).abs() < 0.15), "{predicted:?}");
    // Where nothing of the wheels is measured there is nothing to compare with.
    assert!(asked(&bare, &alone).0.kinematic.is_none());
}
