//! The check that an effect changes nothing where its parameters are neutral: the fit begins there.

use crate::error::Result;
use crate::files::{FormulaText, UserEffect};
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Definitions, Sample};

/// Points of moderate size, at which formulas must be defined, and further ones up to ten times as far.
const MODERATE_POINTS: u32 = 8;
const ALL_POINTS: u32 = 24;
/// Largest difference that counts as rounding, relative to the numbers around.
const RELATIVE_ROUNDING: f64 = 1e-9;

/// The values of names at a point; parameters and states as a reading gives them.
struct Situation<'a> {
    own: &'a UserEffect,
    point: u32,
    states_at_rest: bool,
}

/// That the effect vanishes: its changes give `it`, with its states anywhere, or at rest at zero where they stay.
///
/// An effect whose parameters are all positive or angles has no neutral value; it must only be defined.
pub(crate) fn check(own: &UserEffect) -> Result<()> {
    let has_neutral = own.effect.parameters.values().any(|p| !p.positive && !p.periodic);
    let rests = |rate: &FormulaText| all(own, true, |s| s.value(&rate.formula).is_none_or(|v| close(v, 0.0)));
    let restless = own.rates.iter().find(|(_, rate)| !rests(rate));
    for (key, (_, formula)) in &own.changes {
        if !all(own, true, |s| s.point >= MODERATE_POINTS || s.value(&formula.formula).is_some()) {
            return Err(undefined(own, formula, has_neutral));
        }
        let unchanged = |s: &Situation| s.value(&formula.formula).is_none_or(|v| close(v, s.number("it")));
        if !has_neutral || all(own, false, unchanged) {
            continue;
        }
        if let Some((name, rate)) = restless.filter(|_| all(own, true, unchanged)) {
            return Err(rate
                .error(format!("the state {name} leaves 0 where the parameters are {}", neutral(own)))
                .help("write its rate so that 0 means no effect, such as (c*v_l - u)/tau"));
        }
        if restless.is_some() || !all(own, true, unchanged) {
            return Err(formula
                .error(format!("the effect still changes {key} where the parameters are {}", neutral(own)))
                .help("write it so that 0 means no effect, such as it + c*v_l or it*(1 + scale)"));
        }
    }
    Ok(())
}

fn undefined(own: &UserEffect, formula: &FormulaText, has_neutral: bool) -> crate::Error {
    let place = if has_neutral { neutral(own) } else { "at their start".into() };
    formula
        .error(format!("the formula has no value where the parameters are {place} and speeds are of either sign"))
        .help("avoid a division by a parameter that may be 0, write abs(v_l) below a root, or use positive = true")
}

/// The neutral values in words.
fn neutral(own: &UserEffect) -> String {
    let signed = own.effect.parameters.iter().filter(|(_, p)| !p.positive && !p.periodic);
    signed.map(|(name, _)| format!("{name} = 0")).collect::<Vec<_>>().join(", ")
}

fn all(own: &UserEffect, states_at_rest: bool, holds: impl Fn(&Situation) -> bool) -> bool {
    (0..ALL_POINTS).all(|point| holds(&Situation { own, point, states_at_rest }))
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= RELATIVE_ROUNDING * (1.0 + a.abs().max(b.abs()))
}

impl Situation<'_> {
    fn value(&self, e: &Expr) -> Option<f64> {
        e.eval(&|s| self.number(s.as_str()))
    }

    fn number(&self, name: &str) -> f64 {
        match self.own.effect.parameters.get(name) {
            Some(p) if p.positive => p.start.first().copied().unwrap_or(p.size),
            Some(p) if !p.periodic => 0.0,
            None if self.states_at_rest && self.own.effect.states.contains_key(name) => 0.0,
            _ => self.scattered(name),
        }
    }

    /// A number of either sign that depends on the name and the point only.
    fn scattered(&self, name: &str) -> f64 {
        // Within 0.2 … 1.2, half of them below 0.7.
        let within =
            |k: u32| Sample::of(&Definitions::default(), k).and_then(|s| s.value(&Expr::sym(Symbol::new(name))));
        let size = within(2 * self.point).unwrap_or(1.0);
        let sign = if within(2 * self.point + 1).is_some_and(|x| x < 0.7) { -1.0 } else { 1.0 };
        sign * size * if self.point < MODERATE_POINTS { 1.0 } else { 10.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::EffectsFile;
    use std::path::Path;

    fn warm_creep() -> UserEffect {
        let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/effects/my_effects.toml");
        let all = EffectsFile::read(Path::new(examples)).unwrap().effects;
        all.into_iter().find(|own| own.effect.id == "warm-creep").unwrap()
    }

    /// Formulas must be defined at moderate numbers of either sign, and vanish at larger ones, too.
    #[test]
    fn points_are_of_either_sign_and_of_two_sizes() {
        let own = warm_creep();
        let at = |name: &str, point: u32| Situation { own: &own, point, states_at_rest: false }.scattered(name);
        for (points, size) in [(0..MODERATE_POINTS, 1.0), (MODERATE_POINTS..ALL_POINTS, 10.0)] {
            let found: Vec<f64> = points.clone().map(|p| at("v_l", p)).collect();
            assert!(found.iter().all(|x| (0.2 * size..=1.2 * size).contains(&x.abs())), "{found:?}");
            assert!(found.iter().any(|x| *x < 0.0) && found.iter().any(|x| *x > 0.0), "{found:?}");
            let positive = found.iter().filter(|x| **x > 0.0).count();
            assert!(positive.abs_diff(found.len() - positive) <= found.len() / 2, "{found:?}");
            for p in points {
                assert_ne!(at("v_l", p), at("v_t", p));
                assert_ne!(at("v_l", p), at("v_l", p + 1));
            }
        }
    }

    #[test]
    fn neutral_is_zero_for_what_may_be_and_a_start_for_what_divides() {
        let own = warm_creep();
        let at = |states_at_rest| Situation { own: &own, point: 3, states_at_rest };
        let state = own.effect.states.keys().next().unwrap();
        assert_eq!([at(true).number("k"), at(false).number("k"), at(true).number(state)], [0.0; 3]);
        assert_eq!(at(true).number("tau"), 0.5);
        assert_eq!(at(false).number(state), at(false).scattered(state));
        assert_eq!(at(true).number("v_l"), at(false).scattered("v_l"));
    }

    #[test]
    fn rounding_near_zero_and_far_from_it_is_no_difference() {
        assert!(close(0.1 + 0.2 - 0.3, 0.0) && close(1e9, 1e9 + 0.5) && close(0.3, 0.1 + 0.2));
        assert!(!close(1.0, 1.0 + 1e-6) && !close(0.0, 1e-6));
    }
}
