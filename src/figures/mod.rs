//! The paper's figures and some beyond it, redrawn from the library's own models: SVG with the data as CSV.
//!
//! A figure is an element of [`FIGURES`]: a name, what it shows, where the paper has it, and a function from
//! [`Options`] to a [`Drawing`]. To add one, write its file and add its element. Vehicles come from the catalogue,
//! motion from [`crate::motion`], coefficients act through the library's effects; a figure computes no physics itself.
//! Sizes are those of a printed column, see [`page`].
//!
//! What each reading of the word "conservative" in Fig. 7 makes of the paper's sentences, computed by
//! [`readings::table`]:
//!
#![doc = include_str!("readings.md")]

mod backing;
mod creep_map;
mod data;
mod executed_plans;
mod fig1;
mod fig2;
mod fig3;
mod fig4;
mod fig5;
mod fig6;
mod fig7;
mod fig8;
mod figure;
mod gap;
mod ideal_limit;
mod key;
mod off_tracking;
mod options;
pub mod page;
mod parking;
mod plane;
mod planning;
pub mod readings;
mod rig;
mod tracking_picture;
mod understeer;

pub use data::{Data, fixed, scientific};
pub use figure::{Drawing, Figure};
pub use options::Options;
pub use rig::{Rig, RigWheel};
pub use tracking_picture::tracking_picture;

use crate::error::{Error, Result};
use crate::progress::{OnProgress, Stage, tell};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Every figure, in the order of the paper.
pub const FIGURES: &[Figure] = &[
    fig1::FIGURE,
    fig2::FIGURE,
    fig3::FIGURE,
    fig4::FIGURE,
    fig5::FIGURE,
    fig6::FIGURE,
    fig7::FIGURE,
    fig8::FIGURE,
    creep_map::FIGURE,
    ideal_limit::FIGURE,
    understeer::FIGURE,
    off_tracking::FIGURE,
    planning::FIGURE,
    parking::FIGURE,
    backing::FIGURE,
    gap::FIGURE,
];

/// The figure of that name.
///
/// ```
/// assert_eq!(creepage::figures::named("fig7").unwrap().source, "Fig. 7");
/// let error = creepage::figures::named("figg7").unwrap_err();
/// assert!(error.exit_code() == 2 && error.to_string().contains("did you mean \"fig7\"?"));
/// ```
///
/// # Errors
/// For a name that no figure has, with the nearest one.
pub fn named(name: &str) -> Result<&'static Figure> {
    let names: Vec<&str> = FIGURES.iter().map(|f| f.name).collect();
    FIGURES.iter().find(|f| f.name == name).ok_or_else(|| {
        let advice = crate::files::advice(name, "figures", &names);
        Error::input(format!("no figure is called {:?}", crate::files::shown(name))).help(advice)
    })
}

/// Draws figures, all of them when none is named; in the order of [`FIGURES`], each once.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | e_rc, e_tc | 1 | coefficients the schematic figures are drawn with, [`Options`] |
///
/// ```
/// use creepage::figures::{Options, draw};
/// let drawn = draw(&["fig2".into()], &Options::default(), &creepage::progress::unheard).unwrap();
/// assert_eq!(drawn[0].0.name, "fig2");
/// assert!(drawn[0].1.svg.contains("</svg>") && drawn[0].1.tables[0].csv().starts_with("quantity,value,unit\n"));
/// ```
///
/// # Errors
/// As [`named`], and when a model cannot be integrated with the coefficients given.
pub fn draw(names: &[String], options: &Options, progress: &OnProgress) -> Result<Vec<(&'static Figure, Drawing)>> {
    names.iter().try_for_each(|name| named(name).map(|_| ()))?;
    let wanted = |f: &&Figure| names.is_empty() || names.iter().any(|n| n == f.name);
    let wanted: Vec<&Figure> = FIGURES.iter().filter(wanted).collect();
    let begun = AtomicUsize::new(0);
    let one = |f: &&'static Figure| {
        let before = begun.fetch_add(1, Ordering::Relaxed);
        tell(progress, Stage::Figures { name: f.name }, before, wanted.len())?;
        Ok((*f, (f.draw)(options)?))
    };
    wanted.par_iter().map(one).collect()
}

/// The figures with what they show, as a list for `--help`.
///
/// ```
/// assert!(creepage::figures::list().lines().any(|l| l.trim_start().starts_with("fig7 ")));
/// ```
pub fn list() -> String {
    let row = |f: &Figure| format!("  {:<13} {} ({})", f.name, f.title, f.source);
    FIGURES.iter().map(row).collect::<Vec<_>>().join("\n")
}
