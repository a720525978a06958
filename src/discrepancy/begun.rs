//! How states that no sensor sees began, where the log does not say: by what the poses do soon after.

use super::angle::wrapped;
use super::record::{Channel, Record};
use super::smooth;
use crate::model::Equations;
use crate::motion::{Arc, Stepper, initial_hidden};
use nalgebra::{Cholesky, DMatrix, DVector};

/// What is looked at of the poses, s.
const SOON: f64 = 3.0;
/// With fewer rows nothing is said.
const FEWEST: usize = 8;
/// A state of which less is left of how it began is taken as it was carried.
const FADED: f64 = 0.02;
/// Rounds of Gauss and Newton.
const ROUNDS: usize = 2;
/// How far a pose is moved to see what it does, m and rad.
const TRIED: f64 = 1e-4;
/// A pose may be anywhere near its measurement, m and rad.
const ANYWHERE: f64 = 1.0;

/// What is known beforehand of hidden states at a row.
pub(super) struct Carried<'a> {
    /// The states, and their sensitivities.
    pub arc: Arc,
    /// The pose there.
    pub pose: &'a [f64],
    /// How much is left of how each state began: one at the start of a log.
    pub memory: Vec<f64>,
}

impl Carried<'_> {
    /// Hidden states by what was carried to a row and by the rows after it, least squares of both:
    ///
    /// Σ (y − y(δz, h))²/σ² + Σ (h − h₀)²/(m·a)² → min
    ///
    /// | symbol | meaning |
    /// |---|---|
    /// | h₀ | the state as it was carried from its equilibrium |
    /// | m | what is left there of how it began |
    /// | a | how large its equilibrium is under the inputs of these rows |
    /// | δz | of the pose, free |
    ///
    /// So a state that has forgotten is what it was carried to, and one that has not is what the poses show.
    ///
    /// With them comes how many numbers the poses were asked for: Σ (1 − σ²/(m·a)²) with the deviation σ that is left of
    /// each. A model that is given them has to pay for them as for parameters.
    pub fn settled(self, equations: &Equations, p: &[f64], record: &Record, row: usize) -> (Arc, f64) {
        match self.shown(equations, p, record, row) {
            Some((z, share)) => {
                let (m, k, h) = (equations.visible, self.arc.s.len() / equations.n(), z.len());
                let mut s = self.arc.s.clone();
                for (i, c) in (0..h).flat_map(|i| (0..k).map(move |c| (i, c))) {
                    s[(m + i) * k + c] = (0..h).map(|j| share[(i, j)] * self.arc.s[(m + j) * k + c]).sum();
                }
                (Arc { z, s }, h as f64 - share.trace())
            }
            None => (self.arc, 0.0),
        }
    }

    /// The states, and how much of what they were carried to is still in them; `None` where nothing is asked.
    fn shown(&self, equations: &Equations, p: &[f64], record: &Record, row: usize) -> Option<(Vec<f64>, DMatrix<f64>)> {
        if self.memory.iter().all(|m| *m < FADED) {
            return None;
        }
        let rows = Rows::of(equations, p, record, row)?;
        let spread: Vec<f64> = self.memory.iter().zip(rows.sizes()).map(|(m, a)| m * a).collect();
        let known = spread.iter().all(|s| s.is_finite() && *s > 0.0);
        if known { rows.fitted(&self.arc.z, self.pose, &spread) } else { None }
    }
}

/// Rows soon after one, as what a model gives there is compared with them.
struct Rows<'a> {
    equations: &'a Equations,
    p: &'a [f64],
    record: &'a Record,
    first: usize,
    last: usize,
    /// Of each column.
    noise: Vec<f64>,
}

