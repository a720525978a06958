//! Progress of long work, as data: who listens counts it, words it, and may stop it.

use crate::error::{Error, Result};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What long work is at.
///
/// ```
/// use creepage::{Progress, Stage};
/// use std::ops::ControlFlow::Continue;
/// # use creepage::{Model, Options, Run};
/// # use std::sync::Mutex;
/// let seen = Mutex::new(vec![]);
/// let progress = |p: Progress| {
///     seen.lock().unwrap().push(p.stage);
///     Continue(())
/// };
/// let options = Options { progress: &progress, ..Options::default() };
/// # let model = Model::read("examples/runs/cornering/model.toml")?;
/// # let runs = [Run::read("examples/runs/cornering/eights.csv", &model)?];
/// creepage::discover_with(&model, &runs, &options)?;
/// assert_eq!(seen.lock().unwrap()[0], Stage::ModelFit);
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Stage {
    /// The rows of the runs are looked at: gaps, units, gross errors.
    Rows,
    /// The clocks of inputs and poses are aligned, run by run.
    ClockAlignment,
    /// The clocks are aligned again, beside the effects that were chosen; run by run.
    ClockRefinement,
    /// The model is fitted as it is.
    ModelFit,
    /// Effects that could be added are weighed, one by one.
    Candidates {
        /// Additions that were made before.
        chosen: usize,
    },
    /// An equation is sought for motion that no effect explains.
    UnnamedTerms,
    /// Effects that hold in part only, or move with time, are looked for.
    Scopes,
    /// The effects are asked of parts of the data (jackknife), part by part.
    PartsOfData,
    /// The effects are asked of inputs of which every second row is left out.
    InputSampling,
    /// What each chosen effect is worth is worked out, effect by effect.
    Evidence,
    /// Data sets are drawn from the model without an effect, and each is asked what the effect would gain on it.
    Draws,
    /// The held-out data are opened.
    HeldOut,
    /// How well the runs would show each effect is worked out, effect by effect.
    Detection,
    /// The next experiment is designed.
    Experiment,
    /// Cases of a sweep.
    Cases {
        /// Cases that were there from an earlier run.
        found: usize,
    },
    /// Plans are driven with feedback, drive by drive.
    Drives,
    /// First guesses from which a plan is sought.
    FirstGuesses,
    /// Robots of a fleet.
    Robots,
    /// Robots of a fleet whose runs are fitted with the effects that the fleet needs.
    FleetFits,
    /// Pieces of evidence of claims.
    Claims {
        /// The claim of the piece that was last run.
        id: String,
    },
    /// Figures.
    Figures {
        /// The figure that was last begun.
        name: &'static str,
    },
}

/// How far long work is: a stage, and how many of how many of its parts are done.
///
/// Work that is done on several threads tells from each of them, so a count may come after a larger one.
///
/// | field | unit | meaning |
/// |---|---|---|
/// | `stage` | | what is done |
/// | `done` | 1 | parts of the stage that are done |
/// | `of` | 1 | all parts of the stage; zero where they cannot be counted |
///
/// ```
/// use creepage::{Progress, Stage};
/// let half = Progress { stage: Stage::PartsOfData, done: 2, of: 4 };
/// assert_eq!(half.share(), Some(0.5));
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Progress {
    /// What is done.
    pub stage: Stage,
    /// Parts of the stage that are done.
    pub done: usize,
    /// All parts of the stage; zero where they cannot be counted.
    pub of: usize,
}

impl Progress {
    /// The share of the stage that is done, where its parts can be counted.
    ///
    /// ```
    /// use creepage::{Progress, Stage};
    /// assert_eq!(Progress { stage: Stage::ModelFit, done: 0, of: 0 }.share(), None);
    /// ```
    pub fn share(&self) -> Option<f64> {
        (self.of > 0).then(|| self.done as f64 / self.of as f64)
    }
}

/// Who is told how far long work is; `ControlFlow::Break` stops it at its next step.
///
/// ```
/// use creepage::{ErrorKind, Model, OnProgress, Options, Run};
/// use std::ops::ControlFlow;
/// let stop: &OnProgress = &|_| ControlFlow::Break(());
/// let model = Model::read("examples/runs/cornering/model.toml")?;
/// let runs = [Run::read("examples/runs/cornering/eights.csv", &model)?];
/// let stopped = creepage::discover_with(&model, &runs, &Options { progress: stop, ..Options::default() });
/// assert_eq!(stopped.err().map(|e| e.kind()), Some(ErrorKind::Stopped));
/// # Ok::<(), creepage::Error>(())
/// ```
pub type OnProgress<'a> = dyn Fn(Progress) -> ControlFlow<()> + Sync + 'a;

/// Progress that nobody listens to.
pub fn unheard(_: Progress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Tells how many of how many parts of a stage are done.
///
/// # Errors
/// When the work is to stop.
pub(crate) fn tell(listener: &OnProgress, stage: Stage, done: usize, of: usize) -> Result<()> {
    match listener(Progress { stage, done, of }) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::stopped()),
    }
}

/// Tells that a stage without a count begins.
///
/// # Errors
/// When the work is to stop.
pub(crate) fn begin(listener: &OnProgress, stage: Stage) -> Result<()> {
    tell(listener, stage, 0, 0)
}

/// Parts of a stage that are done on several threads.
pub(crate) struct Counter<'a> {
    listener: &'a OnProgress<'a>,
    stage: Stage,
    done: AtomicUsize,
    of: usize,
}

impl<'a> Counter<'a> {
    /// Tells that a stage of so many parts begins.
    ///
    /// # Errors
    /// When the work is to stop.
    pub fn begin(listener: &'a OnProgress<'a>, stage: Stage, of: usize) -> Result<Self> {
        tell(listener, stage.clone(), 0, of)?;
        Ok(Self { listener, stage, done: AtomicUsize::new(0), of })
    }

    /// Tells that one part more is done.
    ///
    /// # Errors
    /// When the work is to stop.
    pub fn one(&self) -> Result<()> {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        tell(self.listener, self.stage.clone(), done, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Kind;
    use std::sync::Mutex;

    #[test]
    fn parts_are_counted_and_a_break_is_an_error_of_its_own_kind() {
        let heard = Mutex::new(vec![]);
        let listener = |p: Progress| {
            heard.lock().unwrap().push((p.done, p.of));
            if p.done < 2 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        };
        let counter = Counter::begin(&listener, Stage::PartsOfData, 3).unwrap();
        assert!(counter.one().is_ok());
        let stopped = counter.one().unwrap_err();
        assert_eq!((stopped.kind(), stopped.exit_code()), (Kind::Stopped, 1));
        assert_eq!(*heard.lock().unwrap(), [(0, 3), (1, 3), (2, 3)]);
    }
}
