//! The definitions of a model: constraints solved for the motion, effects applied.

use super::constraints::{direction, rolling, trailer_creep, trailer_direction, trailer_lengths};
use super::{Model, trailer_heading};
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Definitions, Heading, Row, Velocity, solve};

/// A formula of this file; a malformed one would be a fault of the program, seen by every test.
fn formula(text: &str) -> Expr {
    Expr::parse(text).unwrap_or_else(|e| unreachable!("{e}"))
}

impl Model {
    /// Every definition of the model, effects included.
    ///
    /// | name | meaning |
    /// |---|---|
    /// | v_d | forward speed that the wheels ask for |
    /// | v_l, v_t | forward and sideways speed of the reference point |
    /// | v_n | sideways speed that the direction constraints ask for |
    /// | x', y', phi', phi_1' … | rates of the coordinates |
    /// | x_m, y_m, heading_m | what the sensor measures |
    /// | delay | how far the inputs are looked up in the past |
    ///
    /// # Errors
    /// When the constraints do not determine the motion, or an effect does not apply.
    pub fn definitions(&self) -> Result<Definitions> {
        let mut d = self.ideal_definitions()?;
        let mut effects: Vec<_> = self.effects.iter().collect();
        effects.sort_by_key(|e| (e.effect.order, e.trailer));
        for applied in effects {
            let names: Vec<Symbol> = d.iter().map(|(n, _)| n.clone()).collect();
            let targets = applied.effect.targets(&names, applied.trailer);
            let targets = targets.ok_or_else(|| {
                Error::input(format!(
                    "the effect {} does not apply to the vehicle {}",
                    applied.label(),
                    self.vehicle.id
                ))
            })?;
            for (name, formula) in targets {
                let own =
                    applied.localised(&formula).substitute(&|s| (s.as_str() == "it").then(|| Expr::sym(name.clone())));
                d.rewrite(&name, &own);
            }
        }
        Ok(d)
    }

    /// The names an effect may rewrite.
    pub(super) fn definition_names(&self) -> Vec<Symbol> {
        let d = self.ideal_definitions();
        d.map(|d| d.iter().map(|(n, _)| n.clone()).collect()).unwrap_or_default()
    }

    fn ideal_definitions(&self) -> Result<Definitions> {
        let mut d = Definitions::default();
        self.define_vehicle(&mut d);
        self.solve_body(&mut d)?;
        for (name, text) in [
            ("v_l", "v_d"),
            ("v_t", "v_n"),
            ("x'", "v_l*cos(phi) - v_t*sin(phi)"),
            ("y'", "v_l*sin(phi) + v_t*cos(phi)"),
        ] {
            d.define(name, formula(text));
        }
        (1..=self.trailers.len()).try_for_each(|i| solve_trailer(i, &mut d))?;
        for (name, text) in [
            ("delay", "0"),
            ("lever_a", "sensor.a"),
            ("lever_b", "sensor.b"),
            ("heading_offset", "sensor.heading_offset"),
            ("x_m", "x + lever_a*cos(phi) - lever_b*sin(phi)"),
            ("y_m", "y + lever_a*sin(phi) + lever_b*cos(phi)"),
            ("heading_m", "phi + heading_offset"),
        ] {
            d.define(name, formula(text));
        }
        Ok(d)
    }

    /// Symbols of parameters, inputs and creep coefficients; an input that is logged otherwise is replaced.
    fn define_vehicle(&self, d: &mut Definitions) {
        let replaced = |s: &Symbol| {
            let input = self.vehicle.inputs.get(s.as_str())?;
            let logged = self.inputs.iter().any(|i| i == s.as_str());
            if logged { None } else { input.instead.as_ref().map(|i| i.formula.clone()) }
        };
        for (name, definition) in &self.vehicle.define {
            d.define(name.clone(), definition.formula.substitute(&replaced));
        }
        let creeps = self.vehicle.wheels.iter().flat_map(|w| [&w.rotation_creep, &w.traverse_creep]);
        creeps.flatten().for_each(|creep| d.define(creep.clone(), Expr::int(0)));
    }

