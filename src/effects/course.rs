//! The course of a parameter: one that moves with time at a constant rate.
//!
//! p(t) = p + p_per_s·(t − since)

use super::{Effect, Parameter};
use crate::formula::{Expr, Symbol};

/// A parameter of an effect that moves with time at a constant rate.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | p | of the parameter | its value at `since` |
/// | p_per_s | unit/s | how fast it moves: a parameter of the effect, beside p |
///
/// ```
/// use creepage::effects;
/// let warming = effects::named("yaw-rate-bias").unwrap().drifting("bias", 0.0).unwrap();
/// assert_eq!(warming.parameters["bias_per_s"].unit, "rad/s/s");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// The parameter that moves.
    pub parameter: String,
    /// The time at which it has its value, s.
    pub since: f64,
}

/// How the rate of a parameter is called.
const RATE: &str = "_per_s";
/// How the time at which it has its value is called in formulas.
pub(super) const SINCE: &str = "since";
/// In so many seconds a parameter moves by a plausible size.
const TYPICAL_S: f64 = 60.0;

impl Course {
    /// The name of the rate among the parameters of the effect.
    pub fn rate(&self) -> String {
        format!("{}{RATE}", self.parameter)
    }
}

impl Effect {
    /// The effect with a parameter that moves with time; `None` where it has no such parameter, or one that is not free
    /// to be anything.
    pub fn drifting(&self, parameter: &str, since: f64) -> Option<Self> {
        let p = self.parameters.get(parameter).filter(|p| !p.positive && !p.periodic && self.course.is_none())?;
        let course = Course { parameter: parameter.into(), since };
        let rate = Parameter {
            unit: if p.unit == "1" { "1/s".into() } else { format!("{}/s", p.unit) },
            range: p.range.map(|end| end / TYPICAL_S),
            size: p.size / TYPICAL_S,
            start: vec![0.0],
            ..p.clone()
        };
        let moving = Expr::parse(&format!("{parameter} + {}*(t + delay - {SINCE})", course.rate())).ok()?;
        let moved = |f: &Expr| f.substitute(&|s: &Symbol| (s.as_str() == parameter).then(|| moving.clone()));
        let mut effect = self.clone();
        effect.parameters.insert(course.rate(), rate);
        effect.changes.values_mut().for_each(|f| *f = moved(f));
        effect.states.values_mut().for_each(|s| s.rate = moved(&s.rate));
        effect.course = Some(course);
        Some(effect)
    }
}
