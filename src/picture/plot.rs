//! A panel: two axes, lines that dashes and markers tell apart, bands, labels at the ends of lines.

use super::axis::Axis;
use super::decimate;
use super::svg::{Element, cut, label, line, path, rect, width_of};

/// The size of a panel and its margins, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// Whole width.
    pub width: f64,
    /// Whole height.
    pub height: f64,
    /// Margins left, right, top and bottom of the plotting area.
    pub margins: [f64; 4],
}

impl Size {
    /// The usual panel.
    pub const PANEL: Size = Size { width: 520.0, height: 390.0, margins: [58.0, 20.0, 50.0, 46.0] };

    /// The horizontal pixels of the plotting area, left to right.
    pub fn columns(&self) -> [f64; 2] {
        [self.margins[0], self.width - self.margins[1]]
    }

    /// The vertical pixels of the plotting area, bottom to top.
    pub fn rows(&self) -> [f64; 2] {
        [self.height - self.margins[3], self.margins[2]]
    }
}

/// The shape of a marker.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marker {
    /// A filled disk.
    Circle,
    /// A filled square.
    Square,
    /// A small hollow ring.
    Ring,
}

/// What a legend says of one kind of line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Key<'a> {
    /// Class of the line, which decides colour, width and dashes.
    pub class: &'a str,
    /// Its marker.
    pub marker: Option<Marker>,
    /// Its name.
    pub label: &'a str,
}

/// A drawing with two axes.
#[derive(Clone, Debug)]
pub struct Panel {
    size: Size,
    x: Axis,
    y: Axis,
    inside: Vec<Element>,
    outside: Vec<Element>,
    heading: Option<(String, String)>,
    /// Pixels between ticks along x, at least.
    spacing: f64,
}

/// Points outside the plotting area that still show, in pixels: half a marker.
const OVERHANG: f64 = 6.0;
/// Height of a line of labels, in pixels.
const LINE_HEIGHT: f64 = 17.0;

impl Panel {
    /// An empty panel whose axes already lie along its pixels.
    pub fn new(size: Size, x: Axis, y: Axis) -> Self {
        Self { size, x, y, inside: Vec::new(), outside: Vec::new(), heading: None, spacing: 58.0 }
    }

    /// Writes a heading and, softer, a remark beside it.
    pub fn heading(&mut self, heading: &str, remark: &str) {
        self.heading = Some((heading.into(), remark.into()));
    }

    /// The panel with ticks along x no nearer than so many pixels.
    pub fn with_ticks(self, spacing: f64) -> Self {
        Self { spacing, ..self }
    }

    /// The pixel of a point in the units of the axes.
    pub fn place(&self, p: [f64; 2]) -> [f64; 2] {
        [self.x.at(p[0]), self.y.at(p[1])]
    }

    /// Draws a function of the horizontal axis; many values become the extremes of every pixel column.
    pub fn series(&mut self, class: &str, points: &[[f64; 2]]) {
        let pixels: Vec<_> = points.iter().map(|p| self.place(*p)).collect();
        self.inside.push(path(&format!("line {class}"), &decimate::columns(&pixels)));
    }

    /// Draws pieces of a path in the plane with at most about `most` points together.
    pub fn pieces(&mut self, class: &str, pieces: &[Vec<[f64; 2]>], most: usize) {
        let pixels: Vec<Vec<_>> = pieces.iter().map(|piece| piece.iter().map(|p| self.place(*p)).collect()).collect();
        let mut all: Vec<[f64; 2]> = Vec::new();
        for piece in decimate::paths(&pixels, most) {
            all.extend(piece);
            all.push([f64::NAN; 2]);
        }
        self.inside.push(path(&format!("line {class}"), &all));
    }

    /// Marks points; those that are not finite are left out.
    pub fn markers(&mut self, class: &str, marker: Marker, points: &[[f64; 2]]) {
        let pixels = points.iter().map(|p| self.place(*p)).filter(|p| p.iter().all(|v| v.is_finite()));
        let marks: Vec<_> = pixels.map(|p| mark(class, marker, p)).collect();
        self.inside.extend(marks);
    }

