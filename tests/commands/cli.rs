//! The command line as a script sees it: exit codes, messages, files.

use crate::bad_inputs::{BAD_LOGS, BAD_MODELS, CSV, MODEL};
use crate::program::{creepage, stderr};
use tempfile::TempDir;

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
    let dir = folder(&[("model.toml", MODEL.as_bytes()), ("run.csv", CSV), ("other.csv", CSV)]);
    for arguments in [
        &["discover"][..],
        &["discover", "run.csv"],
        &["discover", "run.csv", "--model", "model.toml", "--horizon", "-1"],
        &["discover", "run.csv", "--model", "model.toml", "--threads", "0"],
        &["discover", "run.csv", "run.csv", "--model", "model.toml"],
        &["discover", "run.csv", "--held-out", "run.csv", "--model", "model.toml"],
        &["discover", "run.csv", "--held-out", "other.csv", "./other.csv", "--model", "model.toml"],
        &["describe", "model.toml", "--format", "html"],
        &["effects", "--vehicle", "nonsense"],
        &["simulate", "model.toml", "--inputs", "run.csv", "--out", "out.csv", "--rtol", "0"],
        &["fly"],
    ] {
        let output = creepage(dir.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
    }
    assert!(!dir.path().join("report").exists() && !dir.path().join("out.csv").exists());
}

/// Rows that were sorted or left out are told on standard error, by `simulate` and of the log of a sweep.
#[test]
fn what_becomes_of_input_rows_is_told_unless_quiet() {
    let spec = b"model = \"model.toml\"\n[inputs]\nlog = \"in.csv\"\n";
    let model = b"vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n";
    let log = b"time,wheel_rate,yaw_rate\n1,2,0\n0,2,0\n1.5,,0\n";
    let dir = folder(&[("model.toml", model), ("in.csv", log), ("spec.toml", spec)]);
    for command in [&["simulate", "model.toml", "--inputs", "in.csv"][..], &["sweep", "spec.toml"]] {
        let output = creepage(dir.path(), &[command, &["--out", "out.csv"]].concat());
        assert!(output.status.success());
        let sorted = "creepage: warning: in.csv: rows were out of order (1 steps back in time) and have been sorted\n";
        let left =
            "creepage: warning: in.csv: 1 of 3 rows is left out (blank or NaN cell in column \"wheel_rate\": 1)\n";
        assert_eq!(stderr(&output), format!("{sorted}{left}"));
        let quiet = creepage(dir.path(), &[command, &["--out", "out.csv", "--quiet"]].concat());
        assert!(quiet.status.success() && quiet.stderr.is_empty(), "{}", stderr(&quiet));
    }
}

/// A model file of the vehicle with every parameter one, and effects.
fn model_of(vehicle: &str, effects: &str) -> String {
    let parameters = creepage::vehicles::named(vehicle).unwrap().parameters.keys();
    let lines: String = parameters.map(|p| format!("{p} = 1.0\n")).collect();
    format!("vehicle = \"{vehicle}\"\n[parameters]\n{lines}{effects}")
}

/// A log of every input of the vehicle, each constant.
fn log_of(vehicle: &str) -> String {
    let roles: Vec<&str> = creepage::vehicles::named(vehicle).unwrap().inputs.keys().map(String::as_str).collect();
    let row = |t: i32| format!("{t},0,0,0{}\n", ",0.5".repeat(roles.len()));
    let header = [&["time", "x", "y", "heading"], &roles[..]].concat().join(",");
    format!("{header}\n{}", (0..4).map(row).collect::<String>())
}

#[test]
fn every_vehicle_is_described_and_simulated_or_refused() {
    for v in creepage::vehicles::all() {
        let (model, log) = (model_of(&v.id, ""), log_of(&v.id));
        let dir = folder(&[("model.toml", model.as_bytes()), ("run.csv", log.as_bytes())]);
        for format in ["text", "latex", "json"] {
            let output = creepage(dir.path(), &["describe", "model.toml", "--format", format]);
            assert_eq!(output.status.code(), Some(0), "{}: {}", v.id, stderr(&output));
        }
        let simulate = &["simulate", "model.toml", "--inputs", "run.csv", "--out", "out.csv"][..];
        let discover = &["discover", "run.csv", "--model", "model.toml", "--out", "report"][..];
        for arguments in [simulate, discover] {
            let output = creepage(dir.path(), arguments);
            let message = stderr(&output);
            match &v.instead {
                None => assert_eq!(output.status.code(), Some(0), "{}: {message}", v.id),
                Some(advice) => {
                    assert_eq!(output.status.code(), Some(2), "{}: {message}", v.id);
                    let start = format!("creepage: model.toml: the constraints of {} ", v.id);
                    assert!(message.starts_with(&start) && message.contains(advice.as_str()), "{message}");
                    assert_eq!(message.trim_end().lines().count(), 1, "{message}");
                }
            }
        }
        for written in ["out.csv", "report"] {
            assert_eq!(dir.path().join(written).exists(), v.instead.is_none(), "{}", v.id);
        }
    }
}

