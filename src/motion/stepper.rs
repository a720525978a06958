//! Fixed steps with exact sensitivities, for fits: many short arcs over the rows of a log.

use super::Signals;
use crate::model::{Equations, Workspace};

/// Largest angle the vehicle may turn within one step, rad.
const TURN_PER_STEP: f64 = 0.1;
/// Largest step in units of the shortest time constant.
const STEP_PER_TIME_CONSTANT: f64 = 0.35;
/// Most steps between two rows.
const MAX_STEPS: f64 = 64.0;

/// Integrates [`Equations`] along [`Signals`] by the classical Runge–Kutta scheme of order four, the state
/// beside its sensitivities S = ∂z/∂(visible start, p) by the variational equations.
///
/// S′ = J_z·S + [0 | J_p − J_u·u̇·∂delay/∂p], one compiled evaluation a stage. The step adapts to the yaw rate
/// and to the shortest time constant of the states, so the same code serves 10 Hz logs and stiff hidden states.
pub struct Stepper<'a> {
    equations: &'a Equations,
    signals: &'a Signals,
    workspace: Workspace,
    delay: f64,
    delay_slopes: Vec<f64>,
    /// The interval of the signals that was looked up last.
    interval: usize,
    value: Vec<f64>,
    slope: Vec<f64>,
    stage: Stage,
}

/// State and sensitivities at a time; S is stored row by row, with [`Equations::visible`] + p columns.
#[derive(Clone, Debug, Default)]
pub struct Arc {
    /// State.
    pub z: Vec<f64>,
    /// Sensitivities, or empty when they are not wanted.
    pub s: Vec<f64>,
}

#[derive(Default)]
struct Stage {
    rate: Arc,
    total: Arc,
    at: Arc,
}

impl<'a> Stepper<'a> {
    /// Equations at parameters p along signals.
    pub fn new(equations: &'a Equations, signals: &'a Signals, p: &[f64]) -> Self {
        let mut workspace = equations.workspace(p);
        let delay = equations.delay(&mut workspace).to_vec();
        let channels = signals.channels();
        Self {
            equations,
            signals,
            workspace,
            delay: delay[0],
            delay_slopes: delay[1..].to_vec(),
            interval: 0,
            value: vec![0.0; channels],
            slope: vec![0.0; channels],
            stage: Stage::default(),
        }
    }

    /// Columns of the sensitivities.
    pub fn columns(&self) -> usize {
        self.equations.visible + self.equations.free.len()
    }

    /// The inputs that act at a time.
    pub fn inputs(&mut self, t: f64) -> &[f64] {
        self.signals.at_near(&mut self.interval, t - self.delay, &mut self.value, &mut self.slope);
        &self.value
    }

    /// An arc that starts at a state; the sensitivities of hidden states with respect to p are carried over.
    pub fn start(&self, z: &[f64], hidden_s: Option<&[f64]>) -> Arc {
        let (n, k, visible) = (self.equations.n(), self.columns(), self.equations.visible);
        let mut s = vec![0.0; n * k];
        (0..visible).for_each(|i| s[i * k + i] = 1.0);
        if let Some(old) = hidden_s {
            for i in visible..n {
                s[i * k + visible..(i + 1) * k].copy_from_slice(&old[i * k + visible..(i + 1) * k]);
            }
        }
        Arc { z: z.to_vec(), s }
    }

    /// Advances an arc from one time to another.
    pub fn advance(&mut self, arc: &mut Arc, from: f64, to: f64) {
        let mut stage = std::mem::take(&mut self.stage);
        self.rate(arc, from, &mut stage.rate);
        let span = to - from;
        let steps = (span.abs() * self.stiffness(arc, &stage.rate, from)).ceil().clamp(1.0, MAX_STEPS);
        let h = span / steps;
        for i in 0..steps as usize {
            let t = from + h * i as f64;
            if i > 0 {
                self.rate(arc, t, &mut stage.rate);
            }
            self.step(arc, t, h, &mut stage);
        }
        self.stage = stage;
    }

