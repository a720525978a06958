//! The effects that act on one input, put to every input that the runs log.

use crate::discrepancy::record::quantisation::step_of;
use crate::effects::Effect;
use crate::files::Run;
use crate::model::Model;

/// The share of the rows that lie above the size of an input: a spike is no size.
const BEYOND: f64 = 0.01;

/// A library in which every effect on one input stands once for each logged input, its numbers in the input's own size.
///
/// An effect on inputs that come in steps stands only for those that do; an input that stands still has none.
pub(crate) fn on_inputs(library: &[Effect], model: &Model, runs: &[Run]) -> Vec<Effect> {
    let mut found: Vec<Effect> = vec![];
    for effect in library {
        if effect.per_quantity {
            found.extend((0..model.measured.len()).filter_map(|k| on_quantity(effect, k, model, runs)));
            continue;
        }
        if !effect.per_input && !effect.unsought {
            found.push(effect.clone());
        }
        let one_alone = effect.per_input || effect.input_optional && model.inputs.len() > 1;
        let roles = model.inputs.iter().filter(|_| one_alone);
        found.extend(roles.filter_map(|role| on_input(effect, role, model, runs)));
    }
    found
}

fn on_input(effect: &Effect, role: &str, model: &Model, runs: &[Run]) -> Option<Effect> {
    let columns: Vec<&[f64]> = runs.iter().filter_map(|run| column(run, role)).collect();
    let size = size(&columns);
    let moves = model.vehicle.moved_by(role);
    if effect.unsought || !effect.inputs_that.is_empty() && !moves.is_some_and(|m| effect.inputs_that.contains(&m)) {
        return None;
    }
    let in_steps = || columns.iter().any(|c| step_of(c).is_some());
    let stands = size > 0.0 && effect.coarse.is_none_or(|coarse| coarse == in_steps());
    stands.then(|| effect.on_input(role, model.vehicle.unit_of(role), size))
}

/// The effect on a quantity that is measured beside the pose, where a run has it.
fn on_quantity(effect: &Effect, k: usize, model: &Model, runs: &[Run]) -> Option<Effect> {
    let columns: Vec<&[f64]> = runs.iter().filter_map(|run| Some(run.measured.get(k)?.as_slice())).collect();
    let (size, quantity) = (size(&columns), &model.measured[k]);
    (size > 0.0).then(|| effect.on_input(&quantity.name, &quantity.unit, size))
}

fn column<'r>(run: &'r Run, role: &str) -> Option<&'r [f64]> {
    run.roles.iter().position(|r| r == role).map(|k| run.inputs[k].as_slice())
}

/// The size that all but a few of the values of an input stay below.
fn size(columns: &[&[f64]]) -> f64 {
    let mut sizes: Vec<f64> =
        columns.iter().flat_map(|c| c.iter()).map(|u| u.abs()).filter(|u| u.is_finite()).collect();
    sizes.sort_by(f64::total_cmp);
    let at = ((1.0 - BEYOND) * sizes.len() as f64) as usize;
    sizes.get(at.min(sizes.len().saturating_sub(1))).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_spikes_are_not_the_size_of_an_input() {
        let mut column: Vec<f64> = (0..1000).map(|i| -0.5 * f64::from(i % 10)).collect();
        column[7] = 1e6;
        column[8] = f64::NAN;
        assert_eq!(size(&[&column, &[0.1; 5]]), 4.5);
        assert_eq!(size(&[]), 0.0);
    }
}
