//! The sheet a figure is drawn on: as wide as a printed column, with its own style.
//!
//! 400 pixels are 85 mm, so 12 pixels are 7.2 points, the smallest text of a figure but for subscripts.

use crate::picture::plot::{Size, frame_svg};
use crate::picture::svg::{Element, rect};
use crate::picture::theme;

/// Width of a figure in pixels.
pub const WIDTH: f64 = 400.0;

/// A figure of a height in pixels as a file of its own, with a title and a description for those who do not see it.
///
/// ```
/// let svg = creepage::figures::page::page("fig0", "Nothing", "An empty sheet.", 100.0, vec![]);
/// assert!(svg.starts_with("<svg viewBox=\"0 0 400 100\"") && svg.ends_with("</svg>\n"));
/// ```
pub fn page(name: &str, title: &str, description: &str, height: f64, elements: Vec<Element>) -> String {
    let size = Size { width: WIDTH, height, margins: [0.0; 4] };
    let drawing = frame_svg(size, name, title, description)
        .with("xmlns", "http://www.w3.org/2000/svg")
        .number("width", WIDTH)
        .number("height", height)
        .child(Element::new("style").text(theme::figure()))
        .child(rect("paper", [0.0, 0.0], WIDTH, height))
        .children(elements);
    format!("{}\n", drawing.haloed())
}

/// A panel put at a place.
pub fn placed(panel: Element, [x, y]: [f64; 2], size: Size) -> Element {
    panel.number("x", x).number("y", y).number("width", size.width).number("height", size.height)
}
