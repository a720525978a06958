//! Measured quantities among the definitions of a model: their formulas, and the rates that these ask for.

use super::build::TIME;
use super::measured::MeasuredQuantity;
use super::vehicle_model::Model;
use crate::error::{Error, Result};
use crate::files::{ModelFile, advice};
use crate::formula::Symbol;
use crate::mechanism::Definitions;
use std::collections::BTreeSet;

impl Model {
    /// That the formulas of the measured quantities are of this model.
    ///
    /// # Errors
    /// At the entry of the file whose formula uses a name that nothing defines.
    pub(super) fn check_measured(&self, file: &ModelFile) -> Result<()> {
        if self.measured.is_empty() {
            return Ok(());
        }
        let Ok(d) = self.definitions() else { return Ok(()) };
        let (values, states) = (self.values(), self.states());
        let rate_of_input = |s: &Symbol| self.inputs.iter().any(|i| Symbol::new(i).rate() == *s);
        let is_known = |s: &Symbol| {
            let stands = d.get(s).is_some() || values.contains_key(s) || states.contains(s) || rate_of_input(s);
            stands || s.as_str() == TIME || self.inputs.iter().any(|i| i == s.as_str())
        };
        for (measured, entry) in self.measured.iter().zip(&file.measured) {
            let Some(name) = measured.formula.symbols().into_iter().find(|s| !is_known(s)) else { continue };
            let message = format!("the formula of {} uses {name}, which nothing in this model is", measured.name);
            let all: Vec<&str> = d.iter().map(|(name, _)| name.as_str()).filter(|n| !n.contains('.')).collect();
            let (line, column) = entry.place;
            let help = advice(name.as_str(), "it may use", &all);
            return Err(Error::input(message).at_file(&file.path).at(line, column).help(help));
        }
        Ok(())
    }

    /// The measured quantities among the definitions.
    pub(super) fn define_measured(&self, d: &mut Definitions) {
        self.measured.iter().for_each(|m| d.define(m.symbol(), m.formula.clone()));
    }

    /// A measured quantity by its name.
    pub fn measured_quantity(&self, name: &str) -> Option<&MeasuredQuantity> {
        self.measured.iter().find(|m| m.name == name)
    }

    /// Defines the rates that measured quantities ask for and nothing defines, such as `v_l'`.
    pub(super) fn define_measured_rates(&self, d: &mut Definitions) {
        let formulas = self.measured.iter().filter_map(|m| d.get(&m.symbol()).cloned());
        let asked: BTreeSet<Symbol> = formulas.flat_map(|f| f.symbols()).collect();
        for stem in asked.iter().filter_map(|s| s.as_str().strip_suffix('\'')).map(Symbol::new) {
            self.rate_along_motion(&stem, d);
        }
    }
}
