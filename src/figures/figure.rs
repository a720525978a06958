//! A figure that can be drawn, and the drawing that comes of it: a picture, its numbers and a text.

use super::data::Data;
use super::options::Options;
use crate::error::Result;

/// A figure that can be drawn.
#[derive(Clone, Copy, Debug)]
pub struct Figure {
    /// What it is asked for by, and how its files begin.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// Where the paper has it.
    pub source: &'static str,
    /// Draws it.
    pub draw: fn(&Options) -> Result<Drawing>,
}

/// A figure drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawing {
    /// The picture, a file of its own.
    pub svg: String,
    /// The numbers in it.
    pub tables: Vec<Data>,
    /// What is to be said beside the files.
    pub text: String,
}

impl Drawing {
    /// Names and contents of the files of a figure.
    pub fn files(&self, name: &str) -> Vec<(String, String)> {
        let svg = (format!("{name}.svg"), self.svg.clone());
        let csv = self.tables.iter().map(|t| (format!("{name}{}.csv", t.suffix()), t.csv()));
        std::iter::once(svg).chain(csv).collect()
    }
}
