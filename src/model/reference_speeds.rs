//! The speeds that the inputs ask for without any effect: what the regime of driving is told by.

use super::vehicle_model::Model;
use crate::error::Result;
use crate::formula::{Expr, Size, Symbol};
use crate::mechanism::Definitions;
use std::collections::BTreeMap;

/// The forward speed that the inputs ask for, its rate, and the yaw rate that they ask for.
pub(crate) const REFERENCE: [&str; 3] = ["v_0", "v_0'", "w_0"];

/// The most operations of a formula that is written out.
const MAX_OPERATIONS: usize = 5000;

impl Model {
    /// The forward speed that the inputs ask for without any effect, its rate, and the yaw rate, by inputs, their rates
    /// and parameters.
    pub(crate) fn reference_speeds(&self) -> Result<[Expr; 3]> {
        let bare = Model { effects: vec![], ..self.clone() };
        let mut d = bare.definitions()?;
        bare.define_reference_speeds(&mut d)?;
        Ok(REFERENCE.map(|name| d.get(&name.into()).cloned().unwrap_or_default()))
    }

    /// Defines the reference speeds from definitions without effects: formulas of inputs and parameters alone, so that no
    /// gate can close a circle with what it opens.
    ///
    /// | name | formula |
    /// |---|---|
    /// | v_0 | v_d, or v_l where the wheels ask for no speed, written out |
    /// | v_0' | Σ ∂v_0/∂u·u' over the inputs u |
    /// | w_0 | phi' written out |
    pub(super) fn define_reference_speeds(&self, d: &mut Definitions) -> Result<()> {
        let written = written_out(d)?;
        let of = |names: &[&str]| {
            let found = names.iter().find_map(|name| written.get(&Symbol::from(*name)));
            found.map_or_else(Expr::default, |(formula, _)| formula.clone())
        };
        let (speed, yaw) = (of(&["v_d", "v_l"]), of(&["phi'"]));
        let inputs = self.inputs.iter().map(|i| Symbol::new(i)).filter(|i| speed.mentions(i));
        let rate = inputs.map(|i| &speed.derivative(&i) * &Expr::sym(i.rate()));
        let rate = rate.fold(Expr::default(), |sum, term| &sum + &term);
        for (name, formula) in REFERENCE.into_iter().zip([speed, rate, yaw]) {
            d.define(name, formula);
        }
        Ok(())
    }
}

/// Every definition that is short enough with all others put into it, and how long it is.
fn written_out(d: &Definitions) -> Result<BTreeMap<Symbol, (Expr, Size)>> {
    let mut written: BTreeMap<Symbol, (Expr, Size)> = BTreeMap::new();
    for (name, formula) in d.sorted()? {
        let hangs = |s: &Symbol| d.get(s).is_some() && !written.contains_key(s);
        if formula.symbols().iter().any(hangs) {
            continue;
        }
        let size = Size::of(formula, &|s| written.get(s).map_or(Size::SYMBOL, |(_, size)| *size));
        if size.nodes <= MAX_OPERATIONS {
            let out = formula.substitute(&|s| written.get(s).map(|(formula, _)| formula.clone()));
            written.insert(name.clone(), (out, size));
        }
    }
    Ok(written)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reference_speeds_are_of_inputs_and_parameters_alone() {
        let shown = |vehicle: &str, parameters: &[(&str, f64)]| {
            let model = Model::new(vehicle, parameters).unwrap();
            let mut d = model.definitions().unwrap();
            model.define_reference_speeds(&mut d).unwrap();
            REFERENCE.map(|name| d.get(&name.into()).unwrap().to_string())
        };
        let car = shown("car", &[("wheel_radius", 0.3), ("wheelbase", 2.5)]);
        assert_eq!(car[..2], ["wheel_radius*wheel_rate", "wheel_radius*wheel_rate'"]);
        assert!(car[2].contains("sin(steering_angle)") && !car[2].contains("v_"), "{}", car[2]);
        let drive = shown("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.5)]);
        assert!(drive[1].contains("wheel_rate_left'") && drive[1].contains("wheel_rate_right'"), "{}", drive[1]);
    }
}
