//! `creepage fit`: the effects that are named, and no others.

use crate::program::{creepage, stderr};
use serde_json::Value;
use std::path::Path;
use tempfile::TempDir;

fn example(path: &str) -> String {
    format!("{}/examples/runs/{path}", env!("CARGO_MANIFEST_DIR"))
}

fn fitted(folder: &Path, arguments: &[&str]) -> Value {
    let output = creepage(folder, &[&["fit"], arguments, &["--format", "json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Value and deviation of an effect's parameter.
fn value(found: &Value, effect: usize, parameter: &str) -> (f64, f64) {
    let p = &found["effects"][effect]["parameters"][parameter];
    (p["value"].as_f64().unwrap(), p["std"].as_f64().unwrap())
}

/// The model of the vacuum cleaner with an entry that the fit begins at.
fn track(entry: &str) -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(example("track/model.toml")).unwrap();
    std::fs::write(dir.path().join("model.toml"), format!("{text}\n{entry}")).unwrap();
    dir
}

#[test]
fn what_is_named_is_fitted_and_nothing_else() {
    let dir = track("");
    let runs = [example("track/meander.csv"), example("track/rosette.csv")];
    let names = "wheel-radius-mismatch,track-width,heading-misalignment";
    let all = [&runs[0], &runs[1], "--model", "model.toml", "--effects", names];
    let found = fitted(dir.path(), &all);
    let ids: Vec<&str> = found["effects"].as_array().unwrap().iter().map(|e| e["id"].as_str().unwrap()).collect();
    assert_eq!(ids.join(","), names);
    // The hidden track width, and two effects that are not there: values within their deviations all the same.
    for (k, parameter, truth) in [(0, "scale", 0.0), (1, "scale", 0.035), (2, "offset", 0.0)] {
        let (v, std) = value(&found, k, parameter);
        assert!((v - truth).abs() < 4.0 * std && std > 0.0, "{parameter} {v} ± {std}");
        let ends: Vec<f64> = found["effects"][k]["parameters"][parameter]["interval"]
            .as_array()
            .unwrap()
            .iter()
            .map(|v| v.as_f64().unwrap())
            .collect();
        assert!(ends[0] < v && v < ends[1] && (ends[1] - ends[0]) > 3.0 * std, "{ends:?}");
    }
    assert!(found["effects"][1]["delta_bic"].as_f64().unwrap() > 100.0);
    assert!(found["effects"][0]["delta_bic"].as_f64().unwrap() < 0.0);
    let matrix = &found["covariance"]["matrix"];
    for i in 0..3 {
        for j in 0..3 {
            let [a, b] = [&matrix[i][j], &matrix[j][i]].map(|v| v.as_f64().unwrap());
            assert!((a - b).abs() <= 1e-9 * a.abs(), "{matrix}");
        }
    }
    assert_eq!(found["covariance"]["names"][1], "track-width scale");
    assert_eq!(found["data"]["runs"], 2);
    // The same bytes on any number of threads.
    let once = |threads: &str| {
        creepage(dir.path(), &[&["fit"], &all[..], &["--format", "json", "--threads", threads]].concat()).stdout
    };
    assert_eq!(once("1"), once("2"));
}

/// A prior as sharp as the data: the value goes half the way, and its deviation falls by √2.
#[test]
fn a_prior_counts_as_much_as_its_deviation_says() {
    let run = example("track/meander.csv");
    let arguments = [&run, "--model", "model.toml", "--effects", "track-width"];
    let dir = track("");
    let (alone, std) = value(&fitted(dir.path(), &arguments), 0, "scale");
    let mean = alone + 3.0 * std;
    let dir =
        track(&format!("[[effects]]\nid = \"track-width\"\nscale = 0.0\nprior = {{ mean = {mean}, std = {std} }}\n"));
    let found = fitted(dir.path(), &arguments);
    let (both, less) = value(&found, 0, "scale");
    assert!((both - (alone + 1.5 * std)).abs() < 0.15 * std, "{alone} ± {std}, {both}");
    assert!((less / std - 0.5f64.sqrt()).abs() < 0.05, "{less} {std}");
    assert_eq!(found["effects"][0]["parameters"]["scale"]["prior"][1], std);
}

#[test]
fn bounds_hold_and_are_told() {
    let run = example("track/meander.csv");
    let dir = track("[[effects]]\nid = \"track-width\"\nscale = 0.0\nbounds = [-0.02, 0.02]\n");
    let arguments = [&run, "--model", "model.toml", "--effects", "track-width"];
    let found = fitted(dir.path(), &arguments);
    assert_eq!(found["effects"][0]["parameters"]["scale"]["value"], 0.02);
    assert_eq!(found["effects"][0]["parameters"]["scale"]["at_bound"], true);
    let text = creepage(dir.path(), &[&["fit"], &arguments[..]].concat());
    assert!(String::from_utf8(text.stdout).unwrap().contains("stands at an end of its range"));
}

/// A time constant of zero and less has no meaning: its interval is by the likelihood, and ends where the data leave it open.
#[test]
fn an_interval_that_is_not_symmetric_is_by_the_likelihood() {
    let dir = tempfile::tempdir().unwrap();
    let (model, run) = (example("cornering/model.toml"), example("cornering/eights.csv"));
    let found =
        fitted(dir.path(), &[&run, "--model", &model, "--effects", "cornering-creep,traction-creep,input-delay"]);
    let of = |k: usize, name: &str| found["effects"][k]["parameters"][name].clone();
    let slide = of(0, "mass_over_bT");
    assert_eq!((slide["by"].as_str(), of(2, "delay")["by"].as_str()), (Some("profile"), Some("profile")));
    // Far from zero it is as good as symmetric: the two ways agree.
    let (v, std) = value(&found, 0, "mass_over_bT");
    for (end, side) in [(0, -1.0), (1, 1.0)] {
        let off = (slide["interval"][end].as_f64().unwrap() - v) / std;
        assert!((off - side * 1.96).abs() < 0.25, "{off}");
    }
    // Nothing lags: it vanishes, and the data say below what it must be.
    let lag = of(1, "mass_over_bR");
    assert!(lag["interval"][0].is_null() && lag["at_bound"] == true && lag["std"].is_null(), "{lag}");
    assert!(lag["interval"][1].as_f64().is_some_and(|v| v > 0.0 && v < 0.02), "{lag}");
}

#[test]
fn the_fitted_model_runs_again() {
    let dir = track("");
    let run = example("track/meander.csv");
    let fit = ["fit", &run, "--model", "model.toml", "--effects", "track-width", "--out", "fitted.toml", "--quiet"];
    assert_eq!(creepage(dir.path(), &fit).status.code(), Some(0));
    let text = std::fs::read_to_string(dir.path().join("fitted.toml")).unwrap();
    assert!(text.contains("id = \"track-width\"") && text.starts_with("# A vacuum cleaner"), "{text}");
    let simulate = ["simulate", "fitted.toml", "--inputs", &run, "--out", "path.csv", "--quiet"];
    assert_eq!(creepage(dir.path(), &simulate).status.code(), Some(0));
    let onto = ["fit", &run, "--model", "model.toml", "--effects", "track-width", "--out", "model.toml"];
    assert_eq!(creepage(dir.path(), &onto).status.code(), Some(2));
}

#[test]
fn what_cannot_be_fitted_is_one_message() {
    let run = example("track/meander.csv");
    let entry = |keys: &str| format!("[[effects]]\nid = \"lever-arm\"\na = 0.0\nb = 0.0\n{keys}\n");
    for (effects, keys, says) in [
        ("track-with", String::new(), "unknown effect \"track-with\""),
        ("track-width,track-width", String::new(), "is named twice"),
        ("steering-offset", String::new(), "does not apply to this vehicle"),
        ("track-width@2", String::new(), "does not apply"),
        ("@left", String::new(), "names no effect"),
        ("", String::new(), "names no effect"),
        ("lever-arm", entry("prior = { mean = 0.0, std = 0.1 }"), "does not say which it is of"),
        ("lever-arm", entry("prior = { a = { mean = 0.0 } }"), "std"),
        ("lever-arm", entry("prior = { a = { mean = 0.0, std = 0.0 } }"), "std = 0.0 is out of range"),
        ("lever-arm", entry("prior = { c = { mean = 0.0, std = 0.1 } }"), "c"),
        ("lever-arm", entry("bounds = [0.0, 1.0]"), "does not say which it is of"),
        ("lever-arm", entry("bounds = { a = [1.0, 0.0] }"), "end before they begin"),
        ("lever-arm", entry("bounds = { a = [1.0] }"), "a list of two numbers"),
    ] {
        let dir = track(&keys);
        let output =
            creepage(dir.path(), &["fit", &run, "--model", "model.toml", "--effects", effects, "--out", "o.toml"]);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{effects} {keys}: {message}");
        assert!(message.contains(says) && !message.contains("panicked"), "{effects} {keys}: {message}");
        assert!(keys.is_empty() || message.contains("model.toml:"), "{message}");
        assert!(!dir.path().join("o.toml").exists());
    }
}
