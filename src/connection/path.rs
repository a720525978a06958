//! A path in shape space: the shape as a function of time.

use crate::error::{Error, Result};
use crate::formula::{Expr, Graph, NodeId, Program, Symbol};

/// Shape variables as formulas of the time `t`, between two times.
///
/// ```
/// use creepage::connection::Path;
/// let swing = Path::new(&[("theta", "4/5*sin(t)")], [0.0, std::f64::consts::TAU]).unwrap();
/// assert!(swing.is_closed(&[]).unwrap());
/// ```
#[derive(Clone, Debug)]
pub struct Path {
    /// Each variable with its formula.
    pub shape: Vec<(Symbol, Expr)>,
    /// First and last time, s.
    pub times: [f64; 2],
}

/// The distance within which the ends of a path count as the same point, as a share of their size.
const CLOSED_TOLERANCE: f64 = 1e-9;

impl Path {
    /// A path by its formulas in `t`.
    ///
    /// # Errors
    /// When a formula is malformed or a time is not finite.
    pub fn new(shape: &[(&str, &str)], times: [f64; 2]) -> Result<Self> {
        let formula = |(name, text): &(&str, &str)| Ok((Symbol::new(name), Expr::parse(text)?));
        match times.iter().all(|t| t.is_finite()) {
            true => Ok(Self { shape: shape.iter().map(formula).collect::<Result<_>>()?, times }),
            false => Err(Error::input("a path begins and ends at finite times")),
        }
    }

    /// The same path at other times.
    pub fn between(self, times: [f64; 2]) -> Self {
        Self { times, ..self }
    }

    /// The formula of a shape variable.
    ///
    /// # Errors
    /// When the path does not say how it moves.
    pub fn of(&self, name: &Symbol) -> Result<Expr> {
        let found = self.shape.iter().find(|(n, _)| n == name).map(|(_, f)| f.clone());
        found.ok_or_else(|| {
            Error::input(format!("the path does not say how {name} moves")).help("give it a formula of the time t")
        })
    }

    /// A formula of the shape and its rates along the path: a formula of t.
    ///
    /// # Errors
    /// Never for a path of formulas; kept for symmetry with [`Path::of`].
    pub(super) fn along(&self, e: &Expr) -> Expr {
        e.substitute(&|s| {
            let place = self.shape.iter().find(|(n, _)| n == s).map(|(_, f)| f.clone());
            let rate = || self.shape.iter().find(|(n, _)| n.rate() == *s).map(|(_, f)| f.derivative(&"t".into()));
            place.or_else(rate)
        })
    }

    /// Where the shape is at a time, in the order of `shape`.
    ///
    /// # Errors
    /// When a formula uses a name that is neither t nor given, or is undefined.
    pub fn at(&self, t: f64, values: &[(&str, f64)]) -> Result<Vec<f64>> {
        let formulas: Vec<Expr> = self.shape.iter().map(|(_, f)| f.clone()).collect();
        Compiled::new(&formulas, &["t"], values)?.at(&[t])
    }

    /// Whether the shape ends where it began.
    ///
    /// # Errors
    /// As [`Path::at`].
    pub fn is_closed(&self, values: &[(&str, f64)]) -> Result<bool> {
        let (first, last) = (self.at(self.times[0], values)?, self.at(self.times[1], values)?);
        Ok(first.iter().zip(&last).all(|(a, b)| (a - b).abs() <= CLOSED_TOLERANCE * (1.0 + a.abs())))
    }
}

/// Formulas compiled for floating point.
pub(super) struct Compiled {
    program: Program,
    variables: usize,
    slots: Vec<f64>,
    registers: Vec<f64>,
    outputs: usize,
}

impl Compiled {
    /// Formulas of variables and named values.
    pub(super) fn new(formulas: &[Expr], variables: &[&str], values: &[(&str, f64)]) -> Result<Self> {
        let mut graph = Graph::default();
        let nodes: Vec<NodeId> = formulas.iter().map(|f| graph.insert(f)).collect();
        let names = variables.iter().copied().chain(values.iter().map(|(n, _)| *n));
        let names: Vec<Symbol> = names.map(Symbol::new).collect();
        let program = Program::compile(&graph, &names, &nodes).map_err(|name| {
            Error::input(format!("a formula uses {name}, which has no value")).help("give it one, or correct the name")
        })?;
        let slots = std::iter::repeat_n(0.0, variables.len()).chain(values.iter().map(|(_, v)| *v)).collect();
        let registers = program.registers();
        Ok(Self { program, variables: variables.len(), slots, registers, outputs: formulas.len() })
    }

    /// Their values; where one is undefined it is NaN.
    pub(super) fn values(&mut self, variables: &[f64], out: &mut [f64]) {
        self.slots[..self.variables].copy_from_slice(variables);
        self.program.run(&self.slots, &mut self.registers, out);
    }

    /// Their values.
    pub(super) fn at(&mut self, variables: &[f64]) -> Result<Vec<f64>> {
        let mut out = vec![0.0; self.outputs];
        self.values(variables, &mut out);
        match out.iter().all(|v| v.is_finite()) {
            true => Ok(out),
            false => Err(Error::run("a formula is undefined on the path")),
        }
    }
}