impl<'a> Rows<'a> {
    fn of(equations: &'a Equations, p: &'a [f64], record: &'a Record, row: usize) -> Option<Self> {
        let time = &record.time;
        let gap = record.gap();
        let joined = |i: &usize| time[*i] - time[*i - 1] <= gap && time[*i] - time[row] <= SOON;
        let last = (row + 1..record.rows.end).take_while(joined).last()?;
        if last - row < FEWEST {
            return None;
        }
        let rows = row..last + 1;
        let noise = |c: &Vec<f64>| smooth::noise(&time[rows.clone()], &c[rows.clone()]).map(|n| n.max(1e-9));
        let noise = record.columns.iter().map(noise).collect::<Option<Vec<f64>>>()?;
        Some(Self { equations, p, record, first: row, last, noise })
    }

    /// How large the equilibria of the hidden states are under the inputs.
    fn sizes(&self) -> Vec<f64> {
        let (n, m) = (self.equations.n(), self.equations.visible);
        let mut stepper = Stepper::new(self.equations, &self.record.signals, self.p);
        let mut sizes = vec![0.0_f64; n - m];
        for i in (self.first..=self.last).step_by(((self.last - self.first) / 8).max(1)) {
            let u = stepper.inputs(self.record.time[i]).to_vec();
            let rest = initial_hidden(self.equations, self.p, &u, &self.record.measured(i));
            sizes.iter_mut().zip(rest).for_each(|(a, h)| *a = a.max(h.abs()));
        }
        sizes
    }

    /// What a model that begins with a pose and hidden states misses of each row and column, in units of the noise.
    fn missed(&self, begin: &[f64]) -> Option<DVector<f64>> {
        let mut stepper = Stepper::new(self.equations, &self.record.signals, self.p);
        let mut arc = Arc { z: begin.to_vec(), s: vec![] };
        let channels = self.record.channels();
        let mut found = Vec::with_capacity((self.last - self.first) * channels.len());
        for i in self.first..self.last {
            stepper.advance(&mut arc, self.record.time[i], self.record.time[i + 1]);
            let y = stepper.outputs(&arc.z);
            for (c, channel) in channels.iter().enumerate() {
                let off = y[self.record.output_of(c)] - self.record.columns[c][i + 1];
                let off = if *channel == Channel::Position { off } else { wrapped(off) };
                found.push(off / self.noise[c]);
            }
        }
        found.iter().all(|x| x.is_finite()).then(|| DVector::from_vec(found))
    }

    /// Hidden states that fit, and how much of what they were taken to be before is still in them.
    fn fitted(&self, carried: &[f64], pose: &[f64], spread: &[f64]) -> Option<(Vec<f64>, DMatrix<f64>)> {
        let m = pose.len();
        let before = [pose, carried].concat();
        let free = |i: usize| if i < m { ANYWHERE } else { spread[i - m] };
        let prior = DVector::from_fn(before.len(), |i, _| free(i).powi(-2));
        let mut begin = before.clone();
        let mut normal: Option<Cholesky<f64, nalgebra::Dyn>> = None;
        for _ in 0..ROUNDS {
            let here = self.missed(&begin)?;
            let mut jacobian = DMatrix::zeros(here.len(), begin.len());
            for i in 0..begin.len() {
                let step = TRIED * free(i).min(1.0);
                let mut beside = begin.clone();
                beside[i] += step;
                jacobian.set_column(i, &((self.missed(&beside)? - &here) / step));
            }
            let mut information = jacobian.tr_mul(&jacobian);
            (0..begin.len()).for_each(|i| information[(i, i)] += prior[i]);
            let away = DVector::from_fn(begin.len(), |i, _| prior[i] * (begin[i] - before[i]));
            let factors = information.cholesky()?;
            let step = factors.solve(&(jacobian.tr_mul(&here) + away));
            begin.iter_mut().zip(step.iter()).for_each(|(z, s)| *z -= s);
            normal = Some(factors);
        }
        let covariance = normal?.inverse();
        let h = carried.len();
        let share = DMatrix::from_fn(h, h, |i, j| covariance[(m + i, m + j)] * prior[m + j]);
        begin.iter().all(|z| z.is_finite()).then(|| (begin.split_off(m), share))
    }
}
