//! A run without the rows that hold nothing of their own: poses filled forward, repeated rows, spikes of an input.

use super::dead_reckoning::DeadReckoning;
use super::path_pair::PathPair;
use super::row_defects::{DefectKind, RowDefect};
use super::{clipped_inputs, held_poses, input_spikes, other_motion};
use crate::error::Result;
use crate::files::{Apart, InputTiming, Run};
use crate::model::Model;
use std::borrow::Cow;

/// Fewer rows tell nothing of their defects.
const FEWEST: usize = 40;

/// A run without its defects.
pub(crate) struct CleanedRun<'a> {
    /// Itself where it has none.
    pub run: Cow<'a, Run>,
    /// x, y and heading as its inputs reckon them.
    pub reckoned: [Vec<f64>; 3],
    /// What was found of it.
    pub defects: Vec<RowDefect>,
    /// Rows whose pose was left out.
    pub held: usize,
}

impl<'a> CleanedRun<'a> {
    /// Of a run; none of a model whose inputs alone reckon no path.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn of(run: &'a Run, model: &Model, timing: InputTiming) -> Result<Option<Self>> {
        let Some(reckoning) = DeadReckoning::of(model, timing, run)? else { return Ok(None) };
        let reckoned = reckoning.path(&run.inputs);
        let mut cleaned = Self { run: Cow::Borrowed(run), reckoned, defects: vec![], held: 0 };
        if run.time.len() >= FEWEST && run.input_time().len() >= FEWEST {
            cleaned.leave_out_spikes(&reckoning);
            cleaned.leave_out_held();
            cleaned.tell_stretches();
        }
        Ok(Some(cleaned))
    }

    fn pair(&self) -> PathPair<'_> {
        PathPair { run: &self.run, reckoned: &self.reckoned }
    }

    fn found(&mut self, kind: DefectKind) {
        self.defects.push(RowDefect { run: self.run.name.clone(), kind });
    }

    fn leave_out_spikes(&mut self, reckoning: &DeadReckoning) {
        for c in 0..self.run.inputs.len() {
            let rows = input_spikes::candidates(&self.run.inputs[c]);
            if rows.is_empty() {
                continue;
            }
            let with = |rows: &[usize]| {
                let mut inputs = self.run.inputs.clone();
                inputs[c] = input_spikes::without(self.run.input_time(), &inputs[c], rows);
                (reckoning.path(&inputs), inputs)
            };
            let spikes = input_spikes::not_followed(&self.run, &rows, [&self.reckoned, &with(&rows).0]);
            if spikes.is_empty() {
                continue;
            }
            let (reckoned, inputs) = with(&spikes);
            let at = spikes.iter().map(|i| self.run.input_time()[*i]).collect();
            let role = self.run.roles[c].clone();
            self.run.to_mut().inputs = inputs;
            self.reckoned = reckoned;
            self.found(DefectKind::Spikes { role, at });
        }
    }

    fn leave_out_held(&mut self) {
        let (run, all) = (&*self.run, self.run.time.len());
        let held = held_poses::rows(self.pair());
        if held.is_empty() {
            return;
        }
        let is_whole = |i: &usize| run.apart.is_none() && run.inputs.iter().all(|column| column[*i] == column[i - 1]);
        let (repeated, held): (Vec<usize>, Vec<usize>) = held.into_iter().partition(is_whole);
        let every = held_poses::every(run, &held);
        let first = repeated.first().map(|i| run.time[*i]);
        let out = |rows: &[usize]| {
            let mut out = vec![false; all];
            rows.iter().for_each(|i| out[*i] = true);
            out
        };
        let [is_repeated, is_held] = [&repeated, &held].map(|rows| out(rows));
        let is_out = |i: usize| is_repeated[i] || is_held[i];
        let pick = |column: &Vec<f64>, is_out: &dyn Fn(usize) -> bool| -> Vec<f64> {
            (0..column.len()).filter(|i| !is_out(*i)).map(|i| column[i]).collect()
        };
        let mut cleaned = run.with_poses(|column| pick(column, &is_out));
        if run.apart.is_none() {
            let inputs = |column: &Vec<f64>| pick(column, &|i| is_repeated[i]);
            cleaned.inputs = run.inputs.iter().map(inputs).collect();
            // Poses that are fewer than the inputs have times of their own.
            cleaned.apart = (!held.is_empty()).then(|| Apart {
                time: inputs(&run.time),
                truth: run.path.clone(),
                truth_sha256: run.sha256.clone(),
                one_clock: true,
            });
        }
        self.reckoned = self.reckoned.each_ref().map(|column| pick(column, &is_out));
        self.held = repeated.len() + held.len();
        self.run = Cow::Owned(cleaned);
        if let Some(first) = first {
            self.found(DefectKind::Repeated { rows: repeated.len(), first });
        }
        if !held.is_empty() {
            self.found(DefectKind::Held { rows: held.len(), all, every });
        }
    }

    /// Says what stretches of it show; those that are left out are left out of its record.
    fn tell_stretches(&mut self) {
        if self.run.time.len() < FEWEST {
            return;
        }
        let stretches = other_motion::found(self.pair());
        let clipped = clipped_inputs::found(self.pair());
        stretches.into_iter().chain(clipped).for_each(|kind| self.found(kind));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::preprocessing::generated_run::turning;
    use crate::vehicles;
    use rayon::prelude::*;

    /// What is done to a run that is as it should be, and what is told of it.
    fn told(seed: u64, spoilt: impl Fn(&mut Run)) -> (Run, Vec<DefectKind>) {
        let (file, model, mut run) = turning("unicycle", seed, true, 1.0).unwrap();
        spoilt(&mut run);
        let cleaned = CleanedRun::of(&run, &model, file.input_timing).unwrap().unwrap();
        (cleaned.run.into_owned(), cleaned.defects.into_iter().map(|d| d.kind).collect())
    }

    fn poses(run: &mut Run) -> impl Iterator<Item = &mut Vec<f64>> {
        [&mut run.x, &mut run.y].into_iter().chain(&mut run.heading)
    }

    const SEEDS: [u64; 4] = [1, 2, 3, 4];

    #[test]
    fn a_pose_filled_forward_is_left_out_and_the_inputs_stay() {
        for seed in SEEDS {
            let hold = |run: &mut Run| poses(run).for_each(|c| (0..c.len()).for_each(|i| c[i] = c[i / 5 * 5]));
            let (run, found) = told(seed, hold);
            let [DefectKind::Held { rows, all: 500, every }] = found[..] else { panic!("{seed}: {found:?}") };
            // Those at the end, and where the vehicle lags its inputs, catch up with nothing.
            assert!((every - 0.4).abs() < 1e-9 && rows >= 380 && run.time.len() == 500 - rows, "{every} {rows}");
            assert_eq!((run.inputs[0].len(), run.input_time().len()), (500, 500));
        }
    }

    #[test]
    fn rows_that_repeat_the_one_before_are_left_out() {
        for seed in SEEDS {
            let again = |run: &mut Run| {
                let columns = [&mut run.x, &mut run.y].into_iter().chain(&mut run.heading).chain(&mut run.inputs);
                columns.for_each(|c| (1..10).for_each(|k| c[50 * k] = c[50 * k - 1]));
            };
            let (run, found) = told(seed, again);
            let [DefectKind::Repeated { rows: 9, first }] = found[..] else { panic!("{seed}: {found:?}") };
            assert!((first - 4.0).abs() < 1e-9 && run.time.len() == 491 && run.inputs[0].len() == 491, "{first}");
        }
    }

    #[test]
    fn spikes_that_the_vehicle_did_not_follow_are_read_as_if_not_there() {
        for (seed, role) in SEEDS.into_iter().flat_map(|s| [(s, 0), (s, 1)]) {
            let (good, none) = told(seed, |_| ());
            assert_eq!(none, []);
            let (run, found) = told(seed, |run| [100, 200, 333].iter().for_each(|i| run.inputs[role][*i] = -30.0));
            let [DefectKind::Spikes { role: named, at }] = &found[..] else { panic!("{seed}: {found:?}") };
            let wanted = [8.0, 16.0, 26.64];
            assert!(at.len() == 3 && at.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9), "{at:?}");
            assert_eq!(named, &run.roles[role]);
            let off = |i: usize| (run.inputs[role][i] - good.inputs[role][i]).abs();
            assert!([100, 200, 333].into_iter().all(|i| off(i) < 0.01));
        }
        // One that the vehicle did follow stays.
        let (run, found) = told(1, |run| {
            run.inputs[1][100] += 8.0;
            (100..500).for_each(|i| run.heading.as_mut().unwrap()[i] += 0.64);
            let (x, y) = (run.x[100], run.y[100]);
            for i in 100..500 {
                let (dx, dy) = (run.x[i] - x, run.y[i] - y);
                let (sin, cos) = 0.64_f64.sin_cos();
                (run.x[i], run.y[i]) = (x + cos * dx - sin * dy, y + sin * dx + cos * dy);
            }
        });
        assert!(found.is_empty() && run.inputs[1][100] > 7.0, "{found:?}");
    }

    #[test]
    fn an_input_that_was_cut_off_is_told() {
        for seed in SEEDS {
            let most = |run: &Run| run.inputs[1].iter().copied().fold(0.0, f64::max);
            let (run, found) = told(seed, |run| {
                let limit = 0.7 * most(run);
                run.inputs[1].iter_mut().for_each(|u| *u = u.clamp(-limit, limit));
            });
            let is_told = |d: &DefectKind| matches!(d, DefectKind::Clipped { role, times, .. } if role == "yaw_rate" && *times > 2);
            assert!(!found.is_empty() && found.iter().all(is_told), "{seed}: {found:?}");
            // Its rows stay.
            assert_eq!((run.time.len(), run.inputs[1].len()), (500, 500));
            // A vehicle that is driven up to a limit and follows its inputs is as it should be.
            let (_, found) = told(seed, |run| {
                let limit = 0.7 * most(run);
                let time = run.time.clone();
                let mut lost = 0.0;
                for i in 1..500 {
                    let over = run.inputs[1][i] - run.inputs[1][i].clamp(-limit, limit);
                    lost += over * (time[i] - time[i - 1]);
                    run.inputs[1][i] -= over;
                    run.heading.as_mut().unwrap()[i] -= lost;
                }
            });
            assert!(!found.iter().any(|d| matches!(d, DefectKind::Clipped { .. })), "{seed}: {found:?}");
        }
    }

    /// The stretch of the one defect that is told.
    fn span(found: &[DefectKind]) -> [f64; 2] {
        match found {
            [DefectKind::Stands(span) | DefectKind::Carried(span)] => *span,
            _ => panic!("{found:?}"),
        }
    }

    #[test]
    fn a_vehicle_that_is_lifted_or_carried_is_told() {
        for seed in SEEDS {
            let (_, found) = told(seed, |run| {
                poses(run).for_each(|c| {
                    let lost = c[275] - c[200];
                    (200..275).for_each(|i| c[i] = c[200]);
                    (275..500).for_each(|i| c[i] -= lost);
                });
            });
            assert!(matches!(found[0], DefectKind::Stands(_)), "{seed}: {found:?}");
            let [from, to] = span(&found);
            assert!(from <= 16.0 && to >= 22.0 && from > 13.0 && to < 25.0, "{from} {to}");
            let (_, found) = told(seed, |run| run.inputs.iter_mut().for_each(|c| c[200..275].fill(0.0)));
            assert!(matches!(found[0], DefectKind::Carried(_)), "{seed}: {found:?}");
            let [from, to] = span(&found);
            assert!(from <= 16.0 + 1.0 && to >= 22.0 - 1.0 && from > 13.0 && to < 25.0, "{from} {to}");
        }
    }

    /// No ordinary effect, and no noise, is a defect, whatever the vehicle.
    #[test]
    fn a_run_as_it_should_be_has_none() {
        let all: Vec<&str> = vehicles::all().iter().map(|v| v.id.as_str()).collect();
        let tried = (0..500_u64).into_par_iter().filter_map(|seed| {
            let much = [1.0, 0.4][(seed / 7 % 2) as usize];
            let (file, model, run) = turning(all[seed as usize % all.len()], seed, seed % 3 > 0, much)?;
            let cleaned = CleanedRun::of(&run, &model, file.input_timing).unwrap()?;
            Some((seed, file.vehicle.clone(), cleaned.defects))
        });
        let tried: Vec<_> = tried.collect();
        let wrong: Vec<_> = tried.iter().filter(|t| !t.2.is_empty()).collect();
        assert!(wrong.is_empty() && tried.len() > 250, "{} {wrong:#?}", tried.len());
    }
}