    /// Solves the wheels' constraints for v_d, v_n and, where it is no input, phi'.
    fn solve_body(&self, d: &mut Definitions) -> Result<()> {
        let (body, yaw) = (Heading::along("phi"), Symbol::from("phi'"));
        let rows = |speed: &str| -> (Vec<Row>, Vec<Row>) {
            let reference = Velocity::in_body(speed, "v_n", &body);
            // Passive wheels, of unknown rate or angle, follow the motion and do not determine it.
            let known = |s: &Option<Symbol>| s.as_ref().is_none_or(|s| self.vehicle.define.contains_key(s));
            let wheels = || self.vehicle.wheels.iter().filter(|w| known(&w.steering));
            let r = wheels().filter(|w| known(&w.rate)).filter_map(|w| rolling(w, &reference, &body));
            let r = r.map(|c| c.row()).collect();
            let t = wheels().filter_map(|w| direction(w, &reference, &body)).map(|c| c.row()).collect();
            (r, t)
        };
        let undetermined = || Error::run(format!("the constraints of {} do not determine its motion", self.vehicle.id));
        let yaw_is_input = d.get(&yaw).is_some();
        let wanted = |names: &[&str]| -> Vec<Symbol> {
            let yaw = (!yaw_is_input).then(|| yaw.clone());
            names.iter().map(|n| Symbol::from(*n)).chain(yaw).collect()
        };
        // All rows together give the speed the wheels ask for.
        let (r, t) = rows("v_d");
        let together = solve::together(&[r, t].concat(), &wanted(&["v_d", "v_n"])).ok_or_else(undetermined)?;
        // The direction rows alone give the rest from v_l, where they can; an effect may make v_l a state.
        let (_, t) = rows("v_l");
        let directions = solve::chained(&t, &wanted(&["v_n"])).or_else(|| solve::chained(&t, &["v_n".into()]));
        let directions = directions.ok_or_else(undetermined)?;
        for (name, formula) in directions.into_iter().chain(together) {
            if d.get(&name).is_none() {
                d.define(name, formula);
            }
        }
        Ok(())
    }
}

/// Adds a trailer: its forward speed v_i, sideways speed vt_i and the rate of its heading.
fn solve_trailer(i: usize, d: &mut Definitions) -> Result<()> {
    let (length, hitch) = trailer_lengths(i);
    d.define(length, Expr::sym(Symbol::new(&format!("trailer_length_{i}"))));
    d.define(hitch.clone(), Expr::sym(Symbol::new(&format!("hitch_offset_{i}"))));
    d.define(trailer_creep(i), Expr::int(0));
    let (ahead, heading) = match i {
        1 => (["v_l".into(), "v_t".into()], Symbol::from("phi")),
        _ => ([format!("v_{}", i - 1), format!("vt_{}", i - 1)].map(|s| Symbol::new(&s)), trailer_heading(i - 1)),
    };
    let [forward, sideways] = ahead;
    let axle = super::constraints::behind(&Velocity::in_body(forward, sideways, &Heading::along(heading)), i);
    let rate = trailer_heading(i).rate();
    let row = trailer_direction(i, &axle).row();
    let solved = solve::chained(&[row], std::slice::from_ref(&rate));
    let solved = solved.ok_or_else(|| Error::run(format!("trailer {i} does not follow its hitch")))?;
    solved.into_iter().for_each(|(name, f)| d.define(name, f));
    let own = Heading::along(trailer_heading(i));
    d.define(Symbol::new(&format!("v_{i}")), axle.along(&own).expr());
    d.define(Symbol::new(&format!("vt_{i}")), formula(&format!("e_tc_{i}*v_{i}")));
    Ok(())
}
