//! In words: effects that the runs ask for, but not all of their parts, or not with the inputs logged half as often.

use crate::discrepancy::diagnosis::advice::{contradiction, named};
use crate::discrepancy::selection::choice::Selected;
use crate::wording::listed;

/// That something would have another value, were the inputs logged half as often; `None` where nothing would.
pub(crate) fn too_seldom(choice: &Selected) -> Option<String> {
    let names = named(&choice.sampling_sensitive);
    names
        .map(|names| format!("with every second row of the inputs left out these runs ask for other values of {names}"))
}

/// Whether something was asked for by some of the runs' parts or rows only.
pub(crate) fn is_contested(choice: &Selected) -> bool {
    !choice.inconsistent.is_empty() || !choice.sampling_sensitive.is_empty()
}

/// What the report warns of where parts of the data contradict each other, or rows too far apart.
pub(crate) fn warnings(choice: &Selected) -> impl Iterator<Item = String> {
    let both = [contradiction(choice), too_seldom(choice)];
    both.into_iter().flatten().map(|asked| format!("{asked}, so that is not named"))
}

/// What is named where more remains that is not.
pub(crate) fn partly(choice: &Selected) -> String {
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
        let of = |inconsistent, sampling_sensitive| {
            let fit = fit_of(unicycle(&[]));
            let (before, after) = (fit.clone(), fit);
            let choice = Selected {
                before,
                after,
                chosen: vec![],
                steps: vec![],
                candidates: vec![],
                inconsistent,
                sampling_sensitive,
                refused: vec![],
            };
            (is_contested(&choice), warnings(&choice).count())
        };
        assert_eq!(of(vec![], vec![]), (false, 0));
        assert_eq!((of(asked(), vec![]), of(vec![], asked())), ((true, 1), (true, 1)));
        assert_eq!(of(asked(), asked()), (true, 2));
    }
}
