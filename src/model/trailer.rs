//! A trailer behind a vehicle: its lengths, and the symbol of its heading.

use crate::formula::Symbol;

/// A trailer by its nominal lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trailer {
    /// From its hitch to its axle, m.
    pub length: f64,
    /// The hitch behind the axle ahead of it, m.
    pub hitch: f64,
}

/// The heading of a trailer.
pub fn trailer_heading(i: usize) -> Symbol {
    Symbol::new(&format!("phi_{i}"))
}
