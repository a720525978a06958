//! Vehicles and effects of a user's own with sections and states that the catalogue's do not have: every command takes them.

use crate::program::creepage;
use crate::simulator::{Noise, Scenario, Tractor};
use std::path::Path;

#[track_caller]
fn succeeds(dir: &Path, arguments: &[&str]) -> String {
    let output = creepage(dir, arguments);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {said}");
    String::from_utf8(output.stdout).unwrap()
}

/// A log of what a model does: its simulated poses, with the inputs of a time.
fn log(dir: &Path, model: &str, inputs: &str, columns: &[&str], of: impl Fn(f64) -> Vec<f64>) {
    let rows: Vec<(f64, Vec<f64>)> = (0..=600).map(|i| f64::from(i) * 0.05).map(|t| (t, of(t))).collect();
    let mut text = format!("t,{}\n", columns.join(","));
    for (t, values) in &rows {
        text += &format!("{t},{}\n", values.iter().map(f64::to_string).collect::<Vec<_>>().join(","));
    }
    std::fs::write(dir.join(inputs), text).unwrap();
    succeeds(dir, &["simulate", model, "--inputs", inputs, "--out", "motion.csv"]);
    let motion = std::fs::read_to_string(dir.join("motion.csv")).unwrap();
    let mut motion = motion.lines();
    let heading: Vec<&str> = motion.next().unwrap().split(',').collect();
    let at = ["x", "y", "heading"].map(|name| heading.iter().position(|h| *h == name).unwrap());
    let mut text = format!("t,x,y,phi,{}\n", columns.join(","));
    for (i, ((t, values), line)) in rows.iter().zip(motion).enumerate() {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        // A millimetre of scatter: nothing measures exactly.
        let noise = 1e-3 * [0.3, -1.2, 0.7, 1.1, -0.6, -0.9, 0.4][i % 7];
        let pose = at.map(|c| (cells[c] + noise).to_string()).join(",");
        text += &format!("{t},{pose},{}\n", values.iter().map(f64::to_string).collect::<Vec<_>>().join(","));
    }
    std::fs::write(dir.join("run.csv"), text).unwrap();
}

const BUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/bus");

#[test]
fn a_bus_is_checked_and_its_clocks_are_aligned() {
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    for file in ["bus.toml", "model.toml"] {
        std::fs::copy(Path::new(BUS).join(file), dir.join(file)).unwrap();
    }
    // What the joint does is not in the log of this test.
    let path = dir.join("model.toml");
    let text = std::fs::read_to_string(&path).unwrap().replace("trailer_headings", "# trailer_headings");
    std::fs::write(&path, text).unwrap();
    let drive = |t: f64| vec![8.0 + (0.5 * t).sin(), 0.15 * (0.7 * t).sin() + 0.05 * (1.9 * t).cos()];
    log(dir, "model.toml", "inputs.csv", &["wheel_rate", "steering_angle"], drive);
    let said = succeeds(dir, &["check", "run.csv", "--model", "model.toml"]);
    assert!(said.contains("run.csv"), "{said}");
    let said =
        succeeds(dir, &["discover", "run.csv", "--truth", "run.csv", "--model", "model.toml", "--out", "report"]);
    assert!(said.contains("clock of run.csv: offset"), "{said}");
}

/// Nobody reads how far the wheel is worn but the creep it makes, and the state is not among what it hangs on.
#[test]
fn a_state_that_does_not_read_itself_is_weighed() {
    let own = "[[effect]]\nid = \"wear\"\nwhere = \"traverse constraint\"\nsays = \"creep grows with distance\"\n\
               [effect.parameters.k]\nunit = \"1/s\"\nrange = [-10.0, 10.0]\nsize = 0.01\n\
               [effect.states.u]\nunit = \"m/s\"\nrate = \"k*v_l\"\n[effect.changes]\nv_t = \"it + u\"\n";
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    std::fs::write(dir.join("own.toml"), own).unwrap();
    let scenario = Scenario { noise: Noise::MOCAP, duration: 20.0, ..Scenario::new(Tractor::Unicycle, 5) };
    std::fs::write(dir.join("model.toml"), scenario.model_toml()).unwrap();
    std::fs::write(dir.join("run.csv"), scenario.run().to_csv(9)).unwrap();
    let with = ["--model", "model.toml", "--effects", "own.toml"];
    succeeds(dir, &[&["check", "run.csv"], &with[..]].concat());
    let said = succeeds(dir, &[&["discover", "run.csv", "--out", "report"], &with[..]].concat());
    assert!(!said.contains("Missing effect"), "{said}");
}

