//! Equations of motion with forces for claims: as formulas under the paper's letters, and as simulated runs.

use super::{DerivedFormulas, Outcome, Statement, prove};
use crate::dynamics::{Dynamics, Formulas, Masses};
use crate::error::Result;
use crate::formula::{Expr, Node, Symbol};
use crate::model::{Model, Trailer};
use crate::vehicles;

/// A vehicle of the catalogue with trailers, masses as symbols, every contact viscous, driven by forces.
pub fn viscous(vehicle: &str, trailers: usize, forces: &[&str]) -> Result<Dynamics> {
    all_by("viscous", &[1.0], vehicle, trailers, forces)
}

/// The same with ideal contacts.
pub fn ideal(vehicle: &str, trailers: usize, forces: &[&str]) -> Result<Dynamics> {
    let known = vehicles::named(vehicle).ok_or_else(|| crate::Error::run(format!("no vehicle is called {vehicle}")))?;
    let trailers = vec![Trailer { length: 1.0, hitch: 0.5 }; trailers];
    let masses = Masses { trailers: vec![Default::default(); trailers.len()], ..Masses::default() };
    Dynamics::new(&Model::sample(known)?.with_trailers(&trailers), &masses)?.driven_by(forces)
}

/// The same with one law for every contact.
pub fn all_by(law: &str, values: &[f64], vehicle: &str, trailers: usize, forces: &[&str]) -> Result<Dynamics> {
    ideal(vehicle, trailers, forces)?.with_laws(law, values)
}

/// A formula with the program's names replaced by the paper's letters.
pub fn lettered(e: &Expr, letters: &[(&str, &str)]) -> Expr {
    e.substitute(&|s: &Symbol| letters.iter().find(|(name, _)| *name == s.as_str()).map(|(_, l)| Expr::sym(*l)))
}

/// M·q̈ + h − Q of each coordinate, the forces of ideal contacts in Q as symbols.
pub fn residuals(f: &Formulas) -> Vec<Expr> {
    let n = f.coordinates.len();
    let inertial = |i: usize| {
        let terms = (0..n).map(|k| &f.mass[i][k] * &Expr::sym(f.coordinates[k].rate().rate()));
        terms.fold(f.bias[i].clone(), |sum, term| &sum + &term)
    };
    let held = |q: &Symbol| {
        let ideal = f.forces.iter().zip(&f.slips).filter(|(force, _)| matches!(force.node(), Node::Sym(_)));
        ideal.fold(Expr::int(0), |sum, (force, slip)| &sum + &(force * &slip.derivative(&q.rate())))
    };
    (0..n).map(|i| &(&inertial(i) - &f.force[i]) - &held(&f.coordinates[i])).collect()
}

/// The derivative of a formula along the motion: rates for coordinates, accelerations for rates.
pub fn along_motion(e: &Expr, coordinates: &[Symbol]) -> Expr {
    let moving = coordinates.iter().flat_map(|q| [q.clone(), q.rate()]);
    moving.fold(Expr::int(0), |sum, s| &sum + &(&e.derivative(&s) * &Expr::sym(s.rate())))
}

/// A check that puts what a statement says of some names into derived formulas and proves that formulas of it are zero.
pub fn vanishing(
    derived: DerivedFormulas,
    zero: Vec<Expr>,
) -> impl Fn(&Statement, &super::Sampling) -> Outcome + Send + Sync {
    move |statement, _| {
        let with = |m: DerivedFormulas, e: &super::Equation| m.with(&e.left.to_string(), e.right.clone());
        let said = statement.equations().iter().fold(derived.clone(), with);
        let nothing = zero.iter().map(|e| (e.clone(), Expr::int(0)));
        prove(&said, &Statement::of(nothing).in_brief())
    }
}

/// The formulas of a derivation, or none, about which every statement is undefined.
pub fn machine_of(build: impl FnOnce() -> Result<DerivedFormulas>) -> DerivedFormulas {
    build().unwrap_or_default()
}
