//! The state of the patched model, which gives a report its colour.

use crate::discrepancy::report::{Report, Verdict, judged, middle};
use crate::wording::counted;

/// How much worse a patched model may predict before the patch is no help.
const WORSE: f64 = 1.05;

/// How far a user may build on what a page is of: on the patched model, of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum State {
    /// It may be built on: the patched model explains the runs to their noise.
    Good,
    /// Something remains above the noise, or cannot be told.
    Doubtful,
    /// The data cannot be put to the model, or the patched one predicts worse.
    NotUsable,
}

impl State {
    /// Of a report.
    pub fn of(report: &Report) -> Self {
        match report.verdict {
            Verdict::UnusableData => Self::NotUsable,
            _ if is_worse(report) => Self::NotUsable,
            Verdict::NoMissingEffect | Verdict::MissingEffect if report.remains.is_none() => Self::Good,
            _ => Self::Doubtful,
        }
    }

    /// The class of its colour.
    pub fn class(self) -> &'static str {
        match self {
            Self::Good => "good",
            Self::Doubtful => "above",
            Self::NotUsable => "bad",
        }
    }

    /// A mark that tells it without colour.
    pub fn mark(self) -> &'static str {
        match self {
            Self::Good => "✓",
            Self::Doubtful => "▲",
            Self::NotUsable => "✕",
        }
    }
}

/// What was found and how far it goes, in a few words.
pub(crate) fn name(report: &Report) -> String {
    let causes = report.effects.len() + report.odd_runs.len();
    let rest = match State::of(report) {
        State::Good => "only noise is left",
        State::Doubtful => "something remains",
        State::NotUsable => "the patched model is no better",
    };
    match report.verdict {
        Verdict::UnusableData => "These data cannot be used".into(),
        Verdict::NotIdentifiable => "These data cannot tell".into(),
        Verdict::Unexplained => "Not explained".into(),
        Verdict::UnnamedEffect => format!("Found, without a name: {rest}"),
        Verdict::MissingEffect => format!("Found {}: {rest}", counted(causes, "cause")),
        Verdict::NoMissingEffect if report.remains.is_some() => "Nothing with a name; something remains".into(),
        Verdict::NoMissingEffect => "Nothing is missing".into(),
    }
}

fn is_worse(report: &Report) -> bool {
    let gap = middle(&report.gap).and_then(judged);
    !report.effects.is_empty() && gap.is_some_and(|(_, v)| v.position_rms_after > WORSE * v.position_rms_before)
}
