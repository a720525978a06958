//! What runs refute, those fitted by their own gaps and held-out ones: taken out of a choice after the last of it was made.

use super::search::{Search, SearchState, forget};
use super::transients;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::estimation::unexplained::remains;
use crate::discrepancy::evidence::information_criterion::careful_delta_bic;
use crate::discrepancy::record::sensor_noise::Noise;
use crate::discrepancy::selection::choice::{Growth, Refusal, Refused, Selected, SelectedEffect};
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;
use crate::progress::OnProgress;

/// Beside a rest an effect that not every vehicle has and that is worth less than so many times its price must help held-out
/// runs of their own: it may imitate a part of the rest.
const WEAK: f64 = 3.0;

/// Which runs judge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Judging {
    /// Those that were fitted.
    Fitted,
    /// The ends of those fitted, which were not.
    HeldOutEnds,
    /// Drives of their own.
    HeldOutRuns,
}

/// Runs that judge what was found.
pub(crate) trait JudgingRuns {
    /// Which they are.
    fn which(&self) -> Judging;

    /// Whether there are runs that can judge.
    fn can_judge(&self) -> bool;

    /// The gaps of position and heading with the first of two models in the place of the second, beside noise.
    fn gaps(&self, models: [&Model; 2], noise: &Noise) -> Result<Vec<Growth>>;
}

/// Takes out of a choice what runs are predicted worse with, an effect beside all others or what was found as a whole; one
/// judge is asked after the other.
pub(crate) fn refute(
    problem: &Problem,
    library: &[Effect],
    choice: Selected,
    judges: &[&dyn JudgingRuns],
    progress: &OnProgress,
) -> Result<Selected> {
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
    let judges: Vec<_> = judges.iter().filter(|j| j.can_judge()).collect();
    let mut without = if judges.is_empty() { vec![] } else { search.without_each(&grown.fit, &chosen)? };
    for judge in judges {
        let noise = grown.fit.noise();
        while let Some((applied, why, smaller)) = search.refuted(&grown.fit, &chosen, &without, *judge, &noise)? {
            forget(&mut missed, &grown.fit, &applied);
            grown.go_back_to(smaller);
            refused.push(Refused::of(&chosen, applied, why));
            // What is left of the others stands or falls anew.
            let standing = search.keep_standing(&mut grown, None, missed, progress)?;
            (chosen, missed) = (standing.chosen, standing.missed);
            refused.extend(standing.refused);
            without = search.without_each(&grown.fit, &chosen)?;
        }
    }
    let SearchState { fit: after, steps, candidates, .. } = grown;
    Ok(Selected { before, after, chosen, steps, candidates, inconsistent, sampling_sensitive, refused, missed })
}

impl Search<'_> {
    /// The fit without each of the chosen effects.
    fn without_each(&self, fit: &Fit, chosen: &[SelectedEffect]) -> Result<Vec<Option<Fit>>> {
        chosen.iter().map(|c| self.without(fit, &c.applied)).collect()
    }

    /// The next effect that runs refute, why, and the fit without it.
    fn refuted(
        &self,
        fit: &Fit,
        chosen: &[SelectedEffect],
        without: &[Option<Fit>],
        judge: &dyn JudgingRuns,
        noise: &Noise,
    ) -> Result<Option<(Applied, Refusal, Fit)>> {
        let gaps_without = |smaller: &Model| judge.gaps([&fit.model, smaller], noise);
        let mut worst: Option<(Growth, &SelectedEffect, &Fit)> = None;
        for (c, smaller) in chosen.iter().zip(without) {
            // What walks has another value there: no one value is refuted by that.
            let Some(smaller) = smaller.as_ref().filter(|_| c.applied.effect.walk.is_none()) else { continue };
            let gaps = gaps_without(&smaller.model)?;
            let Some(growth) = refuting(judge.which(), &gaps) else {
                let n = fit.sample_size.max(smaller.sample_size);
                let is_weak = !c.applied.effect.basic && careful_delta_bic(fit, smaller, n) < WEAK * self.margin();
                if is_weak && judge.which() == Judging::HeldOutRuns && remains(fit) && !helps(&gaps) {
                    return Ok(Some((c.applied.clone(), Refusal::NotBorneOut, smaller.clone())));
                }
                continue;
            };
            if worst.as_ref().is_none_or(|(most, ..)| growth.factor() > most.factor()) {
                worst = Some((growth, c, smaller));
            }
        }
        let why = match judge.which() {
            Judging::Fitted => Refusal::FittedRuns,
            Judging::HeldOutEnds | Judging::HeldOutRuns => Refusal::HeldOut,
        };
        if let Some((growth, c, smaller)) = worst {
            return Ok(Some((c.applied.clone(), why(growth), smaller.clone())));
        }
        let walks = chosen.iter().any(|c| c.applied.effect.walk.is_some());
        let least = worth_least(chosen, without).filter(|_| judge.which() != Judging::Fitted && !walks);
        let Some((least, smaller)) = least else {
            return Ok(None);
        };
        // Where only all together make a gap grow, the effect that is worth least goes.
        let growth = most_grown(&gaps_without(&self.before.model)?);
        Ok(growth.map(|growth| (least.applied.clone(), Refusal::HeldOutTogether(growth), smaller.clone())))
    }
}

/// The effect that is worth least, and the fit without it.
fn worth_least<'a>(chosen: &'a [SelectedEffect], without: &'a [Option<Fit>]) -> Option<(&'a SelectedEffect, &'a Fit)> {
    let (least, smaller) = chosen.iter().zip(without).min_by(|(a, _), (b, _)| a.delta_bic.total_cmp(&b.delta_bic))?;
    Some((least, smaller.as_ref()?))
}

/// Whether any gap shrinks.
fn helps(gaps: &[Growth]) -> bool {
    gaps.iter().any(Growth::shrinks)
}

/// The gap by which runs refute an effect. On the runs fitted an effect that makes any gap smaller does what it was found for.
fn refuting(which: Judging, gaps: &[Growth]) -> Option<Growth> {
    most_grown(gaps).filter(|_| which != Judging::Fitted || !helps(gaps))
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
        // The runs fitted do not refute what makes their other gap smaller.
        let heading = Growth { of_heading: true, ..grown[1] };
        assert!(refuting(Judging::HeldOutRuns, &[heading, shrunk]).is_some());
        assert_eq!(refuting(Judging::Fitted, &[heading, shrunk]), None);
        assert_eq!(refuting(Judging::Fitted, &[heading, grown[0]]), Some(heading));
        assert!(gap([0.1, 0.08], 0.01).shrinks() && !gap([0.1, 0.095], 0.01).shrinks());
    }
}