    /// Steps per second that the motion asks for.
    fn stiffness(&mut self, arc: &Arc, rate: &Arc, t: f64) -> f64 {
        let n = self.equations.n();
        let turning = rate.z[2].abs() / TURN_PER_STEP;
        if arc.s.is_empty() {
            self.signals.at_near(&mut self.interval, t - self.delay, &mut self.value, &mut self.slope);
            self.equations.rates_and_jacobian(&mut self.workspace, &arc.z, &self.value);
        }
        let f = self.equations.last_jacobian(&self.workspace);
        let width = n + self.value.len() + self.equations.free.len();
        let fastest = (0..n).map(|i| f[n + i * width + i].abs()).fold(0.0, f64::max);
        turning.max(fastest / STEP_PER_TIME_CONSTANT)
    }

    /// One step; the rate at its beginning is known.
    fn step(&mut self, arc: &mut Arc, t: f64, h: f64, stage: &mut Stage) {
        stage.total.z.clone_from(&arc.z);
        stage.total.s.clone_from(&arc.s);
        for (advance, weight, next) in [(0.5, 1.0, 0.5), (0.5, 2.0, 0.5), (1.0, 2.0, 1.0), (0.0, 1.0, 0.0)] {
            accumulate(&mut stage.total.z, weight * h / 6.0, &stage.rate.z);
            accumulate(&mut stage.total.s, weight * h / 6.0, &stage.rate.s);
            if advance > 0.0 {
                stage.at.z.clone_from(&arc.z);
                stage.at.s.clone_from(&arc.s);
                accumulate(&mut stage.at.z, advance * h, &stage.rate.z);
                accumulate(&mut stage.at.s, advance * h, &stage.rate.s);
                self.rate(&stage.at, t + next * h, &mut stage.rate);
            }
        }
        arc.z.clone_from(&stage.total.z);
        arc.s.clone_from(&stage.total.s);
    }

    /// z′ and S′.
    fn rate(&mut self, at: &Arc, t: f64, rate: &mut Arc) {
        let n = self.equations.n();
        self.signals.at_near(&mut self.interval, t - self.delay, &mut self.value, &mut self.slope);
        rate.z.resize(n, 0.0);
        rate.s.clear();
        rate.s.resize(at.s.len(), 0.0);
        if at.s.is_empty() {
            return self.equations.rates(&mut self.workspace, &at.z, &self.value, &mut rate.z);
        }
        let (m, p, visible) = (self.value.len(), self.delay_slopes.len(), self.equations.visible);
        let f = self.equations.rates_and_jacobian(&mut self.workspace, &at.z, &self.value);
        rate.z.copy_from_slice(&f[..n]);
        let (width, k) = (n + m + p, visible + p);
        for i in 0..n {
            let row = &f[n + i * width..n + (i + 1) * width];
            let out = &mut rate.s[i * k..(i + 1) * k];
            for (j, slope) in row[..n].iter().enumerate().filter(|(_, slope)| **slope != 0.0) {
                accumulate(out, *slope, &at.s[j * k..(j + 1) * k]);
            }
            let along_inputs: f64 = row[n..n + m].iter().zip(&self.slope).map(|(j, u)| j * u).sum();
            for (c, delay_slope) in self.delay_slopes.iter().enumerate() {
                out[visible + c] += row[n + m + c] - along_inputs * delay_slope;
            }
        }
    }

    /// What the sensor measures at a state, and the rows of its derivatives with respect to (visible z, p).
    pub fn outputs(&mut self, z: &[f64]) -> &[f64] {
        self.equations.outputs(&mut self.workspace, z)
    }
}

fn accumulate(sum: &mut [f64], factor: f64, x: &[f64]) {
    sum.iter_mut().zip(x).for_each(|(s, x)| *s += factor * x);
}
