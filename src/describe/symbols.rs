//! Every symbol of a model with unit, meaning and value.

use super::forces::UnderForces;
use super::meaning;
use super::symbol_entry::{Kind, SymbolEntry};
use crate::effects::Applied;
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol, latex_symbol};
use crate::mechanism::Definitions;
use crate::model::Model;
use crate::vehicles::Wheel;
use std::collections::{BTreeMap, BTreeSet};

/// The symbols of a model.
#[derive(Clone, Debug, Default)]
pub struct Symbols {
    entries: Vec<SymbolEntry>,
    renamed: BTreeMap<Symbol, Symbol>,
}

impl Symbols {
    /// The entries of the names in use.
    ///
    /// # Errors
    /// When a name has no meaning in the model.
    pub fn of(model: &Model, definitions: &Definitions, used: &BTreeSet<Symbol>) -> Result<Self> {
        let values = values(model, definitions)?;
        let renamed = renamed(used);
        let mut entries: Vec<SymbolEntry> = Vec::new();
        let plain = |symbol: &Symbol| look_up(model, symbol);
        let forces = UnderForces::of(model, definitions, &plain)?;
        for symbol in used {
            let found = forces.as_ref().and_then(|f| f.meaning(symbol)).or_else(|| plain(symbol));
            let (kind, unit, meaning) = found.ok_or_else(|| Error::run(format!("the name {symbol} has no meaning")))?;
            let latex = latex_symbol(renamed.get(symbol).unwrap_or(symbol));
            // No value is a negative zero.
            let value = values.get(symbol).map(|v| v + 0.0);
            entries.push(SymbolEntry { symbol: symbol.clone(), latex, unit, meaning, kind, value });
        }
        let place = |s: &Symbol| model.coordinates().iter().position(|c| c == s || c.rate() == *s);
        entries.sort_by_key(|e| (e.kind, place(&e.symbol)));
        Ok(Self { entries, renamed })
    }

    /// The entries, by kind.
    pub fn entries(&self) -> &[SymbolEntry] {
        &self.entries
    }

    /// The entry of a symbol.
    pub fn get(&self, symbol: &Symbol) -> Option<&SymbolEntry> {
        self.entries.iter().find(|e| e.symbol == *symbol)
    }

    /// A formula in LaTeX, no two symbols alike.
    pub fn latex(&self, formula: &Expr) -> String {
        self.distinct(formula).latex()
    }

    /// A symbol in LaTeX.
    pub fn latex_symbol(&self, symbol: &Symbol) -> String {
        latex_symbol(self.renamed.get(symbol).unwrap_or(symbol))
    }

    /// The formula with names that LaTeX would print alike made different.
    pub(super) fn distinct(&self, formula: &Expr) -> Expr {
        formula.substitute(&|s| self.renamed.get(s).map(|r| Expr::sym(r.clone())))
    }
}

/// A name `effect.parameter` is printed as `parameter`, or with the effect as its index where that is not enough.
fn renamed(used: &BTreeSet<Symbol>) -> BTreeMap<Symbol, Symbol> {
    let alike = |s: &Symbol| used.iter().filter(|o| latex_symbol(o) == latex_symbol(s)).count() > 1;
    let dotted = used.iter().filter_map(|s| Some((s, s.as_str().rsplit_once('.')?)));
    let new = |(of, name): (&str, &str)| {
        let bare = name.trim_end_matches('\'');
        Symbol::new(&format!("{bare}_{}{}", of.replace('.', "_"), &name[bare.len()..]))
    };
    dotted.filter(|(s, _)| alike(s)).map(|(s, parts)| (s.clone(), new(parts))).collect()
}

/// The values the model fixes: parameters, and what is defined by them alone.
pub(super) fn values(model: &Model, definitions: &Definitions) -> Result<BTreeMap<Symbol, f64>> {
    let mut values = model.values();
    for (name, formula) in definitions.sorted()? {
        if let Some(v) = formula.eval(&|s| values.get(s).copied().unwrap_or(f64::NAN)) {
            values.insert(name.clone(), v);
        }
    }
    Ok(values)
}

