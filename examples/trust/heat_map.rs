//! The confusion matrix as a picture: numbers, and a frame around what is right, so that it reads without colour.

use crate::table::{cell, sides};
use crate::tally::{SILENCE, Tally};
use creepage::picture::plot::{Size, frame_svg};
use creepage::picture::svg::{Element, label, rect};
use creepage::picture::theme;

/// Pixels of a cell, left of the first column, and above the first row.
const CELL: f64 = 27.0;
const LEFT: f64 = 212.0;
const TOP: f64 = 262.0;
/// Pixels right of the last column, where the names of the columns lean to.
const RIGHT: f64 = 130.0;

/// The drawing as a file of its own.
pub fn svg(tally: &Tally) -> String {
    let [rows, columns] = sides(tally);
    let size = Size {
        width: LEFT + CELL * columns.len() as f64 + RIGHT,
        height: TOP + CELL * rows.len() as f64 + 16.0,
        margins: [LEFT, RIGHT, TOP, 16.0],
    };
    let description = format!("False alarms: {}. Coverage: {}.", tally.false_alarms.text(), tally.coverage.text());
    let style = format!("{}\n.right{{fill:none;stroke:var(--ink);stroke-width:1.6}}", theme::drawing());
    let cells = rows.iter().enumerate().flat_map(|(i, row)| line(tally, &columns, i, row));
    frame_svg(size, "trust", "Hidden effects and what was named", &description)
        .with("xmlns", "http://www.w3.org/2000/svg")
        .child(Element::new("style").text(style))
        .child(rect("paper", [0.0, 0.0], size.width, size.height))
        .children(heading(tally))
        .children(columns.iter().enumerate().map(|(i, name)| column_name(i, name)))
        .children(cells)
        .to_string()
        + "\n"
}

fn heading(tally: &Tally) -> Vec<Element> {
    let lines = [
        ("false alarms", tally.false_alarms.text()),
        ("one effect, named rightly", tally.singles.text()),
        ("two effects, both right", tally.pairs.text()),
        ("95 % intervals hold the truth", tally.coverage.text()),
    ];
    let mut out = vec![label("title", [12.0, 26.0], "start", "Hidden (rows) and named (columns)")];
    for (i, (what, text)) in lines.iter().enumerate() {
        let y = 48.0 + 17.0 * i as f64;
        out.push(label("soft", [12.0, y], "start", *what));
        out.push(label("strong", [226.0, y], "start", text));
    }
    out
}

fn column_name(i: usize, name: &str) -> Element {
    let (x, y) = (LEFT + CELL * (i as f64 + 0.5), TOP - 8.0);
    label("", [0.0, 0.0], "start", name).with("transform", format!("translate({x:.1} {y:.1}) rotate(-50)"))
}

fn line(tally: &Tally, columns: &[String], i: usize, row: &str) -> Vec<Element> {
    let y = TOP + CELL * i as f64;
    let name = if row == SILENCE { "(nothing hidden)" } else { row };
    let most = columns.iter().map(|c| cell(tally, row, c)).max().unwrap_or(0).max(1) as f64;
    let mut out = vec![label("", [LEFT - 8.0, y + 0.5 * CELL + 4.5], "end", name)];
    for (k, column) in columns.iter().enumerate() {
        let x = LEFT + CELL * k as f64;
        let n = cell(tally, row, column);
        out.push(rect("grid", [x, y], CELL, CELL).with("fill", "none"));
        if n > 0 {
            let share = n as f64 / most;
            let colour = if row == column { "var(--after)" } else { "var(--before)" };
            let tint = rect("", [x + 1.0, y + 1.0], CELL - 2.0, CELL - 2.0).with("fill", colour);
            out.push(tint.with("fill-opacity", format!("{:.2}", 0.12 + 0.4 * share)));
            out.push(label("strong", [x + 0.5 * CELL, y + 0.5 * CELL + 4.5], "middle", n.to_string()));
        }
        if row == column {
            out.push(rect("right", [x + 1.0, y + 1.0], CELL - 2.0, CELL - 2.0));
        }
    }
    out
}
