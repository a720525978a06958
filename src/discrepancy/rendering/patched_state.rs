//! The state of the patched model, which gives a report its colour.

use crate::discrepancy::report::{Report, Verdict, judged, middle};
use crate::wording::counted;

/// How much worse a patched model may predict before the patch is no help.
const WORSE: f64 = 1.05;

/// How far a user may build on the patched model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum State {
    /// It explains the runs to their noise.
    AtFloor,
    /// Something remains above the noise, or cannot be told.
    Above,
    /// The data cannot be put to the model, or the patched one predicts worse.
    NotUsable,
}

impl State {
    /// Of a report.
    pub fn of(report: &Report) -> Self {
        match report.verdict {
            Verdict::UnusableData => Self::NotUsable,
            _ if is_worse(report) => Self::NotUsable,
            Verdict::NoMissingEffect | Verdict::MissingEffect if report.remains.is_none() => Self::AtFloor,
            _ => Self::Above,
        }
    }

    /// The class of its colour.
    pub fn class(self) -> &'static str {
        match self {
            Self::AtFloor => "good",
            Self::Above => "above",
            Self::NotUsable => "bad",
        }
    }

    /// A mark that tells it without colour.
    pub fn mark(self) -> &'static str {
        match self {
            Self::AtFloor => "✓",
            Self::Above => "▲",
            Self::NotUsable => "✕",
        }
    }
}

/// What was found and how far it goes, in a few words.
pub(crate) fn name(report: &Report) -> String {
    let causes = report.effects.len() + report.odd_runs.len();
    let rest = match State::of(report) {
        State::AtFloor => "only noise is left",
        State::Above => "something remains",
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
