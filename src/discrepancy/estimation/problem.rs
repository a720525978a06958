//! Runs cut into windows, and what is known of their noise.

use super::priors::Priors;
use crate::discrepancy::estimation::noise_model::{NoiseModel, Start};
use crate::discrepancy::initial_state::heading_from_path;
use crate::discrepancy::record::input_noise::PHASES;
use crate::discrepancy::record::local_polynomial;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::window_integration::linearise;
use crate::discrepancy::shooting::windows;
use crate::discrepancy::shooting::windows::has_windows;
use crate::discrepancy::shooting::windows::{Segment, WindowStates};
use crate::error::Result;
use crate::model::freedom::Freedom;
use crate::model::observation::{HEADING, PLACE, POSITION};
use crate::model::state::{ACROSS, YAW};
use crate::model::{Model, observation};
use crate::vehicles::Moves;

/// Runs cut into windows, with what is known of their noise.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The runs.
    pub records: Vec<Record>,
    /// Their windows.
    pub plan: Vec<Segment>,
    /// Where the variances start, and which of them are estimated.
    pub variances: NoiseModel,
    /// What is known of values before any run; nothing where effects are searched for.
    pub priors: Priors,
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
        let freedom = records.first().map_or(Freedom::default(), |r| r.freedom().clone());
        let is_defined = !records.is_empty() && records.iter().all(|r| r.has_heading() && !r.measures_heading());
        let of_quantity = |(i, known): (usize, &Option<f64>)| Start {
            variance: known.unwrap_or_else(|| noise_of_quantity(&records, i)).powi(2),
            is_measured: records.iter().any(|r| i < r.quantities.len()),
            is_known: known.is_some(),
        };
        let of_quantities = freedom.quantities.iter().enumerate().map(of_quantity);
        let starts = observation::sensor_noise(freedom.clone()).iter().enumerate().map(|(k, noise)| {
            let known = if noise.unit == "m" { position } else { heading };
            let given = (k == HEADING && is_defined).then_some(DEFINED);
            Start {
                variance: given.or(known).unwrap_or_else(|| noise_of(&records, k)).powi(2),
                is_measured: records.iter().any(|r| r.channels().iter().any(|c| c.noise == k)),
                is_known: known.is_some(),
            }
        });
        let mut variances = NoiseModel::starting(freedom.clone(), starts.chain(of_quantities));
        if !records.iter().any(|r| r.has_heading())
            && let Some(yaw) = yaw_told(&records, &plan, variances.measurement()[POSITION].variance)
        {
            variances.process_mut()[YAW].variance = yaw;
        }
        // Along a line the place shows no motion across it.
        if !records.iter().any(|r| r.observation.measures(PLACE[1])) {
            variances.process_mut()[ACROSS].is_estimated = false;
            variances.process_mut()[YAW].is_estimated &= !is_defined;
        }
        Self { records, plan, variances, priors: Priors::default() }
    }

    /// The same with what the noise of its inputs makes of a model's windows.
    pub(crate) fn knowing_its_inputs(mut self, model: &Model) -> Result<Self> {
        if !self.has_noisy_inputs() {
            return Ok(self);
        }
        let is_wheel = |role: &String| model.vehicle.moved_by(role).is_some_and(Moves::is_wheel);
        let counted: Vec<bool> = model.inputs.iter().map(is_wheel).collect();
        self.records.iter_mut().for_each(|r| r.input_noise = r.input_noise.counting(&counted).into());
        let (equations, starts) = (model.equations(&[])?, self.starts(model)?);
        let ends = |p: &Problem| linearise(&equations, &[], &p.records, &p.plan, &starts);
        let Some(quiet) = ends(&self) else { return Ok(self) };
        let mut squares = vec![0.0; self.variances.process().len()];
        let (mut time, mut windows) = (0.0, 0.0);
        for draw in 0..INPUT_DRAWS {
            let Some(noisy) = ends(&self.with_noisier_inputs(draw)) else { return Ok(self) };
            for (a, b) in quiet.iter().flatten().zip(noisy.iter().flatten()).filter(|(a, _)| !a.mismatch.is_empty()) {
                time += a.duration;
                windows += 1.0;
                let pairs = a.mismatch.iter().zip(&b.mismatch).zip(&mut squares);
                pairs.for_each(|((a, b), square)| *square += (a - b).powi(2));
            }
        }
        if self.variances.hides(&squares.iter().map(|square| square / f64::max(windows, 1.0)).collect::<Vec<f64>>()) {
            let records = self.records.iter().map(Record::with_exact_inputs).collect();
            return Ok(Self { records, ..self });
        }
        let known = squares.into_iter().map(|square| if time > 0.0 { square / time } else { 0.0 });
        Ok(Self { variances: self.variances.clone().knowing(known), ..self })
    }

    /// The same poses with inputs that are as noisy again: one of several draws.
    pub(crate) fn with_noisier_inputs(&self, draw: u64) -> Self {
        let noisier = |(run, r): (usize, &Record)| r.with_noisier_inputs(run as u64, draw);
        Self { records: self.records.iter().enumerate().map(noisier).collect(), ..self.clone() }
    }

    /// The same poses with inputs that a smoother has taken the noise from; `None` where they show none.
    pub(crate) fn with_smoothed_inputs(&self) -> Option<Self> {
        let smooth = || self.records.iter().map(Record::with_smoothed_inputs).collect();
        self.has_noisy_inputs().then(|| Self { records: smooth(), ..self.clone() })
    }

    /// The same where every input that may be rounded is; `None` where none may be.
    pub(crate) fn with_rounded_inputs(&self) -> Option<Self> {
        let is_any = self.records.iter().any(|r| r.input_noise.suspected().iter().any(Option::is_some));
        let rounded = || self.records.iter().map(Record::with_rounded_inputs).collect();
        is_any.then(|| Self { records: rounded(), ..self.clone() })
    }

    /// Whether the inputs of any run show noise that a mean over time has less of.
    pub(crate) fn has_inputs_to_average(&self) -> bool {
        self.records.iter().any(|r| r.input_noise.averages_out())
    }

    /// Whether the inputs of any run show noise.
    pub(crate) fn has_noisy_inputs(&self) -> bool {
        self.records.iter().any(|r| r.input_noise.is_there())
    }

    /// The noise of a quantity that is measured beside the pose, as its rows show it.
    pub(crate) fn quantity_noise(&self, quantity: usize) -> f64 {
        noise_of_quantity(&self.records, quantity)
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
            let record = &self.records[s.record];
            let beside = v.of_quantities(record.quantities.len()).iter().map(|c| c.variance.ln());
            rows as f64 * each.chain(beside).sum::<f64>()
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

/// The standard deviation of a heading that is so by definition, rad.
const DEFINED: f64 = 1e-9;
/// Times the noise of inputs is drawn.
const INPUT_DRAWS: u64 = 2 * PHASES;

/// The variance of a heading that positions of a variance tell over the way of a window, (σ/(v·W))², by the windows whose
/// way is longer than that σ; `None` where nothing moves.
fn yaw_told(records: &[Record], plan: &[Segment], variance: f64) -> Option<f64> {
    let way = |(r, a, b): (&Record, usize, usize)| {
        let (a, b) = (r.smoothed(a), r.smoothed(b));
        (b[0] - a[0]).hypot(b[1] - a[1])
    };
    let steps = plan.iter().flat_map(|s| s.windows.windows(2).map(|w| (&records[s.record], w[0].start, w[1].start)));
    let mut ways: Vec<f64> = steps.map(way).filter(|way| way * way > variance).collect();
    local_polynomial::median(&mut ways).map(|way| variance / (way * way))
}

/// The median over the runs of the noise of the columns that share a component.
fn noise_of(records: &[Record], component: usize) -> f64 {
    let of = |r: &Record| -> Vec<f64> {
        r.channels().into_iter().filter(|c| c.noise == component).filter_map(|c| r.noises()[c.column]).collect()
    };
    median_noise(records.iter().flat_map(of).collect())
}

/// The median over the runs of the noise of a quantity that is measured beside the pose.
fn noise_of_quantity(records: &[Record], quantity: usize) -> f64 {
    median_noise(records.iter().filter_map(|r| *r.quantity_noises().get(quantity)?).collect())
}

fn median_noise(mut noises: Vec<f64>) -> f64 {
    // A column without any noise still has its last digit.
    local_polynomial::median(&mut noises).unwrap_or(1e-3).max(1e-9)
}
