//! Exponential time differencing for spans far longer than a time constant: steps that follow the state's slow limit.

use super::exponential_weights::{Row, SWEEPS, Weights};
use super::states::{LaneStates, take};
use super::variational_equations::VariationalEquations;

/// How much longer each step is than the one before: what a span begins with is forgotten soon.
const STEP_GROWTH: f64 = 1.35;
/// The shortest first step, as a share of the span.
const MIN_FIRST_STEP: f64 = 1e-6;

/// The spans of some arcs.
#[derive(Debug)]
pub(crate) struct Spans<const L: usize> {
    pub from: [f64; L],
    /// Their lengths, with sign; zero for an arc that stays.
    pub length: [f64; L],
    /// The first steps.
    pub first: [f64; L],
    /// The longest steps.
    pub longest: [f64; L],
}

impl<const L: usize> Spans<L> {
    /// Spans that begin at some times and are over.
    pub fn none(from: &[f64; L]) -> Self {
        Self { from: *from, length: [0.0; L], first: [0.0; L], longest: [0.0; L] }
    }
}

/// States within such a step; see [`Weights`] for N.
#[derive(Debug, Default)]
pub(crate) struct ExponentialStepper<const L: usize> {
    now: LaneStates<L>,
    rate: LaneStates<L>,
    at: LaneStates<L>,
    /// N at the beginning, the middle and the end.
    begin: LaneStates<L>,
    middle: LaneStates<L>,
    end: LaneStates<L>,
    /// For each state.
    weights: Vec<Weights<L>>,
}

impl<const L: usize> ExponentialStepper<L> {
    /// Advances arcs and their sensitivities through spans.
    #[inline(always)]
    pub fn advance(
        &mut self,
        motion: &mut VariationalEquations<L>,
        z: &mut [[f64; L]],
        s: &mut [[f64; L]],
        spans: &Spans<L>,
    ) {
        for arcs in [&mut self.now, &mut self.rate, &mut self.at, &mut self.begin, &mut self.middle, &mut self.end] {
            arcs.make_room(z.len(), s.len());
        }
        self.now.z.copy_from_slice(z);
        self.now.s.copy_from_slice(s);
        let mut passed = [0.0; L];
        let mut next: [f64; L] = std::array::from_fn(|l| spans.first[l].max(MIN_FIRST_STEP * spans.length[l].abs()));
        loop {
            let (mut t, mut h, mut wanted) = ([0.0; L], [0.0; L], [false; L]);
            for l in 0..L {
                let left = spans.length[l].abs() - passed[l];
                wanted[l] = left > 0.0;
                let step = if next[l] < left { next[l] } else { left };
                h[l] = step.copysign(spans.length[l]);
                t[l] = spans.from[l] + passed[l].copysign(spans.length[l]);
                passed[l] = if step < left { passed[l] + step } else { spans.length[l].abs() };
                next[l] = spans.longest[l].min(STEP_GROWTH * next[l]);
            }
            if wanted == [false; L] {
                break;
            }
            self.step(motion, &t, &h);
            take(&mut self.now.z, &self.at.z, &wanted);
            take(&mut self.now.s, &self.at.s, &wanted);
        }
        z.copy_from_slice(&self.now.z);
        s.copy_from_slice(&self.now.s);
    }

    /// One step into `at`.
    #[inline(always)]
    fn step(&mut self, motion: &mut VariationalEquations<L>, t: &[f64; L], h: &[f64; L]) {
        let (mut half, mut whole) = (*t, *t);
        for l in 0..L {
            half[l] += 0.5 * h[l];
            whole[l] += h[l];
        }
        self.at.z.copy_from_slice(&self.now.z);
        self.at.s.copy_from_slice(&self.now.s);
        for k in 0..=2 * SWEEPS {
            let then = [t, &half, &whole][if k == 0 { 0 } else { 2 - k % 2 }];
            motion.rate(&self.at.z, &self.at.s, then, &mut self.rate);
            if k == 0 {
                self.weigh(motion, h);
            }
            self.take_in(k, motion);
        }
    }

    /// Weighs a step that begins here.
    #[inline(always)]
    fn weigh(&mut self, motion: &mut VariationalEquations<L>, h: &[f64; L]) {
        self.weights.resize(self.now.z.len(), Weights::default());
        let own = motion.own_slopes(&self.now.z, !self.now.s.is_empty());
        for (weights, own) in self.weights.iter_mut().zip(own) {
            // Most are as they were: what is added to is the same all the way, and so is many a time constant.
            if !weights.are_of(own, h) {
                *weights = Weights::new(own, h);
            }
        }
    }

    /// Takes in the k-th rate of a step.
    #[inline(always)]
    fn take_in(&mut self, k: usize, motion: &VariationalEquations<L>) {
        let Self { now, rate, at, begin, middle, end, weights } = self;
        let width = if now.s.is_empty() { 0 } else { motion.columns() };
        let first = if width == 0 { 0 } else { motion.first };
        for (i, weights) in weights.iter().enumerate() {
            let n = [&mut begin.z[i..=i], &mut middle.z[i..=i], &mut end.z[i..=i]];
            weights.take_in(k, Row { now: &now.z[i..=i], rate: &rate.z[i..=i], at: &mut at.z[i..=i], n });
            if i < motion.still {
                continue;
            }
            let (from, to) = (i * width + first, (i + 1) * width);
            let n = [&mut begin.s[from..to], &mut middle.s[from..to], &mut end.s[from..to]];
            weights.take_in(k, Row { now: &now.s[from..to], rate: &rate.s[from..to], at: &mut at.s[from..to], n });
        }
    }
}
