//! The example `cornering` through the whole workflow: what `creepage discover` does.

use creepage::discrepancy::discover::discover;
use creepage::discrepancy::discovery::Discovery;
use creepage::discrepancy::request::Request;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model::known;
use creepage::progress::unheard;

/// The model of the example and what is discovered in its runs.
pub fn discovered() -> (ModelFile, Discovery) {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/runs/cornering");
    let file = ModelFile::read(format!("{folder}/model.toml"), &known(effects::all())).unwrap();
    let run = |name: &str| Run::read(format!("{folder}/{name}"), &file).unwrap();
    let (runs, held_out) = ([run("eights.csv"), run("rosette.csv")], [run("bay_held_out.csv")]);
    let request =
        Request { file: &file, runs: &runs, held_out: &held_out, library: effects::all(), horizons: &[], seed: 0 };
    let found = discover(&request, &unheard).unwrap();
    (file, found)
}
