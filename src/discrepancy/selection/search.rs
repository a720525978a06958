//! Effects added to a model one or two at a time, each asked whether it predicts.

use super::memo::Memo;
use crate::discrepancy::estimation::fit::Effort;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::Problem;
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;
use crate::wording::listed;

/// Most effects that are added.
const MOST: usize = 6;

/// A candidate effect and its evidence beside the effects already chosen.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The effect at its fitted values.
    pub applied: Applied,
    /// Standard deviations its values have, to first order.
    pub std: Vec<f64>,
    /// BIC without minus BIC with the effect.
    pub delta_bic: f64,
}

/// What a search ends with.
pub(crate) struct SearchState {
    /// The model with what was found.
    pub fit: Fit,
    /// The models on the way, after each addition.
    pub steps: Vec<(String, Model)>,
    /// All candidates as they stood against the model the search began with.
    pub candidates: Vec<Candidate>,
    /// What the data asked for at the end, and parts of them did not bear out.
    pub refused: Vec<Applied>,
}

/// Effects that are added together, and the model with them.
pub(crate) type Addition = (Vec<Applied>, Fit);

impl SearchState {
    /// Nothing added yet.
    pub fn from(fit: &Fit) -> Self {
        Self { fit: fit.clone(), steps: vec![], candidates: vec![], refused: vec![] }
    }

    /// To a smaller model, which is then the only step.
    pub fn go_back_to(&mut self, smaller: Fit) {
        let step = (listed(smaller.model.free_effects().map(Applied::label)), smaller.model.clone());
        self.steps = if smaller.p.is_empty() { vec![] } else { vec![step] };
        self.fit = smaller;
    }
}

/// A search over a library.
pub(crate) struct Search<'a> {
    pub problem: &'a Problem,
    /// The model as given, with its noise and jumps.
    pub before: &'a Fit,
    pub library: &'a [Effect],
    /// How many candidates the library has for the vehicle.
    pub size: f64,
    /// Most effects that are added.
    pub most: usize,
    /// Whether others are tried in the place of those chosen.
    pub exchanges: bool,
    /// Whether those the search begins with may be dropped.
    pub drops: bool,
    /// What was asked of the problem, where it may be asked again.
    pub memo: Option<&'a Memo>,
}

/// A model without an effect that was found; one that the model as given has with a value of its own has it again.
pub(crate) fn without_effect(model: &Model, effect: &Applied, given: &Model) -> Model {
    let mut smaller = model.clone();
    smaller.effects.retain(|e| !e.same_as(effect));
    let given = given.effects.iter().filter(|e| !e.free && e.same_as(effect));
    smaller.effects.extend(given.cloned());
    smaller
}

impl<'a> Search<'a> {
    /// The whole search over a library.
    pub fn over(problem: &'a Problem, before: &'a Fit, library: &'a [Effect]) -> Self {
        let size = before.model.applicable(library).len().max(1) as f64;
        Self { problem, before, library, size, most: MOST, exchanges: true, drops: true, memo: None }
    }

    /// What a candidate must gain beyond BIC because the library is large.
    pub fn margin(&self) -> f64 {
        2.0 * self.size.ln()
    }

    /// What a parameter costs: the margin beyond BIC and its own term.
    pub fn price(&self, fit: &Fit) -> f64 {
        self.margin() + fit.sample_size.ln()
    }

    /// A fit with noise and jumps of its own.
    pub fn refit(&self, fit: &Fit) -> Result<Option<Fit>> {
        self.problem.fit(&fit.model, &fit.window_states, &fit.variances, Effort::FULL)
    }

    /// Another model fitted where a fit is, with noise and jumps of its own.
    ///
    /// From the jumps of the model as given: what an effect leaves unexplained is not found from zero jumps, where the
    /// likelihood is flat.
    pub fn fit_instead(&self, fit: &Fit, model: &Model) -> Result<Option<Fit>> {
        self.problem.fit(model, &fit.window_states, &self.before.variances, Effort::FULL)
    }
}

/// An effect of a model.
pub(crate) fn find(model: &Model, like: &Applied) -> Option<Applied> {
    model.effects.iter().find(|e| e.same_as(like)).cloned()
}

/// The effects of a library without those that were given up.
pub(crate) fn still_open<'e>(library: impl IntoIterator<Item = &'e Effect>, given_up: &[Applied]) -> Vec<Effect> {
    let is_open = |e: &&Effect| given_up.iter().all(|g| g.effect.id != e.id || g.effect.on != e.on);
    library.into_iter().filter(is_open).cloned().collect()
}

/// Where the values of an effect begin among the free ones.
pub(crate) fn first_of(fit: &Fit, effect: &Applied) -> usize {
    fit.model.free_effects().take_while(|e| !e.same_as(effect)).map(|e| e.values.len()).sum()
}

/// Numbers that stand for the free values of a fit, without those of an effect.
pub(crate) fn forget(numbers: &mut Vec<f64>, fit: &Fit, effect: &Applied) {
    let mut at = 0;
    for e in fit.model.free_effects() {
        let values = e.values.len();
        if e.same_as(effect) && at + values <= numbers.len() {
            numbers.drain(at..at + values);
            return;
        }
        at += values;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{KNOWN, applied, fit_of, unicycle};

    #[test]
    fn the_numbers_of_one_effect_are_forgotten() {
        let fit = fit_of(unicycle(&KNOWN));
        let without = |id: &str, mut numbers: Vec<f64>| {
            forget(&mut numbers, &fit, &applied(id));
            numbers
        };
        let all = vec![1.0, 2.0, 3.0, 4.0];
        let left = ["traction-creep", "relaxation-length", "traverse-creep"].map(|id| without(id, all.clone()));
        assert_eq!(left, [vec![2.0, 3.0, 4.0], vec![1.0, 4.0], vec![1.0, 2.0, 3.0]]);
        // An effect that is not among them, or came after the numbers did.
        assert_eq!(without("side-slope", all.clone()), all);
        assert_eq!(without("traverse-creep", all[..3].to_vec()), all[..3]);
    }
}
