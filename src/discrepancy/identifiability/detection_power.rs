//! What is to be expected of each effect.

use super::check_report::{Parameter, Prospect, Seen};
use super::expected_gain::{Background, EffectSignature};
use super::fisher_information::{Driven, Information};
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::effects::{Applied, Effect};
use crate::error::Result;
use crate::model::Model;
use rayon::prelude::*;

/// Quantile of the normal distribution that leaves 5 % below.
pub(crate) const POWER: f64 = 1.644_853_626_951_472_2;

/// The bar an effect must pass, as `discover` sets it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DetectionThreshold {
    /// Effective number of measured values.
    pub sample_size: f64,
    /// Candidates in the library.
    pub candidates: f64,
}

impl DetectionThreshold {
    /// √λ that an effect of k parameters needs to pass with 95 %.
    pub fn needed(&self, k: usize) -> f64 {
        (k as f64 * self.sample_size.max(1.0).ln() + 2.0 * self.candidates.max(1.0).ln()).sqrt() + POWER
    }
}

/// An effect where it is looked at, and the magnitudes that are plausible there.
#[derive(Clone, Debug)]
pub(crate) struct Candidate {
    pub applied: Applied,
    /// Whether its derivative at the neutral value says all.
    pub regular: bool,
    /// Steps from the neutral value to plausible sizes: one for each parameter, or one for all of them.
    pub sizes: Vec<Vec<f64>>,
}

/// Everything that applies to a model, in the order of the library; an effect that is looked at in several directions
/// comes once for each.
pub(crate) fn candidates(model: &Model, library: &[Effect]) -> Vec<Candidate> {
    let all = model.applicable(library).into_iter();
    all.flat_map(|(e, t)| {
        let given = model.effects.iter().find(|a| a.stands_for(e, t));
        candidates_of(e, t, given)
    })
    .collect()
}

fn candidates_of(effect: &Effect, trailer: Option<usize>, given: Option<&Applied>) -> Vec<Candidate> {
    let parameters: Vec<_> = effect.parameters.values().collect();
    let regular = effect.states.is_empty() && parameters.iter().all(|p| !p.positive && !p.periodic);
    if regular {
        let neutral = vec![0.0; parameters.len()];
        let values = given.map_or(neutral, |a| a.values.clone());
        let alone = |i: usize| (0..parameters.len()).map(|j| if i == j { parameters[j].size } else { 0.0 }).collect();
        let sizes = (0..parameters.len()).map(alone).collect();
        return vec![Candidate { applied: Applied::new(effect, trailer, values), regular, sizes }];
    }
    // A direction is looked at from wherever a fit of it begins.
    let places = parameters.iter().fold(vec![vec![]], |places: Vec<Vec<f64>>, p| {
        let values = if p.periodic { p.start.clone() } else { vec![p.size] };
        places.iter().flat_map(|at| values.iter().map(|v| [at.as_slice(), &[*v]].concat())).collect()
    });
    let places = given.map_or(places, |a| vec![a.values.clone()]);
    let size = |at: &[f64]| at.iter().zip(&parameters).map(|(v, p)| if p.periodic { 0.0 } else { *v }).collect();
    places
        .into_iter()
        .map(|at| Candidate { sizes: vec![size(&at)], applied: Applied::new(effect, trailer, at), regular })
        .collect()
}

/// Information about candidates that are looked at together: the regular ones, and each other one beside them.
pub(crate) struct Table {
    /// The candidates and their information against noise alone, and against noise and unexplained motion.
    pub groups: Vec<Group>,
}

/// Candidates looked at together.
pub(crate) struct Group {
    /// Places among the candidates.
    pub members: Vec<usize>,
    /// Against noise alone; against noise and unexplained motion.
    pub information: [Information; 2],
}

impl Table {
    /// The table of all candidates along records.
    pub fn of(
        model: &Model,
        driven: &Driven,
        all: &[Candidate],
        wanted: &[Vec<usize>],
        variances: &[NoiseModel; 2],
        variance_inflation: [f64; 2],
    ) -> Result<Self> {
        let group = |members: &Vec<usize>| -> Result<Option<Group>> {
            let effects: Vec<Applied> = members.iter().map(|i| all[*i].applied.clone()).collect();
            let found = driven.information(model, &effects, variances)?;
            let found = found.and_then(|f| <[Information; 2]>::try_from(f).ok());
            let alike =
                |[calm, now]: [Information; 2]| [calm.over(variance_inflation[0]), now.over(variance_inflation[1])];
            Ok(found.map(|f| Group { members: members.clone(), information: alike(f) }))
        };
        let groups: Vec<Option<Group>> = wanted.par_iter().map(group).collect::<Result<_>>()?;
        Ok(Self { groups: groups.into_iter().flatten().collect() })
    }

    /// The first group with all of these candidates, and their places in it.
    pub fn with(&self, wanted: &[usize]) -> Option<(&Group, Vec<usize>)> {
        self.groups.iter().find_map(|g| {
            let place = |w: &usize| g.members.iter().position(|m| m == w);
            wanted.iter().map(place).collect::<Option<Vec<usize>>>().map(|at| (g, at))
        })
    }

    /// √λ of a candidate at its plausible size over what it needs, beside the motion that is unexplained now.
    fn strength(&self, all: &[Candidate], candidate: usize, bar: &DetectionThreshold) -> f64 {
        let Some((group, at)) = self.with(&[candidate]) else { return 0.0 };
        let misfit = |s: &Vec<f64>| group.information[1].misfit(at[0], s).max(0.0).sqrt();
        let least = all[candidate].sizes.iter().map(misfit).fold(f64::INFINITY, f64::min);
        least / bar.needed(all[candidate].applied.values.len())
    }

