//! Effects where they vanish, and which of their parameters a score test weighs there.
//!
//! Some vanish where a parameter of theirs means nothing (a slope of no steepness has no direction: Davies, 1977), so they are
//! weighed at several values of it. One with states vanishes nowhere: a share of what it changes is weighed at zero, which is
//! the effect to first order at the value that it has, and to first order in its time constant at others.

use crate::effects::{Applied, Effect, Parameter};
use crate::formula::Expr;

/// By which what an effect changes is multiplied.
const SHARE: &str = "share";

/// An effect where it vanishes, and which of its parameters are weighed there.
#[derive(Clone)]
pub(super) struct VanishingEffect {
    /// As it is linearised.
    pub applied: Applied,
    pub weighed: Vec<usize>,
    /// The effect of the library.
    pub whole: Applied,
}

impl VanishingEffect {
    /// Of a regular effect at its first start; of another at each, with the parameter at zero that gives its size; of one with
    /// states a share at plausible values.
    pub fn all_of(effect: &Effect, trailer: Option<usize>) -> Vec<Self> {
        if !effect.states.is_empty() {
            return Self::share_of(effect, trailer).into_iter().collect();
        }
        let starts = effect.starts().into_iter();
        let at = |values: Vec<f64>| Applied::new(effect, trailer, values).freed();
        let of = |applied: Applied, weighed| Self { whole: applied.clone(), applied, weighed };
        if effect.vanishes_first() {
            let weighed = (0..effect.parameters.len()).collect::<Vec<_>>();
            return starts.take(1).map(|s| of(at(s), weighed.clone())).collect();
        }
        let Some(size) = effect.amplitude() else { return vec![] };
        let mut found: Vec<Self> = vec![];
        for mut start in starts {
            start[size] = 0.0;
            if !found.iter().any(|f| f.applied.values == start) {
                found.push(of(at(start), vec![size]));
            }
        }
        found
    }

    /// A share of an effect, at its first start or the plausible size where that is zero.
    fn share_of(effect: &Effect, trailer: Option<usize>) -> Option<Self> {
        let first = effect.starts().into_iter().next()?.into_iter();
        let values: Vec<f64> =
            first.zip(effect.parameters.values()).map(|(v, p)| if v == 0.0 { p.size } else { v }).collect();
        let mut shared = effect.clone();
        for change in shared.changes.values_mut() {
            let it = Expr::sym("it");
            *change = &it + &(&Expr::sym(SHARE) * &(&*change - &it));
        }
        let unit = Parameter {
            unit: "1".into(),
            range: [f64::NEG_INFINITY, f64::INFINITY],
            size: 1.0,
            start: vec![0.0],
            positive: false,
            periodic: false,
        };
        if shared.parameters.insert(SHARE.into(), unit).is_some() {
            return None;
        }
        let weighed = shared.parameters.keys().position(|name| name == SHARE)?;
        let mut at = values.clone();
        at.insert(weighed, 0.0);
        let whole = Applied::new(effect, trailer, values);
        Some(Self { applied: Applied::new(&shared, trailer, at).freed(), weighed: vec![weighed], whole })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::named;

    /// A slide that builds up is weighed by its share, its own parameter in the order of the names beside it.
    #[test]
    fn a_share_of_what_builds_up_is_weighed_at_zero() {
        let all = |id: &str| VanishingEffect::all_of(named(id).unwrap(), None);
        let [slide] = &all("cornering-creep")[..] else { panic!() };
        let names: Vec<&str> = slide.applied.effect.parameters.keys().map(String::as_str).collect();
        assert_eq!(
            (names, &slide.applied.values[..], &slide.weighed[..]),
            (vec!["mass_over_bT", "share"], &[0.05, 0.0][..], &[1][..])
        );
        assert_eq!(slide.applied.effect.changes["v_t"].to_string(), "it + share*(it + w - it)");
        assert_eq!(&slide.whole.values[..], &[0.05]);
        // Nothing would build up of a creep of zero.
        let [builds_up] = &all("relaxation-length")[..] else { panic!() };
        assert_eq!(&builds_up.whole.values[..], &[0.03, 0.5]);
        let slopes = all("side-slope");
        assert!(
            slopes.len() > 1 && slopes.iter().all(|s| s.weighed.len() == 1 && s.applied.values[s.weighed[0]] == 0.0)
        );
    }
}