/// The rope cart of CONTRIBUTING, its drum out of centre: a constraint reads an angle that the motion carries along.
#[test]
fn a_constraint_that_reads_a_carried_coordinate_moves_in_every_command() {
    let vehicle = r#"[[vehicle]]
id = "eccentric"
title = "a cart pulled by a drum that is out of centre"
parameters.drum_radius = { unit = "m", meaning = "radius of the drum" }
parameters.off = { unit = "m", meaning = "its axis out of its centre" }
inputs.drum_rate = { unit = "rad/s", meaning = "rate of the drum" }
inputs.yaw_rate = { unit = "rad/s", meaning = "yaw rate" }
heading = "phi"
coordinates = [
  { name = "x", unit = "m", meaning = "along x" },
  { name = "y", unit = "m", meaning = "along y" },
  { name = "phi", unit = "rad", meaning = "heading" },
  { name = "theta", unit = "rad", meaning = "drum" },
]
[vehicle.define]
"theta'" = { formula = "drum_rate", unit = "rad/s", meaning = "rate of the drum" }
"phi'" = { formula = "yaw_rate", unit = "rad/s", meaning = "yaw rate" }
[[vehicle.wheels]]
name = "axle"
traverse_creep = "e_tc"
[[vehicle.constraints]]
name = "rope"
creep = "e_rc"
type = { id = "cable", letter = "C", form = "pays' - (1 - e)*drum*turns'" }
slots = { "pays'" = "cos(phi)*x' + sin(phi)*y'", drum = "drum_radius + off*cos(theta)", "turns'" = "theta'" }
"#;
    let model = "vehicle = \"eccentric\"\nvehicles = \"own.toml\"\n[parameters]\ndrum_radius = 0.1\noff = 0.05\n[columns]\ntime = \"t\"\nheading = \"phi\"\n";
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    std::fs::write(dir.join("own.toml"), vehicle).unwrap();
    std::fs::write(dir.join("model.toml"), model).unwrap();
    // The drum begins at θ = 0 and turns 2 rad/s: the way is 0.1·θ + 0.05·sin θ.
    log(dir, "model.toml", "inputs.csv", &["drum_rate", "yaw_rate"], |_| vec![2.0, 0.0]);
    let motion = std::fs::read_to_string(dir.join("motion.csv")).unwrap();
    let x = |row: usize| -> f64 { motion.lines().nth(1 + row).unwrap().split(',').nth(1).unwrap().parse().unwrap() };
    for (row, theta) in [(10, 1.0_f64), (31, 3.1), (600, 60.0)] {
        assert!((x(row) - 0.1 * theta - 0.05 * theta.sin()).abs() < 1e-8, "{}", x(row));
    }
    let sweep = "model = \"model.toml\"\nduration = 5.0\nevery = 5.0\n[inputs]\ndrum_rate = \"2.0\"\nyaw_rate = \"0\"\n\
                 [grid]\noff = [0.01, 0.05]\n";
    std::fs::write(dir.join("sweep.toml"), sweep).unwrap();
    succeeds(dir, &["sweep", "sweep.toml", "--out", "table.csv"]);
    let table = std::fs::read_to_string(dir.join("table.csv")).unwrap();
    let column = table.lines().next().unwrap().split(',').position(|name| name == "x").unwrap();
    let swept: Vec<f64> = table.lines().skip(1).map(|l| l.split(',').nth(column).unwrap().parse().unwrap()).collect();
    let last = [swept[1], swept[3]];
    assert!(
        (last[0] - 1.0 - 0.01 * 10.0_f64.sin()).abs() < 1e-9 && (last[1] - 1.0 - 0.05 * 10.0_f64.sin()).abs() < 1e-9,
        "{table}"
    );
    succeeds(dir, &["check", "run.csv", "--model", "model.toml"]);
    succeeds(dir, &["discover", "run.csv", "--model", "model.toml", "--out", "report"]);
}
