//! Every bad input ends in one message that names the place and what to do.

use crate::bad_inputs::{BAD_LOGS, BAD_MODELS, CSV, Case, MODEL};
use crate::known;
use crate::slips::{damage, slip};
use creepage::files::{ModelFile, Run, read_text};
use creepage::{Error, Result};
use proptest::prelude::*;
use std::path::Path;

fn read(dir: &Path, model: &[u8], csv: &[u8]) -> Result<Run> {
    let (model_path, run_path) = (dir.join("model.toml"), dir.join("run.csv"));
    std::fs::write(&model_path, model).unwrap();
    std::fs::write(&run_path, csv).unwrap();
    Run::read(run_path, &ModelFile::read(model_path, &known::known())?)
}

fn check(case: &Case) -> Option<String> {
    let dir = tempfile::tempdir().unwrap();
    let Err(error) = read(dir.path(), case.model.as_bytes(), case.csv) else {
        return Some(format!("{}: accepted", case.name));
    };
    let message = error.to_string();
    let missing: Vec<_> = case.expect.iter().filter(|part| !message.contains(**part)).collect();
    let good = missing.is_empty() && error.exit_code() == 2 && message.lines().count() == 1;
    (!good).then(|| format!("{}: {message}\n   lacks {missing:?}", case.name))
}

#[test]
fn every_bad_input_is_explained() {
    let failures: Vec<_> = BAD_LOGS.iter().chain(BAD_MODELS).filter_map(check).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn the_good_pair_is_accepted() {
    let dir = tempfile::tempdir().unwrap();
    let run = read(dir.path(), MODEL.as_bytes(), CSV).unwrap();
    assert_eq!((run.time.len(), run.rows_dropped, run.warnings.len()), (3, 0, 0));
}

#[test]
fn paths_that_are_no_files_are_explained() {
    let dir = tempfile::tempdir().unwrap();
    let (none, folder) = (dir.path().join("none.csv"), dir.path().to_path_buf());
    let model = ModelFile::parse(MODEL, "model.toml", &known::known()).unwrap();
    let errors = |path: &Path| -> [Error; 3] {
        [
            Run::read(path, &model).unwrap_err(),
            ModelFile::read(path, &known::known()).unwrap_err(),
            read_text(path).unwrap_err(),
        ]
    };
    for error in errors(&none) {
        assert_eq!(error.to_string(), format!("{}: no such file; check the path", none.display()));
        assert_eq!(error.exit_code(), 2);
    }
    for error in errors(&folder) {
        let expect = format!("{}: is a folder, not a file; name a file inside it", folder.display());
        assert_eq!(error.to_string(), expect);
    }
}

#[cfg(unix)]
#[test]
fn a_device_without_end_is_refused() {
    let model = ModelFile::parse(MODEL, "model.toml", &known::known()).unwrap();
    assert!(Run::read("/dev/zero", &model).unwrap_err().to_string().contains("binary"));
    assert!(read_text("/dev/zero").unwrap_err().to_string().contains("larger than 16 MiB"));
}

/// What every run that was accepted keeps to.
fn sound(run: &Run) -> bool {
    let rows = run.time.len();
    let poses = [&run.x, &run.y].into_iter().chain(&run.heading).chain(&run.trailer_headings);
    // Rows without a pose have inputs all the same.
    let logged = run.apart.as_ref().map_or(&run.time, |a| &a.time);
    let whole = |column: &Vec<f64>, rows: usize| column.len() == rows && column.iter().all(|v| v.is_finite());
    let dropped: usize = run.why_dropped.values().sum();
    rows >= 2
        && run.time.is_sorted_by(|a, b| a < b)
        && run.roles.len() == run.inputs.len()
        && run.rows_dropped == dropped
        && logged.is_sorted_by(|a, b| a < b)
        && run.inputs.iter().all(|column| whole(column, logged.len()))
        && poses.into_iter().chain([&run.time]).all(|column| whole(column, rows))
}

const TRAILERS: &str = "\
vehicle = \"n-trailer\"
tractor = \"car\" # pulls
[parameters]
wheel_radius = 0.3
wheelbase = 2.6
trailer_lengths = [3.0, 3e0]
hitch_offsets = [0.1, -0.1]
[columns]
trailer_headings = ['a', \"b\"]
[initial]
x = 0
y = 0.0
heading = -0.5
[[effects]]
id = \"trailer-traverse-creep\"
trailer = 2
e_tc = 0.01
";

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 400, ..Default::default() })]

    #[test]
    fn random_bytes_never_panic(model in prop::collection::vec(any::<u8>(), 0..200), csv in prop::collection::vec(any::<u8>(), 0..200)) {
        let dir = tempfile::tempdir().unwrap();
        prop_assert!(read(dir.path(), &model, CSV).is_err());
        prop_assert!(read(dir.path(), MODEL.as_bytes(), &csv).is_err());
    }

    #[test]
    fn damaged_logs_are_refused_or_sound(slips in prop::collection::vec(slip(), 1..6)) {
        let dir = tempfile::tempdir().unwrap();
        match read(dir.path(), MODEL.as_bytes(), &damage(CSV, &slips)) {
            Ok(run) => prop_assert!(sound(&run), "{run:?}"),
            Err(error) => prop_assert!(error.exit_code() == 2 && error.to_string().contains("run.csv")),
        }
    }

    #[test]
    fn damaged_models_are_refused_or_read(slips in prop::collection::vec(slip(), 1..6)) {
        for text in [MODEL, TRAILERS] {
            let text = String::from_utf8_lossy(&damage(text.as_bytes(), &slips)).into_owned();
            match ModelFile::parse(&text, "model.toml", &known::known()) {
                Ok(model) => {
                    prop_assert!(model.parameters.values().all(|value| value.is_finite()));
                    let again = ModelFile::parse(&model.patched(&[]), "model.toml", &known::known()).unwrap();
                    prop_assert_eq!((again.effects, again.columns), (model.effects, model.columns));
                }
                Err(error) => prop_assert!(error.exit_code() == 2 && error.place().is_some(), "{error}"),
            }
        }
    }
}
