//! The ledger and a report as a person has read and accepted them, numbers rounded so that they stand still.

use creepage::claims::{self, Options, ledger};
use creepage::discrepancy::discover::{Request, discover};
use creepage::discrepancy::summary::summary_text;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model::known;
use serde_json::Value;

fn reviewed(name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name, text));
}

/// What every claim earned; few cases, whose number stands in the text, are enough to see a status change.
#[test]
fn the_ledger() {
    let made = claims::verify(&claims::all(), &Options { cases: 16, seed: 0 }, &|_| {});
    reviewed("ledger", &ledger::text(&made));
}

#[test]
fn a_report() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/runs/cornering");
    let file = ModelFile::read(format!("{folder}/model.toml"), &known(effects::all())).unwrap();
    let run = |name: &str| Run::read(format!("{folder}/{name}"), &file).unwrap();
    let (runs, held_out) = ([run("eights.csv"), run("rosette.csv")], [run("square_held_out.csv")]);
    let request =
        Request { file: &file, runs: &runs, held_out: &held_out, library: effects::all(), horizons: &[], seed: 0 };
    let found = discover(&request, &|_| {}).unwrap();
    let mut json = serde_json::to_value(&found.report).unwrap();
    rounded(&mut json);
    reviewed("report-json", &format!("{json:#}"));
    reviewed("report-summary", &summary_text(&found.report));
    let patched = found.patched(&file);
    let effects = &patched[patched.find("[[effects]]").unwrap()..];
    let short = effects.lines().map(|l| l.split_once(" = ").map_or(l.to_string(), |(k, v)| match v.parse::<f64>() {
        Ok(v) => format!("{k} = {v:.4}"),
        Err(_) => format!("{k} = {v}"),
    }));
    reviewed("report-patched-effects", &short.collect::<Vec<_>>().join("\n"));
}

/// Every number that is not whole with three digits, one too small to matter as zero.
fn rounded(value: &mut Value) {
    match value {
        Value::Number(n) if !n.is_u64() && !n.is_i64() => {
            let x = n.as_f64().unwrap();
            *value = if x.abs() < 1e-12 { Value::from(0.0) } else { format!("{x:.2e}").parse::<f64>().unwrap().into() };
        }
        Value::Array(items) => items.iter_mut().for_each(rounded),
        Value::Object(entries) => entries.values_mut().for_each(rounded),
        _ => {}
    }
}
