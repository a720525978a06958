//! How states that no sensor sees began, where the log does not say: by what the poses do soon after.

use super::first_rows::Rows;
use crate::discrepancy::record::run_record::Record;
use crate::model::Equations;
use crate::motion::StateSensitivity;
use crate::numerics::levenberg_marquardt::{Damping, LeastSquares, Minimum, minimise};
use nalgebra::{DMatrix, DVector};

/// A state of which less is left of how it began is taken as it was carried.
const FADED: f64 = 0.02;
/// Steps that are evaluated, at most.
const MOST_STEPS: usize = 7;
/// A step that gains less, in units of χ², is the last: what one leaves goes with the square of what it gains.
const SETTLED: f64 = 0.1;
/// How far a pose is moved to see what it does, m and rad; a value of the model by such a share of itself.
const TRIED: f64 = 1e-4;
/// A value near zero is moved as if it were this large.
const SMALL: f64 = 1e-2;
/// A pose may be anywhere near its measurement, m and rad.
const ANYWHERE: f64 = 1.0;

/// What is known beforehand of hidden states at a row.
pub(crate) struct PropagatedState<'a> {
    /// The states, and their sensitivities.
    pub arc: StateSensitivity,
    /// The pose there.
    pub pose: &'a [f64],
    /// How much is left of how each state began: one at the start of a log.
    pub memory: Vec<f64>,
}

impl PropagatedState<'_> {
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
    pub fn settled(self, equations: &Equations, p: &[f64], record: &Record, row: usize) -> (StateSensitivity, f64) {
        match self.shown(equations, p, record, row) {
            Some(Posterior { z, share, by_values }) => {
                let (m, k, h) = (equations.visible, self.arc.s.len() / equations.n(), z.len());
                let mut s = self.arc.s.clone();
                for (i, c) in (0..h).flat_map(|i| (0..k).map(move |c| (i, c))) {
                    let carried: f64 = (0..h).map(|j| share[(i, j)] * self.arc.s[(m + j) * k + c]).sum();
                    s[(m + i) * k + c] = carried + if c < m { 0.0 } else { by_values[(i, c - m)] };
                }
                (StateSensitivity { z, s }, h as f64 - share.trace())
            }
            None => (self.arc, 0.0),
        }
    }

    /// What the poses show; `None` where nothing is asked.
    fn shown(&self, equations: &Equations, p: &[f64], record: &Record, row: usize) -> Option<Posterior> {
        if self.memory.iter().all(|m| *m < FADED) {
            return None;
        }
        let rows = Rows::of(equations, p, record, row)?;
        let spread: Vec<f64> = self.memory.iter().zip(rows.sizes()).map(|(m, a)| m * a).collect();
        let known = spread.iter().all(|s| s.is_finite() && *s > 0.0);
        if known { fitted(&rows, &self.arc.z, self.pose, &spread) } else { None }
    }
}

/// Hidden states that fit the poses.
struct Posterior {
    z: Vec<f64>,
    /// How much of what they were carried to is still in them, ∂h/∂h₀.
    share: DMatrix<f64>,
    /// By the model's values alone, h₀ held: with other values other states fit the same poses.
    by_values: DMatrix<f64>,
}

/// What misses both the rows and what was carried to them, as a sum of squares.
struct Prior<'a> {
    rows: &'a Rows<'a>,
    before: Vec<f64>,
    /// Standard deviations beforehand of pose and hidden states.
    deviations: Vec<f64>,
    information: DVector<f64>,
}

/// A beginning, the slopes of what the rows miss from it, and the normal equations of that and of what was carried.
struct Missed {
    begin: Vec<f64>,
    jacobian: DMatrix<f64>,
    information: DMatrix<f64>,
    gradient: DVector<f64>,
}

impl<'a> Prior<'a> {
    fn of(rows: &'a Rows<'a>, carried: &[f64], pose: &[f64], spread: &[f64]) -> Self {
        let deviations = [&vec![ANYWHERE; pose.len()], spread].concat();
        let information = DVector::from_iterator(deviations.len(), deviations.iter().map(|d| d.powi(-2)));
        Self { rows, before: [pose, carried].concat(), deviations, information }
    }

    fn at(&self, begin: Vec<f64>) -> Option<Missed> {
        let rows = self.rows;
        let (residuals, jacobian) = with_slopes(
            &begin,
            |i| self.deviations[i].min(1.0),
            |tries| rows.all_missed(tries.iter().map(|begin| (rows.p, &begin[..]))),
        )?;
        let mut information = jacobian.tr_mul(&jacobian);
        (0..begin.len()).for_each(|i| information[(i, i)] += self.information[i]);
        let away = |i: usize, _| self.information[i] * (begin[i] - self.before[i]);
        let gradient = jacobian.tr_mul(&residuals) + DVector::from_fn(begin.len(), away);
        Some(Missed { begin, jacobian, information, gradient })
    }
}

