//! An effect with a parameter that moves with time.

use super::course::SINCE;
use super::{Course, Effect, Parameter};
use crate::formula::{Expr, Symbol};

/// In so many seconds a parameter moves by a plausible size.
const TYPICAL_S: f64 = 60.0;

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
