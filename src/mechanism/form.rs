//! A generic form with its slots filled in, as a linear form in the rates.

use super::constraint_type::COEFFICIENT;
use super::zero_test::vanishes;
use super::{ConstraintType, Part, Row};
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use std::sync::Arc;

/// The generic form of a type with what a constraint puts in its slots.
#[derive(Clone, Debug, PartialEq)]
pub struct Form {
    kind: Arc<ConstraintType>,
    slots: Vec<(Symbol, Part)>,
    row: Row,
}

impl Form {
    /// A form with its slots filled in; slots with a formula are made here.
    ///
    /// # Errors
    /// When a slot is missing, is none of the type's, or the form is not linear in rates and in its coefficient.
    pub fn new(kind: &Arc<ConstraintType>, given: &[(Symbol, Part)], creep: &Symbol) -> Result<Self> {
        let slots = filled(kind, given, creep)?;
        match assembled(&kind.form, &slots, creep)? {
            Part::Rates(row) if !is_linear(&row, creep) => {
                Err(Error::input(format!("the form of type {} is not linear in its coefficient", kind.id))
                    .help("write it with e as a factor, such as 1 - e"))
            }
            Part::Rates(row) => Ok(Self { kind: kind.clone(), slots, row }),
            Part::Factor(_) => Err(Error::input(format!("a constraint of type {} has no rate in it", kind.id))
                .help("a slot that holds rates has a formula in which a name ends in '")),
        }
    }

    /// A form whose row is known, shorter than the form multiplied out.
    pub(crate) fn with_row(
        kind: &Arc<ConstraintType>,
        given: &[(Symbol, Part)],
        creep: &Symbol,
        row: Row,
    ) -> Result<Self> {
        Ok(Self { kind: kind.clone(), slots: filled(kind, given, creep)?, row })
    }

    /// Its type.
    pub fn kind(&self) -> &ConstraintType {
        &self.kind
    }

    /// What stands in a slot.
    pub fn slot(&self, name: &str) -> Option<&Part> {
        self.slots.iter().find(|(n, _)| n.as_str() == name).map(|(_, part)| part)
    }

    /// The slots that are filled, in the order of print.
    pub fn slots(&self) -> &[(Symbol, Part)] {
        &self.slots
    }

    /// The rate that the constraint gives where it is not measured.
    pub fn gives(&self) -> Option<&Symbol> {
        match self.slot(self.kind.gives.as_ref()?.as_str())? {
            Part::Rates(row) => row.rates().next(),
            Part::Factor(_) => None,
        }
    }

    /// Where σ is undefined: the zeros of this.
    pub fn singular(&self) -> Option<Expr> {
        Some(self.slot(self.kind.singular.as_ref()?.as_str())?.expr())
    }

    /// The row: row·q̇ = 0.
    pub fn row(&self) -> &Row {
        &self.row
    }

    /// The form with its slots put in, rates of each slot in a given order.
    pub fn expr(&self, order: &[Symbol], creep: &Symbol) -> Expr {
        self.kind.form.substitute(&|name| match self.slot(name.as_str()) {
            Some(part) => Some(part.ordered(order)),
            None => (name.as_str() == COEFFICIENT).then(|| Expr::sym(creep.clone())),
        })
    }

    /// With rates replaced by linear forms in other rates.
    pub(crate) fn with_rates(&self, by: &impl Fn(&Symbol) -> Option<Row>) -> Self {
        let part = |part: &Part| match part {
            Part::Rates(row) => Part::Rates(row.with_rates(by)),
            Part::Factor(_) => part.clone(),
        };
        let slots = self.slots.iter().map(|(name, p)| (name.clone(), part(p))).collect();
        Self { kind: self.kind.clone(), slots, row: self.row.with_rates(by) }
    }

    /// With names replaced; rates keep theirs.
    pub(crate) fn substitute(&self, by: &impl Fn(&Symbol) -> Option<Expr>) -> Self {
        let slots = self.slots.iter().map(|(name, part)| (name.clone(), part.substitute(by))).collect();
        Self { kind: self.kind.clone(), slots, row: self.row.substitute(by) }
    }
}

/// Whether a row is linear in its coefficient: its second derivative vanishes.
fn is_linear(row: &Row, creep: &Symbol) -> bool {
    row.terms().iter().all(|(_, c)| !c.mentions(creep) || vanishes(&c.derivative(creep).derivative(creep)))
}

/// The slots of a type with what is given for them, in the order of print.
fn filled(kind: &ConstraintType, given: &[(Symbol, Part)], creep: &Symbol) -> Result<Vec<(Symbol, Part)>> {
    let is_slot = |name: &Symbol| kind.slots.iter().any(|s| s.name == *name && s.formula.is_none());
    if let Some((name, _)) = given.iter().find(|(name, _)| !is_slot(name)) {
        let known: Vec<&str> = kind.slots.iter().filter(|s| s.formula.is_none()).map(|s| s.name.as_str()).collect();
        return Err(Error::input(format!("a constraint of type {} has no slot {name}", kind.id))
            .help(format!("it has {}", known.join(", "))));
    }
    let mut slots = Vec::new();
    for slot in &kind.slots {
        let part = match &slot.formula {
            Some(formula) => Some(assembled(formula, given, creep)?),
            None => given.iter().find(|(name, _)| *name == slot.name).map(|(_, part)| part.clone()),
        };
        match part {
            Some(part) => slots.push((slot.name.clone(), part)),
            None if slot.optional => {}
            None => {
                let missing = Error::input(format!("a constraint of type {} needs the slot {}", kind.id, slot.name));
                return Err(if slot.meaning.is_empty() { missing } else { missing.help(slot.meaning.clone()) });
            }
        }
    }
    Ok(slots)
}

/// A formula of a type with slots and coefficient put in; what is neither stays a name, for the constraint to complain.
fn assembled(formula: &Expr, slots: &[(Symbol, Part)], creep: &Symbol) -> Result<Part> {
    Part::assembled(formula, &|name| match slots.iter().find(|(n, _)| n == name) {
        Some((_, part)) => part.clone(),
        None if name.as_str() == COEFFICIENT => Part::Factor(Expr::sym(creep.clone())),
        None => Part::Factor(Expr::sym(name.clone())),
    })
}
