//! What held-out runs refute, or those fitted by their own gaps: taken out of a choice after the last of it was made.

use super::search::{Search, SearchState, forget};
use super::transients;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::unexplained::remains;
use crate::discrepancy::selection::choice::{Growth, Refusal, Refused, Selected, SelectedEffect};
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;
use crate::progress::OnProgress;

/// Beside a rest an effect that not every vehicle has and that is worth less than so many times its price must help held-out
/// runs of their own: it may imitate a part of the rest.
const WEAK: f64 = 3.0;

/// Runs that judge what was found.
pub(crate) trait JudgingRuns {
    /// Whether they are those it was fitted to.
    fn are_fitted(&self) -> bool;

    /// Whether there are runs that can judge.
    fn can_judge(&self) -> bool;

    /// Whether they are drives of their own.
    fn are_own_runs(&self) -> bool;

    /// The gaps of position and heading with the first of two models in the place of the second.
    fn gaps(&self, with: &Model, without: &Model) -> Result<Vec<Growth>>;
}

/// Takes out of a choice what held-out runs, or the runs fitted, are predicted worse with, an effect beside all others or what was found as a
/// whole.
pub(crate) fn refute(
    problem: &Problem,
    library: &[Effect],
    choice: Selected,
    judge: &dyn JudgingRuns,
    progress: &OnProgress,
) -> Result<Selected> {
    if !judge.can_judge() {
        return Ok(choice);
    }
    let Selected {
        before,
        after,
        mut chosen,
        steps,
        candidates,
        inconsistent,
        sampling_sensitive,
        mut refused,
        mut missed,
    } = choice;
    let quick = transients::without_transients(library);
    let search = Search::over(problem, &before, &quick);
    let mut grown = SearchState { fit: after, steps, candidates, refused: vec![] };
    while let Some((applied, why, smaller)) = next(&search, &grown.fit, &chosen, judge)? {
        forget(&mut missed, &grown.fit, &applied);
        grown.go_back_to(smaller);
        refused.push(Refused::of(&chosen, applied, why));
        // What is left of the others stands or falls anew.
        let standing = search.keep_standing(&mut grown, None, missed, progress)?;
        (chosen, missed) = (standing.chosen, standing.missed);
        refused.extend(standing.refused);
    }
    let SearchState { fit: after, steps, candidates, .. } = grown;
    Ok(Selected { before, after, chosen, steps, candidates, inconsistent, sampling_sensitive, refused, missed })
}

/// The next effect to be taken out, why, and the fit without it.
fn next(
    search: &Search,
    fit: &Fit,
    chosen: &[SelectedEffect],
    judge: &dyn JudgingRuns,
) -> Result<Option<(Applied, Refusal, Fit)>> {
    let mut worst: Option<(f64, Applied, Refusal, Fit)> = None;
    for c in chosen {
        let Some(smaller) = search.without(fit, &c.applied)? else { continue };
        let gaps = judge.gaps(&fit.model, &smaller.model)?;
        // On the runs fitted a name that makes any gap smaller does what it was found for.
        if judge.are_fitted() && gaps.iter().any(Growth::shrinks) {
            continue;
        }
        let Some(growth) = most_grown(&gaps) else {
            let is_weak = !c.applied.effect.basic && c.delta_bic < WEAK * search.margin();
            if is_weak && judge.are_own_runs() && remains(fit) && !gaps.iter().any(Growth::shrinks) {
                return Ok(Some((c.applied.clone(), Refusal::NotBorneOut, smaller)));
            }
            continue;
        };
        let refusal = if judge.are_fitted() { Refusal::OwnRuns } else { Refusal::HeldOut };
        let (factor, why) = (growth.factor(), refusal(growth));
        if worst.as_ref().is_none_or(|(f, ..)| factor > *f) {
            worst = Some((factor, c.applied.clone(), why, smaller));
        }
    }
    if let Some((_, applied, why, smaller)) = worst {
        return Ok(Some((applied, why, smaller)));
    }
    if judge.are_fitted() {
        return Ok(None);
    }
    // Where only all together make it grow, the one that is worth least goes.
    let least = chosen.iter().min_by(|a, b| a.delta_bic.total_cmp(&b.delta_bic));
    let Some(least) = least else { return Ok(None) };
    let Some(growth) = most_grown(&judge.gaps(&fit.model, &search.before.model)?) else { return Ok(None) };
    let smaller = search.without(fit, &least.applied)?;
    Ok(smaller.map(|smaller| (least.applied.clone(), Refusal::HeldOutTogether(growth), smaller)))
}

/// The gap that grows most, of those that do: what shrinks the gap of the same quantity at another horizon is not refuted.
fn most_grown(gaps: &[Growth]) -> Option<Growth> {
    let is_one_way = |g: &&Growth| !gaps.iter().any(|other| other.of_heading == g.of_heading && other.shrinks());
    gaps.iter().filter(|g| g.is_real()).filter(is_one_way).max_by(|a, b| a.factor().total_cmp(&b.factor())).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gap_grows_beyond_its_floor_and_the_largest_counts() {
        let gap = |gap: [f64; 2], floor: f64| Growth { horizon_s: 1.0, of_heading: false, gap, floor };
        assert_eq!(most_grown(&[gap([0.1, 0.12], 0.01), gap([0.01, 0.02], 0.02)]), None);
        let grown = [gap([0.1, 0.2], 0.01), gap([0.1, 0.3], 0.01)];
        assert!((most_grown(&grown).unwrap().factor() - 3.0).abs() < 1e-12);
        // What helps at another horizon is not refuted, what helps the heading alone is.
        let shrunk = gap([0.1, 0.05], 0.01);
        assert_eq!(most_grown(&[grown[0], grown[1], shrunk]), None);
        assert!(most_grown(&[grown[0], Growth { of_heading: true, ..shrunk }]).is_some());
        assert!(gap([0.1, 0.08], 0.01).shrinks() && !gap([0.1, 0.095], 0.01).shrinks());
    }
}
