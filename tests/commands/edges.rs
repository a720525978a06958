//! Numbers at the edge of what can be written: they work, or end in one message, and they end.

use crate::program;
use std::fs;
use std::path::Path;
use std::process::Output;
use std::time::{Duration, Instant};

/// The most time a command may take by the clock: the machine may be busy with other things.
const MAX_TIME: Duration = Duration::from_secs(240);

fn creepage(dir: &Path, arguments: &[&str]) -> Output {
    let begin = Instant::now();
    let output = program::creepage(dir, arguments);
    assert!(begin.elapsed() < MAX_TIME, "{arguments:?} took {:?}", begin.elapsed());
    let message = String::from_utf8_lossy(&output.stderr);
    let lines = message.trim_end().lines().count();
    match output.status.code() {
        Some(0) => assert_eq!(lines, 0, "{arguments:?}: {message}"),
        Some(1 | 2) => assert_eq!(lines, 1, "{arguments:?}: {message}"),
        other => panic!("{arguments:?}: {other:?}: {message}"),
    }
    output
}

fn model(radius: &str) -> String {
    format!("vehicle = \"unicycle\"\n[parameters]\nwheel_radius = {radius}\n")
}

/// Rows at a step, with a wheel rate, a yaw rate and a position of one size.
fn log(step: f64, rate: f64, yaw: f64, size: f64) -> String {
    let row = |i: usize| format!("{:e},{:e},{:e},0,{rate:e},{yaw:e}\n", i as f64 * step, i as f64 * size, size);
    format!("time,x,y,heading,wheel_rate,yaw_rate\n{}", (0..40).map(row).collect::<String>())
}

/// Simulates and searches the log of a folder with a model of a radius.
fn use_or_refuse(dir: &Path, radius: &str) {
    fs::write(dir.join("model.toml"), model(radius)).unwrap();
    let simulated = creepage(dir, &["simulate", "model.toml", "--inputs", "run.csv", "--out", "path.csv"]);
    assert_ne!(simulated.status.code(), Some(2), "{simulated:?}");
    let found = creepage(dir, &["discover", "run.csv", "--model", "model.toml", "--out", "report"]);
    assert_eq!(found.status.code(), Some(0), "{found:?}");
}

#[test]
fn parameters_at_the_edge_are_used_or_refused() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("run.csv"), log(0.1, 1.0, 0.1, 0.1)).unwrap();
    ["1e300", "1e-300", "5e-324"].iter().for_each(|radius| use_or_refuse(dir.path(), radius));
}

#[test]
fn numbers_at_the_edge_are_used_or_refused() {
    let logs = [
        ("a step of 1 ns", log(1e-9, 1.0, 0.1, 0.1)),
        ("a step of 1 h", log(3600.0, 1.0, 0.0005, 0.1)),
        ("a step of 1 h, turns in it", log(3600.0, 1.0, 0.01, 0.1)),
        ("a step of 1e300 s", log(1e300, 1.0, 0.1, 0.1)),
        ("a step of 1e-300 s", log(1e-300, 1.0, 0.1, 0.1)),
        ("a subnormal step", log(5e-324, 1.0, 0.1, 0.1)),
        ("a wheel rate of 1e300", log(0.1, 1e300, 0.1, 0.1)),
        ("a wheel rate of 1e-300", log(0.1, 1e-300, 0.1, 0.1)),
        ("subnormal inputs", log(0.1, 5e-324, 5e-324, 5e-324)),
        ("a yaw rate of 1e300", log(0.1, 1.0, 1e300, 0.1)),
        ("positions of 1e300", log(0.1, 1.0, 0.1, 1e300)),
        ("positions of 1e-300", log(0.1, 1.0, 0.1, 1e-300)),
    ];
    for (name, text) in logs {
        let dir = tempfile::tempdir().unwrap();
        fs::write(dir.path().join("run.csv"), text).unwrap();
        println!("{name}");
        use_or_refuse(dir.path(), "0.1");
    }
}

/// The work is bounded by the rows: 40 of them may take 1 004 000 steps.
#[test]
fn a_motion_that_cannot_be_followed_ends() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("run.csv"), log(0.1, 1.0, 1e9, 0.1)).unwrap();
    fs::write(dir.path().join("model.toml"), model("0.1")).unwrap();
    let output = creepage(dir.path(), &["simulate", "model.toml", "--inputs", "run.csv", "--out", "path.csv"]);
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(1) && message.contains("1004000 steps were not enough"), "{message}");
    assert!(!dir.path().join("path.csv").exists());
    let found = creepage(dir.path(), &["discover", "run.csv", "--model", "model.toml", "--out", "report"]);
    assert_eq!(found.status.code(), Some(0), "{found:?}");
}

/// A train of a thousand trailers is driven; writing out its matrix would take hours, and is refused.
#[test]
fn a_thousand_trailers_are_simulated_and_not_described() {
    let dir = tempfile::tempdir().unwrap();
    let train = |n: usize| {
        format!(
            "vehicle = \"n-trailer\"\ntractor = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.5\n\
             trailer_lengths = [{}]\n",
            vec!["1.0"; n].join(", ")
        )
    };
    fs::write(dir.path().join("model.toml"), train(1000)).unwrap();
    let rows: String = (0..5).map(|i| format!("{},1,0.1\n", f64::from(i) * 0.1)).collect();
    fs::write(dir.path().join("in.csv"), format!("time,wheel_rate,steering_angle\n{rows}")).unwrap();
    let driven = creepage(dir.path(), &["simulate", "model.toml", "--inputs", "in.csv", "--out", "path.csv"]);
    assert_eq!(driven.status.code(), Some(0), "{driven:?}");
    let path = fs::read_to_string(dir.path().join("path.csv")).unwrap();
    assert_eq!((path.lines().count(), path.lines().last().unwrap().split(',').count()), (6, 4 + 1000 + 3));
    let refused = creepage(dir.path(), &["describe", "model.toml"]);
    let message = String::from_utf8_lossy(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{message}");
    assert!(message.contains("model.toml: 1000 trailers are too many"), "{message}");
    // A train that may be described is.
    fs::write(dir.path().join("model.toml"), train(20)).unwrap();
    assert_eq!(creepage(dir.path(), &["describe", "model.toml"]).status.code(), Some(0));
}
