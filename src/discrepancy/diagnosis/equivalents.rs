//! Effects that are listed beside a chosen one, and why.

use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::selection::choice::{Selected, SelectedEffect};
use crate::effects::{self, Applied, Effect};
use crate::equivalence::{Measured, relation};
use crate::model::Model;
use crate::model::effect_equation;
use rayon::prelude::*;

/// Another effect that explains what a chosen one explains.
#[derive(Clone, Debug)]
pub struct EquivalentEffect {
    /// The effect; at its fitted values where the data were asked, else where a fit would begin.
    pub applied: Applied,
    /// `identical`, `first order` or `data`.
    pub why: &'static str,
}

impl EquivalentEffect {
    /// Whether some run could tell it from the chosen effect.
    pub fn differs(&self) -> bool {
        self.why != "identical"
    }
}

/// What a record measures.
pub fn measured(record: &Record) -> Measured {
    Measured { heading: record.has_heading(), trailers: record.observation.measures_trailers() }
}

/// The relatives of every chosen effect.
///
/// Those that are identical by their formulas are always listed, in the order of the library, whatever the data say;
/// then those that the data do not separate, `first order` where the formulas agree that far.
pub fn relatives(choice: &Selected, library: &[Effect], measured: Measured) -> Vec<Vec<EquivalentEffect>> {
    choice.chosen.iter().map(|c| of_one(c, &choice.after.model, library, measured)).collect()
}

fn of_one(chosen: &SelectedEffect, after: &Model, library: &[Effect], measured: Measured) -> Vec<EquivalentEffect> {
    if effect_equation::is_term(&chosen.applied) {
        return vec![];
    }
    let mut rest = after.clone();
    rest.effects.retain(|e| !e.same_as(&chosen.applied));
    let related = |other: &Applied| {
        let of = |a: &Applied| [a.clone().freed()];
        relation(&rest, &of(&chosen.applied), &of(other), measured)
    };
    let known = |other: &Applied| chosen.rivals.iter().find(|r| r.same_as(other)).cloned();
    let identical: Vec<EquivalentEffect> = candidates(after, library)
        .into_par_iter()
        .filter(|other| related(other).replaces())
        .map(|other| EquivalentEffect { applied: known(&other).unwrap_or(other), why: "identical" })
        .collect();
    let listed = |r: &&Applied| !identical.iter().any(|i| i.applied.same_as(r));
    let by_data = chosen.rivals.iter().filter(listed);
    let by_data: Vec<EquivalentEffect> =
        by_data.map(|r| EquivalentEffect { applied: r.clone(), why: related(r).word().unwrap_or("data") }).collect();
    let listed: Vec<EquivalentEffect> = identical.into_iter().chain(by_data).collect();
    let declared = [quasi_static(&chosen.applied, library), twin_on_input(&chosen.applied, after)];
    let is_new = |d: &EquivalentEffect| !listed.iter().any(|r| r.applied.same_as(&d.applied));
    let declared: Vec<EquivalentEffect> = declared.into_iter().flatten().filter(is_new).collect();
    listed.into_iter().chain(declared).collect()
}

/// The effect on the input that drives which is the same as a chosen one: what the contact does, and what an actuator ahead of it
/// would do.
fn twin_on_input(chosen: &Applied, model: &Model) -> Option<EquivalentEffect> {
    let all = effects::all().iter().filter_map(|e| Some((e, e.twin.as_ref()?)));
    all.filter(|(_, twin)| twin.id == chosen.effect.id).find_map(|(effect, twin)| {
        let moves = |role: &&String| model.vehicle.moved_by(role).is_some_and(|m| twin.inputs_that.contains(&m));
        let role = model.inputs.iter().find(moves)?;
        let on_input = effect.on_input(role, model.vehicle.unit_of(role), 1.0);
        let applied = Applied::new(&on_input, None, chosen.values.clone());
        Some(EquivalentEffect { applied, why: "first order" })
    })
}

/// What a chosen effect becomes where its states follow at once: the same to first order in the time they take.
fn quasi_static(chosen: &Applied, library: &[Effect]) -> Option<EquivalentEffect> {
    let limit = library.iter().find(|e| chosen.effect.limit.as_ref() == Some(&e.id))?;
    let applied = Applied::new(limit, chosen.trailer, chosen.values.clone());
    Some(EquivalentEffect { applied, why: "first order" })
}

/// The effects of a library that a model has not.
fn candidates(model: &Model, library: &[Effect]) -> Vec<Applied> {
    let open = model.applicable(library).into_iter();
    let open = open.map(|(e, t)| Applied::new(e, t, e.starts().swap_remove(0)));
    open.filter(|a| !model.effects.iter().any(|e| e.same_as(a))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{applied, unicycle};
    use crate::motion::Timing;

    #[test]
    fn what_is_measured_is_told_by_the_columns() {
        let of = |columns: usize, has_heading: bool| {
            let time = vec![0.0, 1.0];
            let record =
                Record::new("", time.clone(), vec![time.clone(); columns], has_heading, &[time], Timing::Sample);
            let m = measured(&record);
            [m.heading, m.trailers]
        };
        assert_eq!([of(2, false), of(3, true)], [[false, false], [true, false]]);
        assert_eq!([of(3, false), of(4, true)], [[false, true], [true, true]]);
    }

    /// Traction creep is the lag of the input that drives; creep across the vehicle is none.
    #[test]
    fn a_lag_of_the_driving_input_is_told_beside_traction_creep() {
        let lag = twin_on_input(&Applied { values: vec![0.3], ..applied("traction-creep") }, &unicycle(&[])).unwrap();
        let Applied { effect, values, .. } = &lag.applied;
        assert_eq!(
            (effect.id.as_str(), effect.on.as_deref(), &values[..]),
            ("input-lag", Some("wheel_rate"), &[0.3][..])
        );
        assert!(lag.differs() && twin_on_input(&applied("cornering-creep"), &unicycle(&[])).is_none());
    }

    #[test]
    fn what_a_model_has_is_no_candidate_for_it() {
        let library = crate::effects::all();
        let (bare, known) = (unicycle(&[]), applied("traverse-creep"));
        let ids = |m: &Model| candidates(m, library).into_iter().map(|a| a.effect.id).collect::<Vec<_>>();
        let (all, others) = (ids(&bare), ids(&bare.clone().with_effect(known)));
        assert!(all.len() > 5 && all.contains(&"traverse-creep".to_string()));
        assert_eq!(others, all.into_iter().filter(|id| id != "traverse-creep").collect::<Vec<_>>());
    }
}
