//! The two generic constraint forms.

use super::{Heading, Row, Velocity};
use crate::formula::{Expr, Fun, Symbol};

/// A constraint of a mechanism: one of the two forms, with its name and its creep coefficient.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// What it constrains, such as "rear axle, direction".
    pub name: String,
    /// The form.
    pub form: Form,
    /// The symbol of the creep coefficient; zero is ideal.
    pub creep: Symbol,
}

/// The generic form of a constraint.
#[derive(Clone, Debug)]
pub enum Form {
    /// Type R, equation (13): rolling.
    R(Rolling),
    /// Type T, equation (20): direction.
    T(Direction),
}

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

    fn row(&self) -> Row {
        let mut row = self.pi.clone();
        row.add(self.rate.clone(), &-&self.sigma);
        row
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
}

impl Constraint {
    /// The row of the Pfaffian matrix: row·q̇ = 0.
    pub fn row(&self) -> Row {
        match &self.form {
            Form::R(rolling) => rolling.row(),
            Form::T(direction) => direction.row.clone(),
        }
    }

    /// The generic form as printed: π̇ − σ·q̇ or s·q̇₁ − p·q̇₃.
    pub fn generic(&self) -> Expr {
        match &self.form {
            Form::R(r) => &r.pi.expr() - &(&r.sigma * &Expr::sym(r.rate.clone())),
            Form::T(t) => &(&t.s * &t.q1.expr()) - &(&t.p * &t.q3.expr()),
        }
    }

    /// The row with no creep.
    pub fn ideal_row(&self) -> Row {
        self.row().substitute(&|s| (*s == self.creep).then(|| Expr::int(0)))
    }

    /// The constraint with names replaced in its coefficients; rates keep theirs.
    pub fn substitute(&self, by: &impl Fn(&Symbol) -> Option<Expr>) -> Self {
        let form = match &self.form {
            Form::R(r) => {
                Form::R(Rolling { pi: r.pi.substitute(by), sigma: r.sigma.substitute(by), rate: r.rate.clone() })
            }
            Form::T(t) => Form::T(Direction {
                s: t.s.substitute(by),
                p: t.p.substitute(by),
                q1: t.q1.substitute(by),
                q3: t.q3.substitute(by),
                row: t.row.substitute(by),
            }),
        };
        Self { form, ..self.clone() }
    }

    /// `R` or `T`.
    pub fn letter(&self) -> char {
        match self.form {
            Form::R(_) => 'R',
            Form::T(_) => 'T',
        }
    }
}

/// cot(ψ + arctan e), the closed form of σ off its singular set (E2).
pub fn sigma_closed_form(psi: &Expr, e: &Expr) -> Expr {
    Expr::call(Fun::Cot, &(psi + &Expr::call(Fun::Atan, e)))
}
