//! The gap between model and measurement, before and after the missing effect is named.

use super::{Data, Drawing, Figure, Options, page, scientific};
use crate::discrepancy::discover::discover;
use crate::discrepancy::discovery::Discovery;
use crate::discrepancy::rendering::html::gap_panel;
use crate::discrepancy::request::Request;
use crate::effects;
use crate::error::Result;
use crate::files::{ModelFile, Run};
use crate::model::known;
use crate::number_format::with_error;
use crate::picture::maths::maths;
use crate::picture::plot::Size;
use crate::progress::unheard;

/// The figure.
pub const FIGURE: Figure = Figure {
    name: "gap",
    title: "the gap of a bundled run before and after the missing effect is named",
    source: "beyond the paper",
    draw,
};

const PANEL: Size = Size { width: 396.0, height: 286.0, margins: [52.0, 118.0, 50.0, 42.0] };

/// The files of the example `cornering`.
const MODEL: &str = include_str!("../../examples/runs/cornering/model.toml");
const EIGHTS: &str = include_str!("../../examples/runs/cornering/eights.csv");
const ROSETTE: &str = include_str!("../../examples/runs/cornering/rosette.csv");
const BAY: &str = include_str!("../../examples/runs/cornering/bay_held_out.csv");

/// The example `cornering` through the whole workflow: what `creepage discover` does.
fn discovered() -> Result<Discovery> {
    let file = ModelFile::parse(MODEL, "model.toml", &known(effects::all()))?;
    let run = |name: &str, text: &str| Run::parse(name, text, &file);
    let runs = [run("eights.csv", EIGHTS)?, run("rosette.csv", ROSETTE)?];
    let held_out = [run("bay_held_out.csv", BAY)?];
    let request =
        Request { file: &file, runs: &runs, held_out: &held_out, library: effects::all(), horizons: &[], seed: 0 };
    discover(&request, &unheard)
}

fn draw(_: &Options) -> Result<Drawing> {
    let found = discovered()?;
    let mut data = Data::new("", &["horizon [s]", "before [m]", "after [m]", "noise floor [m]"]);
    let curve = &found.pictures.gap;
    for (i, horizon) in curve.horizon.iter().enumerate() {
        let row = [*horizon, curve.before[i], curve.after[i], curve.floor[i]];
        data.row(row.map(|v| scientific(v, 3)));
    }
    let panel = gap_panel(&found.report, &found.pictures, PANEL, "gap-panel");
    let mut elements: Vec<_> = panel.into_iter().map(|p| page::placed(p, [2.0, 0.0], PANEL)).collect();
    elements.push(maths("strong", [10.0, 300.0], "start", &named(&found)));
    let description = "Position error of prediction over the horizon on a run that was held out: the model as given, the \
                       patched model, and the floor that noise makes.";
    let svg = page::page(FIGURE.name, FIGURE.title, description, 310.0, elements);
    Ok(Drawing { svg, tables: vec![data], text: String::new() })
}

/// What was found, with its value.
fn named(found: &Discovery) -> String {
    let effect = |e: &crate::discrepancy::report::Named| {
        let values = e.parameters.values().map(|p| format!("{} {}", with_error(p.value, p.std), p.unit));
        format!("found: {} {}", e.id, values.collect::<Vec<_>>().join(", "))
    };
    found.report.effects.iter().map(effect).collect::<Vec<_>>().join("; ")
}
