//! Disagreement that no effect of the library explains: an equation for it, where one is repeatable.

use super::search::{Search, SearchState, without_effect};
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::estimation::unexplained::{is_wanted, remains};
use crate::discrepancy::evidence::information_criterion::{bic, delta_bic};
use crate::discrepancy::localisation::constraint_residuals::reduction;
use crate::discrepancy::selection::search::still_open;
use crate::effects::Applied;
use crate::error::Result;
use crate::model::Model;
use crate::model::effect_equation::is_term;
use crate::progress::{OnProgress, Stage, begin};

/// Most terms that are added: an equation of more is no explanation.
const MOST: usize = 2;

/// Least share of the violation at its place that a term must remove.
const MATERIAL: f64 = 0.3;

/// The search repeated with terms beside the named effects; `None` unless one of them earns its place.
///
/// A term stands for what has no name, so it must do more than a name would: beat the best model of named effects
/// by BIC and twice the margin, predict the windows left out better, and remove a good share of what is violated at
/// its place. What is given up, with or without a name, is not asked again.
pub(crate) fn search(
    selection: &Search,
    named: &SearchState,
    given_up: &[Applied],
    progress: &OnProgress,
) -> Result<Option<SearchState>> {
    if !is_wanted(&named.fit) {
        return Ok(None);
    }
    begin(progress, Stage::UnnamedTerms)?;
    let model = &selection.before.model;
    let library = still_open(selection.library.iter().chain(&model.terms()?), given_up);
    let wider = Search {
        library: &library,
        size: model.applicable(&library).len() as f64,
        most: MOST,
        exchanges: false,
        ..*selection
    };
    // From what has a name on: what a term makes superfluous is dropped then.
    // Where nothing remains but much was needed, from the model as given: one term may do what several names did.
    let from = if remains(&named.fit) { &named.fit } else { selection.before };
    let mut found = wider.grown(from, progress)?;
    if remains(&found.fit) && named_effects(&found.fit) < named_effects(&named.fit) {
        // A term that leaves the rest unexplained is no reason to give a name up.
        found = Search { drops: false, ..wider }.grown(&named.fit, progress)?;
    }
    if let Some(alone) = instead_of_names(&wider, &found.fit, progress)? {
        found = alone;
    }
    // A name that the terms leave nothing to explain goes, even where names were kept.
    found.fit = wider.eliminate_backward(material(&wider, found.fit)?, 0.0)?;
    if !found.fit.model.free_effects().any(is_term) {
        return Ok(None);
    }
    let n = named.fit.sample_size.max(found.fit.sample_size);
    let better = bic(&found.fit, n) + 2.0 * wider.margin() < bic(&named.fit, n)
        && delta_bic(&found.fit, &named.fit, n) > wider.margin();
    let predicts = selection.problem.predicts_better(&found.fit, &named.fit)?;
    found.steps = [&named.steps[..], &found.steps].concat();
    found.candidates.clone_from(&named.candidates);
    Ok((better && predicts).then_some(found))
}

/// The search repeated after names fell that a law stood beside: it was what those names left, and may be another now; or
/// names that imitated one. `None` where there is none that explains more.
pub(crate) fn without_fallen(
    selection: &Search,
    standing: &SearchState,
    fallen: &[Applied],
    imitated: bool,
    progress: &OnProgress,
) -> Result<Option<SearchState>> {
    let fit = &standing.fit;
    let is_asked = imitated || fit.model.free_effects().any(is_term);
    if !fallen.iter().any(|e| !is_term(e)) || !is_asked || !remains(fit) {
        return Ok(None);
    }
    let Some(bare) = selection.without_terms(fit)? else { return Ok(None) };
    let named = SearchState { candidates: standing.candidates.clone(), ..SearchState::from(&bare) };
    // Where names imitated a law it is that one which is asked for, and no other name.
    let selection = &Search { library: if imitated { &[] } else { selection.library }, ..*selection };
    let found = search(selection, &named, fallen, progress)?;
    let n = found.as_ref().map_or(0.0, |f| f.fit.sample_size).max(fit.sample_size);
    Ok(found.filter(|found| bic(&found.fit, n) < bic(fit, n)))
}

/// The search without the names that a term stands beside at its place: a name and a term may be two parts of one law.
/// `None` where there is no such name, or the data are explained no better.
fn instead_of_names(wider: &Search, fit: &Fit, progress: &OnProgress) -> Result<Option<SearchState>> {
    let (terms, names): (Vec<&Applied>, Vec<&Applied>) = fit.model.free_effects().partition(|e| is_term(e));
    let is_beside = |name: &&Applied| terms.iter().any(|term| term.effect.place == name.effect.place);
    let beside: Vec<&Applied> = names.into_iter().filter(is_beside).collect();
    if beside.is_empty() {
        return Ok(None);
    }
    let without = |model: Model, effect: &Applied| without_effect(&model, effect, &wider.before.model);
    let bare = terms.into_iter().chain(beside).fold(fit.model.clone(), without);
    let Some(bare) = wider.fit_instead(fit, &bare)? else { return Ok(None) };
    let found = wider.grown(&bare, progress)?;
    let n = found.fit.sample_size.max(fit.sample_size);
    let has_term = found.fit.model.free_effects().any(is_term);
    Ok((has_term && bic(&found.fit, n) < bic(fit, n)).then_some(found))
}

fn named_effects(fit: &Fit) -> usize {
    fit.model.free_effects().filter(|e| !is_term(e)).count()
}

/// The fit without the terms that remove too small a share of what is violated at their place.
fn material(selection: &Search, mut fit: Fit) -> Result<Fit> {
    let terms: Vec<Applied> = fit.model.free_effects().filter(|e| is_term(e)).cloned().collect();
    for term in &terms {
        let Some(smaller) = selection.without(&fit, term)? else { continue };
        let violations = |f: &Fit| selection.problem.violations(&f.model, &fit.noise());
        if reduction(&term.effect.place, &violations(&smaller)?, &violations(&fit)?) < MATERIAL {
            fit = smaller;
        }
    }
    Ok(fit)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{applied, fit_of, unicycle};

    #[test]
    fn names_are_counted_without_terms_and_what_is_held() {
        let bare = unicycle(&[]);
        assert_eq!(named_effects(&fit_of(bare.clone())), 0);
        let model = unicycle(&[("traction-creep", &[0.3]), ("traverse-creep", &[0.1])]);
        assert_eq!(named_effects(&fit_of(model.clone().with_effect(applied("relaxation-length")))), 2);
        let terms = bare.terms().unwrap();
        let term = Applied::new(&terms[0], None, vec![0.1; terms[0].parameters.len()]).freed();
        assert!(is_term(&term));
        assert_eq!(named_effects(&fit_of(model.with_effect(term))), 2);
    }
}
