//! The forces and torques that drive a vehicle, by the inputs that give them.

use super::bodies::{Body, rolling_rates};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Heading, Row};
use crate::vehicles::Vehicle;

/// A force or torque by the power it delivers: force times a linear form in the rates.
#[derive(Clone, Debug)]
pub(crate) struct Force {
    /// Its name as an input.
    pub role: String,
    /// The rate at which it does work, for each unit of it.
    pub along: Row,
}

/// The roles of forces and torques that may drive a vehicle, with unit and meaning.
pub(crate) fn roles(vehicle: &Vehicle) -> Vec<(String, &'static str, &'static str)> {
    let mut found = vec![("force".to_string(), "N", "force along the body at its centre of mass")];
    if !vehicle.line {
        found.push(("lateral_force".into(), "N", "force to the left at the centre of mass"));
        found.push(("yaw_torque".into(), "N*m", "torque on the body about the vertical"));
    }
    for (role, _) in torques(vehicle) {
        found.push((role, "N*m", "torque on the wheel about its axle; shared by wheels that turn together"));
    }
    found
}

/// Torques by role, with the rates of the wheels they turn.
fn torques(vehicle: &Vehicle) -> Vec<(String, Vec<Symbol>)> {
    let mut found: Vec<(String, Vec<Symbol>)> = Vec::new();
    for rate in rolling_rates(vehicle) {
        let Some(definition) = vehicle.define.get(&rate) else { continue };
        let inputs = definition.formula.symbols();
        let input = inputs.iter().find(|s| vehicle.inputs.contains_key(s.as_str()));
        let Some(role) = input.map(|s| torque_for(s.as_str())) else { continue };
        match found.iter_mut().find(|(r, _)| *r == role) {
            Some((_, rates)) => rates.push(rate),
            None => found.push((role, vec![rate])),
        }
    }
    found
}

/// The torque on a wheel whose rate is logged by that name.
fn torque_for(rate: &str) -> String {
    if rate.contains("rate") { rate.replacen("rate", "torque", 1) } else { format!("{rate}_torque") }
}

/// A torque on a wheel about its axle.
#[derive(Clone, Debug)]
pub(super) struct Torque {
    /// The rate of the wheel.
    pub rate: Symbol,
    /// The input that gives it, if any.
    pub role: String,
    /// How much of the input falls on this wheel.
    pub share: Expr,
}

/// The torque of every wheel that rolls, driven or not.
pub(super) fn wheel_torques(vehicle: &Vehicle) -> Vec<Torque> {
    let shared = torques(vehicle);
    let of = |rate: Symbol| {
        let found = shared.iter().find(|(_, rates)| rates.contains(&rate));
        let (role, among) = found.map_or((String::new(), 1), |(role, rates)| (role.clone(), rates.len()));
        Torque { rate, role, share: &Expr::int(1) / &Expr::int(among as i64) }
    };
    rolling_rates(vehicle).into_iter().map(of).collect()
}

/// Every force that may drive a vehicle.
pub(super) fn forces(vehicle: &Vehicle, body: &Body) -> Vec<Force> {
    let [vx, vy] = &body.velocity;
    let heading = Heading::along("phi");
    let along = |direction: &Heading| match vehicle.line {
        true => vx.clone(),
        false => vx.times(&direction.cos_from(&Heading::x())).plus(&direction.cos_from(&Heading::y()), vy),
    };
    let turning = |rate: &Symbol, share: &Expr| {
        let mut row = Row::default();
        row.add(rate.clone(), share);
        row
    };
    let mut found = vec![Force { role: "force".into(), along: along(&heading) }];
    if !vehicle.line {
        found.push(Force { role: "lateral_force".into(), along: along(&heading.left()) });
        found.push(Force { role: "yaw_torque".into(), along: turning(&"phi'".into(), &Expr::int(1)) });
    }
    for (role, rates) in torques(vehicle) {
        let share = &Expr::int(1) / &Expr::int(rates.len() as i64);
        let all = rates.iter().fold(Row::default(), |sum, rate| sum.plus(&Expr::int(1), &turning(rate, &share)));
        found.push(Force { role, along: all });
    }
    found
}
