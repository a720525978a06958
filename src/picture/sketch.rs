//! Schematic drawings: points of the plane with y up, arrows, arcs, angles, wheels and lengths.

use super::maths::maths;
use super::svg::{Element, line, path, path_data};

/// Length and half width of an arrow's head, in pixels.
const HEAD: [f64; 2] = [8.0, 3.1];
/// Angle between two points of an arc, rad.
const ARC_STEP: f64 = 0.06;
/// Length of the strokes of hatched ground and their distance, in pixels.
const STROKE: f64 = 6.0;

/// A point at a distance and an angle from another.
///
/// ```
/// let p = creepage::picture::sketch::polar([1.0, 0.0], 2.0, std::f64::consts::FRAC_PI_2);
/// assert!((p[0] - 1.0).abs() < 1e-15 && p[1] == 2.0);
/// ```
pub fn polar(from: [f64; 2], distance: f64, angle: f64) -> [f64; 2] {
    [from[0] + distance * angle.cos(), from[1] + distance * angle.sin()]
}

/// A drawing whose points are in units of the thing drawn: x to the right, y up, angles counter-clockwise.
///
/// ```
/// use creepage::picture::sketch::Sketch;
/// let mut s = Sketch::new([100.0, 80.0], 50.0);
/// s.arrow("velocity", [0.0, 0.0], [1.0, 0.0]);
/// assert_eq!(s.at([1.0, 1.0]), [150.0, 30.0]);
/// assert!(s.finish()[0].to_string().starts_with("<line"));
/// ```
#[derive(Clone, Debug)]
pub struct Sketch {
    origin: [f64; 2],
    scale: f64,
    elements: Vec<Element>,
}

impl Sketch {
    /// An empty drawing whose origin lies at a pixel, with so many pixels to a unit.
    pub fn new(origin: [f64; 2], scale: f64) -> Self {
        Self { origin, scale, elements: Vec::new() }
    }

    /// The pixel of a point.
    pub fn at(&self, p: [f64; 2]) -> [f64; 2] {
        [self.origin[0] + self.scale * p[0], self.origin[1] - self.scale * p[1]]
    }

    /// Pixels to a unit.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// What was drawn.
    pub fn finish(self) -> Vec<Element> {
        self.elements
    }

    /// Adds an element in pixels.
    pub fn add(&mut self, element: Element) {
        self.elements.push(element);
    }

    /// A line through points.
    pub fn line(&mut self, class: &str, points: &[[f64; 2]]) {
        let pixels: Vec<_> = points.iter().map(|p| self.at(*p)).collect();
        self.add(path(&format!("line {class}"), &pixels));
    }

    /// A closed outline.
    pub fn shape(&mut self, class: &str, points: &[[f64; 2]]) {
        let pixels: Vec<_> = points.iter().map(|p| self.at(*p)).collect();
        let data = format!("{}Z", path_data(&pixels));
        self.add(Element::new("path").with("class", format!("shape {class}")).with("d", data));
    }

    /// A circle.
    pub fn circle(&mut self, class: &str, centre: [f64; 2], radius: f64) {
        let [x, y] = self.at(centre);
        let circle = Element::new("circle").with("class", class);
        self.add(circle.number("cx", x).number("cy", y).number("r", radius * self.scale));
    }

    /// A small dot.
    pub fn dot(&mut self, p: [f64; 2]) {
        let [x, y] = self.at(p);
        self.add(Element::new("circle").with("class", "dot").number("cx", x).number("cy", y).number("r", 2.6));
    }

    /// An arrow; one too short for its head is not drawn.
    pub fn arrow(&mut self, class: &str, from: [f64; 2], to: [f64; 2]) {
        let (from, to) = (self.at(from), self.at(to));
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        if length < 0.6 * HEAD[0] {
            return;
        }
        let head = HEAD[0].min(0.7 * length);
        let back = |share: f64| [0, 1].map(|i| to[i] - share * (to[i] - from[i]) / length);
        self.add(line(&format!("line {class}"), from, back(head - 1.0)));
        self.head(class, to, [(to[0] - from[0]) / length, (to[1] - from[1]) / length], head);
    }