#[test]
fn limits_name_the_regime_of_every_coefficient() {
    let effects = "[[effects]]\nid = \"rotation-creep\"\ne_rc = 0.2\n";
    let dir = folder(&[("model.toml", model_of("unicycle", effects).as_bytes())]);
    let describe = |more: &[&str]| {
        let output = creepage(dir.path(), &[&["describe", "model.toml"], more].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        String::from_utf8(output.stdout).unwrap()
    };
    let plain = describe(&[]);
    assert!(plain.contains("e_rc = 0.2: backward-creep (by its sign; limits were not given)."), "{plain}");
    assert!(!plain.contains("e_tc = 0:"), "{plain}");
    let rotation = describe(&["--rotation-limits=-0.2,0.2"]);
    assert!(rotation.contains("e_rc = 0.2: slipping (limits -0.2 to 0.2)."), "{rotation}");
    assert!(!rotation.contains("e_tc = 0:"), "{rotation}");
    let both = describe(&["--rotation-limits", "-0.2,0.3", "--traverse-limits", "-0.1,0.1"]);
    assert!(both.contains("e_rc = 0.2: backward-creep (limits -0.2 to 0.3)."), "{both}");
    assert!(both.contains("e_tc = 0: ideal (limits -0.1 to 0.1)."), "{both}");
    let latex = describe(&["--traverse-limits=-0.1,0.1", "--format", "latex"]);
    assert!(latex.contains("$e_{tc} = 0$, ideal (limits -0.1 to 0.1)."), "{latex}");
    let json: serde_json::Value =
        serde_json::from_str(&describe(&["--rotation-limits=-0.2,0.2", "--format", "json"])).unwrap();
    assert_eq!(json["constraints"][0]["coefficient"]["regime"], "slipping");
    assert!(json["constraints"][1]["coefficient"].is_null());
}

#[test]
fn limits_that_are_none_are_refused() {
    let dir = folder(&[("model.toml", MODEL.as_bytes())]);
    for flag in ["--rotation-limits", "--traverse-limits"] {
        for (value, why) in [
            ("0,0.2", "the lower limit 0 must be below zero"),
            ("-0.2,-0.1", "the upper limit -0.1 must be above zero"),
            ("-inf,0.2", "must be finite"),
            ("-0.2,nan", "must be finite"),
            ("-0.2", "limits are two numbers"),
            ("-0.2,0.1,0.3", "limits are two numbers"),
            ("a,b", "limits are two numbers"),
        ] {
            let output = creepage(dir.path(), &["describe", "model.toml", &format!("{flag}={value}")]);
            let message = stderr(&output);
            assert_eq!(output.status.code(), Some(2), "{flag} {value}: {message}");
            assert!(message.contains(why) && message.contains("-0.2,0.2"), "{flag} {value}: {message}");
            assert!(output.stdout.is_empty() && !message.contains("panicked"), "{message}");
        }
    }
}

#[test]
fn trailers_behind_a_vehicle_that_cannot_pull_are_refused() {
    for tractor in ["disk", "sleigh", "skid-steer"] {
        let model = format!("vehicle = \"n-trailer\"\ntractor = \"{tractor}\"\n[parameters]\ntrailer_lengths = [3]\n");
        let dir = folder(&[("model.toml", model.as_bytes())]);
        let output = creepage(dir.path(), &["describe", "model.toml"]);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(&format!("model.toml:2:11: unknown tractor \"{tractor}\"")), "{message}");
    }
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
        // Of unusable data there is no model to write.
        assert_eq!(dir.path().join("report/model.patched.toml").exists(), verdict != "unusable-data");
    }
}

#[test]
fn a_verdict_may_end_the_command() {
    let dir = folder(&[("model.toml", MODEL.as_bytes()), ("run.csv", CSV)]);
    let told = |fail_on: &str| {
        let arguments = ["discover", "run.csv", "--model", "model.toml", "--out", "report", "--fail-on", fail_on];
        let output = creepage(dir.path(), &arguments);
        (output.status.code(), stderr(&output))
    };
    assert_eq!(told("missing-effect,unexplained").0, Some(0));
    let (code, message) = told("missing-effect,not-identifiable");
    assert!(code == Some(3) && message.contains("the verdict is not-identifiable"), "{message}");
    assert!(dir.path().join("report/report.html").exists(), "everything is written");
    let (code, message) = told("lost");
    assert!(code == Some(2) && message.contains("no-missing-effect"), "{message}");
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

#[test]
fn figures_are_written_whole_or_not_at_all() {
    let dir = folder(&[]);
    let figures = |arguments: &[&str]| creepage(dir.path(), &[&["figures"], arguments].concat());
    let made = figures(&["fig2", "fig7", "--out", "out"]);
    assert_eq!(made.status.code(), Some(0), "{}", stderr(&made));
    let said = String::from_utf8(made.stdout).unwrap();
    assert!(said.contains("S4   the energy") && said.contains("fig7-ends.csv"), "{said}");
    let mut names: Vec<_> = std::fs::read_dir(dir.path().join("out"))
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names, ["fig2.csv", "fig2.svg", "fig7-ends.csv", "fig7-paths.csv", "fig7-readings.csv", "fig7.svg"]);
    assert!(figures(&["fig2", "--out", "out", "--quiet"]).stdout.is_empty());
    for (arguments, expect) in [
        (&["fig77", "--out", "none"][..], "did you mean \"fig7\"?"),
        (&["fig1", "--e-rc=1.5", "--out", "none"], "e_rc has to lie within"),
        (&["fig1", "--e-tc=NaN", "--out", "none"], "e_tc has to lie within"),
        (&["fig7", "--reading", "G", "--out", "none"], "readings: A, A_l, B, C1, C2, D, F"),
        (&["fig1"], "--out <DIR>"),
    ] {
        let output = figures(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(stderr(&output).contains(expect), "{arguments:?}: {}", stderr(&output));
        assert!(!dir.path().join("none").exists());
    }
    let help = String::from_utf8(figures(&["--help"]).stdout).unwrap();
    assert!(creepage::figures::FIGURES.iter().all(|f| help.contains(f.name)), "{help}");
}
