//! Runs cut into windows, and what is known of their noise.

use crate::discrepancy::estimation::noise_model::Estimated;
use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::initial_state::heading_from_path;
use crate::discrepancy::record::local_polynomial;
use crate::discrepancy::record::run_record::{Channel, Record};
use crate::discrepancy::shooting::window_integration::linearise;
use crate::discrepancy::shooting::windows;
use crate::discrepancy::shooting::windows::has_windows;
use crate::discrepancy::shooting::windows::{Segment, WindowStates};
use crate::error::Result;
use crate::model::Model;

/// Runs cut into windows, with what is known of their noise.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The runs.
    pub records: Vec<Record>,
    /// Their windows.
    pub plan: Vec<Segment>,
    /// Which variances are free.
    pub free: Estimated,
    /// Where the variances start.
    pub variances: NoiseModel,
    /// Variances of the jumps, for each second, that the noise of the inputs makes: along, across, yaw, trailers.
    pub(crate) input_jumps: [f64; 4],
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
        let channels = [Channel::Position, Channel::Heading, Channel::Trailer];
        let known = [position, heading, heading];
        let present = channels.map(|c| records.iter().any(|r| r.channels().contains(&c)));
        let noise = [0, 1, 2].map(|k| known[k].unwrap_or_else(|| noise_of(&records, channels[k])).powi(2));
        let yaw = if present[1] { noise[1] } else { yaw_told(&records, &plan, noise[0]).unwrap_or(noise[1]) };
        let jump = [noise[0], noise[0], yaw, noise[2]];
        let free = Estimated {
            measurement: [0, 1, 2].map(|k| present[k] && known[k].is_none()),
            process: [true, true, true, present[2]],
        };
        let variances = NoiseModel { measurement: noise, process: jump };
        Self { records, plan, free, variances, input_jumps: [0.0; 4] }
    }

    /// The same with what the noise of its inputs makes of a model's windows.
    pub(crate) fn knowing_its_inputs(self, model: &Model) -> Result<Self> {
        if !self.records.iter().any(|r| r.input_noise.is_there()) {
            return Ok(self);
        }
        let (equations, starts) = (model.equations(&[])?, self.starts(model)?);
        let ends = |p: &Problem| linearise(&equations, &[], &p.records, &p.plan, &starts);
        let Some(quiet) = ends(&self) else { return Ok(self) };
        let (mut squares, mut time) = ([0.0; 4], 0.0);
        for draw in 0..INPUT_DRAWS {
            let Some(noisy) = ends(&self.with_noisier_inputs(draw)) else { return Ok(self) };
            for (a, b) in quiet.iter().flatten().zip(noisy.iter().flatten()).filter(|(a, _)| !a.mismatch.is_empty()) {
                time += a.duration;
                a.mismatch
                    .iter()
                    .zip(&b.mismatch)
                    .take(4)
                    .zip(&mut squares)
                    .for_each(|((a, b), s)| *s += (a - b).powi(2));
            }
        }
        let input_jumps = squares.map(|s| if time > 0.0 { s / time } else { 0.0 });
        Ok(Self { input_jumps, ..self })
    }

    /// The same poses with inputs that are as noisy again.
    pub(crate) fn with_noisier_inputs(&self, seed: u64) -> Self {
        let noisier = |(i, r): (usize, &Record)| r.with_noisier_inputs(1000 * seed + i as u64);
        Self { records: self.records.iter().enumerate().map(noisier).collect(), ..self.clone() }
    }

    /// How many windows there are.
    pub fn windows(&self) -> usize {
        self.plan.iter().map(|s| s.windows.len()).sum()
    }

    /// Σ n·ln σ² over all measured values of all windows.
    pub fn noise_determinant(&self, v: &NoiseModel) -> f64 {
        let of_segment = |s: &Segment| {
            let rows: usize = s.windows.iter().map(std::ops::Range::len).sum();
            let each = self.records[s.record].channels().into_iter().map(|c| v.measurement[c as usize].ln());
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

/// Times the noise of inputs is drawn.
const INPUT_DRAWS: u64 = 3;

/// The variance of a heading that positions of a variance tell over the way of a window, (σ/(v·W))²; `None` where nothing
/// moves.
fn yaw_told(records: &[Record], plan: &[Segment], variance: f64) -> Option<f64> {
    let way = |(r, a, b): (&Record, usize, usize)| {
        let (a, b) = (r.smoothed(a), r.smoothed(b));
        (b[0] - a[0]).hypot(b[1] - a[1])
    };
    let steps = plan.iter().flat_map(|s| s.windows.windows(2).map(|w| (&records[s.record], w[0].start, w[1].start)));
    let mut ways: Vec<f64> = steps.map(way).filter(|way| *way > 0.0).collect();
    local_polynomial::median(&mut ways).map(|way| variance / (way * way))
}

/// The median noise of a channel over the runs.
fn noise_of(records: &[Record], channel: Channel) -> f64 {
    let mut found: Vec<f64> = Vec::new();
    for r in records {
        let columns = r.channels().into_iter().zip(&r.columns).filter(|(c, _)| *c == channel);
        found.extend(columns.filter_map(|(_, y)| local_polynomial::noise(&r.time[r.rows.clone()], &y[r.rows.clone()])));
    }
    found.sort_by(f64::total_cmp);
    // A column without any noise still has its last digit.
    found.get(found.len() / 2).copied().unwrap_or(1e-3).max(1e-9)
}