    /// The head of an arrow at a pixel along a direction in pixels.
    fn head(&mut self, class: &str, [x, y]: [f64; 2], [dx, dy]: [f64; 2], length: f64) {
        let half = HEAD[1] * length / HEAD[0];
        let side = |s: f64| [x - length * dx - s * half * dy, y - length * dy + s * half * dx];
        let data = format!("{}Z", path_data(&[[x, y], side(1.0), side(-1.0)]));
        self.add(Element::new("path").with("class", format!("head {class}")).with("d", data));
    }

    /// Part of a circle from one angle to another.
    pub fn arc(&mut self, class: &str, centre: [f64; 2], radius: f64, [from, to]: [f64; 2]) {
        self.line(class, &arc(centre, radius, [from, to]));
    }

    /// Part of a circle with a head at its end: a turn, a torque.
    pub fn turn(&mut self, class: &str, centre: [f64; 2], radius: f64, [from, to]: [f64; 2]) {
        let sign = (to - from).signum();
        let head = HEAD[0].min(0.8 * (to - from).abs() * radius * self.scale);
        if head < 2.0 {
            return;
        }
        // The head is straight: it begins where it is as long as the arc it takes the place of.
        let back = to - sign * head / (radius * self.scale);
        self.arc(class, centre, radius, [from, back]);
        let (tip, foot) = (self.at(polar(centre, radius, to)), self.at(polar(centre, radius, back)));
        let length = (tip[0] - foot[0]).hypot(tip[1] - foot[1]).max(1e-9);
        self.head(class, tip, [(tip[0] - foot[0]) / length, (tip[1] - foot[1]) / length], head);
    }

    /// An angle with an arc, a head in its sense and a name beside it, `radius` and `gap` in pixels.
    pub fn angle(&mut self, centre: [f64; 2], radius: f64, angles: [f64; 2], text: &str, gap: f64) {
        let r = radius / self.scale;
        self.turn("angle", centre, r, angles);
        let middle = 0.5 * (angles[0] + angles[1]);
        let at = self.at(polar(centre, r + gap / self.scale, middle));
        let anchor = if middle.cos() > 0.35 {
            "start"
        } else if middle.cos() < -0.35 {
            "end"
        } else {
            "middle"
        };
        self.add(maths("", [at[0], at[1] + 4.0 - 3.0 * middle.sin()], anchor, text));
    }

    /// Text with mathematics at a point, moved by pixels to the right and down.
    pub fn text(&mut self, class: &str, p: [f64; 2], [dx, dy]: [f64; 2], anchor: &str, text: &str) {
        let [x, y] = self.at(p);
        self.add(maths(class, [x + dx, y + dy], anchor, text));
    }

    /// A length between two points: a line with a head at both ends, moved aside by pixels, and its name.
    pub fn length(&mut self, from: [f64; 2], to: [f64; 2], aside: f64, text: &str) {
        let way = (to[0] - from[0]).hypot(to[1] - from[1]).max(1e-12);
        let across = [-(to[1] - from[1]) / way, (to[0] - from[0]) / way].map(|c| c * aside / self.scale);
        let moved = |p: [f64; 2]| [p[0] + across[0], p[1] + across[1]];
        let (a, b) = (moved(from), moved(to));
        self.line("help", &[from, a]);
        self.line("help", &[to, b]);
        let middle = [0, 1].map(|i| 0.5 * (a[i] + b[i]));
        self.arrow("measure", middle, a);
        self.arrow("measure", middle, b);
        let [x, y] = self.at(middle);
        self.add(maths("", [x, y + if aside < 0.0 { 14.0 } else { -5.0 }], "middle", text));
    }

    /// A wheel from above: a rectangle with round corners along its heading, sides in units.
    pub fn wheel(&mut self, class: &str, centre: [f64; 2], heading: f64, [length, width]: [f64; 2]) {
        self.shape(class, &rounded(centre, heading, [length, width], 0.3 * width));
    }

