//! The equations of motion under forces as definitions: Kane's equations in the axes of the bodies.

use super::bodies::{castors, rolling_rates, unprimed};
use super::contact::Contact;
use super::description::{Dynamics, rate_role};
use super::ldl_factors::define_solution;
use super::masses::{inertia_of, without_inertia};
use super::quasi_velocities::Contacts;
use super::rate_forms::{RateForms, sum, times};
use crate::error::Result;
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Definitions, Heading, Row};
use crate::model::constraints::{behind, constraints_in_body, moving, section_heading, trailer_direction};
use crate::model::forced_motion::{ForcedMotion, stated};

impl Dynamics {
    /// The equations of motion as definitions.
    ///
    /// # Errors
    /// When nothing says how a coordinate accelerates, or the steering swings an ideal contact.
    pub(crate) fn lowered(&self) -> Result<ForcedMotion> {
        let (vehicle, trailers) = (&self.model.vehicle, self.model.trailers.len());
        let own = constraints_in_body(vehicle);
        let lawful = |slips: Vec<Contact>, from: usize| -> Vec<Contact> {
            let law = |(i, c): (usize, Contact)| Contact { law: self.contacts[from + i].law.clone(), ..c };
            slips.into_iter().enumerate().map(law).collect()
        };
        let of_body = lawful(own.iter().map(Contact::of).collect(), 0);
        let axle = |i: usize| behind(&moving(i - 1), i);
        let rows = (1..=trailers).map(|i| Contact::of(&trailer_direction(vehicle, i, &axle(i))));
        let of_trailers = lawful(rows.collect(), of_body.len());
        let axles: Vec<[(Symbol, Row); 2]> = (1..=trailers)
            .map(|i| {
                let along = |stem: &str, to: Heading| (Symbol::new(&format!("{stem}_{i}")), axle(i).along(&to));
                [along("v", section_heading(i)), along("vt", section_heading(i).left())]
            })
            .collect();
        let given = self.given();
        let wheels = rolling_rates(vehicle);
        let contacts = Contacts {
            vehicle,
            of_body: &of_body,
            of_trailers: &of_trailers,
            axles: &axles,
            wheels: &wheels,
            given: &given,
        };
        self.check_swung(of_body.iter().chain(&of_trailers))?;
        let mut forms = contacts.rate_forms()?;
        self.check_inert(&forms)?;
        let all: Vec<Contact> = of_body.into_iter().chain(of_trailers).collect();
        self.assembled(&mut forms, &all)
    }

    /// Symbols of the vehicle that its steering moves.
    pub(super) fn given(&self) -> Vec<Symbol> {
        let steering = self.steering();
        let define = &self.model.vehicle.define;
        let moved = |s: &Symbol| -> bool {
            let mut open = vec![s.clone()];
            while let Some(next) = open.pop() {
                if steering.iter().any(|role| role == next.as_str()) {
                    return true;
                }
                open.extend(define.get(&next).into_iter().flat_map(|d| d.formula.symbols()));
            }
            false
        };
        define.keys().filter(|s| moved(s)).cloned().collect()
    }

