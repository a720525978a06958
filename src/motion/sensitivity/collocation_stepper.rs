//! Radau IIA collocation of order five for stiff states and their exact sensitivities (Hairer and Wanner, Solving Ordinary
//! Differential Equations II, IV.5 and IV.8).

use super::collocation_sensitivity::{SensitivityMemory, StageSlopes};
use super::radau_tableau::{STAGES, Tableau, tableau};
use super::states::LaneStates;
use super::variational_equations::VariationalEquations;
use crate::formula::{Isa, Kernel};
use crate::model::Equations;
use crate::motion::Signals;
use crate::numerics::row_factors::RowFactors;

/// The stages are evaluated side by side; a vector has one lane more.
const LANES: usize = 4;
/// Steps of Newton's method before a step is halved.
const MAX_NEWTON_STEPS: usize = 10;
/// What counts as arrived, relative to the state.
const TOLERANCE: f64 = 1e-11;
/// The longest step, s.
const LONGEST: f64 = 0.1;
/// The largest angle the vehicle may turn within a step, rad.
const TURN_PER_STEP: f64 = 0.3;
/// The most steps between two knots.
const MAX_STEPS: f64 = 32.0;
/// How often a step is halved before the motion counts as undefined.
const MAX_HALVINGS: u32 = 6;

/// Steps of the method for one arc.
///
/// The first states, those of the pose that the others do not read, are no part of Newton's system: they are integrals of
/// the others at the same nodes.
pub(crate) struct CollocationStepper<'a> {
    tableau: Tableau,
    motion: VariationalEquations<'a, LANES>,
    /// How many of the states, the first ones, are integrals.
    pose: usize,
    isa: Isa,
    rate: LaneStates<LANES>,
    /// The states at the stages.
    at: Vec<[f64; LANES]>,
    /// J and P there.
    by_states: Vec<[f64; LANES]>,
    by_p: Vec<[f64; LANES]>,
    times: [f64; LANES],
    factors: RowFactors,
    step: Vec<f64>,
    memory: SensitivityMemory,
}

impl<'a> CollocationStepper<'a> {
    /// Equations along signals at some parameters.
    pub fn new(equations: &'a Equations, signals: &'a Signals, p: &[f64]) -> Self {
        let motion = VariationalEquations::new(equations, signals, [p; LANES]);
        let n = equations.n();
        let mut rate = LaneStates::default();
        rate.make_room(n, 0);
        Self {
            tableau: tableau(),
            pose: integrals(motion.read_by()),
            motion,
            isa: Isa::best(),
            rate,
            at: vec![[0.0; LANES]; n],
            by_states: vec![[0.0; LANES]; n * n],
            by_p: vec![[0.0; LANES]; n * p.len()],
            times: [0.0; LANES],
            factors: RowFactors::default(),
            step: vec![],
            memory: SensitivityMemory::default(),
        }
    }

    /// Advances the arc, which turns at a rate, between times within which the inputs have no knot; S is stored row by row, or
    /// empty.
    pub fn advance(&mut self, z: &mut [f64], s: &mut [f64], (from, to): (f64, f64), yaw_rate: f64) {
        let span = to - from;
        if span == 0.0 {
            return;
        }
        let turning = (span * yaw_rate).abs() / TURN_PER_STEP;
        let steps = (span.abs() / LONGEST).max(turning).ceil().max(1.0);
        // What spins faster is no vehicle, and undefined.
        if steps.is_nan() || steps > MAX_STEPS {
            return z.fill(f64::NAN);
        }
        let h = span / steps;
        for i in 0..steps as usize {
            self.step(z, s, (from + h * i as f64, h), MAX_HALVINGS);
        }
    }

    /// One step, or two of half the length where Newton's method does not arrive.
    fn step(&mut self, z: &mut [f64], s: &mut [f64], (t, h): (f64, f64), halvings: u32) {
        if !z.iter().all(|z| z.is_finite()) {
            return;
        }
        if self.stages(z, (t, h)).is_none() {
            if halvings == 0 {
                return z.fill(f64::NAN);
            }
            self.step(z, s, (t, h / 2.0), halvings - 1);
            return self.step(z, s, (t + h / 2.0, h / 2.0), halvings - 1);
        }
        self.evaluate();
        self.integrate(z, h);
        match s.is_empty() {
            true => self.evaluate(),
            false => {
                self.linearise();
                let Self { tableau, pose, by_states, by_p, memory, .. } = self;
                StageSlopes { tableau, h, n: z.len(), pose: *pose, by_states, by_p }.advance(s, memory);
            }
        }
        self.integrate(z, h);
        z.iter_mut().zip(&self.at).for_each(|(z, at)| *z = at[STAGES - 1]);
    }

