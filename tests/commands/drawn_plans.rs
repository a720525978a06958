//! `creepage plan` on vehicles, effects and goals drawn from a seed: every one that can be moved everywhere reaches its goal.
//!
//! A few are drawn; `PLANS=200 cargo test --release --test commands drawn_vehicles -- --nocapture` draws as many as it says.

use crate::program::{creepage, stderr};
use creepage::effects::{self, Effect};
use creepage::files::ModelFile;
use creepage::model::{self, Model};
use creepage::scaffold::{Starter, Wanted};
use creepage::vehicles::Moves;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::Value;
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// Vehicles whose inputs do not change all of a pose, which is a test of its own.
const HELD: [&str; 3] = ["synchro-drive", "hopper", "disk"];

/// Vehicles that inputs move everywhere, as files to begin with make them.
fn makes(folder: &Path) -> Vec<(String, Model)> {
    let moved = creepage::vehicles::all().iter().filter(|v| !HELD.contains(&v.id.as_str()));
    let ids = moved.map(|v| (v.id.clone(), None));
    let trains = (1..=3).map(|n| ("n-trailer".to_string(), Some(n)));
    let make = |(vehicle, trailers): (String, Option<usize>)| {
        let text = Starter::new(&Wanted { vehicle, trailers, ..Wanted::default() }).ok()?.text;
        let path = folder.join("make.toml");
        fs::write(&path, &text).unwrap();
        let file = ModelFile::read(&path, &model::known(effects::all())).unwrap();
        Model::check_motion(&file).ok()?;
        Some((text, Model::of_file(&file, effects::all()).ok()?))
    };
    ids.chain(trains).filter_map(make).collect()
}

/// What a sensor does is of no plan; where a law has no value at rest, nothing begins.
const LEFT_OUT: [&str; 4] = ["sensor-bias", "sensor-scale", "rocard-creep", "pose-filter"];

/// The size of an input that an effect acts on.
fn size(model: &Model, role: &str) -> f64 {
    match model.vehicle.moved_by(role) {
        Some(moves) if moves.is_wheel() => 10.0,
        Some(Moves::Steering | Moves::RearSteering) => 0.5,
        _ => 1.0,
    }
}

/// An effect that applies to a model, of plausible size, as a file has it.
fn drawn_effect(model: &Model, rng: &mut ChaCha8Rng) -> String {
    let sought = |e: &&Effect| !LEFT_OUT.contains(&e.id.as_str()) && !e.per_quantity;
    let each = |e: &Effect| match e.per_input {
        true => model.inputs.iter().map(|r| e.on_input(r, model.vehicle.unit_of(r), size(model, r))).collect(),
        false => vec![e.clone()],
    };
    let library: Vec<Effect> = effects::all().iter().filter(sought).flat_map(each).collect();
    let all = model.applicable(&library);
    let (effect, trailer) = all[rng.random_range(0..all.len())];
    let mut text = format!("[[effects]]\nid = \"{}\"\n", effect.id);
    if let Some(role) = &effect.on {
        let _ = writeln!(text, "input = \"{role}\"");
    }
    if let Some(n) = trailer {
        let _ = writeln!(text, "trailer = {n}");
    }
    for (name, p) in &effect.parameters {
        let one_sided = p.positive || p.range[0] >= 0.0 || effect.id.contains("delay");
        let sign = if one_sided || rng.random_bool(0.5) { 1.0 } else { -1.0 };
        let _ = writeln!(text, "{name} = {}", sign * p.size * rng.random_range(0.3..1.0));
    }
    text
}

/// A model file, and a goal.
fn drawn_case((text, model): &(String, Model), rng: &mut ChaCha8Rng) -> (String, String) {
    let [first, second] = [0; 2].map(|_| drawn_effect(model, rng));
    let is_another = first.lines().nth(1) != second.lines().nth(1);
    let second = if is_another && rng.random_bool(0.5) { &second } else { "" };
    let goal = [3.0; 3].map(|reach: f64| (reach * rng.random_range(-1.0..1.0_f64)).to_string());
    (format!("{text}\n{first}{second}"), format!("--goal={}", goal.join(",")))
}

#[test]
fn drawn_vehicles_reach_drawn_goals() {
    let dir = tempfile::tempdir().unwrap();
    let makes = makes(dir.path());
    assert!(makes.len() >= 12, "{}", makes.len());
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let cases = std::env::var("PLANS").ok().and_then(|n| n.parse().ok()).unwrap_or(14);
    let mut missed = Vec::new();
    for case in 0..cases {
        let (text, goal) = drawn_case(&makes[case % makes.len()], &mut rng);
        fs::write(dir.path().join("model.toml"), &text).unwrap();
        let arguments = ["plan", "model.toml", &goal, "--out", "plan.csv", "--format", "json", "-q"];
        let output = creepage(dir.path(), &arguments);
        // An integration across jumps is less exact; where an input rests on one the rows that lead there are not the planned ones.
        let bounds = [("input-truncation", 1e-3), ("input-backlash", 1e-6), ("", 1e-8)];
        let (_, bound) = bounds.into_iter().find(|(id, _)| text.contains(id)).unwrap();
        let found: Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
        let off = ["miss_m", "miss_rad"].map(|k| found["reached"][k].as_f64().unwrap_or(f64::INFINITY).abs());
        if off.iter().any(|miss| *miss > bound) {
            missed.push(format!(
                "{case} {goal} {off:?} {}\n{}",
                stderr(&output),
                &text[text.find("[columns]").unwrap()..]
            ));
        }
    }
    assert!(missed.is_empty(), "{} of {cases} missed:\n{}", missed.len(), missed.join("\n"));
}
