//! Effects that the runs ask for, but not all of their parts, or not with the inputs logged half as often.

use super::warning::Warning;
use crate::discrepancy::selection::choice::Selected;

/// Whether an effect was asked for by some of the runs' parts or rows only.
pub(crate) fn is_contested(choice: &Selected) -> bool {
    !choice.inconsistent.is_empty() || !choice.sampling_sensitive.is_empty()
}

/// What the report warns of where parts of the data contradict each other, or rows too far apart.
pub(crate) fn warnings(choice: &Selected) -> Vec<Warning> {
    let parts = (!choice.inconsistent.is_empty()).then(|| Warning::Inconsistent(choice.inconsistent.clone()));
    let seldom =
        (!choice.sampling_sensitive.is_empty()).then(|| Warning::SamplingSensitive(choice.sampling_sensitive.clone()));
    parts.into_iter().chain(seldom).collect()
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
                missed: vec![],
            };
            (is_contested(&choice), warnings(&choice).len())
        };
        assert_eq!(of(vec![], vec![]), (false, 0));
        assert_eq!((of(asked(), vec![]), of(vec![], asked())), ((true, 1), (true, 1)));
        assert_eq!(of(asked(), asked()), (true, 2));
    }
}
