//! Units and meanings of the names of a motion under forces.

use super::meaning::{Known, unit_of_rate};
use super::symbol_entry::Kind;
use crate::formula::{Expr, Node, Symbol, Unit};
use crate::mechanism::Definitions;
use crate::model::Model;
use crate::model::forced_motion::{STATED, stated};
use crate::model::forces::laws;
use std::collections::{BTreeMap, BTreeSet};

type Meaning = (Kind, String, String);

/// Quantities of a body, after its name and a dot.
const OF_BODY: &[Known] = &[
    ("u", Kind::State, "m/s", "forward speed that forces change, of the"),
    ("w", Kind::State, "m/s", "speed to the left that forces change, of the"),
    ("omega", Kind::State, "rad/s", "yaw rate that forces change, of the"),
    ("mass", Kind::Defined, "kg", "mass of the"),
    ("inertia", Kind::Defined, "kg*m^2", "moment of inertia about the vertical through the centre of mass of the"),
    ("mass_offset", Kind::Defined, "m", "how far ahead of its reference point or axle the centre of mass lies of the"),
    ("mass_aside", Kind::Defined, "m", "how far to the left the centre of mass lies of the"),
    ("force_ahead", Kind::Defined, "N", "force forward at the centre of mass, or at the axle, of the"),
    ("force_aside", Kind::Defined, "N", "force to the left at the centre of mass of the"),
    ("torque", Kind::Defined, "N*m", "torque about the vertical on the"),
    ("push", Kind::Defined, "N", "force forward of all that drives and brakes the"),
    ("drag", Kind::Defined, "1/s", "rate at which a resistance slows the"),
];

/// Quantities of a contact, after its name and a dot.
const OF_CONTACT: &[Known] = &[
    ("slip", Kind::Defined, "m/s", "speed at which it slips, of the contact"),
    ("speed", Kind::Defined, "m/s", "speed along the wheel of the contact"),
    ("law", Kind::Defined, "N", "force by its law of the contact"),
    ("force", Kind::Defined, "N", "force along the slip of the contact"),
    ("deflection", Kind::State, "m", "deflection of the tyre at the contact"),
];

/// Quantities by the number of a contact.
const BY_CONTACT: &[Known] = &[
    ("traction", Kind::Defined, "1", "factor on the force of the contact"),
    ("grip_front", Kind::Defined, "1", "factor on the force of the contact"),
    ("grip_rear", Kind::Defined, "1", "factor on the force of the contact"),
    ("drive_force", Kind::Defined, "N", "force that the law gives the contact"),
    ("asked_force", Kind::Defined, "N", "force that the law asks for at the contact"),
    ("built_force", Kind::Defined, "N", "force that has built up at the contact"),
    ("side_force", Kind::Defined, "N", "force that the law gives the contact"),
];

/// Quantities by the number of a wheel that rolls.
const BY_WHEEL: &[Known] = &[
    ("torque", Kind::Defined, "N*m", "torque about the axle on wheel"),
    ("motor_torque", Kind::Defined, "N*m", "torque that the motor gives for wheel"),
    ("drive_torque", Kind::Defined, "N*m", "torque that the gear passes on to wheel"),
    ("wheel_impulse", Kind::Defined, "kg*m", "impulse of a torque that gives the body one metre per second, at wheel"),
    ("wheel_loss", Kind::Defined, "N*m", "torque that the drive loses at wheel"),
    ("wheel_drag", Kind::Defined, "1/s", "rate at which the drive brakes wheel"),
    ("wheel_rub", Kind::Defined, "1", "dry friction in the drive as a share of the weight, at wheel"),
];

/// Steps of the solution of the equations of motion, before numbers of rows and columns.
const OF_SOLUTION: &[(&str, &str)] = &[
    ("mass.entry_", "entry of the mass matrix"),
    ("mass.pivot_", "pivot of the mass matrix"),
    ("mass.factor_", "factor of the mass matrix"),
    ("mass.forward_", "right-hand side after forward substitution"),
    ("push.", "what drives, brakes and holds, along the speed"),
];

/// Between a rate and the speed that moves it.
const BY: &str = ".by_";

/// What names mean in the motion under forces of a model.
pub(super) struct UnderForces<'a> {
    model: &'a Model,
    contacts: Vec<String>,
    /// Names whose value is that of the model file.
    as_stated: BTreeSet<Symbol>,
    /// Units of names that stand for parts of a formula.
    inferred: BTreeMap<Symbol, String>,
}

/// Whether a definition says no more than that a value is that of the model file: no effect has rewritten it.
pub(super) fn is_as_stated(name: &Symbol, formula: &Expr) -> bool {
    matches!(formula.node(), Node::Sym(s) if *s == stated(name))
}