fn plus(begin: &[f64], step: &DVector<f64>) -> Vec<f64> {
    begin.iter().zip(step.iter()).map(|(z, s)| z + s).collect()
}

impl LeastSquares for Prior<'_> {
    type Point = Missed;

    fn normal(&self, here: &Missed) -> (DMatrix<f64>, DVector<f64>) {
        (here.information.clone(), here.gradient.clone())
    }

    fn next(&self, here: &Missed, step: &DVector<f64>, _: f64) -> Option<Missed> {
        self.at(plus(&here.begin, step))
    }

    fn is_small(&self, here: &Missed, step: &DVector<f64>, _: Option<f64>) -> bool {
        -here.gradient.dot(step) < SETTLED
    }
}

/// Hidden states that fit both the rows and what they were carried to: whole steps of Gauss and Newton, for the start
/// is near, and the last of them is taken unevaluated.
fn fitted(rows: &Rows, carried: &[f64], pose: &[f64], spread: &[f64]) -> Option<Posterior> {
    let (m, h) = (pose.len(), carried.len());
    let prior = Prior::of(rows, carried, pose, spread);
    let Minimum { here, step, .. } = minimise(&prior, prior.at(prior.before.clone())?, &Damping::NONE, MOST_STEPS);
    let mut begin = plus(&here.begin, &step?);
    let factors = here.information.cholesky()?;
    let covariance = factors.inverse();
    let share = DMatrix::from_fn(h, h, |i, j| covariance[(m + i, m + j)] * prior.information[m + j]);
    // Where the sum is least its slope is zero whatever the values: they move the states by −(JᵀJ + P)⁻¹·Jᵀ·∂r/∂p.
    let (_, by_values) = with_slopes(
        rows.p,
        |j| rows.p[j].abs().max(SMALL),
        |tries| rows.all_missed(tries.iter().map(|p| (&p[..], &begin[..]))),
    )?;
    let moved = -factors.solve(&here.jacobian.tr_mul(&by_values));
    let by_values = moved.rows(m, h).into_owned();
    begin.iter().all(|z| z.is_finite()).then(|| Posterior { z: begin.split_off(m), share, by_values })
}

