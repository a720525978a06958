//! What remains above the noise floor, in words.

use super::regime_text;
use crate::discrepancy::diagnosis::rest::{Excess, Rest};
use crate::discrepancy::localisation::driving_regimes::DrivingRegime;
use crate::discrepancy::report::{Remains, Verdict};
use crate::number_format::{plain, significant};

/// A rest as the report has it.
pub(crate) fn remains(rest: &Rest) -> Remains {
    let most = regime_text::disagreement(&rest.most);
    let says = says(rest);
    Remains { ratio: rest.excess.ratio, place: most.place, from: most.from, to: most.to, regime: most.regime, says }
}

/// A verdict's sentence with what remains as its second half.
pub(crate) fn admitted(sentence: &str, verdict: Verdict, rest: Option<&Rest>) -> String {
    let Some(rest) = rest.filter(|_| verdict != Verdict::UnusableData) else { return sentence.into() };
    let first = sentence.trim_end_matches('.');
    match verdict {
        // What remains is said once, and more than a trace is no trace.
        Verdict::NoMissingEffect => {
            format!("No effect is missing that can be named, but something remains: {}.", says(rest))
        }
        Verdict::Unexplained => format!("{first}: {}.", says(rest)),
        _ => format!("{first}, and something remains: {}.", says(rest)),
    }
}

fn says(rest: &Rest) -> String {
    let most = &rest.most;
    let Excess { ratio, horizon_s, of_heading } = rest.excess;
    let runs = if rest.is_held_out { "held-out" } else { "fitted" };
    let of = if of_heading { "heading" } else { "position" };
    let error = match rest.exceeds_floor() {
        false => "the model disagrees by more than the noise".into(),
        true => format!("{runs} {of} error after {} s is {} times the noise", plain(horizon_s), significant(ratio, 2)),
    };
    let most_of = if most.share > 0.5 { "most of it" } else { "the largest part of it" };
    let along = along(most.place);
    let during = match most.regime {
        DrivingRegime::Whole => String::new(),
        regime => format!(", in {}", regime_text::regime(regime)),
    };
    let [from, to] = most.span.map(|t| significant(t, 3));
    format!("{error}, {most_of} {along}, from {from} s to {to} s of {}{during}", most.run)
}

/// The direction of motion that the process noise of a place of the model stands for.
pub(super) fn along(place: &str) -> &'static str {
    match place {
        "rotation constraint" => "along the vehicle",
        "traverse constraint" => "across the vehicle",
        "yaw rate" => "in yaw",
        "force along the body" => "by a force along the vehicle",
        "force across the body" => "by a force across the vehicle",
        "torque on the body" => "by a torque on the vehicle",
        "torque on a trailer" => "by a torque on a trailer",
        "torque on a wheel" => "by a torque on a wheel",
        _ => "at the trailers",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::state::JUMPS;
    use std::collections::BTreeSet;

    #[test]
    fn every_component_of_the_process_noise_has_a_direction_of_its_own() {
        let said: BTreeSet<&str> = JUMPS.iter().map(|jump| along(jump.place)).collect();
        let places: BTreeSet<&str> = JUMPS.iter().map(|jump| jump.place).collect();
        assert_eq!(said.len(), places.len());
    }
    use crate::discrepancy::localisation::driving_regimes::Stretch;

    #[test]
    fn what_remains_is_the_second_half_of_the_sentence() {
        let rest = |regime| Rest {
            excess: Excess { ratio: 5.02, horizon_s: 5.0, of_heading: false },
            is_held_out: true,
            most: Stretch { run: "a.csv".into(), place: "yaw rate", span: [27.0, 58.04], regime, share: 0.8 },
        };
        let said = |verdict, regime| admitted("The model misses track-width.", verdict, Some(&rest(regime)));
        assert_eq!(
            said(Verdict::MissingEffect, DrivingRegime::Whole),
            "The model misses track-width, and something remains: held-out position error after 5 s is 5.0 times the noise, \
             most of it in yaw, from 27.0 s to 58.0 s of a.csv."
        );
        let unexplained = said(Verdict::Unexplained, DrivingRegime::LeftTurns);
        assert!(unexplained.starts_with("The model misses track-width: held-out"), "{unexplained}");
        assert!(unexplained.ends_with("to 58.0 s of a.csv, in left turns."), "{unexplained}");
        assert_eq!(said(Verdict::UnusableData, DrivingRegime::Whole), "The model misses track-width.");
        assert_eq!(admitted("Fine.", Verdict::NoMissingEffect, None), "Fine.");
        // What remains is more than a trace of it, and no ratio is given where the gap is at its floor.
        let none = said(Verdict::NoMissingEffect, DrivingRegime::Whole);
        assert!(none.starts_with("No effect is missing that can be named, but something remains: held-out"), "{none}");
        let whole = rest(DrivingRegime::Whole);
        let windows = says(&Rest { excess: Excess { ratio: 0.9, ..whole.excess }, ..whole });
        assert!(windows.starts_with("the model disagrees by more than the noise, most of it in yaw"), "{windows}");
        assert_eq!(remains(&rest(DrivingRegime::Fast)).regime, "fast driving");
    }
}
