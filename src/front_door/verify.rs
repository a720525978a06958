//! The jobs that need no run: the claims of the paper, and sweeps.

use super::options::Options;
use crate::claims::{self, Claim, Ledger};
use crate::error::{Error, Result};
use crate::files::advice;
use crate::sweep::{Shard, Summary, Sweep};
use std::path::Path;

/// Runs the claims of the paper that have these ids, all where none is named, and says which status each earns.
///
/// Of the options `seed` and `progress` count; [`claims::verify`] takes claims and numbers of cases of one's own.
///
/// ```
/// let ledger = creepage::verify(&["eq-21"], &creepage::Options::default())?;
/// assert!(ledger.all_earned());
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// When no claim has an id, or the listener stops the work.
pub fn verify(ids: &[&str], options: &Options) -> Result<Ledger> {
    let all = claims::all();
    let known: Vec<&str> = all.iter().map(|c| c.id.as_str()).collect();
    if let Some(stranger) = ids.iter().find(|id| !known.contains(id)) {
        return Err(Error::input(format!("no claim is called {stranger:?}")).help(advice(stranger, "claims", &known)));
    }
    let wanted: Vec<Claim> = all.iter().filter(|c| ids.is_empty() || ids.contains(&c.id.as_str())).cloned().collect();
    let how = claims::Options { seed: options.seed, ..claims::Options::default() };
    claims::verify(&wanted, &how, options.progress)
}

/// Simulates all cases of a sweep's file and writes their table; goes on where an earlier run of it was stopped.
///
/// Of the options `progress` counts.
///
/// ```
/// let table = std::env::temp_dir().join(format!("creepage-sweep-{}.csv", std::process::id()));
/// let written = creepage::sweep("examples/sweeps/wheels.toml", &table, &creepage::Options::default())?;
/// assert_eq!(written.undefined, 0);
/// # std::fs::remove_file(table).unwrap();
/// # Ok::<(), creepage::Error>(())
/// ```
///
/// # Errors
/// With file, line and column, where a file of the sweep is not as it should be; when the table cannot be written, or the
/// listener stops the work.
pub fn sweep(spec: impl AsRef<Path>, out: impl AsRef<Path>, options: &Options) -> Result<Summary> {
    Sweep::read(spec)?.write(Shard::WHOLE, out.as_ref(), options.progress)
}
