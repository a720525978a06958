//! `creepage vehicles` and `creepage effects`

use super::print;
use clap::{Args, ValueEnum};
use creepage::describe::{effects_json, effects_text, vehicle_effects_text, vehicles_json, vehicles_text};
use creepage::{Result, effects as library};

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
#[command(after_help = "Examples:\n  creepage effects\n  creepage effects --vehicle car")]
pub struct Effects {
    /// Only those of one vehicle, with the equations they rewrite there and the effects that are the same
    #[arg(long, value_name = "NAME", conflicts_with = "format")]
    vehicle: Option<String>,
    /// How to print them
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
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
    });
    Ok(())
}

/// Carries out `creepage effects`.
pub fn effects(arguments: &Effects) -> Result<()> {
    if let Some(vehicle) = &arguments.vehicle {
        print(&vehicle_effects_text(vehicle, library::all())?);
        return Ok(());
    }
    print(&match arguments.format {
        Format::Text => effects_text(library::all())?,
        Format::Json => pretty(&effects_json(library::all())?),
    });
    Ok(())
}
