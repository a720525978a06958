//! The outcome of a check: it holds, it fails with a counterexample, or it is undefined.

use std::fmt;

/// What a check found. `Undefined` is never `Holds`.
///
/// ```
/// use creepage::claims::Outcome;
/// assert!(Outcome::PROVED.holds() && Outcome::failure("at x = 0").fails());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// True in every case tried; a proof is one case.
    Holds {
        /// How many cases.
        cases: u64,
    },
    /// False, and here is where.
    Fails(Counterexample),
    /// The check could not say.
    Undefined(String),
}

/// A case in which a statement is false, in numbers a person can check by hand.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Counterexample {
    /// Names and values of the case.
    pub values: Vec<(String, String)>,
    /// What is found there and what the statement says.
    pub says: String,
}

impl Outcome {
    /// True in one case: the outcome of a proof.
    pub const PROVED: Outcome = Outcome::Holds { cases: 1 };

    /// Whether the statement was found true.
    pub fn holds(&self) -> bool {
        matches!(self, Outcome::Holds { .. })
    }

    /// Whether the statement was found false.
    pub fn fails(&self) -> bool {
        matches!(self, Outcome::Fails(_))
    }

    /// A failure without a case: a statement about no numbers.
    pub fn failure(says: impl Into<String>) -> Self {
        Outcome::Fails(Counterexample { values: vec![], says: says.into() })
    }

    /// True when every one of several checks is: their cases added up, or the first that is not true.
    pub fn all(outcomes: impl IntoIterator<Item = Outcome>) -> Self {
        let mut cases = 0;
        for outcome in outcomes {
            match outcome {
                Outcome::Holds { cases: n } => cases += n,
                other => return other,
            }
        }
        match cases {
            0 => Outcome::Undefined("nothing was checked".into()),
            _ => Outcome::Holds { cases },
        }
    }
}

impl fmt::Display for Counterexample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let values: Vec<String> = self.values.iter().map(|(name, value)| format!("{name} = {value}")).collect();
        match values.is_empty() {
            true => f.write_str(&self.says),
            false => write!(f, "{}: {}", values.join(", "), self.says),
        }
    }
}
