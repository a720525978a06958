//! What [`discover`](crate::discover()) and [`check`](crate::check()) say, part by part, as data.
//!
//! A [`Report`](crate::Report) is `report.json`; a [`Check`](crate::Check) is what `creepage check --format json` prints.
//! Both are read and written by `serde`.
//!
//! ```
//! use creepage::report::Estimate;
//! let creep: Estimate = serde_json::from_str(r#"{"value": 0.05, "std": null, "unit": "1"}"#).unwrap();
//! assert_eq!((creep.value, creep.std), (0.05, None));
//! ```

pub use crate::discrepancy::identifiability::{Health, Pair, Parameter, Prospect, RunHealth, Seen, Standing};
#[doc(hidden)]
pub use crate::discrepancy::report::RemainingSensor;
pub use crate::discrepancy::report::{
    AboveSpeed, BeforeAfter, CourseFound, Covariance, DataSummary, Disagreement, Estimate, Evidence, Finding, Floor,
    Gap, Named, NextExperiment, OddRun, PerRun, Provenance, Refuted, Remaining, RemainingConstraint, Remains, Rival,
    RunClock, RunEstimate, ScopeFound, Step, Unnamed,
};
