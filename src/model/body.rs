//! The motion of the body and of what follows it, from the wheels' constraints.

use super::Model;
use super::constraints::{direction, rolling};
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Constraint, Definitions, Heading, Sample, Velocity, solve};
use crate::vehicles::Wheel;

/// Points at which rows that are left over must vanish; they are analytic, so that one point is as good as proof
/// but for rounding and bad luck.
const POINTS: u32 = 5;

impl Model {
    /// Solves the wheels' constraints for v_d, v_n and, where it is known otherwise, phi'.
    pub(super) fn solve_body(&self, d: &mut Definitions) -> Result<()> {
        if self.vehicle.line {
            if !self.trailers.is_empty() {
                return Err(Error::input(format!("{} moves along a line and pulls no trailer", self.vehicle.id))
                    .help("leave the trailers out"));
            }
            // A line has no sideways motion and no yaw.
            ["v_n", "phi'"].into_iter().for_each(|name| d.define(name, Expr::int(0)));
        }
        let wanted = |names: &[&str]| -> Vec<Symbol> {
            let names = names.iter().copied().chain(["phi'"]).map(Symbol::from);
            names.filter(|n| d.get(n).is_none()).collect()
        };
        let row = |c: &Constraint| c.row().without(&|rate| d.get(rate).is_some_and(Expr::is_zero));
        let rows = |speed: &str| -> (Vec<_>, Vec<_>) {
            let (r, t) = self.body_constraints(speed);
            (r.iter().map(row).collect(), t.iter().map(row).collect())
        };
        // All rows together give the speed the wheels ask for.
        let (r, t) = rows("v_d");
        let together = solve::together(&[r, t].concat(), &wanted(&["v_d", "v_n"])).ok_or_else(|| self.free())?;
        // The direction rows alone give the rest from v_l, where they can; an effect may make v_l a state. Where none
        // may, v_l may vanish while the vehicle moves sideways, and says nothing of the rest.
        let mut found = Vec::new();
        if !self.vehicle.holds(&"v_l".into()) {
            let (_, t) = rows("v_l");
            let directions = solve::chained(&t, &wanted(&["v_n"])).or_else(|| solve::chained(&t, &["v_n".into()]));
            found = directions.unwrap_or_default();
        }
        for (name, formula) in found.into_iter().chain(together) {
            if d.get(&name).is_none() {
                d.define(name, formula);
            }
        }
        Ok(())
    }

    /// The rolling and the direction constraints of the wheels that are measured, in v_n, phi' and a forward speed.
    fn body_constraints(&self, speed: &str) -> (Vec<Constraint>, Vec<Constraint>) {
        let body = Heading::along("phi");
        let reference = match self.vehicle.line {
            true => Velocity::along_line(speed, &body),
            false => Velocity::in_body(speed, "v_n", &body),
        };
        // Passive wheels, of unknown rate or angle, follow the motion and do not determine it.
        let known = |s: &Option<Symbol>| s.as_ref().is_none_or(|s| !self.vehicle.is_free(s));
        let wheels = || self.vehicle.wheels.iter().filter(|w| known(&w.steering));
        let r = wheels().filter(|w| known(&w.rate)).filter_map(|w| rolling(w, &reference, &body));
        let t = wheels().filter_map(|w| direction(w, &reference, &body));
        (r.collect(), t.chain(self.vehicle.constraints.iter().map(|c| in_body(c, speed))).collect())
    }

    /// That the rows which were not needed for the solution vanish with it, whatever the inputs and the coefficients.
    pub(super) fn check_rows(&self, d: &Definitions) -> Result<()> {
        let free = d.without(&|name| self.vehicle.creeps().any(|creep| creep == name));
        let (r, t) = self.body_constraints("v_d");
        let holds =
            |c: &&Constraint| (0..POINTS).all(|k| Sample::of(&free, k).is_some_and(|s| s.annihilates(&c.row())));
        let broken: Vec<String> = r.iter().chain(&t).filter(|c| !holds(c)).map(|c| c.name.clone()).collect();
        match broken.is_empty() {
            true => Ok(()),
            false => Err(self.unmoved("contradict each other for general inputs")),
        }
    }

    pub(super) fn free(&self) -> Error {
        self.unmoved("do not determine its motion by themselves")
    }

    pub(super) fn unmoved(&self, why: &str) -> Error {
        let error = Error::input(format!("the constraints of {} {why}", self.vehicle.id));
        match &self.vehicle.instead {
            Some(advice) => error.help(advice.clone()),
            None => error.help("`creepage describe` shows them"),
        }
    }

    /// Solves the constraints of castors and of wheels that turn freely for their rates, from the motion as it is.
    pub(super) fn solve_passive(&self, d: &mut Definitions) -> Result<()> {
        let body = Heading::along("phi");
        let reference = Velocity::in_body("v_l", "v_t", &body);
        for wheel in &self.vehicle.wheels {
            let unknown = self.free_rates(wheel);
            if unknown.is_empty() {
                continue;
            }
            // The direction of a wheel on a fixed or steered axis is one of the rows that were solved.
            let castor = wheel.steering.as_ref().is_some_and(|s| self.vehicle.is_free(s));
            let t = direction(wheel, &reference, &body).filter(|_| castor);
            let rows: Vec<_> = t.into_iter().chain(rolling(wheel, &reference, &body)).map(|c| c.row()).collect();
            let solved = solve::together(&rows, &unknown);
            let solved = solved.ok_or_else(|| self.unmoved(&format!("do not say what the {} does", wheel.name)))?;
            solved.into_iter().for_each(|(name, f)| d.define(name, f));
        }
        Ok(())
    }

    /// The rates of a wheel that nothing defines.
    fn free_rates(&self, wheel: &Wheel) -> Vec<Symbol> {
        let turning = wheel.steering.iter().filter(|s| self.vehicle.is_free(s)).map(Symbol::rate);
        turning.chain(wheel.rate.clone().filter(|s| self.vehicle.is_free(s))).collect()
    }
}

/// A constraint in the world's rates with the reference point moving at a forward speed and at v_n to the left.
fn in_body(c: &Constraint, speed: &str) -> Constraint {
    let along = |axis: Heading| Velocity::in_body(speed, "v_n", &Heading::along("phi")).along(&axis);
    c.with_rates(&|rate| match rate.as_str() {
        "x'" => Some(along(Heading::x())),
        "y'" => Some(along(Heading::y())),
        _ => None,
    })
}
