//! Terms without a name: a library of monomials in speed, yaw rate, steering and heading for unknown effects.

use super::vehicle_model::Model;
use crate::effects::{Effect, Parameter};
use crate::error::Result;
use crate::formula::{Expr, Size, Symbol};
use crate::mechanism::Definitions;
use crate::vehicles::Moves;
use std::collections::BTreeMap;

/// How every term's id begins.
pub const PREFIX: &str = "unnamed-";
/// The coefficient of a term.
pub const COEFFICIENT: &str = "k";

/// Terms are applied after whatever the library holds.
const AFTER_LIBRARY: usize = 1 << 20;

/// A factor of a term: its name, its formula, and its powers of length and time.
struct Factor {
    name: &'static str,
    formula: &'static str,
    metres: i32,
    seconds: i32,
}

const fn factor(name: &'static str, formula: &'static str, metres: i32, seconds: i32) -> Factor {
    Factor { name, formula, metres, seconds }
}

/// Powers of the forward speed.
const SPEED: [Factor; 4] =
    [factor("", "1", 0, 0), factor("v", "v", 1, -1), factor("v2", "v^2", 2, -2), factor("v3", "v^3", 3, -3)];

/// Powers of the yaw rate, each in both parities: turning left and right alike, or opposite; and one side alone.
const YAW: [Factor; 9] = [
    factor("", "1", 0, 0),
    factor("yaw", "w", 0, -1),
    factor("abs-yaw", "abs(w)", 0, -1),
    factor("yaw-abs-yaw", "w*abs(w)", 0, -2),
    factor("yaw2", "w^2", 0, -2),
    factor("yaw3", "w^3", 0, -3),
    factor("abs-yaw3", "abs(w)*w^2", 0, -3),
    factor("left-yaw", "(w + abs(w))/2", 0, -1),
    factor("right-yaw", "(w - abs(w))/2", 0, -1),
];

/// Powers of the steering angle beyond offset and gain, which have names.
const STEERING: [Factor; 3] = [
    factor("steering2", "d^2", 0, 0),
    factor("steering-abs-steering", "d*abs(d)", 0, 0),
    factor("steering3", "d^3", 0, 0),
];

/// Where the vehicle points: ground that is not level, a compass near iron.
const HEADING: [Factor; 4] = [
    factor("sin-heading", "sin(phi)", 0, 0),
    factor("cos-heading", "cos(phi)", 0, 0),
    factor("sin-2-heading", "sin(2*phi)", 0, 0),
    factor("cos-2-heading", "cos(2*phi)", 0, 0),
];

/// A definition that terms are added to.
struct Target {
    definition: &'static str,
    name: &'static str,
    place: &'static str,
    /// Powers of length and time in what it defines.
    metres: i32,
    seconds: i32,
}

const TARGETS: [Target; 3] = [
    Target { definition: "v_l", name: "rotation", place: "rotation constraint", metres: 1, seconds: -1 },
    Target { definition: "v_t", name: "traverse", place: "traverse constraint", metres: 1, seconds: -1 },
    Target { definition: "phi'", name: "yaw", place: "yaw rate", metres: 0, seconds: -1 },
];

