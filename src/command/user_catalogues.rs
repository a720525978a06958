//! The options `--vehicles FILE.toml` and `--effects FILE.toml`: catalogues with a user's own vehicles and effects.

use clap::Args;
use creepage::effects::{self, Effect};
use creepage::files::ModelFile;
use creepage::vehicles::{self, Vehicle};
use creepage::{Model, Result, extensions};
use std::path::{Path, PathBuf};

/// The user's own vehicles, beside those of the catalogue.
#[derive(Args)]
pub struct UserVehicles {
    /// Vehicles of your own, as in examples/bus/bus.toml; a model file may name them by vehicles = "FILE.toml" too
    #[arg(long, value_name = "FILE.toml")]
    vehicles: Option<PathBuf>,
}

/// The user's own vehicles and effects, beside those of the catalogues.
#[derive(Args)]
pub struct UserCatalogues {
    #[command(flatten)]
    vehicles: UserVehicles,
    /// Effects of your own, as in examples/effects/my_effects.toml; they join the library
    #[arg(long, value_name = "FILE.toml")]
    effects: Option<PathBuf>,
}

impl UserVehicles {
    /// The file, if one is given.
    pub fn file(&self) -> Option<&Path> {
        self.vehicles.as_deref()
    }

    /// The catalogue with the user's own vehicles.
    pub fn all(&self) -> Result<Vec<Vehicle>> {
        match &self.vehicles {
            Some(path) => extensions::vehicles_with_own(path),
            None => Ok(vehicles::all().to_vec()),
        }
    }
}

impl UserCatalogues {
    /// The files of vehicles and of effects, if they are given.
    pub fn files(&self) -> [Option<&Path>; 2] {
        [self.vehicles.file(), self.effects.as_deref()]
    }

    /// The vehicles, and the library of effects.
    pub fn catalogues(&self) -> Result<(Vec<Vehicle>, Vec<Effect>)> {
        let vehicles = self.vehicles.all()?;
        let library = self.library(&vehicles)?;
        Ok((vehicles, library))
    }

    /// A model file and the library of effects; the vehicles that the model names join the catalogue.
    pub fn read(&self, path: &Path) -> Result<(ModelFile, Vec<Effect>)> {
        Ok(self.model(path)?.into_parts())
    }

    /// A model with the library of effects.
    pub fn model(&self, path: &Path) -> Result<Model> {
        Model::read_with(path, self.vehicles.file(), self.effects.as_deref())
    }

    fn library(&self, vehicles: &[Vehicle]) -> Result<Vec<Effect>> {
        match &self.effects {
            Some(path) => extensions::with_own_on(path, vehicles),
            None => Ok(effects::all().to_vec()),
        }
    }
}