    /// An ideal contact behind the axis of a steered wheel is swung by the steering itself, whose acceleration is not
    /// among the inputs.
    fn check_swung<'c>(&self, mut contacts: impl Iterator<Item = &'c Contact>) -> Result<()> {
        let swung = |c: &&Contact| c.law.is_none() && c.slip.rates().any(|r| self.given().contains(&unprimed(r)));
        contacts.find(swung).map_or(Ok(()), |c| Err(c.swung_error()))
    }

    /// That every quasi-velocity of a wheel or a castor has a moment of inertia.
    fn check_inert(&self, forms: &RateForms) -> Result<()> {
        let values = self.values();
        let angles = rolling_rates(&self.model.vehicle).into_iter().map(|r| unprimed(&r));
        for angle in angles.chain(castors(&self.model.vehicle)) {
            let is_free = forms.speeds.iter().any(|s| s.as_str() == format!("{angle}.omega"));
            if is_free && values.get(&inertia_of(&angle)).is_none_or(|i| *i <= 0.0) {
                return Err(without_inertia(&angle));
            }
        }
        Ok(())
    }

    /// Masses, forces, and what they give.
    fn assembled(&self, forms: &mut RateForms, contacts: &[Contact]) -> Result<ForcedMotion> {
        let energy = self.inertial(forms);
        let mut d = Definitions::default();
        self.define_stated(&mut d);
        let mut push = self.external(forms, &mut d);
        let (mut memory, mut turned) = (Vec::new(), Vec::new());
        for (i, contact) in contacts.iter().enumerate() {
            memory.extend(self.define_contact(contact, i + 1, forms, &mut d, &mut push));
            let swung = contact.slip.rates().map(unprimed).filter(|q| self.given().contains(q));
            turned.extend(swung);
        }
        self.define_push(forms, &mut d, &push);
        let n = forms.speeds.len();
        let mass: Vec<Vec<Expr>> =
            (0..n).map(|j| (0..=j).map(|k| self.define_mass(&energy, j, k, &mut d)).collect()).collect();
        let side: Vec<Expr> = (0..n)
            .map(|j| {
                let carried = sum(energy.iter().map(|e| {
                    let bias = sum([forms.drift(&e.form), e.turning.clone()].into_iter());
                    times(&times(&e.weight, &e.form[j].value), &bias)
                }));
                let name = format!("push.{}", forms.speeds[j]);
                let force = sum(push[j].drain(..));
                d.define(name.as_str(), if carried.is_zero() { force } else { &force - &carried });
                Expr::sym(name.as_str())
            })
            .collect();
        let rates: Vec<Symbol> = forms.speeds.iter().map(Symbol::rate).collect();
        define_solution(&mut d, &mass, &side, &rates);
        forms.definitions.iter().for_each(|(name, formula)| d.define(name.clone(), formula.clone()));
        turned.extend(forms.motion.asked());
        turned.sort();
        turned.dedup();
        Ok(self.gathered(forms, memory, turned, d))
    }

    /// The states and the rest of what a model is given.
    fn gathered(&self, forms: &RateForms, memory: Vec<Symbol>, turned: Vec<Symbol>, d: Definitions) -> ForcedMotion {
        let mut d = d;
        let mut states: Vec<Symbol> = castors(&self.model.vehicle);
        states.extend(forms.speeds.iter().cloned().chain(memory));
        if self.by_rate {
            for angle in &self.prescribed {
                states.push(angle.clone());
                let role = self.steering().first().map(|s| rate_role(s)).unwrap_or_default();
                d.define(angle.rate(), Expr::sym(role.as_str()));
            }
        }
        let own = self.model.values();
        let values = self.values().into_iter().filter(|(name, _)| !own.contains_key(name));
        ForcedMotion {
            kinematic: (self.model.vehicle.clone(), self.model.inputs.clone()),
            nodes: vec![],
            states,
            speeds: forms.speeds.clone(),
            definitions: d,
            values: values.map(|(name, value)| (stated(&name), value)).collect(),
            losses: (1..=rolling_rates(&self.model.vehicle).len())
                .map(|i| {
                    let name = |stem: &str| Symbol::new(&format!("{stem}_{i}"));
                    (name("wheel_loss"), [name("wheel_drag"), name("wheel_rub")])
                })
                .collect(),
            turned: if self.by_rate { vec![] } else { turned },
        }
    }

    /// Masses, moments and coefficients by their bare names, which effects rewrite.
    fn define_stated(&self, d: &mut Definitions) {
        let own = self.model.values();
        for name in self.values().into_keys().filter(|name| !own.contains_key(name)) {
            d.define(name.clone(), Expr::sym(stated(&name)));
        }
        d.define("body.mass_aside", Expr::int(0));
    }
}
