//! A drawing as PDF or PNG, by `svg2pdf` and `resvg`.

use crate::error::{Error, Result};
use resvg::{tiny_skia, usvg};
use std::sync::Arc;
use usvg::fontdb;

/// Pixels of a PNG for each of the drawing: 300 dpi where 400 pixels are 85 mm.
const SCALE: f32 = 2.5;
/// Points of a PDF for each pixel of the drawing: 400 pixels are 85 mm.
const POINTS: f32 = 85.0 / 25.4 * 72.0 / 400.0;

/// The drawing, with the fonts of the system.
fn tree(svg: &str) -> Result<usvg::Tree> {
    let mut fonts = fontdb::Database::new();
    fonts.load_system_fonts();
    // Without one the letters would be missing and nobody told.
    let Some(family) = fonts.faces().find_map(|f| f.families.first().map(|(name, _)| name.clone())) else {
        return Err(
            Error::run("no font is installed, so a drawing has no letters").help("install one, such as DejaVu Sans")
        );
    };
    let query = fontdb::Query { families: &[fontdb::Family::SansSerif], ..fontdb::Query::default() };
    if fonts.query(&query).is_none() {
        let dejavu = fonts.faces().any(|f| f.families.iter().any(|(name, _)| name == "DejaVu Sans"));
        fonts.set_sans_serif_family(if dejavu { "DejaVu Sans".to_string() } else { family });
    }
    let options = usvg::Options { fontdb: Arc::new(fonts), ..usvg::Options::default() };
    usvg::Tree::from_str(svg, &options).map_err(|e| Error::run(format!("a drawing cannot be converted: {e}")))
}

/// A drawing as PDF, in its printed size.
///
/// # Errors
/// When no font is installed.
pub fn pdf(svg: &str) -> Result<Vec<u8>> {
    let page = svg2pdf::PageOptions { dpi: 72.0 / POINTS };
    svg2pdf::to_pdf(&tree(svg)?, svg2pdf::ConversionOptions::default(), page)
        .map_err(|e| Error::run(format!("a drawing cannot be converted: {e}")))
}

/// A drawing as PNG, at 300 dpi.
///
/// # Errors
/// When no font is installed.
pub fn png(svg: &str) -> Result<Vec<u8>> {
    let tree = tree(svg)?;
    let [width, height] = [tree.size().width(), tree.size().height()].map(|v| (v * SCALE).ceil() as u32);
    let mut picture = tiny_skia::Pixmap::new(width, height).ok_or_else(|| Error::run("a drawing has no size"))?;
    resvg::render(&tree, tiny_skia::Transform::from_scale(SCALE, SCALE), &mut picture.as_mut());
    picture.encode_png().map_err(|e| Error::run(format!("a picture cannot be encoded: {e}")))
}
