//! Richardson extrapolation: runs with N and 2N steps, doubled until their difference is small enough.

use super::case::Case;
use super::equations::LaneEquations;
use super::lanes::{LANES, Lane};
use super::model_ensemble::Ensemble;
use super::plan::Plan;
use super::rounding::{Estimate, Floor};
use super::steps::{Block, Instants, Running, Scheme, Span, States, advance};
use crate::error::Result;
use crate::formula::Memory;

/// How often the number of steps may double.
const MAX_DOUBLINGS: u32 = 12;
/// How often it may, divided among the spans, where the first number is looked for: runs of an hour need tens of thousands.
const PILOT_DOUBLINGS: u32 = 16;
/// The most steps that a number which does not suffice may grow to: a few minutes for a block of cases.
const MAX_STEPS: usize = 1 << 24;
/// More steps than the estimate asks for, so that few cases need to be doubled.
const STEP_MARGIN: f64 = 1.1;

/// How often it does where the motion is undefined.
const UNDEFINED_DOUBLINGS: u32 = 4;

/// A block's states at the times of the rows after the start.
type Rows = Vec<Vec<Lane>>;

/// A case that is not ready: its number, the rows of its last run, and the truncation error they were found to have.
struct Waiting {
    case: usize,
    before: Option<(Vec<f64>, f64)>,
}

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
    /// The first number of steps that an order needs for most of the cases, and what it costs; without bound where the order
    /// does not get there, or not for less than `most`.
    pub(crate) fn effort_of(&self, order: i32, e: &LaneEquations, cases: &[&[f64]], most: f64) -> Result<(f64, f64)> {
        let mut work = Work::new(e, Scheme::of_order(order));
        let (stages, spans) = (work.scheme.stages, self.spans(e));
        let cost = |steps| (stages * spans.iter().map(|s| self.steps_in(s, steps)).sum::<usize>()) as f64;
        let shared = spans.len().checked_ilog2().unwrap_or(0);
        let last = PILOT_DOUBLINGS.saturating_sub(shared).max(MAX_DOUBLINGS);
        let z0 = self.begin(&mut work, cases)?;
        let first = self.stable_steps(e, &mut work.readings, &z0, cases);
        let last = last.min(self.most_doublings(e, first));
        let (mut doublings, (mut coarse, _)) = (0, self.integrate(&mut work, &z0, (first, 0)));
        let mut before: Vec<Option<f64>> = vec![None; cases.len()];
        let needed = loop {
            let (fine, floor) = self.integrate(&mut work, &z0, (first, doublings + 1));
            let found = estimates([&coarse, &fine], &floor, cases.len(), order);
            let defined = found.iter().filter(|e| !e.error.is_nan()).count();
            let good = found.iter().filter(|e| e.error <= self.tolerance);
            let enough = found.iter().zip(&before).filter(|(e, b)| e.error <= self.tolerance || e.is_stuck(**b));
            if defined > 0 && 4 * enough.count() >= 3 * defined {
                let worst = good.clone().map(|e| e.truncation).fold(0.0, f64::max);
                // Where rounding alone is more than the error asked for, this number is as good as any larger one.
                let share = if good.count() > 0 { worst / self.tolerance } else { 1.0 };
                let steps = first * f64::from(1u32 << doublings) * STEP_MARGIN;
                break (steps * share.powf(1.0 / f64::from(order))).max(first);
            }
            before = found.iter().map(|e| Some(e.truncation)).collect();
            if defined == 0 && doublings == UNDEFINED_DOUBLINGS {
                break first;
            }
            if doublings == last || cost((first, doublings)) >= most {
                return Ok((first, f64::INFINITY));
            }
            (doublings, coarse) = (doublings + 1, fine);
        };
        Ok((needed, cost((needed, 0))))
    }

    /// Integrates cases until each is as exact as asked for.
    pub(crate) fn refined(&self, e: &LaneEquations, plan: &Plan, cases: &[&[f64]]) -> Result<Vec<Case>> {
        let mut work = Work::new(e, Scheme::of_order(plan.order));
        let mut done: Vec<Option<Case>> = vec![None; cases.len()];
        // The first two runs of every case, then one more for those that need it, side by side again.
        let mut waiting: Vec<Waiting> = (0..cases.len()).map(|case| Waiting { case, before: None }).collect();
        let last = MAX_DOUBLINGS.min(self.most_doublings(e, plan.steps));
        for doubling in 0..=last {
            let mut next = Vec::new();
            for group in waiting.chunks(LANES) {
                self.refine_block(&mut work, group, cases, (plan.steps, doubling, last), &mut done, &mut next)?;
            }
            waiting = next;
        }
        Ok(done.into_iter().flatten().collect())
    }

    /// One block: what is good goes to `done`, the rest to `next`.
    fn refine_block(
        &self,
        work: &mut Work,
        group: &[Waiting],
        cases: &[&[f64]],
        (steps, doublings, last): (f64, u32, u32),
        done: &mut [Option<Case>],
        next: &mut Vec<Waiting>,
    ) -> Result<()> {
        let own: Vec<&[f64]> = group.iter().map(|w| cases[w.case]).collect();
        let order = work.scheme.order;
        let z0 = self.begin(work, &own)?;
        let coarse = match group[0].before {
            None => self.integrate(work, &z0, (steps, doublings)).0,
            Some(_) => gathered(group, self.times.len() - usize::from(self.shows_start()), work.e.n),
        };
        let (fine, floor) = self.integrate(work, &z0, (steps, doublings + 1));
        let better = extrapolated(&coarse, &fine, order);
        let found = estimates([&coarse, &fine], &floor, group.len(), order);
        let ready = |l: usize| {
            let (of, most) = (&found[l], if found[l].error.is_nan() { last.min(UNDEFINED_DOUBLINGS) } else { last });
            of.error <= self.tolerance || doublings >= most || of.is_stuck(group[l].before.as_ref().map(|(_, t)| *t))
        };
        if (0..group.len()).any(ready) {
            let rows = self.read_rows(work, &z0, &better);
            for (l, w) in group.iter().enumerate().filter(|(l, _)| ready(*l)) {
                done[w.case] = Some(self.case(&rows, l, found[l].error));
            }
        }
        for (l, w) in group.iter().enumerate().filter(|(l, _)| !ready(*l)) {
            let rows = fine.iter().flatten().map(|lane| lane[l]).collect();
            next.push(Waiting { case: w.case, before: Some((rows, found[l].truncation)) });
        }
        Ok(())
    }

    /// How often a first number of steps may double before there are too many of them.
    fn most_doublings(&self, e: &LaneEquations, steps: f64) -> u32 {
        let first: usize = self.spans(e).iter().map(|s| self.steps_in(s, (steps, 0))).sum();
        (MAX_STEPS / first.max(1)).checked_ilog2().unwrap_or(0)
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

    /// The states at every row after the start, and what rounding leaves of them.
    fn integrate(&self, work: &mut Work, z0: &[Lane], steps: (f64, u32)) -> (Rows, Floor) {
        let (mut states, mut floor) = (States::new(z0), Floor::new());
        let mut rows = Vec::with_capacity(self.times.len());
        let cut = |span: Span| Span { steps: self.steps_in(&span, steps), ..span };
        let spans: Vec<Span> = self.spans(work.e).into_iter().map(cut).collect();
        let instants = &mut work.instants[steps.1 as usize];
        instants.rewind(work.e, &work.scheme, spans.iter().map(|s| s.steps).sum());
        for span in spans {
            let memory = Running { block: &mut work.block, instants };
            advance(work.e, &work.scheme, span, &mut states, memory, self.isa);
            if span.row {
                floor.see(&states, work.e.visible);
                rows.push(states.z.clone());
            }
        }
        (rows, floor)
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
            instants: vec![Instants::default(); PILOT_DOUBLINGS as usize + 2],
        }
    }
}

