//! The observed quantities of a motion with forces: speeds, slips, energy and power.

use super::{Dynamics, Law};
use crate::error::{Error, Result};
use crate::formula::{Expr, Graph, NodeId, Program, Symbol};

/// Names and formulas of what is tabulated beside the pose.
#[derive(Clone, Debug)]
pub(super) struct Observed {
    pub names: Vec<String>,
    pub program: Program,
}

impl Observed {
    /// Speeds, rates of the wheels, slips and forces of the contacts, energy, power of the inputs and of friction.
    pub fn compile(dynamics: &Dynamics, graph: &mut Graph, slots: &[Symbol]) -> Result<Self> {
        let found = dynamics.observed();
        let nodes: Vec<NodeId> = found.iter().map(|(_, e)| graph.insert(e)).collect();
        let program = Program::compile(graph, slots, &nodes).map_err(undefined)?;
        Ok(Self { names: found.into_iter().map(|(name, _)| name).collect(), program })
    }
}

/// The error of a formula of the motion that uses a name without a definition.
pub(super) fn undefined(name: Symbol) -> Error {
    Error::input(format!("a formula of the motion uses {name}, which nothing defines"))
}

fn sum(parts: impl Iterator<Item = Expr>) -> Expr {
    parts.fold(Expr::int(0), |sum, e| &sum + &e)
}

impl Dynamics {
    fn observed(&self) -> Vec<(String, Expr)> {
        let [speed, lateral] = self.speeds();
        let yaw = if self.model.vehicle.line { Expr::int(0) } else { Expr::sym("phi'") };
        let mut found = vec![("speed".to_string(), speed), ("lateral_speed".into(), lateral), ("yaw_rate".into(), yaw)];
        found.extend(self.wheel_rates());
        for contact in &self.contacts {
            found.push((format!("slip.{}", contact.name), contact.slip.expr()));
        }
        let mut multiplier = 0;
        for (i, contact) in self.contacts.iter().enumerate() {
            let force = contact.force(i + 1).unwrap_or_else(|| {
                multiplier += 1;
                Expr::sym(Law::symbol("multiplier", multiplier))
            });
            found.push((format!("force.{}", contact.name), force));
        }
        found.push(("energy".into(), self.energy()));
        found.push(("input_power".into(), self.input_power()));
        found.push(("friction_power".into(), self.friction_power()));
        found
    }

    /// Rates of the wheels, by the names they are logged under where there are such.
    fn wheel_rates(&self) -> Vec<(String, Expr)> {
        let vehicle = &self.model.vehicle;
        let mut found: Vec<(String, Expr)> = Vec::new();
        for c in &self.mechanism.constraints {
            let Some(rate) = c.form.gives() else { continue };
            let inputs = vehicle.define.get(rate).map(|d| d.formula.symbols()).unwrap_or_default();
            let logged = inputs.iter().find(|s| vehicle.inputs.contains_key(s.as_str()));
            let name = logged.map_or(rate.as_str(), Symbol::as_str).to_string();
            let taken = found.iter().any(|(n, _)| *n == name);
            found.push((if taken { rate.to_string() } else { name }, Expr::sym(rate.clone())));
        }
        found
    }

    /// What the inputs deliver, W.
    pub fn input_power(&self) -> Expr {
        sum(self.driven.iter().map(|f| &Expr::sym(f.role.as_str()) * &f.along.expr()))
    }

    /// What the contacts with a law deliver, W: negative or zero for `viscous` and `rocard`; of `elastic` what the spring
    /// takes and gives as well.
    pub fn friction_power(&self) -> Expr {
        sum(self.contacts.iter().enumerate().filter_map(|(i, c)| Some(&c.force(i + 1)? * &c.slip.expr())))
    }
}
