//! Runs cut into windows, and what is known of their noise.

use crate::discrepancy::estimation::noise_model::{NoiseModel, Start};
use crate::discrepancy::initial_state::heading_from_path;
use crate::discrepancy::record::local_polynomial;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::windows;
use crate::discrepancy::shooting::windows::has_windows;
use crate::discrepancy::shooting::windows::{Segment, WindowStates};
use crate::error::Result;
use crate::model::{Model, observation};

/// Runs cut into windows, with what is known of their noise.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The runs.
    pub records: Vec<Record>,
    /// Their windows.
    pub plan: Vec<Segment>,
    /// Where the variances start, and which of them are estimated.
    pub variances: NoiseModel,
}

impl Problem {
    /// Cuts runs into windows and estimates their noise; a known standard deviation of position (m) or heading (rad)
    /// is kept.
    ///
    /// A run without a window says nothing, so it is left out where another one has some: whatever is asked of runs one
    /// by one would take its silence for an answer.
    pub fn new(records: Vec<Record>, position: Option<f64>, heading: Option<f64>) -> Self {
        let records = match records.iter().any(has_windows) {
            true => records.into_iter().filter(has_windows).collect(),
            false => records,
        };
        let plan = windows::plan(&records);
        let trailers = records.first().map_or(0, |r| r.trailers);
        let starts = observation::sensor_noise(trailers).iter().enumerate().map(|(k, noise)| {
            let known = if noise.unit == "m" { position } else { heading };
            Start {
                variance: known.unwrap_or_else(|| noise_of(&records, k)).powi(2),
                is_measured: records.iter().any(|r| r.channels().iter().any(|c| c.noise == k)),
                is_known: known.is_some(),
            }
        });
        let variances = NoiseModel::starting(trailers, starts);
        Self { records, plan, variances }
    }

    /// How many windows there are.
    pub fn windows(&self) -> usize {
        self.plan.iter().map(|s| s.windows.len()).sum()
    }

    /// Σ n·ln σ² over all measured values of all windows.
    pub fn noise_determinant(&self, v: &NoiseModel) -> f64 {
        let of_segment = |s: &Segment| {
            let rows: usize = s.windows.iter().map(std::ops::Range::len).sum();
            let each = self.records[s.record].channels().into_iter().map(|c| v.measurement()[c.noise].variance.ln());
            rows as f64 * each.sum::<f64>()
        };
        self.plan.iter().map(of_segment).sum()
    }

    /// Poses at the windows' starts from the measurements alone, as the model's sensor says.
    pub fn starts(&self, model: &Model) -> Result<WindowStates> {
        starts(model, &self.records, &self.plan)
    }
}

/// Poses at the windows' starts from the measurements alone, as a model's sensor says; where no heading is measured, its
/// motion at the values that it has.
pub(crate) fn starts(model: &Model, records: &[Record], plan: &[Segment]) -> Result<WindowStates> {
    let equations = model.equations(&[])?;
    Ok(plan.iter().map(|s| heading_from_path::starts(&equations, &records[s.record], &s.windows)).collect())
}

/// The median over the runs of the noise of the columns that share a component.
fn noise_of(records: &[Record], component: usize) -> f64 {
    let mut found: Vec<f64> = Vec::new();
    for r in records {
        let columns = r.channels().into_iter().zip(&r.columns).filter(|(c, _)| c.noise == component);
        found.extend(columns.filter_map(|(_, y)| local_polynomial::noise(&r.time[r.rows.clone()], &y[r.rows.clone()])));
    }
    found.sort_by(f64::total_cmp);
    // A column without any noise still has its last digit.
    found.get(found.len() / 2).copied().unwrap_or(1e-3).max(1e-9)
}