    /// The states at the stages but for the pose, by Newton's method with the derivatives of the beginning.
    fn stages(&mut self, begin: &[f64], (t, h): (f64, f64)) -> Option<()> {
        self.stand(begin, [t; LANES]);
        self.linearise();
        let (n, pose, a) = (begin.len(), self.pose, self.tableau.a);
        let free = n - pose;
        let by_states = &self.by_states;
        let factored = self.factors.factor(STAGES * free, |row, col| {
            let slope = by_states[(pose + row % free) * n + pose + col % free][0];
            f64::from(u8::from(row == col)) - h * a[row / free][col / free] * slope
        });
        if !factored {
            return None;
        }
        (0..STAGES).for_each(|i| self.times[i] = t + self.tableau.c[i] * h);
        let mut before = None;
        for _ in 0..MAX_NEWTON_STEPS {
            self.evaluate();
            self.step.clear();
            for row in 0..STAGES * free {
                let (i, k) = (row / free, pose + row % free);
                let moved: f64 = (0..STAGES).map(|j| a[i][j] * self.rate.z[k][j]).sum();
                self.step.push(begin[k] + h * moved - self.at[k][i]);
            }
            self.factors.solve(&mut self.step);
            if !self.step.iter().all(|by| by.is_finite()) {
                return None;
            }
            let mut largest = 0.0_f64;
            for (row, by) in self.step.iter().enumerate() {
                let at = &mut self.at[pose + row % free][row / free];
                *at += by;
                largest = largest.max(by.abs() / (1.0 + at.abs()));
            }
            // What is left goes on falling as it fell.
            let falls = before.map_or(1.0, |before: f64| largest / before);
            if largest <= TOLERANCE || falls < 1.0 && falls / (1.0 - falls) * largest <= TOLERANCE {
                return Some(());
            }
            before = Some(largest);
        }
        None
    }

    /// The pose at the stages by the rates there.
    fn integrate(&mut self, begin: &[f64], h: f64) {
        for (k, begin) in begin.iter().enumerate().take(self.pose) {
            for i in 0..STAGES {
                let moved: f64 = (0..STAGES).map(|j| self.tableau.a[i][j] * self.rate.z[k][j]).sum();
                self.at[k][i] = begin + h * moved;
            }
        }
    }

    /// All lanes at a state.
    fn stand(&mut self, z: &[f64], times: [f64; LANES]) {
        self.at.iter_mut().zip(z).for_each(|(at, z)| *at = [*z; LANES]);
        self.times = times;
    }

    /// The rates at the stages.
    fn evaluate(&mut self) {
        let Self { motion, at, times, rate, .. } = self;
        self.isa.dispatch(Rates { motion, at, times, rate });
    }

    /// The rates at the stages and their derivatives.
    fn linearise(&mut self) {
        let Self { motion, at, times, rate, by_states, by_p, .. } = self;
        self.isa.dispatch(Linearised { motion, at, times, rate, by_states, by_p });
    }
}

/// How many states, the first ones, are integrals of the others: none of the others reads them, and those of them that they
/// read among themselves read none of them.
fn integrals(read_by: &[Vec<usize>]) -> usize {
    let fits = |pose: usize| {
        let (own, others) = read_by.split_at(pose);
        let inner = |reads: &Vec<usize>| reads.iter().copied().filter(|j| *j < pose).collect::<Vec<_>>();
        let is_integral = |j: usize| inner(&own[j]).is_empty();
        others.iter().all(|reads| inner(reads).is_empty())
            && own.iter().all(|reads| inner(reads).into_iter().all(is_integral))
    };
    (0..=3.min(read_by.len().saturating_sub(1))).rev().find(|pose| fits(*pose)).unwrap_or(0)
}

struct Rates<'s, 'a> {
    motion: &'s mut VariationalEquations<'a, LANES>,
    at: &'s [[f64; LANES]],
    times: &'s [f64; LANES],
    rate: &'s mut LaneStates<LANES>,
}

