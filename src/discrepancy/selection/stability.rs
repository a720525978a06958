//! Effects asked of parts of the data, where a model leaves motion unexplained.
//!
//! A model that misses a law is wrong, and then the formal evidence for whatever stands in for that law is large: each
//! run is imitated by other values of it. What is there has the same value in all runs.

use super::scopes::is_partial;
use super::search::{Search, SearchState};
use super::unnamed_terms;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::unexplained::remains;
use crate::discrepancy::evidence::cross_validation::Gains;
use crate::discrepancy::evidence::jackknife::Jackknife;
use crate::discrepancy::evidence::wald_test::is_one_way;
use crate::discrepancy::localisation::unexplained_motion::visible;
use crate::discrepancy::selection::search::still_open;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::effect_equation::is_term;
use crate::model::state::JUMPS;
use crate::progress::OnProgress;

/// Searches at most: each is without what the one before could not keep.
const ROUNDS: usize = 3;

/// A search's outcome that all parts of the data share.
pub(crate) struct Stable {
    /// What they share.
    pub grown: SearchState,
    /// What the whole data ask for and their parts do not share.
    pub inconsistent: Vec<Applied>,
    /// How the values scatter, where the parts were asked.
    pub scatter: Option<Jackknife>,
}

/// Keeps of what was found what parts of the data share, and looks again without the rest.
///
/// Asked only where motion remains that the fit does not explain: where nothing remains the formal evidence holds.
pub(crate) fn search(selection: &Search, found: SearchState, progress: &OnProgress) -> Result<Stable> {
    let mut stable = Stable { grown: found, inconsistent: vec![], scatter: None };
    for round in 1..=ROUNDS {
        if !stable.keep_shared(selection, progress)? || round == ROUNDS {
            break;
        }
        stable.look_again(selection, progress)?;
    }
    if !stable.inconsistent.is_empty() && !stable.grown.fit.model.free_effects().any(is_term) {
        let named = SearchState::from(&stable.grown.fit);
        if let Some(found) = unnamed_terms::search(selection, &named, &stable.inconsistent, progress)? {
            stable.go_on_with(found);
        }
        stable.keep_shared(selection, progress)?;
    }
    if stable.inconsistent.is_empty() && remains(&stable.grown.fit) {
        // Something remains, and what is asked for in its place no part bears out.
        stable.inconsistent = std::mem::take(&mut stable.grown.refused);
    }
    Ok(stable)
}

/// Keeps of what was found what parts of the data share.
pub(crate) fn shared(selection: &Search, found: SearchState, progress: &OnProgress) -> Result<Stable> {
    let mut stable = Stable { grown: found, inconsistent: vec![], scatter: None };
    stable.keep_shared(selection, progress)?;
    Ok(stable)
}

impl Stable {
    /// Drops what the parts do not share, one after another, what has no name first; whether anything went.
    fn keep_shared(&mut self, selection: &Search, progress: &OnProgress) -> Result<bool> {
        let known = self.inconsistent.len();
        while remains(&self.grown.fit) && !self.grown.fit.p.is_empty() {
            self.scatter = Jackknife::of(selection.problem, &self.grown.fit, progress)?;
            let Some((worst, smaller)) = self.least_borne_out(selection)? else { break };
            self.inconsistent.push(worst);
            self.grown.go_back_to(smaller);
            self.scatter = None;
        }
        Ok(self.inconsistent.len() > known)
    }

    /// Of the effects that their scatter over the parts does not bear out the one that predicts the parts least, those
    /// without a name first and those that every vehicle has last; and the fit without it.
    fn least_borne_out(&self, selection: &Search) -> Result<Option<(Applied, Fit)>> {
        let Some(scatter) = &self.scatter else { return Ok(None) };
        let fit = &self.grown.fit;
        let seen = visible_places(selection, fit)?;
        let mut least: Option<((bool, bool, f64), Applied, Fit)> = None;
        for effect in inconsistent(fit, scatter) {
            let Some(smaller) = selection.without(fit, &effect)? else { return Ok(None) };
            let gains = selection.problem.gains_by_parts(fit, &smaller)?;
            let is_one_way = scatter.is_one_way(fit, &effect) || is_one_way(fit, &effect);
            if is_there(&effect, &seen, is_one_way, gains) {
                continue;
            }
            let rank = (!is_term(&effect), effect.effect.basic, gains.map_or(f64::NEG_INFINITY, |g| g.total));
            if least.as_ref().is_none_or(|(other, ..)| rank < *other) {
                least = Some((rank, effect, smaller));
            }
        }
        Ok(least.map(|(_, effect, smaller)| (effect, smaller)))
    }

