//! A run that differs from the others, in words.

use super::plain_text;
use crate::discrepancy::diagnosis::findings::estimates;
use crate::discrepancy::report::{OddRun, Verdict};
use crate::discrepancy::selection::odd_run;
use crate::effects::{Applied, TypicalMotion};
use crate::number_format::with_error;
use crate::wording::listed;

/// An odd run as the report lists it.
pub(crate) fn odd_run(of: &odd_run::OddRun, motion: TypicalMotion) -> OddRun {
    let (values, std): (Vec<f64>, Vec<Option<f64>>) = of.others.iter().copied().unzip();
    OddRun {
        run: of.run.clone(),
        id: of.applied.effect.id.clone(),
        parameters: estimates(&of.applied, &of.std),
        others: estimates(&Applied { values, ..of.applied.clone() }, &std),
        plain: plain_text::plain(&of.applied, motion),
        says: says(of),
    }
}

/// That a run differs, with its value and that of the others.
pub fn says(of: &odd_run::OddRun) -> String {
    let each = of.applied.effect.parameters.iter().zip(&of.applied.values).zip(of.std.iter().zip(&of.others));
    let values = each.map(|(((name, p), value), (std, (other, of_others)))| {
        let unit = if p.unit == "1" { String::new() } else { format!(" {}", p.unit) };
        let [here, there] = [(*value, *std), (*other, *of_others)].map(|(value, std)| with_error(value, std));
        format!("{name} = {here}{unit}, where the others have {there}{unit}")
    });
    format!("{} differs from the other runs by {}: {}", of.run, of.applied.label(), listed(values))
}

/// A sentence of the other runs with those that differ before it.
pub(crate) fn before(odd: &[odd_run::OddRun], sentence: &str) -> String {
    if odd.is_empty() {
        return sentence.into();
    }
    let each: String = odd.iter().map(|o| format!("{}. ", says(o))).collect();
    let mut rest = sentence.chars();
    let first: String = rest.next().map(|c| c.to_lowercase().collect()).unwrap_or_default();
    let pronoun = if odd.len() == 1 { "it" } else { "them" };
    format!("{each}Without {pronoun}, {first}{}", rest.as_str())
}

/// The verdict of all runs by that of those that agree: what one run has is named.
pub(crate) fn verdict(of_others: Verdict, odd: &[odd_run::OddRun]) -> Verdict {
    match of_others {
        Verdict::NoMissingEffect | Verdict::NotIdentifiable if !odd.is_empty() => Verdict::MissingEffect,
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::applied;

    #[test]
    fn a_run_that_differs_is_told_before_the_others() {
        let odd = odd_run::OddRun {
            run: "run_3.csv".into(),
            applied: Applied { values: vec![0.04], ..applied("traverse-creep") },
            std: vec![Some(0.002)],
            others: vec![(0.001, Some(0.0005))],
        };
        let said = before(std::slice::from_ref(&odd), "The model explains these runs.");
        assert_eq!(
            said,
            "run_3.csv differs from the other runs by traverse-creep: e_tc = 0.0400 ± 0.0020, where the others have \
             0.00100 ± 0.00050. Without it, the model explains these runs."
        );
        assert_eq!(before(&[], "Fine."), "Fine.");
        let motion = TypicalMotion { speed: 1.0, turning: 0.5, until: 60.0 };
        let listed = odd_run(&odd, motion);
        assert_eq!((listed.parameters["e_tc"].value, listed.others["e_tc"].value), (0.04, 0.001));
        let all = [Verdict::NoMissingEffect, Verdict::Unexplained, Verdict::UnusableData];
        let told = all.map(|v| verdict(v, std::slice::from_ref(&odd)));
        assert_eq!(told, [Verdict::MissingEffect, Verdict::Unexplained, Verdict::UnusableData]);
        assert_eq!(all.map(|v| verdict(v, &[])), all);
    }
}
