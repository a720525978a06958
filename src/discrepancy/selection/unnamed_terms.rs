//! Disagreement that no effect of the library explains: an equation for it, where one is repeatable.

use super::search::{Grown, Selection, bic, worth};
use crate::discrepancy::estimation::autocorrelation::NOTICEABLE;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::localisation::constraint_residuals::Violation;
use crate::discrepancy::rendering::figure_data;
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::{COEFFICIENT, Model, PREFIX};
use crate::number_format::significant;

/// Named effects from which on one simpler term is tried whatever remains.
const MANY: usize = 2;

/// Most terms that are added: an equation of more is no explanation.
const MOST: usize = 2;

/// Least share of the violation at its place that a term must remove.
const MATERIAL: f64 = 0.3;

/// Whether an effect is a term of the library without names.
pub fn is_term(effect: &Applied) -> bool {
    effect.effect.id.starts_with(PREFIX)
}

/// Whether motion remains that a fit does not explain.
pub fn remains(fit: &Fit) -> bool {
    remaining(fit).next().is_some()
}

/// The kinds of jumps that a fit needs beyond chance.
pub(crate) fn remaining(fit: &Fit) -> impl Iterator<Item = usize> {
    (0..fit.unexplained.len()).filter(|c| fit.unexplained[*c] / fit.dependence() > NOTICEABLE)
}

/// Whether a term may be asked for: something remains, or suspiciously much was needed.
pub(crate) fn is_wanted(named: &Fit) -> bool {
    remains(named) || named.model.free_effects().count() >= MANY
}

/// The search repeated with terms beside the named effects; `None` unless one of them earns its place.
///
/// A term stands for what has no name, so it must do more than a name would: beat the best model of named effects
/// by BIC and twice the margin, predict the windows left out better, and remove a good share of what is violated at
/// its place. What is given up, with or without a name, is not asked again.
pub(crate) fn search(
    selection: &Selection,
    named: &Grown,
    given_up: &[Applied],
    progress: &dyn Fn(&str),
) -> Result<Option<Grown>> {
    if !is_wanted(&named.fit) {
        return Ok(None);
    }
    progress("looking for an equation of what has no name");
    let model = &selection.before.model;
    let library = still_open(selection.library.iter().chain(&model.terms()?), given_up);
    let wider = Selection {
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
        found = Selection { drops: false, ..wider }.grown(&named.fit, progress)?;
    }
    // A name that the terms leave nothing to explain goes, even where names were kept.
    found.fit = wider.pruned(material(&wider, found.fit)?, 0.0)?;
    if !found.fit.model.free_effects().any(is_term) {
        return Ok(None);
    }
    let n = named.fit.sample_size.max(found.fit.sample_size);
    let better = bic(&found.fit, n) + 2.0 * wider.margin() < bic(&named.fit, n)
        && worth(&found.fit, &named.fit, n) > wider.margin();
    let predicts = selection.problem.predicts_better(&found.fit, &named.fit)?;
    found.steps = [&named.steps[..], &found.steps].concat();
    found.candidates.clone_from(&named.candidates);
    Ok((better && predicts).then_some(found))
}

/// The effects of a library without those that were given up.
pub(crate) fn still_open<'e>(library: impl IntoIterator<Item = &'e Effect>, given_up: &[Applied]) -> Vec<Effect> {
    let is_open = |e: &&Effect| given_up.iter().all(|g| g.effect.id != e.id);
    library.into_iter().filter(is_open).cloned().collect()
}

fn named_effects(fit: &Fit) -> usize {
    fit.model.free_effects().filter(|e| !is_term(e)).count()
}

/// The fit without the terms that remove too small a share of what is violated at their place.
fn material(selection: &Selection, mut fit: Fit) -> Result<Fit> {
    let terms: Vec<Applied> = fit.model.free_effects().filter(|e| is_term(e)).cloned().collect();
    for term in &terms {
        let Some(smaller) = selection.reduced(&fit, term)? else { continue };
        let violations = |f: &Fit| selection.problem.violations(&f.model, &fit.noise());
        if reduction(&term.effect.place, &violations(&smaller)?, &violations(&fit)?) < MATERIAL {
            fit = smaller;
        }
    }
    Ok(fit)
}

/// A term with its number in place, such as `v_t = v_n - 0.1294*phi'*abs(phi')`.
pub fn equation(term: &Applied, model: &Model) -> String {
    let shown = figure_data::equation(term, model);
    let Some(k) = term.values.first() else { return shown };
    let number = significant(k.abs(), 5);
    let sign = if *k < 0.0 { "-" } else { "+" };
    let name = term.symbol(COEFFICIENT).to_string();
    let shown = shown.replace(&name, COEFFICIENT);
    match shown.rsplit_once(&format!("+ {COEFFICIENT}")) {
        Some((before, after)) => format!("{before}{sign} {number}{after}"),
        None => shown,
    }
}

/// The share of a constraint's violation on some data that is gone, noise apart and in the windows that both models
/// have: at most one, negative where it grew.
pub fn reduction(place: &str, before: &[Violation], after: &[Violation]) -> f64 {
    let both = before.iter().zip(after).map(|(before, after)| before.in_common(after).map(|v| v.excess(place)));
    let [before, after] = both.fold([0.0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]]);
    if before > 0.0 { (1.0 - after / before).clamp(-1.0, 1.0) } else { 0.0 }
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
