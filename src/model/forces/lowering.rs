//! The equations of motion under forces as definitions: Kane's equations in the axes of the bodies.

use super::bodies::{castors, rolling_rates, unprimed};
use super::contact::Contact;
use super::description::{Dynamics, rate_role};
use super::driving_force::{Torque, wheel_torques};
use super::law::Law;
use super::ldl_factors::define_solution;
use super::masses::{inertia_of, symbols};
use super::quasi_velocities::Contacts;
use super::rate_forms::{Coefficient, RateForms, sum, times};
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Definitions, Heading, Row};
use crate::model::constraints::{behind, constraints_in_body, moving, section_heading, trailer_direction};
use crate::model::forced_motion::{ForcedMotion, stated};
use crate::model::trailer::trailer_heading;

/// A part of the kinetic energy, ½·weight·form².
struct Inertial {
    weight: Expr,
    form: Vec<Coefficient>,
    /// What the turning of the axes adds to the rate of the form: −ω·w forward, ω·u sideways.
    turning: Expr,
}

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
    fn given(&self) -> Vec<Symbol> {
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
        match contacts.find(swung) {
            None => Ok(()),
            Some(c) => {
                Err(Error::input(format!("{} is swung by the steering, whose acceleration is not known", c.name))
                    .help("give this contact a law of friction"))
            }
        }
    }

    /// That every quasi-velocity of a wheel or a castor has a moment of inertia.
    fn check_inert(&self, forms: &RateForms) -> Result<()> {
        let values = self.values();
        let angles = rolling_rates(&self.model.vehicle).into_iter().map(|r| unprimed(&r));
        for angle in angles.chain(castors(&self.model.vehicle)) {
            let is_free = forms.speeds.iter().any(|s| s.as_str() == format!("{angle}.omega"));
            if is_free && values.get(&inertia_of(&angle)).is_none_or(|i| *i <= 0.0) {
                return Err(Error::input(format!(
                    "nothing says how {angle} accelerates: it has neither mass nor an ideal contact"
                ))
                .help("give it a moment of inertia under [dynamics], or make its contact ideal"));
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
        let define = &self.model.vehicle.define;
        let is_input = |s: &Symbol| self.model.vehicle.inputs.contains_key(s.as_str());
        let kept = self.given();
        let mut freed: Vec<Symbol> = define
            .iter()
            .filter(|(name, f)| !kept.contains(name) && f.formula.symbols().iter().any(is_input))
            .map(|(name, _)| name.clone())
            .collect();
        if self.by_rate {
            for angle in &self.prescribed {
                states.push(angle.clone());
                freed.push(angle.clone());
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
            freed,
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

    /// The kinetic energy as a sum of squares.
    fn inertial(&self, forms: &mut RateForms) -> Vec<Inertial> {
        let sym = |s: &str| Expr::sym(s);
        let vehicle = &self.model.vehicle;
        let mut found = Vec::new();
        for i in 0..=self.model.trailers.len() {
            let [mass, inertia, offset] = symbols(i).map(Expr::sym);
            let names = match i {
                0 => ["v_l".to_string(), "v_t".to_string(), "phi'".to_string()],
                _ => [format!("v_{i}"), format!("vt_{i}"), trailer_heading(i).rate().to_string()],
            };
            let mut row = [0, 1, 2].map(|k| {
                let mut row = Row::default();
                row.add(names[k].as_str(), &Expr::int(1));
                row
            });
            let [forward, sideways, turning] = &mut row;
            if vehicle.line {
                found.push(Inertial { weight: mass, form: forms.of(forward), turning: Expr::int(0) });
                continue;
            }
            if i == 0 {
                forward.add(names[2].as_str(), &-&sym("body.mass_aside"));
            }
            sideways.add(names[2].as_str(), &offset);
            let omega = sym(&names[2]);
            let across = -&(&omega * &sideways.expr());
            let ahead = &omega * &forward.expr();
            found.push(Inertial { weight: mass.clone(), form: forms.of(forward), turning: across });
            found.push(Inertial { weight: mass, form: forms.of(sideways), turning: ahead });
            found.push(Inertial { weight: inertia, form: forms.of(turning), turning: Expr::int(0) });
        }
        for rate in rolling_rates(vehicle) {
            let row = Row::as_written(vec![(rate.clone(), Expr::int(1))]);
            let weight = Expr::sym(inertia_of(&unprimed(&rate)));
            found.push(Inertial { weight, form: forms.of(&row), turning: Expr::int(0) });
        }
        for angle in castors(vehicle) {
            let row = Row::as_written(vec![("phi'".into(), Expr::int(1)), (angle.rate(), Expr::int(1))]);
            let weight = Expr::sym(inertia_of(&angle));
            found.push(Inertial { weight, form: forms.of(&row), turning: Expr::int(0) });
        }
        let moves = |e: &Inertial| e.form.iter().any(|c| !c.value.is_zero());
        found.retain(moves);
        found
    }

    /// An entry of BᵀMB.
    fn define_mass(&self, energy: &[Inertial], j: usize, k: usize, d: &mut Definitions) -> Expr {
        let product = |e: &Inertial| times(&times(&e.weight, &e.form[j].value), &e.form[k].value);
        let entry = sum(energy.iter().map(product));
        if entry.is_zero() {
            return entry;
        }
        let name = format!("mass.entry_{}_{}", j + 1, k + 1);
        d.define(name.as_str(), entry);
        Expr::sym(name.as_str())
    }

    /// What the inputs do, and forces on the body and torques on the wheels that effects may add; by quasi-velocity.
    fn external(&self, forms: &mut RateForms, d: &mut Definitions) -> Vec<Vec<Expr>> {
        let mut push = vec![Vec::new(); forms.speeds.len()];
        let mut add = |force: &str, row: &Row, forms: &mut RateForms| {
            for (push, c) in push.iter_mut().zip(forms.of(row)) {
                push.push(times(&c.value, &Expr::sym(force)));
            }
        };
        let driven = |role: &str| match self.driven.iter().any(|f| f.role == role) {
            true => Expr::sym(role),
            false => Expr::int(0),
        };
        let mut centre = moving(0);
        if !self.model.vehicle.line {
            let (body, [_, _, offset]) = (section_heading(0), symbols(0));
            centre = centre.at_offset(&body, &Expr::sym(offset));
            centre = centre.at_offset(&body.left(), &Expr::sym("body.mass_aside"));
        }
        let body = section_heading(0);
        d.define("body.force_ahead", driven("force"));
        add("body.force_ahead", &centre.along(&body), forms);
        if !self.model.vehicle.line {
            d.define("body.force_aside", driven("lateral_force"));
            add("body.force_aside", &centre.along(&body.left()), forms);
            d.define("body.torque", driven("yaw_torque"));
            add("body.torque", &Row::as_written(vec![("phi'".into(), Expr::int(1))]), forms);
        }
        for i in 1..=self.model.trailers.len() {
            // Along the trailer, at its axle.
            let [name, drag] = ["force_ahead", "drag"].map(|what| format!("trailer_{i}.{what}"));
            let [mass, _, _] = symbols(i).map(Expr::sym);
            d.define(drag.as_str(), Expr::int(0));
            let braking = &(&Expr::sym(drag.as_str()) * &mass) * &Expr::sym(Symbol::new(&format!("v_{i}")));
            d.define(name.as_str(), -&braking);
            add(&name, &Row::as_written(vec![(Symbol::new(&format!("v_{i}")), Expr::int(1))]), forms);
        }
        for (i, Torque { rate, role, share }) in wheel_torques(&self.model.vehicle).into_iter().enumerate() {
            let [torque, loss, drag, rub] =
                ["torque", "wheel_loss", "wheel_drag", "wheel_rub"].map(|stem| format!("{stem}_{}", i + 1));
            d.define(drag.as_str(), Expr::int(0));
            d.define(rub.as_str(), Expr::int(0));
            d.define(loss.as_str(), self.lost_torque(&rate, [&drag, &rub]));
            let applied = times(&share, &driven(&role));
            d.define(torque.as_str(), &applied - &Expr::sym(loss.as_str()));
            add(&torque, &Row::as_written(vec![(rate, Expr::int(1))]), forms);
        }
        push
    }

    /// What the drive of a wheel loses: in proportion to its rate, as by a back-EMF, and by dry friction, each for the weight
    /// of the body at the radius of the wheel; dry friction is smooth within a hundredth of a metre per second.
    fn lost_torque(&self, rate: &Symbol, [drag, rub]: [&String; 2]) -> Expr {
        let wheels = &self.model.vehicle.wheels;
        let radius = wheels.iter().find(|w| w.rate.as_ref() == Some(rate)).and_then(|w| w.radius.clone());
        let formula = Expr::parse("body.mass*r*(drag*r*w + 9.81*rub*tanh(100*r*w))").unwrap_or_default();
        formula.substitute(&|s| match s.as_str() {
            "r" => radius.clone().map(Expr::sym),
            "w" => Some(Expr::sym(rate.clone())),
            "drag" => Some(Expr::sym(drag.as_str())),
            "rub" => Some(Expr::sym(rub.as_str())),
            _ => None,
        })
    }

    /// The force of a contact with a law, and what it does; its state where it has one.
    fn define_contact(
        &self,
        contact: &Contact,
        number: usize,
        forms: &mut RateForms,
        d: &mut Definitions,
        push: &mut [Vec<Expr>],
    ) -> Option<Symbol> {
        let (law, _) = contact.law.as_ref()?;
        let name = |what: &str| Law::symbol(what, number);
        let written = |formula: &Expr| {
            formula.substitute(&|s| match s.as_str() {
                "slip" | "speed" | "deflection" => Some(Expr::sym(name(s.as_str()))),
                other => law.parameters.iter().any(|p| p.name == other).then(|| Expr::sym(name(other))),
            })
        };
        d.define(name("slip"), contact.slip.expr());
        d.define(name("speed"), contact.speed.expr());
        let grip = self.grip(number);
        d.define(grip.clone(), Expr::int(1));
        let side = if contact.letter == 'R' { "drive_force" } else { "side_force" };
        let along = Symbol::new(&format!("{side}_{number}"));
        d.define(along.clone(), &Expr::sym(grip) * &written(&law.force));
        d.define(name("force"), Expr::sym(along));
        for (push, c) in push.iter_mut().zip(forms.of(&contact.slip)) {
            push.push(times(&c.value, &Expr::sym(name("force"))));
        }
        let rate = law.rate.as_ref()?;
        d.define(name("deflection").rate(), written(rate));
        Some(name("deflection"))
    }

    /// The factor on the force of a contact, by its place: `traction_1`, `grip_front_1`, `grip_rear_2`, `grip_trailer_1`.
    fn grip(&self, number: usize) -> Symbol {
        let of_body = self.contacts.len() - self.model.trailers.len();
        if number > of_body {
            return Symbol::new(&format!("grip_trailer_{}", number - of_body));
        }
        let contact = &self.contacts[number - 1];
        let stem = match contact.letter {
            'R' => "traction",
            _ if self.is_ahead(&contact.name) => "grip_front",
            _ => "grip_rear",
        };
        Symbol::new(&format!("{stem}_{number}"))
    }

    /// Whether the wheel of a contact stands ahead of the reference point.
    fn is_ahead(&self, contact: &str) -> bool {
        let wheel = self.model.vehicle.wheels.iter().find(|w| contact.starts_with(&super::contact::slug(&w.name)));
        wheel.is_some_and(|w| w.forward.eval_undefined_as_value(&|_| 1.0) > 0.0)
    }
}
