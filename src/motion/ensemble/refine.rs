//! Runs with N and 2N steps, until they agree.

use super::equations::LaneEquations;
use super::steps::{Block, Instants, Lane, Running, Scheme, Span, advance};
use super::{Case, Ensemble, LANES, Plan, scheme};
use crate::error::Result;
use crate::formula::Memory;

/// How often the number of steps may double.
const DOUBLINGS: u32 = 12;
/// More steps than the estimate asks for, so that few cases need to be doubled.
const MARGIN: f64 = 1.1;

/// How often it does where the motion is undefined.
const TRIES: u32 = 4;

/// A block's states at the times of the rows after the start.
type Rows = Vec<Vec<Lane>>;

/// Memory and equations of a thread at work.
struct Work<'a> {
    e: &'a LaneEquations,
    scheme: Scheme,
    block: Block,
    readings: Memory<LANES>,
    /// By how often the number of steps has doubled.
    instants: Vec<Instants>,
}

impl Ensemble {
    /// The first number of steps that an order needs for most of the cases, and what it costs.
    pub(super) fn effort_of(&self, order: i32, e: &LaneEquations, cases: &[&[f64]]) -> Result<(f64, f64)> {
        let scheme = scheme(order);
        let mut work = Work::new(e, scheme);
        let z0 = self.begin(&mut work, cases)?;
        let (mut doublings, mut coarse) = (0, self.integrate(&mut work, &z0, (1.0, 0)));
        let needed = loop {
            let fine = self.integrate(&mut work, &z0, (1.0, doublings + 1));
            let errors: Vec<f64> = (0..cases.len()).map(|l| error(&coarse, &fine, l, order)).collect();
            let defined = errors.iter().filter(|e| !e.is_nan()).count();
            let good = errors.iter().filter(|e| **e <= self.tolerance).count();
            if doublings == DOUBLINGS || defined == 0 && doublings == TRIES {
                break 1.0;
            }
            if defined > 0 && 4 * good >= 3 * defined {
                let worst = errors.iter().copied().filter(|e| *e <= self.tolerance).fold(0.0, f64::max);
                let steps = f64::from(1u32 << doublings) * MARGIN;
                break (steps * (worst / self.tolerance).powf(1.0 / f64::from(order))).max(1.0);
            }
            (doublings, coarse) = (doublings + 1, fine);
        };
        let count: usize = self.spans(e).iter().map(|s| self.steps_in(s, (needed, 0))).sum();
        Ok((needed, (work.scheme.stages * count) as f64))
    }

    /// Integrates cases until each is as exact as asked for.
    pub(super) fn refined(&self, e: &LaneEquations, plan: &Plan, cases: &[&[f64]]) -> Result<Vec<Case>> {
        let mut work = Work::new(e, scheme(plan.order));
        let mut done: Vec<Option<Case>> = vec![None; cases.len()];
        // The first two runs of every case, then one more for those that need it, side by side again.
        let mut waiting: Vec<(usize, Option<Vec<f64>>)> = (0..cases.len()).map(|i| (i, None)).collect();
        for doubling in 0..=DOUBLINGS {
            let mut next = Vec::new();
            for group in waiting.chunks(LANES) {
                self.refine_block(&mut work, group, cases, (plan.steps, doubling), &mut done, &mut next)?;
            }
            waiting = next;
        }
        Ok(done.into_iter().flatten().collect())
    }

    /// One block: what is good goes to `done`, the rest to `next`.
    fn refine_block(
        &self,
        work: &mut Work,
        group: &[(usize, Option<Vec<f64>>)],
        cases: &[&[f64]],
        (steps, doublings): (f64, u32),
        done: &mut [Option<Case>],
        next: &mut Vec<(usize, Option<Vec<f64>>)>,
    ) -> Result<()> {
        let own: Vec<&[f64]> = group.iter().map(|(i, _)| cases[*i]).collect();
        let order = work.scheme.order;
        let z0 = self.begin(work, &own)?;
        let coarse = match group[0].1 {
            None => self.integrate(work, &z0, (steps, doublings)),
            Some(_) => gathered(group, self.times.len() - usize::from(self.shows_start()), work.e.n),
        };
        let fine = self.integrate(work, &z0, (steps, doublings + 1));
        let better = extrapolated(&coarse, &fine, order);
        let errors: Vec<f64> = (0..group.len()).map(|l| error(&coarse, &fine, l, order)).collect();
        let most = |e: f64| if e.is_nan() { TRIES } else { DOUBLINGS };
        let ready = |e: f64| e <= self.tolerance || doublings >= most(e);
        if errors.iter().any(|e| ready(*e)) {
            let rows = self.read_rows(work, &z0, &better);
            for (l, (i, _)) in group.iter().enumerate().filter(|(l, _)| ready(errors[*l])) {
                done[*i] = Some(self.case(&rows, l, errors[l]));
            }
        }
        for (l, (i, _)) in group.iter().enumerate().filter(|(l, _)| !ready(errors[*l])) {
            next.push((*i, Some(fine.iter().flatten().map(|lane| lane[l]).collect())));
        }
        Ok(())
    }

