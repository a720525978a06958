//! Steps of fixed length on a block of lanes.

use super::LANES;
use super::equations::LaneEquations;
use crate::formula::{Isa, Kernel, Memory};
use crate::motion::tableau::Tableau;

/// The lanes of one quantity.
pub(super) type Lane = [f64; LANES];

/// A stretch of time on which the inputs are smooth, cut into steps of equal length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub from: f64,
    pub to: f64,
    pub steps: usize,
    /// Whether its end is asked for.
    pub row: bool,
}

/// The coefficients of a method without its zeros.
pub(super) struct Scheme {
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
    pub fn of(t: &Tableau) -> Self {
        let a = std::iter::once(vec![]).chain(t.a.iter().map(|row| sparse(row))).collect();
        Self { stages: t.c.len(), order: t.order, c: t.c.to_vec(), a, b: sparse(t.b) }
    }
}

/// Memory for integrating a block.
pub(super) struct Block {
    pub memory: Memory<LANES>,
    /// Rates, stage by stage.
    k: Vec<Lane>,
    logged: Vec<f64>,
    slopes: Vec<f64>,
}

impl Block {
    pub fn new(e: &LaneEquations, stages: usize) -> Self {
        let channels = e.log.as_ref().map_or(0, |l| l.channels());
        Self {
            memory: e.rates.memory(),
            k: vec![[0.0; LANES]; stages * e.n],
            logged: vec![0.0; channels],
            slopes: vec![0.0; channels],
        }
    }
}

/// Advances the states `z` of a block over a span.
pub(super) fn advance(e: &LaneEquations, scheme: &Scheme, span: Span, z: &mut [Lane], block: &mut Block, isa: Isa) {
    isa.dispatch(Advance { e, scheme, span, z, block });
}

struct Advance<'a> {
    e: &'a LaneEquations,
    scheme: &'a Scheme,
    span: Span,
    z: &'a mut [Lane],
    block: &'a mut Block,
}

impl Kernel for Advance<'_> {
    #[inline(always)]
    fn run(self) {
        let Advance { e, scheme, span, z, block } = self;
        let h = (span.to - span.from) / span.steps as f64;
        // At the ends themselves rounding would look across a kink of the inputs.
        let margin = 4.0 * f64::EPSILON * span.from.abs().max(span.to.abs());
        let within = [span.from + margin, span.to - margin];
        for i in 0..span.steps {
            step(e, scheme, (span.from + h * i as f64, h), within, z, block);
        }
    }
}

#[inline(always)]
fn step(e: &LaneEquations, scheme: &Scheme, (t, h): (f64, f64), within: [f64; 2], z: &mut [Lane], block: &mut Block) {
    let n = e.n;
    for s in 0..scheme.stages {
        // States that no rate reads need no value between the steps.
        for i in &e.read {
            *block.memory.input(*i) = sum(&z[*i], &scheme.a[s], h, &block.k, n, *i);
        }
        let at = (t + scheme.c[s] * h).max(within[0]).min(within[1]);
        e.set_clock(at, &mut block.memory, &mut block.logged, &mut block.slopes);
        e.rates.run_here(&mut block.memory);
        for i in 0..n {
            block.k[s * n + i] = *e.rates.output(&block.memory, i);
        }
    }
    for (i, z) in z.iter_mut().enumerate().take(n) {
        *z = sum(z, &scheme.b, h, &block.k, n, i);
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