    /// Level ground seen from the side, hatched below.
    pub fn ground(&mut self, [from, to]: [f64; 2], height: f64) {
        let (a, b) = (self.at([from, height]), self.at([to, height]));
        self.add(line("line ink", a, b));
        let strokes = ((b[0] - a[0]) / STROKE) as usize;
        let mut points = Vec::new();
        for i in 1..=strokes {
            let x = a[0] + STROKE * i as f64;
            points.extend([[x, a[1]], [x - STROKE, a[1] + STROKE], [f64::NAN; 2]]);
        }
        self.add(path("line hair", &points));
    }
}

/// Points of part of a circle.
pub fn arc(centre: [f64; 2], radius: f64, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    let steps = ((to - from).abs() / ARC_STEP).ceil().max(1.0);
    (0..=steps as usize).map(|i| polar(centre, radius, from + (to - from) * i as f64 / steps)).collect()
}

/// A rectangle about a centre, turned, its corners rounded.
pub fn rounded(centre: [f64; 2], heading: f64, [length, width]: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let (along, across) = (0.5 * length - radius, 0.5 * width - radius);
    let quarter = std::f64::consts::FRAC_PI_2;
    let corners = [(along, across, 0.0), (-along, across, 1.0), (-along, -across, 2.0), (along, -across, 3.0)];
    let corner = |(x, y, n): (f64, f64, f64)| {
        let round = (0..=8).map(move |i| polar([x, y], radius, quarter * (n + 0.125 * f64::from(i))));
        round.map(|p| turned(p, centre, heading)).collect::<Vec<_>>()
    };
    corners.into_iter().flat_map(corner).collect()
}