impl Model {
    /// Every term of the library without names for this vehicle: `target = it + k·vⁱ·ωʲ`, in both parities of ω, and
    /// terms of the heading; and powers of the steering angle where there is one.
    ///
    /// | symbol | unit | meaning |
    /// |---|---|---|
    /// | v | m/s | forward speed v_l; in a term of v_l itself the speed v_d that the wheels ask for |
    /// | ω | rad/s | yaw rate phi'; in a term of v_l or phi' the one without terms |
    /// | k | so that the units agree | coefficient, zero where nothing is missing |
    ///
    /// The factors are what every vehicle has; an effect with a name of its own is always asked first.
    ///
    /// # Errors
    /// When the constraints do not determine the motion.
    ///
    /// ```
    /// use creepage::model::Model;
    /// let wheel = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
    /// let terms = wheel.terms().unwrap();
    /// let term = terms.iter().find(|t| t.id == "unnamed-traverse-yaw-abs-yaw").unwrap();
    /// assert_eq!(term.parameters["k"].unit, "m*s");
    /// assert_eq!(term.changes["v_t"].to_string(), "it + k*(phi'*abs(phi'))");
    /// ```
    pub fn terms(&self) -> Result<Vec<Effect>> {
        let bare = Model { effects: vec![], ..self.clone() };
        let definitions = bare.definitions()?;
        let mut found = Vec::new();
        for target in TARGETS.iter().filter(|t| !self.vehicle.holds(&t.definition.into())) {
            let Some(symbols) = Symbols::of(target, &definitions)? else { continue };
            // What does not move has no speed for a term.
            let moves =
                |factors: &[&Factor; 2]| !self.vehicle.stays() || factors.iter().all(|f| !f.formula.contains('v'));
            found.extend(products().filter(moves).map(|factors| term(target, &factors, &symbols, &bare)));
        }
        if let Some(angle) = self.vehicle.input_that(Moves::Steering) {
            let symbols = Symbols { d: Expr::sym(angle), ..Symbols::by("v_l", Expr::sym("phi'")) };
            found.extend(STEERING.iter().map(|power| term(&STEERED, &[power], &symbols, &bare)));
        }
        let mut found: Vec<Effect> = found.into_iter().flatten().collect();
        // After every effect that has a name.
        found.iter_mut().enumerate().for_each(|(i, e)| e.order = AFTER_LIBRARY + i);
        Ok(found)
    }

    /// The term of that id.
    ///
    /// # Errors
    /// As [`Model::terms`].
    pub fn term(&self, id: &str) -> Result<Option<Effect>> {
        Ok(self.terms()?.into_iter().find(|t| t.id == id))
    }
}

/// The steering input; what it misses shows in the yaw rate.
const STEERED: Target = Target { definition: "delta", name: "steering", place: "yaw rate", metres: 0, seconds: 0 };

/// What a term adds, for people: `it` and the coefficient times the factors in v and the yaw rate, not written out.
pub(crate) fn shown(term: &Effect) -> Option<Expr> {
    if STEERING.iter().any(|power| id(&STEERED, &[power]) == term.id) {
        return term.changes.get(STEERED.definition).cloned();
    }
    let mut all = TARGETS.iter().flat_map(|target| products().map(move |f| (target, f.to_vec())));
    let (target, factors) = all.find(|(target, factors)| id(target, factors) == term.id)?;
    let speed = if target.definition == "v_l" { "v_d" } else { "v_l" };
    Some(added(&factors, &Symbols::by(speed, Expr::sym("phi'"))))
}

/// `it` and the coefficient times some factors.
fn added(factors: &[&Factor], symbols: &Symbols) -> Expr {
    let factors = factors.iter().map(|f| formula(f.formula, symbols)).filter(|f| !f.is_one());
    &Expr::sym("it") + &factors.fold(Expr::sym(COEFFICIENT), |product, f| &product * &f)
}

/// The id of every term that some vehicle has.
pub fn ids() -> Vec<String> {
    let steering = STEERING.iter().map(|power| id(&STEERED, &[power]));
    TARGETS.iter().flat_map(|target| products().map(|f| id(target, &f))).chain(steering).collect()
}

/// What the coefficient of a term may stand before.
fn products() -> impl Iterator<Item = [&'static Factor; 2]> {
    let yaw = SPEED.iter().flat_map(|v| YAW.iter().map(move |w| [v, w]));
    let heading = HEADING.iter().flat_map(|h| SPEED[..2].iter().map(move |v| [v, h]));
    yaw.chain(heading)
}

/// Whether an id is that of a term.
pub fn is_term(id: &str) -> bool {
    ids().iter().any(|term| term == id)
}

/// Smallest and largest coefficient.
pub const RANGE: [f64; 2] = [-1e6, 1e6];

fn id(target: &Target, factors: &[&Factor]) -> String {
    format!("{PREFIX}{}-{}", target.name, product_name(factors))
}

