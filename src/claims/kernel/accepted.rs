//! Which theorems a kernel has accepted: the digest of every file that it was given and let
//! pass, with what the file rests on.

use super::file::{BRACKETS, SHARED};
use super::{ClaimFile, Proofs};
use sha2::{Digest, Sha256};

/// The kernel, then a line a claim: its id, the number of its theorems, the digest of its file; written by the test that
/// runs the kernel.
const ACCEPTED: &str = include_str!("accepted.txt");

/// The kernel whose answers are on record, with its version.
pub fn kernel() -> &'static str {
    ACCEPTED.lines().next().unwrap_or_default()
}

/// The line of a file that was accepted.
pub fn accepted_line(file: &ClaimFile) -> String {
    let digest =
        [SHARED, BRACKETS, &file.text].iter().fold(Sha256::new(), |all, text| all.chain_update(text)).finalize();
    let hex: String = digest.iter().take(8).map(|byte| format!("{byte:02x}")).collect();
    format!("{} {} {hex}", file.claim, file.theorems)
}

/// Whether the kernel has accepted the file, letter for letter, and the files that it rests on.
pub fn is_accepted(file: &ClaimFile) -> bool {
    let line = accepted_line(file);
    ACCEPTED.lines().skip(1).any(|accepted| accepted == line)
}

impl Proofs {
    /// The file of a claim that the kernel has accepted as it is.
    pub fn accepted(&self, claim: &str) -> Option<&ClaimFile> {
        self.claims.iter().find(|c| c.claim == claim && is_accepted(c))
    }

    /// How many theorems of how many claims the kernel has accepted.
    pub fn count_accepted(&self) -> (usize, usize) {
        let accepted = || self.claims.iter().filter(|c| is_accepted(c));
        (accepted().map(|c| c.theorems).sum(), accepted().count())
    }
}
