//! The blade of the sleigh: what the program derives of its one constraint, for several groups of claims.

use crate::claims::{DerivedFormulas, Outcome, Sampling, Statement, prove};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Form, Part};
use crate::model::mechanism;
use crate::vehicles;
use std::sync::LazyLock;

/// The form of the sleigh's one constraint, type T.
fn direction() -> Option<Form> {
    let sleigh = mechanism(vehicles::named("sleigh")?, 0);
    sleigh.constraints.into_iter().find(|c| c.letter() == 'T').map(|c| c.form)
}

pub(crate) fn formula(text: &str) -> Expr {
    Expr::parse(text).unwrap_or_else(|_| Expr::int(0))
}

/// Velocities of the sleigh in the world, its row g with creep and without, s, p and σ, and derivatives of all.
pub(crate) fn sleigh() -> DerivedFormulas {
    let velocities = DerivedFormulas::default()
        .with_text("x'", "v_l*cos(phi) - v_t*sin(phi)")
        .with_text("y'", "v_l*sin(phi) + v_t*cos(phi)");
    let Some(form) = direction() else { return velocities };
    let slot = |name: &str| form.slot(name).map(Part::expr).unwrap_or_default();
    let [s, p, sigma] = ["s", "p", "sigma"].map(slot);
    let creep = Symbol::from("e_tc");
    // The row of the program is e·v_l − v_t; the paper's (14) has the other sign.
    let g = form.expr(&[], &creep);
    let ideal = g.substitute(&|s| (*s == creep).then(|| Expr::int(0)));
    let by = |e: &Expr, name: &str| e.derivative(&name.into());
    velocities
        .with("g_phi", by(&g, "phi"))
        .with("g_e", by(&g, "e_tc"))
        .with("s_phi", by(&s, "phi"))
        .with("p_phi", by(&p, "phi"))
        .with("s_e", by(&s, "e_tc"))
        .with("p_e", by(&p, "e_tc"))
        .with("sigma_phi", by(&sigma, "phi"))
        .with("sigma_e", by(&sigma, "e_tc"))
        .with("sigma", sigma)
        .with("s", s)
        .with("p", p)
        .with("ideal", ideal)
        .with("g", g)
}

/// The row with x' and y' left free.
pub(crate) fn row() -> DerivedFormulas {
    let derived = sleigh();
    let keep = ["g", "g_phi", "g_e", "ideal", "s", "p", "sigma", "s_phi", "p_phi", "s_e", "p_e"];
    keep.iter().fold(DerivedFormulas::default(), |m, name| match derived.formula(name) {
        Some(f) => m.with(name, f.clone()),
        None => m,
    })
}

pub(crate) fn on_row(s: &Statement, _: &Sampling) -> Outcome {
    static DERIVED: LazyLock<DerivedFormulas> = LazyLock::new(row);
    prove(&DERIVED, s)
}

pub(crate) fn on_sleigh(s: &Statement, _: &Sampling) -> Outcome {
    static DERIVED: LazyLock<DerivedFormulas> = LazyLock::new(sleigh);
    prove(&DERIVED, s)
}
