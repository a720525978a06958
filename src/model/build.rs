//! The definitions of a model: constraints solved for the motion, effects applied.

use super::constraints::{behind, moving, section_heading, trailer_creep, trailer_direction, trailer_lengths};
use super::forced_motion::ForcedMotion;
use super::reference_speeds::REFERENCE;
use super::trailer::trailer_heading;
use super::vehicle_model::Model;
use crate::effects::{Applied, Effect, acting, delaying};
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Definitions, solve};
use std::collections::BTreeSet;

/// The velocity of the reference point in the world.
const WORLD: [(&str, &str); 2] = [("x'", "v_l*cos(phi) - v_t*sin(phi)"), ("y'", "v_l*sin(phi) + v_t*cos(phi)")];

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
    /// | gamma', theta_c' … | what a castor does: the motion gives it, and does not depend on it |
    /// | x_m, y_m, heading_m | what the sensor measures |
    /// | delay | how far the inputs are looked up in the past |
    ///
    /// # Errors
    /// When the constraints do not determine the motion, or an effect does not apply.
    pub fn definitions(&self) -> Result<Definitions> {
        let mut d = self.with_effects(self.ideal_definitions()?)?;
        if let Some(forced) = &self.forced {
            forced.without_idle_parts(&mut d);
            for angle in &forced.turned {
                // The motion asks for it even where nothing turns it.
                if self.rate_along_motion(angle, &mut d).is_zero() {
                    d.define(angle.rate(), Expr::int(0));
                }
            }
        }
        self.define_measured_rates(&mut d);
        Ok(d)
    }

    /// [`Model::definitions`]; where the constraints do not determine the motion, only what stands in their rows: the
    /// symbols of the vehicle and the coefficients of creep.
    ///
    /// # Errors
    /// When an effect does not apply.
    ///
    /// ```
    /// use creepage::model::Model;
    /// let sleigh = Model::new("sleigh", &[("mass", 2.0), ("inertia", 0.5), ("mass_offset", 0.1)]).unwrap();
    /// assert!(sleigh.definitions().is_err());
    /// assert!(sleigh.row_definitions().unwrap().get(&"e_tc".into()).unwrap().is_zero());
    /// ```
    pub fn row_definitions(&self) -> Result<Definitions> {
        self.with_effects(self.bare_definitions())
    }

    /// What is defined before any effect: all of the motion, or what stands in the rows.
    pub(crate) fn bare_definitions(&self) -> Definitions {
        self.ideal_definitions().unwrap_or_else(|_| {
            let mut d = Definitions::default();
            self.define_vehicle(&mut d);
            (1..=self.trailer_count()).for_each(|i| self.define_trailer(i, &mut d));
            d
        })
    }

    /// That the constraints determine the motion from the inputs.
    ///
    /// # Errors
    /// An input error that says why they do not, and what to use instead.
    ///
    /// ```
    /// use creepage::model::Model;
    /// let sleigh = Model::new("sleigh", &[("mass", 2.0), ("inertia", 0.5), ("mass_offset", 0.1)]).unwrap();
    /// let error = sleigh.determined().unwrap_err();
    /// assert!(error.exit_code() == 2 && error.to_string().contains("use unicycle"));
    /// ```
    pub fn determined(&self) -> Result<()> {
        self.ideal_definitions().map(|_| ())
    }

    /// What an effect rewrites on this vehicle; `None` when it does not apply.
    pub(crate) fn targets(&self, e: &Effect, trailer: Option<usize>, names: &[Symbol]) -> Option<Vec<(Symbol, Expr)>> {
        let at_contacts = e.at_contacts(names);
        let e = &*at_contacts;
        let found = match &e.on {
            Some(name) if e.per_quantity => {
                let quantity = self.measured_quantity(name)?;
                e.targets(&[quantity.symbol()], trailer)
            }
            Some(role) if self.inputs.contains(role) => {
                let own = [acting(role), delaying(role)];
                let known = names.iter().filter(|n| !own.contains(n)).cloned();
                e.targets(&known.chain(own.clone()).collect::<Vec<_>>(), trailer)
            }
            Some(_) => None,
            None => e.targets(names, trailer),
        };
        let found = found.filter(|_| self.has_inputs_of(e) && !Self::moves_delay(e))?;
        let free = found.iter().all(|(name, _)| !self.vehicle.holds(name));
        (free && self.stranger(e, names).is_none()).then_some(found)
    }

    /// Whether the vehicle has all inputs that an effect needs.
    fn has_inputs_of(&self, e: &Effect) -> bool {
        e.needs.iter().all(|role| self.vehicle.inputs.contains_key(role))
    }

    /// Whether an effect would change in time how late inputs are: they are read at one delay along a run.
    fn moves_delay(e: &Effect) -> bool {
        (e.scope.is_some() || e.course.is_some()) && e.delays_inputs()
    }

    /// The first name in an effect's formulas that means nothing in this model.
    pub(crate) fn stranger(&self, e: &Effect, names: &[Symbol]) -> Option<Symbol> {
        let at_contacts = e.at_contacts(names);
        let e = &*at_contacts;
        let own = |s: &Symbol| e.parameters.contains_key(s.as_str()) || e.states.contains_key(s.as_str());
        let mut used: BTreeSet<Symbol> = e.formulas().flat_map(Expr::symbols).filter(|s| !own(s)).collect();
        if let Some(scope) = &e.scope {
            let numbers = scope.numbers();
            let own = |s: &Symbol| numbers.iter().any(|(name, _)| name == s.as_str());
            let of_gate = |s: &Symbol| !own(s) && !REFERENCE.contains(&s.as_str());
            used.extend(scope.gate().symbols().into_iter().filter(of_gate));
        }
        let stands = |s: &str| match s {
            "it" | TIME => true,
            "input" | "input'" => e.on.is_some(),
            "since" => e.course.is_some(),
            _ => false,
        };
        used.into_iter().find(|s| !stands(s.as_str()) && !names.contains(s) && !self.gives(s))
    }

    /// Whether a name is a state, an input or a parameter of the model without its effects.
    fn gives(&self, s: &Symbol) -> bool {
        let plain = || Model { effects: vec![], ..self.clone() };
        self.inputs.iter().any(|i| i == s.as_str()) || plain().values().contains_key(s) || plain().states().contains(s)
    }

    fn with_effects(&self, mut d: Definitions) -> Result<Definitions> {
        self.define_measured(&mut d);
        let mut effects: Vec<_> = self.effects.iter().collect();
        if effects.iter().any(|e| e.gate().is_some_and(|g| REFERENCE.iter().any(|name| g.mentions(&(*name).into())))) {
            self.define_reference_speeds(&mut d)?;
        }
        let of_inputs = effects.iter().filter(|e| !e.effect.per_quantity);
        of_inputs.filter_map(|e| e.effect.on.as_ref()).for_each(|role| define_acting(role, &mut d));
        effects.sort_by_key(|e| (e.effect.order, e.trailer));
        for applied in effects {
            let names: Vec<Symbol> = d.iter().map(|(n, _)| n.clone()).collect();
            let targets = self.targets(&applied.effect, applied.trailer, &names);
            let targets = targets.ok_or_else(|| {
                let (label, vehicle) = (applied.label(), &self.vehicle.id);
                if Self::moves_delay(&applied.effect) {
                    return moving_delay(applied);
                }
                let is_aimed =
                    self.has_inputs_of(&applied.effect) && applied.effect.targets(&names, applied.trailer).is_some();
                Error::input(match self.stranger(&applied.effect, &names).filter(|_| is_aimed) {
                    Some(name) => format!("the effect {label} speaks of {name}, which this {vehicle} has not"),
                    None => format!("the effect {label} does not apply to the vehicle {vehicle}"),
                })
            })?;
            for (name, formula) in targets {
                let own =
                    applied.localised(&formula).substitute(&|s| (s.as_str() == "it").then(|| Expr::sym(name.clone())));
                let it = Expr::sym(name.clone());
                let gated = applied.gate().map(|gate| &it + &(&gate * &(&own - &it)));
                d.rewrite(&name, &gated.unwrap_or(own));
            }
        }
        Ok(d)
    }

    /// Whether the definitions still lead from one to the next, without a circle, when one more effect rewrites them.
    pub(crate) fn stays_open(&self, bare: &Definitions, e: &Effect, trailer: Option<usize>) -> bool {
        let values = e.parameters.values().map(|p| p.size).collect();
        let with = self.clone().with_effect(Applied::new(e, trailer, values));
        with.with_effects(bare.clone()).is_ok_and(|d| d.sorted().is_ok())
    }

    fn ideal_definitions(&self) -> Result<Definitions> {
        if let Some(forced) = &self.forced {
            return Ok(self.moved_by_forces(forced));
        }
        // Which coordinates of its own a vehicle has is for its effects to say as well.
        if !self.vehicle.coordinates.is_empty() {
            return self.solved();
        }
        self.solution.or_solve(&self.vehicle, self.trailers.len(), &self.inputs, || self.solved())
    }

    /// The constraints solved, whatever is known of them.
    fn solved(&self) -> Result<Definitions> {
        let mut d = Definitions::default();
        self.define_vehicle(&mut d);
        match self.vehicle.coordinates.is_empty() {
            true => self.solve_in_plane(&mut d)?,
            false => self.solve_own(&mut d)?,
        }
        self.define_sensor(&mut d);
        Ok(d)
    }

    /// The motion under forces.
    fn moved_by_forces(&self, forced: &ForcedMotion) -> Definitions {
        let mut d = Definitions::default();
        self.define_vehicle(&mut d);
        let creeps: Vec<Symbol> = self.vehicle.creeps().cloned().collect();
        d = d.without(&|name| creeps.contains(name));
        (1..=self.trailer_count()).for_each(|i| self.define_trailer_lengths(i, &mut d));
        forced.definitions.iter().for_each(|(name, formula)| d.define(name.clone(), formula.clone()));
        for (name, text) in [WORLD[0], WORLD[1]] {
            d.define(name, formula(text));
        }
        self.define_sensor(&mut d);
        d
    }

    /// What the sensor measures, and when inputs act.
    fn define_sensor(&self, d: &mut Definitions) {
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
    }

    /// The constraints that break where the others hold, by name; `None` where these do not determine the motion.
    pub(crate) fn contradictions(&self) -> Option<Vec<String>> {
        let mut d = Definitions::default();
        self.define_vehicle(&mut d);
        let rows = match self.vehicle.coordinates.is_empty() {
            true => self.solve_front(&mut d).map(|()| self.all_rows()),
            false => self.solve_some(&mut d),
        };
        Some(self.broken(&d, &rows.ok()?))
    }

    /// The motion of a body with wheels in the plane, and of its trailers.
    fn solve_in_plane(&self, d: &mut Definitions) -> Result<()> {
        self.solve_front(d)?;
        self.check(d, &self.all_rows())?;
        self.solve_passive(d)?;
        self.solve_followers(d)?;
        (self.vehicle.trailers.len() + 1..=self.trailer_count()).try_for_each(|i| self.solve_trailer(i, d))
    }

    /// The motion of the body and of the vehicle's own trailers, by as many constraints as it takes.
    fn solve_front(&self, d: &mut Definitions) -> Result<()> {
        self.solve_body(d)?;
        for (name, text) in [("v_l", "v_d"), ("v_t", "v_n"), WORLD[0], WORLD[1]] {
            d.define(name, formula(text));
        }
        if self.vehicle.line {
            d.define("s'", formula("v_l"));
        }
        (1..=self.vehicle.trailers.len()).try_for_each(|i| self.solve_trailer(i, d))
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
        self.vehicle.creeps().for_each(|creep| d.define(creep.clone(), Expr::int(0)));
    }

    /// Lengths and coefficient of a trailer.
    fn define_trailer(&self, i: usize, d: &mut Definitions) {
        self.define_trailer_lengths(i, d);
        d.define(trailer_creep(i), Expr::int(0));
    }

    fn define_trailer_lengths(&self, i: usize, d: &mut Definitions) {
        let (length, hitch) = trailer_lengths(i);
        let towed = |stem: &str| Expr::sym(Symbol::new(&format!("{stem}_{i}")));
        let own = self.vehicle.trailers.get(i - 1).map(|own| [own.length.clone(), own.hitch.clone()]);
        let [bar, behind] = own.unwrap_or_else(|| [towed("trailer_length"), towed("hitch_offset")]);
        d.define(length, bar);
        d.define(hitch, behind);
    }

    /// Adds a trailer: its forward speed v_i, sideways speed vt_i and the rate of its heading.
    pub(super) fn solve_trailer(&self, i: usize, d: &mut Definitions) -> Result<()> {
        self.define_trailer(i, d);
        let axle = behind(&moving(i - 1), i);
        let rate = trailer_heading(i).rate();
        let row = trailer_direction(&self.vehicle, i, &axle).row();
        let solved = solve::chained(&[row], std::slice::from_ref(&rate));
        let solved = solved.ok_or_else(|| Error::run(format!("trailer {i} does not follow its hitch")))?;
        solved.into_iter().for_each(|(name, f)| d.define(name, f));
        d.define(Symbol::new(&format!("v_{i}")), axle.along(&section_heading(i)).expr());
        d.define(Symbol::new(&format!("vt_{i}")), formula(&format!("e_tc_{i}*v_{i}")));
        Ok(())
    }
}

