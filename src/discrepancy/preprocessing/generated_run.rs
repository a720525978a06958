//! Runs as they should be, of any vehicle, for the tests of what is not.
#![cfg(test)]

use crate::discrepancy::record::run_record::Record;
use crate::effects::{self, Applied, Effect};
use crate::files::{ModelFile, Run};
use crate::model::Model;
use crate::motion::{StateSensitivity, Stepper, Timing};
use crate::vehicles;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A run of a vehicle that drives in all directions, with an ordinary effect or none, and noise.
pub fn generated(vehicle: &str, seed: u64, has_heading: bool) -> Option<(ModelFile, Model, Run)> {
    turning(vehicle, seed, has_heading, 1.0)
}

/// The same that turns so many times as much.
pub fn turning(vehicle: &str, seed: u64, has_heading: bool, much: f64) -> Option<(ModelFile, Model, Run)> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let known = vehicles::named(vehicle)?;
    let value = |name: &str| if name.contains("radius") { 0.1 } else { 0.4 };
    let parameters: Vec<(&str, f64)> = known.parameters.keys().map(|name| (name.as_str(), value(name))).collect();
    let list: Vec<String> = parameters.iter().map(|(name, value)| format!("{name} = {value}")).collect();
    let text = format!("vehicle = \"{vehicle}\"\n[parameters]\n{}\n", list.join("\n"));
    let file = ModelFile::parse(&text, "model.toml", &crate::model::known(effects::all())).ok()?;
    let roles: Vec<String> = known.inputs.keys().filter(|r| *r != "speed").cloned().collect();
    let model = Model::from_file(&file, effects::all(), &roles).ok()?;
    let time: Vec<f64> = (0..500).map(|i| 0.08 * f64::from(i)).collect();
    let phase = random.random_range(0.0..6.0);
    let turns = much * random.random_range(0.4..1.0);
    let speed = |t: f64| 8.0 + 3.0 * (0.3 * t + phase).sin();
    let column = |(k, role): (usize, &String)| -> Vec<f64> {
        let unit = known.inputs[role].unit.as_str();
        let of = |t: f64| match (role.as_str(), unit) {
            ("yaw_rate", _) => turns * (0.5 * t + phase).sin(),
            (_, "rad") => 0.4 * much * (0.5 * t + phase).sin(),
            (name, _) if name.contains("left") => speed(t) - 2.0 * turns * (0.5 * t + phase).sin(),
            (name, _) if name.contains("right") => speed(t) + 2.0 * turns * (0.5 * t + phase).sin(),
            _ => speed(t) + 0.1 * k as f64,
        };
        time.iter().map(|t| of(*t)).collect()
    };
    let inputs: Vec<Vec<f64>> = roles.iter().enumerate().map(column).collect();
    let ordinary = |(e, _): &(&Effect, Option<usize>)| !e.unsought;
    let applicable: Vec<_> = model.applicable(effects::all()).into_iter().filter(ordinary).collect();
    let chosen = random.random_range(0..2 * applicable.len().max(1));
    let truth = match applicable.get(chosen) {
        Some((effect, trailer)) => {
            let sign = if random.random_range(0..2) == 0 { 1.0 } else { -1.0 };
            let signed = |p: &crate::effects::Parameter| if p.positive { p.size } else { sign * p.size };
            let values = effect.parameters.values().map(signed).collect();
            model.clone().with_effect(Applied::new(effect, *trailer, values))
        }
        None => model.clone(),
    };
    let equations = truth.equations(&[]).ok()?;
    let record = Record::new("run", time.clone(), vec![vec![]; 2], false, &inputs, Timing::Sample);
    let mut stepper = Stepper::new(&equations, &record.signals, &[]);
    let mut arc = StateSensitivity { z: vec![0.3; equations.n()], s: vec![] };
    let noise = 10.0_f64.powf(random.random_range(-4.0..-2.0));
    let mut pose = [const { Vec::new() }; 3];
    for i in 0..time.len() {
        let y = stepper.outputs(&arc.z).to_vec();
        (0..3).for_each(|c| pose[c].push(y[c] + noise * random.random_range(-1.0..1.0)));
        if i + 1 < time.len() {
            stepper.advance(&mut arc, time[i], time[i + 1]);
        }
    }
    if pose.iter().flatten().any(|v| !v.is_finite()) {
        return None;
    }
    let [x, y, heading] = pose;
    let run = Run {
        deviations: Default::default(),
        defined: crate::files::Defined::default(),
        differences: vec![None; inputs.len()],
        name: "run.csv".into(),
        path: "run.csv".into(),
        sha256: String::new(),
        time,
        x,
        y,
        heading: has_heading.then_some(heading),
        trailer_headings: vec![],
        measured: vec![],
        roles,
        inputs,
        rows_dropped: 0,
        why_dropped: std::collections::BTreeMap::new(),
        warnings: vec![],
        apart: None,
    };
    Some((file, model, run))
}
