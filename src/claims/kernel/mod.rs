//! Proofs for an independent kernel: identities as theorems over the reals in the language of the Coq proof assistant.
//!
//! What the normal form of the program finds to be true, the kernel proves again from the axioms of its real numbers:
//! the files hold statements, and no certificate of the program is believed. An equation of sines and cosines is one of
//! polynomials once sums of angles are written out; two polynomials are the same modulo sin² + cos² = 1 when their
//! normal forms under sin² → 1 − cos² are, which the tactic `field` decides by reflection, inside the kernel.
//!
//! | step | where |
//! |---|---|
//! | everything that a check proves on its way is recorded | `proved` |
//! | definitions that are numbers are put in | `folded` |
//! | the identity becomes a theorem: no divisor is zero, so left = right | `theorem`, `term` |
//! | a growth vector becomes one: a distribution, of which the kernel computes brackets and ranks | `distribution`, `growth`, `Brackets.v` |
//! | a file a claim, the tactic they share, a script that runs `coqc` | `file`, `Creepage.v`, `check.sh` |
//! | of which files a kernel has accepted which text | `accepted` |

mod accepted;
mod distribution;
mod file;
mod folded;
mod growth;
mod term;
mod theorem;

pub use accepted::{accepted_line, is_accepted, kernel};
pub use file::{ClaimFile, Proofs, proofs, proofs_of};
