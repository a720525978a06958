//! Named formulas that refer to one another, sorted topologically and evaluated in any carrier.

use crate::error::{Error, Result};
use crate::formula::{Expr, Graph, Scalar, Symbol};
use std::collections::BTreeMap;

/// A set of definitions name = formula, each name defined once, in the order they were made.
///
/// Effects *rewrite* a definition: the new formula may mention the name itself, which stands for the old
/// formula.
///
/// ```
/// use creepage::mechanism::Definitions;
/// use creepage::formula::Expr;
/// let mut d = Definitions::default();
/// d.define("r", Expr::sym("wheel_radius"));
/// d.rewrite(&"r".into(), &Expr::parse("r*(1 + scale)").unwrap());
/// assert_eq!(d.get(&"r".into()).unwrap().to_string(), "wheel_radius*(1 + scale)");
/// ```
#[derive(Clone, Debug, Default)]
pub struct Definitions {
    entries: Vec<(Symbol, Expr)>,
}

impl Definitions {
    /// Defines a name, replacing an older definition.
    pub fn define(&mut self, name: impl Into<Symbol>, formula: Expr) {
        let name = name.into();
        match self.entries.iter_mut().find(|(n, _)| *n == name) {
            Some((_, f)) => *f = formula,
            None => self.entries.push((name, formula)),
        }
    }

    /// The formula of a name.
    pub fn get(&self, name: &Symbol) -> Option<&Expr> {
        self.entries.iter().find(|(n, _)| n == name).map(|(_, f)| f)
    }

    /// Replaces a formula by one that may mention the old one by its name; false when there is none.
    pub fn rewrite(&mut self, name: &Symbol, formula: &Expr) -> bool {
        let Some(old) = self.get(name).cloned() else { return false };
        let new = formula.substitute(&|s| (s == name).then(|| old.clone()));
        self.define(name.clone(), new);
        true
    }

    /// The definitions but for some names, which then stand for anything.
    pub fn without(&self, left_out: &impl Fn(&Symbol) -> bool) -> Self {
        Self { entries: self.entries.iter().filter(|(n, _)| !left_out(n)).cloned().collect() }
    }

    /// Names and formulas in the order they were made.
    pub fn iter(&self) -> impl Iterator<Item = &(Symbol, Expr)> {
        self.entries.iter()
    }

    /// The definitions so ordered that each uses only earlier ones.
    ///
    /// # Errors
    /// When definitions use each other in a circle.
    pub fn sorted(&self) -> Result<Vec<&(Symbol, Expr)>> {
        let mut waiting: Vec<(&(Symbol, Expr), Vec<Symbol>)> = self
            .entries
            .iter()
            .map(|e| (e, e.1.symbols().into_iter().filter(|s| self.get(s).is_some()).collect()))
            .collect();
        let mut sorted: Vec<&(Symbol, Expr)> = Vec::with_capacity(waiting.len());
        let mut placed = std::collections::HashSet::new();
        while !waiting.is_empty() {
            let before = waiting.len();
            waiting.retain(|(entry, uses)| {
                let ready = uses.iter().all(|s| placed.contains(s));
                if ready {
                    placed.insert(entry.0.clone());
                    sorted.push(entry);
                }
                !ready
            });
            if waiting.len() == before {
                let names: Vec<_> = waiting.iter().map(|(e, _)| e.0.to_string()).collect();
                return Err(Error::input(format!("the formulas of {} use each other in a circle", names.join(", "))));
            }
        }
        Ok(sorted)
    }

    /// The value of every definition in a carrier; what `given` gives takes the place of a definition.
    ///
    /// A name that is neither defined nor given has no value, and neither has what uses it.
    ///
    /// ```
    /// use creepage::mechanism::Definitions;
    /// use creepage::formula::{Exact, Expr, Scalar};
    /// let mut d = Definitions::default();
    /// d.define("v", Expr::parse("r*omega").unwrap());
    /// d.define("r", Expr::parse("1/2").unwrap());
    /// let values = d.evaluate(&|s| (s.as_str() == "omega").then(|| Exact::ratio(3, 1))).unwrap();
    /// assert!(values[&"v".into()].equals(&Exact::ratio(3, 2)));
    /// ```
    ///
    /// # Errors
    /// As [`Definitions::sorted`].
    pub fn evaluate<S: Scalar>(&self, given: &impl Fn(&Symbol) -> Option<S>) -> Result<BTreeMap<Symbol, S>> {
        let nothing = || S::number(&num_traits::Zero::zero()).recip();
        let mut values: BTreeMap<Symbol, S> = BTreeMap::new();
        for (name, formula) in self.sorted()? {
            let value = given(name).unwrap_or_else(|| {
                let known = |s: &Symbol| values.get(s).cloned().or_else(|| given(s)).unwrap_or_else(nothing);
                formula.eval_undefined_as_value(&known)
            });
            values.insert(name.clone(), value);
        }
        Ok(values)
    }

    /// Adds every definition to a graph.
    ///
    /// # Errors
    /// As [`Definitions::sorted`].
    pub fn insert_into(&self, graph: &mut Graph) -> Result<()> {
        for (name, formula) in self.sorted()? {
            let id = graph.insert(formula);
            graph.define(name.clone(), id);
        }
        Ok(())
    }
}
