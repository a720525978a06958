//! The time derivative of a formula along the motion: Σ ∂f/∂q·q̇.

use crate::formula::{Expr, Symbol};
use std::collections::{BTreeMap, BTreeSet};

/// The rates of the symbols that move.
#[derive(Clone, Debug, Default)]
pub(super) struct TimeDerivative {
    rates: BTreeMap<Symbol, Expr>,
    given: BTreeSet<Symbol>,
    asked: BTreeSet<Symbol>,
}

impl TimeDerivative {
    /// Of these angles, and of those that the inputs give.
    pub fn of_angles(angles: impl Iterator<Item = Symbol>, given: impl Iterator<Item = Symbol>) -> Self {
        let rates = angles.map(|angle| (angle.clone(), Expr::sym(angle.rate()))).collect();
        Self { rates, given: given.collect(), asked: BTreeSet::new() }
    }

    /// A symbol with its rate.
    pub fn moves(&mut self, name: Symbol, rate: Expr) {
        self.rates.insert(name, rate);
    }

    /// d/dt of a formula.
    pub fn along_motion(&mut self, formula: &Expr) -> Expr {
        let mut sum = Expr::int(0);
        for name in formula.symbols() {
            let rate = match (self.rates.get(&name), self.given.contains(&name)) {
                (Some(rate), _) => rate.clone(),
                (None, true) => Expr::sym(name.rate()),
                (None, false) => continue,
            };
            let slope = formula.derivative(&name).tidy();
            if slope.is_zero() || rate.is_zero() {
                continue;
            }
            if self.given.contains(&name) {
                self.asked.insert(name);
            }
            sum = &sum + &(&slope * &rate);
        }
        sum
    }

    /// The angles given by inputs whose rate the motion asks for.
    pub fn asked(&self) -> Vec<Symbol> {
        self.asked.iter().cloned().collect()
    }
}
