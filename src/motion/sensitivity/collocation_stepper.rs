//! Radau IIA collocation of order five for stiff states and their exact sensitivities (Hairer and Wanner, Solving Ordinary
//! Differential Equations II, IV.5 and IV.8).

use super::states::LaneStates;
use super::variational_equations::VariationalEquations;
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// Stages of the method.
const STAGES: usize = 3;
/// Steps of Newton's method before a step is halved.
const MAX_NEWTON_STEPS: usize = 10;
/// What counts as arrived, relative to the state.
const TOLERANCE: f64 = 1e-11;
/// The longest step, s.
const LONGEST: f64 = 0.1;
/// The largest angle the vehicle may turn within a step, rad.
const TURN_PER_STEP: f64 = 0.3;
/// How often a step is halved before it is taken as it is.
const MAX_HALVINGS: u32 = 6;

/// The nodes and the matrix of the method.
struct Tableau {
    c: [f64; STAGES],
    a: [[f64; STAGES]; STAGES],
}

fn tableau() -> Tableau {
    let r = 6.0_f64.sqrt();
    Tableau {
        c: [(4.0 - r) / 10.0, (4.0 + r) / 10.0, 1.0],
        a: [
            [(88.0 - 7.0 * r) / 360.0, (296.0 - 169.0 * r) / 1800.0, (-2.0 + 3.0 * r) / 225.0],
            [(296.0 + 169.0 * r) / 1800.0, (88.0 + 7.0 * r) / 360.0, (-2.0 - 3.0 * r) / 225.0],
            [(16.0 - r) / 36.0, (16.0 + r) / 36.0, 1.0 / 9.0],
        ],
    }
}

/// Steps of the method for L arcs, one arc after another.
pub(crate) struct CollocationStepper<const L: usize> {
    tableau: Tableau,
    rate: LaneStates<L>,
    at: LaneStates<L>,
}

/// Rates, their derivatives by the states, and by what else the sensitivities hang on.
struct Slopes {
    f: DVector<f64>,
    by_states: DMatrix<f64>,
    by_rest: DMatrix<f64>,
}

impl<const L: usize> Default for CollocationStepper<L> {
    fn default() -> Self {
        Self { tableau: tableau(), rate: LaneStates::default(), at: LaneStates::default() }
    }
}

impl<const L: usize> CollocationStepper<L> {
    /// Advances arcs between times within which the inputs have no knot.
    pub fn advance(
        &mut self,
        motion: &mut VariationalEquations<L>,
        z: &mut [[f64; L]],
        s: &mut [[f64; L]],
        from: &[f64; L],
        to: &[f64; L],
    ) {
        for arcs in [&mut self.rate, &mut self.at] {
            arcs.make_room(z.len(), s.len());
        }
        for l in 0..L {
            let span = to[l] - from[l];
            if span == 0.0 {
                continue;
            }
            let f = self.rates(motion, &column(z, l), l, from[l]);
            let turning = (span * f[2]).abs() / TURN_PER_STEP;
            let steps = (span.abs() / LONGEST).max(turning).ceil().max(1.0);
            if !steps.is_finite() {
                z.iter_mut().for_each(|z| z[l] = f64::NAN);
                continue;
            }
            let h = span / steps;
            for i in 0..steps as usize {
                self.step(motion, z, s, l, (from[l] + h * i as f64, h), MAX_HALVINGS);
            }
        }
    }

    /// One step of one arc, or two of half the length where Newton's method does not arrive.
    fn step(
        &mut self,
        motion: &mut VariationalEquations<L>,
        z: &mut [[f64; L]],
        s: &mut [[f64; L]],
        l: usize,
        (t, h): (f64, f64),
        halvings: u32,
    ) {
        let begin = column(z, l);
        let Some(stages) = self.stages(motion, &begin, l, (t, h)) else {
            if halvings == 0 {
                z.iter_mut().for_each(|z| z[l] = f64::NAN);
                return;
            }
            self.step(motion, z, s, l, (t, h / 2.0), halvings - 1);
            return self.step(motion, z, s, l, (t + h / 2.0, h / 2.0), halvings - 1);
        };
        if !s.is_empty() {
            self.sensitivities(motion, &stages, s, l, (t, h));
        }
        z.iter_mut().zip(stages[STAGES - 1].iter()).for_each(|(z, end)| z[l] = *end);
    }

