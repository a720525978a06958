//! Descriptions and lists as a person has read and accepted them.

mod models;

use creepage::describe::{self, Description};
use creepage::effects;

fn reviewed(run: impl FnOnce()) {
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(concat!(env!("CARGO_MANIFEST_DIR"), "/snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.bind(run);
}

fn pretty(v: &serde_json::Value) -> String {
    format!("{v:#}")
}

#[test]
fn descriptions_as_text() {
    for (name, model) in models::reviewed() {
        let d = Description::of(&model).unwrap();
        reviewed(|| insta::assert_snapshot!(format!("describe-{name}-text"), describe::text(&d)));
    }
}

#[test]
fn descriptions_as_latex() {
    for (name, model) in models::reviewed() {
        let d = Description::of(&model).unwrap();
        reviewed(|| insta::assert_snapshot!(format!("describe-{name}-latex"), describe::latex(&d)));
    }
}

#[test]
fn descriptions_as_json() {
    for (name, model) in models::reviewed() {
        let d = Description::of(&model).unwrap();
        reviewed(|| insta::assert_snapshot!(format!("describe-{name}-json"), pretty(&describe::json(&d))));
    }
}

#[test]
fn the_list_of_vehicles() {
    reviewed(|| insta::assert_snapshot!("vehicles-text", describe::vehicles_text().unwrap()));
    let json = describe::vehicles_json().unwrap();
    reviewed(|| insta::assert_snapshot!("vehicles-json", pretty(&json)));
    assert_eq!(json["vehicles"].as_array().unwrap().len(), creepage::vehicles::all().len() + 1);
}

#[test]
fn the_list_of_effects() {
    reviewed(|| insta::assert_snapshot!("effects-text", describe::effects_text(effects::all()).unwrap()));
    let json = describe::effects_json(effects::all()).unwrap();
    reviewed(|| insta::assert_snapshot!("effects-json", pretty(&json)));
    let applies = |id: &str| {
        let entries = json["effects"].as_array().unwrap();
        let entry = entries.iter().find(|e| e["id"] == id).unwrap();
        entry["vehicles"].as_array().unwrap().iter().map(|v| v.as_str().unwrap().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(applies("yaw-rate-bias"), ["unicycle", "n-trailer"]);
    assert_eq!(applies("track-width"), ["differential-drive", "n-trailer"]);
    assert_eq!(applies("hitch-offset"), ["n-trailer"]);
    assert_eq!(applies("understeer"), ["car", "four-wheel-car", "tricycle", "n-trailer"]);
}