/// The runs before of the cases in a block.
fn gathered(group: &[Waiting], rows: usize, n: usize) -> Rows {
    let mut found = vec![vec![[0.0; LANES]; n]; rows];
    for (l, w) in group.iter().enumerate() {
        let before = w.before.iter().flat_map(|(rows, _)| rows);
        found.iter_mut().flatten().zip(before).for_each(|(lane, value)| lane[l] = *value);
    }
    found
}

/// The difference of two runs stands for a quarter as many times the error, lest steps that are still too long for their
/// order look better than they are.
const ERROR_FACTOR: f64 = 4.0;

/// 2^order − 1
fn gain(order: i32) -> f64 {
    2f64.powi(order) - 1.0
}

/// The estimated error of a lane without rounding; NaN where a state is undefined.
fn error(coarse: &Rows, fine: &Rows, l: usize, order: i32) -> f64 {
    let mut worst = 0.0;
    for (a, b) in coarse.iter().flatten().zip(fine.iter().flatten()) {
        let e = ERROR_FACTOR * (b[l] - a[l]).abs() / gain(order) / b[l].abs().max(1.0);
        if e.is_nan() {
            return f64::NAN;
        }
        worst = f64::max(worst, e);
    }
    worst
}

/// The errors of the first lanes, by two runs of which the second has twice the steps of the first.
fn estimates([coarse, fine]: [&Rows; 2], floor: &Floor, lanes: usize, order: i32) -> Vec<Estimate> {
    (0..lanes).map(|l| Estimate::new(error(coarse, fine, l, order), floor.of(l))).collect()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Expr;
    use crate::model::Model;
    use crate::motion::ensemble::{EnsembleInputs, Varied};

    fn wheels(from: f64, times: &[f64], tolerance: f64) -> Ensemble {
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        let formulas = ["2 + sin(3*t)", "cos(2*t)"].map(|f| Expr::parse(f).unwrap()).to_vec();
        let inputs = EnsembleInputs { formulas, ..EnsembleInputs::default() };
        let varied = [Varied::Model("wheel_radius".into())];
        Ensemble::new(&model, &inputs, &varied, &[0.0; 3], from, times, tolerance).unwrap()
    }

    /// The first number of steps is what the worst case needs, less a margin of a tenth, and the cost follows it. Cases that
    /// need fewer steps do not decide while they are fewer than three in four.
    #[test]
    fn the_first_number_of_steps_is_what_is_needed() {
        let cases: [&[f64]; 4] = [&[1e-4], &[1e-4], &[1.0], &[1.0]];
        for (order, tolerance) in [(4, 1e-10), (4, 1e-8), (8, 1e-13)] {
            let wheels = wheels(1.0, &[6.0], tolerance);
            let (steps, cost) = wheels.effort_of(order, &wheels.equations, &cases, f64::INFINITY).unwrap();
            let mut work = Work::new(&wheels.equations, Scheme::of_order(order));
            let z0 = wheels.begin(&mut work, &cases).unwrap();
            let [coarse, fine] = [0, 1].map(|doublings| wheels.integrate(&mut work, &z0, (steps, doublings)).0);
            let worst = (0..4).map(|l| error(&coarse, &fine, l, order)).fold(0.0, f64::max);
            let taken = steps.ceil();
            let (margin, found) = ((steps / taken / STEP_MARGIN).powi(order), worst / tolerance);
            // What rounding leaves of the last digits of order 8 is more than a twentieth.
            let within = if order == 8 { 0.5 } else { 0.05 };
            assert!((found / margin - 1.0).abs() < within, "order {order}, {steps} steps: {found} and not {margin}");
            assert_eq!(cost, work.scheme.stages as f64 * taken, "order {order}");
            // Where another order is cheaper this one is given up, and not where it is dearer.
            let given = |most: f64| wheels.effort_of(order, &wheels.equations, &cases, most).unwrap();
            assert_eq!([given(cost / 4.0), given(2.0 * cost)], [(1.0, f64::INFINITY), (steps, cost)]);
        }
    }

    #[test]
    fn what_is_undefined_needs_one_step() {
        let wheels = wheels(0.0, &[1.0], 1e-10);
        let (steps, _) = wheels.effort_of(4, &wheels.equations, &[&[f64::NAN]], f64::INFINITY).unwrap();
        assert_eq!(steps, 1.0);
    }

    /// Every span has its share of the steps, rounded up before it is doubled.
    #[test]
    fn spans_share_the_steps() {
        let wheels = wheels(1.0, &[2.0, 5.0], 1e-10);
        let spans = wheels.spans(&wheels.equations);
        let count = |steps, doublings| spans.iter().map(|s| wheels.steps_in(s, (steps, doublings))).collect::<Vec<_>>();
        assert_eq!(spans.iter().map(|s| (s.from, s.to)).collect::<Vec<_>>(), [(1.0, 2.0), (2.0, 5.0)]);
        assert_eq!([count(10.0, 0), count(10.0, 1), count(0.1, 2)], [[3, 8], [6, 16], [4, 4]]);
    }

    /// Richardson's way: the difference over 2^q − 1 is added, and four times as much is the error, relative above one.
    #[test]
    fn two_runs_give_a_better_one_and_its_error() {
        let lanes = |values: [f64; 2]| vec![vec![values.map(|v| [v; LANES])[0]], vec![[values[1]; LANES]]];
        let (coarse, mut fine) = (lanes([0.5, 100.0]), lanes([0.8, 102.0]));
        for (order, gained) in [(4, 15.0), (8, 255.0)] {
            assert_eq!(gain(order), gained);
            assert!((error(&coarse, &fine, 3, order) - 4.0 * 0.3 / gained).abs() < 1e-15);
            let better = extrapolated(&coarse, &fine, order);
            let [a, b] = [better[0][0][7], better[1][0][7]];
            assert!((a - 0.8 - 0.3 / gained).abs() < 1e-15 && (b - 102.0 - 2.0 / gained).abs() < 1e-12, "{a} {b}");
        }
        fine[0][0][3] = 0.5;
        assert!((error(&coarse, &fine, 3, 4) - 4.0 * 2.0 / 15.0 / 102.0).abs() < 1e-15);
        fine[1][0][3] = f64::NAN;
        assert!(error(&coarse, &fine, 3, 4).is_nan() && !error(&coarse, &fine, 2, 4).is_nan());
    }

    /// A case has all its numbers or none.
    #[test]
    fn a_case_is_defined_all_the_way_or_not() {
        let wheels = wheels(0.0, &[1.0, 2.0], 1e-10);
        let rows = |last: f64| vec![[1.0; LANES], [2.0; LANES], [3.0; LANES], [last; LANES]];
        let good = wheels.case(&rows(4.0), 1, 1e-10);
        assert_eq!((good.row(1), good.error, good.converged), (&[3.0, 4.0][..], Some(1e-10), true));
        assert!(!wheels.case(&rows(4.0), 1, 2e-10).converged);
        for (last, error) in [(f64::NAN, 1e-12), (f64::INFINITY, 1e-12), (4.0, f64::NAN), (4.0, f64::INFINITY)] {
            let bad = wheels.case(&rows(last), 1, error);
            assert!(!bad.is_defined() && !bad.converged && bad.values.is_empty(), "{last} {error}");
        }
    }
}
