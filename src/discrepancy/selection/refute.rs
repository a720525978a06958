//! What runs refute, those fitted by their own gaps and held-out ones: taken out of a choice after the last of it was made.

use super::search::{Search, SearchState, forget};
use super::second_choice::second_choice;
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
use crate::model::effect_equation::is_term;
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
///
/// Where the fitted runs refute a name, the search is repeated without it: the right one may have been passed over beside it.
pub(crate) fn refute(
    problem: &Problem,
    library: &[Effect],
    choice: Selected,
    judges: &[&dyn JudgingRuns],
    progress: &OnProgress,
) -> Result<Selected> {
    let before = choice.before.clone();
    let quick = transients::without_transients(library);
    let search = Search::over(problem, &before, &quick);
    let judges: Vec<_> = judges.iter().filter(|j| j.can_judge()).collect();
    if judges.is_empty() {
        return Ok(choice);
    }
    let mut judged = Judged::of(&search, choice)?;
    for judge in judges {
        judged.drop_refuted(&search, *judge, progress)?;
        let is_refuted = judged.choice.refused.iter().any(|r| matches!(r.why, Refusal::FittedRuns(_)));
        if judge.which() != Judging::Fitted || !is_refuted {
            continue;
        }
        if let Some(second) = second_choice(&search, &judged.choice, progress)? {
            judged = Judged::of(&search, second)?;
            judged.drop_refuted(&search, *judge, progress)?;
        }
    }
    let Selected { mut chosen, refused, .. } = judged.choice;
    for c in &mut chosen {
        c.rivals.retain(|rival| !refused.iter().any(|r| r.applied.same_as(rival)));
    }
    Ok(Selected { chosen, refused, ..judged.choice })
}

/// A choice, and the fits without each of its effects.
struct Judged {
    choice: Selected,
    without: Vec<Option<Fit>>,
}

impl Judged {
    fn of(search: &Search, choice: Selected) -> Result<Self> {
        let without = search.without_each(&choice.after, &choice.chosen)?;
        Ok(Self { choice, without })
    }

    /// Takes out what a judge refutes, one effect after another; what is left of the others stands or falls anew.
    fn drop_refuted(&mut self, search: &Search, judge: &dyn JudgingRuns, progress: &OnProgress) -> Result<()> {
        let noise = self.choice.after.noise();
        while let Some((applied, why, smaller)) =
            search.refuted(&self.choice.after, &self.choice.chosen, &self.without, judge, &noise)?
        {
            let in_its_place = search.borne_out_rival(&self.choice, &smaller, &applied, judge)?;
            let Selected { after, chosen, steps, candidates, refused, missed, .. } = &mut self.choice;
            refused.push(Refused::of(chosen, applied.clone(), why));
            forget(missed, after, &applied);
            let (fit, way, all) = (after.clone(), std::mem::take(steps), std::mem::take(candidates));
            let mut grown = SearchState { fit, steps: way, candidates: all, refused: vec![] };
            let standing = match in_its_place {
                Some(rival) => {
                    grown.go_back_to(rival);
                    search.keep_sampled_and_standing(&mut grown, None, progress)?.1
                }
                None => {
                    grown.go_back_to(smaller);
                    search.keep_standing(&mut grown, None, std::mem::take(missed), progress)?
                }
            };
            refused.extend(standing.refused);
            (*chosen, *missed) = (standing.chosen, standing.missed);
            (*after, *steps, *candidates) = (grown.fit, grown.steps, grown.candidates);
            self.without = search.without_each(&self.choice.after, &self.choice.chosen)?;
        }
        Ok(())
    }
}

