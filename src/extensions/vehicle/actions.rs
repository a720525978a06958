//! The check that the effects of the library mean on a user's vehicle what they say.

use crate::effects;
use crate::effects::Effect;
use crate::error::Result;
use crate::extensions::formula_growth;
use crate::extensions::test_vehicle::TestVehicle;
use crate::files::UserVehicle;
use crate::formula::{Expr, Symbol, Unit};
use crate::vehicles;
use crate::vehicles::Definition;

/// That letters of the catalogue mean what they mean there, and formulas stay small whatever effects do to them.
pub(crate) fn check(own: &UserVehicle, test_vehicles: &[TestVehicle]) -> Result<()> {
    for (symbol, definition) in &own.vehicle.define {
        let usual = of_catalogue(symbol).filter(|usual| is_spoken_of(symbol) && !alike(usual, definition));
        let Some(usual) = usual else { continue };
        let (meaning, is, found) = (&usual.meaning, &usual.unit, &definition.unit);
        let message = format!("the effects of the library take {symbol} for the {meaning}, in {is}, not in {found}");
        return Err(own.names[symbol].error(message).help("give the symbol another letter"));
    }
    match formula_growth::outgrown_of(effects::all(), test_vehicles) {
        None => Ok(()),
        Some((name, on)) => {
            let message = format!("with all effects together the formula of {name} grows beyond all bounds on {on}");
            let error = own.define.get(&name).map_or_else(|| own.id.error(&message), |f| f.error(&message));
            Err(error.help("use smaller powers and fewer symbols that stand for long formulas"))
        }
    }
}

fn of_catalogue(symbol: &Symbol) -> Option<&'static Definition> {
    vehicles::all().iter().find_map(|v| v.define.get(symbol))
}

/// Whether an effect of the library rewrites a symbol or has it in a formula.
fn is_spoken_of(symbol: &Symbol) -> bool {
    let own = std::slice::from_ref(symbol);
    let rewrites = |(key, f): (&String, &Expr)| Effect::of_change(key, f).targets(own, Some(1)).is_some();
    effects::all().iter().any(|e| e.changes.iter().any(rewrites) || e.formulas().any(|f| f.mentions(symbol)))
}

fn alike(a: &Definition, b: &Definition) -> bool {
    let unit = |d: &Definition| Unit::parse(&d.unit).unwrap_or(Unit::number_unit());
    unit(a).fits(&unit(b))
}
