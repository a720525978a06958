//! The constraints of a vehicle solved once, kept for every copy of a model that differs in other things.

use crate::error::Result;
use crate::mechanism::Definitions;
use crate::vehicles::Vehicle;
use std::sync::{Arc, Mutex, PoisonError};

/// The constraints of a vehicle solved once, for all models that differ in their effects, values and sensor alone.
#[derive(Clone, Debug, Default)]
pub struct Solution(Arc<Mutex<Known>>);

type Known = Option<Box<(Key, Definitions)>>;

/// What a solution depends on.
#[derive(Debug)]
struct Key {
    vehicle: Vehicle,
    trailers: usize,
    inputs: Vec<String>,
}

impl Key {
    fn is(&self, vehicle: &Vehicle, trailers: usize, inputs: &[String]) -> bool {
        self.trailers == trailers && self.inputs == inputs && self.vehicle == *vehicle
    }
}

impl Solution {
    /// The definitions of a vehicle with so many trailers behind it, logged by these inputs: those that are kept, or those
    /// that `solve` finds, which are kept from then on.
    ///
    /// # Errors
    /// As `solve`.
    pub(super) fn or_solve(
        &self,
        vehicle: &Vehicle,
        trailers: usize,
        inputs: &[String],
        solve: impl FnOnce() -> Result<Definitions>,
    ) -> Result<Definitions> {
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((key, known)) = kept.as_deref()
            && key.is(vehicle, trailers, inputs)
        {
            return Ok(known.clone());
        }
        let solved = solve()?;
        let key = Key { vehicle: vehicle.clone(), trailers, inputs: inputs.to_vec() };
        *kept = Some(Box::new((key, solved.clone())));
        Ok(solved)
    }
}