impl Search<'_> {
    /// The fit without each of the chosen effects.
    fn without_each(&self, fit: &Fit, chosen: &[SelectedEffect]) -> Result<Vec<Option<Fit>>> {
        chosen.iter().map(|c| self.without(fit, &c.applied)).collect()
    }

    /// The fit with a rival in the place of an effect with a name that runs refute: where the fitted data do not tell the two, and
    /// these runs refute the one and are predicted better with the other, they tell them.
    fn borne_out_rival(
        &self,
        choice: &Selected,
        smaller: &Fit,
        applied: &Applied,
        judge: &dyn JudgingRuns,
    ) -> Result<Option<Fit>> {
        let chosen = choice.chosen.iter().find(|c| c.applied.same_as(applied) && !is_term(applied));
        let rivals = chosen.map_or(&[][..], |c| &c.rivals);
        for rival in rivals.iter().filter(|r| !choice.refused.iter().any(|f| f.applied.same_as(r))) {
            let model = smaller.model.clone().with_effect(rival.clone().freed());
            let Some(with) = self.fit_instead(&choice.after, &model)? else { continue };
            let gaps = judge.gaps([&with.model, &smaller.model], &choice.after.noise())?;
            if helps(&gaps) && refuting(judge.which(), &gaps).is_none() {
                return Ok(Some(with));
            }
        }
        Ok(None)
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
    use crate::discrepancy::fixtures::{WEAVING, applied, equations, logged, unicycle};
    use crate::discrepancy::selection::select::choose;
    use crate::effects::all;
    use crate::progress::unheard;

    /// Gaps that grow with one effect, and shrink with another.
    struct Told {
        grows: &'static str,
        shrinks: &'static str,
    }

    impl JudgingRuns for Told {
        fn which(&self) -> Judging {
            Judging::HeldOutRuns
        }

        fn can_judge(&self) -> bool {
            true
        }

        fn gaps(&self, [with, without]: [&Model; 2], _: &Noise) -> Result<Vec<Growth>> {
            let of = |m: &Model| {
                m.free_effects().fold(0.1, |gap, e| match e.effect.id.as_str() {
                    id if id == self.grows => 2.0 * gap,
                    id if id == self.shrinks => 0.5 * gap,
                    _ => gap,
                })
            };
            Ok(vec![Growth { horizon_s: 5.0, of_heading: false, gap: [of(without), of(with)], floor: 0.01 }])
        }
    }

    /// Names and refusals where runs judge what a run with a crab angle was fitted by.
    fn judged(judge: Told) -> [Vec<String>; 2] {
        let (equations, p) = equations(&[("traverse-creep", &[-0.05])]);
        let time = (0..600).map(|i| 0.05 * f64::from(i)).collect();
        let run = logged((&equations, &p), time, WEAVING, &[0.0; 3], 1e-3);
        let problem = Problem::new(vec![run], None, None);
        let bare = unicycle(&[]);
        let choice = choose(&problem, &bare, all(), &unheard).unwrap().unwrap();
        let [first] = &choice.chosen[..] else { panic!("{:?}", choice.chosen) };
        assert_eq!(first.applied.effect.id, "traverse-creep");
        let rivals = vec![applied("heading-misalignment")];
        let choice = Selected { chosen: vec![SelectedEffect { rivals, ..first.clone() }], ..choice };
        let found = refute(&problem, all(), choice, &[&judge], &unheard).unwrap();
        let ids = |of: &mut dyn Iterator<Item = &Applied>| of.map(|a| a.effect.id.clone()).collect::<Vec<String>>();
        assert!(found.chosen.iter().all(|c| !c.rivals.iter().any(|r| r.effect.id == "traverse-creep")));
        [ids(&mut found.chosen.iter().map(|c| &c.applied)), ids(&mut found.refused.iter().map(|r| &r.applied))]
    }

    /// What the fitted run does not tell apart, runs of their own may.
    #[test]
    fn a_rival_that_runs_bear_out_takes_the_place_of_what_they_refute() {
        let none: [&str; 0] = [];
        let borne_out = judged(Told { grows: "traverse-creep", shrinks: "heading-misalignment" });
        assert_eq!(borne_out, [["heading-misalignment"], ["traverse-creep"]].map(|ids| ids.map(String::from).to_vec()));
        // One that says nothing of them does not.
        let [chosen, refused] = judged(Told { grows: "traverse-creep", shrinks: "lever-arm" });
        assert_eq!((chosen, refused), (none.map(String::from).to_vec(), vec!["traverse-creep".to_string()]));
        let [chosen, refused] = judged(Told { grows: "lever-arm", shrinks: "traverse-creep" });
        assert_eq!((chosen, refused), (vec!["traverse-creep".to_string()], none.map(String::from).to_vec()));
    }

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
