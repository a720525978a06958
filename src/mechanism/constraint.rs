//! A constraint of a mechanism: one of the generic forms with its slots filled in, its name and its creep coefficient.

use super::{ConstraintType, Form, Momentum, Part, Row};
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A constraint of a mechanism: one of the generic forms, with its name and its creep coefficient.
///
/// In TOML its `type` is the id of a type of the catalogue, or a table with the fields of [`ConstraintType`]; its
/// `slots` are formulas, in which names that end in `'` are rates. In place of slots a constraint of type `momentum` may
/// have the `energy` and the `generator` of [`Momentum::of`].
///
/// ```
/// use creepage::vehicles;
/// let own: Vec<_> = vehicles::all().iter().flat_map(|vehicle| &vehicle.constraints).collect();
/// assert!(own.iter().all(|constraint| !constraint.name.is_empty()));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Written")]
pub struct Constraint {
    /// What it constrains, such as "rear axle, direction".
    pub name: String,
    /// The form with its slots filled in.
    pub form: Form,
    /// The symbol of the creep coefficient; zero is ideal.
    pub creep: Symbol,
}

/// A constraint as it is written in TOML.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    name: String,
    #[serde(rename = "type")]
    kind: Kind,
    creep: Symbol,
    #[serde(default)]
    slots: BTreeMap<Symbol, Expr>,
    /// Of a momentum that is zero: the kinetic energy, and the generator of the symmetry that leaves it unchanged.
    energy: Option<Expr>,
    #[serde(default)]
    generator: BTreeMap<Symbol, Expr>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Kind {
    Named(String),
    Own(Box<ConstraintType>),
}

impl TryFrom<Written> for Constraint {
    type Error = Error;
    fn try_from(written: Written) -> Result<Self> {
        let kind = match written.kind {
            Kind::Named(name) => ConstraintType::named(&name)?,
            Kind::Own(own) => Arc::new(*own),
        };
        if let Some(energy) = &written.energy {
            let generator: Vec<_> = written.generator.into_iter().collect();
            let derived = Momentum::of(energy, &generator)?.constraint(&written.name, written.creep.as_str())?;
            return match kind.id == derived.kind().id && written.slots.is_empty() {
                true => Ok(derived),
                false => Err(Error::input(format!("an energy gives a constraint of type {}", derived.kind().id))
                    .help("leave the slots out, they are derived")),
            };
        }
        let part = |(name, formula): (Symbol, Expr)| Ok((name, Part::of(&formula)?));
        let slots = written.slots.into_iter().map(part).collect::<Result<Vec<_>>>()?;
        Self::of(&written.name, &kind, &slots, written.creep)
    }
}

impl Constraint {
    /// A constraint of a type, its slots given as formulas; names in them that end in `'` are rates.
    ///
    /// # Errors
    /// When a formula is malformed or not linear in rates, or a slot is missing or none of the type's.
    pub fn new(name: &str, kind: &ConstraintType, slots: &[(&str, &str)], creep: &str) -> Result<Self> {
        let part = |(name, text): &(&str, &str)| Ok((Symbol::new(name), Part::of(&Expr::parse(text)?)?));
        let slots = slots.iter().map(part).collect::<Result<Vec<_>>>()?;
        Self::of(name, &Arc::new(kind.clone()), &slots, creep.into())
    }

    /// A constraint of a type with what stands in its slots.
    ///
    /// # Errors
    /// When a slot is missing or none of the type's.
    pub fn of(name: &str, kind: &Arc<ConstraintType>, slots: &[(Symbol, Part)], creep: Symbol) -> Result<Self> {
        Ok(Self { name: name.into(), form: Form::new(kind, slots, &creep)?, creep })
    }

    /// Its type.
    pub fn kind(&self) -> &ConstraintType {
        self.form.kind()
    }

    /// The row of the Pfaffian matrix: row·q̇ = 0.
    pub fn row(&self) -> Row {
        self.form.row().clone()
    }

    /// The generic form as printed: π̇ − σ·q̇ or s·q̇₁ − p·q̇₃.
    pub fn generic(&self) -> Expr {
        self.form.expr(&[], &self.creep)
    }

    /// The row with no creep.
    pub fn ideal_row(&self) -> Row {
        self.row().substitute(&|s| (*s == self.creep).then(|| Expr::int(0)))
    }

    /// The constraint with names replaced in its coefficients; rates keep theirs.
    pub fn substitute(&self, by: &impl Fn(&Symbol) -> Option<Expr>) -> Self {
        Self { form: self.form.substitute(by), ..self.clone() }
    }

    /// The constraint with rates replaced by linear forms in other rates, its row multiplied out.
    pub(crate) fn with_rates(&self, by: &impl Fn(&Symbol) -> Option<Row>) -> Self {
        Self { form: self.form.with_rates(by), ..self.clone() }
    }

    /// The letter of its type, such as `R` or `T`.
    pub fn letter(&self) -> char {
        self.kind().letter
    }
}

impl Momentum {
    /// The constraint that this momentum is zero, with a coefficient of creep: J = e·h.
    ///
    /// # Errors
    /// When no rate is left in it.
    pub fn constraint(&self, name: &str, creep: &str) -> Result<Constraint> {
        if self.map.terms().iter().all(|(_, c)| c.is_zero()) {
            return Err(Error::input(format!("the momentum of \"{name}\" is zero in every motion"))
                .help("take a symmetry that moves something with inertia"));
        }
        let mut slots = vec![
            ("s", Part::Factor(self.locked.clone())),
            ("q1'", Part::rate(&self.along.rate())),
            ("h", Part::Rates(self.shape.clone())),
        ];
        if let [(_, carried)] = self.shape.terms() {
            let keeps = &Expr::int(1) - &Expr::sym(creep);
            slots.push(("sigma", Part::Factor(&-&(&keeps * carried) / &self.locked)));
        }
        let slots: Vec<(Symbol, Part)> = slots.into_iter().map(|(name, part)| (name.into(), part)).collect();
        Constraint::of(name, &ConstraintType::named("momentum")?, &slots, creep.into())
    }
}
