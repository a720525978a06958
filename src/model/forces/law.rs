//! Laws of contact: the force along a slip as a formula.

use crate::formula::{Expr, Symbol};
use std::sync::LazyLock;

/// A law of contact, as data: a force, and for a law with memory the rate of its state.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | `slip` | m/s | v_A of a rolling contact, v_t of a direction |
/// | `speed` | m/s | speed of the contact along the wheel |
/// | `deflection` | m | the state of a law that has one |
/// | the law's parameters | | their values |
///
/// ```
/// let viscous = creepage::dynamics::laws().iter().find(|l| l.id == "viscous").unwrap();
/// assert_eq!(viscous.force.to_string(), "-coefficient*slip");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// Its name in model files.
    pub id: String,
    /// What it says.
    pub says: String,
    /// Where it stands.
    pub source: String,
    /// What it needs to know.
    pub parameters: Vec<LawParameter>,
    /// The force along the slip, N.
    pub force: Expr,
    /// The rate of `deflection`, m/s, of a law with memory.
    pub rate: Option<Expr>,
}

/// A number that a law needs; it must be greater than zero.
#[derive(Clone, Debug, PartialEq)]
pub struct LawParameter {
    /// Its key in model files.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// Meaning.
    pub meaning: String,
}

struct Line {
    id: &'static str,
    says: &'static str,
    source: &'static str,
    parameters: &'static [(&'static str, &'static str, &'static str)],
    force: &'static str,
    rate: Option<&'static str>,
}

const STIFFNESS: (&str, &str, &str) = ("stiffness", "N", "force for each radian of creep angle, k_r");

const LINES: [Line; 3] = [
    Line {
        id: "viscous",
        says: "f = −b·slip",
        source: "(11), (18)",
        parameters: &[("coefficient", "N*s/m", "b_R or b_T")],
        force: "-coefficient*slip",
        rate: None,
    },
    Line {
        id: "rocard",
        says: "f = −k_r·slip/|speed|: k_r times the creep angle; undefined at rest",
        source: "(2)",
        parameters: &[STIFFNESS],
        force: "-stiffness*slip/abs(speed)",
        rate: None,
    },
    Line {
        id: "elastic",
        says: "f = k_r·k_g·x_c and x_c' = −slip − k_g·|speed|·x_c with k_g = 1/relaxation_length",
        source: "(1)–(2), errata E13–E14",
        parameters: &[STIFFNESS, ("relaxation_length", "m", "1/k_g, over which a deflection fades")],
        force: "stiffness/relaxation_length*deflection",
        rate: Some("-slip - abs(speed)/relaxation_length*deflection"),
    },
];

static LAWS: LazyLock<Vec<Law>> = LazyLock::new(|| LINES.iter().map(law).collect());

/// Every law of contact but the ideal one, which is a constraint.
///
/// ```
/// let ids: Vec<&str> = creepage::dynamics::laws().iter().map(|l| l.id.as_str()).collect();
/// assert_eq!(ids, ["viscous", "rocard", "elastic"]);
/// ```
pub fn laws() -> &'static [Law] {
    &LAWS
}

fn law(line: &Line) -> Law {
    // The table is part of the program; a test reads all of it.
    let parse = |text: &str| Expr::parse(text).unwrap_or_else(|e| unreachable!("{e}"));
    let parameter = |(name, unit, meaning): &(&str, &str, &str)| LawParameter {
        name: (*name).into(),
        unit: (*unit).into(),
        meaning: (*meaning).into(),
    };
    Law {
        id: line.id.into(),
        says: line.says.into(),
        source: line.source.into(),
        parameters: line.parameters.iter().map(parameter).collect(),
        force: parse(line.force),
        rate: line.rate.map(parse),
    }
}

impl Law {
    /// The symbol of a name of the law at the n-th contact, counted from one.
    pub(crate) fn symbol(name: &str, contact: usize) -> Symbol {
        Symbol::new(&format!("contact_{contact}.{name}"))
    }

    /// A formula of the law at the n-th contact, with what its slip, speed and deflection are there.
    pub(super) fn written(&self, formula: &Expr, contact: usize, by: &dyn Fn(&str) -> Expr) -> Expr {
        formula.substitute(&|s| match s.as_str() {
            name @ ("slip" | "speed" | "deflection") => Some(by(name)),
            name => self.parameters.iter().any(|p| p.name == name).then(|| Expr::sym(Self::symbol(name, contact))),
        })
    }
}
