//! What commands print, print as JSON, and keep to themselves.

use serde_json::Value;
use std::path::Path;
use std::process::{Command, Output};

const RUNS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/runs");

fn creepage(folder: &Path, line: &str) -> Output {
    let arguments: Vec<String> = line.split_whitespace().map(|w| w.replace("RUNS", RUNS)).collect();
    Command::new(env!("CARGO_BIN_EXE_creepage")).current_dir(folder).args(&arguments).output().unwrap()
}

fn printed(folder: &Path, line: &str) -> String {
    let output = creepage(folder, line);
    assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn refused(folder: &Path, line: &str) -> String {
    let output = creepage(folder, line);
    assert_eq!(output.status.code(), Some(2), "{line}");
    assert!(output.stdout.is_empty(), "{line}");
    String::from_utf8(output.stderr).unwrap()
}

/// A script that asks for JSON gets it, quiet or not.
#[test]
fn quiet_holds_back_words_and_no_json() {
    let folder = tempfile::tempdir().unwrap();
    // Twenty seconds are enough to say something of.
    let log = std::fs::read_to_string(format!("{RUNS}/cornering/eights.csv")).unwrap();
    let first: Vec<&str> = log.lines().take(500).collect();
    std::fs::write(folder.path().join("eights.csv"), first.join("\n")).unwrap();
    for (line, word) in
        [("check eights.csv --model RUNS/cornering/model.toml", "eights"), ("verify eq-3 --cases 5 --seed 1", "eq-3")]
    {
        let said = printed(folder.path(), line);
        assert!(said.contains(word), "{said}");
        assert_eq!(printed(folder.path(), &format!("{line} --quiet")), "");
        let json = printed(folder.path(), &format!("{line} --quiet --format json"));
        serde_json::from_str::<Value>(&json).unwrap();
        assert_eq!(json, printed(folder.path(), &format!("{line} --format json")));
    }
    for line in ["man --out pages", "init car --out car.toml --force"] {
        assert!(printed(folder.path(), line).lines().count() > 0);
        assert_eq!(printed(folder.path(), &format!("{line} --quiet")), "");
    }
}

#[test]
fn claims_are_verified_one_by_one_or_all() {
    let folder = tempfile::tempdir().unwrap();
    let one = printed(folder.path(), "verify eq-3 --cases 5 --seed 1 --format json");
    let entries = |text: &str| serde_json::from_str::<Value>(text).unwrap()["claims"].as_array().unwrap().len();
    assert_eq!(entries(&one), 1);
    assert!(refused(folder.path(), "verify eq-300").contains("no claim is called \"eq-300\""));
    let bus = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/bus");
    let own = std::fs::read_to_string(format!("{bus}/claims.toml")).unwrap().replace("\"bus-front\"", "\"eq-3\"");
    std::fs::write(folder.path().join("mine.toml"), own).unwrap();
    let error = refused(folder.path(), &format!("verify --claims mine.toml --vehicles {bus}/bus.toml"));
    assert!(error.contains("the claim eq-3 of mine.toml is already known"), "{error}");
}

#[test]
fn what_a_command_line_cannot_mean_is_said_before_anything_is_read() {
    let folder = tempfile::tempdir().unwrap();
    for (line, says) in [
        ("discover a.csv --model m.toml --horizon 0", "a horizon is a positive number of seconds"),
        ("discover a.csv --model m.toml --horizon=-1", "a horizon is a positive number of seconds"),
        ("discover a.csv --model m.toml --horizon inf", "a horizon is a positive number of seconds"),
        ("discover a.csv --model m.toml --horizon nan", "a horizon is a positive number of seconds"),
        ("discover a.csv --model m.toml --truth b.csv --clock-offset nan", "an offset is a number of seconds"),
        ("discover a.csv --model m.toml --truth b.csv --clock-offset soon", "an offset is a number of seconds"),
        (
            "discover a.csv --model RUNS/cornering/model.toml --held-out-truth b.csv",
            "--held-out-truth is given without --truth",
        ),
        (
            "discover a.csv --truth b.csv --held-out c.csv --model RUNS/cornering/model.toml",
            "--held-out is given without --held-out-truth",
        ),
    ] {
        let error = refused(folder.path(), line);
        assert!(error.contains(says), "{line}: {error}");
    }
    assert!(std::fs::read_dir(folder.path()).unwrap().next().is_none());
}

#[test]
fn a_model_names_the_file_beside_it_by_its_name_alone() {
    let folder = tempfile::tempdir().unwrap();
    let bus = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/bus/bus.toml");
    std::fs::create_dir(folder.path().join("sub")).unwrap();
    for place in ["mine.toml", "sub/mine.toml"] {
        std::fs::copy(bus, folder.path().join(place)).unwrap();
    }
    for (out, file, named) in [
        ("sub/bus.toml", "sub/mine.toml", "vehicles = \"mine.toml\"".to_string()),
        ("bus.toml", "sub/mine.toml", "vehicles = \"sub/mine.toml\"".to_string()),
        (
            "sub/up.toml",
            "mine.toml",
            format!("vehicles = \"{}\"", folder.path().canonicalize().unwrap().join("mine.toml").display()),
        ),
    ] {
        printed(folder.path(), &format!("init articulated-bus --vehicles {file} --out {out}"));
        let text = std::fs::read_to_string(folder.path().join(out)).unwrap();
        assert!(text.contains(&named), "{named}: {text}");
        printed(folder.path(), &format!("describe {out}"));
    }
}

/// Without a pose anywhere a train begins at the origin, straight.
#[test]
fn a_train_begins_at_the_origin_unless_told_otherwise() {
    let folder = tempfile::tempdir().unwrap();
    printed(folder.path(), "init n-trailer --tractor car --trailers 2 --out train.toml");
    let rows: String = (0..5).map(|i| format!("{i},1.0,0.0\n")).collect();
    std::fs::write(folder.path().join("in.csv"), format!("time,wheel_rate,steering_angle\n{rows}")).unwrap();
    printed(folder.path(), "simulate train.toml --inputs in.csv --out out.csv");
    let text = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    let row = |i: usize| text.lines().nth(i).unwrap().to_string();
    let first: Vec<f64> = row(1).split(',').map(|v| v.parse().unwrap()).collect();
    let header = row(0);
    let names: Vec<&str> = header.split(',').collect();
    for name in ["x", "y", "heading", "trailer_heading_1", "trailer_heading_2"] {
        let column = names.iter().position(|n| *n == name).unwrap();
        assert_eq!(first[column], 0.0, "{name}");
    }
}
