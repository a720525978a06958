//! A model as code without dependencies: rates with their exact derivatives, and a step with its Jacobian.

use super::corrections::{Corrections, origin, written};
use super::exported::Exported;
use super::language::{Language, identifier};
use crate::effects::{Effect, Scope};
use crate::error::{Error, Result};
use crate::files::ModelFile;
use crate::formula::{Expr, Symbol};
use crate::model::Model;
use std::collections::{BTreeMap, BTreeSet};

/// A model as code.
///
/// z′ = f(z, u) is written out definition by definition, each with its derivatives by (z, u) by the chain rule; a step is the
/// classical Runge–Kutta scheme of order four with inputs that are held, W′ = f_z·W + [0 | f_u] beside it.
#[derive(Clone, Debug)]
pub struct Code {
    states: Vec<Symbol>,
    inputs: Vec<Symbol>,
    /// Values that the model fixes.
    constants: Vec<(Symbol, f64)>,
    /// Definitions in an order in which each uses earlier ones.
    definitions: Vec<(Symbol, Expr)>,
    /// A formula for each state.
    rates: Vec<Expr>,
    /// The names that stand in definitions and rates.
    used: BTreeSet<Symbol>,
    unsaid: Vec<String>,
    covariance: (Vec<String>, Vec<Vec<f64>>),
    head: Vec<String>,
}

impl Code {
    /// The code of a model file with the effects of a library.
    ///
    /// # Errors
    /// As [`Code::of`], and when the file's model cannot be built.
    pub fn of_file(file: &ModelFile, library: &[Effect]) -> Result<Self> {
        Model::check_motion(file)?;
        Self::of(&Model::of_file(file, library)?, file).map_err(|e| e.at_file(&file.path))
    }

    /// The code of a model that stands in a file; effects of a time of the log, and delays, are left out and told.
    ///
    /// # Errors
    /// When the constraints do not determine the motion.
    pub fn of(model: &Model, file: &ModelFile) -> Result<Self> {
        let says_time = |scope: &Option<Scope>| matches!(scope, Some(Scope::Times(_)));
        let (left, kept): (Vec<_>, Vec<_>) = model.effects.iter().cloned().partition(|e| {
            let moves = e.effect.course.is_some() || e.effect.walk.is_some();
            moves || says_time(&e.effect.scope) || e.effect.is_of_clock() || e.effect.changes.contains_key("delay")
        });
        let model = Model { effects: kept, ..model.clone() };
        let equations = model.equations_to_simulate()?;
        let definitions = model.definitions()?;
        let hidden: BTreeMap<Symbol, Expr> = model.effects.iter().flat_map(|e| e.states()).collect();
        let rate = |state: &Symbol| {
            hidden
                .get(state)
                .or_else(|| definitions.get(&state.rate()))
                .cloned()
                .ok_or_else(|| Error::run(format!("the model does not define the rate of {state}")))
        };
        let rates = equations.states.iter().map(rate).collect::<Result<Vec<_>>>()?;
        let sorted: Vec<(Symbol, Expr)> =
            definitions.sorted()?.into_iter().map(|(n, f)| (n.clone(), f.clone())).collect();
        let definitions = needed(&rates, sorted);
        let used: BTreeSet<Symbol> =
            rates.iter().chain(definitions.iter().map(|(_, f)| f)).flat_map(Expr::symbols).collect();
        let constants = model.values().into_iter().filter(|(name, _)| used.contains(name)).collect();
        Ok(Self {
            states: equations.states.clone(),
            inputs: equations.inputs.clone(),
            constants,
            definitions,
            rates,
            used,
            unsaid: left.iter().map(|e| written(&e.entry())).collect(),
            covariance: (vec![], vec![]),
            head: head(file),
        })
    }

    /// With the covariance of fitted parameters, by their names.
    pub fn with_covariance(self, names: Vec<String>, matrix: Vec<Vec<f64>>) -> Self {
        Self { covariance: (names, matrix), ..self }
    }