    /// Fills between two functions of the horizontal axis, up to the first value that is not finite.
    pub fn band(&mut self, points: &[(f64, [f64; 2])]) {
        let finite =
            |(x, y): &&(f64, [f64; 2])| self.place([*x, y[0]]).iter().chain([&self.y.at(y[1])]).all(|v| v.is_finite());
        let points: Vec<_> = points.iter().take_while(finite).collect();
        let lower = points.iter().map(|(x, y)| self.place([*x, y[0]]));
        let upper = points.iter().rev().map(|(x, y)| self.place([*x, y[1]]));
        let outline: Vec<_> = lower.chain(upper).collect();
        self.inside.push(path("band", &outline));
    }

    /// Adds an element in pixels that may lie outside the plotting area.
    pub fn note(&mut self, element: Element) {
        self.outside.push(element);
    }

    /// Names lines at their ends, right of the plotting area, moved apart where they would overlap.
    pub fn end_labels(&mut self, ends: &[([f64; 2], &str)]) {
        let right = self.size.columns()[1];
        let mut ends: Vec<_> = ends.iter().map(|(p, text)| (self.place(*p), *text)).collect();
        ends.retain(|(p, _)| p.iter().all(|v| v.is_finite()));
        ends.sort_by(|a, b| a.0[1].total_cmp(&b.0[1]));
        let [bottom, top] = self.size.rows();
        let wanted: Vec<f64> = ends.iter().map(|(p, _)| p[1]).collect();
        for ((p, text), y) in ends.iter().zip(apart(&wanted, LINE_HEIGHT, top, bottom)) {
            self.outside.push(line("leader", [p[0] + 7.0, p[1]], [right + 12.0, y]));
            self.outside.push(label("strong", [right + 15.0, y + 4.5], "start", *text));
        }
    }

    /// The panel as an `<svg>` with a title and a description for those who do not see it.
    pub fn finish(self, id: &str, title: &str, description: &str) -> Element {
        let [left, right] = self.size.columns();
        let [bottom, top] = self.size.rows();
        let [x, y] = [left - OVERHANG, top - OVERHANG];
        let (width, height) = (right - x + OVERHANG, bottom - y + OVERHANG);
        let window = [x, y, width, height].map(super::svg::fixed).join(" ");
        let clip = Element::new("svg").number("x", x).number("y", y).number("width", width).number("height", height);
        let frame = self.frame();
        frame_svg(self.size, id, title, description)
            .children(frame)
            .child(clip.with("viewBox", window).children(self.inside))
            .children(self.outside)
    }

    fn frame(&self) -> Vec<Element> {
        let mut out = self.grid();
        let [left, right] = self.size.columns();
        let [bottom, top] = self.size.rows();
        out.push(line("axis", [left, bottom], [right, bottom]));
        out.push(label("caption", [right, bottom + 37.0], "end", self.x.caption()));
        out.push(label("caption", [2.0, top - 12.0], "start", self.y.caption()));
        if let Some((heading, remark)) = &self.heading {
            out.push(heading_text(heading, remark, self.size.width));
        }
        out
    }

    fn grid(&self) -> Vec<Element> {
        let [left, right] = self.size.columns();
        let [bottom, top] = self.size.rows();
        let mut out = Vec::new();
        for tick in self.x.ticks(self.spacing) {
            out.push(line("grid", [tick.at, bottom], [tick.at, top]));
            out.push(label("tick", [tick.at, bottom + 18.0], "middle", tick.label));
        }
        for tick in self.y.ticks(if bottom - top < 120.0 { 24.0 } else { 34.0 }) {
            out.push(line("grid", [left, tick.at], [right, tick.at]));
            out.push(label("tick", [left - 9.0, tick.at + 4.0], "end", tick.label));
        }
        out
    }
}