/// The time at which inputs are looked up, in formulas.
pub(super) const TIME: &str = "t";

/// What is said of a delay that would change along a run.
fn moving_delay(applied: &Applied) -> Error {
    let (label, id) = (applied.label(), &applied.effect.id);
    Error::input(format!("the effect {label} cannot hold in part, nor move: a delay is one for a run"))
        .help(format!("remove the scope or course of {id}, or cut the run into files where the delay changes"))
}

/// Defines an input as it acts, and puts it in the place of the logged one.
fn define_acting(role: &str, d: &mut Definitions) {
    let (logged, acts) = (Symbol::new(role), acting(role));
    if d.get(&acts).is_some() {
        return;
    }
    let reference = |name: &Symbol| REFERENCE.contains(&name.as_str());
    let using: Vec<(Symbol, Expr)> =
        d.iter().filter(|(name, f)| !reference(name) && f.mentions(&logged)).cloned().collect();
    for (name, formula) in using {
        d.define(name, formula.substitute(&|s| (*s == logged).then(|| Expr::sym(acts.clone()))));
    }
    d.define(acts, Expr::sym(logged));
    d.define(delaying(role), Expr::int(0));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Trailer;

    /// Copies share a solution, but not one of other constraints or inputs.
    #[test]
    fn a_solution_is_of_its_own_constraints() {
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        let alone = model.definitions().unwrap();
        let rate = trailer_heading(1).rate();
        let train = model.clone().with_trailers(&[Trailer { length: 1.0, hitch: 0.0 }]);
        assert!(train.definitions().unwrap().get(&rate).is_some());
        assert!(model.definitions().unwrap().get(&rate).is_none());
        let car = crate::vehicles::named("car").unwrap().clone();
        let other = Model { inputs: car.inputs.keys().cloned().collect(), vehicle: car, ..model.clone() };
        let formula = |d: &Definitions| d.get(&"phi'".into()).map(ToString::to_string);
        assert_ne!(formula(&other.definitions().unwrap()), formula(&alone));
        assert_eq!(formula(&model.definitions().unwrap()), formula(&alone));
    }
}
