//! `creepage describe`

use super::lists::pretty;
use super::print;
use clap::{Args, ValueEnum};
use creepage::describe::{Description, json, latex, text};
use creepage::files::ModelFile;
use creepage::model::{self, Model};
use creepage::{Result, effects};
use std::path::PathBuf;

/// Print a model's constraints, matrix, derivatives and motion, with every symbol and unit
#[derive(Args)]
#[command(after_help = "\
Example:
  creepage describe examples/runs/steering/model.toml
  creepage describe examples/runs/steering/model.toml --format latex > model.tex")]
pub struct Arguments {
    /// The model
    #[arg(value_name = "MODEL.toml")]
    model: PathBuf,
    /// How to print it
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Latex,
    Json,
}

/// Carries out the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let library = effects::all();
    let file = ModelFile::read(&arguments.model, &model::known(library))?;
    let roles: Vec<String> = file.columns.inputs.iter().map(|i| i.role.clone()).collect();
    let description = Description::of(&Model::from_file(&file, library, &roles)?)?;
    print(&match arguments.format {
        Format::Text => text(&description),
        Format::Latex => latex(&description),
        Format::Json => pretty(&json(&description)),
    });
    Ok(())
}
