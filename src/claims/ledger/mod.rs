//! The ledger written down.

mod contents;
mod errata;
mod json;
mod text;

pub use contents::{claims_json, claims_text, contents};
pub use errata::errata;
pub use json::json;
pub use text::text;

use super::{Evidence, Gives, Outcome, Shown};

/// What became of a piece of evidence, in a few words.
fn outcome(evidence: &Evidence, shown: &Shown) -> String {
    let found = match &shown.outcome {
        Outcome::Holds { .. } if evidence.gives == Gives::Refutation => "NOT refuted: it holds".into(),
        Outcome::Holds { cases: 1 } if evidence.gives == Gives::Proof => "proved".into(),
        Outcome::Holds { cases } if evidence.gives == Gives::Proof => format!("proved, {cases} identities"),
        Outcome::Holds { cases } => format!("holds in {cases} {}", if *cases == 1 { "case" } else { "cases" }),
        Outcome::Fails(c) if evidence.gives == Gives::Refutation => format!("false at {c}"),
        Outcome::Fails(c) => format!("FAILS at {c}"),
        Outcome::Undefined(why) => format!("CANNOT TELL: {why}"),
    };
    let noticed = shown.sabotages - shown.survivors.len();
    let sabotage = match (evidence.gives, noticed == shown.sabotages) {
        (Gives::Refutation, true) => "the true form passes".into(),
        (Gives::Refutation, false) => "THE TRUE FORM IS REFUTED TOO".into(),
        (_, true) => format!("{noticed} of {} sabotages noticed", shown.sabotages),
        (_, false) => format!("ONLY {noticed} of {} sabotages noticed", shown.sabotages),
    };
    format!("{found}; {sabotage}")
}
