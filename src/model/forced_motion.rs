//! The motion under forces as definitions: states, formulas and values that stand beside those of the vehicle.

use crate::formula::{Expr, Symbol};
use crate::mechanism::Definitions;
use crate::vehicles::Vehicle;
use std::collections::BTreeMap;

/// The equations of motion of a vehicle with forces, lowered into definitions.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | `body.u`, `body.w`, `body.omega` | m/s, rad/s | forward and sideways speed and yaw rate, where the ideal contacts leave them free |
/// | `trailer_1.omega`, `theta.omega` | rad/s | the rates of a trailer's heading, of a wheel |
/// | `contact_1.deflection` | m | the state of a law of contact |
#[derive(Clone, Debug, Default)]
pub struct ForcedMotion {
    /// The vehicle whose inputs say how it moves, and those inputs.
    pub(crate) kinematic: (Vehicle, Vec<String>),
    /// Speeds that are free at the start of every window, the first of the states.
    pub(crate) nodes: Vec<Symbol>,
    /// The states behind the pose, each with a definition of its rate.
    pub(crate) states: Vec<Symbol>,
    /// The quasi-velocities among them.
    pub(crate) speeds: Vec<Symbol>,
    /// Every formula of the motion.
    pub(crate) definitions: Definitions,
    /// Values of the symbols that a model file states.
    pub(crate) values: BTreeMap<Symbol, f64>,
    /// Losses that are none where their coefficients vanish, whatever stands beside them.
    pub(crate) losses: Vec<(Symbol, [Symbol; 2])>,
    /// Angles that the inputs give, of which the motion asks the rate.
    pub(crate) turned: Vec<Symbol>,
}

impl ForcedMotion {
    /// Takes away what no effect asks for: losses whose coefficients are zero, and the push by which load would move.
    pub(crate) fn without_idle_parts(&self, d: &mut Definitions) {
        for (loss, coefficients) in &self.losses {
            if coefficients.iter().all(|c| d.get(c).is_none_or(Expr::is_zero)) {
                d.define(loss.clone(), Expr::int(0));
            }
        }
        let push = Symbol::new(PUSH);
        if !d.iter().any(|(_, formula)| formula.mentions(&push)) {
            d.define(push, Expr::int(0));
        }
    }

    /// The same with these speeds free at the start of every window.
    pub(crate) fn with_nodes(mut self, nodes: Vec<Symbol>) -> Self {
        self.states.retain(|s| !nodes.contains(s));
        self.states.splice(0..0, nodes.iter().cloned());
        self.nodes = nodes;
        self
    }
}

/// What pushes the body ahead.
pub(crate) const PUSH: &str = "body.push";

/// Before the name of a value as the model file states it.
pub(crate) const STATED: &str = "stated.";

/// The symbol of a value as the model file states it; the definition of the bare name may be rewritten by an effect.
pub(crate) fn stated(name: &Symbol) -> Symbol {
    Symbol::new(&format!("{STATED}{name}"))
}