/// A point of a body in the plane: `p` forward and left of a place with a heading.
pub fn turned(p: [f64; 2], place: [f64; 2], heading: f64) -> [f64; 2] {
    let (sin, cos) = heading.sin_cos();
    [place[0] + p[0] * cos - p[1] * sin, place[1] + p[0] * sin + p[1] * cos]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forward_and_left_are_turned_counter_clockwise() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let p = turned([2.0, 1.0], [10.0, 10.0], quarter);
        assert!((p[0] - 9.0).abs() < 1e-12 && (p[1] - 12.0).abs() < 1e-12, "{p:?}");
    }

    #[test]
    fn an_arrow_without_room_is_not_drawn() {
        let mut s = Sketch::new([0.0, 0.0], 1.0);
        s.arrow("velocity", [0.0, 0.0], [1.0, 0.0]);
        s.turn("angle", [0.0, 0.0], 10.0, [0.0, 1e-9]);
        assert!(s.finish().is_empty());
    }

    /// Up the paper, moved to the left, whatever way it points.
    #[test]
    fn a_length_is_moved_aside_of_its_way() {
        let mut s = Sketch::new([0.0, 0.0], 10.0);
        s.length([1.0, 3.0], [1.0, 11.0], 20.0, "L");
        let middle = s.at([-1.0, 7.0]);
        let text: String = s.finish().iter().map(|e| format!("{e}")).collect();
        assert!(text.contains(&format!("x=\"{}\"", middle[0])), "{text}");
    }

    #[test]
    fn a_rounded_rectangle_keeps_its_sides() {
        let outline = rounded([0.0, 0.0], 0.0, [4.0, 2.0], 0.5);
        let most = |i: usize| outline.iter().map(|p| p[i]).fold(f64::MIN, f64::max);
        assert!((most(0) - 2.0).abs() < 1e-12 && (most(1) - 1.0).abs() < 1e-12);
    }

    fn drawn(draw: impl Fn(&mut Sketch)) -> String {
        let mut s = Sketch::new([0.0, 0.0], 1.0);
        draw(&mut s);
        s.finish().iter().map(|e| format!("{e}")).collect()
    }

    #[test]
    fn an_arrow_ends_at_the_base_of_its_head() {
        let arrow = |to| drawn(move |s| s.arrow("", [0.0, 0.0], to));
        let long = arrow([30.0, 40.0]);
        assert!(long.contains("x1=\"0\" y1=\"0\" x2=\"25.8\" y2=\"-34.4\""), "{long}");
        assert!(long.contains("d=\"M30 -40L27.7 -31.7L22.7 -35.5Z\""), "{long}");
        let short = arrow([10.0, 0.0]);
        assert!(short.contains("x2=\"4\"") && short.contains("d=\"M10 0L3 2.7L3 -2.7Z\""), "{short}");
        assert_eq!((arrow([4.7, 0.0]).len(), arrow([4.9, 0.0]).is_empty()), (0, false));
    }

    #[test]
    fn the_head_of_a_turn_begins_on_its_arc() {
        let quarter = std::f64::consts::FRAC_PI_2;
        // 8 pixels of a circle of 100 are 0.08 rad; the head lies along their chord.
        let left = drawn(|s| s.turn("", [0.0, 0.0], 100.0, [0.0, quarter]));
        assert!(left.contains("L8 -99.7\""), "{left}");
        assert!(left.contains("M0 -100L"), "{left}");
        let right = drawn(|s| s.turn("", [0.0, 0.0], 100.0, [0.0, -quarter]));
        assert!(right.contains("L8 99.7\"") && right.contains("M0 100L"), "{right}");
    }

    #[test]
    fn names_of_angles_stand_outside_them() {
        let named = |angles: [f64; 2]| drawn(move |s| s.angle([0.0, 0.0], 20.0, angles, "a", 10.0));
        for (middle, at) in [
            (0.0, "x=\"30\" y=\"4\" text-anchor=\"start\""),
            (std::f64::consts::PI, "x=\"-30\" y=\"4\" text-anchor=\"end\""),
            (std::f64::consts::FRAC_PI_2, "x=\"0\" y=\"-29\" text-anchor=\"middle\""),
        ] {
            let text = named([middle - 0.5, middle + 0.5]);
            assert!(text.contains(at), "{at}: {text}");
        }
    }

    #[test]
    fn a_length_is_named_on_its_far_side() {
        let named = |aside| drawn(move |s| s.length([0.0, 0.0], [60.0, 0.0], aside, "L"));
        let (above, below) = (named(20.0), named(-20.0));
        assert!(above.contains("x=\"30\" y=\"-25\"") && above.contains("M0 0L0 -20"), "{above}");
        assert!(below.contains("x=\"30\" y=\"34\"") && below.contains("M60 0L60 20"), "{below}");
    }

    #[test]
    fn ground_is_hatched_below() {
        let ground = drawn(|s| s.ground([0.0, 20.0], 0.0));
        assert!(ground.contains("d=\"M6 0L0 6M12 0L6 6M18 0L12 6\""), "{ground}");
    }

    #[test]
    fn an_arc_has_points_enough_to_look_round() {
        let points = arc([1.0, 2.0], 3.0, [0.0, 0.59]);
        assert_eq!((points.len(), points[0]), (11, [4.0, 2.0]));
        assert!(points.iter().all(|p| ((p[0] - 1.0).hypot(p[1] - 2.0) - 3.0).abs() < 1e-12));
        assert_eq!(arc([0.0, 0.0], 1.0, [1.0, 1.0]).len(), 2);
    }

    #[test]
    fn every_corner_is_rounded() {
        let outline = rounded([1.0, 2.0], 0.0, [4.0, 2.0], 0.5);
        let centre = |x: f64, y: f64| {
            outline.iter().filter(move |p| ((p[0] - 1.0 - x).hypot(p[1] - 2.0 - y) - 0.5).abs() < 1e-12)
        };
        for (x, y) in [(1.5, 0.5), (-1.5, 0.5), (-1.5, -0.5), (1.5, -0.5)] {
            assert_eq!(centre(x, y).count(), 9);
        }
        assert_eq!(outline.len(), 36);
    }
}
