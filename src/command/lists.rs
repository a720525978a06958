//! `creepage vehicles` and `creepage effects`

use super::own_effects::OwnEffects;
use super::print;
use clap::{Args, ValueEnum};
use creepage::Result;
use creepage::describe::{effects_json, effects_text, vehicle_effects_text, vehicles_json, vehicles_text};

/// List the vehicles a model file may name
#[derive(Args)]
#[command(after_help = "Example:\n  creepage vehicles --format json")]
pub struct Vehicles {
    /// How to print them
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// List the effects that can be named, with their equations
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage effects
  creepage effects --vehicle car
  creepage effects --effects examples/effects/my_effects.toml")]
pub struct Effects {
    /// Only those of one vehicle, with the equations they rewrite there and the effects that are the same
    #[arg(long, value_name = "NAME", conflicts_with = "format")]
    vehicle: Option<String>,
    /// How to print them
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    own: OwnEffects,
}

#[derive(Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Json,
}

/// JSON for people.
pub fn pretty(value: &serde_json::Value) -> String {
    format!("{value:#}\n")
}

/// Carries out `creepage vehicles`.
pub fn vehicles(arguments: &Vehicles) -> Result<()> {
    print(&match arguments.format {
        Format::Text => vehicles_text()?,
        Format::Json => pretty(&vehicles_json()?),
    })
}

/// Carries out `creepage effects`.
pub fn effects(arguments: &Effects) -> Result<()> {
    let library = arguments.own.library()?;
    if let Some(vehicle) = &arguments.vehicle {
        return print(&vehicle_effects_text(vehicle, &library)?);
    }
    print(&match arguments.format {
        Format::Text => effects_text(&library)?,
        Format::Json => pretty(&effects_json(&library)?),
    })
}