impl Kernel for Rates<'_, '_> {
    #[inline(always)]
    fn run(self) {
        self.motion.rate(self.at, &[], self.times, self.rate);
    }
}

struct Linearised<'s, 'a> {
    motion: &'s mut VariationalEquations<'a, LANES>,
    at: &'s [[f64; LANES]],
    times: &'s [f64; LANES],
    rate: &'s mut LaneStates<LANES>,
    by_states: &'s mut [[f64; LANES]],
    by_p: &'s mut [[f64; LANES]],
}

impl Kernel for Linearised<'_, '_> {
    #[inline(always)]
    fn run(self) {
        self.motion.linearised(self.at, self.times, &mut self.rate.z, [self.by_states, self.by_p]);
    }
}

#[cfg(test)]
mod tests {
    use crate::effects::{self, Applied};
    use crate::model::forces::{Dynamics, Masses};
    use crate::model::{Equations, Model};
    use crate::motion::{Signals, StateSensitivity, Stepper, Timing, initial_hidden};

    /// A robot by its torques whose light wheels forget in 2 ms, its mass left free, with more effects.
    fn robot(more: &[Applied]) -> (Equations, Vec<f64>) {
        let model = Model::new("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.5)]).unwrap();
        let wheels = [("theta_1'".into(), 0.005), ("theta_2'".into(), 0.005)].into();
        let masses = Masses { mass: 20.0, inertia: 1.0, mass_offset: 0.1, wheels, ..Masses::default() };
        let robot = Dynamics::new(&model, &masses).unwrap();
        let robot = robot.driven_by(&["wheel_torque_left", "wheel_torque_right"]).unwrap();
        let robot = robot.with_laws("viscous", &[200.0]).unwrap().model().unwrap();
        let mass = Applied::new(effects::named("mass").unwrap(), None, vec![0.2]).freed();
        let robot = more.iter().fold(robot.with_effect(mass), |robot, effect| robot.with_effect(effect.clone()));
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

    /// Rows a twentieth of a second apart end where sixteen times as many do, once the wheels roll as their torques let them.
    #[test]
    fn long_rows_end_where_short_ones_do() {
        let (equations, p) = robot(&[]);
        let mut begin: Vec<f64> = (0..equations.visible).map(|i| 0.1 * (i as f64 + 1.0)).collect();
        begin.extend(initial_hidden(&equations, &p, &[0.0, 0.7_f64.sin()], &begin));
        let [long, short] = [0.05, 0.05 / 16.0].map(|row| after(&equations, &p, &begin, row));
        for (a, b) in long.z.iter().zip(&short.z).chain(long.s.iter().zip(&short.s)) {
            assert!((a - b).abs() < 1e-5 * (1.0 + b.abs()), "{a} {b}");
        }
    }

    /// The sensitivities are the derivatives of what the steps give.
    #[test]
    fn sensitivities_are_those_of_the_end() {
        let hill = Applied::new(effects::named("hill").unwrap(), None, vec![0.1, 0.4]).freed();
        // On a hill the speeds read the heading.
        for (integrals, more) in [(3, vec![]), (2, vec![hill])] {
            let (equations, p) = robot(&more);
            assert_eq!(super::integrals(&equations.read_by()), integrals);
            check_sensitivities(&equations, &p);
        }
    }

    fn check_sensitivities(equations: &Equations, p: &[f64]) {
        let begin: Vec<f64> = (0..equations.n()).map(|i| 0.1 * (i as f64 + 1.0)).collect();
        let exact = after(equations, p, &begin, 0.1);
        let (n, m) = (equations.n(), equations.visible);
        let k = m + p.len();
        for c in 0..k {
            let moved = |by: f64| {
                let (mut p, mut begin) = (p.to_vec(), begin.clone());
                if c < m {
                    begin[c] += by
                } else {
                    p[c - m] += by
                }
                after(equations, &p, &begin, 0.1).z
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
        let (equations, p) = robot(&[]);
        let yaw = equations.states.iter().position(|s| s.as_str() == "body.omega").unwrap();
        for wild in [1e6, f64::NAN] {
            let mut begin = vec![0.1; equations.n()];
            begin[yaw] = wild;
            assert!(after(&equations, &p, &begin, 0.1).z.iter().any(|z| z.is_nan()));
        }
    }
}
