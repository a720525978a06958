//! Terms without a name: which a vehicle has, and what stands in them.

use creepage::effects::Effect;
use creepage::formula::{Symbol, Unit};
use creepage::model::{Model, is_term};
use creepage::vehicles;
use std::collections::BTreeSet;

fn terms(vehicle: &str) -> Vec<Effect> {
    Model::sample(vehicles::named(vehicle).unwrap()).unwrap().terms().unwrap()
}

fn ids(vehicle: &str) -> BTreeSet<String> {
    let all = terms(vehicle);
    let ids: BTreeSet<String> = all.iter().map(|t| t.id.clone()).collect();
    assert_eq!(ids.len(), all.len(), "no id twice");
    assert!(ids.iter().all(|id| is_term(id)) && !is_term("unnamed-") && !is_term("rotation-creep"));
    // After whatever has a name, each in its place.
    assert!(all.windows(2).all(|w| w[0].order + 1 == w[1].order) && all[0].order > 1000);
    ids
}

/// What an effect of the library says is no term; what only a steering or a logged yaw rate makes plain neither.
#[test]
fn terms_are_what_the_library_has_no_name_for() {
    let named = [
        "rotation-v",
        "rotation-yaw",
        "traverse-v",
        "traverse-yaw",
        "traverse-v-yaw",
        "traverse-v2-yaw",
        "traverse-sin-heading",
        "traverse-cos-heading",
        "yaw-yaw",
    ];
    // Three definitions with 4 powers of speed, 9 of the yaw rate, and 4 of the heading with 2 of speed.
    for (vehicle, count, own, other) in [
        ("unicycle", 3 * (4 * 9 + 4 * 2) - 11, "yaw-constant", "yaw-v2-yaw"),
        ("car", 3 * (4 * 9 + 4 * 2) - 10 + 3, "yaw-v2-yaw", "yaw-constant"),
        ("differential-drive", 3 * (4 * 9 + 4 * 2) - 9, "", "yaw-v2-yaw"),
    ] {
        let found = ids(vehicle);
        let has = |id: &str| found.contains(&format!("unnamed-{id}"));
        assert_eq!(found.len(), count, "{vehicle}");
        assert!(named.iter().all(|id| !has(id)) && !has(own) && has(other), "{vehicle}");
        for id in
            ["rotation-constant", "rotation-v2", "traverse-constant", "traverse-abs-yaw", "yaw-v2", "yaw-sin-heading"]
        {
            assert!(has(id), "{vehicle}: {id}");
        }
        assert_eq!(has("steering-steering2"), vehicle == "car");
    }
}

/// k has the unit that makes the term one of what it is added to.
#[test]
fn every_term_has_the_unit_of_its_target() {
    let unit = |text: &str| Unit::parse(text).unwrap();
    for vehicle in ["unicycle", "car", "differential-drive", "tricycle"] {
        for term in terms(vehicle) {
            let (target, change) = term.changes.iter().next().unwrap();
            let wanted = match target.as_str() {
                "v_l" | "v_t" => unit("m/s"),
                "phi'" => unit("rad/s"),
                _ => unit("rad"),
            };
            let of = |s: &Symbol| match s.as_str() {
                "it" => wanted,
                "k" => unit(&term.parameters["k"].unit),
                "v_l" | "v_d" | "v_t" | "v_n" => unit("m/s"),
                "phi'" | "yaw_rate" | "theta_1'" | "theta_2'" | "theta'" => unit("rad/s"),
                "phi" | "delta" | "steering_angle" => unit("rad"),
                "L" | "a" | "r" | "r_1" | "r_2" | "l" => unit("m"),
                s if s.starts_with("e_") => unit("1"),
                s => panic!("{vehicle}: {}: {s}", term.id),
            };
            let found = change.eval(&of).unwrap_or_else(|| panic!("{vehicle}: {}: {change}", term.id));
            assert!(found.fits(&wanted), "{vehicle}: {}: {found}, {wanted}", term.id);
            assert!(!term.parameters["k"].unit.is_empty() && term.parameters["k"].start == [0.0]);
        }
    }
}

/// What stays where it is has no speed, and the names of the library speak of what moves.
#[test]
fn a_body_in_the_air_has_terms_of_its_turning_alone() {
    let hopper = vehicles::all().iter().find(|v| !v.coordinates.is_empty()).unwrap();
    let found = ids(&hopper.id);
    let turning = ["", "-yaw", "-abs-yaw", "-yaw-abs-yaw", "-yaw2", "-yaw3", "-abs-yaw3", "-left-yaw", "-right-yaw"];
    let heading = ["-sin-heading", "-cos-heading", "-sin-2-heading", "-cos-2-heading"];
    let name = |end: &str| format!("unnamed-yaw{}", if end.is_empty() { "-constant" } else { end });
    assert_eq!(found, turning.into_iter().chain(heading).map(name).collect());
}
