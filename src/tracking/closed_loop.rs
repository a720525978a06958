//! A drive in closed loop: a vehicle, a sensor with noise, a filter and a controller, sample by sample.

use super::commands::Commands;
use super::extended_kalman_filter::ExtendedKalmanFilter;
use super::predictive_control::{Now, PredictiveControl};
use super::reference::Reference;
use crate::error::Result;
use crate::export::WALK;
use crate::model::Equations;
use crate::motion::{Integrator, input_delays, simulate};
use crate::planning::Limit;
use nalgebra::{DMatrix, DVector};
use rand::Rng;
use rand_distr::StandardNormal;

/// What a coefficient walks in a second, as a share of its plausible size.
const PARAMETER_WALK: f64 = 0.05;
/// How filter and controller integrate; the vehicle itself moves as the program's other simulations do.
const ON_BOARD: Integrator =
    Integrator { method: crate::motion::Method::Dopri5, rtol: 1e-6, atol: 1e-8, max_steps: 100_000 };

/// A vehicle with a sensor.
pub struct Vehicle<'a> {
    /// How it moves.
    pub equations: &'a Equations,
    /// Its states at the beginning.
    pub start: &'a [f64],
    /// Deviations of a measured position, m, and heading, rad.
    pub noise: [f64; 2],
    /// Time between two samples, s.
    pub sample: f64,
    /// How many samples are driven.
    pub samples: usize,
}

/// What feedback knows of the vehicle.
pub struct Belief<'a> {
    /// The model.
    pub equations: &'a Equations,
    /// Its states at the beginning.
    pub start: &'a [f64],
    /// Coefficients that are observed.
    pub observed: &'a [Coefficient],
    /// Limits of the inputs.
    pub limits: &'a [Limit],
    /// How many commands the controller looks ahead.
    pub horizon: usize,
}

/// A coefficient that is observed.
#[derive(Clone, Debug)]
pub struct Coefficient {
    /// Effect and parameter.
    pub name: String,
    /// What it is taken to be at the beginning.
    pub begin: f64,
    /// Its plausible size.
    pub size: f64,
    /// Least and most.
    pub range: [f64; 2],
}

/// A drive.
#[derive(Clone, Debug)]
pub struct Driven {
    /// What a sensor without noise would measure, a row a sample.
    pub poses: Vec<Vec<f64>>,
    /// Commands, likewise.
    pub commands: Vec<Vec<f64>>,
    /// Observed coefficients at the end with their deviations.
    pub coefficients: Vec<[f64; 2]>,
}

/// Drives along a reference, with feedback by a belief, or by the planned commands alone.
///
/// # Errors
/// When a motion is undefined on the way.
pub fn drive(vehicle: &Vehicle, reference: &Reference, belief: Option<&Belief>, rng: &mut impl Rng) -> Result<Driven> {
    let time = |k: usize| k as f64 * vehicle.sample;
    let mut feedback = belief.map(|b| Feedback::begin(b, vehicle));
    let mut commands = Commands::from(0.0, reference.command(0).to_vec());
    let mut states = vehicle.start.to_vec();
    let mut poses = vec![measured(vehicle.equations, &states)];
    for k in 0..vehicle.samples {
        let next = match &mut feedback {
            None => reference.command(k + 1).to_vec(),
            Some(feedback) => {
                // The same noise whatever the feedback, so that ways are compared in pairs.
                let noisy = seen(&poses[k], vehicle.noise, rng);
                feedback.command(reference, k, &noisy, &commands)?
            }
        };
        commands.then(time(k + 1), next);
        let span = [time(k), time(k + 1)];
        let ends = simulate(vehicle.equations, &[], &commands, &states, &span, &Integrator::default())?;
        states = ends.into_iter().next_back().unwrap_or(states);
        poses.push(measured(vehicle.equations, &states));
        if let Some(feedback) = &mut feedback {
            feedback.filter.predict(&commands, span[0], span[1])?;
        }
    }
    let coefficients = feedback.map_or(vec![], |f| f.coefficients());
    Ok(Driven { poses, commands: commands.rows().to_vec(), coefficients })
}