fn product_name(factors: &[&Factor]) -> String {
    let names: Vec<&str> = factors.iter().map(|f| f.name).filter(|n| !n.is_empty()).collect();
    if names.is_empty() { "constant".to_string() } else { names.join("-") }
}

/// What a term calls v, ω and the steering angle.
struct Symbols {
    v: Expr,
    w: Expr,
    d: Expr,
}

impl Symbols {
    fn by(speed: &str, w: Expr) -> Self {
        Self { v: Expr::sym(speed), w, d: Expr::default() }
    }

    /// What a term adds to must not stand in its factors: not for a circle, and not for formulas that double with
    /// every term. So the speed in a term of v_l is what the wheels ask for, the yaw rate in one of phi' the logged one.
    ///
    /// None where the yaw rate is too long to be written out.
    fn of(target: &Target, definitions: &Definitions) -> Result<Option<Self>> {
        let speed = if target.definition == "v_l" { "v_d" } else { "v_l" };
        if target.definition == "v_t" {
            return Ok(Some(Self::by(speed, Expr::sym("phi'"))));
        }
        let yaw = Symbol::from("phi'");
        let w = match written_out(speed, definitions)?.remove(&yaw) {
            Some(hanging) => hanging.map(|(formula, _)| formula),
            None => definitions.get(&yaw).cloned().or_else(|| Some(Expr::default())),
        };
        Ok(w.map(|w| Self::by(speed, w)))
    }
}

/// The most operations of a formula that is written out; a few short ones put into one another may fill any memory.
const MAX_WRITTEN_OPERATIONS: usize = 5000;

/// Everything that hangs on v_l, written out with another speed for it, and how long that is; none where it is too long.
///
/// One pass in the order of the definitions: each asks only what stands before it.
fn written_out(speed: &str, definitions: &Definitions) -> Result<BTreeMap<Symbol, Option<(Expr, Size)>>> {
    let mut hanging = BTreeMap::from([(Symbol::from("v_l"), Some((Expr::sym(speed), Size::SYMBOL)))]);
    for (name, formula) in definitions.sorted()? {
        let parts: Vec<_> = formula.symbols().iter().filter_map(|s| hanging.get(s)).collect();
        if name.as_str() == "v_l" || parts.is_empty() {
            continue;
        }
        let of = |s: &Symbol| hanging.get(s).cloned().flatten();
        let size = Size::of(formula, &|s| of(s).map_or(Size::SYMBOL, |(_, size)| size));
        let short = parts.iter().all(|p| p.is_some()) && size.nodes <= MAX_WRITTEN_OPERATIONS;
        let out = short.then(|| (formula.substitute(&|s| of(s).map(|(formula, _)| formula)), size));
        hanging.insert(name.clone(), out);
    }
    Ok(hanging)
}

/// Terms that say what an effect of the library says, exactly or as long as they are small.
const NAMED: [(&str, &str); 9] = [
    ("v_l", "v"),
    ("v_l", "yaw"),
    ("v_t", "v"),
    ("v_t", "yaw"),
    ("v_t", "v-yaw"),
    ("v_t", "v2-yaw"),
    ("v_t", "sin-heading"),
    ("v_t", "cos-heading"),
    ("phi'", "yaw"),
];

fn term(target: &Target, factors: &[&Factor], symbols: &Symbols, model: &Model) -> Option<Effect> {
    let name = product_name(factors);
    let logged = model.vehicle.input_that(Moves::Yaw).is_some();
    let steered = model.vehicle.input_that(Moves::Steering).is_some();
    let taken = NAMED.contains(&(target.definition, name.as_str()))
        || (target.definition == "phi'"
            && (logged && (name == "constant" || name == "v") || steered && name == "v2-yaw"));
    // The effects that have these names speak of vehicles that move.
    if taken && !model.vehicle.stays() {
        return None;
    }
    let metres = target.metres - factors.iter().map(|f| f.metres).sum::<i32>();
    let seconds = target.seconds - factors.iter().map(|f| f.seconds).sum::<i32>();
    let parameter = Parameter {
        unit: unit(metres, seconds),
        range: RANGE,
        size: 0.03,
        start: vec![0.0],
        positive: false,
        periodic: false,
    };
    Some(Effect {
        id: id(target, factors),
        place: target.place.into(),
        says: format!("the {} gains a term of {name}", target.place),
        source: "no name".into(),
        parameters: BTreeMap::from([(COEFFICIENT.to_string(), parameter)]),
        changes: BTreeMap::from([(target.definition.to_string(), added(factors, symbols))]),
        ..Effect::default()
    })
}

