//! Descriptions and lists as a person has read and accepted them.

use crate::models;
use crate::reviewed::reviewed;
use creepage::describe::{self, CreepLimits, Description};
use creepage::effects;
use creepage::model::Model;
use creepage::vehicles;

fn pretty(v: &serde_json::Value) -> String {
    format!("{v:#}")
}

#[test]
fn descriptions_as_text() {
    for (name, model) in models::reviewed() {
        let d = Description::of(&model).unwrap();
        reviewed(&format!("describe-{name}-text"), &describe::text(&d));
    }
}

#[test]
fn descriptions_of_later_vehicles_as_text() {
    for (name, model) in models::reviewed_as_text() {
        let d = Description::of(&model).unwrap();
        reviewed(&format!("describe-{name}-text"), &describe::text(&d));
    }
}

#[test]
fn regimes_in_every_format() {
    let limits = CreepLimits { rotation: "-0.2,0.2".parse().ok(), traverse: "-0.1,0.1".parse().ok() };
    let wheel = Model::new("unicycle", &[("wheel_radius", 0.3)]).unwrap();
    let spinning = wheel.clone().with_effect(models::effect("rotation-creep", None, &[1.0]));
    let sliding = models::effect("cornering-creep", None, &[0.1]);
    let model = spinning.with_effect(models::effect("traverse-creep", None, &[-0.05])).with_effect(sliding);
    let d = Description::of(&model).unwrap();
    let judged = d.clone().with_limits(limits);
    reviewed("regimes-by-sign-text", constraints(&describe::text(&d)));
    reviewed("regimes-text", constraints(&describe::text(&judged)));
    reviewed("regimes-latex", constraints(&describe::latex(&judged)));
    let json = describe::json(&judged);
    let told: Vec<_> = json["constraints"].as_array().unwrap().iter().map(|c| c["coefficient"].clone()).collect();
    reviewed("regimes-json", &pretty(&told.into()));
}

/// The part of a description that speaks of the constraints.
fn constraints(text: &str) -> &str {
    let end = text.find("Pfaffian matrix").unwrap();
    &text[text.find("Constraints\n").or(text.find("{Constraints}")).unwrap()..end]
}

#[test]
fn descriptions_as_latex() {
    for (name, model) in models::reviewed() {
        let d = Description::of(&model).unwrap();
        reviewed(&format!("describe-{name}-latex"), &describe::latex(&d));
    }
}

#[test]
fn descriptions_as_json() {
    for (name, model) in models::reviewed() {
        let d = Description::of(&model).unwrap();
        reviewed(&format!("describe-{name}-json"), &pretty(&describe::json(&d)));
    }
}

#[test]
fn the_list_of_vehicles() {
    reviewed("vehicles-text", &describe::vehicles_text(vehicles::all()).unwrap());
    let json = describe::vehicles_json(vehicles::all()).unwrap();
    reviewed("vehicles-json", &pretty(&json));
    assert_eq!(json["vehicles"].as_array().unwrap().len(), creepage::vehicles::all().len() + 1);
}

#[test]
fn the_list_of_effects() {
    reviewed("effects-text", &describe::effects_text(vehicles::all(), effects::all()).unwrap());
    let json = describe::effects_json(vehicles::all(), effects::all()).unwrap();
    reviewed("effects-json", &pretty(&json));
    let applies = |id: &str| {
        let entries = json["effects"].as_array().unwrap();
        let entry = entries.iter().find(|e| e["id"] == id).unwrap();
        entry["vehicles"].as_array().unwrap().iter().map(|v| v.as_str().unwrap().to_string()).collect::<Vec<_>>()
    };
    assert_eq!(applies("yaw-rate-bias"), ["unicycle", "n-trailer"]);
    let wide = ["differential-drive", "differential-drive-castor", "skid-steer", "tracked", "mecanum", "n-trailer"];
    assert_eq!(applies("track-width"), wide);
    let pairs = ["differential-drive", "differential-drive-castor", "tracked", "n-trailer"];
    assert_eq!(applies("unequal-rotation-creep"), pairs);
    assert_eq!(applies("wheel-radius-mismatch"), pairs);
    // Where nothing yaws every point of the body moves alike.
    let held = |id: &str| ["disk", "synchro-drive"].map(|v| applies(id).contains(&v.to_string()));
    assert_eq!((held("drift"), held("lever-arm"), held("rotation-creep")), ([false, true], [false; 2], [true; 2]));
    assert_eq!(applies("hitch-offset"), ["n-trailer"]);
    assert_eq!(applies("understeer"), ["car", "four-wheel-car", "tricycle", "four-wheel-steering", "n-trailer"]);
}