/// What is missed at some numbers, and what each of them does to it: one is moved by a small share of its size, and
/// nothing else. All are tried side by side.
fn with_slopes(
    at: &[f64],
    size: impl Fn(usize) -> f64,
    missed: impl Fn(&[Vec<f64>]) -> Option<Vec<DVector<f64>>>,
) -> Option<(DVector<f64>, DMatrix<f64>)> {
    let step = |i: usize| TRIED * size(i);
    let beside = |i: usize| at.iter().enumerate().map(|(j, x)| if i == j { x + step(i) } else { *x }).collect();
    let tries: Vec<Vec<f64>> = std::iter::once(at.to_vec()).chain((0..at.len()).map(beside)).collect();
    let mut found = missed(&tries)?;
    let here = found.remove(0);
    let mut slopes = DMatrix::zeros(here.len(), at.len());
    for (i, missed) in found.into_iter().enumerate() {
        slopes.set_column(i, &((missed - &here) / step(i)));
    }
    Some((here, slopes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::{WEAVING, equations, logged};
    use crate::discrepancy::initial_state::hidden_states;
    use crate::motion::Timing;

    /// A vehicle that slides already when its log begins, and nearly forgets within it; its speed lags, if told.
    const SLIDES: [(&str, &[f64]); 2] = [("relaxation-length", &[0.1, 0.8]), ("traction-creep", &[0.4])];

    fn record(equations: &Equations, p: &[f64], noise: f64) -> Record {
        let time = (0..80).map(|i| 0.05 * f64::from(i)).collect();
        let begin = [0.0, 0.0, 0.2, -0.15, 0.6];
        logged((equations, p), time, WEAVING, &begin[..equations.n()], noise)
    }

    /// What a number does to the hidden states that `at` finds.
    fn slope(at: impl Fn(f64) -> Vec<f64>, by: f64) -> Vec<f64> {
        at(by).iter().zip(at(-by)).map(|(more, less)| (more - less) / (2.0 * by)).collect()
    }

    /// The fit follows the slopes of these states by the values, so they must be those of what is found.
    #[test]
    fn states_move_with_the_values_as_their_slopes_say() {
        for (known, row, small) in [(&SLIDES[..1], 0, 0.01), (&SLIDES, 0, 0.01), (&SLIDES, 8, 0.05)] {
            let (equations, p) = equations(known);
            let record = record(&equations, &p, 2e-4);
            let at = |p: &[f64]| hidden_states::before(&equations, p, &record, row, &record.measured(row));
            let here = at(&p);
            assert!(row > 0 || (here.z[0] + 0.15).abs() < 2e-3, "{}", here.z[0]);
            let (m, k) = (equations.visible, here.s.len() / equations.n());
            for j in 0..p.len() {
                let moved = |by: f64| {
                    let mut p = p.clone();
                    p[j] += by;
                    at(&p).z
                };
                for (i, slope) in slope(moved, 1e-3).into_iter().enumerate() {
                    let said = here.s[(m + i) * k + m + j];
                    assert!((said - slope).abs() < 0.02 * slope.abs().max(small), "{row} {i} {j}: {said} for {slope}");
                }
            }
        }
    }

    /// States carried to row 0, as the rows after it leave them; noise as large as leaves something to either side.
    struct Start {
        equations: Equations,
        p: Vec<f64>,
        record: Record,
    }

    impl Start {
        fn new(noise: f64) -> Self {
            let (equations, p) = equations(&SLIDES);
            let record = record(&equations, &p, noise);
            Self { equations, p, record }
        }

        fn columns(&self) -> usize {
            self.equations.visible + self.p.len()
        }

        fn settled(&self, carried: [f64; 2], memory: [f64; 2], s: &[f64]) -> (StateSensitivity, f64) {
            let (pose, arc) = (self.record.measured(0), StateSensitivity { z: carried.to_vec(), s: s.to_vec() });
            let carried = PropagatedState { arc, pose: &pose, memory: memory.to_vec() };
            carried.settled(&self.equations, &self.p, &self.record, 0)
        }

        /// What is left of what was carried, ∂hᵢ/∂h₀ⱼ, by differences.
        fn left(&self, carried: [f64; 2], memory: [f64; 2]) -> DMatrix<f64> {
            let s = vec![0.0; self.equations.n() * self.columns()];
            let moved = |j: usize, by: f64| {
                let mut carried = carried;
                carried[j] += by;
                self.settled(carried, memory, &s).0.z
            };
            let columns: Vec<_> = (0..2).map(|j| DVector::from_vec(slope(|by| moved(j, by), 1e-3))).collect();
            DMatrix::from_columns(&columns)
        }
    }

    #[test]
    fn what_the_poses_do_not_decide_is_left_as_it_was_carried() {
        let start = Start::new(0.03);
        let (n, k, m) = (start.equations.n(), start.columns(), start.equations.visible);
        let carried = [0.02, 1.9];
        let zero = vec![0.0; n * k];
        let slopes: Vec<f64> = (0..n * k).map(|i| (i as f64).sin()).collect();
        let mut decided = Vec::new();
        for memory in [[1.0, 1.0], [0.9, 0.05], [0.3, 0.2]] {
            let left = start.left(carried, memory);
            let (arc, asked) = start.settled(carried, memory, &slopes);
            assert!((asked - (2.0 - left.trace())).abs() < 0.02, "{asked} {left}");
            decided.push(asked);
            let bare = start.settled(carried, memory, &zero).0;
            for (i, c) in (0..2).flat_map(|i| (0..k).map(move |c| (i, c))) {
                let more = arc.s[(m + i) * k + c] - bare.s[(m + i) * k + c];
                let carried: f64 = (0..2).map(|j| left[(i, j)] * slopes[(m + j) * k + c]).sum();
                assert!((more - carried).abs() < 0.02, "{i} {c}: {more} {carried}");
                assert!(c >= m || bare.s[(m + i) * k + c] == 0.0);
            }
        }
        assert!(decided[0] > 1.9 && decided[1] < 1.7 && decided[2] < 1.9, "{decided:?}");
    }

    #[test]
    fn what_has_faded_is_not_asked_for() {
        let start = Start::new(2e-4);
        let (carried, s) = ([0.02, 1.9], vec![0.5; start.equations.n() * start.columns()]);
        let (arc, asked) = start.settled(carried, [0.019, 0.019], &s);
        assert_eq!((&arc.z[..], &arc.s[..], asked), (&carried[..], &s[..], 0.0));
        // One that has not is enough; the other may move by as little as is left of it.
        for memory in [[0.019, 1.0], [1.0, 0.019], [0.02, 0.02]] {
            let (arc, asked) = start.settled(carried, memory, &s);
            assert!(asked > 0.01 && arc.z != carried, "{memory:?}: {asked}");
        }
        // Without a way to say how large a state is nothing is asked.
        let resting = Record::new(
            "run",
            start.record.time.clone(),
            start.record.columns.clone(),
            true,
            &[vec![0.0; 80], vec![0.0; 80]],
            Timing::Sample,
        );
        let (arc, asked) = Start { record: resting, ..start }.settled(carried, [1.0, 1.0], &s);
        assert_eq!((&arc.z[..], asked), (&carried[..], 0.0));
    }
}
