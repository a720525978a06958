//! Logs in a robot's own format, written as a logger would: `init`, what it asks for, and `discover` names what is hidden.

use crate::program::{creepage, stderr};
use crate::simulator::{Hidden, Log, Noise, Scenario, Timing, Tractor};
use std::path::Path;

/// A log of a robot, and what its user answers to `init`.
struct Robot {
    vehicle: &'static str,
    text: String,
    /// What `init` says of the file that it writes.
    says: &'static str,
    /// A line of the model file, and what the user makes of it.
    edits: Vec<(String, String)>,
    names: &'static str,
}

/// One nanosecond in a second.
const NANO: f64 = 1e9;
/// A second of the year 2023.
const START: i64 = 1_700_000_000;

fn drive(tractor: Tractor, hidden: Hidden, seed: u64) -> Scenario {
    Scenario {
        hidden: vec![hidden],
        duration: 60.0,
        noise: Noise::MOCAP,
        logs_speed: true,
        ..Scenario::new(tractor, seed)
    }
}

/// Columns by name, a line for every row.
fn lines(log: &Log, header: &str, line: impl Fn(usize, &dyn Fn(&str) -> f64) -> String) -> String {
    let row = |i: usize| line(i, &|name: &str| log.column(name)[i]);
    let rows: Vec<String> = (0..log.rows.len()).map(row).collect();
    format!("{header}{}\n", rows.join("\n"))
}

fn radius(scenario: &Scenario) -> (String, String) {
    ("wheel_radius = 0.1 ".into(), format!("wheel_radius = {} ", scenario.parameters.wheel_radius))
}

