//! The motion of a vehicle with coordinates of its own: its constraints solved for the rates that are not given.

use super::vehicle_model::Model;
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Constraint, Definitions, Printed, solve};

impl Model {
    /// Solves the constraints for the rates of coordinates that nothing defines; the pose follows from them.
    pub(super) fn solve_own(&self, d: &mut Definitions) -> Result<()> {
        if !self.trailers.is_empty() {
            let id = &self.vehicle.id;
            return Err(Error::input(format!("{id} has coordinates of its own and pulls no trailer"))
                .help("leave the trailers out"));
        }
        let left = self.solve_some(d)?;
        self.check(d, &left)
    }

    /// The motion by as many constraints as it takes, and those that are left over.
    pub(super) fn solve_some(&self, d: &mut Definitions) -> Result<Vec<Constraint>> {
        let mut unknown = self.unknown_rates();
        let mut left = self.constraints();
        while let Some((c, rate)) = single(&left, &unknown) {
            let solved = isolated(&left.remove(c), &rate).ok_or_else(|| self.free(&[], std::slice::from_ref(&rate)))?;
            unknown.retain(|r| *r != rate);
            d.define(rate, solved);
        }
        let rows: Vec<_> = left.iter().map(Constraint::row).collect();
        let solved = solve::together(&rows, &unknown).ok_or_else(|| self.free(&rows, &unknown))?;
        solved.into_iter().for_each(|(rate, f)| d.define(rate, f));
        self.define_pose(d);
        Ok(left)
    }

    /// The rates of its own coordinates that neither they themselves nor their rates are defined by inputs.
    fn unknown_rates(&self) -> Vec<Symbol> {
        let given = |q: &Symbol| self.vehicle.define.contains_key(q);
        let own = self.vehicle.coordinates.iter().map(|c| &c.name);
        own.filter(|q| !given(q) && !given(&q.rate())).map(Symbol::rate).collect()
    }

    /// v_l, v_t, x', y' and phi' by the coordinates that are a place and a heading; what is none does not move.
    fn define_pose(&self, d: &mut Definitions) {
        let text = |text: &str| Expr::parse(text).unwrap_or_else(|e| unreachable!("{e}"));
        match self.vehicle.stays() {
            true => ["v_l", "v_t", "x'", "y'"].into_iter().for_each(|name| d.define(name, Expr::int(0))),
            false => {
                d.define("v_l", text("x'*cos(phi) + y'*sin(phi)"));
                d.define("v_t", text("y'*cos(phi) - x'*sin(phi)"));
            }
        }
        match &self.vehicle.heading {
            Some(heading) if heading.as_str() != "phi" => {
                d.define("phi'", Expr::sym(heading.rate()));
                d.define(heading.clone(), text("phi"));
            }
            _ if d.get(&"phi'".into()).is_none() => d.define("phi'", Expr::int(0)),
            _ => {}
        }
    }

    /// Coordinates of its own whose rates alone are given and which its formulas speak of: they are carried along.
    pub(super) fn own_states(&self) -> Vec<Symbol> {
        if let Some(forced) = &self.forced {
            return forced.states.clone();
        }
        let vehicle = &self.vehicle;
        let is_pose = |q: &Symbol| ["x", "y", "phi"].contains(&q.as_str()) || vehicle.heading.as_ref() == Some(q);
        let rows: Vec<_> = vehicle.constraints.iter().map(Constraint::row).collect();
        let in_rows = |q: &Symbol| rows.iter().flat_map(|r| r.terms()).any(|(_, c)| c.mentions(q));
        let in_effects = |q: &Symbol| self.effects.iter().any(|e| e.effect.formulas().any(|f| f.mentions(q)));
        let own = vehicle.coordinates.iter().map(|c| c.name.clone());
        own.filter(|q| !is_pose(q) && !vehicle.define.contains_key(q) && (in_rows(q) || in_effects(q))).collect()
    }
}

/// A constraint in which one rate is not known, and that rate.
fn single(constraints: &[Constraint], unknown: &[Symbol]) -> Option<(usize, Symbol)> {
    constraints.iter().enumerate().find_map(|(i, c)| {
        let row = c.row();
        let mut found = row.rates().filter(|r| unknown.contains(r));
        let rate = found.next()?.clone();
        found.next().is_none().then_some((i, rate))
    })
}

/// A rate from its constraint, as short as the constraint is written.
fn isolated(c: &Constraint, rate: &Symbol) -> Option<Expr> {
    if c.kind().printed == Printed::Row {
        return solve::chained(&[c.row()], std::slice::from_ref(rate)).and_then(|s| s.into_iter().next()).map(|s| s.1);
    }
    let form = c.form.expr(&[], &c.creep);
    let row = c.row();
    // The form is linear: its value where one rate is 1 and the others are 0 is what multiplies that rate.
    let at = |one: bool| {
        form.substitute(&|s| match (s == rate, row.rates().any(|r| r == s)) {
            (true, _) => Some(Expr::int(i64::from(one))),
            (false, true) if one => Some(Expr::int(0)),
            _ => None,
        })
    };
    Some(&-&at(false) / &at(true))
}
