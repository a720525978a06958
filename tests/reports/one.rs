//! A report and the motion of every vehicle as a person has read and accepted them, numbers rounded so that they stand still.

use crate::cornering;
use crate::models;
use crate::reviewed::reviewed;
use crate::rounded::rounded;
use creepage::discrepancy::rendering::html::gap_svg;
use creepage::discrepancy::rendering::summary::summary_text;
use creepage::effects::{self, Applied};
use creepage::figures::fixed;
use creepage::formula::Expr;
use creepage::model::Model;
use creepage::motion::{Formulas, Integrator, simulate_model};

#[test]
fn a_report() {
    let (file, found) = cornering::discovered();
    let mut json = serde_json::to_value(&found.report).unwrap();
    rounded(&mut json);
    // The same on every machine, wherever the package lies.
    let home = concat!(env!("CARGO_MANIFEST_DIR"), "/");
    reviewed("report-json", &format!("{json:#}").replace(home, ""));
    reviewed("report-summary", &summary_text(&found.report));
    let patched = found.patched(&file);
    let effects = &patched[patched.find("[[effects]]").unwrap()..];
    let short = effects.lines().map(|l| {
        l.split_once(" = ").map_or(l.to_string(), |(k, v)| match v.parse::<f64>() {
            Ok(v) => format!("{k} = {v:.4}"),
            Err(_) => format!("{k} = {v}"),
        })
    });
    reviewed("report-patched-effects", &short.collect::<Vec<_>>().join("\n"));
    let kept = std::fs::read_to_string(format!("{home}examples/gap.svg")).unwrap();
    let again = "run the first command of the README and copy report/gap.svg to examples";
    assert!(kept == gap_svg(&found.report, &found.pictures), "examples/gap.svg is stale: {again}");
}

/// Inputs of the reviewed drive, by the beginning of their role: smooth, turning to both sides, never alike.
const INPUTS: [(&str, &str); 5] = [
    ("wheel_rate_left", "4 + cos(t)"),
    ("wheel_rate_right", "5 + sin(2*t)"),
    ("wheel_rate", "4 + sin(t)"),
    ("yaw_rate", "1/5 + cos(t)/2"),
    ("steering_angle", "1/10 + sin(2*t)/4"),
];

/// Where every vehicle that moves, alone and with trailers, is after three seconds with each effect at its usual size.
#[test]
fn the_motion_of_every_vehicle() {
    let mut text = String::from("After 3 s: x, y, heading, headings of trailers; m and rad.\n");
    // The hopper has its own tests: it stands nowhere in the plane.
    for machine in models::machines().into_iter().filter(|m| m.vehicle.id != "hopper") {
        let trailers = if machine.trailers.is_empty() { "" } else { " with two trailers" };
        text.push_str(&format!("\n{}{trailers}\n", machine.vehicle.id));
        text.push_str(&line("no effect", &machine));
        for (effect, trailer) in machine.applicable(effects::all()) {
            let values = effect.parameters.values().map(|p| p.size).collect();
            let applied = Applied::new(effect, trailer, values);
            text.push_str(&line(&applied.label(), &machine.clone().with_effect(applied)));
        }
    }
    reviewed("motion", &text);
}

fn line(what: &str, model: &Model) -> String {
    let formula = |role: &String| {
        let found = INPUTS.iter().find(|(name, _)| role.starts_with(name)).unwrap();
        Expr::parse(found.1).unwrap()
    };
    let inputs = Formulas::new(&model.inputs.iter().map(formula).collect::<Vec<_>>(), &[]).unwrap();
    let mut start = vec![0.0, 0.0, 0.3];
    start.extend((1..=model.trailers.len()).map(|i| 0.3 - 0.2 * i as f64));
    let table = simulate_model(model, &inputs, &[0.0, 3.0], &start, &Integrator::default()).unwrap();
    // After the time come x, y, heading and the trailers.
    let end = table.columns[1..=start.len()].iter().map(|c| format!("{:>9}", fixed(c[1], 4)));
    format!("  {what:<36}{}\n", end.collect::<String>())
}
