//! The check that wheels and hitches of a user's vehicle keep their places on the body.

use crate::error::Result;
use crate::files::{FormulaText, UserVehicle};
use crate::formula::Symbol;
use std::collections::BTreeSet;

/// That no length depends on an input: a place that moves on the body would have a velocity there.
pub(crate) fn check(own: &UserVehicle) -> Result<()> {
    own.parts().flat_map(|p| p.lengths.values()).try_for_each(|f| constant(own, f))
}

fn constant(own: &UserVehicle, f: &FormulaText) -> Result<()> {
    let mut seen = BTreeSet::new();
    for part in f.formula.symbols() {
        let mut waiting = vec![part.clone()];
        while let Some(s) = waiting.pop() {
            if own.vehicle.inputs.contains_key(s.as_str()) {
                let error = f.error_at(&part, format!("a place on the body would move with the input {s}"));
                return Err(error.help("use parameters only, by themselves or through defined symbols"));
            }
            let parts = own.vehicle.define.get(&s).map(|d| d.formula.symbols()).unwrap_or_default();
            waiting.extend(parts.into_iter().filter(|s: &Symbol| seen.insert(s.clone())));
        }
    }
    Ok(())
}
