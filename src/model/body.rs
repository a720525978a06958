//! The motion of the body and of what follows it, solved from the wheels' constraints.

use super::constraints::{
    bodies, direction, in_body, moving, rolling, section_heading, sideways, trailer_creep, trailer_direction,
    trailer_lengths,
};
use super::trailer::trailer_heading;
use super::vehicle_model::Model;
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Constraint, Definitions, Row, Sample, Velocity, solve};
use crate::vehicles::Wheel;

/// Points at which rows that are left over must vanish; they are analytic, so that one point is as good as proof
/// but for rounding and bad luck.
const TEST_POINTS: u32 = 5;

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
        let unknown =
            |names: &[Symbol]| -> Vec<Symbol> { names.iter().filter(|n| d.get(n).is_none()).cloned().collect() };
        let row = |c: &Constraint| c.row().without(&|rate| d.get(rate).is_some_and(Expr::is_zero));
        // All rows together give the speed the wheels ask for, those of driven trailers among them.
        let driven = self.driven_trailers();
        let mut wanted: Vec<Symbol> = ["v_d", "v_n", "phi'"].map(Symbol::from).to_vec();
        wanted.extend((1..=driven).map(|i| trailer_heading(i).rate()));
        let wanted = unknown(&wanted);
        let (r, t) = self.rows("v_d", driven);
        let rows: Vec<_> = r.iter().chain(&t).map(row).collect();
        let together = match driven {
            0 => solve::together(&rows, &wanted),
            _ => self.pushed(&unknown(&["v_n".into(), "phi'".into()]), driven, &row),
        };
        let together = together.ok_or_else(|| self.free(&rows, &wanted))?;
        // The direction rows of the body alone give the rest from v_l, where they can; an effect may make v_l a state.
        // Where none may, v_l may vanish while the vehicle moves sideways, and says nothing of the rest.
        let mut found = Vec::new();
        if !self.vehicle.holds(&"v_l".into()) {
            let t: Vec<_> = self.rows("v_l", 0).1.iter().map(row).collect();
            let directions = solve::chained(&t, &unknown(&["v_n".into(), "phi'".into()]));
            found = directions.or_else(|| solve::chained(&t, &["v_n".into()])).unwrap_or_default();
        }
        // The trailers' own rates follow from the motion as it is, effects included.
        let of_body = together.into_iter().filter(|(name, _)| ["v_d", "v_n", "phi'"].contains(&name.as_str()));
        for (name, formula) in found.into_iter().chain(of_body) {
            if d.get(&name).is_none() {
                d.define(name, formula);
            }
        }
        Ok(())
    }

    /// The forward speed that a driven trailer asks of the body, and what else the body's rows give.
    ///
    /// The directions alone make every speed a multiple of the body's but for what inputs add, so that the trailer's
    /// rolling constraint is one equation in v_d; solving all rows at once would cost more with every trailer.
    fn pushed(
        &self,
        unknown: &[Symbol],
        driven: usize,
        row: &impl Fn(&Constraint) -> Row,
    ) -> Option<Vec<(Symbol, Expr)>> {
        let (r, t) = self.rows("v_d", 0);
        let rows: Vec<Row> = r.iter().chain(&t).map(row).collect();
        let speed = Symbol::from("v_d");
        if let Some(by_body) = solve::together(&rows, &[std::slice::from_ref(&speed), unknown].concat()) {
            return Some(by_body);
        }
        let mut found = solve::chained(&rows, unknown)?;
        let mut chain = Definitions::default();
        [("v_l", "v_d"), ("v_t", "v_n")].into_iter().for_each(|(name, is)| chain.define(name, Expr::sym(is)));
        found.iter().for_each(|(name, formula)| chain.define(name.clone(), formula.clone()));
        (1..=driven).try_for_each(|i| self.solve_trailer(i, &mut chain)).ok()?;
        let lengths = |i| <[Symbol; 2]>::from(trailer_lengths(i)).into_iter().chain([trailer_creep(i)]);
        let kept: Vec<Symbol> = (1..=driven).flat_map(lengths).collect();
        let chain = chain.without(&|name| kept.contains(name));
        let pushing = (1..=driven).flat_map(|i| self.vehicle.wheels_on(i).map(move |w| (i, w)));
        let rolls =
            |(i, w): (usize, &Wheel)| rolling(w, &moving(i), &section_heading(i)).filter(|_| self.is_known(&w.rate));
        let rolling = pushing.filter(|(_, w)| self.is_known(&w.steering)).find_map(rolls)?.row();
        let (slope, rest) = line_in(&rolling, &chain);
        let rest = (-&rest).tidy();
        found.push((speed, (!slope.is_zero()).then(|| &rest / &slope)?));
        Some(found)
    }

    /// Whether a wheel's angle and rate are known.
    ///
    /// Passive wheels, of unknown rate or angle, follow the motion and do not determine it.
    fn is_known(&self, s: &Option<Symbol>) -> bool {
        s.as_ref().is_none_or(|s| !self.vehicle.is_free(s))
    }

    /// The last of the vehicle's own trailers on which a wheel of measured rate stands, or whose rate a constraint of
    /// its own has.
    fn driven_trailers(&self) -> usize {
        let driven = self.vehicle.wheels.iter().filter(|w| w.rate.is_some() && self.is_known(&w.rate));
        let driven = driven.map(|w| self.vehicle.section_of(w));
        let has = |c: &Constraint, i: usize| c.row().rates().any(|r| *r == trailer_heading(i).rate());
        let bound = |i: &usize| self.vehicle.constraints.iter().any(|c| has(c, *i));
        driven.chain((1..=self.vehicle.trailers.len()).filter(bound)).max().unwrap_or(0)
    }

    /// The rolling constraints, and then those of direction and of the vehicle's own, of the body and of its first own
    /// trailers, as far as they are measured: in v_n, phi', the rates of the trailers and a forward speed.
    fn rows(&self, speed: &str, trailers: usize) -> (Vec<Constraint>, Vec<Constraint>) {
        let reference = match self.vehicle.line {
            true => Velocity::along_line(speed, &section_heading(0)),
            false => Velocity::in_body(speed, "v_n", &section_heading(0)),
        };
        let (mut r, mut t) = (Vec::new(), Vec::new());
        for (i, axle) in bodies(reference, trailers).iter().enumerate() {
            let heading = section_heading(i);
            t.extend((i > 0).then(|| trailer_direction(&self.vehicle, i, axle)));
            for wheel in self.vehicle.wheels_on(i).filter(|w| self.is_known(&w.steering)) {
                r.extend(rolling(wheel, axle, &heading).filter(|_| self.is_known(&wheel.rate)));
                t.extend(direction(wheel, axle, &heading));
            }
        }
        t.extend(
            self.vehicle.constraints.iter().map(|c| in_body(c, Velocity::in_body(speed, "v_n", &section_heading(0)))),
        );
        (r, t)
    }

    /// That the rows which were not needed for the solution vanish with it, whatever the inputs and the coefficients.
    pub(super) fn check(&self, d: &Definitions, rows: &[Constraint]) -> Result<()> {
        let broken = self.broken(d, rows);
        match broken.is_empty() {
            true => Ok(()),
            false => Err(self.unmoved(&format!(
                "contradict each other for general inputs: what the others give breaks {}",
                broken.join("; ")
            ))),
        }
    }

    /// The constraints among these whose rows do not vanish with the solution, by name.
    pub(super) fn broken(&self, d: &Definitions, rows: &[Constraint]) -> Vec<String> {
        let free = d.without(&|name| self.vehicle.creeps().any(|creep| creep == name));
        let holds =
            |c: &&Constraint| (0..TEST_POINTS).all(|k| Sample::of(&free, k).is_some_and(|s| s.annihilates(&c.row())));
        rows.iter().filter(|c| !holds(c)).map(|c| c.name.clone()).collect()
    }

    /// Every constraint of the body and of the vehicle's own trailers that is measured.
    pub(super) fn all_rows(&self) -> Vec<Constraint> {
        let (r, t) = self.rows("v_d", self.vehicle.trailers.len());
        [r, t].concat()
    }

    /// That something of the motion is left open, and what.
    pub(super) fn free(&self, rows: &[Row], wanted: &[Symbol]) -> Error {
        let open = open(rows, wanted);
        self.unmoved(&format!("do not determine its motion by themselves: nothing gives its {}", open.join(", its ")))
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
        for wheel in &self.vehicle.wheels {
            let unknown = self.free_rates(wheel);
            if unknown.is_empty() {
                continue;
            }
            let i = self.vehicle.section_of(wheel);
            let (reference, body) = (moving(i), section_heading(i));
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

    /// The rates of the wheels that only follow, and their coefficients of traverse creep, from the motion as it is.
    pub(super) fn solve_followers(&self, d: &mut Definitions) -> Result<()> {
        for wheel in &self.vehicle.followers {
            let i = self.vehicle.section_of(wheel);
            let (reference, body) = (moving(i), section_heading(i));
            if let Some(creep) = &wheel.traverse_creep {
                d.define(creep.clone(), sideways(wheel, &reference, &body));
            }
            let rate = wheel.rate.clone().filter(|rate| self.vehicle.is_free(rate));
            let Some((rolls, rate)) = rolling(wheel, &reference, &body).zip(rate) else { continue };
            let solved = solve::together(&[rolls.row()], &[rate]);
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

/// A row as slope·v_d + rest, the names of a chain that begins at v_d written out.
fn line_in(row: &Row, chain: &Definitions) -> (Expr, Expr) {
    let (mut slope, mut rest) = (Expr::int(0), Expr::int(0));
    for (rate, c) in row.terms() {
        let [at_rest, at_one] = [0, 1].map(|v| written_out(&Expr::sym(rate.clone()), chain, &Expr::int(v)));
        slope = &slope + &(c * &(&at_one - &at_rest));
        rest = &rest + &(c * &at_rest);
    }
    (slope, rest)
}

fn written_out(formula: &Expr, chain: &Definitions, speed: &Expr) -> Expr {
    formula.substitute(&|s| match s.as_str() {
        "v_d" => Some(speed.clone()),
        _ => chain.get(s).map(|f| written_out(f, chain, speed)),
    })
}

/// Of the unknown rates, those that are left when the rows give as many of the others as they can, in words.
fn open(rows: &[Row], wanted: &[Symbol]) -> Vec<String> {
    let order = |s: &Symbol| match s.as_str() {
        "v_n" => 0,
        "phi'" => 2,
        "v_d" => 3,
        _ => 1,
    };
    let mut by_rows: Vec<Symbol> = Vec::new();
    let mut tried: Vec<&Symbol> = wanted.iter().collect();
    tried.sort_by_key(|s| order(s));
    for rate in tried {
        by_rows.push(rate.clone());
        if solve::together(rows, &by_rows).is_none() {
            by_rows.pop();
        }
    }
    wanted.iter().filter(|s| !by_rows.contains(s)).map(in_words).collect()
}

fn in_words(rate: &Symbol) -> String {
    match rate.as_str() {
        "v_d" => "forward speed".into(),
        "v_n" => "sideways speed".into(),
        "phi'" => "yaw rate".into(),
        other => format!("rate {other}"),
    }
}
