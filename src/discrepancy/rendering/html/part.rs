//! The parts a page is built of: sections, figures, tables.

use crate::picture::svg::Element;

/// An element that holds only text.
pub fn holding(name: &'static str, text: impl Into<String>) -> Element {
    Element::new(name).text(text)
}

/// A section with a heading; none where it would be empty.
pub fn section(heading: &str, content: Vec<Element>) -> Option<Element> {
    let body = Element::new("section").child(holding("h2", heading));
    (!content.is_empty()).then(|| body.children(content))
}

/// A part that unfolds.
pub fn fold(id: &str, heading: &str, open: bool, content: Vec<Element>) -> Element {
    let details = Element::new("details").with("id", id);
    let details = if open { details.with("open", "") } else { details };
    details.child(Element::new("summary").child(holding("h2", heading))).children(content)
}

/// A figure: drawings in a grid, and a caption that starts with what to see.
pub fn figure(drawings: Vec<Element>, key: Option<Element>, see: &str, how: &str) -> Element {
    let caption = Element::new("figcaption").child(holding("strong", see)).text(format!(" {how}"));
    let class = if drawings.len() == 1 { "panels single" } else { "panels" };
    let panels = Element::new("div").with("class", class).children(drawings);
    Element::new("figure").children(key).child(panels).child(caption)
}

/// A cell of a table.
pub enum Cell {
    /// Words.
    Text(String),
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
