//! The request of a discovery: model, runs, effects and options.

use crate::effects::Effect;
use crate::error::{Error, Result};
use crate::files::{ModelFile, Run};

/// What `discover` works on.
pub struct Request<'a> {
    /// The model as its user believes it.
    pub file: &'a ModelFile,
    /// Runs to fit.
    pub runs: &'a [Run],
    /// Runs that are only judged.
    pub held_out: &'a [Run],
    /// The effects that may be named.
    pub library: &'a [Effect],
    /// Horizons of the gap, s; the usual ones when empty.
    pub horizons: &'a [f64],
    /// Seed of the noise floor's random numbers.
    pub seed: u64,
}

/// The input roles that all runs log.
pub(crate) fn common_roles(runs: &[Run], held_out: &[Run]) -> Result<Vec<String>> {
    let mut all = runs.iter().chain(held_out);
    let first = all.next().ok_or_else(|| Error::input("no run was given").help("name at least one CSV file"))?;
    for run in all {
        if run.roles != first.roles {
            let message = format!("logs {} where {} logs {}", run.roles.join(", "), first.name, first.roles.join(", "));
            return Err(Error::input(message).at_file(&run.path).help("give runs of one kind in one call"));
        }
        if run.heading.is_some() != first.heading.is_some() {
            let message = format!(
                "{} measures a heading, the other does not",
                if run.heading.is_some() { &run.name } else { &first.name }
            );
            return Err(Error::input(message).at_file(&run.path).help("give runs of one kind in one call"));
        }
    }
    Ok(first.roles.clone())
}

pub(crate) fn horizons(request: &Request) -> Vec<f64> {
    let mut h = if request.horizons.is_empty() { vec![1.0, 5.0, 30.0] } else { request.horizons.to_vec() };
    h.sort_by(f64::total_cmp);
    h.dedup();
    h
}
