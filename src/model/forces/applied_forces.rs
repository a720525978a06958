//! Generalised active forces (Kane and Levinson, Dynamics: Theory and Applications, 4.4): drives, losses, contacts with a law.

use super::contact::Contact;
use super::description::Dynamics;
use super::driving_force::{Torque, wheel_torques};
use super::law::Law;
use super::masses::symbols;
use super::rate_forms::{RateForms, sum, times};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Definitions, Row};
use crate::model::constraints::{moving, section_heading};
use crate::model::forced_motion::PUSH;

impl Dynamics {
    /// What the inputs do, and forces on the body and torques on the wheels that effects may add; by quasi-velocity.
    pub(super) fn external(&self, forms: &mut RateForms, d: &mut Definitions) -> Vec<Vec<Expr>> {
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
            let transmitted = self.transmitted_torque(i + 1, &rate, &times(&share, &driven(&role)), d);
            d.define(torque.as_str(), &transmitted - &Expr::sym(loss.as_str()));
            add(&torque, &Row::as_written(vec![(rate, Expr::int(1))]), forms);
        }
        push
    }

    /// What the teeth of a gear pass on to a driven wheel of what its motor gives, and the impulse of the torque that would
    /// give the body a speed of one metre per second; nothing to a wheel that no motor drives.
    fn transmitted_torque(&self, number: usize, rate: &Symbol, given: &Expr, d: &mut Definitions) -> Expr {
        let Some(radius) = self.radius(rate).filter(|_| !given.is_zero()) else { return given.clone() };
        let name = |stem: &str| format!("{stem}_{number}");
        d.define(name("motor_torque").as_str(), given.clone());
        d.define(name("wheel_impulse").as_str(), &Expr::sym("body.mass") * &Expr::sym(radius));
        d.define(name("drive_torque").as_str(), Expr::sym(name("motor_torque").as_str()));
        Expr::sym(name("drive_torque").as_str())
    }

    fn radius(&self, rate: &Symbol) -> Option<Symbol> {
        let wheels = &self.model.vehicle.wheels;
        wheels.iter().find(|w| w.rate.as_ref() == Some(rate)).and_then(|w| w.radius.clone())
    }

    /// What the drive of a wheel loses: in proportion to its rate, as by a back-EMF, and by dry friction, each for the weight
    /// of the body at the radius of the wheel; dry friction is smooth within a hundredth of a metre per second.
    fn lost_torque(&self, rate: &Symbol, [drag, rub]: [&String; 2]) -> Expr {
        let radius = self.radius(rate);
        let formula = Expr::parse("body.mass*r*(drag*r*w + 9.81*rub*tanh(100*r*w))").unwrap_or_default();
        formula.substitute(&|s| match s.as_str() {
            "r" => radius.clone().map(Expr::sym),
            "w" => Some(Expr::sym(rate.clone())),
            "drag" => Some(Expr::sym(drag.as_str())),
            "rub" => Some(Expr::sym(rub.as_str())),
            _ => None,
        })
    }

    /// What pushes the body ahead, with side forces as their laws have them: the load that it moves may change what they are.
    pub(super) fn define_push(&self, forms: &RateForms, d: &mut Definitions, push: &[Vec<Expr>]) {
        let ahead = forms.speeds.iter().position(|s| s.as_str() == "body.u");
        let all = sum(ahead.into_iter().flat_map(|k| push[k].iter().cloned()));
        let by_law = |s: &Symbol| {
            let number: usize = s.as_str().strip_prefix("contact_")?.strip_suffix(".force")?.parse().ok()?;
            (self.contacts[number - 1].letter != 'R').then(|| Expr::sym(Law::symbol("law", number)))
        };
        d.define(PUSH, all.substitute(&by_law));
    }

    /// The force of a contact with a law, and what it does; its state where it has one.
    pub(super) fn define_contact(
        &self,
        contact: &Contact,
        number: usize,
        forms: &mut RateForms,
        d: &mut Definitions,
        push: &mut [Vec<Expr>],
    ) -> Option<Symbol> {
        let (law, _) = contact.law.as_ref()?;
        let name = |what: &str| Law::symbol(what, number);
        let written = |formula: &Expr| law.written(formula, number, &|slot| Expr::sym(name(slot)));
        d.define(name("slip"), contact.slip.expr());
        d.define(name("speed"), contact.speed.expr());
        let grip = self.grip(number);
        d.define(grip.clone(), Expr::int(1));
        d.define(name("law"), written(&law.force));
        let asked = &Expr::sym(grip) * &Expr::sym(name("law"));
        let along = match contact.letter {
            'R' => self.defined("drive_force", number, asked, d),
            // What a tyre without memory is asked for, what of it is built up, and what it holds of that.
            _ if law.rate.is_none() => {
                let asked = self.defined("asked_force", number, asked, d);
                let built = self.defined("built_force", number, Expr::sym(asked), d);
                self.defined("side_force", number, Expr::sym(built), d)
            }
            _ => self.defined("side_force", number, asked, d),
        };
        d.define(name("force"), Expr::sym(along));
        for (push, c) in push.iter_mut().zip(forms.of(&contact.slip)) {
            push.push(times(&c.value, &Expr::sym(name("force"))));
        }
        let rate = law.rate.as_ref()?;
        d.define(name("deflection").rate(), written(rate));
        Some(name("deflection"))
    }

    /// A quantity of a contact by its number.
    fn defined(&self, stem: &str, number: usize, formula: Expr, d: &mut Definitions) -> Symbol {
        let name = Symbol::new(&format!("{stem}_{number}"));
        d.define(name.clone(), formula);
        name
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
