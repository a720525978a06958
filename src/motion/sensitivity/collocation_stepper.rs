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
/// The most steps between two knots.
const MAX_STEPS: f64 = 256.0;
/// How often a step is halved before the motion counts as undefined.
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
            // What spins faster is no vehicle, and undefined.
            if steps.is_nan() || steps > MAX_STEPS {
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
        if !begin.iter().all(|z| z.is_finite()) {
            return;
        }
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
        let rates = self.rates(motion, begin, l, t);
        let by_states = motion.by_states(&self.at.z, false, l);
        let lu = self.matrix(&[&by_states; STAGES], h)?;
        let mut stages: Vec<DVector<f64>> = self.tableau.c.iter().map(|c| begin + &rates * (c * h)).collect();
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
        let each: Vec<[DMatrix<f64>; 2]> =
            stages.iter().zip(times).map(|(z, t)| self.slopes(motion, z, l, t)).collect();
        let pushed: Vec<DMatrix<f64>> = each.iter().map(|[by_states, rest]| by_states * &before + rest).collect();
        let right = DMatrix::from_fn(STAGES * n, k, |row, c| {
            let (i, m) = (row / n, row % n);
            h * (0..STAGES).map(|j| self.tableau.a[i][j] * pushed[j][(m, c)]).sum::<f64>()
        });
        let lu = self.matrix(&[&each[0][0], &each[1][0], &each[2][0]], h);
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
        self.stand(z);
        motion.rate(&self.at.z, &[], &[t; L], &mut self.rate);
        column(&self.rate.z, l)
    }

    /// The derivatives of the rates by the states, and by what else the sensitivities hang on: S′ where S is zero.
    fn slopes(
        &mut self,
        motion: &mut VariationalEquations<L>,
        z: &DVector<f64>,
        l: usize,
        t: f64,
    ) -> [DMatrix<f64>; 2] {
        self.stand(z);
        self.at.s.fill([0.0; L]);
        self.rate.s.fill([0.0; L]);
        motion.rate(&self.at.z, &self.at.s, &[t; L], &mut self.rate);
        let (n, k) = (z.len(), self.rate.s.len() / z.len());
        let by_rest = DMatrix::from_fn(n, k, |i, c| self.rate.s[i * k + c][l]);
        [motion.by_states(&self.at.z, true, l), by_rest]
    }

    /// All lanes stand where one does: those that have nothing to do must not be undefined.
    fn stand(&mut self, z: &DVector<f64>) {
        self.at.z.iter_mut().zip(z.iter()).for_each(|(at, z)| *at = [*z; L]);
    }
}

fn column<const L: usize>(values: &[[f64; L]], l: usize) -> DVector<f64> {
    DVector::from_iterator(values.len(), values.iter().map(|v| v[l]))
}

#[cfg(test)]
mod tests {
    use crate::effects::{self, Applied};
    use crate::model::forces::{Dynamics, Masses};
    use crate::model::{Equations, Model};
    use crate::motion::{Signals, StateSensitivity, Stepper, Timing};

    /// A robot by its torques whose light wheels forget in 2 ms, its mass left free.
    fn robot() -> (Equations, Vec<f64>) {
        let model = Model::new("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.5)]).unwrap();
        let wheels = [("theta_1'".into(), 0.005), ("theta_2'".into(), 0.005)].into();
        let masses = Masses { mass: 20.0, inertia: 1.0, mass_offset: 0.1, wheels, ..Masses::default() };
        let robot = Dynamics::new(&model, &masses).unwrap();
        let robot = robot.driven_by(&["wheel_torque_left", "wheel_torque_right"]).unwrap();
        let robot = robot.with_laws("viscous", &[200.0]).unwrap().model().unwrap();
        let mass = Applied::new(effects::named("mass").unwrap(), None, vec![0.2]).freed();
        let robot = robot.with_effect(mass);
        (robot.free_equations().unwrap(), robot.free_values())
    }

    fn driven() -> Signals {
        let time: Vec<f64> = (0..=20).map(|i| 0.1 * f64::from(i)).collect();
        let column = |shift: f64| time.iter().map(|t| (2.0 * t + shift).sin()).collect::<Vec<f64>>();
        Signals::new(&time, &[column(0.0), column(0.7)], Timing::Sample)
    }

    fn after(equations: &Equations, p: &[f64], begin: &[f64], row: f64) -> StateSensitivity {
        let signals = driven();
        let mut stepper = Stepper::new(equations, &signals, p);
        let mut arc = stepper.start(begin, None);
        let rows = (1.6 / row).round() as usize;
        (0..rows).for_each(|i| stepper.advance(&mut arc, row * i as f64, row * (i + 1) as f64));
        arc
    }

    /// Rows a tenth of a second apart end where sixteen times as many do, stiff wheels or not.
    #[test]
    fn long_rows_end_where_short_ones_do() {
        let (equations, p) = robot();
        let begin: Vec<f64> = (0..equations.n()).map(|i| 0.1 * (i as f64 + 1.0)).collect();
        let [long, short] = [0.1, 0.1 / 16.0].map(|row| after(&equations, &p, &begin, row));
        for (a, b) in long.z.iter().zip(&short.z).chain(long.s.iter().zip(&short.s)) {
            assert!((a - b).abs() < 1e-5 * (1.0 + b.abs()), "{a} {b}");
        }
    }

    /// The sensitivities are the derivatives of what the steps give.
    #[test]
    fn sensitivities_are_those_of_the_end() {
        let (equations, p) = robot();
        let begin: Vec<f64> = (0..equations.n()).map(|i| 0.1 * (i as f64 + 1.0)).collect();
        let exact = after(&equations, &p, &begin, 0.1);
        let (n, m) = (equations.n(), equations.visible);
        let k = m + p.len();
        for c in 0..k {
            let moved = |by: f64| {
                let (mut p, mut begin) = (p.clone(), begin.clone());
                if c < m {
                    begin[c] += by
                } else {
                    p[c - m] += by
                }
                after(&equations, &p, &begin, 0.1).z
            };
            let (more, less) = (moved(1e-5), moved(-1e-5));
            for i in 0..n {
                let said = (more[i] - less[i]) / 2e-5;
                assert!((exact.s[i * k + c] - said).abs() < 1e-6 * (1.0 + said.abs()), "{i} by {c}: {said}");
            }
        }
    }

    /// A body that spins thousands of times a row is undefined, and so is what begins undefined, without a search for steps.
    #[test]
    fn what_spins_is_undefined() {
        let (equations, p) = robot();
        let yaw = equations.states.iter().position(|s| s.as_str() == "body.omega").unwrap();
        for wild in [1e6, f64::NAN] {
            let mut begin = vec![0.1; equations.n()];
            begin[yaw] = wild;
            assert!(after(&equations, &p, &begin, 0.1).z.iter().any(|z| z.is_nan()));
        }
    }
}
