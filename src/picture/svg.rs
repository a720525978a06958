//! Elements of markup, well-formed by construction; the only place where text is escaped.

use std::fmt;

/// An element with attributes and children, for SVG and for HTML.
///
/// ```
/// use creepage::picture::svg::Element;
/// let e = Element::new("text").number("x", 1.25).with("class", "a\"b").text("<script>");
/// assert_eq!(e.to_string(), "<text x=\"1.3\" class=\"a&quot;b\">&lt;script&gt;</text>");
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    name: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Child>,
}

#[derive(Clone, Debug, PartialEq)]
enum Child {
    Element(Element),
    Text(String),
    Verbatim(String),
}

/// Elements that are written without an end tag when they are empty.
const LEAVES: [&str; 9] = ["br", "circle", "col", "hr", "input", "line", "meta", "path", "rect"];

impl Element {
    /// An empty element.
    pub fn new(name: &'static str) -> Self {
        Self { name, attributes: Vec::new(), children: Vec::new() }
    }

    /// With an attribute.
    pub fn with(mut self, attribute: &'static str, value: impl Into<String>) -> Self {
        self.attributes.push((attribute, value.into()));
        self
    }

    /// With an attribute that is a length in pixels.
    pub fn number(self, attribute: &'static str, value: f64) -> Self {
        self.with(attribute, fixed(value))
    }

    /// With text after what it already holds.
    pub fn text(mut self, text: impl Into<String>) -> Self {
        self.children.push(Child::Text(text.into()));
        self
    }

    /// With a text that is not escaped, for a script, which no markup is read in; what would end it is taken apart.
    pub fn verbatim(mut self, text: impl Into<String>) -> Self {
        self.children.push(Child::Verbatim(text.into().replace("</", "<\\/")));
        self
    }

    /// With an outline of the paper's colour behind every text in it, as an element of its own: programs that do not know
    /// `paint-order` would draw it over the letters.
    pub fn haloed(mut self) -> Self {
        let with_halo = |child: Child| match child {
            Child::Element(text) if text.name == "text" => {
                vec![Child::Element(text.clone().into_halo()), Child::Element(text)]
            }
            Child::Element(other) => vec![Child::Element(other.haloed())],
            other => vec![other],
        };
        self.children = self.children.into_iter().flat_map(with_halo).collect();
        self
    }

    /// The halo of a text, which nobody reads twice.
    fn into_halo(mut self) -> Self {
        match self.attributes.iter_mut().find(|(name, _)| *name == "class") {
            Some((_, class)) => *class = format!("{class} halo").trim_start().to_string(),
            None => self.attributes.push(("class", "halo".into())),
        }
        self.with("aria-hidden", "true")
    }

    /// With an element after what it already holds.
    pub fn child(mut self, element: Element) -> Self {
        self.children.push(Child::Element(element));
        self
    }

    /// With elements after what it already holds.
    pub fn children(mut self, elements: impl IntoIterator<Item = Element>) -> Self {
        self.children.extend(elements.into_iter().map(Child::Element));
        self
    }
}

impl fmt::Display for Element {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "<{}", self.name)?;
        for (name, value) in &self.attributes {
            write!(f, " {name}=\"{}\"", escape(value))?;
        }
        if self.children.is_empty() && LEAVES.contains(&self.name) {
            return f.write_str("/>");
        }
        f.write_str(">")?;
        self.children.iter().try_for_each(|child| write!(f, "{child}"))?;
        write!(f, "</{}>", self.name)
    }
}

impl fmt::Display for Child {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Child::Element(element) => element.fmt(f),
            Child::Text(text) => f.write_str(&escape(text)),
            Child::Verbatim(text) => f.write_str(text),
        }
    }
}

/// Text that stays text inside an element or an attribute; characters that XML forbids become U+FFFD.
///
/// An apostrophe may stay, since attributes are written with quotation marks.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' | '\t' => out.push(c),
            '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c if c.is_control() => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// A coordinate in pixels, rounded to a tenth; what is not finite becomes zero.
pub fn fixed(x: f64) -> String {
    if !x.is_finite() {
        return "0".into();
    }
    let tenths = (x * 10.0).round().clamp(-1e9, 1e9) as i64;
    let sign = if tenths < 0 { "-" } else { "" };
    let (whole, rest) = (tenths.abs() / 10, tenths.abs() % 10);
    if rest == 0 { format!("{sign}{whole}") } else { format!("{sign}{whole}.{rest}") }
}

