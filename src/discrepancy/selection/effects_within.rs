//! The effects of the library asked for within the scopes that others found: to first order in the place of a good one, and in
//! full where none is good.

use super::candidates::{place, rounded};
use super::scope_screen::Price;
use super::search::{Search, find};
use crate::discrepancy::estimation::bounds::{is_possible, vanishes};
use crate::discrepancy::estimation::fit::{Effort, Fit};
use crate::discrepancy::evidence::information_criterion::bic;
use crate::effects::{Applied, Effect, Scope};
use crate::error::Result;
use rayon::prelude::*;

/// Two fits whose criteria differ by no more say the same.
const SAME: f64 = 1.0;
/// Other effects in the scope of one that are fitted, at most.
const RIVALS: usize = 4;

/// Effects in part, each with a fit, and what a choice among them costs.
pub(super) struct InPart {
    /// In the order of their evidence.
    pub fits: Vec<(Applied, Fit)>,
    pub price: Price,
}

impl InPart {
    /// Fits in the order of their evidence.
    pub fn ordered(mut fits: Vec<(Applied, Fit)>, price: Price, n: f64) -> Self {
        by_evidence(&mut fits, n);
        Self { fits, price }
    }

    /// The best scope of every kind; intervals with an open end are a kind of their own.
    fn scopes(&self) -> Vec<Scope> {
        let mut found: Vec<Scope> = vec![];
        let scopes = self.fits.iter().filter_map(|(a, _)| a.effect.scope.as_ref());
        for scope in scopes {
            if !found.iter().any(|f| f.is_like(scope) && is_bounded(f) == is_bounded(scope)) {
                found.push(scope.clone());
            }
        }
        found
    }
}

/// Whether a scope both begins and ends.
fn is_bounded(scope: &Scope) -> bool {
    let Scope::Times(intervals) = scope else { return true };
    intervals.iter().flatten().all(|t| t.is_finite())
}

/// In the order of their evidence; of identical ones the first of the library comes first.
pub(super) fn by_evidence(fits: &mut [(Applied, Fit)], n: f64) {
    let n = fits.iter().map(|(_, f)| f.sample_size).fold(n, f64::max);
    fits.sort_by(|(a, f), (b, g)| rounded(bic(f, n)).total_cmp(&rounded(bic(g, n))).then(place(a).cmp(&place(b))));
}

/// An effect in part as a fit has it, and the fit; `None` where it is not worth what it costs beside the fit without it.
pub(super) fn paid(without: &Fit, fit: Fit, own: &Applied, price: &Price) -> Option<(Applied, Fit)> {
    let n = without.sample_size;
    let is_worth_it = bic(&fit, n) + price.of(own) < bic(without, n);
    let own = find(&fit.model, own).filter(|_| is_worth_it)?;
    Some((own, fit))
}

impl Search<'_> {
    /// The effects that may hold where one holds, with states where that one has some: else they were proposed for scopes of
    /// their own; `None` where it holds always.
    pub(super) fn library_within(&self, own: &Applied) -> Option<Vec<Effect>> {
        own.effect.scope.as_ref().map(|scope| self.library_in(scope, !own.effect.states.is_empty()))
    }

    /// The fit with the effect that explains most in the same scope; of those that say the same the first of the library.
    pub(super) fn named_in_scope(&self, base: &Fit, own: &Applied, fit: &Fit) -> Result<Fit> {
        let Some(within) = self.library_within(own) else { return Ok(fit.clone()) };
        let beside = Search { library: &within, ..*self };
        let mut fits = vec![(own.clone(), fit.clone())];
        for (other, rough) in beside.in_place_of(fit, own)?.into_iter().take(RIVALS) {
            let Some(full) = self.refit(&rough)? else { continue };
            let is_sound = find(&full.model, &other).is_some_and(|a| is_possible(&a) && !vanishes(&a));
            if is_sound && !self.problem.predicts_worse(&full, base)? {
                fits.push((other, full));
            }
        }
        let n = fits.iter().map(|(_, f)| f.sample_size).fold(0.0, f64::max);
        let worth = |f: &Fit| rounded(bic(f, n));
        let best = fits.iter().map(|(_, f)| worth(f)).fold(f64::INFINITY, f64::min);
        let same = fits.into_iter().filter(|(_, f)| worth(f) <= best + SAME);
        Ok(same.min_by_key(|(a, _)| (a.values.len(), place(a))).map_or_else(|| fit.clone(), |(_, f)| f))
    }

    /// The effects of the library in one scope, those that act at once or all.
    fn library_in(&self, scope: &Scope, has_states: bool) -> Vec<Effect> {
        let some = self.library.iter().filter(|e| e.scope.is_none() && (has_states || e.states.is_empty()));
        some.map(|e| e.within(scope.clone())).collect()
    }

    /// All effects within the scopes of others, each fitted from its own starts at the noise of a fit: where a model took an
    /// effect for a state that is not measured, a heading above all, no step to first order shows it.
    pub(super) fn in_full_within(&self, at: &Fit, others: [InPart; 2]) -> Result<InPart> {
        let price = others[0].price;
        let mut scopes: Vec<Scope> = vec![];
        for scope in others.iter().flat_map(InPart::scopes) {
            if !scopes.contains(&scope) {
                scopes.push(scope);
            }
        }
        let all: Vec<Effect> = scopes.iter().flat_map(|s| self.library_in(s, false)).collect();
        let is_new = |a: &Applied| !at.model.effects.iter().any(|e| e.same_as(a));
        let begun = at.model.applicable(&all).into_iter();
        let begun =
            begun.flat_map(|(e, t)| e.separate_starts().into_iter().map(move |v| Applied::new(e, t, v).freed()));
        let begun: Vec<Applied> = begun.filter(is_new).collect();
        let fitted = |own: Applied| {
            let model = at.model.clone().with_effect(own.clone());
            let fit = self.problem.fit(&model, &at.window_states, &at.variances, Effort::SCREENING)?;
            let found = fit.and_then(|fit| paid(at, fit, &own, &price));
            Ok(found.filter(|(own, _)| is_possible(own) && !vanishes(own)))
        };
        let fits = begun.into_par_iter().map(fitted).collect::<Result<Vec<_>>>()?;
        Ok(InPart::ordered(fits.into_iter().flatten().collect(), price, at.sample_size))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{applied, fit_of, unicycle};

    /// Of every kind the first, and of intervals one that ends and one that does not.
    #[test]
    fn every_kind_of_scope_is_asked_once() {
        let scopes = [
            Scope::Times(vec![[3.0, f64::INFINITY]]),
            Scope::Disk([1.0, 2.0, 3.0]),
            Scope::Times(vec![[4.0, f64::INFINITY]]),
            Scope::Times(vec![[3.0, 9.0]]),
            Scope::Disk([1.0, 2.0, 4.0]),
            Scope::Above(1.0),
        ];
        let creep = applied("rotation-creep");
        let within = |s: &Scope| Applied { effect: creep.effect.within(s.clone()), ..creep.clone() };
        let fits = scopes.iter().map(|s| (within(s), fit_of(unicycle(&[])))).collect();
        let found = InPart { fits, price: Price::default() }.scopes();
        assert_eq!(found, [0, 1, 3, 5].map(|k| scopes[k].clone()));
    }
}
