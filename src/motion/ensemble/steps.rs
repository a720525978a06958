//! Explicit Runge–Kutta steps of fixed length on a block of lanes, with compensated sums.

use super::equations::LaneEquations;
use super::lanes::{LANES, Lane};
use crate::formula::{Isa, Kernel, Memory, Rows};
use crate::motion::integrators::tableau::{ORDER_4, ORDER_8, Tableau};

/// A stretch of time on which the inputs are smooth, cut into steps of equal length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    pub from: f64,
    pub to: f64,
    pub steps: usize,
    /// Whether its end is asked for.
    pub row: bool,
}

/// The coefficients of a method without its zeros.
pub(crate) struct Scheme {
    pub stages: usize,
    pub order: i32,
    c: Vec<f64>,
    a: Vec<Vec<(usize, f64)>>,
    b: Vec<(usize, f64)>,
}

fn sparse(row: &[f64]) -> Vec<(usize, f64)> {
    row.iter().copied().enumerate().filter(|(_, v)| *v != 0.0).collect()
}

impl Scheme {
    /// The method of order 8, or that of order 4.
    pub fn of_order(order: i32) -> Self {
        Self::of(if order == 8 { &ORDER_8 } else { &ORDER_4 })
    }

    fn of(t: &Tableau) -> Self {
        let a = std::iter::once(vec![]).chain(t.a.iter().map(|row| sparse(row))).collect();
        Self { stages: t.c.len(), order: t.order, c: t.c.to_vec(), a, b: sparse(t.b) }
    }
}

/// The most numbers that are kept of the instants of a run: 2 MiB.
const MAX_KEPT_INSTANTS: usize = 1 << 18;

/// What depends on the time alone, stage by stage of a run: the same for every block of cases, and kept for the next one
/// where it is not too much.
#[derive(Clone, Default)]
pub(crate) struct Instants {
    values: Vec<f64>,
    at: usize,
    all: usize,
}

impl Instants {
    /// To the start of a run of so many steps.
    pub fn rewind(&mut self, e: &LaneEquations, scheme: &Scheme, steps: usize) {
        self.at = 0;
        self.all = steps.saturating_mul(scheme.stages * e.rates.instant_len());
        if self.values.len() != self.all {
            self.values.clear();
        }
    }

    /// Goes to the next step; whether its instants are to be computed.
    #[inline(always)]
    fn next(&mut self) -> bool {
        if self.all == 0 || self.at < self.values.len() {
            return false;
        }
        if self.all > MAX_KEPT_INSTANTS {
            self.values.clear();
            self.at = 0;
        }
        true
    }
}

/// Memory for integrating a block.
pub(crate) struct Block {
    pub memory: Memory<LANES>,
    /// Rates, stage by stage.
    k: Rows<LANES>,
    logged: Vec<f64>,
    slopes: Vec<f64>,
}

impl Block {
    pub fn new(e: &LaneEquations, stages: usize) -> Self {
        let channels = e.log.as_ref().map_or(0, |l| l.channels());
        Self {
            memory: e.rates.memory(),
            k: Rows::new(stages * e.n),
            logged: vec![0.0; channels],
            slopes: vec![0.0; channels],
        }
    }
}

/// States under way, and what rounding has taken from their sums so far: it goes into the next step. Otherwise the
/// rounding of a long run grows with the square of its steps.
pub(crate) struct States {
    pub z: Vec<Lane>,
    lost: Vec<Lane>,
    pub start: Vec<Lane>,
    /// How far each has been from its start.
    pub reach: Vec<Lane>,
}

impl States {
    pub fn new(z: &[Lane]) -> Self {
        let none = vec![[0.0; LANES]; z.len()];
        Self { z: z.to_vec(), lost: none.clone(), start: z.to_vec(), reach: none }
    }

    #[inline(always)]
    pub fn note_reach(&mut self) {
        for ((z, start), reach) in self.z.iter().zip(&self.start).zip(&mut self.reach) {
            for l in 0..LANES {
                let far = (z[l] - start[l]).abs();
                reach[l] = if far > reach[l] { far } else { reach[l] };
            }
        }
    }
}

/// Advances the states of a block over a span.
pub(crate) fn advance(e: &LaneEquations, scheme: &Scheme, span: Span, states: &mut States, memory: Running, isa: Isa) {
    let Running { block, instants } = memory;
    isa.dispatch(Advance { e, scheme, span, states, block, instants });
}

/// Memory of a run under way.
pub(crate) struct Running<'a> {
    pub block: &'a mut Block,
    pub instants: &'a mut Instants,
}

