//! The parts a page is built of: sections, figures, tables.

use crate::discrepancy::rendering::patched_state::State;
use crate::picture::svg::{Element, fixed};

/// An element that holds only text.
pub fn holding(name: &'static str, text: impl Into<String>) -> Element {
    Element::new(name).text(text)
}

/// A section with a heading; none where it would be empty.
pub fn section(heading: &str, content: Vec<Element>) -> Option<Element> {
    let body = Element::new("section").child(holding("h2", heading));
    (!content.is_empty()).then(|| body.children(content))
}

/// A part that unfolds: its id, its heading, whether it is open, and what it holds.
pub struct Fold {
    /// Its id.
    pub id: &'static str,
    /// Its heading.
    pub heading: &'static str,
    /// Whether it is open.
    pub open: bool,
    /// What it holds.
    pub content: Vec<Element>,
}

impl Fold {
    /// A part that is open.
    pub fn open(id: &'static str, heading: &'static str, content: impl IntoIterator<Item = Element>) -> Self {
        Self { id, heading, open: true, content: content.into_iter().collect() }
    }

    /// A part that is folded.
    pub fn closed(id: &'static str, heading: &'static str, content: impl IntoIterator<Item = Element>) -> Self {
        Self { open: false, ..Self::open(id, heading, content) }
    }

    fn element(self) -> Element {
        let details = Element::new("details").with("id", self.id);
        let details = if self.open { details.with("open", "") } else { details };
        details.child(Element::new("summary").child(holding("h2", self.heading))).children(self.content)
    }
}

/// Parts that unfold, with links to them before where there shall be such; those without content are left out.
pub fn folds(parts: Vec<Fold>, linked: bool) -> Vec<Element> {
    let full: Vec<Fold> = parts.into_iter().filter(|p| !p.content.is_empty()).collect();
    let links = full.iter().map(|p| holding("a", p.heading).with("href", format!("#{}", p.id)));
    let contents = (linked && !full.is_empty())
        .then(|| Element::new("nav").with("aria-label", "Evidence").child(holding("h2", "Evidence")).children(links));
    contents.into_iter().chain(full.into_iter().map(Fold::element)).collect()
}

/// The first line of a page: a state as a mark with its colour and its name, and what the page is of.
pub fn eyebrow(state: State, name: &str, of: String) -> Element {
    let pill = holding("span", format!("{} {name}", state.mark())).with("class", format!("verdict {}", state.class()));
    Element::new("p").with("class", "eyebrow").child(pill).text(of)
}

/// A row of bars: its name, the words behind it, a bar from one percentage to another, and a line across it at a third.
pub fn bar(look: &str, name: &str, says: String, from: f64, to: f64, line: f64) -> [Element; 3] {
    let (left, width) = (from.min(to), (to - from).abs());
    let place = format!("left:{}%;width:{}%", fixed(left), fixed(width));
    let line = Element::new("b").with("class", "zero").with("style", format!("left:{}%", fixed(line)));
    let fill = Element::new("i").with("class", look).with("style", place);
    [
        holding("span", name).with("class", format!("name {look}")),
        holding("span", says).with("class", "value"),
        Element::new("span").with("class", "length").with("aria-hidden", "true").child(fill).child(line),
    ]
}

/// A figure: drawings in a grid, and a caption that starts with what to see.
pub fn figure(drawings: Vec<Element>, key: Option<Element>, see: &str, how: &str) -> Element {
    let caption = Element::new("figcaption").child(holding("strong", see)).text(format!(" {how}"));
    let class = if drawings.len() == 1 { "panels single" } else { "panels" };
    let panels = Element::new("div").with("class", class).children(drawings);
    Element::new("figure").children(key).child(panels).child(caption)
}

/// A figure of many small drawings, with what to see above them.
pub fn small_figure(drawings: Vec<Element>, see: &str, how: &str) -> Element {
    let caption = Element::new("figcaption").child(holding("strong", see)).text(format!(" {how}"));
    let caption = caption.with("class", "before");
    let panels = Element::new("div").with("class", "panels small").children(drawings);
    Element::new("figure").child(caption).child(panels)
}

/// A cell of a table.
pub enum Cell {
    /// Words.
    Text(String),
    /// Words with files that belong to them: what each is called, and where it lies beside the page.
    Files(String, Vec<(&'static str, String)>),
    /// A number, set to the right.
    Number(String),
    /// A formula.
    Code(String),
    /// A hash: its beginning, and all of it to who asks.
    Hash(String),
    /// Words on several lines.
    Lines(Vec<String>),
}

impl Cell {
    /// A cell with words.
    pub fn text(text: impl Into<String>) -> Self {
        Cell::Text(text.into())
    }

    /// The cell under a heading, which a narrow screen shows before it.
    fn element(self, heading: &str) -> Element {
        let heading = heading.strip_prefix('#').unwrap_or(heading);
        let cell = Element::new("td").with("data-of", heading);
        match self {
            Cell::Text(text) => cell.text(text),
            Cell::Files(text, files) => {
                let link = |(name, at): (&str, String)| holding("a", name).with("class", "file").with("href", at);
                files.into_iter().fold(cell.text(text), |cell, file| cell.text(" ").child(link(file)))
            }
            Cell::Number(text) => cell.with("class", "number").text(text),
            Cell::Code(text) => cell.child(holding("code", text)),
            Cell::Hash(text) => {
                let short: String = text.chars().take(12).collect();
                cell.child(holding("code", short).with("title", text))
            }
            Cell::Lines(lines) => cell.children(lines.into_iter().map(|l| holding("div", l))),
        }
    }
}

/// A table with a caption; a heading that starts with `#` stands over numbers. None where there is no row.
pub fn table(caption: &str, headings: &[&str], rows: Vec<Vec<Cell>>) -> Option<Element> {
    if rows.is_empty() {
        return None;
    }
    let heading = |h: &&str| {
        let cell = Element::new("th").with("scope", "col");
        match h.strip_prefix('#') {
            Some(text) => cell.with("class", "number").text(text),
            None => cell.text(*h),
        }
    };
    let head = Element::new("thead").child(Element::new("tr").children(headings.iter().map(heading)));
    let row = |cells: Vec<Cell>| {
        Element::new("tr").children(cells.into_iter().zip(headings).map(|(cell, heading)| cell.element(heading)))
    };
    let body = Element::new("tbody").children(rows.into_iter().map(row));
    let table = Element::new("table").child(head).child(body);
    let caption = holding("figcaption", caption).with("class", "over");
    Some(Element::new("figure").with("class", "wide").child(caption).child(table))
}
