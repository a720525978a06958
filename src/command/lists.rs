//! `creepage vehicles` and `creepage effects`

use super::own::{Own, OwnVehicles};
use super::print;
use clap::{Args, ValueEnum};
use creepage::Result;
use creepage::describe::{
    effects_json, effects_text, vehicle_effects_json, vehicle_effects_text, vehicles_json, vehicles_text,
};

/// List the vehicles a model file may name
#[derive(Args)]
#[command(
    after_help = "Examples:\n  creepage vehicles --format json\n  creepage vehicles --vehicles examples/bus/bus.toml"
)]
pub struct Vehicles {
    /// How to print them
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    own: OwnVehicles,
}

/// List the effects that can be named, with their equations
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage effects
  creepage effects --vehicle car
  creepage effects --effects examples/effects/my_effects.toml
  creepage effects --vehicles examples/bus/bus.toml --vehicle articulated-bus")]
pub struct Effects {
    /// Only those of one vehicle, with the equations they rewrite there and the effects that are the same
    #[arg(long, value_name = "NAME")]
    vehicle: Option<String>,
    /// How to print them
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    #[command(flatten)]
    own: Own,
}

#[derive(Clone, Copy, ValueEnum)]
pub(super) enum Format {
    Text,
    Json,
}

/// JSON for people.
pub fn pretty(value: &serde_json::Value) -> String {
    format!("{value:#}\n")
}

/// Carries out `creepage vehicles`.
pub fn vehicles(arguments: &Vehicles) -> Result<()> {
    let all = arguments.own.all()?;
    print(&match arguments.format {
        Format::Text => vehicles_text(&all)?,
        Format::Json => pretty(&vehicles_json(&all)?),
    })
}

/// Carries out `creepage effects`.
pub fn effects(arguments: &Effects) -> Result<()> {
    let (vehicles, library) = arguments.own.catalogues()?;
    if let Some(vehicle) = &arguments.vehicle {
        return print(&match arguments.format {
            Format::Text => vehicle_effects_text(vehicle, &vehicles, &library)?,
            Format::Json => pretty(&vehicle_effects_json(vehicle, &vehicles, &library)?),
        });
    }
    print(&match arguments.format {
        Format::Text => effects_text(&vehicles, &library)?,
        Format::Json => pretty(&effects_json(&vehicles, &library)?),
    })
}
