//! The kinetic energy of bodies and wheels as a sum of squares of rates, and the mass matrix BᵀMB that follows.

use super::bodies::{castors, rolling_rates, unprimed};
use super::description::Dynamics;
use super::masses::{inertia_of, symbols};
use super::rate_forms::{Coefficient, RateForms, sum, times};
use crate::formula::Expr;
use crate::mechanism::{Definitions, Row};
use crate::model::trailer::trailer_heading;

/// A part of the kinetic energy, ½·weight·form².
pub(super) struct Inertial {
    pub weight: Expr,
    pub form: Vec<Coefficient>,
    /// What the turning of the axes adds to the rate of the form: −ω·w forward, ω·u sideways.
    pub turning: Expr,
}

impl Dynamics {
    /// The kinetic energy as a sum of squares.
    pub(super) fn inertial(&self, forms: &mut RateForms) -> Vec<Inertial> {
        let sym = |s: &str| Expr::sym(s);
        let vehicle = &self.model.vehicle;
        let mut found = Vec::new();
        for i in 0..=self.model.trailers.len() {
            let [mass, inertia, offset] = symbols(i).map(Expr::sym);
            let names = match i {
                0 => ["v_l".to_string(), "v_t".to_string(), "phi'".to_string()],
                _ => [format!("v_{i}"), format!("vt_{i}"), trailer_heading(i).rate().to_string()],
            };
            let mut row = [0, 1, 2].map(|k| {
                let mut row = Row::default();
                row.add(names[k].as_str(), &Expr::int(1));
                row
            });
            let [forward, sideways, turning] = &mut row;
            if vehicle.line {
                found.push(Inertial { weight: mass, form: forms.of(forward), turning: Expr::int(0) });
                continue;
            }
            if i == 0 {
                forward.add(names[2].as_str(), &-&sym("body.mass_aside"));
            }
            sideways.add(names[2].as_str(), &offset);
            let omega = sym(&names[2]);
            let across = -&(&omega * &sideways.expr());
            let ahead = &omega * &forward.expr();
            found.push(Inertial { weight: mass.clone(), form: forms.of(forward), turning: across });
            found.push(Inertial { weight: mass, form: forms.of(sideways), turning: ahead });
            found.push(Inertial { weight: inertia, form: forms.of(turning), turning: Expr::int(0) });
        }
        for rate in rolling_rates(vehicle) {
            let row = Row::as_written(vec![(rate.clone(), Expr::int(1))]);
            let weight = Expr::sym(inertia_of(&unprimed(&rate)));
            found.push(Inertial { weight, form: forms.of(&row), turning: Expr::int(0) });
        }
        for angle in castors(vehicle) {
            let row = Row::as_written(vec![("phi'".into(), Expr::int(1)), (angle.rate(), Expr::int(1))]);
            let weight = Expr::sym(inertia_of(&angle));
            found.push(Inertial { weight, form: forms.of(&row), turning: Expr::int(0) });
        }
        let moves = |e: &Inertial| e.form.iter().any(|c| !c.value.is_zero());
        found.retain(moves);
        found
    }

    /// An entry of BᵀMB.
    pub(super) fn define_mass(&self, energy: &[Inertial], j: usize, k: usize, d: &mut Definitions) -> Expr {
        let product = |e: &Inertial| times(&times(&e.weight, &e.form[j].value), &e.form[k].value);
        let entry = sum(energy.iter().map(product));
        if entry.is_zero() {
            return entry;
        }
        let name = format!("mass.entry_{}_{}", j + 1, k + 1);
        d.define(name.as_str(), entry);
        Expr::sym(name.as_str())
    }
}
