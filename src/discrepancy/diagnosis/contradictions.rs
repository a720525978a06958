//! In words: effects that the runs ask for, but not all of their parts, or not with the inputs logged half as often.

use super::verdict::drive;
use crate::discrepancy::rendering::summary::{listed, listed_to};
use crate::discrepancy::report::NextExperiment;
use crate::discrepancy::selection::select::Choice;
use crate::discrepancy::selection::unnamed_terms;
use crate::effects::Applied;

/// Names in a sentence.
const NAMED: usize = 3;

/// That parts of the data ask for something differently; `None` where they agree.
fn contradiction(choice: &Choice) -> Option<String> {
    let names = named(&choice.unshared);
    names.map(|names| format!("parts of these runs ask for other values of {names}"))
}

/// That something would have another value, were the inputs logged half as often; `None` where nothing would.
pub(crate) fn too_seldom(choice: &Choice) -> Option<String> {
    let names = named(&choice.unsampled);
    names
        .map(|names| format!("with every second row of the inputs left out these runs ask for other values of {names}"))
}

/// Effects in words, terms by their place.
fn named(effects: &[Applied]) -> Option<String> {
    let mut names: Vec<String> = Vec::new();
    for effect in effects {
        let name = match unnamed_terms::is_term(effect) {
            true => format!("a law without name at the {}", effect.effect.place),
            false => effect.label(),
        };
        if !names.contains(&name) {
            names.push(name);
        }
    }
    // The last one takes no more room than its number.
    let most = if names.len() == NAMED + 1 { NAMED + 1 } else { NAMED };
    (!names.is_empty()).then(|| listed_to(&names, most))
}

/// Whether something was asked for by some of the runs' parts or rows only.
pub(crate) fn is_contested(choice: &Choice) -> bool {
    !choice.unshared.is_empty() || !choice.unsampled.is_empty()
}

/// What the report warns of where parts of the data contradict each other, or rows too far apart.
pub(crate) fn warnings(choice: &Choice) -> impl Iterator<Item = String> {
    let both = [contradiction(choice), too_seldom(choice)];
    both.into_iter().flatten().map(|asked| format!("{asked}, so that is not named"))
}

/// What mends runs whose parts contradict each other: no manoeuvre can be thought through with a model that is wrong,
/// but where speed and turn change by themselves a law shows as what it is.
pub(crate) fn settling(choice: &Choice) -> NextExperiment {
    let asked = contradiction(choice).unwrap_or_else(|| "what disagrees in these runs has no name".into());
    drive(&format!("{asked}: where speed and turn vary together, one law imitates another"))
}

/// What mends inputs that change between their rows.
pub(crate) fn oftener(why: &str) -> NextExperiment {
    NextExperiment {
        why: why.into(),
        manoeuvre: "log the inputs several times as often, or as means over the time between rows (input_timing = \
                    \"interval-mean\"), or drive with speeds and turns that change more slowly"
            .into(),
    }
}

/// What is named where more remains that is not.
pub(crate) fn partly(choice: &Choice) -> String {
    let names = listed(choice.chosen.iter().map(|c| c.applied.label()));
    format!("The model misses {names}; what else remains differs between parts of these runs and is not named.")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{applied, fit_of, unicycle};

    #[test]
    fn what_parts_or_rows_contradict_is_contested() {
        let asked = || vec![applied("traverse-creep")];
        let of = |unshared, unsampled| {
            let fit = fit_of(unicycle(&[]));
            let (before, after) = (fit.clone(), fit);
            let choice =
                Choice { before, after, chosen: vec![], steps: vec![], candidates: vec![], unshared, unsampled };
            (is_contested(&choice), warnings(&choice).count())
        };
        assert_eq!(of(vec![], vec![]), (false, 0));
        assert_eq!((of(asked(), vec![]), of(vec![], asked())), ((true, 1), (true, 1)));
        assert_eq!(of(asked(), asked()), (true, 2));
    }
}