    /// The states at the stages, by Newton's method with the derivatives of the beginning.
    fn stages(
        &mut self,
        motion: &mut VariationalEquations<L>,
        begin: &DVector<f64>,
        l: usize,
        (t, h): (f64, f64),
    ) -> Option<Vec<DVector<f64>>> {
        let n = begin.len();
        let slopes = self.slopes(motion, begin, l, t, false);
        let lu = self.matrix(&[&slopes.by_states; STAGES], h)?;
        let mut stages: Vec<DVector<f64>> = self.tableau.c.iter().map(|c| begin + &slopes.f * (c * h)).collect();
        for _ in 0..MAX_NEWTON_STEPS {
            let times = self.tableau.c.map(|c| t + c * h);
            let rates: Vec<DVector<f64>> = stages.iter().zip(times).map(|(z, t)| self.rates(motion, z, l, t)).collect();
            let off = DVector::from_fn(STAGES * n, |row, _| {
                let (i, k) = (row / n, row % n);
                let moved: f64 = (0..STAGES).map(|j| self.tableau.a[i][j] * rates[j][k]).sum();
                begin[k] + h * moved - stages[i][k]
            });
            let step = lu.solve(&off)?;
            if !step.iter().all(|v| v.is_finite()) {
                return None;
            }
            let mut arrived = true;
            for (i, stage) in stages.iter_mut().enumerate() {
                for k in 0..n {
                    let by = step[i * n + k];
                    stage[k] += by;
                    arrived &= by.abs() <= TOLERANCE * (1.0 + stage[k].abs());
                }
            }
            if arrived {
                return Some(stages);
            }
        }
        None
    }

    /// S at the end: (1 − h·A⊗J)·ΔS = h·A⊗(J·S + P), exact for the stages that were found.
    fn sensitivities(
        &mut self,
        motion: &mut VariationalEquations<L>,
        stages: &[DVector<f64>],
        s: &mut [[f64; L]],
        l: usize,
        (t, h): (f64, f64),
    ) {
        let n = stages[0].len();
        let k = s.len() / n;
        let before = DMatrix::from_fn(n, k, |i, c| s[i * k + c][l]);
        let times = self.tableau.c.map(|c| t + c * h);
        let each: Vec<Slopes> = stages.iter().zip(times).map(|(z, t)| self.slopes(motion, z, l, t, true)).collect();
        let pushed: Vec<DMatrix<f64>> = each.iter().map(|e| &e.by_states * &before + &e.by_rest).collect();
        let right = DMatrix::from_fn(STAGES * n, k, |row, c| {
            let (i, m) = (row / n, row % n);
            h * (0..STAGES).map(|j| self.tableau.a[i][j] * pushed[j][(m, c)]).sum::<f64>()
        });
        let lu = self.matrix(&[&each[0].by_states, &each[1].by_states, &each[2].by_states], h);
        let moved = lu.and_then(|lu| lu.solve(&right));
        for (entry, s) in s.iter_mut().enumerate() {
            let (i, c) = (entry / k, entry % k);
            s[l] += moved.as_ref().map_or(f64::NAN, |m| m[((STAGES - 1) * n + i, c)]);
        }
    }

    /// 1 − h·A⊗J with a J for each stage, factored.
    fn matrix(&self, by_states: &[&DMatrix<f64>; STAGES], h: f64) -> Option<LU<f64, Dyn, Dyn>> {
        let n = by_states[0].nrows();
        let matrix = DMatrix::from_fn(STAGES * n, STAGES * n, |row, col| {
            let (i, k, j, m) = (row / n, row % n, col / n, col % n);
            let own = if row == col { 1.0 } else { 0.0 };
            own - h * self.tableau.a[i][j] * by_states[j][(k, m)]
        });
        matrix.iter().all(|v| v.is_finite()).then(|| matrix.lu())
    }

    fn rates(&mut self, motion: &mut VariationalEquations<L>, z: &DVector<f64>, l: usize, t: f64) -> DVector<f64> {
        self.at.z.iter_mut().zip(z.iter()).for_each(|(at, z)| at[l] = *z);
        self.others(l);
        let mut rate = std::mem::take(&mut self.rate);
        motion.rate(&self.at.z, &[], &[t; L], &mut rate);
        let found = column(&rate.z, l);
        self.rate = rate;
        found
    }

    fn slopes(
        &mut self,
        motion: &mut VariationalEquations<L>,
        z: &DVector<f64>,
        l: usize,
        t: f64,
        with_rest: bool,
    ) -> Slopes {
        let n = z.len();
        let f = self.rates(motion, z, l, t);
        let mut by_rest = DMatrix::zeros(0, 0);
        if with_rest {
            self.at.s.fill([0.0; L]);
            let mut rate = std::mem::take(&mut self.rate);
            rate.s.fill([0.0; L]);
            motion.rate(&self.at.z, &self.at.s, &[t; L], &mut rate);
            let k = rate.s.len() / n;
            by_rest = DMatrix::from_fn(n, k, |i, c| rate.s[i * k + c][l]);
            self.rate = rate;
        }
        let by_states = motion.by_states(&self.at.z, with_rest, l);
        Slopes { f, by_states, by_rest }
    }

    /// Lanes that have nothing to do stand where this one does.
    fn others(&mut self, l: usize) {
        for at in &mut self.at.z {
            *at = [at[l]; L];
        }
    }
}

fn column<const L: usize>(values: &[[f64; L]], l: usize) -> DVector<f64> {
    DVector::from_iterator(values.len(), values.iter().map(|v| v[l]))
}
