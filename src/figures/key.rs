//! The legend of a figure in a column.

use crate::picture::maths::{maths, width_of};
use crate::picture::plot::{Marker, mark};
use crate::picture::svg::{Element, path};

/// One kind of line.
#[derive(Clone, Debug)]
pub struct Entry<'a> {
    /// Class of the line.
    pub class: &'a str,
    /// Marker at its end.
    pub marker: Option<Marker>,
    /// Its name, with mathematics.
    pub text: &'a str,
}

/// Length of a sample, room to its name and to the next entry, in pixels.
const SAMPLE: f64 = 26.0;
const GAP: f64 = 5.0;
const NEXT: f64 = 12.0;
/// Letters are narrower than the widest guess.
const LETTERS: f64 = 10.4;

/// Entries in a row from a pixel on.
pub fn row(entries: &[Entry], [left, y]: [f64; 2]) -> Vec<Element> {
    let mut out = Vec::new();
    let mut x = left;
    for entry in entries {
        out.push(path(&format!("line {}", entry.class), &[[x, y], [x + SAMPLE, y]]));
        out.extend(entry.marker.map(|m| mark(entry.class, m, [x + SAMPLE, y])));
        out.push(maths("", [x + SAMPLE + GAP + 2.0, y + 4.0], "start", entry.text));
        x += SAMPLE + GAP + 2.0 + width_of(entry.text, LETTERS) + NEXT;
    }
    out
}

/// Entries below each other from a pixel on.
pub fn column(entries: &[Entry], [left, top]: [f64; 2]) -> Vec<Element> {
    let one = |(i, entry): (usize, &Entry)| row(std::slice::from_ref(entry), [left, top + 16.0 * i as f64]);
    entries.iter().enumerate().flat_map(one).collect()
}
