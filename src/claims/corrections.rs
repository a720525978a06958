//! The corrections of a ledger by kind, and the statements of the paper that they are of.

use super::{Correction, Ledger, Status};
use std::collections::BTreeSet;

/// How many claims of a ledger were corrected in which way, and of how many statements of the paper they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CorrectionCounts {
    /// In the order of [`Correction::ALL`].
    pub by_kind: [usize; 3],
    /// Entries about the same theorem count once.
    pub statements: usize,
}

impl Ledger {
    /// The corrections that were earned, counted by kind.
    pub fn corrections(&self) -> CorrectionCounts {
        let corrected = || self.entries.iter().filter(|e| e.earned == Status::Corrected);
        let of = |kind| corrected().filter(|e| e.claim.correction == Some(kind)).count();
        let statement = |part_of: &str, id: &str| if part_of.is_empty() { id.to_string() } else { part_of.to_string() };
        let statements: BTreeSet<String> = corrected().map(|e| statement(&e.claim.part_of, &e.claim.id)).collect();
        CorrectionCounts { by_kind: Correction::ALL.map(of), statements: statements.len() }
    }
}