/// Answers `init`, and gives what `discover` names.
fn named(folder: &Path, robot: &Robot) -> Vec<String> {
    std::fs::write(folder.join("run.csv"), &robot.text).unwrap();
    let output = creepage(folder, &["init", robot.vehicle, "--from", "run.csv"]);
    let said = String::from_utf8(output.stdout.clone()).unwrap();
    assert!(output.status.success() && said.contains(robot.says), "{said}{}", stderr(&output));
    let path = folder.join("model.toml");
    let mut model = std::fs::read_to_string(&path).unwrap();
    for (from, to) in &robot.edits {
        assert!(model.contains(from), "{from} in\n{model}");
        model = model.replacen(from, to, 1);
    }
    std::fs::write(&path, &model).unwrap();
    let output = creepage(folder, &["discover", "run.csv", "--model", "model.toml", "--out", "out"]);
    assert!(output.status.success(), "{}\n{model}", stderr(&output));
    let report = std::fs::read_to_string(folder.join("out/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let effects = report["effects"].as_array().unwrap().iter();
    effects.map(|e| e["id"].as_str().unwrap().to_string()).collect()
}

fn check(robot: &Robot) {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(named(folder.path(), robot), [robot.names]);
}

/// What `ros2 bag` exports as CSV: the stamp in two columns, a quaternion, forward speed and yaw rate.
#[test]
fn a_quaternion_and_a_stamp_in_two_columns() {
    let scenario = drive(Tractor::Unicycle, Hidden::CorneringCreep { mass_over_bt: 0.12 }, 11);
    let header = "header.stamp.sec,header.stamp.nanosec,pose.position.x,pose.position.y,pose.position.z,\
                  pose.orientation.x,pose.orientation.y,pose.orientation.z,pose.orientation.w,twist.linear.x,twist.angular.z\n";
    let text = lines(&scenario.run(), header, |_, v| {
        let stamp = START * 1_000_000_000 + (v("t") * NANO).round() as i64;
        let (sin, cos) = (0.5 * v("phi")).sin_cos();
        format!(
            "{},{},{},{},0.0,0.0,0.0,{sin},{cos},{},{}",
            stamp / 1_000_000_000,
            stamp % 1_000_000_000,
            v("x"),
            v("y"),
            v("speed"),
            v("phi_dot")
        )
    });
    check(&Robot {
        vehicle: "unicycle",
        text,
        says: "valid as it stands",
        edits: vec![radius(&scenario)],
        names: "cornering-creep",
    });
}

/// Encoder counts that roll over at 16 bits, and milliseconds.
#[test]
fn cumulative_counts() {
    let scenario = Scenario {
        timing: Timing::IntervalMean,
        ..drive(Tractor::DifferentialDrive, Hidden::TrackWidth { scale: 0.04 }, 12)
    };
    let log = scenario.run();
    let times = log.column("t");
    let counts = |name: &str| {
        let mut angle = 0.0;
        let rates = log.column(name);
        let turned = (0..rates.len()).map(|i| {
            angle += if i == 0 { 0.0 } else { rates[i] * (times[i] - times[i - 1]) };
            ((angle * 4096.0 / std::f64::consts::TAU).floor() as i64 + 32_000).rem_euclid(65_536)
        });
        turned.collect::<Vec<i64>>()
    };
    let [left, right] = ["wheel_rate_left", "wheel_rate_right"].map(|role| {
        let column = scenario.roles().into_iter().find(|(r, _)| *r == role).unwrap().1;
        counts(column)
    });
    assert!(left.windows(2).any(|w| (w[1] - w[0]).abs() > 32_768), "they roll over");
    let text = lines(&log, "timestamp_ms,left_ticks,right_ticks,x,y,theta\n", |i, v| {
        format!("{},{},{},{},{},{}", (v("t") * 1e3).round(), left[i], right[i], v("x"), v("y"), v("phi"))
    });
    let mut edits = vec![radius(&scenario)];
    edits.push(("ticks_per_turn = 1000 }".into(), "ticks_per_turn = 4096 }".into()));
    edits.push(("ticks_per_turn = 1000 }".into(), "ticks_per_turn = 4096 }".into()));
    edits.push(("track_width = 0.4 ".into(), format!("track_width = {} ", scenario.parameters.track_width)));
    check(&Robot { vehicle: "differential-drive", text, says: "ticks_per_turn", edits, names: "track-width" });
}

/// Degrees and kilometres an hour, of a car.
#[test]
fn degrees_and_kilometres_an_hour() {
    let scenario = Scenario {
        logs_speed: false,
        wrap_heading: true,
        ..drive(Tractor::Car, Hidden::SteeringOffset { offset: 0.02 }, 13)
    };
    let roles = scenario.roles();
    let column = |role: &str| roles.iter().find(|(r, _)| *r == role).unwrap().1;
    let r = scenario.parameters.wheel_radius;
    let text = lines(&scenario.run(), "time,x,y,yaw_deg,speed_kmh,steering_deg\n", |_, v| {
        let (speed, steering) = (3.6 * r * v(column("wheel_rate")), v(column("steering_angle")).to_degrees());
        format!("{},{},{},{},{speed},{steering}", v("t"), v("x"), v("y"), v("phi").to_degrees())
    });
    let edits =
        vec![radius(&scenario), ("wheelbase = 0.5 ".into(), format!("wheelbase = {} ", scenario.parameters.wheelbase))];
    check(&Robot { vehicle: "car", text, says: "valid as it stands", edits, names: "steering-offset" });
}

/// A receiver of satellites with dates, and a compass.
#[test]
fn latitude_longitude_and_a_compass() {
    let scenario = drive(Tractor::Unicycle, Hidden::YawRateScale { scale: 0.05 }, 14);
    let (latitude, longitude) = (52.5f64, 13.4f64);
    // Radii of curvature of WGS 84.
    let (a, e2) = (6_378_137.0, 0.006_694_379_990_14);
    let w = 1.0 - e2 * latitude.to_radians().sin().powi(2);
    let (meridian, parallel) = (a * (1.0 - e2) / w.powf(1.5), a / w.sqrt() * latitude.to_radians().cos());
    let text = lines(&scenario.run(), "time,latitude,longitude,heading_deg,v,gyro_z_dps\n", |_, v| {
        let t = v("t");
        let heading = (90.0 - v("phi").to_degrees()).rem_euclid(360.0);
        format!(
            "2026-01-31T10:{:02}:{:09.6}Z,{:.10},{:.10},{heading},{},{}",
            (t / 60.0) as u32,
            t % 60.0,
            latitude + (v("y") / meridian).to_degrees(),
            longitude + (v("x") / parallel).to_degrees(),
            v("speed"),
            v("phi_dot").to_degrees()
        )
    });
    let says = "{ column = \"heading_deg\", unit = \"deg\", zero = \"north\", turn = \"clockwise\" }";
    check(&Robot { vehicle: "unicycle", text, says, edits: vec![radius(&scenario)], names: "yaw-rate-scale" });
}

/// What an outer merge of two topics writes: no row has both inputs and a pose.
#[test]
fn an_outer_merge() {
    let scenario = drive(Tractor::Unicycle, Hidden::CorneringCreep { mass_over_bt: 0.12 }, 15);
    let poses = Scenario { rate: 20.0, jitter: 0.3, seed: 16, ..scenario.clone() }.run();
    let mut rows: Vec<(f64, String)> = vec![];
    rows.extend(scenario.run().rows.iter().map(|row| (row[0], format!("{},{},,,", row[4], row[5]))));
    rows.extend(poses.rows.iter().map(|row| (row[0], format!(",,{},{},{}", row[1], row[2], row[3]))));
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let rows: Vec<String> = rows.iter().map(|(t, cells)| format!("{t},{cells}")).collect();
    let text = format!("t,v,w,x,y,phi\n{}\n", rows.join("\n"));
    let edits = vec![radius(&scenario)];
    check(&Robot { vehicle: "unicycle", text, says: "valid as it stands", edits, names: "cornering-creep" });
}

/// Numbers without a header, semicolons between them and commas in them.
#[test]
fn semicolons_without_a_header() {
    let scenario = drive(Tractor::Unicycle, Hidden::TraverseCreep { e_tc: 0.05 }, 17);
    let text = lines(&scenario.run(), "", |_, v| {
        let cells = ["t", "speed", "phi_dot", "x", "y", "phi"].map(|name| format!("{:.6}", v(name)).replace('.', ","));
        cells.join(";")
    });
    let named = |role: &str, column: u32| (format!("# {role} = \"…\""), format!("{role} = {column}"));
    let mut edits = vec![named("x", 4), named("y", 5), named("yaw_rate", 3), radius(&scenario)];
    edits.push(("# wheel_rate = \"…\"".into(), "speed = 2 ".into()));
    edits.push(("# heading = \"heading\"".into(), "heading = 6".into()));
    let says = "not complete: name x, y, wheel_rate, yaw_rate";
    check(&Robot { vehicle: "unicycle", text, says, edits, names: "traverse-creep" });
}
