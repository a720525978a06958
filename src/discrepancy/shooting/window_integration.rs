//! A model along the windows of a segment: side by side, though each as if it were alone.

use super::hidden_start::{HiddenStart, started};
use super::hidden_trajectory::HiddenTrajectory;
use super::row_sums::{NormalEquations, WindowKernel};
use crate::discrepancy::initial_state::hidden_states;
use crate::discrepancy::initial_state::slow_manifold::moved_along;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use crate::discrepancy::shooting::windows::{LANES, Segment, WindowStates};
use crate::model::Equations;
use crate::motion::{LaneStates, LaneStepper, StateSensitivity};
use rayon::prelude::*;
use std::ops::Range;

/// With many parameters, so many that the sums over rows would not fit near the processor.
const FEW_LANES: usize = 8;
const MANY: usize = 32;
/// With more parameters than these columns fill the vectors.
const WIDE: usize = 256;
/// Hidden states that differ by less, in units of a state or of one, are the same.
const UNDECIDED: f64 = 1e-7;

/// The model along the windows of a segment, one after another; `None` where it is undefined, or where `take` ends it.
pub fn each_window(
    equations: &Equations,
    p: &[f64],
    record: &Record,
    segment: &Segment,
    starts: &[Vec<f64>],
    mut take: impl FnMut(LinearisedWindow) -> Option<()>,
) -> Option<()> {
    let along = Along { equations, p, record, windows: &segment.windows, starts };
    let (first, asked) = hidden_states::asked(equations, p, record, segment.windows[0].start, &starts[0]);
    let mut asked = Some(asked);
    let mut take =
        |window: LinearisedWindow| take(LinearisedWindow { initial_state_dof: asked.take().unwrap_or(0.0), ..window });
    if p.len() > WIDE || segment.windows.len() == 1 {
        return along.side_by_side::<1>(0, &first, &[], &mut take).map(|_| ());
    }
    if equations.n() == equations.visible {
        return match p.len() > MANY {
            true => along.side_by_side::<FEW_LANES>(0, &first, &[], &mut take).map(|_| ()),
            false => along.side_by_side::<LANES>(0, &first, &[], &mut take).map(|_| ()),
        };
    }
    if equations.has_speeds() {
        return along.side_by_side::<1>(0, &first, &[], &mut take).map(|_| ());
    }
    // States that no sensor sees go from window to window. Where their motion does not ask for the pose they are
    // found ahead by themselves; windows that find them elsewhere at their end than they were taken to be go alone.
    let ahead = along.ahead(&first.z).unwrap_or_default();
    let (done, hidden) = along.side_by_side::<LANES>(0, &first, &ahead, &mut take)?;
    along.side_by_side::<1>(done, &hidden, &[], &mut take).map(|_| ())
}

/// Equations along the windows of a segment.
struct Along<'a> {
    equations: &'a Equations,
    p: &'a [f64],
    record: &'a Record,
    windows: &'a [Range<usize>],
    starts: &'a [Vec<f64>],
}

impl Along<'_> {
    /// The hidden states at the start of every window, where their motion does not ask for the pose.
    fn ahead(&self, first: &[f64]) -> Option<Vec<Vec<f64>>> {
        let Self { p, record, windows, starts, .. } = *self;
        HiddenTrajectory { carried: self.equations.carried()?, p, record, windows, starts }.from(first)
    }

    /// Windows from one on, L at a time, the hidden states carried from window to window; where these go side by side it is
    /// known ahead where each begins. Ends before a window that does not begin where the one before it ended; says which, and
    /// what was found there.
    fn side_by_side<const L: usize>(
        &self,
        from: usize,
        hidden: &StateSensitivity,
        ahead: &[Vec<f64>],
        take: &mut impl FnMut(LinearisedWindow) -> Option<()>,
    ) -> Option<(usize, StateSensitivity)> {
        let (record, visible) = (self.record, self.equations.visible);
        let mut last = hidden.clone();
        let h = self.equations.n() - visible;
        if from == self.windows.len() || L > 1 && ahead.is_empty() && h > 0 {
            return Some((from, last));
        }
        let mut k = from;
        let starts = if L > 1 { h } else { 0 };
        let mut stepper = LaneStepper::new(self.equations, &record.signals, [self.p; L]).with_hidden_starts(starts);
        let mut sums = NormalEquations::new(stepper.columns() - starts, starts, record);
        for windows in self.windows[from..].chunks(L) {
            let next = |l: usize| self.starts.get(k + l + 1).filter(|_| l < windows.len());
            let at = |l: usize| k + l.min(windows.len() - 1);
            let mut arcs = match L {
                1 => carried_on(self.equations, stepper.columns(), &self.starts[k], &last),
                _ => started(stepper.columns(), |l| &self.starts[at(l)][..visible], |l| ahead.get(at(l))),
            };
            let rows = std::array::from_fn(|l| windows.get(l).cloned().unwrap_or(0..0));
            let goes_on = std::array::from_fn(|l| next(l).is_some());
            sums.clear();
            let isa = stepper.isa();
            let (stepper, arcs, sums) = (&mut stepper, &mut arcs, &mut sums);
            isa.dispatch(WindowKernel { stepper, record, rows: &rows, goes_on: &goes_on, arcs, sums });
            for (l, rows) in rows.iter().enumerate().take(windows.len()) {
                let start = if L > 1 { HiddenStart::of(&last, visible) } else { HiddenStart::none() };
                let arc = start.in_arc(arcs.one(l));
                take(sums.linear(l, record, rows, (&arc, &start), next(l))?)?;
                last = match (self.equations.has_speeds(), next(l)) {
                    (true, Some(begin)) => {
                        let u = stepper.inputs(&[record.time[rows.end]; L]);
                        moved_along(self.equations, self.p, &arc, begin, &u.iter().map(|u| u[l]).collect::<Vec<_>>())
                    }
                    _ => arc.hidden(visible),
                };
                if ahead.get(k + l + 1).is_some_and(|taken| !are_near(taken, &last.z)) {
                    return Some((k + l + 1, last));
                }
            }
            k += windows.len();
        }
        Some((k, last))
    }
}

