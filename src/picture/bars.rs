//! Horizontal bars with names and remarks, told apart by fill, hatching and text.

use super::axis::Axis;
use super::plot::{Size, frame_svg};
use super::svg::{Element, cut, label, line, path, rect};

/// How a bar looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// Filled.
    Solid,
    /// Hatched.
    Hatched,
    /// Only an outline.
    Hollow,
}

/// One bar.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Written left of it.
    pub name: String,
    /// Its length, in the axis' unit; a value that is not finite draws no bar.
    pub value: f64,
    /// Written right of it.
    pub remark: String,
    /// How it looks.
    pub look: Look,
}

/// Height of a row in pixels.
const ROW: f64 = 26.0;
/// Pixels left for the names.
const NAMES: f64 = 186.0;
/// Pixels left for the remarks.
const REMARKS: f64 = 190.0;
/// Pixels above the first row.
const TOP: f64 = 10.0;

/// The size of a chart with so many bars.
pub fn size(bars: usize) -> Size {
    Size { width: 760.0, height: TOP + ROW * bars as f64 + 48.0, margins: [NAMES, REMARKS, TOP, 48.0] }
}

/// The chart of bars from top to bottom over one axis.
pub fn chart(bars: &[Bar], axis: Axis, id: &str, title: &str, description: &str) -> Element {
    let size = size(bars.len());
    let axis = axis.along(size.columns());
    let rows = bars.iter().enumerate().flat_map(|(i, bar)| row(bar, &axis, TOP + ROW * i as f64));
    let zero = axis.at(0.0);
    frame_svg(size, id, title, description).children(grid(&axis, size)).children(rows).child(line(
        "axis",
        [zero, TOP],
        [zero, size.rows()[0]],
    ))
}

fn grid(axis: &Axis, size: Size) -> Vec<Element> {
    let [bottom, top] = size.rows();
    let mut out = Vec::new();
    for tick in axis.ticks(46.0) {
        out.push(line("grid", [tick.at, top], [tick.at, bottom]));
        out.push(label("tick", [tick.at, bottom + 17.0], "middle", tick.label));
    }
    out.push(label("caption", [size.columns()[1], bottom + 37.0], "end", axis.caption()));
    out
}

fn row(bar: &Bar, axis: &Axis, top: f64) -> Vec<Element> {
    let class = if bar.look == Look::Hollow { "" } else { "strong" };
    let middle = top + ROW / 2.0 + 4.5;
    let name = label(class, [NAMES - 10.0, middle], "end", cut(&bar.name, 24));
    let zero = axis.at(0.0);
    let end = if bar.value.is_finite() { axis.at(bar.value) } else { zero };
    let [left, right] = if end < zero { [end, zero] } else { [zero, end] };
    let mut out = vec![name];
    if bar.value.is_finite() {
        out.extend(body(bar.look, [left, right], [top + 5.0, top + ROW - 5.0]));
    }
    out.push(label(class, [right + 8.0, middle], "start", &bar.remark));
    out
}

fn body(look: Look, [left, right]: [f64; 2], [top, bottom]: [f64; 2]) -> Vec<Element> {
    let class = match look {
        Look::Solid => "bar",
        Look::Hatched => "bar rival",
        Look::Hollow => "bar other",
    };
    let outline = rect(class, [left, top], right - left, bottom - top);
    if look == Look::Hatched { vec![outline, hatch([left, right], [top, bottom])] } else { vec![outline] }
}

/// Strokes at 45° within a rectangle.
fn hatch([left, right]: [f64; 2], [top, bottom]: [f64; 2]) -> Element {
    let height = bottom - top;
    let strokes = ((right - left + height) / 7.0).floor() as usize;
    let mut points = Vec::new();
    for start in (1..=strokes).map(|i| left + 7.0 * i as f64) {
        let (low, high) = ((start - height).max(left), start.min(right));
        points.extend([[low, top + start - low], [high, top + start - high], [f64::NAN; 2]]);
    }
    path("hatch", &points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bar_fills_its_row_and_its_length() {
        let drawn = body(Look::Solid, [100.0, 250.0], [20.0, 34.0])[0].to_string();
        for part in ["x=\"100\"", "y=\"20\"", "width=\"150\"", "height=\"14\""] {
            assert!(drawn.contains(part), "{part} in {drawn}");
        }
        assert_eq!(body(Look::Hatched, [0.0, 1.0], [0.0, 1.0]).len(), 2);
    }

    #[test]
    fn strokes_end_at_the_edges_of_their_bar() {
        let drawn = hatch([30.0, 50.0], [100.0, 110.0]).to_string();
        assert!(drawn.contains("\"M30 107L37 100M34 110L44 100M41 110L50 101M48 110L50 108\""), "{drawn}");
    }

    #[test]
    fn bars_grow_from_zero_to_either_side_and_remarks_keep_clear_of_them() {
        let bar = |value: f64, look| Bar { name: "n".into(), value, remark: format!("r{value}"), look };
        let bars = [bar(3.0, Look::Solid), bar(-2.0, Look::Hatched), bar(f64::NAN, Look::Hollow)];
        let drawn = chart(&bars, Axis::linear("v", "m", [-4.0, 4.0]), "i", "t", "d").to_string();
        assert!(drawn.contains("viewBox=\"0 0 760 136\""), "{drawn}");
        // 48 pixels to a unit, zero at 378.
        for part in [
            "class=\"bar\" x=\"378\" y=\"15\" width=\"144\" height=\"16\"",
            "x=\"530\" y=\"27.5\" text-anchor=\"start\">r3<",
            "class=\"bar rival\" x=\"282\" y=\"41\" width=\"96\" height=\"16\"",
            "x=\"386\" y=\"53.5\" text-anchor=\"start\">r-2<",
            "class=\"\" x=\"386\" y=\"79.5\" text-anchor=\"start\">rNaN<",
            "class=\"strong\" x=\"176\" y=\"27.5\" text-anchor=\"end\">n<",
            "class=\"axis\" x1=\"378\" y1=\"10\" x2=\"378\" y2=\"88\"",
            "class=\"grid\" x1=\"570\" y1=\"10\" x2=\"570\" y2=\"88\"",
            "class=\"tick\" x=\"570\" y=\"105\"",
            "class=\"caption\" x=\"570\" y=\"125\" text-anchor=\"end\">v, m<",
        ] {
            assert!(drawn.contains(part), "{part} in {drawn}");
        }
        assert_eq!(drawn.matches("<rect").count(), 2);
    }
}
