//! `creepage plan`: goals that are reached under creep, by how much a plan without it misses, and what is told of the others.

use crate::program::{creepage, stderr};
use serde_json::Value;
use std::fs;
use std::path::Path;

const WHEEL: &str = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n";
const DRIVE: &str = "vehicle = \"differential-drive\"\ninput_timing = \"interval-mean\"\n[parameters]\nwheel_radius = 0.06\ntrack_width = 0.32\n";
const CAR: &str = "vehicle = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.0\n";

fn effect(id: &str, values: &str) -> String {
    format!("[[effects]]\nid = \"{id}\"\n{values}\n")
}

/// Plans for a model, and gives the report.
fn planned(folder: &Path, model: &str, arguments: &[&str]) -> Value {
    fs::write(folder.join("model.toml"), model).unwrap();
    let output = creepage(folder, &[&["plan", "model.toml", "--format", "json"], arguments].concat());
    assert_eq!(output.status.code(), Some(0), "{model}{arguments:?}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Where `simulate` ends with a plan: x, y, heading.
fn driven(folder: &Path, plan: &str) -> [f64; 3] {
    let output = creepage(folder, &["simulate", "model.toml", "--inputs", plan, "--out", "path.csv"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let text = fs::read_to_string(folder.join("path.csv")).unwrap();
    let last: Vec<f64> = text.lines().last().unwrap().split(',').map(|c| c.parse().unwrap()).collect();
    [last[1], last[2], last[3]]
}

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| panic!("{v} is no number"))
}

#[test]
fn goals_are_reached_and_the_file_that_is_written_drives_there() {
    let dir = tempfile::tempdir().unwrap();
    for (model, goal) in [
        (WHEEL.to_string() + &effect("cornering-creep", "mass_over_bT = 0.11"), [2.0, 1.0, 1.57]),
        (DRIVE.to_string() + &effect("track-width", "scale = 0.035"), [-1.0, 0.5, 3.0]),
        (
            CAR.to_string() + &effect("understeer", "gradient = 0.02") + &effect("traverse-creep", "e_tc = 0.03"),
            [0.0, -1.2, 0.0],
        ),
        // The steering begins where the plan begins with it.
        (CAR.to_string() + &effect("input-lag", "input = \"steering_angle\"\ntime_constant = 0.3"), [-4.0, -1.6, 0.0]),
    ] {
        let goal_text = goal.map(|v: f64| v.to_string()).join(",");
        let found = planned(dir.path(), &model, &["--goal", &goal_text, "--out", "plan.csv"]);
        assert!(number(&found["reached"]["miss_m"]) < 1e-8, "{found:#}");
        let end = driven(dir.path(), "plan.csv");
        assert!((0..3).all(|i| (end[i] - goal[i]).abs() < 1e-8), "{end:?} {goal:?}");
        // The ideal plan is no plan for this vehicle.
        assert!(number(&found["ideal"]["reached"]["miss_m"]) > 1e-3, "{found:#}");
    }
}

/// Inputs that act late are commanded early, those that do not wait for them; what moves the vehicle while it waits counts.
#[test]
fn inputs_that_act_late_are_commanded_ahead() {
    let dir = tempfile::tempdir().unwrap();
    let delay = |input: &str, delay: &str| effect("input-delay", &format!("{input}delay = {delay}"));
    let steering = "input = \"steering_angle\"\n";
    let left = "input = \"wheel_rate_left\"\n";
    let drift = effect("drift", "vx = 0.01\nvy = 0.0");
    for (model, misses, goal) in [
        (CAR.to_string() + &delay("", "0.2"), false, [4.0, 1.0, 0.5]),
        (CAR.to_string() + &delay(steering, "0.2"), true, [4.0, 1.0, 0.5]),
        // A log that is late.
        (WHEEL.to_string() + &delay("", "-0.15"), true, [1.0, -0.5, 0.0]),
        (DRIVE.to_string() + &delay("", "0.05") + &delay(left, "0.11") + &drift, true, [-1.0, 0.5, 3.0]),
    ] {
        let goal_text = goal.map(|v: f64| v.to_string()).join(",");
        let found = planned(dir.path(), &model, &["--goal", &goal_text, "--out", "plan.csv"]);
        assert!(number(&found["reached"]["miss_m"]) < 1e-8, "{found:#}");
        let end = driven(dir.path(), "plan.csv");
        let turned = (end[2] - goal[2]) / std::f64::consts::TAU;
        assert!((0..2).all(|i| (end[i] - goal[i]).abs() < 1e-8) && (turned - turned.round()).abs() < 1e-8, "{end:?}");
        // All inputs late alike, a vehicle only arrives later.
        assert_eq!(number(&found["ideal"]["reached"]["miss_m"]) > 2e-3, misses, "{found:#}");
        let asked = planned(dir.path(), &model, &["--goal", &goal_text, "--duration", "15", "--out", "plan.csv"]);
        assert!((number(&asked["duration_s"]) - 15.0).abs() < 1e-9 && number(&asked["reached"]["miss_m"]) < 1e-8);
    }
}

/// A limit and a dead band have no slope where they act, play has a memory, and counts that are cut off jump: goals are reached all
/// the same.
#[test]
fn inputs_with_kinks_are_planned_for() {
    let dir = tempfile::tempdir().unwrap();
    let short = CAR.replace("wheelbase = 2.0", "wheelbase = 0.5");
    let on_steering = |id: &str, value: &str| effect(id, &format!("input = \"steering_angle\"\n{value}"));
    let goal = [2.0, 1.0, 0.5];
    for (id, value) in [
        ("input-saturation", "limit = 0.3"),
        ("input-dead-band", "width = 0.03"),
        ("input-backlash", "width = 0.03"),
        ("input-truncation", "step = 0.03"),
    ] {
        let model = short.clone() + &on_steering(id, value);
        let found = planned(dir.path(), &model, &["--goal", "2,1,0.5", "--out", "plan.csv"]);
        assert!(number(&found["reached"]["miss_m"]) < 1e-6, "{found:#}");
        assert!(number(&found["ideal"]["reached"]["miss_m"]) > 0.02, "{found:#}");
        let end = driven(dir.path(), "plan.csv");
        assert!((0..3).all(|i| (end[i] - goal[i]).abs() < 1e-6), "{id}: {end:?}");
    }
}

/// A speed that follows the wheels is none at rest: what a way usually takes is judged by what it comes to.
#[test]
fn a_speed_that_lags_is_driven_in_a_usual_time() {
    let dir = tempfile::tempdir().unwrap();
    let lagging = CAR.to_string() + &effect("traction-creep", "mass_over_bR = 0.04");
    let arguments = ["--goal=-6,-8,0.4", "--out", "plan.csv"];
    let found = planned(dir.path(), &lagging, &arguments);
    let ideal = number(&found["ideal"]["duration_s"]);
    assert!((number(&found["duration_s"]) / ideal - 1.0).abs() < 0.1, "{found:#}");
    // The plan without effects is found from the one with them, and would be long beside a long one: 559 s and 38 m once.
    assert!(number(&found["duration_s"]) < 30.0 && number(&found["length_m"]) < 15.0, "{found:#}");
}

/// A train is backed, not driven about: what a second costs is the same wherever the search begins, and trailers begin where they
/// would be drawn from. With a detour the ways are of 12.7 m and of 33 m.
#[test]
fn trains_are_backed_without_detours() {
    let dir = tempfile::tempdir().unwrap();
    for (lengths, of, goal, most) in [("1.5", "0", "-8,1.5,0.2", 11.0), ("1.5, 1.5, 1.5", "3", "-10,3,0", 20.0)] {
        let offsets = lengths.replace("1.5", "0.0");
        let model = format!(
            "vehicle = \"n-trailer\"\ntractor = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.0\n\
             trailer_lengths = [{lengths}]\nhitch_offsets = [{offsets}]\n{}",
            effect("traverse-creep", "e_tc = 0.03")
        );
        let goal = format!("--goal={goal}");
        let found = planned(dir.path(), &model, &[&goal, "--of-trailer", of, "--out", "plan.csv"]);
        assert!(number(&found["reached"]["miss_m"]) < 1e-8, "{found:#}");
        assert!(number(&found["length_m"]) < most, "{found:#}");
    }
}

/// Theory, chapter 09: a plan made on the ideal wheel misses by (κ − 1)·z, whatever it is.
#[test]
fn the_plan_without_creep_misses_by_what_the_theory_says() {
    let dir = tempfile::tempdir().unwrap();
    let (e_rc, e_tc) = (0.08, -0.05);
    let model = WHEEL.to_string()
        + &effect("rotation-creep", &format!("e_rc = {e_rc}"))
        + &effect("traverse-creep", &format!("e_tc = {e_tc}"));
    for goal in ["2,1,0.5", "-1,1.5,2"] {
        let found = planned(dir.path(), &model, &["--goal", goal, "--out", "plan.csv"]);
        let z: Vec<f64> = goal.split(',').map(|v| v.parse().unwrap()).collect();
        let miss = [-e_rc * z[0] - (1.0 - e_rc) * e_tc * z[1], (1.0 - e_rc) * e_tc * z[0] - e_rc * z[1]];
        let reached = &found["ideal"]["reached"];
        let there = [number(&reached["x"]), number(&reached["y"])];
        assert!((0..2).all(|i| (there[i] - z[i] - miss[i]).abs() < 1e-8), "{found:#}");
        assert!(number(&reached["miss_rad"]).abs() < 1e-8);
    }
}

/// Limits hold at every row, also between the ends; a path is followed; poses on the way are passed; a trailer reaches a goal.
#[test]
fn limits_paths_ways_and_trailers_are_kept_to() {
    let dir = tempfile::tempdir().unwrap();
    let car = CAR.to_string() + &effect("understeer", "gradient = 0.02");
    let limits = ["--limit", "steering_angle=-0.35,0.35", "--limit", "wheel_rate=0,2", "--rate", "steering_angle=0.4"];
    planned(dir.path(), &car, &[&["--goal", "12,3,0.2", "--out", "plan.csv"], &limits[..]].concat());
    let text = fs::read_to_string(dir.path().join("plan.csv")).unwrap();
    let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let column = |name: &str| -> Vec<f64> {
        let k = header.iter().position(|h| *h == name).unwrap();
        text.lines().skip(1).map(|row| row.split(',').nth(k).unwrap().parse().unwrap()).collect()
    };
    let (time, steering, wheel) = (column("time"), column("steering_angle"), column("wheel_rate"));
    assert!(steering.iter().all(|v| v.abs() < 0.35 + 1e-9) && wheel.iter().all(|v| (-1e-9..2.0 + 1e-9).contains(v)));
    let rates = (1..time.len()).map(|i| (steering[i] - steering[i - 1]) / (time[i] - time[i - 1]));
    assert!(rates.into_iter().all(|r| r.abs() < 0.4 + 1e-9));
    assert!(wheel[0].abs() < 1e-9 && wheel[wheel.len() - 1].abs() < 1e-9);

    let lane: String =
        (0..=40).map(|i| 0.25 * f64::from(i)).map(|x| format!("{x},{}\n", 0.5 - 0.5 * (0.3 * x).cos())).collect();
    fs::write(dir.path().join("lane.csv"), format!("x,y\n{lane}")).unwrap();
    let found = planned(dir.path(), &car, &["--path", "lane.csv", "--out", "lane-plan.csv"]);
    assert!(number(&found["off_path_m"]) < 0.03, "{found:#}");

    let wheel = WHEEL.to_string() + &effect("cornering-creep", "mass_over_bT = 0.11");
    planned(dir.path(), &wheel, &["--goal", "2,0,0", "--via", "1,0.8", "--out", "plan.csv"]);
    driven(dir.path(), "plan.csv");
    let path = fs::read_to_string(dir.path().join("path.csv")).unwrap();
    let distance = |row: &str| {
        let at: Vec<f64> = row.split(',').map(|c| c.parse().unwrap()).collect();
        (at[1] - 1.0).hypot(at[2] - 0.8)
    };
    assert!(path.lines().skip(1).map(distance).fold(f64::INFINITY, f64::min) < 1e-6);

    let train = "vehicle = \"n-trailer\"\ntractor = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.0\ntrailer_lengths = [1.5]\nhitch_offsets = [0.3]\n"
        .to_string() + &effect("trailer-traverse-creep", "trailer = 1\ne_tc = 0.04");
    let found = planned(dir.path(), &train, &["--goal=-4,0.5,0", "--of-trailer", "1", "--out", "plan.csv"]);
    assert!(
        number(&found["reached"]["miss_m"]) < 1e-6 && number(&found["ideal"]["reached"]["miss_m"]) > 0.01,
        "{found:#}"
    );
}

#[test]
fn what_is_not_known_of_the_model_spreads_the_end() {
    let dir = tempfile::tempdir().unwrap();
    let model = WHEEL.to_string() + &effect("rotation-creep", "e_rc = 0.05");
    fs::write(
        dir.path().join("report.json"),
        r#"{"covariance": {"names": ["rotation-creep e_rc"], "matrix": [[0.0001]]}}"#,
    )
    .unwrap();
    let found = planned(dir.path(), &model, &["--goal", "2,1,0.5", "--covariance", "report.json", "--out", "plan.csv"]);
    // A hundredth of the distance over what is left of the wheel's rate.
    let expect = 0.01 * 5.0_f64.sqrt() / 0.95;
    assert!((number(&found["spread"]["position_m"]) / expect - 1.0).abs() < 1e-4, "{found:#}");
    assert!(number(&found["spread"]["heading_rad"]) < 1e-9);
}

#[test]
fn a_goal_out_of_reach_is_told_with_the_reason_and_nothing_is_written() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("car.toml"), CAR).unwrap();
    fs::write(dir.path().join("drive.toml"), DRIVE).unwrap();
    fs::write(dir.path().join("synchro.toml"), WHEEL.replace("unicycle", "synchro-drive")).unwrap();
    for (arguments, code, says) in [
        (
            &["car.toml", "--goal", "1,1,1.57", "--limit", "steering_angle=0.0001"][..],
            1,
            "beyond the limits of the inputs",
        ),
        (&["drive.toml", "--goal", "1,1,1.57", "--duration", "1"], 1, "in 1 s"),
        (&["synchro.toml", "--goal", "1,1,1"], 1, "no input of this vehicle changes the heading"),
        (&["drive.toml", "--goal", "1,1"], 2, "X,Y,HEADING"),
        (&["drive.toml"], 2, "--goal"),
        (&["drive.toml", "--goal", "1,1,0", "--limit", "speed=1"], 2, "no input \"speed\""),
        (&["drive.toml", "--goal", "1,1,0", "--of-trailer", "1"], 2, "0 trailers"),
        (&["drive.toml", "--path", "none.csv"], 2, "none.csv"),
        (&["drive.toml", "--goal", "1,1,0", "--start", "0,0,0,1"], 2, "headings of 1 trailers"),
    ] {
        let output = creepage(dir.path(), &[&["plan"], arguments, &["--out", "plan.csv"]].concat());
        assert!(
            output.status.code() == Some(code) && stderr(&output).contains(says),
            "{arguments:?}: {}",
            stderr(&output)
        );
        assert!(!dir.path().join("plan.csv").exists());
    }
}