    /// What is to be expected of a candidate.
    pub fn prospect(
        &self,
        all: &[Candidate],
        candidate: usize,
        shown: &ExpectedDetection,
        bar: &DetectionThreshold,
    ) -> Prospect {
        let Candidate { applied, .. } = &all[candidate];
        let effect = &applied.effect;
        let nothing = vec![None; applied.values.len()];
        let deviations = |kind: usize| {
            let found = self.with(&[candidate]).map(|(g, at)| g.information[kind].deviations(at[0]));
            found.unwrap_or_else(|| nothing.clone())
        };
        let (calm, now) = (deviations(0), deviations(1));
        let parameter = |(i, (name, p)): (usize, (&String, &crate::effects::Parameter))| {
            let smallest = shown.smallest.get(i).copied().flatten().filter(|_| !p.periodic);
            let found = Parameter {
                unit: p.unit.clone(),
                std: calm[i],
                std_unexplained: now[i],
                plausible: p.size,
                smallest_seen: smallest,
            };
            (name.clone(), found)
        };
        let now = self.strength(all, candidate, bar) > 1.0;
        Prospect {
            id: effect.id.clone(),
            trailer: applied.trailer,
            place: effect.place.clone(),
            seen: match (shown.strength(all, candidate, bar) > 1.0, now) {
                (true, true) => Seen::Yes,
                (true, false) => Seen::OnceExplained,
                (false, _) => Seen::No,
            },
            parameters: effect.parameters.iter().enumerate().map(parameter).collect(),
        }
    }
}

/// What naming a candidate would gain against noise alone.
#[derive(Clone, Debug)]
pub(crate) struct ExpectedDetection {
    /// Expected gain at its plausible size, the least of its sizes.
    pub gain: f64,
    /// The smallest value of each parameter that would be seen.
    pub smallest: Vec<Option<f64>>,
}

impl ExpectedDetection {
    /// What a candidate would gain in records.
    pub fn of(
        model: &Model,
        driven: &Driven,
        c: &Candidate,
        bar: &DetectionThreshold,
        ground: &Background,
    ) -> Result<Self> {
        let k = c.applied.values.len();
        let Some(marks) = driven.marks(model, &[&c.applied])? else {
            return Ok(Self { gain: 0.0, smallest: vec![None; k] });
        };
        let root = bar.needed(k);
        let factors: Vec<Option<f64>> = c.sizes.iter().map(|s| marks.smallest(0, s, root, ground)).collect();
        let smallest = |i: usize| {
            let s = c.sizes.iter().position(|s| s[i] != 0.0)?;
            factors[s].map(|f| (f * c.sizes[s][i]).abs())
        };
        let gain = gain(&marks, c, ground);
        Ok(Self { gain, smallest: (0..k).map(smallest).collect() })
    }

    /// √gain at the plausible size over what it needs.
    pub fn strength(&self, all: &[Candidate], candidate: usize, bar: &DetectionThreshold) -> f64 {
        self.gain.sqrt() / bar.needed(all[candidate].applied.values.len())
    }
}

/// The expected gain of a candidate at its plausible size, the least of its sizes.
pub(crate) fn gain(marks: &EffectSignature, c: &Candidate, ground: &Background) -> f64 {
    c.sizes.iter().map(|s| marks.gain(0, s, None, ground)).fold(f64::INFINITY, f64::min)
}

/// The groups to look at: the regular candidates, each of the others beside them, and these two by two.
pub(crate) fn groups(all: &[Candidate]) -> Vec<Vec<usize>> {
    let own = |i: &usize| all[*i].applied.effect.origin.is_some();
    let regular: Vec<usize> = (0..all.len()).filter(|i| all[*i].regular && !own(i)).collect();
    // A user's own may be undefined somewhere: it must not spoil the pass for others.
    let others: Vec<usize> = (0..all.len()).filter(|i| !regular.contains(i)).collect();
    let beside = others.iter().map(|i| regular.iter().copied().chain([*i]).collect::<Vec<usize>>());
    let two = others.iter().enumerate().flat_map(|(k, a)| others[k + 1..].iter().map(move |b| vec![*a, *b]));
    let two = two.filter(|pair| !all[pair[0]].applied.same_as(&all[pair[1]].applied));
    std::iter::once(regular.clone()).filter(|g| !g.is_empty()).chain(beside).chain(two).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects;

    #[test]
    fn only_what_has_a_derivative_at_nothing_is_looked_at_from_there() {
        let of = |id: &str| candidates_of(effects::named(id).unwrap(), None, None);
        let size = |id: &str| effects::named(id).unwrap().parameters.values().map(|p| p.size).collect::<Vec<_>>();
        let creep = of("rotation-creep");
        assert!(creep.len() == 1 && creep[0].regular, "{creep:?}");
        assert_eq!((&creep[0].applied.values, &creep[0].sizes), (&vec![0.0], &vec![size("rotation-creep")]));
        // Two parameters that vanish by themselves are two directions.
        let arm = of("lever-arm");
        assert!(arm.len() == 1 && arm[0].regular && arm[0].sizes.len() == 2, "{arm:?}");
        assert!(arm[0].sizes.iter().all(|s| s.iter().filter(|x| **x != 0.0).count() == 1), "{arm:?}");
        // A time that must be positive, and a direction, which is nowhere zero: looked at where fits of it begin.
        let relaxation = of("relaxation-length");
        assert!(relaxation.iter().all(|c| !c.regular && c.sizes.len() == 1), "{relaxation:?}");
        let slope = of("side-slope");
        assert!(slope.len() > 1 && slope.iter().all(|c| !c.regular), "{slope:?}");
    }
}
