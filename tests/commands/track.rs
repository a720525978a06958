//! `creepage track`: what feedback on several models makes of a plan, what an observer finds, and what is told of bad input.

use crate::program::{creepage, stderr};
use serde_json::Value;
use std::fs;
use std::path::Path;

const WHEEL: &str = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n";
const CAR: &str = "vehicle = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 1.0\n";
const CREEPS: &str =
    "[[effects]]\nid = \"traverse-creep\"\ne_tc = 0.08\n[[effects]]\nid = \"rotation-creep\"\ne_rc = 0.05\n";

fn tracked(folder: &Path, model: &str, arguments: &[&str]) -> Value {
    fs::write(folder.join("model.toml"), model).unwrap();
    let output = creepage(folder, &[&["track", "model.toml", "--format", "json"], arguments].concat());
    assert_eq!(output.status.code(), Some(0), "{model}{arguments:?}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| panic!("{v} is no number"))
}

fn way<'a>(report: &'a Value, id: &str) -> &'a Value {
    report["ways"].as_array().unwrap().iter().find(|w| w["id"] == id).unwrap_or_else(|| panic!("no {id}: {report:#}"))
}

#[test]
fn feedback_pays_and_that_on_a_model_with_creep_pays_more() {
    let dir = tempfile::tempdir().unwrap();
    for model in [WHEEL, CAR] {
        let found = tracked(dir.path(), &format!("{model}{CREEPS}"), &["--goal", "4,1,0.4", "--drives", "3"]);
        let off = |id: &str| number(&way(&found, id)["off_plan_m"]);
        // By halves and more.
        assert!(off("ideal") < 0.5 * off("ideal-plan"), "{found:#}");
        assert!(off("observer") < 0.5 * off("ideal"), "{found:#}");
        // The model is the vehicle: alone it follows its plan, and with feedback it is disturbed by the sensor alone.
        assert!(off("model-plan") < 1e-6 && off("model") < 0.005, "{found:#}");
        for observed in found["observed"].as_array().unwrap() {
            let [is, found, deviation] = ["true_value", "found", "deviation"].map(|k| number(&observed[k]));
            assert!((found - is).abs() < 4.0 * deviation && deviation < 0.03, "{observed:#}");
        }
        assert_eq!(found["observed"].as_array().unwrap().len(), 2);
    }
}

/// Commands that act later are reckoned with: without Smith's predictor such a loop swings.
#[test]
fn a_delay_is_reckoned_with() {
    let dir = tempfile::tempdir().unwrap();
    let of_one = "input = \"yaw_rate\"\n";
    for (input, share) in [("", 0.25), (of_one, 0.5)] {
        let model = format!("{WHEEL}[[effects]]\nid = \"input-delay\"\n{input}delay = 0.4\n");
        let found = tracked(dir.path(), &model, &["--goal", "4,1,0.4", "--drives", "2"]);
        let off = |id: &str| number(&way(&found, id)["off_plan_m"]);
        assert!(off("model") < share * off("ideal") && off("model") < 0.01, "{found:#}");
    }
}

#[test]
fn the_same_seed_gives_the_same_files_on_any_number_of_threads() {
    let dir = tempfile::tempdir().unwrap();
    let files = |threads: &str, seed: &str| {
        let arguments = ["--goal", "2,0.5,0.3", "--drives", "3", "--threads", threads, "--seed", seed, "--out", "out"];
        tracked(dir.path(), &format!("{WHEEL}{CREEPS}"), &arguments);
        ["track.json", "track.svg", "drives.csv"].map(|f| fs::read(dir.path().join("out").join(f)).unwrap())
    };
    let one = files("1", "0");
    assert!(one == files("2", "0") && one[0] != files("1", "1")[0]);
    let table = String::from_utf8(one[2].clone()).unwrap();
    assert!(
        table.starts_with(
            "way,t,plan_x,plan_y,plan_heading,x,y,heading,command_1,command_2\nideal-plan,0.0000,0.000000,"
        )
    );
    assert!(table.lines().skip(1).all(|row| row.split(',').skip(1).all(|v| v.parse::<f64>().is_ok())));
}

#[test]
fn a_model_without_effects_has_two_ways_and_nothing_to_observe() {
    let dir = tempfile::tempdir().unwrap();
    let found = tracked(dir.path(), WHEEL, &["--goal", "2,0.5,0.3", "--drives", "1"]);
    let ids: Vec<&str> = found["ways"].as_array().unwrap().iter().map(|w| w["id"].as_str().unwrap()).collect();
    assert_eq!((ids, found["observed"].as_array().unwrap().len()), (vec!["model-plan", "model"], 0));
}

#[test]
fn goals_out_of_reach_and_bad_options_are_told() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("model.toml"), WHEEL).unwrap();
    let told = |arguments: &[&str]| {
        let output = creepage(dir.path(), &[&["track", "model.toml"], arguments].concat());
        (output.status.code(), stderr(&output))
    };
    let (code, said) = told(&["--goal", "20,0,0", "--duration", "1"]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("leave --duration out"), "{said}");
    for bad in [["--noise", "1"], ["--noise", "0,1"], ["--every", "0"], ["--drives", "0"], ["--settling", "-1"]] {
        let (code, said) = told(&[&["--goal", "1,0,0"], &bad[..]].concat());
        assert_eq!(code, Some(2), "{bad:?}: {said}");
    }
    let (code, said) = told(&["--goal", "3,0,0", "--every", "0.001", "--duration", "200"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("sample less often"), "{said}");
    assert!(!dir.path().join("track").exists());
}
