//! An effect: the definitions it changes, its parameters, its states.

use super::{Course, PlainSentence, RandomWalk, Scope};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Definitions, Sample};
use crate::provenance::Origin;
use crate::vehicles::Moves;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Something a vehicle really does that its model leaves out.
///
/// ```
/// use creepage::effects::{self, Effect};
/// let creep: &Effect = effects::named("rotation-creep").unwrap();
/// assert!(creep.parameters.contains_key("e_rc") && creep.states.is_empty());
/// ```
#[derive(Clone, Debug, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Effect {
    /// Its name in files and reports.
    pub id: String,
    /// Where it acts, such as "traverse constraint".
    #[serde(rename = "where")]
    pub place: String,
    /// What it says, in words.
    pub says: String,
    /// The same for anyone, with the numbers of a finding; what it says where there is none.
    #[serde(default)]
    pub plain: Option<PlainSentence>,
    /// Where it comes from.
    pub source: String,
    /// Whether it belongs to one trailer.
    #[serde(default)]
    pub per_trailer: bool,
    /// Whether it acts on one input of the vehicle, which its formulas call `{input}`; `it` is the input after the effects
    /// before it, `input` the logged one. A parameter whose unit is `input` has that of the input, and its plausible
    /// size and its starts are shares of the input's own size.
    #[serde(default)]
    pub per_input: bool,
    /// Whether it acts on one of the quantities that are measured beside the pose, which its formulas call `{input}`, and
    /// whose unit `input` is.
    #[serde(default)]
    pub per_quantity: bool,
    /// Whether it may act on one input, too, and not on all of them alike.
    #[serde(default)]
    pub input_optional: bool,
    /// Whether it is of inputs that come in steps alone, or of those alone that do not: steps are blurred by whatever
    /// lags, so that a lag is found where there is none.
    #[serde(default)]
    pub coarse: Option<bool>,
    /// What the inputs do that it is asked of; of all where the list is empty. A wheel that lags is a creep.
    #[serde(default)]
    pub inputs_that: Vec<Moves>,
    /// Whether it is not asked for with the others: another effect says the same, or it stands in the place of another
    /// vehicle, which is asked for last.
    #[serde(default)]
    pub unsought: bool,
    /// The role of the input it acts on, for an effect that acts on one.
    #[serde(skip)]
    pub on: Option<String>,
    /// The unit of that input.
    #[serde(skip)]
    pub on_unit: String,
    /// When, where or in which regime it holds; always and everywhere where there is none.
    #[serde(skip)]
    pub scope: Option<Scope>,
    /// Which of its parameters moves with time.
    #[serde(skip)]
    pub course: Option<Course>,
    /// A parameter that walks at random.
    #[serde(skip)]
    pub walk: Option<RandomWalk>,
    /// Whether every vehicle has it in one form or another: where one of plausible size could hide, silence means
    /// nothing. A user's own effect is basic where its file says so.
    #[serde(default)]
    pub basic: bool,
    /// Inputs the vehicle must have.
    #[serde(default)]
    pub needs: Vec<String>,
    /// Its parameters.
    pub parameters: BTreeMap<String, Parameter>,
    /// States it adds.
    #[serde(default)]
    pub states: BTreeMap<String, State>,
    /// Whether it has a state at every contact that it changes: `_n` in its states and formulas stands for the number of one.
    #[serde(default)]
    pub per_contact: bool,
    /// Definitions it rewrites.
    pub changes: BTreeMap<String, Expr>,
    /// The effect of the library that it becomes where its states follow at once; it is asked for in the place of
    /// that one, with the same parameters, where that one does not explain everything.
    #[serde(default)]
    pub limit: Option<String>,
    /// Whether its one parameter is known to walk at random, as the bias of a gyroscope is.
    #[serde(default)]
    pub walks: bool,
    /// The effect of the vehicle that it is, with the same value, on inputs of some kinds where nothing creeps sideways.
    #[serde(default)]
    pub twin: Option<Box<Twin>>,
    /// Its place in the library; effects are applied in this order.
    #[serde(skip)]
    pub order: usize,
    /// The file of a user that defines it; none for one of the catalogue.
    #[serde(skip)]
    pub origin: Option<Arc<Origin>>,
}