fn look_up(model: &Model, symbol: &Symbol) -> Option<(Kind, String, String)> {
    let name = symbol.as_str();
    let vehicle = &model.vehicle;
    if let Some(c) = vehicle.coordinate(name) {
        return Some((Kind::Coordinate, c.unit.clone(), c.meaning.clone()));
    }
    let is_rate = model.coordinates().iter().any(|c| c.rate() == *symbol);
    if let Some(d) = vehicle.define.get(symbol) {
        let kind = if is_rate { Kind::Rate } else { Kind::Defined };
        return Some((kind, d.unit.clone(), d.meaning.clone()));
    }
    if let Some(p) = vehicle.parameters.get(name) {
        return Some((Kind::Parameter, p.unit.clone(), p.meaning.clone()));
    }
    if let Some(i) = vehicle.inputs.get(name) {
        return Some((Kind::Input, i.unit.clone(), i.meaning.clone()));
    }
    let mut replacements = vehicle.inputs.values().filter_map(|i| i.instead.as_ref().map(|r| (i, r)));
    if let Some((input, r)) = replacements.find(|(_, r)| r.role == name) {
        return Some((Kind::Input, r.unit.clone(), format!("logged in place of the {}", input.meaning)));
    }
    wheel(model, symbol)
        .or_else(|| of_constraint(model, symbol))
        .or_else(|| model.effects.iter().find_map(|e| of_effect(e, symbol)))
        .or_else(|| meaning::of(name, model.trailer_count()))
        .or_else(|| measured(model, symbol))
}

/// A quantity that is measured beside the pose, or the rate of another name that one asks for.
fn measured(model: &Model, symbol: &Symbol) -> Option<(Kind, String, String)> {
    if let Some(quantity) = model.measured.iter().find(|m| m.symbol() == *symbol) {
        return Some((Kind::Measured, quantity.unit.clone(), format!("measured {}", quantity.name)));
    }
    let (_, unit, meaning) = look_up(model, &Symbol::new(symbol.as_str().strip_suffix('\'')?))?;
    Some((Kind::Rate, meaning::unit_of_rate(&unit), format!("rate of the {meaning}")))
}

/// A name of a wheel: a coefficient of its creep, its angles and their rates where nothing defines them.
fn wheel(model: &Model, symbol: &Symbol) -> Option<(Kind, String, String)> {
    let is = |s: &Option<Symbol>| s.as_ref() == Some(symbol);
    type Test<'t> = &'t dyn Fn(&Wheel) -> bool;
    let table: [(Test, Kind, &str, &str); 6] = [
        (&|w| is(&w.rotation_creep), Kind::Creep, "1", "rotation creep of the"),
        (&|w| is(&w.traverse_creep), Kind::Creep, "1", "traverse creep of the"),
        (&|w| w.rate == Some(symbol.rate()), Kind::Coordinate, "rad", "angle turned by the"),
        (&|w| is(&w.rate), Kind::Rate, "rad/s", "rate of the"),
        (&|w| is(&w.steering), Kind::Coordinate, "rad", "angle from the body's heading to that of the"),
        (
            &|w| w.steering.as_ref().map(Symbol::rate).as_ref() == Some(symbol),
            Kind::Rate,
            "rad/s",
            "rate of the angle from the body's heading to that of the",
        ),
    ];
    table.into_iter().find_map(|(test, kind, unit, means)| {
        let names: Vec<&str> = model.vehicle.all_wheels().filter(|w| test(w)).map(|w| w.name.as_str()).collect();
        (!names.is_empty()).then(|| (kind, unit.into(), format!("{means} {}", names.join(", "))))
    })
}

/// A coefficient of a constraint that is no wheel's, or the rate of a coordinate of the vehicle's own.
fn of_constraint(model: &Model, symbol: &Symbol) -> Option<(Kind, String, String)> {
    let vehicle = &model.vehicle;
    let creeps = vehicle.constraints.iter().find(|c| c.creep == *symbol);
    let creep = creeps.map(|c| (Kind::Creep, "1".to_string(), format!("{} of the {}", c.kind().creep, c.name)));
    creep.or_else(|| {
        let coordinate = vehicle.coordinate(symbol.as_str().strip_suffix('\'')?)?;
        Some((Kind::Rate, format!("{}/s", coordinate.unit), format!("rate of the {}", coordinate.meaning)))
    })
}

/// A parameter or a state of an effect.
fn of_effect(e: &Applied, symbol: &Symbol) -> Option<(Kind, String, String)> {
    let means = |what: &str| format!("{what} of {}: {}", e.label(), e.effect.says);
    let parameter = e.effect.parameters.iter().find(|(name, _)| e.symbol(name) == *symbol);
    if let Some((_, p)) = parameter {
        return Some((Kind::EffectParameter, p.unit.clone(), means("parameter")));
    }
    let state = e.effect.states.iter().find(|(name, _)| e.symbol(name) == *symbol);
    state.map(|(_, s)| (Kind::State, s.unit.clone(), means("state")))
}
