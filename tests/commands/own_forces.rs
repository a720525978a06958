//! A user's own effect of forces: read, simulated, found with its value, and refused where it is wrong.

use crate::program::{creepage, stderr};
use std::path::Path;

const ROBOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/dynamics/robot");
const OWN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/effects/force_effects.toml");

fn ran(folder: &Path, arguments: &[&str]) {
    let output = creepage(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", stderr(&output));
}

/// A robot whose tyres scrub, by the torques of the example, seen by a sensor of a millimetre.
fn log(folder: &Path) {
    let model = std::fs::read_to_string(format!("{ROBOT}.toml")).unwrap();
    std::fs::write(folder.join("truth.toml"), format!("{model}[[effects]]\nid = \"scrubbing\"\nq = 0.8\n")).unwrap();
    let torques = format!("{ROBOT}.csv");
    ran(folder, &["simulate", "truth.toml", "--inputs", &torques, "--out", "path.csv", "--effects", OWN]);
    let read = |path: &Path| std::fs::read_to_string(path).unwrap();
    let (path, torques) = (read(&folder.join("path.csv")), read(Path::new(&torques)));
    let mut run = String::from("time,wheel_torque_left,wheel_torque_right,x,y,heading\n");
    for (i, (path, torques)) in path.lines().zip(torques.lines()).enumerate().skip(1) {
        let pose = path.split(',').skip(1).take(3).map(|v| v.parse::<f64>().unwrap());
        let noisy = pose.enumerate().map(|(k, v)| v + 1e-3 * (12.9898 * i as f64 + 78.233 * k as f64).sin());
        let inputs: Vec<&str> = torques.split(',').take(3).collect();
        run += &inputs.join(",");
        noisy.for_each(|v| run += &format!(",{v:.6}"));
        run.push('\n');
    }
    std::fs::write(folder.join("run.csv"), run).unwrap();
}

#[test]
fn an_effect_of_forces_of_ones_own_is_found() {
    let folder = tempfile::tempdir().unwrap();
    log(folder.path());
    let model = format!("{ROBOT}.toml");
    ran(folder.path(), &["discover", "run.csv", "--model", &model, "--effects", OWN, "--out", "report", "-q"]);
    // Without it what remains is a torque, and told as one.
    let checked = creepage(folder.path(), &["check", "run.csv", "--model", &model, "-q", "--format", "json"]);
    let said = String::from_utf8(checked.stdout).unwrap();
    assert!(said.contains("most of it by a torque on the vehicle"), "{said}");
    let report = std::fs::read_to_string(folder.path().join("report/report.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    let effects = report["effects"].as_array().unwrap();
    assert!(effects.len() == 1 && effects[0]["id"] == "scrubbing", "{}", report["summary"]);
    let q = &effects[0]["parameters"]["q"];
    let (value, std) = (q["value"].as_f64().unwrap(), q["std"].as_f64().unwrap());
    assert!((value - 0.8).abs() < 4.0 * std && std < 0.01, "{value} {std}");
}

/// The place in the file and what is wrong, on a vehicle that forces move.
#[test]
fn a_wrong_effect_of_forces_is_refused_where_it_is_wrong() {
    let own = std::fs::read_to_string(OWN).unwrap();
    let cases = [
        (
            "*body.inertia",
            "",
            "has no unit on unicycle with [dynamics]: it is in m^2*kg/s^2, q*phi'*abs(phi') is in 1/s^2",
        ),
        ("phi'*abs", "phii'*abs", "no vehicle knows the name \"phii'\"; did you mean \"phi'\"?"),
        ("\"body.torque\" =", "\"body.torqe\" =", "no vehicle defines \"body.torqe\""),
        ("= \"it - q", "= \"it + 1 - q", "has no unit"),
        ("asked_force_n", "asked_torque_n", "no vehicle knows the name \"asked_torque_n\""),
        (
            "lagging_n)/tau",
            "lagging_n)*tau",
            "the formula for lagging_n' is in m*kg/s, but lagging_n' is in m*kg/s^3 on unicycle with [dynamics]",
        ),
        ("\"built_force*\"", "built_force_3", "end every name with *, such as \"built_force*\", or remove per_contact"),
    ];
    for (old, new, says) in cases {
        let folder = tempfile::tempdir().unwrap();
        assert!(own.contains(old), "{old}");
        std::fs::write(folder.path().join("own.toml"), own.replace(old, new)).unwrap();
        let output = creepage(folder.path(), &["effects", "--effects", "own.toml"]);
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(says) && said.contains("own.toml:"), "{old}: {said}");
    }
}

/// One state at the only contact that holds sideways, and its law in the equations.
#[test]
fn an_effect_with_a_state_at_every_contact_is_described() {
    let folder = tempfile::tempdir().unwrap();
    let model = std::fs::read_to_string(format!("{ROBOT}.toml")).unwrap();
    std::fs::write(folder.path().join("slow.toml"), format!("{model}[[effects]]\nid = \"slow-tyres\"\ntau = 0.3\n"))
        .unwrap();
    let output = creepage(folder.path(), &["describe", "slow.toml", "--effects", OWN]);
    let said = String::from_utf8(output.stdout.clone()).unwrap();
    assert!(output.status.success(), "{}", stderr(&output));
    let one_line = said.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in [
        "slow_tyres.lagging_3' = (asked_force_3 - slow_tyres.lagging_3)/slow_tyres.tau",
        "built_force_3 = slow_tyres.lagging_3",
    ] {
        assert!(one_line.contains(part), "{part}: {said}");
    }
    assert!(!said.contains("lagging_1") && !said.contains("lagging_n"), "{said}");
}
