//! The coefficient of a constraint in the model as it stands, and the regime it lies in.

use crate::formula::Symbol;
use crate::mechanism::{ConstraintType, Landmark, Limits, Regimes, RotationRegime, TraverseRegime};

/// Limits of creep, as far as they are given.
#[derive(Clone, Copy, Debug, Default)]
pub struct CreepLimits {
    /// Of rotation creep.
    pub rotation: Option<Limits>,
    /// Of traverse creep.
    pub traverse: Option<Limits>,
}

impl CreepLimits {
    /// Those of a type whose coefficient has these regimes.
    pub(super) fn of(self, regimes: Regimes) -> Option<Limits> {
        match regimes {
            Regimes::Rotation => self.rotation,
            Regimes::Traverse => self.traverse,
            Regimes::None => None,
        }
    }
}

/// The coefficient of a constraint in the model as it stands.
#[derive(Clone, Debug)]
pub struct Coefficient {
    /// Its symbol.
    pub creep: Symbol,
    /// The type of its constraint.
    pub kind: ConstraintType,
    /// Its value; `None` where it is not constant.
    pub value: Option<f64>,
    /// Whether an effect gives it.
    pub given: bool,
    /// Whether the motion keeps to the row; effects beside the rows make it creep otherwise.
    pub row_holds: bool,
    /// Limits of its form, where they are given.
    pub limits: Option<Limits>,
}

impl Coefficient {
    /// Whether there is something to say: it is given, or limits are.
    pub fn is_told(&self) -> bool {
        self.given || self.limits.is_some()
    }

    /// The name of its regime. A row that the motion does not keep to is not ideal for having no coefficient.
    pub fn regime(&self) -> &'static str {
        let unknown = !self.row_holds && self.value == Some(0.0);
        let e = self.value.filter(|_| !unknown).unwrap_or(f64::NAN);
        match self.kind.regimes {
            Regimes::Rotation => RotationRegime::of(e, self.limits).name(),
            Regimes::Traverse => TraverseRegime::of(e, self.limits).name(),
            Regimes::None if e.is_nan() => "undefined",
            Regimes::None if e == 0.0 => "ideal",
            Regimes::None => "creep",
        }
    }

    /// What else a coefficient of rotation creep means.
    pub fn landmark(&self) -> Option<&'static str> {
        self.value.filter(|_| self.kind.regimes == Regimes::Rotation).and_then(Landmark::of).map(Landmark::name)
    }

    /// Regime, landmark, limits and reservations in words.
    pub fn words(&self) -> String {
        let mut said = match self.value {
            None => "not constant".to_string(),
            Some(_) => self.regime().to_string(),
        };
        if let Some(landmark) = self.landmark() {
            said += &format!(", {landmark}");
        }
        said += &match self.limits {
            Some(limits) => format!(" (limits {limits})"),
            None if self.kind.regimes == Regimes::None => String::new(),
            None => " (by its sign; limits were not given)".into(),
        };
        if !self.row_holds {
            said += "; effects beside the rows change the motion further";
        }
        said
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::constraint_types;

    #[test]
    fn a_type_without_regimes_is_ideal_or_creeps() {
        let kind = ConstraintType { regimes: Regimes::None, ..ConstraintType::clone(&constraint_types()[0]) };
        let regime = |value, row_holds| {
            let (creep, kind) = (Symbol::new("e"), kind.clone());
            Coefficient { creep, kind, value, given: true, row_holds, limits: None }.regime()
        };
        assert_eq!([regime(Some(0.0), true), regime(Some(0.1), true)], ["ideal", "creep"]);
        // A row that the motion does not keep to is not ideal for having no coefficient.
        assert_eq!([regime(None, true), regime(Some(0.0), false)], ["undefined"; 2]);
        assert_eq!(regime(Some(0.1), false), "creep");
    }
}
