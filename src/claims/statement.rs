//! A statement: equations as data, which can be put to the test and tampered with.

use crate::error::Result;
use crate::formula::{Expr, Symbol};
use std::fmt;

/// left = right. The left side is what the program derives or measures, the right side what is said of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Equation {
    /// What is spoken of.
    pub left: Expr,
    /// What is said of it.
    pub right: Expr,
}

/// The equations of a piece of evidence, in order.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Statement {
    equations: Vec<Equation>,
    /// Whether it is enough to know that it is false: the simplest counterexample costs time.
    brief: bool,
    /// The one equation in which it differs from a statement already found true.
    changed: Option<usize>,
}

impl Statement {
    /// Reads pairs of formulas.
    ///
    /// ```
    /// use creepage::claims::Statement;
    /// let s = Statement::parse(&[("v_l", "r*theta'*(1 - e_rc)")]).unwrap();
    /// assert_eq!(s.to_string(), "v_l = r*theta'*(1 - e_rc)");
    /// ```
    ///
    /// # Errors
    /// When a formula is malformed.
    pub fn parse<T: AsRef<str>>(equations: &[(T, T)]) -> Result<Self> {
        let equation = |(left, right): &(T, T)| {
            Ok(Equation { left: Expr::parse(left.as_ref())?, right: Expr::parse(right.as_ref())? })
        };
        Ok(Self { equations: equations.iter().map(equation).collect::<Result<_>>()?, ..Self::default() })
    }

    /// Equations made of formulas at hand.
    pub fn of(equations: impl IntoIterator<Item = (Expr, Expr)>) -> Self {
        let equations = equations.into_iter().map(|(left, right)| Equation { left, right }).collect();
        Self { equations, ..Self::default() }
    }

    /// The equations.
    pub fn equations(&self) -> &[Equation] {
        &self.equations
    }

    /// Each equation as a statement of its own, with its place; one that need not be looked at again is left out.
    pub(crate) fn each(&self) -> impl Iterator<Item = (usize, Self)> {
        let asked = |(i, _): &(usize, &Equation)| self.changed.is_none_or(|changed| changed == *i);
        let alone =
            |(i, e): (usize, &Equation)| (i, Self { equations: vec![e.clone()], brief: self.brief, changed: None });
        self.equations.iter().enumerate().filter(asked).map(alone)
    }

    /// What is said of a name, the left side of an equation.
    pub fn said_of(&self, name: &str) -> Option<&Expr> {
        let name = Expr::sym(Symbol::new(name));
        self.equations.iter().find(|e| e.left == name).map(|e| &e.right)
    }

    /// What is said of a name as a number.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.said_of(name)?.eval(&|_| f64::NAN)
    }

    /// The same with one right side replaced.
    pub(crate) fn with(&self, index: usize, right: Expr) -> Self {
        let mut changed = self.clone();
        changed.equations[index].right = right;
        changed.changed = Some(index);
        changed
    }

    /// The same, of which one only wants to know whether it is true.
    pub(crate) fn in_brief(mut self) -> Self {
        self.brief = true;
        self
    }

    /// The equations whose truth is not known from elsewhere: of a slip, the one it was made in.
    pub fn in_question(&self) -> &[Equation] {
        match self.changed {
            Some(i) => &self.equations[i..=i],
            None => &self.equations,
        }
    }

    /// Whether one only wants to know if it is true.
    pub(crate) fn is_brief(&self) -> bool {
        self.brief
    }
}

impl fmt::Display for Equation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}", self.left, self.right)
    }
}

impl fmt::Display for Statement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.equations.iter().map(ToString::to_string).collect();
        f.write_str(&lines.join("; "))
    }
}