fn formula(text: &str, symbols: &Symbols) -> Expr {
    let parsed = Expr::parse(text).unwrap_or_else(|e| unreachable!("{e}"));
    parsed.substitute(&|s: &Symbol| match s.as_str() {
        "v" => Some(symbols.v.clone()),
        "w" => Some(symbols.w.clone()),
        "d" => Some(symbols.d.clone()),
        _ => None,
    })
}

/// mᵃ·sᵇ as the catalogue spells it.
fn unit(metres: i32, seconds: i32) -> String {
    let power = |name: &str, n: i32| if n == 1 { name.to_string() } else { format!("{name}^{n}") };
    let all = [("m", metres), ("s", seconds)];
    let above: Vec<String> = all.iter().filter(|(_, n)| *n > 0).map(|(u, n)| power(u, *n)).collect();
    let below: String = all.iter().filter(|(_, n)| *n < 0).map(|(u, n)| format!("/{}", power(u, -*n))).collect();
    if above.is_empty() { format!("1{below}") } else { format!("{}{below}", above.join("*")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_hangs_on_speed_is_written_out_and_the_rest_keeps_its_name() {
        let mut known = Definitions::default();
        for (name, formula) in [("slow", "k*v_l^2"), ("slower", "1 + slow"), ("k", "4*load"), ("still", "k + 1")] {
            known.define(name, Expr::parse(formula).unwrap());
        }
        known.define("phi'", Expr::parse("slower*still").unwrap());
        let out = written_out("v_d", &known).unwrap();
        assert_eq!(out.keys().map(Symbol::as_str).collect::<Vec<_>>(), ["phi'", "slow", "slower", "v_l"]);
        let yaw = &out[&"phi'".into()].as_ref().unwrap().0;
        assert_eq!(yaw.to_string(), Expr::parse("(1 + k*v_d^2)*still").unwrap().to_string());
        let symbols = Symbols::of(&TARGETS[0], &known).unwrap().unwrap();
        assert_eq!([symbols.v, symbols.w.clone()], [Expr::sym("v_d"), yaw.clone()]);
    }

    /// Each definition uses two before it: written out they are longer than any memory, and asked one by one it takes for
    /// ever. What does not hang on the speed keeps its names and has its terms.
    #[test]
    fn definitions_that_grow_beyond_bounds_are_not_written_out() {
        let long = |first: &str| {
            let mut known = Definitions::default();
            for i in (0..200).rev() {
                known.define(format!("q{i}").as_str(), Expr::parse(&format!("(q{} + q{})/2", i + 1, i + 2)).unwrap());
            }
            known.define("q200", Expr::parse(first).unwrap());
            known.define("phi'", Expr::parse("yaw_rate*q0").unwrap());
            Symbols::of(&TARGETS[2], &known).unwrap().map(|s| s.w.to_string())
        };
        assert_eq!(long("gain"), Some("yaw_rate*q0".into()));
        assert_eq!(long("v_l"), None);
    }

    #[test]
    fn units_are_spelled_as_the_catalogue_spells_them() {
        let spelled = [(0, 0), (1, 0), (0, 1), (2, 1), (1, -2), (-1, 0), (0, -1), (-1, -2)].map(|(m, s)| unit(m, s));
        assert_eq!(spelled, ["1", "m", "s", "m^2*s", "m/s^2", "1/m", "1/s", "1/m/s^2"]);
    }
}