/// Whether hidden states are the same but for what the steps of an integration leave undecided.
fn are_near(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= UNDECIDED * (1.0 + b.abs()))
}

/// A state that begins at a pose, the hidden states carried on with their sensitivities.
fn carried_on<const L: usize>(
    equations: &Equations,
    k: usize,
    begin: &[f64],
    hidden: &StateSensitivity,
) -> LaneStates<L> {
    let (visible, first) = (equations.visible, equations.first_of_hidden());
    let z: Vec<[f64; L]> = begin[..visible].iter().chain(&hidden.z).map(|z| [*z; L]).collect();
    let mut s = vec![[0.0; L]; z.len() * k];
    (0..visible).for_each(|i| s[i * k + i] = [1.0; L]);
    for i in visible..z.len() {
        (first..k).for_each(|c| s[i * k + c] = [hidden.s[i * k + c]; L]);
    }
    LaneStates { z, s }
}

/// The model along all windows; `None` where it is undefined.
pub fn linearise(
    equations: &Equations,
    p: &[f64],
    records: &[Record],
    plan: &[Segment],
    starts: &WindowStates,
) -> Option<Vec<Vec<LinearisedWindow>>> {
    let along = |(segment, starts): (&Segment, &Vec<Vec<f64>>)| {
        let mut found = Vec::with_capacity(segment.windows.len());
        each_window(equations, p, &records[segment.record], segment, starts, |window| {
            found.push(window);
            Some(())
        })?;
        Some(found)
    };
    plan.par_iter().zip(starts).map(along).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::record::row_weights::RowWeights;
    use crate::discrepancy::shooting::windows;
    use crate::effects;
    use crate::effects::Applied;
    use crate::model::Model;
    use crate::model::observation::{HEADING, POSITION};
    use crate::motion::Timing;
    use nalgebra::DMatrix;

    /// A run of uneven rows with some that are missing.
    fn record() -> Record {
        let rows = (0..1100).filter(|i| i % 97 != 5);
        let time: Vec<f64> = rows.map(|i| 0.04 * f64::from(i) + 0.003 * f64::from(i % 3)).collect();
        let of = |f: &dyn Fn(f64) -> f64| time.iter().map(|t| f(*t)).collect::<Vec<f64>>();
        let inputs = [of(&|t| 3.0 + (0.7 * t).sin()), of(&|t| 0.6 * (0.4 * t).cos())];
        let columns = vec![of(&|t| 1.5 * t), of(&|t| (0.3 * t).sin()), of(&|t| 1.5 * (0.4 * t).sin())];
        Record::new("run", time, columns, true, &inputs, Timing::Sample)
    }

    fn model(effect: &str, values: &[f64]) -> Model {
        let effect = Applied::new(effects::named(effect).unwrap(), None, values.to_vec()).freed();
        Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_effect(effect)
    }

    /// The windows alone and together, and how many went side by side.
    fn both(model: &Model) -> ([Vec<LinearisedWindow>; 2], usize) {
        let record = record();
        let segment = windows::plan(std::slice::from_ref(&record)).remove(0);
        let equations = model.free_equations().unwrap();
        let p = model.free_values();
        let starts: Vec<Vec<f64>> = segment.windows.iter().map(|w| record.measured(w.start)).collect();
        let along = Along { equations: &equations, p: &p, record: &record, windows: &segment.windows, starts: &starts };
        let first = hidden_states::before(&equations, &p, &record, segment.windows[0].start, &starts[0]);
        let mut alone = vec![];
        let listed = |found: &mut Vec<LinearisedWindow>, w: LinearisedWindow| {
            found.push(w);
            Some(())
        };
        along.side_by_side::<1>(0, &first, &[], &mut |w| listed(&mut alone, w)).unwrap();
        let mut together = vec![];
        each_window(&equations, &p, &record, &segment, &starts, |w| listed(&mut together, w)).unwrap();
        let ahead = if first.z.is_empty() { vec![] } else { along.ahead(&first.z).unwrap() };
        let (done, _) = along.side_by_side::<LANES>(0, &first, &ahead, &mut |_| Some(())).unwrap();
        ([alone, together], done)
    }

    /// How far the numbers of windows are apart, in units of the largest of each matrix.
    fn apart(a: &LinearisedWindow, b: &LinearisedWindow) -> f64 {
        let matrices = |w: &LinearisedWindow| [w.gram.clone(), w.back.iter().cloned().collect()].concat();
        assert_eq!((a.count.clone(), a.duration, matrices(a).len()), (b.count.clone(), b.duration, matrices(b).len()));
        let mismatch = a.mismatch.iter().zip(&b.mismatch).map(|(a, b)| (a - b).abs());
        let most = |(a, b): (&DMatrix<f64>, &DMatrix<f64>)| (a - b).amax() / b.amax().max(1e-300);
        matrices(a).iter().zip(&matrices(b)).map(most).chain(mismatch).fold(0.0, f64::max)
    }

    #[test]
    fn windows_side_by_side_are_those_alone() {
        let slow = model("cornering-creep", &[0.3]);
        let stiff = model("traction-creep", &[2e-3]);
        let built_up = model("relaxation-length", &[0.4, 0.1]);
        for model in [model("rotation-creep", &[0.05]), slow, stiff, built_up, model("input-delay", &[0.07])] {
            let ([alone, together], done) = both(&model);
            assert!(alone.len() > 40 && done == alone.len() && together.len() == alone.len());
            let apart = alone.iter().zip(&together).map(|(a, b)| apart(a, b)).fold(0.0, f64::max);
            // Without hidden states to the last bit.
            let has_hidden = model.states().len() > 3;
            let bound = if has_hidden { 1e-8 } else { 0.0 };
            assert!(apart <= bound, "{apart}");
        }
    }

    /// A row of weight w counts w² times: one and two by turns, and two and one, make five times the plain sums.
    #[test]
    fn rows_count_by_the_squares_of_their_weights() {
        let (plain, model) = (record(), model("rotation-creep", &[0.05]));
        let (equations, p) = (model.free_equations().unwrap(), model.free_values());
        let summed = |weights: RowWeights| {
            let records = [Record { weights, ..plain.clone() }];
            let plan = windows::plan(&records);
            let starts = plan.iter().map(|s| s.windows.iter().map(|w| plain.measured(w.start)).collect()).collect();
            linearise(&equations, &p, &records, &plan, &starts).unwrap().remove(0).remove(3).gram
        };
        let by_turns = |even: bool| {
            let weight = |i: usize| if i.is_multiple_of(2) == even { 2.0 } else { 1.0 };
            let of_place = Some((0..plain.time.len()).map(weight).collect::<Vec<f64>>());
            summed(RowWeights::new(vec![of_place.clone(), of_place, None]))
        };
        let (alike, [a, b]) = (summed(RowWeights::default()), [true, false].map(by_turns));
        assert!((&a[POSITION] + &b[POSITION] - 5.0 * &alike[POSITION]).norm() < 1e-12 * alike[POSITION].norm());
        assert!(a[POSITION] != b[POSITION] && a[HEADING] == alike[HEADING] && alike[HEADING].norm() > 0.0);
    }

    /// Hidden states that were taken to be elsewhere are noticed.
    #[test]
    fn windows_that_begin_elsewhere_go_alone() {
        let (record, model) = (record(), model("cornering-creep", &[0.3]));
        let segment = windows::plan(std::slice::from_ref(&record)).remove(0);
        let (equations, p) = (model.free_equations().unwrap(), model.free_values());
        let starts: Vec<Vec<f64>> = segment.windows.iter().map(|w| record.measured(w.start)).collect();
        let along = Along { equations: &equations, p: &p, record: &record, windows: &segment.windows, starts: &starts };
        let first = hidden_states::before(&equations, &p, &record, segment.windows[0].start, &starts[0]);
        let mut ahead = along.ahead(&first.z).unwrap();
        let honest = ahead[7][0];
        ahead[7][0] += 1e-6;
        let (done, hidden) = along.side_by_side::<LANES>(0, &first, &ahead, &mut |_| Some(())).unwrap();
        assert!(done == 7 && (hidden.z[0] - honest).abs() < 1e-9);
    }
}
