//! Panels that show paths from above, and panels of functions, in a column.

use crate::picture::axis::{Axis, equal_aspect, extent, widened};
use crate::picture::maths::maths;
use crate::picture::plot::{Panel, Size};

/// Points that a path in a panel may have.
pub const MAX_POINTS: usize = 400;

/// Pixels between ticks along x in a narrow panel.
const TICKS: f64 = 40.0;

/// The ranges of x and y that hold all points, a little wider.
pub fn ranges<'a>(points: impl Iterator<Item = &'a [f64; 2]>, share: f64) -> [[f64; 2]; 2] {
    let points: Vec<&[f64; 2]> = points.collect();
    [0, 1].map(|i| widened(extent(points.iter().map(|p| p[i])).unwrap_or([0.0, 1.0]), share))
}

/// A panel of the plane: metres, both axes with one scale.
pub fn plane(size: Size, [x, y]: [[f64; 2]; 2]) -> Panel {
    let x = Axis::linear("x", "m", x).along(size.columns());
    let y = Axis::linear("y", "m", y).along(size.rows());
    let (x, y) = equal_aspect(x, y);
    Panel::new(size, x, y).with_ticks(TICKS)
}

/// A panel of a function.
pub fn graph(size: Size, x: Axis, y: Axis) -> Panel {
    Panel::new(size, x.along(size.columns()), y.along(size.rows())).with_ticks(TICKS)
}

/// Writes what a panel shows at its upper right.
pub fn name(panel: &mut Panel, size: Size, text: &str) {
    panel.note(maths("", [size.columns()[1], size.margins[2] - 12.0], "end", text));
}
