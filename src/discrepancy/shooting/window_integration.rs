//! A model along the windows of a segment: side by side, though each as if it were alone.

use super::row_sums::{NormalEquations, WindowKernel};
use crate::discrepancy::initial_state::hidden_states;
use crate::discrepancy::initial_state::slow_manifold::moved_along;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use crate::discrepancy::shooting::windows::{Segment, WindowStates};
use crate::model::Equations;
use crate::motion::{LaneStates, LaneStepper, StateSensitivity};
use rayon::prelude::*;
use std::ops::Range;

/// Windows that are integrated side by side: two vectors of AVX-512, so that one waits while the other works.
const LANES: usize = 16;
/// With many parameters, so many that the sums over rows would not fit near the processor.
const FEW_LANES: usize = 8;
const MANY: usize = 32;
/// With more parameters than these columns fill the vectors.
const WIDE: usize = 256;

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
    let first = hidden_states::before(equations, p, record, segment.windows[0].start, &starts[0]);
    if p.len() > WIDE || segment.windows.len() == 1 {
        return along.side_by_side::<1>(0, &[first], &mut take).map(|_| ());
    }
    if equations.n() == equations.visible {
        return match p.len() > MANY {
            true => along.side_by_side::<FEW_LANES>(0, &[], &mut take).map(|_| ()),
            false => along.side_by_side::<LANES>(0, &[], &mut take).map(|_| ()),
        };
    }
    if equations.has_speeds() {
        return along.side_by_side::<1>(0, &[first], &mut take).map(|_| ());
    }
    // States that no sensor sees go from window to window. Where their motion does not ask for the pose they are
    // carried ahead by themselves; windows that find them elsewhere at their end than they were taken to be go alone.
    let ahead = along.ahead(&first).unwrap_or_default();
    let (done, hidden) = along.side_by_side::<LANES>(0, &ahead, &mut take)?;
    along.side_by_side::<1>(done, &[hidden.unwrap_or(first)], &mut take).map(|_| ())
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
    /// The hidden states at the start of every window, without what the pose does meanwhile.
    ///
    /// States that forget within a window where they began, bit for bit, come to the same end from any start: all
    /// windows are tried side by side, and once more from the ends found. What is the same twice is what one window
    /// after another would give; the rest goes one after another.
    fn ahead(&self, first: &StateSensitivity) -> Option<Vec<StateSensitivity>> {
        let carried = self.equations.carried()?;
        let mut found = vec![first.clone()];
        if self.forgets(carried, first) {
            let once = self.ends(carried, &vec![first.clone(); self.windows.len()]);
            found = self.ends(carried, &once);
            let same = |k: &usize| once[*k].is_same(&found[*k], carried.visible);
            let known = (0..found.len()).find(|k| !same(k)).unwrap_or(found.len() - 1);
            found.truncate(known + 1);
        }
        let mut stepper = LaneStepper::new(carried, &self.record.signals, [self.p]);
        for k in found.len() - 1..self.windows.len() - 1 {
            let [end] = self.end_of(carried, &mut stepper, [k], [&found[k]]);
            found.push(end);
        }
        Some(found)
    }

    /// Whether the hidden states end the first window the same wherever they begin it.
    fn forgets(&self, carried: &Equations, first: &StateSensitivity) -> bool {
        let elsewhere = StateSensitivity {
            z: first.z.iter().map(|z| z + 1.0).collect(),
            s: first.s.iter().map(|s| s + 1.0).collect(),
        };
        let mut stepper = LaneStepper::new(carried, &self.record.signals, [self.p; 2]);
        let [a, b] = self.end_of(carried, &mut stepper, [0; 2], [first, &elsewhere]);
        a.is_same(&b, carried.visible)
    }

    /// The first start, and where every window but the last ends, side by side.
    fn ends(&self, carried: &Equations, starts: &[StateSensitivity]) -> Vec<StateSensitivity> {
        let mut stepper = LaneStepper::new(carried, &self.record.signals, [self.p; LANES]);
        let mut found = vec![starts[0].clone()];
        let last = self.windows.len() - 2;
        while found.len() < starts.len() {
            let k: [usize; LANES] = std::array::from_fn(|l| (found.len() - 1 + l).min(last));
            let ends = self.end_of(carried, &mut stepper, k, k.map(|k| &starts[k]));
            let more = starts.len() - found.len();
            found.extend(ends.into_iter().take(more));
        }
        found
    }

    /// The hidden states at the ends of some windows.
    fn end_of<const L: usize>(
        &self,
        carried: &Equations,
        stepper: &mut LaneStepper<L>,
        windows: [usize; L],
        starts: [&StateSensitivity; L],
    ) -> [StateSensitivity; L] {
        let mut arcs = started(carried, stepper.columns(), |l| &self.starts[windows[l]], |l| starts[l]);
        stepper.through(&mut arcs, &self.record.time, &windows.map(|k| self.windows[k].clone()));
        std::array::from_fn(|l| arcs.one(l).hidden(carried.visible))
    }

    /// Windows from one on, L at a time, with their hidden states: one for each window, or the first to be carried on.
    /// Ends before a window that does not begin where the one before it ended; says which, and what was found there.
    fn side_by_side<const L: usize>(
        &self,
        from: usize,
        hidden: &[StateSensitivity],
        take: &mut impl FnMut(LinearisedWindow) -> Option<()>,
    ) -> Option<(usize, Option<StateSensitivity>)> {
        let (record, visible) = (self.record, self.equations.visible);
        let mut k = from;
        if k == self.windows.len() || L > 1 && hidden.is_empty() && self.equations.n() > visible {
            return Some((k, None));
        }
        let none = StateSensitivity::default();
        let mut last = hidden.first().cloned();
        let mut stepper = LaneStepper::new(self.equations, &record.signals, [self.p; L]);
        let mut sums = NormalEquations::new(stepper.columns(), record);
        for windows in self.windows[from..].chunks(L) {
            let next = |l: usize| self.starts.get(k + l + 1).filter(|_| l < windows.len());
            let at = |l: usize| k + l.min(windows.len() - 1);
            let carried = |l: usize| if L == 1 { last.as_ref() } else { hidden.get(at(l)) }.unwrap_or(&none);
            let mut arcs = started(self.equations, stepper.columns(), |l| &self.starts[at(l)], carried);
            let rows = std::array::from_fn(|l| windows.get(l).cloned().unwrap_or(0..0));
            let goes_on = std::array::from_fn(|l| next(l).is_some());
            sums.clear();
            let isa = stepper.isa();
            let (stepper, arcs, sums) = (&mut stepper, &mut arcs, &mut sums);
            isa.dispatch(WindowKernel { stepper, record, rows: &rows, goes_on: &goes_on, arcs, sums });
            for (l, rows) in rows.iter().enumerate().take(windows.len()) {
                let arc = arcs.one(l);
                take(sums.linear(l, record, rows, &arc, next(l))?)?;
                let end = match (self.equations.has_speeds(), next(l)) {
                    (true, Some(begin)) => {
                        let u = stepper.inputs(&[record.time[rows.end]; L]);
                        moved_along(self.equations, self.p, &arc, begin, &u.iter().map(|u| u[l]).collect::<Vec<_>>())
                    }
                    _ => arc.hidden(visible),
                };
                if L > 1 && hidden.get(k + l + 1).is_some_and(|taken| !taken.is_same(&end, visible)) {
                    return Some((k + l + 1, Some(end)));
                }
                last = Some(end);
            }
            k += windows.len();
        }
        Some((k, None))
    }
}