struct Advance<'a> {
    e: &'a LaneEquations,
    scheme: &'a Scheme,
    span: Span,
    states: &'a mut States,
    block: &'a mut Block,
    instants: &'a mut Instants,
}

impl Kernel for Advance<'_> {
    #[inline(always)]
    fn run(self) {
        let Advance { e, scheme, span, states, block, instants } = self;
        let h = (span.to - span.from) / span.steps as f64;
        // At the ends themselves rounding would look across a kink of the inputs.
        let margin = 4.0 * f64::EPSILON * span.from.abs().max(span.to.abs());
        let within = [span.from + margin, span.to - margin];
        for i in 0..span.steps {
            let t = span.from + h * i as f64;
            if instants.next() {
                for c in &scheme.c {
                    let at = (t + c * h).max(within[0]).min(within[1]);
                    e.set_clock(at, &mut block.memory, &mut block.logged, &mut block.slopes);
                    e.rates.push_instant(&mut block.memory, &mut instants.values);
                }
            }
            step(e, scheme, h, states, block, &instants.values[instants.at..]);
            instants.at += scheme.stages * e.rates.instant_len();
        }
    }
}

#[inline(always)]
fn step(e: &LaneEquations, scheme: &Scheme, h: f64, states: &mut States, block: &mut Block, instants: &[f64]) {
    let (n, instant) = (e.n, e.rates.instant_len());
    for s in 0..scheme.stages {
        // States that no rate reads need no value between the steps.
        for i in &e.read {
            *block.memory.input(*i) = sum(&states.z[*i], &scheme.a[s], h, &block.k, n, *i);
        }
        e.rates.run_at(&mut block.memory, &instants[s * instant..(s + 1) * instant]);
        for i in 0..n {
            block.k[s * n + i] = *e.rates.output(&block.memory, i);
        }
    }
    for (i, (z, lost)) in states.z.iter_mut().zip(&mut states.lost).enumerate().take(n) {
        let more = sum(lost, &scheme.b, h, &block.k, n, i);
        add(z, &more, lost);
    }
    states.note_reach();
}

/// Adds to a state; what rounding takes from the sum is exactly `lost` (D. E. Knuth, *The Art of Computer Programming* 2,
/// 4.2.2, theorem C).
#[inline(always)]
fn add(z: &mut Lane, more: &Lane, lost: &mut Lane) {
    for l in 0..LANES {
        let total = z[l] + more[l];
        let added = total - z[l];
        lost[l] = (z[l] - (total - added)) + (more[l] - added);
        z[l] = total;
    }
}

/// z + h·Σ weight·rate
#[inline(always)]
fn sum(z: &Lane, weights: &[(usize, f64)], h: f64, k: &[Lane], n: usize, i: usize) -> Lane {
    let mut total = *z;
    for (j, weight) in weights {
        let (w, rate) = (h * weight, &k[j * n + i]);
        for l in 0..LANES {
            total[l] += w * rate[l];
        }
    }
    total
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_lost_of_a_long_sum() {
        for (a, b) in [(1e16, 1.0), (1.0, 1e16), (-1.0, 1e16)] {
            let (mut z, mut lost) = ([a; LANES], [0.0; LANES]);
            add(&mut z, &[b; LANES], &mut lost);
            assert_eq!((z[3], lost[3]), (1e16, a.min(b)));
        }
        let (mut z, mut lost) = ([1.0; LANES], [0.0; LANES]);
        for _ in 0..10_000 {
            let more = lost.map(|l| l + 1e-17);
            add(&mut z, &more, &mut lost);
        }
        assert!((z[0] - 1.0 - 1e-13).abs() < 1e-15, "{:e}", z[0] - 1.0);
    }

    /// What is known of an instant is not computed again, and is kept for the next block where it is not too much.
    #[test]
    fn instants_are_kept_where_there_are_not_too_many() {
        let at = |all: usize, known: usize, at: usize| {
            let mut instants = Instants { values: vec![0.0; known], at, all };
            (instants.next(), instants.values.len(), instants.at)
        };
        assert_eq!(at(0, 0, 0), (false, 0, 0), "nothing depends on the time");
        assert_eq!(at(10, 10, 5), (false, 10, 5));
        assert_eq!(at(10, 5, 5), (true, 5, 5));
        assert_eq!(at(MAX_KEPT_INSTANTS, 5, 5), (true, 5, 5));
        assert_eq!(at(MAX_KEPT_INSTANTS + 1, 5, 5), (true, 0, 0), "one step at a time");
    }
}