    /// Sets the parameters of a block and gives its start.
    fn begin(&self, work: &mut Work, cases: &[&[f64]]) -> Result<Vec<Lane>> {
        for l in 0..LANES {
            let case = cases[l.min(cases.len() - 1)];
            for (k, value) in case.iter().enumerate() {
                work.block.memory.input(work.e.n + k)[l] = *value;
                work.readings.input(work.e.n + k)[l] = *value;
            }
        }
        work.e.rates.begin(&mut work.block.memory, self.isa);
        work.e.readings.begin(&mut work.readings, self.isa);
        self.start(work.e, &mut work.readings, cases, self.isa)
    }

    /// The states at every row after the start.
    fn integrate(&self, work: &mut Work, z0: &[Lane], steps: (f64, u32)) -> Rows {
        let mut z = z0.to_vec();
        let mut rows = Vec::with_capacity(self.times.len());
        let cut = |span: Span| Span { steps: self.steps_in(&span, steps), ..span };
        let spans: Vec<Span> = self.spans(work.e).into_iter().map(cut).collect();
        let instants = &mut work.instants[steps.1 as usize];
        instants.rewind(work.e, &work.scheme, spans.iter().map(|s| s.steps).sum());
        for span in spans {
            let memory = Running { block: &mut work.block, instants };
            advance(work.e, &work.scheme, span, &mut z, memory, self.isa);
            if span.row {
                rows.push(z.clone());
            }
        }
        rows
    }

    /// Steps of a span when the whole run has so many: its share is rounded up before it is doubled.
    fn steps_in(&self, span: &Span, (steps, doublings): (f64, u32)) -> usize {
        let whole = self.times[self.times.len() - 1] - self.from;
        ((steps * (span.to - span.from) / whole).ceil().max(1.0) as usize) << doublings
    }

    /// What a logger sees, row by row: outputs of the readings and hidden states.
    fn read_rows(&self, work: &mut Work, z0: &[Lane], rows: &Rows) -> Vec<Lane> {
        let (e, shown) = (work.e, work.e.visible + 3);
        let start = self.shows_start().then_some(z0);
        let all = start.into_iter().chain(rows.iter().map(Vec::as_slice));
        let mut read = Vec::with_capacity(self.times.len() * (shown + e.n - e.visible));
        for (t, z) in self.times.iter().zip(all) {
            e.read(*t, z, &mut work.readings, self.isa);
            read.extend((0..shown).map(|k| *e.readings.output(&work.readings, k)));
            read.extend_from_slice(&z[e.visible..]);
        }
        read
    }

    fn case(&self, rows: &[Lane], l: usize, error: f64) -> Case {
        let width = rows.len() / self.times.len();
        let values: Vec<f64> = rows.iter().map(|lane| lane[l]).collect();
        match error.is_finite() && values.iter().all(|v| v.is_finite()) {
            true => Case { values, error: Some(error), converged: error <= self.tolerance, width },
            false => Case { values: vec![], error: None, converged: false, width },
        }
    }
}

impl<'a> Work<'a> {
    fn new(e: &'a LaneEquations, scheme: Scheme) -> Self {
        Self {
            e,
            block: Block::new(e, scheme.stages),
            scheme,
            readings: e.readings.memory(),
            instants: vec![Instants::default(); DOUBLINGS as usize + 2],
        }
    }
}

/// The runs before of the cases in a block.
fn gathered(group: &[(usize, Option<Vec<f64>>)], rows: usize, n: usize) -> Rows {
    let mut found = vec![vec![[0.0; LANES]; n]; rows];
    for (l, (_, before)) in group.iter().enumerate() {
        let before = before.iter().flatten();
        found.iter_mut().flatten().zip(before).for_each(|(lane, value)| lane[l] = *value);
    }
    found
}

/// The difference of two runs stands for a quarter as many times the error, lest steps that are still too long for their
/// order look better than they are.
const CAUTION: f64 = 4.0;

/// 2^order − 1
fn gain(order: i32) -> f64 {
    2f64.powi(order) - 1.0
}

/// The estimated error of a lane; NaN where a state is undefined.
fn error(coarse: &Rows, fine: &Rows, l: usize, order: i32) -> f64 {
    let mut worst = 0.0;
    for (a, b) in coarse.iter().flatten().zip(fine.iter().flatten()) {
        let e = CAUTION * (b[l] - a[l]).abs() / gain(order) / b[l].abs().max(1.0);
        if e.is_nan() {
            return f64::NAN;
        }
        worst = f64::max(worst, e);
    }
    worst
}

fn extrapolated(coarse: &Rows, fine: &Rows, order: i32) -> Rows {
    let mut better = fine.clone();
    for (b, a) in better.iter_mut().flatten().zip(coarse.iter().flatten()) {
        for l in 0..LANES {
            b[l] += (b[l] - a[l]) / gain(order);
        }
    }
    better
}
