//! The command line as a script sees it: exit codes, messages, files.

#[path = "support/bad_inputs.rs"]
#[allow(dead_code)]
mod bad_inputs;

use bad_inputs::{BAD_LOGS, BAD_MODELS, CSV, MODEL};
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

fn creepage(dir: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_creepage")).current_dir(dir).args(arguments).output().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    files.iter().for_each(|(name, bytes)| std::fs::write(dir.path().join(name), bytes).unwrap());
    dir
}

fn example(path: &str) -> String {
    format!("{}/examples/runs/{path}", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn every_bad_input_is_one_message_exit_code_2_and_no_file() {
    assert!(BAD_LOGS.len() + BAD_MODELS.len() >= 40);
    for case in BAD_LOGS.iter().chain(BAD_MODELS) {
        let dir = folder(&[("model.toml", case.model.as_bytes()), ("run.csv", case.csv)]);
        let output = creepage(dir.path(), &["discover", "run.csv", "--model", "model.toml", "--out", "report"]);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{}: {message}", case.name);
        assert!(!message.contains("panicked"), "{}: {message}", case.name);
        // Parts about keys that only the stand-in catalogue of the library's tests knows differ in their advice.
        let place = case.expect[0];
        assert!(message.contains(place), "{}: {place:?} is not in {message:?}", case.name);
        assert!(!dir.path().join("report").exists(), "{} left something behind", case.name);
    }
}

#[test]
fn folders_and_missing_files_are_refused() {
    let dir = folder(&[("model.toml", MODEL.as_bytes()), ("run.csv", CSV)]);
    for (run, model) in
        [("nowhere.csv", "model.toml"), (".", "model.toml"), ("run.csv", "nowhere.toml"), ("run.csv", ".")]
    {
        let output = creepage(dir.path(), &["discover", run, "--model", model, "--out", "report"]);
        assert_eq!(output.status.code(), Some(2), "{run} {model}: {}", stderr(&output));
        assert!(!dir.path().join("report").exists());
    }
}

#[test]
fn wrong_usage_is_exit_code_2() {
    let dir = folder(&[("model.toml", MODEL.as_bytes()), ("run.csv", CSV)]);
    for arguments in [
        &["discover"][..],
        &["discover", "run.csv"],
        &["discover", "run.csv", "--model", "model.toml", "--horizon", "-1"],
        &["discover", "run.csv", "--model", "model.toml", "--threads", "0"],
        &["discover", "run.csv", "run.csv", "--model", "model.toml"],
        &["discover", "run.csv", "--held-out", "run.csv", "--model", "model.toml"],
        &["describe", "model.toml", "--format", "html"],
        &["simulate", "model.toml", "--inputs", "run.csv", "--out", "out.csv", "--rtol", "0"],
        &["fly"],
    ] {
        let output = creepage(dir.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
    }
    assert!(!dir.path().join("report").exists() && !dir.path().join("out.csv").exists());
}

#[test]
fn a_log_too_short_or_too_still_is_an_answer_not_an_error() {
    let still: String = (0..500).map(|i| format!("{},1.0,2.0,0.5,0.0,0.0\n", f64::from(i) * 0.04)).collect();
    let still = format!("t,x,y,phi,wheel_rate,yaw_rate\n{still}");
    for (csv, verdict) in [(CSV, "not-identifiable"), (still.as_bytes(), "unusable-data")] {
        let dir = folder(&[("model.toml", MODEL.as_bytes()), ("run.csv", csv)]);
        let output = creepage(dir.path(), &["discover", "run.csv", "--model", "model.toml", "--out", "report"]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let report = std::fs::read_to_string(dir.path().join("report/report.json")).unwrap();
        assert!(report.contains(&format!("\"verdict\": \"{verdict}\"")), "{report}");
        assert!(dir.path().join("report/report.html").exists());
    }
}

#[test]
fn the_bundled_run_is_answered_the_same_by_any_number_of_threads() {
    let dir = tempfile::tempdir().unwrap();
    let (run, model) = (example("pair/eights.csv"), example("pair/model.toml"));
    let answers = ["1", "2"].map(|n| {
        let output = creepage(dir.path(), &["discover", &run, "--model", &model, "--out", n, "--threads", n]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        ["report.json", "report.html", "gap.svg", "model.patched.toml"]
            .map(|f| std::fs::read(dir.path().join(n).join(f)).unwrap())
    });
    assert_eq!(answers[0], answers[1]);
    let report: serde_json::Value = serde_json::from_slice(&answers[0][0]).unwrap();
    let ids: Vec<&str> = report["effects"].as_array().unwrap().iter().map(|e| e["id"].as_str().unwrap()).collect();
    assert_eq!(ids, ["rotation-creep", "yaw-rate-bias"]);
    // The patched model runs in every command, and nothing more is found.
    let patched = "1/model.patched.toml";
    let output = creepage(dir.path(), &["describe", patched]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let output = creepage(dir.path(), &["simulate", patched, "--inputs", &run, "--out", "path.csv", "--quiet"]);
    assert_eq!((output.status.code(), output.stdout.len()), (Some(0), 0), "{}", stderr(&output));
    let output = creepage(dir.path(), &["discover", &run, "--model", patched, "--out", "again"]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let again = std::fs::read_to_string(dir.path().join("again/report.json")).unwrap();
    assert!(again.contains("\"verdict\": \"no-missing-effect\""), "{again}");
}

#[test]
fn an_older_report_survives_a_failure_and_is_replaced_by_a_success() {
    let dir = folder(&[("model.toml", MODEL.as_bytes()), ("run.csv", CSV), ("report", b"a file, not a folder")]);
    let output = creepage(dir.path(), &["discover", "run.csv", "--model", "model.toml", "--out", "report"]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    assert_eq!(std::fs::read(dir.path().join("report")).unwrap(), b"a file, not a folder");
    for _ in 0..2 {
        let output = creepage(dir.path(), &["discover", "run.csv", "--model", "model.toml", "--out", "fresh"]);
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    }
}

#[test]
fn every_command_has_help_with_an_example() {
    let dir = tempfile::tempdir().unwrap();
    for command in ["discover", "simulate", "describe", "vehicles", "effects"] {
        let output = creepage(dir.path(), &[command, "--help"]);
        let help = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && help.contains("Example"), "{command}: {help}");
    }
}
