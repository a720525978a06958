//! The status of a claim, as stated or as earned.

use std::fmt;

/// What is known of a claim; *stated* by its author, *earned* by running its evidence.
///
/// ```
/// use creepage::claims::Status;
/// assert_eq!(Status::ALL.map(Status::name)[0], "proved");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Deserialize, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// True for every value of its symbols, shown in exact arithmetic.
    Proved,
    /// True in every generated case.
    Sampled,
    /// False: a counterexample is at hand.
    Refuted,
    /// False as printed, with a counterexample; a corrected form is proved or sampled.
    Corrected,
    /// A misprint without mathematics.
    Editorial,
    /// No evidence yet, or evidence that did not hold.
    Open,
}

impl Status {
    /// Every status in the order of a summary.
    pub const ALL: [Status; 6] =
        [Status::Proved, Status::Sampled, Status::Corrected, Status::Refuted, Status::Editorial, Status::Open];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Status::Proved => "proved",
            Status::Sampled => "sampled",
            Status::Refuted => "refuted",
            Status::Corrected => "corrected",
            Status::Editorial => "editorial",
            Status::Open => "open",
        }
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
