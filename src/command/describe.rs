//! `creepage describe`

use super::output::{pretty, print};
use super::user_catalogues::UserCatalogues;
use clap::{Args, ValueEnum};
use creepage::Result;
use creepage::describe::{CreepLimits, GivenPoint, json, latex, text};
use creepage::formula::Symbol;
use creepage::mechanism::Limits;
use std::path::PathBuf;

/// Print a model's constraints, matrix, derivatives and motion, with every symbol and unit
#[derive(Args)]
#[command(after_help = "\
Example:
  creepage describe examples/runs/steering/model.toml
  creepage describe examples/runs/steering/model.toml --format latex > model.tex
  creepage describe report/model.patched.toml --rotation-limits=-0.2,0.2 --traverse-limits=-0.1,0.1
  creepage describe examples/bus/model.toml
  creepage describe examples/runs/steering/model.toml --at \"phi=0.3,x'=1\"
  creepage describe report/model.patched.toml --effects examples/effects/my_effects.toml

A coefficient that the model gives is named by its regime; limits tell creep from sliding, and name every coefficient.")]
pub struct Arguments {
    /// The model
    #[arg(value_name = "MODEL.toml")]
    model: PathBuf,
    /// How to print it
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Limits of rotation creep: skidding at the lower one, slipping at the upper one
    #[arg(long, value_name = "E2,E1", allow_hyphen_values = true, value_parser = limits)]
    rotation_limits: Option<Limits>,
    /// Limits of traverse creep: side-slip at and beyond them
    #[arg(long, value_name = "E2,E1", allow_hyphen_values = true, value_parser = limits)]
    traverse_limits: Option<Limits>,
    /// Adds value, gradient and Hessian of every constraint at a point of coordinates, rates and coefficients, by dual
    /// numbers; q=… and q'=… give all coordinates and all rates in their order
    #[arg(long, value_name = "NAME=VALUE,…", value_parser = point)]
    at: Option<GivenPoint>,
    /// Rates that are measured beside those that the inputs give, such as phi_1' of a trailer: the signature hangs on them
    #[arg(long, value_name = "RATE,RATE", value_delimiter = ',')]
    measured: Vec<String>,
    #[command(flatten)]
    own: UserCatalogues,
}

fn point(text: &str) -> std::result::Result<GivenPoint, String> {
    text.parse().map_err(|e: creepage::Error| e.to_string())
}

fn limits(text: &str) -> std::result::Result<Limits, String> {
    text.parse().map_err(|e: creepage::Error| e.to_string())
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Latex,
    Json,
}

/// Carries out the command.
pub fn run(arguments: &Arguments) -> Result<()> {
    let model = arguments.own.model(&arguments.model)?;
    let limits = CreepLimits { rotation: arguments.rotation_limits, traverse: arguments.traverse_limits };
    let measured: Vec<Symbol> = arguments.measured.iter().map(|s| Symbol::new(s)).collect();
    let description = creepage::describe_with(&model, &measured, arguments.at.as_ref());
    let description = description.map_err(|e| e.at_file(&arguments.model))?.with_limits(limits);
    print(&match arguments.format {
        Format::Text => text(&description),
        Format::Latex => latex(&description),
        Format::Json => pretty(&json(&description)),
    })
}