/// What an effect on an input is the same as, where it acts on inputs of some kinds.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Twin {
    /// The other effect.
    pub id: String,
    /// The kinds of inputs.
    pub inputs_that: Vec<Moves>,
}

/// A parameter of an effect.
///
/// ```
/// use creepage::effects;
/// let creep = &effects::named("rotation-creep").unwrap().parameters["e_rc"];
/// assert!(creep.admits(creep.size) && !creep.admits(f64::INFINITY));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameter {
    /// SI unit.
    pub unit: String,
    /// What may stand in a model file.
    pub range: [f64; 2],
    /// A plausible magnitude.
    pub size: f64,
    /// Where a fit begins; neutral when left out.
    #[serde(default = "neutral_start")]
    pub start: Vec<f64>,
    /// Whether a value of zero or less has no meaning.
    #[serde(default)]
    pub positive: bool,
    /// Whether it is an angle that wraps.
    #[serde(default)]
    pub periodic: bool,
}

/// A state that an effect adds.
///
/// ```
/// use creepage::effects::{self, State};
/// let states: Vec<&State> = effects::all().iter().flat_map(|effect| effect.states.values()).collect();
/// assert!(states.iter().all(|state| !state.unit.is_empty()));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct State {
    /// SI unit.
    pub unit: String,
    /// Its rate.
    pub rate: Expr,
}

impl Parameter {
    /// Whether a value lies in the range.
    pub fn admits(&self, value: f64) -> bool {
        (self.range[0]..=self.range[1]).contains(&value)
    }
}

fn neutral_start() -> Vec<f64> {
    vec![0.0]
}

/// What stands for an input: as a unit its unit, in a formula the logged value.
pub(super) const INPUT: &str = "input";
/// What stands for the rate of an input.
pub(super) const INPUT_RATE: &str = "input'";
/// What stands for an input among the definitions that an effect changes.
const INPUT_PATTERN: &str = "{input}";

/// The definition by which all inputs are late.
const DELAY: &str = "delay";
/// What stands for the delay of one input among the definitions that an effect changes.
const DELAY_PATTERN: &str = "{delay}";

/// The definition by which one input is late, beside what all of them are.
pub fn delaying(role: &str) -> Symbol {
    Symbol::new(&format!("{role}.delay"))
}

/// The definition of an input as it acts, after the effects on it.
pub fn acting(role: &str) -> Symbol {
    Symbol::new(&format!("{role}.acting"))
}

/// The definition of a quantity that is measured beside the pose, as its sensor gives it.
pub fn measuring(name: &str) -> Symbol {
    Symbol::new(&format!("{name}.measured"))
}

/// Points at which an effect is looked at for where it vanishes.
const POINTS: u32 = 3;

/// Where an effect stands that shifts the inputs in time.
const CLOCK: &str = "clock";

impl Effect {
    /// Whether it is of the clocks: it shifts the inputs in time.
    pub fn is_of_clock(&self) -> bool {
        self.place == CLOCK
    }

    /// Whether it makes all inputs late, or one of them.
    pub fn delays_inputs(&self) -> bool {
        [DELAY, DELAY_PATTERN].iter().any(|name| self.changes.contains_key(*name))
    }

    /// The effect on an input of a unit and a size; one that acts on no single input stays as it is.
    ///
    /// ```
    /// use creepage::effects;
    /// let limit = effects::named("input-saturation").unwrap().on_input("steering_angle", "rad", 0.4);
    /// assert_eq!((limit.on.as_deref(), limit.parameters["limit"].unit.as_str()), (Some("steering_angle"), "rad"));
    /// ```
    pub fn on_input(&self, role: &str, unit: &str, size: f64) -> Self {
        let mut effect = self.clone();
        if !self.per_input && !self.input_optional && !self.per_quantity {
            return effect;
        }
        effect.on = Some(role.to_string());
        effect.on_unit = unit.to_string();
        if let Some(formula) = effect.changes.remove(DELAY).filter(|_| self.input_optional) {
            effect.place = INPUT.into();
            effect.changes.insert(DELAY_PATTERN.into(), formula);
        }
        for p in effect.parameters.values_mut().filter(|p| p.unit == INPUT) {
            p.unit = unit.to_string();
            p.size *= size;
            p.start.iter_mut().for_each(|s| *s *= size);
        }
        effect.states.values_mut().filter(|s| s.unit == INPUT).for_each(|s| s.unit = unit.to_string());
        effect
    }