/// The `d` of a path through points in pixels; a point that is not finite breaks the line.
///
/// ```
/// use creepage::picture::svg::path_data;
/// assert_eq!(path_data(&[[0.0, 0.0], [1.0, 2.5], [f64::NAN, 0.0], [3.0, 4.0]]), "M0 0L1 2.5M3 4");
/// ```
pub fn path_data(points: &[[f64; 2]]) -> String {
    let mut out = String::new();
    let mut pen_down = false;
    for point in points {
        let finite = point.iter().all(|v| v.is_finite());
        if finite {
            out.push(if pen_down { 'L' } else { 'M' });
            out.push_str(&format!("{} {}", fixed(point[0]), fixed(point[1])));
        }
        pen_down = finite;
    }
    out
}

/// A straight line between two points in pixels.
pub fn line(class: &str, from: [f64; 2], to: [f64; 2]) -> Element {
    Element::new("line")
        .with("class", class)
        .number("x1", from[0])
        .number("y1", from[1])
        .number("x2", to[0])
        .number("y2", to[1])
}

/// Text at a point in pixels; `anchor` is `start`, `middle` or `end`.
pub fn label(class: &str, at: [f64; 2], anchor: &str, text: impl Into<String>) -> Element {
    Element::new("text")
        .with("class", class)
        .number("x", at[0])
        .number("y", at[1])
        .with("text-anchor", anchor)
        .text(text)
}

/// A rectangle in pixels; a negative side is drawn as none.
pub fn rect(class: &str, at: [f64; 2], width: f64, height: f64) -> Element {
    Element::new("rect")
        .with("class", class)
        .number("x", at[0])
        .number("y", at[1])
        .number("width", width.max(0.0))
        .number("height", height.max(0.0))
}

/// A path through points in pixels.
pub fn path(class: &str, points: &[[f64; 2]]) -> Element {
    Element::new("path").with("class", class).with("d", path_data(points))
}

/// Text cut to a number of characters, the last one an ellipsis.
pub fn cut(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.into();
    }
    let head: String = text.chars().take(most.saturating_sub(1)).collect();
    format!("{}…", head.trim_end())
}

/// A guess at the width of text in pixels, wide enough for any usual sans-serif font.
pub fn width_of(text: &str, font_size: f64) -> f64 {
    0.6 * font_size * text.chars().count() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_markup_forbids_is_replaced() {
        assert_eq!(escape("a\u{1}b\n\t\u{fffe}\u{ffff}\u{7f}"), "a\u{fffd}b\n\t\u{fffd}\u{fffd}\u{fffd}");
        assert_eq!(escape("<&\">'"), "&lt;&amp;&quot;&gt;'");
    }

    #[test]
    fn a_script_ends_where_it_ends() {
        let script = Element::new("script").verbatim("a < b && '</script>'").to_string();
        assert_eq!(script, "<script>a < b && '<\\/script>'</script>");
    }

    #[test]
    fn every_text_gets_a_halo_behind_it() {
        let drawn = Element::new("svg").child(Element::new("g").child(label("tick", [1.0, 2.0], "end", "x"))).haloed();
        let text = "x=\"1\" y=\"2\" text-anchor=\"end\"";
        let halo = format!("<text class=\"tick halo\" {text} aria-hidden=\"true\">x</text>");
        assert_eq!(drawn.to_string(), format!("<svg><g>{halo}<text class=\"tick\" {text}>x</text></g></svg>"));
    }

    #[test]
    fn only_leaves_are_without_an_end() {
        assert_eq!(Element::new("g").to_string(), "<g></g>");
        assert_eq!(Element::new("path").to_string(), "<path/>");
        assert_eq!(Element::new("path").child(Element::new("title")).to_string(), "<path><title></title></path>");
    }

    #[test]
    fn coordinates_are_rounded_to_tenths() {
        let written = [-0.04, -0.3, -1.25, 2.0, 2.06, f64::NAN, f64::INFINITY, 1e300].map(fixed);
        assert_eq!(written, ["0", "-0.3", "-1.3", "2", "2.1", "0", "0", "100000000"]);
    }

    #[test]
    fn text_is_cut_where_it_does_not_fit() {
        assert_eq!(["abcde", "abcdef", "abc def"].map(|t| cut(t, 5)), ["abcde", "abcd…", "abc…"]);
        assert_eq!([cut("abc", 0), cut("", 0)], ["…", ""]);
        assert_eq!(width_of("abc", 10.0), 18.0);
    }

    #[test]
    fn a_rectangle_has_no_negative_side() {
        let drawn = rect("bar", [1.0, 2.0], -3.0, -4.0).to_string();
        assert_eq!(drawn, "<rect class=\"bar\" x=\"1\" y=\"2\" width=\"0\" height=\"0\"/>");
    }
}
