//! Inputs that were rounded before they were logged.

use crate::discrepancy::record::quantisation::step_of;
use crate::files::Run;
use crate::model::Model;

/// An input of a run that was rounded before it was logged.
#[derive(Clone, Debug, PartialEq)]
pub struct CoarseInput {
    /// Name of the run.
    pub run: String,
    /// The input.
    pub role: String,
    /// Its step.
    pub step: f64,
    /// The unit of the step.
    pub unit: String,
}

/// The inputs of a run that come in steps.
pub(crate) fn coarse_inputs(model: &Model, run: &Run) -> Vec<CoarseInput> {
    let of = |(role, column): (&String, &Vec<f64>)| {
        let step = step_of(column)?;
        let unit = model.vehicle.unit_of(role).into();
        Some(CoarseInput { run: run.name.clone(), role: role.clone(), step, unit })
    };
    run.roles.iter().zip(&run.inputs).filter_map(of).collect()
}
