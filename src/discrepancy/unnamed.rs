//! Disagreement that no effect of the library explains: an equation for it, where one is repeatable.

use super::fit::Fit;
use super::locate::Violation;
use super::picture;
use super::selection::{Grown, Selection, bic, free_effects};
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::{COEFFICIENT, Model, PREFIX};
use crate::picture::number::significant;

/// Deviance that unexplained motion must be worth before terms without a name are tried.
const NOTICEABLE: f64 = 25.0;
/// Named effects from which on simpler terms are tried whatever remains: so many causes at once are rare.
const MANY: usize = 3;

/// Whether an effect is a term of the library without names.
pub fn is_term(effect: &Applied) -> bool {
    effect.effect.id.starts_with(PREFIX)
}

/// Whether a term may be asked for: something remains, or suspiciously much was needed.
fn is_wanted(named: &Fit) -> bool {
    named.unexplained.iter().any(|gain| *gain > NOTICEABLE) || free_effects(&named.model).len() >= MANY
}

/// The search repeated with terms beside the named effects; `None` unless one of them earns its place.
///
/// A term stands for what has no name, so it must do more than a name would: beat the best model of named effects
/// by BIC and twice the margin, predict the windows left out better, and leave less unexplained.
pub(super) fn search(
    selection: &Selection,
    model: &Model,
    before: &Fit,
    named: &Grown,
    progress: &dyn Fn(&str),
) -> Result<Option<Grown>> {
    if !is_wanted(&named.fit) {
        return Ok(None);
    }
    progress("looking for an equation of what has no name");
    let terms = model.terms()?;
    let library: Vec<Effect> = selection.library.iter().cloned().chain(terms).collect();
    let wider = Selection { library: &library, size: model.applicable(&library).len() as f64, ..*selection };
    let found = wider.grown(before, progress)?;
    if !free_effects(&found.fit.model).iter().any(is_term) {
        return Ok(None);
    }
    let n = named.fit.sample_size.max(found.fit.sample_size);
    let better = bic(&found.fit, n) + 2.0 * wider.margin() < bic(&named.fit, n);
    let left_out = |fit: &Fit| selection.problem.left_out(fit);
    let (with, without) = (left_out(&found.fit)?, left_out(&named.fit)?);
    let predicts = with.zip(without).is_some_and(|(with, without)| with < without);
    Ok((better && predicts).then_some(found))
}

/// A term with its number in place, such as `v_t = v_n - 0.1294*phi'*abs(phi')`.
pub fn equation(term: &Applied, model: &Model) -> String {
    let shown = picture::equation(term, model);
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

/// The share of a constraint's violation on some data that is gone, noise apart: at most one, negative where it grew.
pub fn reduction(place: &str, before: &[Violation], after: &[Violation]) -> f64 {
    let excess = |all: &[Violation]| all.iter().map(|v| v.excess(place)).sum::<f64>();
    let (before, after) = (excess(before), excess(after));
    if before > 0.0 { (1.0 - after / before).clamp(-1.0, 1.0) } else { 0.0 }
}
