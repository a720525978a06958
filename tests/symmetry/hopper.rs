//! The hopper through the commands, against an integration that knows nothing of the program.

use crate::support::check;
use creepage::effects;
use creepage::model::Model;
use creepage::motion::driven;
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::path::Path;
use std::process::{Command, Output};

fn creepage(dir: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_creepage")).current_dir(dir).args(arguments).output().unwrap()
}

const MODEL: &str = "vehicle = \"hopper\"\n[parameters]\nbody_inertia = 1.0\nleg_mass = 0.4\nleg_offset = 0.6\n";

fn leg(rows: usize) -> String {
    let row = |i: usize| {
        let t = TAU * i as f64 / rows as f64;
        format!("{t},{},{}\n", 0.8 * t.cos(), 0.5 + 0.3 * t.cos())
    };
    String::from("time,leg_angle_rate,leg_length\n") + &(0..=rows).map(row).collect::<String>()
}

fn simulated(initial: &str) -> Vec<Vec<f64>> {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("model.toml"), format!("{MODEL}{initial}")).unwrap();
    std::fs::write(dir.path().join("in.csv"), leg(500)).unwrap();
    let output = creepage(dir.path(), &["simulate", "model.toml", "--inputs", "in.csv", "--out", "out.csv"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = std::fs::read_to_string(dir.path().join("out.csv")).unwrap();
    assert!(text.starts_with("time,x,y,heading,"), "{text}");
    text.lines().skip(1).map(|l| l.split(',').map(|v| v.parse().unwrap()).collect()).collect()
}

#[test]
fn a_loop_of_the_leg_turns_the_body_by_its_phase() {
    for (initial, start) in [
        ("", 0.0),
        ("[initial]\npsi = 0.7\n", 0.7),
        ("[initial]\nheading = -2.0\n", -2.0),
        ("[initial]\nx = 1.0\ny = 2.0\nheading = 0.5\n", 0.5),
    ] {
        let rows = simulated(initial);
        let last = rows.last().unwrap();
        // Inputs are interpolated between rows.
        assert!((last[3] - start + 0.29741719748508).abs() < 1e-9, "{initial}: {}", last[3]);
        assert_eq!(rows[0][3], start);
        assert!(rows.iter().all(|r| r[1] == rows[0][1] && r[2] == rows[0][2] && r[4] == 0.0 && r[5] == 0.0));
    }
}

#[test]
fn a_wrong_beginning_is_one_message() {
    for (initial, said) in [
        ("[initial]\npsi = 0.1\nheading = 0.2\n", "the heading is given twice"),
        ("[initial]\nx = 0.1\n", "heading"),
        ("[initial]\npsi = \"east\"\n", "psi"),
        ("[initial]\ntheta = 0.1\n", "theta"),
    ] {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join("model.toml"), format!("{MODEL}{initial}")).unwrap();
        std::fs::write(dir.path().join("in.csv"), leg(20)).unwrap();
        let output = creepage(dir.path(), &["simulate", "model.toml", "--inputs", "in.csv", "--out", "out.csv"]);
        let message = String::from_utf8_lossy(&output.stderr).to_string();
        assert_eq!(output.status.code(), Some(2), "{initial}: {message}");
        assert!(message.contains(said) && message.contains("model.toml:"), "{initial}: {message}");
        assert!(!dir.path().join("out.csv").exists());
    }
    // Other vehicles have no psi.
    let dir = tempfile::tempdir().unwrap();
    let wheel = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1.0\n[initial]\nx = 0.0\ny = 0.0\npsi = 0.1\n";
    std::fs::write(dir.path().join("model.toml"), wheel).unwrap();
    std::fs::write(dir.path().join("in.csv"), "time,wheel_rate,yaw_rate\n0,1,0\n1,1,0\n").unwrap();
    let output = creepage(dir.path(), &["simulate", "model.toml", "--inputs", "in.csv", "--out", "out.csv"]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn it_is_described_in_every_format() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("model.toml"), MODEL).unwrap();
    let run = |arguments: &[&str]| {
        let output = creepage(dir.path(), &[&["describe", "model.toml"], arguments].concat());
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let text = run(&[]);
    for said in [
        "coordinates: psi, l, theta",
        "Type S, s*q1' + (1 - e)*h = 0; coefficient e_sc; equations (20). Put in:",
        "sigma = -(1 - e_sc)*(m*(l + d)^2)/(I + m*(l + d)^2)",
        "psi' = -(1 - e_sc)*(m*(l + d)^2*theta')/(I + m*(l + d)^2)",
        "growth vector: (2, 3); degree of nonholonomy: 2",
        "RT signature by ranks: S",
    ] {
        assert!(text.contains(said), "{said}\n{text}");
    }
    assert!(run(&["--format", "latex"]).contains(r"\dot{\psi} &= -\frac{"));
    let json: serde_json::Value = serde_json::from_str(&run(&["--format", "json"])).unwrap();
    assert_eq!(json["constraints_by_form"]["s"], 1);
    assert_eq!(json["structure"]["holonomy"]["growth_vector"], serde_json::json!([2, 3]));
    assert_eq!(json["undetermined"], serde_json::Value::Null);
}

/// ψ̇ = −M·θ̇/(I + M) with classical Runge–Kutta steps.
fn turned([i, m, d]: [f64; 3], l: impl Fn(f64) -> f64, rate: impl Fn(f64) -> f64, keeps: f64) -> f64 {
    let psi = |t: f64| {
        let moment = m * (l(t) + d) * (l(t) + d);
        -keeps * moment * rate(t) / (i + moment)
    };
    let (n, end) = (2000, 3.0);
    let h = end / f64::from(n);
    (0..n).map(|k| h * f64::from(k)).map(|t| h / 6.0 * (psi(t) + 4.0 * psi(t + h / 2.0) + psi(t + h))).sum()
}

#[test]
fn generated_legs_turn_generated_bodies() {
    let bodies = ([0.2..3.0f64, 0.1..2.0f64, 0.1..1.0f64], prop::array::uniform3(-1.0..1.0f64));
    check(25, bodies, |(body, [a, b, c])| {
        let parameters = ["body_inertia", "leg_mass", "leg_offset"].into_iter().zip(body).collect::<Vec<_>>();
        let hopper = Model::new("hopper", &parameters).unwrap();
        let inputs = [("leg_length", "1 + c_0*sin(t)"), ("leg_angle_rate", "c_1 + c_2*cos(2*t)")];
        let path = driven(&hopper, &inputs, &[a, b, c], &[0.0, 0.0, 0.4], &[0.0, 3.0]).unwrap();
        let wanted = turned(body, |t| 1.0 + a * t.sin(), |t| b + c * (2.0 * t).cos(), 1.0);
        prop_assert!((path[1][2] - 0.4 - wanted).abs() < 1e-10, "{} {}", path[1][2], wanted);
        Ok(())
    });
}

/// An effect of one's own sets the coefficient; none of the library does, since none is a law of air.
#[test]
fn a_coefficient_of_ones_own_makes_it_creep() {
    const OWN: &str = r#"
[[effect]]
id = "kept-spin"
where = "momentum"
says = "the body keeps a share of what the leg carries"
source = "test"
changes = { e_sc = "it + share" }
[effect.parameters.share]
unit = "1"
range = [-1.0, 1.0]
size = 0.1
"#;
    assert!(effects::all().iter().all(|e| !e.changes.contains_key("e_sc")));
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("own.toml"), OWN).unwrap();
    let library = creepage::extensions::with_own(dir.path().join("own.toml")).unwrap();
    let body = [1.0, 0.4, 0.6];
    let parameters: Vec<_> = ["body_inertia", "leg_mass", "leg_offset"].into_iter().zip(body).collect();
    let own = library.iter().find(|e| e.id == "kept-spin").unwrap();
    let applied = creepage::effects::Applied::new(own, None, vec![0.25]);
    let hopper = Model::new("hopper", &parameters).unwrap().with_effect(applied);
    let inputs = [("leg_length", "1 + sin(t)/4"), ("leg_angle_rate", "cos(t)")];
    let path = driven(&hopper, &inputs, &[], &[0.0; 3], &[0.0, 3.0]).unwrap();
    let wanted = turned(body, |t| 1.0 + t.sin() / 4.0, f64::cos, 0.75);
    assert!((path[1][2] - wanted).abs() < 1e-11, "{} {wanted}", path[1][2]);
}
