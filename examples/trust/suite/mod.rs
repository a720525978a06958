//! Hidden runs by the independent simulator, and how an answer to one of them is judged.
//!
//! ```text
//! seed → case ⟨make, drive, logging, secret; power⟩ → trial ⟨files → discover⟩ → judgement
//! ```
//! Nothing here looks at an answer of the library before it is judged: whether the data of a case can tell
//! its secret is computed from the simulator alone ([`power`]).

// The benchmark and the test that mount this module use different parts of it, beside a `simulator` of theirs.
#![allow(dead_code)]

pub mod basis;
pub mod case;
pub mod class;
pub mod drive;
pub mod judgement;
pub mod logging;
pub mod make;
pub mod power;
pub mod secret;
pub mod trial;
