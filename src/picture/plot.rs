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

    fn panel(size: Size) -> Panel {
        let x = Axis::linear("t", "s", [0.0, 10.0]).along(size.columns());
        let y = Axis::linear("v", "m", [0.0, 10.0]).along(size.rows());
        Panel::new(size, x, y)
    }

    const SMALL: Size = Size { width: 340.0, height: 240.0, margins: [20.0, 20.0, 20.0, 20.0] };

    #[test]
    fn the_plotting_area_lies_within_its_margins() {
        let size = Size { width: 340.0, height: 240.0, margins: [10.0, 20.0, 30.0, 40.0] };
        assert_eq!((size.columns(), size.rows()), ([10.0, 320.0], [200.0, 30.0]));
        let drawn = panel(size).finish("i", "t", "d").to_string();
        assert!(drawn.contains("x=\"4\" y=\"24\" width=\"322\" height=\"182\" viewBox=\"4 24 322 182\""), "{drawn}");
        assert!(drawn.contains("class=\"axis\" x1=\"10\" y1=\"200\" x2=\"320\" y2=\"200\""), "{drawn}");
        assert!(
            drawn.contains("class=\"caption\" x=\"320\" y=\"237\"") && drawn.contains("x=\"2\" y=\"18\""),
            "{drawn}"
        );
        assert!(drawn.contains("aria-labelledby=\"i-title i-desc\""), "{drawn}");
    }

    #[test]
    fn ticks_are_as_far_apart_as_asked() {
        let count = |panel: &Panel| panel.grid().len() / 2;
        // 300 pixels along x: five steps of 2; 200 along y: five steps of 2.
        assert_eq!(count(&panel(SMALL)), 12);
        assert_eq!(count(&panel(SMALL).with_ticks(30.0)), 17);
        // 119 pixels along y have room for four steps of 24, not of 34.
        let low = |height| panel(Size { height, ..SMALL }).y.ticks(if height < 160.0 { 24.0 } else { 34.0 }).len();
        assert_eq!(count(&panel(Size { height: 159.0, ..SMALL })), 6 + low(159.0));
        assert_eq!(count(&panel(Size { height: 160.0, ..SMALL })), 6 + low(160.0));
    }

    #[test]
    fn a_band_ends_before_the_first_hole() {
        let mut p = panel(SMALL);
        let hole = (4.0, [f64::NAN, 2.0]);
        p.band(&[(0.0, [0.0, 2.0]), (2.0, [1.0, 3.0]), hole, (6.0, [0.0, 2.0])]);
        assert!(p.inside[0].to_string().contains("d=\"M20 220L80 200L80 160L20 180\""), "{}", p.inside[0]);
    }

    #[test]
    fn markers_are_centred_and_holes_have_none() {
        let mut p = panel(SMALL);
        p.markers("a", Marker::Square, &[[5.0, 5.0], [f64::NAN, 1.0], [1.0, f64::NAN]]);
        let marks: Vec<_> = p.inside.iter().map(|e| e.to_string()).collect();
        assert_eq!(marks, ["<rect class=\"mark a\" x=\"165.8\" y=\"115.8\" width=\"8.4\" height=\"8.4\"/>"]);
        let radius = |m| mark("a", m, [1.0, 2.0]).to_string();
        assert!(radius(Marker::Circle).contains("cy=\"2\" r=\"4.6\"") && radius(Marker::Ring).contains("r=\"3\""));
    }

    #[test]
    fn a_heading_leaves_room_for_its_remark() {
        let long = "m".repeat(100);
        let letters = |remark: &str| heading_text(&long, remark, 500.0).to_string().matches('m').count();
        // The classes have an m each.
        let [alone, beside] = [letters(""), letters(&"r".repeat(30))];
        assert_eq!((alone, beside), (56, 28 + 1));
        assert!(heading_text("heads", &"r".repeat(100), 10.0).to_string().contains(">heads"));
        assert!(!heading_text("h", "", 500.0).to_string().contains("tspan"));
    }

    #[test]
    fn a_legend_gives_every_name_its_room() {
        let key = |class, marker, label| Key { class, marker, label };
        let (drawn, width) = legend(&[key("band", None, "abc"), key("b", Some(Marker::Ring), "")], [10.0, 50.0]);
        let drawn = drawn.to_string();
        assert!((width - 141.4).abs() < 1e-9, "{width}");
        assert!(drawn.contains("class=\"band\" x=\"10\" y=\"43\" width=\"32\" height=\"14\""), "{drawn}");
        assert!(drawn.contains("x=\"49\" y=\"54.5\" text-anchor=\"start\">abc<"), "{drawn}");
        assert!(drawn.contains("d=\"M92.4 50L124.4 50\"") && drawn.contains("cx=\"108.4\""), "{drawn}");
    }
}