    /// The search for names from what is shared on, without what is not.
    fn look_again(&mut self, selection: &Search, progress: &OnProgress) -> Result<()> {
        let library = still_open(selection.library, &self.inconsistent);
        let found = Search { library: &library, ..*selection }.grown(&self.grown.fit, progress)?;
        self.go_on_with(found);
        Ok(())
    }

    fn go_on_with(&mut self, found: SearchState) {
        self.grown.steps.extend(found.steps);
        self.grown.fit = found.fit;
        self.grown.refused = found.refused;
        self.scatter = None;
    }
}

/// Whether what every vehicle has more or less of is there, though it differs by more than the noise: unless so much is seen to be
/// left where it acts that it stands in for a law. It has one direction in all parts, or in every run by itself, or predicts each
/// part better from the others.
pub(super) fn is_there(effect: &Applied, seen: &[&str], is_one_way: bool, gains: Option<Gains>) -> bool {
    let is_law = seen.iter().any(|place| acts_at(effect, place));
    effect.effect.basic && !is_law && gains.is_some_and(|g| g.is_gain() && (is_one_way || g.is_everywhere()))
}

/// The constraints at which a fit leaves what is seen without statistics.
pub(super) fn visible_places(selection: &Search, fit: &Fit) -> Result<Vec<&'static str>> {
    let left = selection.problem.violations(&fit.model, &fit.noise())?;
    Ok(visible(fit, &left).map(|c| JUMPS[c].place).collect())
}

/// Whether an effect acts at a constraint; one of the sensor, or of an input, may act at any.
fn acts_at(effect: &Applied, place: &str) -> bool {
    let own = &effect.effect.place;
    own.starts_with(place) || JUMPS.iter().all(|jump| !own.starts_with(jump.place))
}

/// The effects that do not stand out, those without a name first, then by how far they stand out.
fn inconsistent(fit: &Fit, scatter: &Jackknife) -> Vec<Applied> {
    // What holds in part is told by that part; it has paid for being sought. A course is that of all runs.
    let whole = fit.model.free_effects().filter(|e| e.effect.scope.is_none() && (fit.runs > 1 || !is_partial(e)));
    let ranked = whole.map(|e| (!is_term(e), scatter.shows(fit, e), e));
    let mut inconsistent: Vec<_> = ranked.filter(|(_, shows, _)| *shows < 1.0).collect();
    inconsistent.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    inconsistent.into_iter().map(|(_, _, e)| e.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{fit_of, unicycle};

    #[test]
    fn an_effect_acts_at_its_constraint_and_one_of_the_sensor_anywhere() {
        let at = |id: &str, place: &str| acts_at(&crate::discrepancy::fixtures::applied(id), place);
        assert!(at("track-width", "yaw rate") && !at("track-width", "traverse constraint"));
        assert!(at("rotation-creep", "rotation constraint") && !at("rotation-creep", "yaw rate"));
        assert!(at("heading-misalignment", "traverse constraint") && at("heading-misalignment", "yaw rate"));
    }

    /// The one that stands out least of those that do not.
    #[test]
    fn what_is_least_shared_goes_first() {
        let fit = fit_of(unicycle(&[("traction-creep", &[0.3]), ("traverse-creep", &[-0.05])]));
        let gone = |std: [f64; 2]| {
            let scatter = Jackknife { std: std.to_vec(), alike: vec![false; 2], one_way: vec![false; 2], parts: 3 };
            inconsistent(&fit, &scatter).first().map(|e| e.effect.id.clone())
        };
        assert_eq!(gone([0.3 / 4.31, 0.05 / 4.31]), None);
        assert_eq!(gone([0.3 / 4.29, 0.05 / 4.31]).as_deref(), Some("traction-creep"));
        assert_eq!(gone([0.3 / 4.31, 0.05 / 4.29]).as_deref(), Some("traverse-creep"));
        assert_eq!(gone([0.3, 0.05 / 2.0]).as_deref(), Some("traction-creep"));
        assert_eq!(gone([0.3 / 2.0, 0.05]).as_deref(), Some("traverse-creep"));
    }
}