impl<'a> UnderForces<'a> {
    /// Of a model with its definitions; `None` where no forces move it. The units of what stands for a part of a formula are
    /// those of the formula.
    pub fn of(
        model: &'a Model,
        definitions: &Definitions,
        beside: &impl Fn(&Symbol) -> Option<Meaning>,
    ) -> crate::error::Result<Option<Self>> {
        if model.forced.is_none() {
            return Ok(None);
        }
        let contacts = model.kinematic().constraints().into_iter().map(|c| c.name).collect();
        let as_stated = definitions.iter().filter(|(name, formula)| is_as_stated(name, formula));
        let as_stated = as_stated.map(|(name, _)| name.clone()).collect();
        let mut found = Self { model, contacts, as_stated, inferred: BTreeMap::new() };
        for (name, formula) in definitions.sorted()? {
            let bare = name.as_str().trim_end_matches('\'');
            if !bare.contains(BY) && !OF_SOLUTION.iter().any(|(stem, _)| bare.starts_with(stem)) {
                continue;
            }
            let of = |s: &Symbol| found.meaning(s).or_else(|| beside(s)).and_then(|(_, unit, _)| Unit::parse(&unit));
            let unit = formula.eval(&|s| of(s).unwrap_or_else(Unit::number_unit));
            let unit = unit.map(|u| u.to_string()).filter(|u| Unit::parse(u).is_some());
            found.inferred.insert(name.clone(), unit.unwrap_or_else(|| "1".into()));
        }
        Ok(Some(found))
    }

    /// Kind, unit and meaning of a name; `None` for a name that has nothing to do with forces.
    pub fn meaning(&self, symbol: &Symbol) -> Option<Meaning> {
        let name = symbol.as_str();
        if let Some(unit) = self.inferred.get(symbol) {
            return Some((Kind::Defined, unit.clone(), step_of_solution(name)?));
        }
        if let Some(bare) = name.strip_prefix(STATED) {
            let (_, unit, meaning) = self.meaning(&Symbol::new(bare))?;
            return Some((Kind::Parameter, unit, format!("{meaning}, as stated")));
        }
        if let Some(state) = name.strip_suffix('\'') {
            let (_, unit, meaning) = self.meaning(&Symbol::new(state)).filter(|(kind, ..)| *kind == Kind::State)?;
            return Some((Kind::Rate, unit_of_rate(&unit), format!("rate of the {meaning}")));
        }
        let (kind, unit, meaning) = match name.split_once('.') {
            Some((of, quantity)) => self.dotted(of, quantity),
            None => self.numbered(name),
        }?;
        Some((if self.as_stated.contains(symbol) { Kind::Parameter } else { kind }, unit, meaning))
    }

    fn dotted(&self, of: &str, quantity: &str) -> Option<Meaning> {
        if let Some(contact) = of.strip_prefix("contact_") {
            let at = self.contact(contact)?;
            let law = || laws().iter().flat_map(|l| &l.parameters).find(|p| p.name == quantity);
            let own = OF_CONTACT.iter().find(|r| r.0 == quantity).map(|r| said(r, &at));
            return own.or_else(|| {
                law().map(|p| (Kind::Parameter, p.unit.clone(), format!("{} of the contact {at}", p.meaning)))
            });
        }
        if of == "body" {
            return OF_BODY.iter().find(|r| r.0 == quantity).map(|r| said(r, "body"));
        }
        if let Some(number) = of.strip_prefix("trailer_") {
            number.parse::<usize>().ok().filter(|n| (1..=self.model.trailers.len()).contains(n))?;
            return OF_BODY.iter().find(|r| r.0 == quantity).map(|r| said(r, &format!("trailer {number}")));
        }
        match quantity {
            "omega" => Some((Kind::State, "rad/s".into(), format!("rate of {of} that forces change"))),
            "inertia" => Some((Kind::Defined, "kg*m^2".into(), format!("moment of inertia that goes with {of}"))),
            _ => None,
        }
    }

    fn numbered(&self, name: &str) -> Option<Meaning> {
        if name == "flank_rate" {
            return Some((Kind::Defined, "1/s".into(), "rate at which teeth of a gear come to rest on a flank".into()));
        }
        let (stem, number) = name.rsplit_once('_')?;
        if stem == "grip_trailer" {
            return Some((Kind::Defined, "1".into(), format!("factor on the side force of trailer {number}")));
        }
        if let Some(row) = BY_CONTACT.iter().find(|r| r.0 == stem) {
            return Some(said(row, &self.contact(number)?));
        }
        BY_WHEEL.iter().find(|r| r.0 == stem).map(|row| said(row, number))
    }

    /// The name of a contact by its number, counted from one.
    fn contact(&self, number: &str) -> Option<String> {
        self.contacts.get(number.parse::<usize>().ok()?.checked_sub(1)?).cloned()
    }
}

fn said(row: &Known, of: &str) -> Meaning {
    (row.1, row.2.to_string(), format!("{} {of}", row.3))
}

/// What a name that stands for a part of a formula says.
fn step_of_solution(name: &str) -> Option<String> {
    let bare = name.trim_end_matches('\'');
    if let Some((rate, speed)) = bare.split_once(BY) {
        let how = format!("how the rate of {rate} moves with {speed}");
        return Some(if bare == name { how } else { format!("rate of {how}") });
    }
    let (stem, words) = OF_SOLUTION.iter().find(|(stem, _)| bare.starts_with(stem))?;
    Some(format!("{words} {}", bare[stem.len()..].replace('_', ", ")))
}
