//! The check of units in a user's formulas.

use super::applicability::Place;
use crate::error::{Error, Result};
use crate::files::{FormulaText, UserEffect, shown};
use crate::formula::{Expr, Scalar, Symbol, Unit};

/// That each formula has the unit of what it stands for.
pub(crate) fn check(own: &UserEffect, place: &Place) -> Result<()> {
    for target in &place.targets {
        let Some((_, formula)) = own.changes.get(&target.key) else { continue };
        let wanted = unit_of(own, place, &target.name, &target.name);
        expect(formula, &wanted, &|s| unit_of(own, place, s, &target.name), &target.name, place)?;
    }
    let per_second = unit("s").recip();
    for (name, rate) in &own.rates {
        let wanted = own.effect.states.get(name).map_or(Unit::number_unit(), |s| unit(&s.unit)).mul(&per_second);
        let symbol = Symbol::new(name);
        expect(rate, &wanted, &|s| unit_of(own, place, s, s), &symbol.rate(), place)?;
    }
    Ok(())
}

/// A unit that was checked when it was read.
fn unit(text: &str) -> Unit {
    Unit::parse(text).unwrap_or(Unit::number_unit())
}

/// The unit of a name in a formula for `target`.
fn unit_of(own: &UserEffect, place: &Place, s: &Symbol, target: &Symbol) -> Unit {
    let name = s.as_str();
    if let Some(p) = own.effect.parameters.get(name) {
        return unit(&p.unit);
    }
    if let Some(state) = own.effect.states.get(name) {
        return unit(&state.unit);
    }
    let s = if name == "it" { target } else { s };
    // Every name is known by now.
    place.vehicle.units.get(s).copied().unwrap_or(Unit::number_unit())
}

fn expect(
    formula: &FormulaText,
    wanted: &Unit,
    of: &impl Fn(&Symbol) -> Unit,
    name: &Symbol,
    place: &Place,
) -> Result<()> {
    let on = &place.vehicle.label;
    match formula.formula.eval(of) {
        None => Err(mixed(formula, of, &format!(" on {on}"))),
        Some(found) if found.fits(wanted) => Ok(()),
        Some(found) => Err(formula
            .error(format!("the formula for {name} is in {found}, but {name} is in {wanted} on {on}"))
            .help("correct the formula, or the unit of a parameter")),
    }
}

/// The error of a formula that has no unit: the smallest part that has none; `on` says where.
pub(crate) fn mixed(formula: &FormulaText, of: &impl Fn(&Symbol) -> Unit, on: &str) -> Error {
    formula.error(unlike(&formula.formula, of, on)).help("add only what has one unit; functions take and give numbers")
}

/// What of a formula has no unit, and what it is made of.
pub(crate) fn unlike(formula: &Expr, of: &impl Fn(&Symbol) -> Unit, on: &str) -> String {
    let mut part = formula;
    while let Some(inner) = part.children().into_iter().find(|c| c.eval(of).is_none()) {
        part = inner;
    }
    let unit = |e: &&Expr| e.eval(of).map_or_else(String::new, |u| format!("{} is in {u}", shown(&e.to_string())));
    let parts: Vec<String> = part.children().iter().map(unit).collect();
    format!("{} has no unit{on}: {}", shown(&part.to_string()), parts.join(", "))
}
