//! Creep kinematics of nonholonomic vehicles: constraints derived, theorems checked, and models corrected by measured runs.
//!
//! ```
//! use creepage::{Model, Run};
//! let model = Model::read("examples/runs/cornering/model.toml")?;
//! let runs = Run::read_all(["examples/runs/cornering/eights.csv", "examples/runs/cornering/rosette.csv"], &model)?;
//! let found = creepage::discover(&model, &runs)?;
//! assert_eq!(found.report.summary, "The model misses cornering-creep.");
//! assert!(found.model.text().contains("cornering-creep"));
//! # Ok::<(), creepage::Error>(())
//! ```
//!
//! What holds a wheel or an axle is a row that is linear in rates, in one of two generic forms (paper, (13) and (20)):
//!
//! ```text
//! π̇ − σ(e)·q̇ = 0          σ = r·(1 − e)           type R: it rolls
//! q̇₁ − σ(q₂, e)·q̇₃ = 0    σ = cot(q₂ + arctan e)   type T: it keeps a direction
//! ```
//!
//! From the rows follows the motion; a measured run is the motion within windows, a jump at the end of each, and a sensor:
//!
//! ```text
//! z′ = f(z, u, p)    z jumps by w ~ N(0, W·diag(q))    y = h(z, p) + v, v ~ N(0, σ²)
//! ```
//!
//! | symbol | unit | meaning |
//! |---|---|---|
//! | π̇, q̇ | m/s, rad/s | speed along the wheel, rate of the wheel |
//! | q₁, q₂, q₃ | m, rad, m | x, heading, y |
//! | e | 1 | creep, zero where the constraint is ideal |
//! | z, u, p | SI | pose and hidden states, logged inputs, parameters |
//! | w, v | SI | what no effect of the model explains, over windows of W seconds; noise of the sensor |
//!
//! Modules in their order; each imports only those above it:
//!
//! | module | what it is |
//! |---|---|
//! | [`error`], [`provenance`], [`progress`] | one message with its place and an exit code; which file something comes from; how far long work is |
//! | `wording`, [`number_format`] | phrases and numbers for people |
//! | [`formula`] | expressions as data: values, derivatives, proofs, units, vector lanes |
//! | [`mechanism`] | rows and what follows from them |
//! | [`vehicles`], [`effects`] | the catalogues, as data |
//! | [`files`] | model files, logs, results that are whole or absent |
//! | [`model`], [`motion`] | a vehicle with parameters and effects; its trajectories and their sensitivities |
//! | [`energy_rule`] | the paper's rule for the energy of a creeping wheel, Fig. 7 |
//! | [`equivalence`] | effects that are proved to give the same motions |
//! | [`mod@describe`], [`extensions`] | a model in formulas; a user's own effects and vehicles, held against every vehicle |
//! | [`connection`], [`dynamics`] | shapes that turn a body; motion by forces |
//! | [`scaffold`], [`sweep`] | what `init` and `sweep` do |
//! | [`picture`] | drawings as pure functions |
//! | [`claims`] | what the paper says, with evidence that runs |
//! | [`discrepancy`] | where model and measurement disagree, which effect is missing, how much it mends |
//! | [`figures`], [`theory`] | the paper's figures; the long form of the paper |
//! | `front_door` | the jobs as calls of one line: [`discover()`], [`check()`], [`describe()`], [`simulate()`], [`verify()`], [`sweep()`] |
#![warn(missing_docs)]

pub mod claims;
pub mod connection;
pub mod describe;
pub mod discrepancy;
pub mod dynamics;
pub mod effects;
pub mod energy_rule;
pub mod equivalence;
pub mod error;
pub mod extensions;
pub mod figures;
pub mod files;
pub mod formula;
mod front_door;
pub mod mechanism;
pub mod model;
pub mod motion;
pub mod number_format;
pub mod picture;
pub mod progress;
pub mod provenance;
pub mod scaffold;
pub mod sweep;
pub mod theory;
pub mod vehicles;
mod wording;

pub use discrepancy::report::{Report, Verdict};
pub use error::{Error, Kind as ErrorKind, Result};
pub use files::Run;
pub use front_door::{
    Discovery, Model, Options, Pose, check, check_with, describe, discover, discover_with, simulate, sweep, verify,
};
pub use progress::{OnProgress, Progress, Stage};

/// The examples of the README are compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub mod readme {}
