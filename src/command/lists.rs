//! `creepage vehicles` and `creepage effects`

use super::output::{Format, pretty, print};
use super::user_catalogues::{UserCatalogues, UserVehicles};
use clap::{Args, ValueEnum};
use creepage::describe::{
    effects_json, effects_text, every_effect_page, vehicle_effects_json, vehicle_effects_text, vehicles_json,
    vehicles_text,
};
use creepage::{Error, Result};

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
    own: UserVehicles,
}

/// List the effects that can be named, with their equations
#[derive(Args)]
#[command(after_help = "\
Examples:
  creepage effects
  creepage effects track-width input-delay
  creepage effects --vehicle car
  creepage effects --format page
  creepage effects --effects examples/effects/my_effects.toml
  creepage effects --vehicles examples/bus/bus.toml --vehicle articulated-bus")]
pub struct Effects {
    /// Only these, by id; all when none is named
    #[arg(value_name = "ID")]
    only: Vec<String>,
    /// Only those of one vehicle, with the equations they rewrite there and the effects that are the same
    #[arg(long, value_name = "NAME")]
    vehicle: Option<String>,
    /// How to print them
    #[arg(long, value_enum, default_value_t = EffectsFormat::Text)]
    format: EffectsFormat,
    #[command(flatten)]
    own: UserCatalogues,
}

#[derive(Clone, Copy, ValueEnum)]
enum EffectsFormat {
    Text,
    Json,
    /// A Markdown page: tables of the equations that every effect rewrites on every vehicle
    Page,
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
    let (vehicles, mut library) = arguments.own.catalogues()?;
    if let Some(unknown) = arguments.only.iter().find(|id| library.iter().all(|e| e.id != **id)) {
        return Err(Error::input(format!("no effect is called {unknown:?}")).help("`creepage effects` lists them"));
    }
    library.retain(|e| arguments.only.is_empty() || arguments.only.contains(&e.id));
    let one = arguments.vehicle.as_deref();
    print(&match (arguments.format, one) {
        (EffectsFormat::Page, one) => every_effect_page(one, &vehicles, &library)?,
        (EffectsFormat::Text, Some(vehicle)) => vehicle_effects_text(vehicle, &vehicles, &library)?,
        (EffectsFormat::Json, Some(vehicle)) => pretty(&vehicle_effects_json(vehicle, &vehicles, &library)?),
        (EffectsFormat::Text, None) => effects_text(&vehicles, &library)?,
        (EffectsFormat::Json, None) => pretty(&effects_json(&vehicles, &library)?),
    })
}
