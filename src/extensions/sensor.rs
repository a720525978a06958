//! The check that a user's effect lets the sensor see the pose alone, and keeps the delay constant.

use super::applicability::Place;
use super::test_vehicle::reached;
use crate::error::Result;
use crate::files::UserEffect;
use crate::formula::Symbol;
use std::collections::BTreeSet;

/// That the sensor sees no more than the pose, and that the delay is constant: they are evaluated without inputs.
pub(crate) fn check(own: &UserEffect, place: &Place) -> Result<()> {
    let model = place.vehicle.model.clone().with_effect(place.applied.clone());
    let definitions = model.row_definitions()?;
    let mut moving: BTreeSet<Symbol> = model.inputs.iter().map(|i| Symbol::new(i)).collect();
    moving.extend(place.applied.states().into_iter().map(|(s, _)| s));
    let pose: Vec<Symbol> = place.vehicle.model.states();
    let still: BTreeSet<Symbol> = moving.iter().cloned().chain(pose).collect();
    let sensor = ["x_m", "y_m", "heading_m"].map(Symbol::from);
    let table = [
        (&sensor[..], &moving, "what the sensor measures", "the pose and parameters"),
        (&["delay".into()][..], &still, "the delay of the inputs", "parameters"),
    ];
    for (from, barred, what, may) in table {
        let seen = reached(&definitions, from);
        let Some(culprit) = barred.iter().find(|s| seen.contains(s)) else { continue };
        let at = place.targets.iter().find(|t| seen.contains(&t.name)).and_then(|t| own.changes.get(&t.key));
        let message = format!("{what} would depend on {culprit} on {}", place.vehicle.label);
        let error = at.map_or_else(|| own.id.error(message.clone()), |(_, formula)| formula.error(message.clone()));
        return Err(error.help(format!("it may depend on {may} only")));
    }
    Ok(())
}
