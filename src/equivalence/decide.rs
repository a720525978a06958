//! The decision: a reparametrisation is sought each way, then agreement to first order.

use super::family::Family;
use super::pair::Pair;
use super::points::{Sample, exact_points, samples};
use super::relation::{Measured, Relation, TURN};
use super::tangent::Tangent;
use super::values::{Values, formula};
use crate::effects::Applied;
use crate::formula::{Normal, Scalar, Symbol, with_work_bounded};
use crate::model::Model;

/// Most products of two terms that all proofs of a relation may take: a thousand times what the catalogue's effects
/// take two by two.
const WORK: u64 = 10_000_000;

/// How two sets of effects are related in a model that has neither.
///
/// Parameters of the model's free effects may change with them. Symbols stand for every value: what is proved holds
/// for all parameters of the vehicle. What numbers refute is not tried, and a proof of too many steps counts as none.
///
/// ```
/// use creepage::equivalence::{Measured, Relation, relation};
/// use creepage::{effects::{self, Applied}, model::Model};
/// let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
/// let effect = |id: &str| [Applied::new(effects::named(id).unwrap(), None, vec![0.0])];
/// let Relation::Identical(change) = relation(&car, &effect("rotation-creep"), &effect("wheel-radius"), Measured::ALL)
///     else { panic!() };
/// assert_eq!(change[&"wheel_radius.scale".into()].to_string(), "-rotation_creep.e_rc");
/// ```
pub fn relation(model: &Model, a: &[Applied], b: &[Applied], measured: Measured) -> Relation {
    with_work_bounded(WORK, || compared(model, a, b, measured, &samples(model)))
}

/// As [`relation`], with the samples at which numbers may reject it before it is asked of the formulas.
fn compared(model: &Model, a: &[Applied], b: &[Applied], measured: Measured, samples: &[Sample]) -> Relation {
    let families = Family::of(model, a, measured).zip(Family::of(model, b, measured));
    let Some((first, second)) = families.filter(|(a, b)| a.comparable(b) && a.acts() && b.acts()) else {
        return Relation::Different;
    };
    let points = exact_points(model);
    let pair = |given, sought| Pair { given, sought, points: &points, samples };
    let (forth, back) = (pair(&first, &second), pair(&second, &first));
    let (few, many) = (first.own.len(), second.own.len());
    let turning = !measured.heading;
    let slopes = forth.slopes(turning);
    if let Some(change) = sought(&forth, slopes.as_deref(), turning) {
        let returns = || sought(&back, back.slopes(turning).as_deref(), turning).is_some();
        let reached = few == many && (reaches(&change, &first, &second) || (few > 1 && returns()));
        let change = change.iter().map(|(s, value)| (s.clone(), formula(value))).collect();
        return if reached { Relation::Identical(change) } else { Relation::Contained(change) };
    }
    if many <= few {
        let slopes = back.slopes(turning);
        if let Some(change) = sought(&back, slopes.as_deref(), turning) {
            return Relation::Contains(change.iter().map(|(s, value)| (s.clone(), formula(value))).collect());
        }
    }
    let agree = forth.is_regular() && slopes.is_some_and(|s| forth.agree(&s, turning));
    if agree { Relation::FirstOrder } else { Relation::Different }
}

/// The change of parameter, where the first order leaves one possible.
fn sought(pair: &Pair, slopes: Option<&[Vec<Normal>]>, turning: bool) -> Option<Values> {
    if pair.is_regular() && slopes.is_none() {
        return None;
    }
    let first = slopes.and_then(|s| s.first()).map(Vec::as_slice);
    pair.change(first).or_else(|| if turning { pair.turned(&TURN.into()) } else { None })
}

/// Whether a change of one parameter into one reaches every small value: its slope at zero is none.
fn reaches(change: &Values, given: &Family, sought: &Family) -> bool {
    let ([p], [q]) = (&given.own[..], &sought.own[..]) else { return false };
    let by = if change.contains_key(p) { TURN.into() } else { p.clone() };
    let value = |s: &Symbol| match *s == by {
        true => Tangent::parameter(),
        false => Tangent::constant(Normal::symbol(s.clone())),
    };
    let slope = change.get(q).and_then(|q| formula(q).eval(&value));
    slope.is_some_and(|t| t.slope.is_defined() && !t.slope.is_zero())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects;
    use crate::model::Trailer;
    use crate::vehicles;

    /// A vehicle with every length one, with a trailer or without.
    fn models() -> impl Iterator<Item = Model> {
        let bare = vehicles::all().iter().filter_map(|v| Model::sample(v).ok()).filter(|m| m.equations(&[]).is_ok());
        bare.flat_map(|m| [m.clone(), m.with_trailers(&[Trailer { length: 1.0, hitch: 0.5 }])])
    }

    /// One in so many of all pairs of effects, half of them on a model with a third effect.
    fn pairs(model: &Model, every: usize) -> Vec<(Model, [Applied; 2])> {
        let free = |(e, t): (&effects::Effect, Option<usize>)| Applied::new(e, t, e.starts().swap_remove(0)).freed();
        let all: Vec<Applied> = model.applicable(effects::all()).into_iter().map(free).collect();
        let mut pairs = vec![];
        for (i, a) in all.iter().enumerate() {
            for (j, b) in all.iter().enumerate().filter(|(j, _)| *j != i) {
                let third = &all[(i * 7 + j * 3) % all.len()];
                let is_third = (i + j) % 2 == 0 && !third.same_as(a) && !third.same_as(b);
                let base = if is_third { model.clone().with_effect(third.clone()) } else { model.clone() };
                pairs.push((base, [a.clone(), b.clone()]));
            }
        }
        pairs.into_iter().step_by(every).collect()
    }

    #[test]
    fn numbers_reject_nothing_that_is_proved() {
        let mut related = 0;
        for model in models() {
            for (k, (model, [a, b])) in pairs(&model, 11).into_iter().enumerate() {
                let measured = if k % 2 == 0 { Measured::ALL } else { Measured { heading: false, trailers: false } };
                let ask = |samples: &[Sample]| {
                    let one = std::slice::from_ref;
                    compared(&model, one(&a), one(&b), measured, samples)
                };
                let (quick, sure) = (ask(&samples(&model)), ask(&[]));
                assert_eq!(quick, sure, "{}, {}, {measured:?}", a.label(), b.label());
                related += usize::from(sure != Relation::Different);
            }
        }
        assert!(related > 0);
    }

    #[test]
    fn a_proof_that_takes_too_much_is_none() {
        let model = Model::new("unicycle", &[("wheel_radius", 1.0)]).unwrap();
        let one = |id: &str| [Applied::new(effects::named(id).unwrap(), None, vec![0.0]).freed()];
        let (a, b) = (one("rotation-creep"), one("wheel-radius"));
        let within = |most: u64| with_work_bounded(most, || compared(&model, &a, &b, Measured::ALL, &[]));
        assert!(matches!(within(WORK), Relation::Identical(_)));
        assert_eq!(within(50), Relation::Different);
    }
}
