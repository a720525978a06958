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
/// How far a pose is moved to see what it does, m and rad; a value of the model by such a share of itself.
const TRIED: f64 = 1e-4;
/// A value near zero is moved as if it were this large.
const SMALL: f64 = 1e-2;
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
            Some(Shown { z, share, by_values }) => {
                let (m, k, h) = (equations.visible, self.arc.s.len() / equations.n(), z.len());
                let mut s = self.arc.s.clone();
                for (i, c) in (0..h).flat_map(|i| (0..k).map(move |c| (i, c))) {
                    let carried: f64 = (0..h).map(|j| share[(i, j)] * self.arc.s[(m + j) * k + c]).sum();
                    s[(m + i) * k + c] = carried + if c < m { 0.0 } else { by_values[(i, c - m)] };
                }
                (Arc { z, s }, h as f64 - share.trace())
            }
            None => (self.arc, 0.0),
        }
    }

    /// What the poses show; `None` where nothing is asked.
    fn shown(&self, equations: &Equations, p: &[f64], record: &Record, row: usize) -> Option<Shown> {
        if self.memory.iter().all(|m| *m < FADED) {
            return None;
        }
        let rows = Rows::of(equations, p, record, row)?;
        let spread: Vec<f64> = self.memory.iter().zip(rows.sizes()).map(|(m, a)| m * a).collect();
        let known = spread.iter().all(|s| s.is_finite() && *s > 0.0);
        if known { rows.fitted(&self.arc.z, self.pose, &spread) } else { None }
    }
}

/// Hidden states that fit the poses.
struct Shown {
    z: Vec<f64>,
    /// How much of what they were carried to is still in them, ∂h/∂h₀.
    share: DMatrix<f64>,
    /// By the model's values alone, h₀ held: with other values other states fit the same poses.
    by_values: DMatrix<f64>,
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

    /// What a model with such values that begins with a pose and hidden states misses of each row and column, in units
    /// of the noise.
    fn missed(&self, p: &[f64], begin: &[f64]) -> Option<DVector<f64>> {
        let mut stepper = Stepper::new(self.equations, &self.record.signals, p);
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

    /// Hidden states that fit both the rows and what they were carried to.
    fn fitted(&self, carried: &[f64], pose: &[f64], spread: &[f64]) -> Option<Shown> {
        let m = pose.len();
        let before = [pose, carried].concat();
        let free = |i: usize| if i < m { ANYWHERE } else { spread[i - m] };
        let prior = DVector::from_fn(before.len(), |i, _| free(i).powi(-2));
        let mut begin = before.clone();
        let mut last: Option<(Cholesky<f64, nalgebra::Dyn>, DMatrix<f64>)> = None;
        for _ in 0..ROUNDS {
            let here = self.missed(self.p, &begin)?;
            let jacobian = slopes(&begin, |i| free(i).min(1.0), &here, |begin| self.missed(self.p, begin))?;
            let mut information = jacobian.tr_mul(&jacobian);
            (0..begin.len()).for_each(|i| information[(i, i)] += prior[i]);
            let away = DVector::from_fn(begin.len(), |i, _| prior[i] * (begin[i] - before[i]));
            let factors = information.cholesky()?;
            let step = factors.solve(&(jacobian.tr_mul(&here) + away));
            begin.iter_mut().zip(step.iter()).for_each(|(z, s)| *z -= s);
            last = Some((factors, jacobian));
        }
        let (factors, jacobian) = last?;
        let covariance = factors.inverse();
        let h = carried.len();
        let share = DMatrix::from_fn(h, h, |i, j| covariance[(m + i, m + j)] * prior[m + j]);
        // Where the sum is least its slope is zero whatever the values: they move the states by −(JᵀJ + P)⁻¹·Jᵀ·∂r/∂p.
        let here = self.missed(self.p, &begin)?;
        let by_values = slopes(self.p, |j| self.p[j].abs().max(SMALL), &here, |p| self.missed(p, &begin))?;
        let moved = -factors.solve(&jacobian.tr_mul(&by_values));
        let by_values = moved.rows(m, h).into_owned();
        begin.iter().all(|z| z.is_finite()).then(|| Shown { z: begin.split_off(m), share, by_values })
    }
}

/// What numbers do to what is missed: each is moved by a small share of its size, and nothing else.
fn slopes(
    at: &[f64],
    size: impl Fn(usize) -> f64,
    here: &DVector<f64>,
    missed: impl Fn(&[f64]) -> Option<DVector<f64>>,
) -> Option<DMatrix<f64>> {
    let mut slopes = DMatrix::zeros(here.len(), at.len());
    for i in 0..at.len() {
        let step = TRIED * size(i);
        let mut beside = at.to_vec();
        beside[i] += step;
        slopes.set_column(i, &((missed(&beside)? - here) / step));
    }
    Some(slopes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::carry;
    use crate::effects::{self, Applied};
    use crate::model::Model;
    use crate::motion::Timing;

    /// A vehicle that slides already when its log begins, and nearly forgets within it.
    fn record(equations: &Equations, p: &[f64]) -> Record {
        let time: Vec<f64> = (0..80).map(|i| 0.05 * f64::from(i)).collect();
        let of = |f: &dyn Fn(f64) -> f64| time.iter().map(|t| f(*t)).collect::<Vec<f64>>();
        let inputs = [of(&|t| 2.0 + (0.7 * t).sin()), of(&|t| 0.6 * (0.4 * t).cos())];
        let mut record = Record::new("run", time, vec![vec![]; 3], true, &inputs, Timing::Sample);
        let signals = record.signals.clone();
        let mut stepper = Stepper::new(equations, &signals, p);
        let mut arc = Arc { z: vec![0.0, 0.0, 0.2, -0.15], s: vec![] };
        for i in 0..record.time.len() {
            let y = stepper.outputs(&arc.z);
            let noise = |c: usize| 2e-4 * ((i * i) as f64 + c as f64).sin();
            (0..3).for_each(|c| record.columns[c].push(y[c] + noise(c)));
            if i + 1 < record.time.len() {
                stepper.advance(&mut arc, record.time[i], record.time[i + 1]);
            }
        }
        record
    }

    /// The fit follows the slopes of these states by the values, so they must be those of what is found.
    #[test]
    fn states_move_with_the_values_as_their_slopes_say() {
        let effect = Applied::new(effects::named("relaxation-length").unwrap(), None, vec![0.1, 0.8]).freed();
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_effect(effect);
        let (equations, p) = (model.free_equations().unwrap(), model.free_values());
        let record = record(&equations, &p);
        let at = |p: &[f64]| carry::before(&equations, p, &record, 0, &record.measured(0));
        let here = at(&p);
        assert!((here.z[0] + 0.15).abs() < 2e-3, "{}", here.z[0]);
        let (m, k) = (equations.visible, here.s.len() / equations.n());
        for j in 0..p.len() {
            let moved = |by: f64| {
                let mut p = p.clone();
                p[j] += by;
                at(&p).z[0]
            };
            let slope = (moved(1e-3) - moved(-1e-3)) / 2e-3;
            let said = here.s[m * k + m + j];
            assert!((said - slope).abs() < 0.02 * slope.abs().max(0.01), "{j}: {said} for {slope}");
        }
    }
}
