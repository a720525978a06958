//! Hidden states at the starts of all windows at once: multiple shooting by Newton's method (Bock and Plitt, 1984; parallel in
//! time after Lions, Maday and Turinici, 2001).

use super::hidden_start::started;
use super::windows::LANES;
use crate::discrepancy::record::run_record::Record;
use crate::model::Equations;
use crate::motion::{LaneStepper, StateSensitivity};
use std::ops::Range;

/// Newton's steps, at most; motion that is linear in the hidden states takes one.
const MOST_STEPS: usize = 6;
/// A step that moves the states by less, in units of a state or of one, is the last.
const SETTLED: f64 = 1e-9;

/// A motion of the hidden states that does not ask for the pose, along the windows of a segment.
pub(super) struct HiddenTrajectory<'a> {
    /// The motion of the hidden states alone.
    pub carried: &'a Equations,
    /// Its parameters.
    pub p: &'a [f64],
    /// The run.
    pub record: &'a Record,
    /// The windows.
    pub windows: &'a [Range<usize>],
    /// The visible states at their starts.
    pub starts: &'a [Vec<f64>],
}

impl HiddenTrajectory<'_> {
    /// The hidden states at the start of every window.
    ///
    /// Every window is integrated from a guess ĥₖ of its start, all side by side, with Aₖ = ∂hₖ₊₁/∂hₖ:
    ///
    /// hₖ₊₁ = φₖ(ĥₖ) + Aₖ·(hₖ − ĥₖ)
    ///
    /// which is exact where the motion is linear in h; elsewhere once more from what comes out, until that stays. `None`
    /// where it does not.
    pub fn from(&self, first: &[f64]) -> Option<Vec<Vec<f64>>> {
        let mut guess = vec![first.to_vec(); self.windows.len()];
        for _ in 0..MOST_STEPS {
            let found = self.joined(&guess);
            let near = |(new, old): (&f64, &f64)| (new - old).abs() <= SETTLED * (1.0 + new.abs());
            let settled = found.iter().zip(&guess).all(|(new, old)| new.iter().zip(old).all(near));
            guess = found;
            if settled || self.carried.is_linear_in_hidden {
                return Some(guess);
            }
        }
        None
    }

    /// One step: the windows from a guess of their starts, joined to one another.
    fn joined(&self, guess: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let (visible, h) = (self.carried.visible, guess[0].len());
        let columns = visible + self.p.len() + h;
        let mut found = vec![guess[0].clone()];
        for (end, guess) in self.ends(guess).into_iter().zip(guess) {
            let here = &found[found.len() - 1];
            let by_start = |i: usize, j: usize| end.s[(visible + i + 1) * columns - h + j];
            let moved = |i: usize| (0..h).map(|j| by_start(i, j) * (here[j] - guess[j])).sum::<f64>();
            found.push((0..h).map(|i| end.z[visible + i] + moved(i)).collect());
        }
        found
    }

    /// Where every window but the last ends, by its hidden start.
    fn ends(&self, guess: &[Vec<f64>]) -> Vec<StateSensitivity> {
        let last = self.windows.len() - 2;
        let stepper = LaneStepper::new(self.carried, &self.record.signals, [self.p; LANES]);
        let mut stepper = stepper.by_hidden_starts(guess[0].len());
        let some = (0..=last).step_by(LANES).flat_map(|k| {
            let windows: [usize; LANES] = std::array::from_fn(|l| (k + l).min(last));
            let begin = |l: usize| &self.starts[windows[l]][..self.carried.visible];
            let mut arcs = started::<LANES>(stepper.columns(), begin, |l| guess.get(windows[l]));
            stepper.through(&mut arcs, &self.record.time, &windows.map(|k| self.windows[k].clone()));
            (0..LANES.min(last + 1 - k)).map(move |l| arcs.one(l)).collect::<Vec<_>>()
        });
        some.collect()
    }
}