/// The heading of a panel on one line, the heading cut where both would not fit.
fn heading_text(heading: &str, remark: &str, width: f64) -> Element {
    let room = (width - 16.0 - width_of(remark, 13.0)) / width_of("m", 14.0);
    let text = label("heading", [2.0, 18.0], "start", cut(heading, room.max(8.0) as usize));
    let remark = Element::new("tspan").with("class", "remark").text(remark);
    if remark == Element::new("tspan").with("class", "remark").text("") {
        text
    } else {
        text.text("  ").child(remark.with("dx", "6"))
    }
}

/// An `<svg>` that scales with the page, with a title and a description.
pub fn frame_svg(size: Size, id: &str, title: &str, description: &str) -> Element {
    let [title_id, description_id] = ["title", "desc"].map(|part| format!("{id}-{part}"));
    Element::new("svg")
        .with("viewBox", format!("0 0 {} {}", super::svg::fixed(size.width), super::svg::fixed(size.height)))
        .with("role", "img")
        .with("aria-labelledby", format!("{title_id} {description_id}"))
        .child(Element::new("title").with("id", title_id).text(title))
        .child(Element::new("desc").with("id", description_id).text(description))
}

/// A marker at a point in pixels.
pub fn mark(class: &str, marker: Marker, [x, y]: [f64; 2]) -> Element {
    let circle = |r: f64, class: &str| {
        Element::new("circle").with("class", format!("mark {class}")).number("cx", x).number("cy", y).number("r", r)
    };
    match marker {
        Marker::Circle => circle(4.6, class),
        Marker::Ring => circle(3.0, class),
        Marker::Square => rect(&format!("mark {class}"), [x - 4.2, y - 4.2], 8.4, 8.4),
    }
}

/// A row of samples with names from a point in pixels on, and its width.
pub fn legend(keys: &[Key], [left, y]: [f64; 2]) -> (Element, f64) {
    let mut group = Element::new("g");
    let mut x = left;
    for key in keys {
        let middle = x + 16.0;
        group = match key.class {
            "band" => group.child(rect("band", [x, y - 7.0], 32.0, 14.0)),
            "start" => group,
            class => group.child(path(&format!("line {class}"), &[[x, y], [x + 32.0, y]])),
        };
        group = group.children(key.marker.map(|m| mark(key.class, m, [middle, y])));
        group = group.child(label("", [x + 39.0, y + 4.5], "start", key.label));
        x += 39.0 + width_of(key.label, 13.0) + 20.0;
    }
    (group, x - left)
}

/// Positions at least `gap` apart and as near as possible to the wanted ones, which increase, within bounds.
fn apart(wanted: &[f64], gap: f64, least: f64, most: f64) -> Vec<f64> {
    let mut out: Vec<f64> = wanted.to_vec();
    for _ in 0..60 {
        for i in 1..out.len() {
            let overlap = gap - (out[i] - out[i - 1]);
            if overlap > 0.0 {
                out[i - 1] -= overlap / 2.0;
                out[i] += overlap / 2.0;
            }
        }
        shift_into(&mut out, least, most);
    }
    out
}

fn shift_into(values: &mut [f64], least: f64, most: f64) {
    let above = values.first().map_or(0.0, |v| (least - v).max(0.0));
    values.iter_mut().for_each(|v| *v += above);
    let below = values.last().map_or(0.0, |v| (v - most).max(0.0));
    values.iter_mut().for_each(|v| *v -= below);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_move_apart_and_stay_within_bounds() {
        let placed = apart(&[100.0, 101.0, 102.0], 17.0, 0.0, 110.0);
        assert!(placed.windows(2).all(|w| w[1] - w[0] > 16.9), "{placed:?}");
        assert!(placed[2] <= 110.0 && placed[0] >= 0.0, "{placed:?}");
        assert_eq!(apart(&[10.0, 90.0], 17.0, 0.0, 100.0), [10.0, 90.0]);
        let low = apart(&[1.0, 2.0], 17.0, 0.0, 100.0);
        assert!(low[0] >= 0.0 && low[1] - low[0] > 16.9, "{low:?}");
    }
}
