//! Formulas as the body of a function: values read from arrays, definitions on the way, results, and derivatives by the chain
//! rule.

use super::language::{Language, identifier};
use crate::formula::{Expr, Symbol};
use std::collections::BTreeSet;

/// Formulas with what they rest on.
#[derive(Clone, Debug)]
pub(super) struct Function {
    /// Definitions in an order in which each uses earlier ones.
    definitions: Vec<(Symbol, Expr)>,
    /// The results.
    formulas: Vec<Expr>,
    /// The names that stand in definitions and results.
    used: BTreeSet<Symbol>,
}

impl Function {
    /// Formulas with those of some definitions, in their order, that they rest on.
    pub fn of(formulas: Vec<Expr>, sorted: &[(Symbol, Expr)]) -> Self {
        let definitions = needed(&formulas, sorted.to_vec());
        let used = formulas.iter().chain(definitions.iter().map(|(_, f)| f)).flat_map(Expr::symbols).collect();
        Self { definitions, formulas, used }
    }

    /// Names from the places of an array, where they are used.
    pub fn read(&self, language: Language, array: &str, names: &[Symbol]) -> String {
        let line = |(i, name): (usize, &Symbol)| language.constant(name, &format!("{array}[{i}]"));
        names.iter().enumerate().filter(|(_, name)| self.used.contains(*name)).map(line).collect()
    }

    /// Values of names, where they are used.
    pub fn constants(&self, language: Language, values: &[(Symbol, f64)]) -> String {
        let used = values.iter().filter(|(name, _)| self.used.contains(name));
        used.map(|(name, v)| language.constant(name, &format!("{v:?}"))).collect()
    }

    /// The definitions.
    pub fn values(&self, language: Language) -> String {
        self.definitions.iter().map(|(n, f)| language.constant(n, &language.expression(f))).collect()
    }

    /// The results, into the places of an array.
    pub fn results(&self, language: Language, array: &str) -> String {
        let end = language.end();
        let result = |(i, f): (usize, &Expr)| format!("    {array}[{i}] = {}{end}\n", language.expression(f));
        self.formulas.iter().enumerate().map(result).collect()
    }

    /// Derivatives of definitions and results by some variables, by the chain rule, into `by`; those that are zero, or that no
    /// result hangs on, are left out.
    pub fn slopes(&self, language: Language, variables: &[&Symbol]) -> String {
        let mut known: BTreeSet<Symbol> = BTreeSet::new();
        let mut of_definitions: Vec<(Symbol, Expr)> = Vec::new();
        for (name, formula) in &self.definitions {
            for (j, variable) in variables.iter().enumerate() {
                let slope = chained(formula, variable, j, &known);
                if !slope.is_zero() {
                    let name = slope_name(name, j);
                    known.insert(name.clone());
                    of_definitions.push((name, slope));
                }
            }
        }
        let places = (0..self.formulas.len()).flat_map(|i| (0..variables.len()).map(move |j| (i, j)));
        let of_results: Vec<((usize, usize), Expr)> =
            places.map(|(i, j)| ((i, j), chained(&self.formulas[i], variables[j], j, &known))).collect();
        let formulas: Vec<Expr> = of_results.iter().map(|(_, slope)| slope.clone()).collect();
        let mut text = String::new();
        for (name, slope) in needed(&formulas, of_definitions) {
            text += &language.constant(&name, &language.expression(&slope));
        }
        for ((i, j), slope) in of_results.iter().filter(|(_, slope)| !slope.is_zero()) {
            text += &format!("    by[{i}][{j}] = {}{}\n", language.expression(slope), language.end());
        }
        text
    }
}

/// The name of the derivative of a definition by the j-th variable.
fn slope_name(name: &Symbol, j: usize) -> Symbol {
    Symbol::new(&format!("d_{}_{j}", identifier(name).trim_end_matches('_')))
}

/// The derivative of a formula by the j-th variable, where derivatives of definitions have names.
fn chained(formula: &Expr, variable: &Symbol, j: usize, known: &BTreeSet<Symbol>) -> Expr {
    formula.symbols().into_iter().fold(Expr::int(0), |sum, s| {
        let inner = slope_name(&s, j);
        let term = match (s == *variable, known.contains(&inner)) {
            (true, _) => formula.derivative(&s),
            (false, true) => &formula.derivative(&s) * &Expr::sym(inner),
            (false, false) => return sum,
        };
        if term.is_zero() { sum } else { &sum + &term }
    })
}

/// The definitions that formulas use, directly or through others, in their order.
fn needed(formulas: &[Expr], sorted: Vec<(Symbol, Expr)>) -> Vec<(Symbol, Expr)> {
    let mut wanted: BTreeSet<Symbol> = formulas.iter().flat_map(Expr::symbols).collect();
    for (name, formula) in sorted.iter().rev() {
        if wanted.contains(name) {
            wanted.extend(formula.symbols());
        }
    }
    sorted.into_iter().filter(|(name, _)| wanted.contains(name)).collect()
}
