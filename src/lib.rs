//! Creep kinematics of nonholonomic vehicles: constraints derived, theorems checked, and models corrected by measured runs.
//!
//! ```
//! use creepage::{Model, Run};
//! let model = Model::read("examples/runs/cornering/model.toml")?;
//! let runs = Run::read_all(["examples/runs/cornering/eights.csv", "examples/runs/cornering/rosette.csv"], &model)?;
//! let found = creepage::discover(&model, &runs)?;
//! assert!(found.report.summary.starts_with("In turns the robot slides outwards: 8."));
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
//! The jobs are calls of one line:
//!
//! | call | what it does |
//! |---|---|
//! | [`discover()`], [`discover_with()`] | finds where model and runs disagree, names the missing effect, adds it to the model |
//! | [`check()`], [`check_with()`] | says before any fit what runs can tell of a model |
//! | [`fit()`] | fits just the effects that are named: values and covariance, and no selection |
//! | [`describe()`] | the constraints of a model with their equations, Jacobians and growth vector |
//! | [`simulate()`], [`simulate_many()`], [`sweep()`] | the motion of a model; motions of many cases as arrays; as a table |
//! | [`verify()`] | runs the claims of the paper, each with its evidence |
//!
//! They take a [`Model`] and [`Run`]s, from files or from arrays, and [`Options`]; they tell their [`Progress`], and stop
//! where they are asked to. Behind them stand
//!
//! | module | what it is |
//! |---|---|
//! | [`report`] | what `discover` and `check` say, part by part |
//! | [`vehicles`], [`effects`] | the catalogues, as data |
//! | [`formula`] | expressions as data: values, derivatives, proofs, units, vector lanes |
//! | [`mechanism`] | constraints, their rows, and what follows from them |
//! | [`mod@describe`] | a model in formulas, as text, LaTeX or JSON |
//! | [`motion`], [`mod@sweep`] | trajectories along inputs, one or many |
//! | [`dynamics`], [`connection`] | motion by forces; shapes that turn a body |
//! | [`claims`] | what the paper says, with evidence that runs |
//! | [`theory`] | the long form of the paper, and how to extend the program |
//!
//! Other modules can be reached, for the program's own tests and benches, but are hidden and carry no promise: they change
//! without notice, and so does what a visible module hides.
#![warn(missing_docs)]

// The command calls the library by its name.
extern crate self as creepage;

pub mod claims;
#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod command;
pub mod connection;
pub mod describe;
#[doc(hidden)]
pub mod discrepancy;
pub mod dynamics;
pub mod effects;
#[doc(hidden)]
pub mod energy_rule;
#[doc(hidden)]
pub mod equivalence;
#[doc(hidden)]
pub mod error;
#[doc(hidden)]
pub mod export;
#[doc(hidden)]
pub mod extensions;
#[doc(hidden)]
pub mod figures;
#[doc(hidden)]
pub mod files;
#[doc(hidden)]
pub mod fleet;
pub mod formula;
mod front_door;
pub mod mechanism;
#[doc(hidden)]
pub mod model;
pub mod motion;
#[doc(hidden)]
pub mod number_format;
#[doc(hidden)]
pub mod numerics;
#[doc(hidden)]
pub mod picture;
#[doc(hidden)]
pub mod planning;
#[doc(hidden)]
pub mod progress;
#[doc(hidden)]
pub mod provenance;
pub mod report;
#[doc(hidden)]
pub mod scaffold;
pub mod sweep;
pub mod theory;
#[doc(hidden)]
pub mod tracking;
pub mod vehicles;
mod wording;

pub use discrepancy::identifiability::Check;
pub use discrepancy::report::{Report, Verdict};
pub use error::{Error, Kind as ErrorKind, Result};
pub use files::Run;
pub use front_door::{
    Discovery, Model, Motions, Options, Pose, check, check_with, describe, describe_with, discover, discover_with, fit,
    simulate, simulate_many, sweep, verify,
};
pub use progress::{OnProgress, Progress, Stage};

/// The examples of the README are compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub mod readme {}
