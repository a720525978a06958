//! The blade of the sleigh: what the program derives of its one constraint, for several groups of claims.

use crate::claims::{Machine, Outcome, Sampling, Statement, prove};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Direction, Form};
use crate::model::mechanism;
use crate::vehicles;
use std::sync::LazyLock;

/// The sleigh's one constraint, type T.
fn direction() -> Option<Direction> {
    let sleigh = mechanism(vehicles::named("sleigh")?, 0);
    sleigh.constraints.into_iter().find_map(|c| match c.form {
        Form::T(t) => Some(t),
        Form::R(_) => None,
    })
}

pub(super) fn formula(text: &str) -> Expr {
    Expr::parse(text).unwrap_or_else(|_| Expr::int(0))
}

/// Velocities of the sleigh in the world, its row g with creep and without, s, p and σ, and derivatives of all.
pub(super) fn sleigh() -> Machine {
    let velocities = Machine::default()
        .with_text("x'", "v_l*cos(phi) - v_t*sin(phi)")
        .with_text("y'", "v_l*sin(phi) + v_t*cos(phi)");
    let Some(t) = direction() else { return velocities };
    let creep = Symbol::from("e_tc");
    // The row of the program is e·v_l − v_t; the paper's (14) has the other sign.
    let g = &(&t.s * &t.q1.expr()) - &(&t.p * &t.q3.expr());
    let ideal = g.substitute(&|s| (*s == creep).then(|| Expr::int(0)));
    let by = |e: &Expr, name: &str| e.derivative(&name.into());
    velocities
        .with("g_phi", by(&g, "phi"))
        .with("g_e", by(&g, "e_tc"))
        .with("s_phi", by(&t.s, "phi"))
        .with("p_phi", by(&t.p, "phi"))
        .with("s_e", by(&t.s, "e_tc"))
        .with("p_e", by(&t.p, "e_tc"))
        .with("sigma_phi", by(&t.sigma(), "phi"))
        .with("sigma_e", by(&t.sigma(), "e_tc"))
        .with("sigma", t.sigma())
        .with("s", t.s)
        .with("p", t.p)
        .with("ideal", ideal)
        .with("g", g)
}

/// The row with x' and y' left free.
pub(super) fn row() -> Machine {
    let machine = sleigh();
    let keep = ["g", "g_phi", "g_e", "ideal", "s", "p", "sigma", "s_phi", "p_phi", "s_e", "p_e"];
    keep.iter().fold(Machine::default(), |m, name| match machine.formula(name) {
        Some(f) => m.with(name, f.clone()),
        None => m,
    })
}

pub(super) fn on_row(s: &Statement, _: &Sampling) -> Outcome {
    static MACHINE: LazyLock<Machine> = LazyLock::new(row);
    prove(&MACHINE, s)
}

pub(super) fn on_sleigh(s: &Statement, _: &Sampling) -> Outcome {
    static MACHINE: LazyLock<Machine> = LazyLock::new(sleigh);
    prove(&MACHINE, s)
}
