//! What held-out runs refute: taken out of a choice after the last of it was made.

use super::search::{MOST, Search, SearchState};
use super::transients;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::selection::choice::{Growth, Refusal, Refused, Selected, SelectedEffect};
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;

/// By how much a held-out gap grows with the first of two models in the place of the second.
type Grows<'g> = &'g dyn Fn(&Model, &Model) -> Result<Option<Growth>>;

/// Takes out of a choice what held-out runs are predicted worse with: an effect beside all others, or what was found
/// as a whole.
///
/// `grows` says by how much a held-out gap grows with the first of two models in the place of the second.
pub(crate) fn refute(problem: &Problem, library: &[Effect], choice: Selected, grows: Grows) -> Result<Selected> {
    let Selected { before, after, mut chosen, steps, candidates, inconsistent, sampling_sensitive, mut refused } =
        choice;
    let quick = transients::without_transients(library);
    let size = before.model.applicable(&quick).len().max(1) as f64;
    let selection =
        Search { problem, before: &before, library: &quick, size, most: MOST, exchanges: true, drops: true };
    let mut grown = SearchState { fit: after, steps, candidates, refused: vec![] };
    while let Some((applied, growth, smaller)) = refuted(&selection, &grown.fit, &chosen, grows)? {
        grown.go_back_to(smaller);
        refused.push(Refused::of(&chosen, applied, Refusal::HeldOut(growth)));
        // What is left of the others stands or falls anew.
        let standing = selection.keep_standing(&mut grown, None, vec![])?;
        chosen = standing.chosen;
        refused.extend(standing.refused);
    }
    let SearchState { fit: after, steps, candidates, .. } = grown;
    Ok(Selected { before, after, chosen, steps, candidates, inconsistent, sampling_sensitive, refused })
}

/// The effect with which a held-out gap grows most, and the fit without it; where only all together make it grow, the one
/// that is worth least.
fn refuted(
    selection: &Search,
    fit: &Fit,
    chosen: &[SelectedEffect],
    grows: Grows,
) -> Result<Option<(Applied, Growth, Fit)>> {
    let mut worst: Option<(Applied, Growth, Fit)> = None;
    for c in chosen {
        let Some(smaller) = selection.without(fit, &c.applied)? else { continue };
        let Some(growth) = grows(&fit.model, &smaller.model)? else { continue };
        if worst.as_ref().is_none_or(|(_, w, _)| growth.factor() > w.factor()) {
            worst = Some((c.applied.clone(), growth, smaller));
        }
    }
    let least = chosen.iter().min_by(|a, b| a.delta_bic.total_cmp(&b.delta_bic));
    if let (None, Some(least), Some(growth)) = (&worst, least, grows(&fit.model, &selection.before.model)?) {
        let smaller = selection.without(fit, &least.applied)?;
        worst = smaller.map(|smaller| (least.applied.clone(), growth, smaller));
    }
    Ok(worst)
}