/// States that begin at poses, with the hidden states as they were carried there.
fn started<'z, const L: usize>(
    equations: &Equations,
    k: usize,
    begin: impl Fn(usize) -> &'z Vec<f64>,
    hidden: impl Fn(usize) -> &'z StateSensitivity,
) -> LaneStates<L> {
    let (visible, first) = (equations.visible, equations.first_of_hidden());
    let mut z: Vec<[f64; L]> = (0..visible).map(|i| std::array::from_fn(|l| begin(l)[i])).collect();
    z.extend((0..hidden(0).z.len()).map(|i| std::array::from_fn(|l| hidden(l).z[i])));
    let mut s = vec![[0.0; L]; z.len() * k];
    (0..visible).for_each(|i| s[i * k + i] = [1.0; L]);
    for i in visible..z.len() {
        (first..k).for_each(|c| s[i * k + c] = std::array::from_fn(|l| hidden(l).s[i * k + c]));
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

    /// All numbers of the windows, to their last bit, and how many went side by side.
    fn both(model: &Model) -> ([Vec<String>; 2], usize, usize) {
        let record = record();
        let segment = windows::plan(std::slice::from_ref(&record)).remove(0);
        let equations = model.free_equations().unwrap();
        let p = model.free_values();
        let starts: Vec<Vec<f64>> = segment.windows.iter().map(|w| record.measured(w.start)).collect();
        let along = Along { equations: &equations, p: &p, record: &record, windows: &segment.windows, starts: &starts };
        let first = hidden_states::before(&equations, &p, &record, segment.windows[0].start, &starts[0]);
        let mut alone = vec![];
        let listed = |found: &mut Vec<String>, w: LinearisedWindow| {
            found.push(format!("{w:?}"));
            Some(())
        };
        along.side_by_side::<1>(0, std::slice::from_ref(&first), &mut |w| listed(&mut alone, w)).unwrap();
        let mut together = vec![];
        each_window(&equations, &p, &record, &segment, &starts, |w| listed(&mut together, w)).unwrap();
        let ahead = if first.z.is_empty() { vec![] } else { along.ahead(&first).unwrap() };
        let (done, _) = along.side_by_side::<LANES>(0, &ahead, &mut |_| Some(())).unwrap();
        ([alone, together], done, segment.windows.len())
    }

    #[test]
    fn windows_side_by_side_are_those_alone() {
        let slow = model("cornering-creep", &[0.3]);
        let stiff = model("traction-creep", &[2e-3]);
        let built_up = model("relaxation-length", &[0.4, 0.1]);
        for model in [model("rotation-creep", &[0.05]), slow, stiff, built_up, model("input-delay", &[0.07])] {
            let ([alone, together], done, windows) = both(&model);
            assert!(alone == together && windows > 40);
            assert_eq!(done, windows);
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
        let mut ahead = along.ahead(&first).unwrap();
        ahead[7].s[3 * 4 + 3] += 1e-12;
        let (done, hidden) = along.side_by_side::<LANES>(0, &ahead, &mut |_| Some(())).unwrap();
        assert!(done == 7 && hidden.is_some());
    }
}