    /// The unit of the input it acts on, as people say it: angles in degrees.
    pub(super) fn input_unit(&self) -> &str {
        match self.on_unit.as_str() {
            "rad" => "deg",
            "rad/s" => "deg/s",
            unit => unit,
        }
    }

    /// The effect within a scope.
    ///
    /// ```
    /// use creepage::effects::{self, DrivingRegime, Scope};
    /// let creep = effects::named("rotation-creep").unwrap().within(Scope::Regime(DrivingRegime::Reverse));
    /// assert!(creep.scope.is_some());
    /// ```
    pub fn within(&self, scope: Scope) -> Self {
        Self { scope: Some(scope), ..self.clone() }
    }

    /// An effect with one change and no parameters.
    pub(crate) fn of_change(key: &str, formula: &Expr) -> Self {
        Self { changes: [(key.to_string(), formula.clone())].into(), ..Self::default() }
    }

    /// Where it may stand behind a tractor with so many trailers: once for each of them, or once for the vehicle.
    pub fn trailers(&self, n: usize) -> Vec<Option<usize>> {
        if self.per_trailer { (1..=n).map(Some).collect() } else { vec![None] }
    }

    /// The definitions among `names` that the effect rewrites for a trailer, each with its formula in `it`.
    ///
    /// `None` when one it needs is not there: the effect does not apply to the vehicle.
    pub fn targets(&self, names: &[Symbol], trailer: Option<usize>) -> Option<Vec<(Symbol, Expr)>> {
        let mut found = Vec::new();
        for (pattern, formula) in &self.changes {
            let pattern = match trailer {
                Some(i) => pattern.replace("{trailer}", &i.to_string()),
                None => pattern.clone(),
            };
            let pattern = match &self.on {
                Some(role) => {
                    let own = pattern.replace(DELAY_PATTERN, delaying(role).as_str());
                    let target = if self.per_quantity { measuring(role) } else { acting(role) };
                    own.replace(INPUT_PATTERN, target.as_str())
                }
                None => pattern,
            };
            let before = found.len();
            found.extend(names.iter().filter(|n| matches(&pattern, n.as_str())).map(|n| (n.clone(), formula.clone())));
            if found.len() == before {
                return None;
            }
        }
        Some(found)
    }

    /// Its formulas: the changes, then the rates of its states.
    pub fn formulas(&self) -> impl Iterator<Item = &Expr> {
        self.changes.values().chain(self.states.values().map(|s| &s.rate))
    }

    /// Which of its parameters gives its size: the effect vanishes where that alone is zero, whatever the others are.
    ///
    /// ```
    /// use creepage::effects;
    /// let slope = effects::named("side-slope").unwrap();
    /// assert_eq!(slope.parameters.keys().nth(slope.amplitude().unwrap()).unwrap(), "rate");
    /// assert_eq!(effects::named("lever-arm").unwrap().amplitude(), None);
    /// ```
    pub fn amplitude(&self) -> Option<usize> {
        let samples: Vec<Sample> = (0..POINTS).filter_map(|k| Sample::of(&Definitions::default(), k)).collect();
        let vanishes = |zero: &String| {
            let without = |f: &Expr| f.substitute(&|s| (s.as_str() == zero).then(|| Expr::int(0)));
            let rest: Vec<Expr> = self.changes.values().map(|f| &without(f) - &Expr::sym("it")).collect();
            let is_zero = |s: &Sample, e: &Expr| s.value(e).is_some_and(|v| v.abs() < 1e-12);
            samples.iter().all(|s| rest.iter().all(|e| is_zero(s, e)))
        };
        self.parameters.keys().position(vanishes)
    }
}

/// `r*` stands for r, r_1, r_2, …; anything else for itself.
pub(super) fn matches(pattern: &str, name: &str) -> bool {
    let Some(stem) = pattern.strip_suffix('*') else { return pattern == name };
    match name.strip_prefix(stem) {
        Some("") => true,
        Some(rest) => rest.strip_prefix('_').is_some_and(|n| !n.is_empty() && n.chars().all(|c| c.is_ascii_digit())),
        None => false,
    }
}
