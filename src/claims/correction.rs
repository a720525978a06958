//! In which way a printed statement had to be corrected.

/// The kind of a correction.
///
/// ```
/// use creepage::claims::{self, Correction, Status};
/// let kind = |id: &str| claims::all().into_iter().find(|c| c.id == id).and_then(|c| c.correction);
/// assert_eq!(kind("E1"), Some(Correction::FalseAsPrinted));
/// assert_eq!(kind("E9"), Some(Correction::LacksHypothesis));
/// assert_eq!(kind("E24"), Some(Correction::ContestedReading));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Correction {
    /// The words or the formula, as they stand, are false.
    FalseAsPrinted,
    /// True where a condition holds that is not printed.
    LacksHypothesis,
    /// False in one way of reading it, which the text does not force.
    ContestedReading,
}

impl Correction {
    /// All kinds, the gravest first.
    pub const ALL: [Self; 3] = [Self::FalseAsPrinted, Self::LacksHypothesis, Self::ContestedReading];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::FalseAsPrinted => "false as printed",
            Self::LacksHypothesis => "lacking a hypothesis",
            Self::ContestedReading => "of contested reading",
        }
    }
}
