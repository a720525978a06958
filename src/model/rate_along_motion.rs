//! The rate of any symbol of a model along its motion, by the chain rule.

use super::build::TIME;
use super::vehicle_model::Model;
use crate::formula::{Expr, Symbol};
use crate::mechanism::Definitions;

impl Model {
    /// The rate of a symbol along the motion, zero where nothing moves it: f' = Σ ∂f/∂s·s' over states, inputs and what is
    /// defined by them, effects on the way included. The rates on the way become definitions.
    pub(super) fn rate_along_motion(&self, name: &Symbol, d: &mut Definitions) -> Expr {
        let rate = name.rate();
        if d.get(&rate).is_some() || self.inputs.iter().any(|role| role == name.as_str()) {
            return Expr::sym(rate);
        }
        if name.as_str() == TIME {
            return Expr::int(1);
        }
        if let Some((_, rate)) = self.effects.iter().flat_map(|e| e.states()).find(|(state, _)| state == name) {
            return rate;
        }
        let Some(formula) = d.get(name).cloned() else { return Expr::int(0) };
        let mut sum = Expr::int(0);
        for s in formula.symbols() {
            let slope = formula.derivative(&s).tidy();
            let moves = if slope.is_zero() { Expr::int(0) } else { self.rate_along_motion(&s, d) };
            if !moves.is_zero() {
                sum = &sum + &(&slope * &moves);
            }
        }
        if sum.is_zero() {
            return sum;
        }
        d.define(rate.clone(), sum);
        Expr::sym(rate)
    }
}
