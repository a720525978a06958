//! Effects asked of parts of the data, where a model leaves motion unexplained.
//!
//! A model that misses a law is wrong, and then the formal evidence for whatever stands in for that law is large: each
//! run is imitated by other values of it. What is there has the same value in all runs.

use super::scopes::is_partial;
use super::search::{Search, SearchState};
use super::unnamed_terms;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::unexplained::remains;
use crate::discrepancy::evidence::jackknife::Jackknife;
use crate::discrepancy::selection::search::still_open;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::effect_equation::is_term;
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

impl Stable {
    /// Drops what the parts do not share, one after another, what has no name first; whether anything went.
    fn keep_shared(&mut self, selection: &Search, progress: &OnProgress) -> Result<bool> {
        let known = self.inconsistent.len();
        while remains(&self.grown.fit) && !self.grown.fit.p.is_empty() {
            self.scatter = Jackknife::of(selection.problem, &self.grown.fit, progress)?;
            let worst = self.scatter.as_ref().and_then(|s| least_shared(&self.grown.fit, s));
            let Some(worst) = worst else { break };
            let Some(smaller) = selection.without(&self.grown.fit, &worst)? else { break };
            self.inconsistent.push(worst);
            self.grown.go_back_to(smaller);
            self.scatter = None;
        }
        Ok(self.inconsistent.len() > known)
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

/// The effect that stands out least, of those that do not stand out; one without a name before one that has one.
fn least_shared(fit: &Fit, scatter: &Jackknife) -> Option<Applied> {
    // What holds in part is told by that part; it has paid for being sought. A course is that of all runs.
    let whole = fit.model.free_effects().filter(|e| e.effect.scope.is_none() && (fit.runs > 1 || !is_partial(e)));
    let ranked = whole.map(|e| (!is_term(e), scatter.shows(fit, e), e));
    let inconsistent = ranked.filter(|(_, shows, _)| *shows < 1.0);
    inconsistent.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))).map(|(_, _, e)| e.clone())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{fit_of, unicycle};

    /// The one that stands out least of those that do not.
    #[test]
    fn what_is_least_shared_goes_first() {
        let fit = fit_of(unicycle(&[("traction-creep", &[0.3]), ("traverse-creep", &[-0.05])]));
        let gone = |std: [f64; 2]| {
            least_shared(&fit, &Jackknife { std: std.to_vec(), alike: vec![false; 2], parts: 3 })
                .map(|e| e.effect.id.clone())
        };
        assert_eq!(gone([0.3 / 4.31, 0.05 / 4.31]), None);
        assert_eq!(gone([0.3 / 4.29, 0.05 / 4.31]).as_deref(), Some("traction-creep"));
        assert_eq!(gone([0.3 / 4.31, 0.05 / 4.29]).as_deref(), Some("traverse-creep"));
        assert_eq!(gone([0.3, 0.05 / 2.0]).as_deref(), Some("traction-creep"));
        assert_eq!(gone([0.3 / 2.0, 0.05]).as_deref(), Some("traverse-creep"));
    }
}
