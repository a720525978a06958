//! What was found in sentences for anyone: the effect's own template with its numbers, then when it holds and how it moves.

use super::title_text::title;
use crate::discrepancy::report::Named;
use crate::effects::{Applied, DrivingRegime, Scope, TypicalMotion};
use crate::number_format::significant;

/// Sentences that stand in a heading; more are counted.
const MOST: usize = 3;

/// An effect in a sentence without its end; its words where it has no template, or a number of it is undefined.
///
/// What moves with time is told as it is in the end.
pub(crate) fn plain(applied: &Applied, motion: TypicalMotion) -> String {
    let effect = &applied.effect;
    let told = in_the_end(applied, motion.until).in_plain_words(motion);
    let told = told.unwrap_or_else(|| capitalised(&effect.says));
    let scope = effect.scope.as_ref().map(|s| format!(", {}", in_words(s))).unwrap_or_default();
    let course = match (&effect.course, &effect.walk) {
        (Some(_), _) => format!(", at {} s, and this changes with time", significant(motion.until, 3)),
        (_, Some(_)) => ", and this wanders".into(),
        _ => String::new(),
    };
    format!("{}{scope}{course}", told.trim_end_matches('.'))
}

/// When or where an effect holds, for anyone: a rate that passes a bound has words in place of its formula.
fn in_words(scope: &Scope) -> String {
    let Some((regime, bound)) = scope.regime_beyond() else { return scope.to_string() };
    let by = |unit: &str| format!("{} {unit}", significant(bound, 2));
    match regime {
        DrivingRegime::SpeedingUp => format!("while it gains more than {} every second", by("m/s")),
        DrivingRegime::SlowingDown => format!("while it loses more than {} every second", by("m/s")),
        DrivingRegime::Forward => format!("forward, above {}", by("m/s")),
        DrivingRegime::Reverse => format!("in reverse, above {}", by("m/s")),
        DrivingRegime::Left => format!("in left turns faster than {}", by("rad/s")),
        DrivingRegime::Right => format!("in right turns faster than {}", by("rad/s")),
    }
}

/// Several findings, sentence after sentence.
pub(crate) fn sentences(effects: &[Named]) -> String {
    told(effects, |e| e.plain.clone())
}

/// The same, each with its id.
pub(crate) fn sentences_with_ids(effects: &[Named]) -> String {
    told(effects, |e| if e.plain.is_empty() { title(e) } else { format!("{} ({})", e.plain, e.id) })
}

/// The effect as it is at a time.
fn in_the_end(applied: &Applied, until: f64) -> Applied {
    let mut found = applied.clone();
    let Some(course) = &applied.effect.course else { return found };
    let place = |name: &str| applied.effect.parameters.keys().position(|p| p == name);
    if let (Some(value), Some(rate)) = (place(&course.parameter), place(&course.rate())) {
        found.values[value] += applied.values[rate] * (until - course.since);
    }
    found
}

fn told(effects: &[Named], each: impl Fn(&Named) -> String) -> String {
    let shown: Vec<String> = effects.iter().take(MOST).map(|e| format!("{}.", each(e))).collect();
    let more = effects.len().saturating_sub(MOST);
    match more {
        0 => shown.join(" "),
        1 => format!("{} And one more.", shown.join(" ")),
        more => format!("{} And {more} more.", shown.join(" ")),
    }
}

/// A sentence within another one.
pub(crate) fn within(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |c| c.to_lowercase().chain(rest).collect())
}

/// A sentence of its own.
pub(crate) fn capitalised(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |c| c.to_uppercase().chain(rest).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{self, Effect};

    #[test]
    fn a_rate_beyond_a_bound_has_words() {
        let words = |formula: &str| in_words(&Scope::Where(crate::formula::Expr::parse(formula).unwrap()));
        assert_eq!(words("-sign(v_0)*v_0' - 0.17608"), "while it loses more than 0.18 m/s every second");
        assert_eq!(words("w_0 - 0.5"), "in left turns faster than 0.50 rad/s");
        assert_eq!(words("x - 3"), "where x - 3 > 0");
    }

    #[test]
    fn an_effect_is_told_with_its_scope_and_without_a_template() {
        let motion = TypicalMotion { speed: 1.0, turning: 0.5, until: 90.0 };
        let creep = effects::named("rotation-creep").unwrap().within(Scope::Regime(DrivingRegime::Reverse));
        let told = plain(&Applied::new(&creep, None, vec![0.05]), motion);
        assert!(told.starts_with("The wheels travel 5.0 % less than they turn, "), "{told}");
        let own = Effect { says: "it slides".into(), ..Effect::default() };
        assert_eq!(plain(&Applied::new(&own, None, vec![]), motion), "It slides");
        // No number where none is defined: the sentence falls back to the words of the effect.
        let slips = effects::named("saturating-creep").unwrap();
        let told = plain(&Applied::new(slips, None, vec![0.1, 0.0]), motion);
        assert_eq!(told, "The vehicle slides outwards or inwards in turns, and no faster than a limit");
        let warming = effects::named("yaw-rate-bias").unwrap().drifting("bias", 10.0).unwrap();
        let told = plain(&Applied::new(&warming, None, vec![0.0, 0.001]), motion);
        assert!(told.starts_with("The robot turns 4.6°/s further to the left"), "{told}");
        assert!(told.ends_with(", at 90.0 s, and this changes with time"), "{told}");
    }
}