    /// The code in a language.
    pub fn export(&self, language: Language) -> Exported {
        let number = |v: &f64| format!("{v:?}");
        let comment = language.comment();
        let left_out = self.unsaid.iter().map(|e| format!("left out: {e}"));
        let head: Vec<String> =
            self.head.iter().cloned().chain(left_out).map(|line| format!("{comment} {line}")).collect();
        let list = |names: &[Symbol]| names.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let read = |array: &str, names: &[Symbol]| -> String {
            let line = |(i, name): (usize, &Symbol)| language.constant(name, &format!("{array}[{i}]"));
            names.iter().enumerate().filter(|(_, name)| self.used.contains(*name)).map(line).collect()
        };
        let constants: String = self.constants.iter().map(|(n, v)| language.constant(n, &number(v))).collect();
        let values: String =
            self.definitions.iter().map(|(n, f)| language.constant(n, &language.expression(f))).collect();
        let end = language.end();
        let rate = |(i, f): (usize, &Expr)| format!("    rate[{i}] = {}{end}\n", language.expression(f));
        // C has no lists of no length.
        let (mut names, mut matrix) = (self.covariance.0.clone(), self.covariance.1.clone());
        let p = names.len();
        if matches!(language, Language::C | Language::Cpp) {
            names.push(String::new());
            matrix.iter_mut().for_each(|row| row.push(0.0));
            matrix.push(vec![0.0; p + 1]);
        }
        let names: Vec<String> = names.iter().map(|n| format!("{n:?}")).collect();
        let rows: Vec<String> =
            matrix.iter().map(|row| language.list(&row.iter().map(number).collect::<Vec<_>>())).collect();
        let parts = [
            ("@HEAD@", head.join("\n")),
            ("@STATES@", list(&self.states)),
            ("@INPUTS@", list(&self.inputs)),
            ("@N@", self.states.len().to_string()),
            ("@M@", self.inputs.len().to_string()),
            ("@P@", p.to_string()),
            ("@NAMES@", language.list(&names)),
            ("@COVARIANCE@", language.list(&rows)),
            ("@READ@", format!("{}{}{constants}", read("z", &self.states), read("u", &self.inputs))),
            ("@VALUES@", values),
            ("@RATES@", self.rates.iter().enumerate().map(rate).collect()),
            ("@SLOPES@", self.slopes(language)),
        ];
        let text = parts.into_iter().fold(language.template(), |t, (mark, part)| t.replace(mark, &part));
        Exported { text, unsaid: self.unsaid.clone() }
    }

    /// Derivatives of definitions and rates by states and inputs, by the chain rule; those that are zero, or that no rate
    /// hangs on, are left out.
    fn slopes(&self, language: Language) -> String {
        let variables: Vec<&Symbol> = self.states.iter().chain(&self.inputs).collect();
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
        let places = (0..self.rates.len()).flat_map(|i| (0..variables.len()).map(move |j| (i, j)));
        let of_rates: Vec<((usize, usize), Expr)> =
            places.map(|(i, j)| ((i, j), chained(&self.rates[i], variables[j], j, &known))).collect();
        let formulas: Vec<Expr> = of_rates.iter().map(|(_, slope)| slope.clone()).collect();
        let mut text = String::new();
        for (name, slope) in needed(&formulas, of_definitions) {
            text += &language.constant(&name, &language.expression(&slope));
        }
        for ((i, j), slope) in of_rates.iter().filter(|(_, slope)| !slope.is_zero()) {
            text += &format!("    by[{i}][{j}] = {}{}\n", language.expression(slope), language.end());
        }
        text
    }
}

/// The name of the derivative of a definition by the j-th of states and inputs.
fn slope_name(name: &Symbol, j: usize) -> Symbol {
    Symbol::new(&format!("d_{}_{j}", identifier(name).trim_end_matches('_')))
}

/// The derivative of a formula by the j-th of states and inputs, `variable`, where derivatives of definitions have names.
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

/// Where code comes from, and what its state is of.
fn head(file: &ModelFile) -> Vec<String> {
    let from = origin(file);
    let found = Corrections::of(file);
    let [x, y, yaw] = found.place;
    let tracked = format!(
        "The state is that of the reference point; the tracked frame is at x {x} m, y {y} m, yaw {yaw} rad on it."
    );
    if found.is_at_reference() { vec![from] } else { vec![from, tracked] }
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
