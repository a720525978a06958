//! The contact of a wheel with the ground: the terms it puts in the slots of the two generic forms, (13) and (20).

use super::{Constraint, ConstraintType, Form, Heading, Part, Row, Velocity};
use crate::formula::{Expr, Fun, Symbol};

/// π̇ − σ(e)·q̇ = 0 with σ = r(1 − e).
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | π̇ | m/s | quasi-velocity: speed of the contact along the wheel |
/// | σ | m | rolling radius |
/// | q̇ | rad/s | rate of the wheel |
///
/// Defined everywhere. Source: equations (8), (13), (24).
#[derive(Clone, Debug)]
pub struct Rolling {
    /// The quasi-velocity as a linear form in the rates.
    pub pi: Row,
    /// σ(e).
    pub sigma: Expr,
    /// q̇.
    pub rate: Symbol,
}

/// s·q̇₁ − p·q̇₃ = 0 with s = sin ψ + e·cos ψ, p = cos ψ − e·sin ψ, σ = p/s.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | q̇₁, q̇₃ | m/s | velocity of the contact along x and y |
/// | ψ | rad | heading of the wheel |
/// | e | 1 | coefficient of traverse creep, v_t/v_l of the contact |
///
/// The row is regular for every ψ and e, since s² + p² = 1 + e²; σ itself is undefined where s = 0.
/// Source: equations (20)–(21), with E1–E3 of the errata.
#[derive(Clone, Debug)]
pub struct Direction {
    /// sin ψ + e·cos ψ
    pub s: Expr,
    /// cos ψ − e·sin ψ
    pub p: Expr,
    /// q̇₁: velocity of the contact along x.
    pub q1: Row,
    /// q̇₃: velocity of the contact along y.
    pub q3: Row,
    /// s·q̇₁ − p·q̇₃ with the sines and cosines of sums collected.
    row: Row,
}

impl Rolling {
    /// A wheel of radius `radius` turning at `rate` whose contact moves with `contact` along `heading`.
    pub fn new(contact: &Velocity, heading: &Heading, radius: &Expr, rate: &Symbol, creep: &Expr) -> Self {
        let sigma = radius * &(&Expr::int(1) - creep);
        Self { pi: contact.along(heading), sigma, rate: rate.clone() }
    }

    /// The same with rollers on the rim, a Swedish wheel: the contact is free across the axis of the roller it stands on,
    /// and what is left is its speed along that axis, π̇·cos γ = (v cos γ + w sin γ) = r(1 − e)·θ̇·cos γ.
    ///
    /// | symbol | unit | meaning |
    /// |---|---|---|
    /// | v, w | m/s | speed of the contact along the wheel and to its left |
    /// | γ | rad | angle from the wheel's heading to the axis of the roller |
    /// | π̇ | m/s | v + w·tan γ, the quasi-velocity |
    ///
    /// At γ = 0 the rolling of any wheel; undefined for γ = ±π/2, where a wheel drives nothing. Source: Campion, Bastin and
    /// d'Andréa-Novel 1996, the Swedish wheel; Lynch and Park 2017, chapter 13, omnidirectional wheels.
    ///
    /// ```
    /// use creepage::formula::Expr;
    /// use creepage::mechanism::{Heading, Rolling, Velocity};
    /// let (body, contact) = (Heading::along("phi"), Velocity::in_body("v", "w", &Heading::along("phi")));
    /// let wheel = Rolling::new(&contact, &body, &Expr::sym("r"), &"theta'".into(), &Expr::sym("e"));
    /// let mecanum = wheel.over_rollers(&contact, &body, &Expr::parse("-pi/4").unwrap());
    /// assert_eq!(mecanum.pi.to_string(), "v - w");
    /// ```
    pub fn over_rollers(self, contact: &Velocity, heading: &Heading, angle: &Expr) -> Self {
        Self { pi: self.pi.plus(&tangent(angle), &contact.along(&heading.left())), ..self }
    }

    /// The constraint of this form.
    pub fn constraint(self, name: &str, creep: &Symbol) -> Constraint {
        let mut row = self.pi.clone();
        row.add(self.rate.clone(), &-&self.sigma);
        let q = Part::rate(&self.rate);
        let slots = [("pi'", Part::Rates(self.pi)), ("sigma", Part::Factor(self.sigma)), ("q'", q)];
        filled("rolling", slots, row, name, creep)
    }
}

impl Direction {
    /// A contact moving with `contact` on a wheel of direction `heading`.
    pub fn new(contact: &Velocity, heading: &Heading, creep: &Expr) -> Self {
        let (cos, sin) = (heading.cos_from(&Heading::x()), heading.cos_from(&Heading::y()));
        // e·(forward component) − (component to the left): the same form, written with angle sums.
        let row = contact.along(heading).times(creep).plus(&Expr::int(-1), &contact.along(&heading.left()));
        Self {
            s: &sin + &(creep * &cos),
            p: &cos - &(creep * &sin),
            q1: contact.along(&Heading::x()),
            q3: contact.along(&Heading::y()),
            row,
        }
    }

    /// σ = p/s, undefined where the wheel's course is along x.
    pub fn sigma(&self) -> Expr {
        &self.p / &self.s
    }

    /// The constraint of this form.
    pub fn constraint(self, name: &str, creep: &Symbol) -> Constraint {
        let [s, p] = [self.s, self.p].map(Part::Factor);
        let [q1, q3] = [self.q1, self.q3].map(Part::Rates);
        filled("direction", [("s", s), ("q1'", q1), ("p", p), ("q3'", q3)], self.row, name, creep)
    }
}

/// A constraint of the catalogue's types with its slots filled in and its row.
fn filled<const N: usize>(id: &str, slots: [(&str, Part); N], row: Row, name: &str, creep: &Symbol) -> Constraint {
    let slots = slots.map(|(name, part)| (Symbol::new(name), part));
    let form = ConstraintType::named(id).and_then(|kind| Form::with_row(&kind, &slots, creep, row));
    // The slots are those of the catalogue, which is part of the program; every vehicle goes through here.
    Constraint { name: name.into(), form: form.unwrap_or_else(|e| unreachable!("{e}")), creep: creep.clone() }
}

/// The symbol that stands for the half of a whole turn in the angle of a roller.
const PI: &str = "pi";
/// A tangent this near to -1, 0 or 1 is that number: angles are sums of parts of π, rounded once.
const ROUNDING: f64 = 1e-12;

/// The tangent of an angle: -1, 0 or 1 where it is that, and π as 4·arctan 1, for which formulas have no name.
pub(crate) fn tangent(angle: &Expr) -> Expr {
    let pi = &Expr::int(4) * &Expr::call(Fun::Atan, &Expr::int(1));
    let angle = angle.substitute(&|s| (s.as_str() == PI).then(|| pi.clone()));
    let value = angle.eval(&|_| f64::NAN).map(f64::tan);
    match value.filter(|t| t.abs() < 1.0 + ROUNDING && (t - t.round()).abs() < ROUNDING) {
        Some(t) => Expr::int(t.round() as i64),
        None => Expr::call(Fun::Tan, &angle),
    }
}

/// cot(ψ + arctan e), the closed form of σ off its singular set (E2).
pub fn sigma_closed_form(psi: &Expr, e: &Expr) -> Expr {
    Expr::call(Fun::Cot, &(psi + &Expr::call(Fun::Atan, e)))
}
