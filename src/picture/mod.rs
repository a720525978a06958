//! Drawings as pure functions from data to SVG text.
//!
//! Nothing here reads a clock, a font or a file, and every coordinate is rounded to a tenth of a pixel, so the same
//! data give the same bytes on every machine. Values that are not finite break a line; they never reach the text.
//!
//! ```
//! use creepage::picture::{axis::Axis, plot::{Panel, Size}};
//! let size = Size::PANEL;
//! let x = Axis::linear("time", "s", [0.0, 10.0]).along(size.columns());
//! let y = Axis::linear("speed", "m/s", [0.0, 2.0]).along(size.rows());
//! let mut panel = Panel::new(size, x, y);
//! panel.series("after", &[[0.0, 0.0], [5.0, f64::NAN], [10.0, 2.0]]);
//! let svg = panel.finish("speed", "Speed over time", "A ramp with a hole.").to_string();
//! assert!(svg.starts_with("<svg") && !svg.contains("NaN"));
//! ```

pub mod axis;
#[cfg(feature = "drawings")]
pub mod converted;
pub mod decimate;
pub mod letters;
pub mod maths;
pub mod plot;
pub mod sketch;
pub mod svg;
pub mod theme;
pub mod ticks;
