//! `--effects FILE.toml`

use clap::Args;
use creepage::effects::{self, Effect};
use creepage::{Result, library};
use std::path::PathBuf;

/// The user's own effects, beside those of the library.
#[derive(Args)]
pub struct OwnEffects {
    /// Effects of your own, as in examples/effects/my_effects.toml; they join the library
    #[arg(long, value_name = "FILE.toml")]
    effects: Option<PathBuf>,
}

impl OwnEffects {
    /// The library with the user's own effects.
    pub fn library(&self) -> Result<Vec<Effect>> {
        match &self.effects {
            Some(path) => library::with_own(path),
            None => Ok(effects::all().to_vec()),
        }
    }
}
