//! What remains above the noise floor, in words.

use crate::discrepancy::diagnosis::rest::Rest;
use crate::discrepancy::localisation::driving_regimes::WHOLE_RUN;
use crate::discrepancy::report::{Remains, Verdict};
use crate::number_format::significant;

/// A rest as the report has it.
pub(crate) fn remains(rest: &Rest) -> Remains {
    let most = &rest.most;
    Remains {
        ratio: rest.ratio,
        place: most.place.clone(),
        from: most.from,
        to: most.to,
        regime: most.regime.clone(),
        says: says(rest),
    }
}

/// A verdict's sentence with what remains as its second half.
pub(crate) fn admitted(sentence: &str, verdict: Verdict, rest: Option<&Rest>) -> String {
    let Some(rest) = rest.filter(|_| verdict != Verdict::UnusableData) else { return sentence.into() };
    let first = sentence.trim_end_matches('.');
    match verdict {
        Verdict::Unexplained => format!("{first}: {}.", says(rest)),
        _ => format!("{first}, and something remains: {}.", says(rest)),
    }
}

fn says(rest: &Rest) -> String {
    let most = &rest.most;
    let judged = if rest.is_held_out { "held-out" } else { "fitted" };
    let along = match most.place.as_str() {
        "rotation constraint" => "along the vehicle",
        "traverse constraint" => "across the vehicle",
        "yaw rate" => "in yaw",
        _ => "at the trailers",
    };
    let during = if most.regime == WHOLE_RUN { String::new() } else { format!(", in {}", most.regime) };
    let [ratio, from, to] = [(rest.ratio, 2), (most.from, 3), (most.to, 3)].map(|(x, digits)| significant(x, digits));
    format!(
        "{judged} error is {ratio} times the noise, most of it {along}, from {from} s to {to} s of {}{during}",
        most.run
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::report::Disagreement;

    #[test]
    fn what_remains_is_the_second_half_of_the_sentence() {
        let most = |regime: &str| Disagreement {
            run: "a.csv".into(),
            place: "yaw rate".into(),
            from: 27.0,
            to: 58.04,
            regime: regime.into(),
            share_of_gap: 0.8,
        };
        let rest = |regime| Rest { ratio: 5.02, is_held_out: true, most: most(regime) };
        let said = |verdict, regime| admitted("The model misses track-width.", verdict, Some(&rest(regime)));
        assert_eq!(
            said(Verdict::MissingEffect, WHOLE_RUN),
            "The model misses track-width, and something remains: held-out error is 5.0 times the noise, most of it in yaw, \
             from 27.0 s to 58.0 s of a.csv."
        );
        assert!(said(Verdict::Unexplained, "left turns").ends_with(
            "track-width: held-out error is 5.0 times the noise, \
             most of it in yaw, from 27.0 s to 58.0 s of a.csv, in left turns."
        ));
        assert_eq!(said(Verdict::UnusableData, WHOLE_RUN), "The model misses track-width.");
        assert_eq!(admitted("Fine.", Verdict::NoMissingEffect, None), "Fine.");
    }
}
