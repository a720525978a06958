//! The growth of formulas when every effect is put into them: a bound on operations, depth and degree.

use super::test_vehicle::TestVehicle;
use crate::effects::Effect;
use crate::error::Result;
use crate::files::UserEffect;
use crate::formula::{Size, Symbol};
use std::collections::BTreeMap;

/// The most operations and nesting of a definition, and the most factors once all are put into one another.
const MAX_SIZE: Size = Size { nodes: 5000, depth: 300, degree: 1000 };

/// That the definitions stay small with all effects of a library, the last of which is the user's.
pub(crate) fn check(own: &UserEffect, library: &[Effect], test_vehicles: &[TestVehicle]) -> Result<()> {
    if let Some((name, on)) = outgrown_of(library, test_vehicles) {
        let touches =
            |key: &str| key.trim_end_matches('*').starts_with(name.as_str()) || name.as_str().starts_with(key);
        let at = own.changes.iter().find(|(key, _)| touches(key)).or(own.changes.iter().next());
        let message = format!("with all effects together the formula of {name} grows beyond all bounds on {on}");
        let error = at.map_or_else(|| own.id.error(message.clone()), |(_, (_, f))| f.error(message.clone()));
        return Err(error.help("write `it` once in a formula, use smaller powers, or put fewer effects on one name"));
    }
    Ok(())
}

/// A definition that is too large with the effects, and the vehicle it is too large on.
pub(crate) fn outgrown_of<'m>(library: &[Effect], test_vehicles: &'m [TestVehicle]) -> Option<(Symbol, &'m str)> {
    test_vehicles.iter().find_map(|m| Some((outgrown(library, m)?, m.label.as_str())))
}

/// A definition that is too large with the effects, if there is one.
fn outgrown(library: &[Effect], test_vehicle: &TestVehicle) -> Option<Symbol> {
    let names = test_vehicle.defined();
    let mut sizes: BTreeMap<Symbol, Size> =
        test_vehicle.definitions.iter().map(|(n, f)| (n.clone(), Size::of(f, &|_| Size::SYMBOL))).collect();
    let mut parts = test_vehicle.definitions.clone();
    let mut degrees: BTreeMap<Symbol, usize> = BTreeMap::new();
    // What is not sought stands in the place of another, not beside it.
    for e in library.iter().filter(|e| !e.unsought) {
        let trailers = e.trailers(test_vehicle.model.trailer_count());
        for (name, formula) in trailers.into_iter().filter_map(|t| test_vehicle.model.targets(e, t, &names)).flatten() {
            let old = *sizes.get(&name).unwrap_or(&Size::SYMBOL);
            let is_old = |s: &Symbol| s.as_str() == "it" || *s == name;
            let new = Size::of(&formula, &|s| if is_old(s) { old } else { Size::SYMBOL });
            if new.nodes > MAX_SIZE.nodes || new.depth > MAX_SIZE.depth {
                return Some(name);
            }
            sizes.insert(name.clone(), new);
            parts.rewrite(&name, &formula.substitute(&|s| is_old(s).then(|| crate::formula::Expr::sym(name.clone()))));
        }
    }
    // The solution of equations of motion multiplies masses with one another, step by step, whatever an effect writes.
    if test_vehicle.model.forced.is_some() {
        return None;
    }
    // With circles among them no order is right; the effects of a circle never stand in one model.
    for (name, formula) in parts.sorted().unwrap_or_default() {
        let inner = |s: &Symbol| Size { degree: degrees.get(s).copied().unwrap_or(1), ..Size::SYMBOL };
        let degree = Size::of(formula, &inner).degree;
        if degree > MAX_SIZE.degree {
            return Some(name.clone());
        }
        degrees.insert(name.clone(), degree);
    }
    None
}