/// What a sensor without noise measures.
pub fn measured(equations: &Equations, states: &[f64]) -> Vec<f64> {
    let mut w = equations.workspace(&vec![0.0; equations.free.len()]);
    equations.outputs(&mut w, states)[..equations.visible].to_vec()
}

fn seen(pose: &[f64], noise: [f64; 2], rng: &mut impl Rng) -> Vec<f64> {
    let mut normal = || rng.sample::<f64, _>(StandardNormal);
    pose.iter().enumerate().map(|(i, v)| v + normal() * deviation(noise, i)).collect()
}

/// Of a measured value, in the order x, y, angles.
fn deviation([position, heading]: [f64; 2], i: usize) -> f64 {
    if i < 2 { position } else { heading }
}

/// A filter and a controller of one model.
struct Feedback<'a> {
    filter: ExtendedKalmanFilter<'a>,
    control: PredictiveControl<'a>,
    /// Commands that were found for the samples at which they act.
    ahead: Vec<Vec<f64>>,
}

impl<'a> Feedback<'a> {
    fn begin(belief: &Belief<'a>, vehicle: &Vehicle) -> Self {
        let (equations, n) = (belief.equations, belief.equations.n());
        let visible = equations.visible;
        let noise: Vec<f64> = (0..visible).map(|i| deviation(vehicle.noise, i).powi(2)).collect();
        let begin: Vec<f64> = belief.observed.iter().map(|c| c.begin).collect();
        let hidden = vec![0.0; n - visible];
        let sizes = belief.observed.iter().map(|c| c.size);
        let known = noise.iter().chain(&hidden).copied().chain(sizes.clone().map(|s| s * s));
        // As the filter that is exported has it.
        let walk = (0..n).map(|i| if i < visible { WALK * WALK } else { 0.0 });
        let walk = walk.chain(sizes.map(|s| (PARAMETER_WALK * s).powi(2)));
        let filter = ExtendedKalmanFilter {
            equations,
            states: belief.start.to_vec(),
            covariance: DMatrix::from_diagonal(&DVector::from_vec(known.collect())),
            walk: walk.collect(),
            ranges: belief.observed.iter().map(|c| c.range).collect(),
            noise,
            integrator: ON_BOARD,
            parameters: begin,
        };
        let in_samples = |delay: &f64| (delay / vehicle.sample).round().max(0.0) as usize;
        let control = PredictiveControl {
            equations,
            limits: belief.limits,
            sample: vehicle.sample,
            horizon: belief.horizon,
            delays: input_delays(equations, &filter.parameters).iter().map(in_samples).collect(),
            integrator: ON_BOARD,
        };
        Self { filter, control, ahead: vec![] }
    }

    /// The command that is to be reached at the next sample.
    fn command(&mut self, reference: &Reference, k: usize, pose: &[f64], commands: &Commands) -> Result<Vec<f64>> {
        self.filter.update(pose);
        let states = self.when_it_acts(k, commands)?;
        let now = Now { states: &states, parameters: &self.filter.parameters, commands: commands.rows() };
        let ahead = self.ahead.split_first().map_or(&[][..], |(_, rest)| rest);
        self.ahead = self.control.commands(reference, &now, ahead)?;
        let next = |(c, wait): (usize, usize)| self.ahead[wait][c];
        Ok(self.control.waits().enumerate().map(next).collect())
    }

    /// The states at which the first command of now begins to act, by those that are on their way (Smith's predictor).
    fn when_it_acts(&self, k: usize, commands: &Commands) -> Result<Vec<f64>> {
        let soonest = self.control.soonest();
        if soonest == 0 {
            return Ok(self.filter.states.clone());
        }
        let span = [k, k + soonest].map(|k| k as f64 * self.control.sample);
        let f = &self.filter;
        let ends = simulate(f.equations, &f.parameters, commands, &f.states, &span, &f.integrator)?;
        Ok(ends.into_iter().next_back().unwrap_or_default())
    }

    fn coefficients(&self) -> Vec<[f64; 2]> {
        self.filter.parameters.iter().enumerate().map(|(i, v)| [*v, self.filter.deviation(i)]).collect()
    }
}
