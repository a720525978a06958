//! Rates as linear forms in the quasi-velocities, with the time derivatives of their coefficients: q̇ = B·ν, Ḃ.

use super::time_derivative::TimeDerivative;
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Definitions, Row};

/// The coefficient of a quasi-velocity in a rate, and its time derivative.
#[derive(Clone, Debug)]
pub(super) struct Coefficient {
    pub value: Expr,
    pub rate: Expr,
}

impl Coefficient {
    fn zero() -> Self {
        Self { value: Expr::int(0), rate: Expr::int(0) }
    }
}

/// Rates by the quasi-velocities, each from those before it: coefficients that are more than a number are definitions of
/// their own, so that a train of N trailers has as many formulas as N² and not as 2^N.
#[derive(Clone, Debug, Default)]
pub(super) struct RateForms {
    /// ν.
    pub speeds: Vec<Symbol>,
    /// What the forms are made of.
    pub definitions: Definitions,
    /// How the coefficients move.
    pub motion: TimeDerivative,
    forms: Vec<(Symbol, Vec<Coefficient>)>,
}

impl RateForms {
    /// No rates yet, in a motion.
    pub fn along(motion: TimeDerivative) -> Self {
        Self { motion, ..Self::default() }
    }

    /// A rate that the contacts leave free: a quasi-velocity by another name.
    pub fn set_free(&mut self, rate: Symbol, speed: Symbol) {
        let mut form = vec![Coefficient::zero(); self.speeds.len()];
        form.push(Coefficient { value: Expr::int(1), rate: Expr::int(0) });
        self.definitions.define(rate.clone(), Expr::sym(speed.clone()));
        self.speeds.push(speed);
        self.forms.push((rate, form));
    }

    /// A rate that follows from others.
    pub fn follow(&mut self, rate: Symbol, row: &Row) {
        let coefficients = self.of(row);
        let named = coefficients.into_iter().enumerate().map(|(j, c)| self.named(&rate, j, c)).collect();
        self.definitions.define(rate.clone(), row.expr());
        self.forms.push((rate, named));
    }

    /// A coefficient by a name of its own where it is more than a number.
    fn named(&mut self, rate: &Symbol, by: usize, c: Coefficient) -> Coefficient {
        if c.value.as_number().is_some() {
            return Coefficient { rate: Expr::int(0), ..c };
        }
        let stem = rate.as_str().trim_end_matches('\'');
        let name = Symbol::new(&format!("{stem}.by_{}", self.speeds[by]));
        self.definitions.define(name.clone(), c.value);
        let rate = match c.rate.is_zero() {
            true => Expr::int(0),
            false => {
                self.definitions.define(name.rate(), c.rate);
                Expr::sym(name.rate())
            }
        };
        self.motion.moves(name.clone(), rate.clone());
        Coefficient { value: Expr::sym(name), rate }
    }

    /// A linear form in the rates as one in the quasi-velocities; rates that inputs give are no part of it.
    pub fn of(&mut self, row: &Row) -> Vec<Coefficient> {
        let mut sum = vec![Coefficient::zero(); self.speeds.len()];
        for (rate, c) in row.terms() {
            let Some((_, form)) = self.forms.iter().find(|(r, _)| r == rate) else { continue };
            let moving = self.motion.along_motion(c);
            for (sum, k) in sum.iter_mut().zip(form) {
                sum.value = &sum.value + &times(c, &k.value);
                sum.rate = &sum.rate + &(&times(&moving, &k.value) + &times(c, &k.rate));
            }
        }
        sum
    }

    /// Σ ċ·ν of a form: what it accelerates by while the quasi-velocities stay.
    pub fn drift(&self, form: &[Coefficient]) -> Expr {
        sum(form.iter().zip(&self.speeds).map(|(c, nu)| times(&c.rate, &Expr::sym(nu.clone()))))
    }
}

/// A product; zero where a factor is, even if the other may be undefined somewhere.
pub(super) fn times(a: &Expr, b: &Expr) -> Expr {
    if a.is_zero() || b.is_zero() { Expr::int(0) } else { a * b }
}

/// A sum.
pub(super) fn sum(parts: impl Iterator<Item = Expr>) -> Expr {
    parts.fold(Expr::int(0), |sum, part| &sum + &part)
}
