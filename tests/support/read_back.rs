//! A model and a log as the library reads them from their text.

use creepage::files::{ModelFile, Run};
use creepage::{effects, model};

/// The texts of `model.toml` and `run.csv`, read; the library of effects is known.
pub fn read_back(model: &str, log: &str) -> (ModelFile, Run) {
    let file = ModelFile::parse(model, "model.toml", &model::known(effects::all())).unwrap();
    let run = Run::parse("run.csv", log, &file).unwrap();
    (file, run)
}
