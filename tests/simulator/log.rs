//! What a run leaves behind: the log as its user gets it, and the truth.

use std::fmt::Write as _;
use std::path::Path;

/// The vehicle as it really moved at one logged instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Truth {
    /// Time, s.
    pub t: f64,
    /// Reference point, m.
    pub x: f64,
    /// Reference point, m.
    pub y: f64,
    /// Body heading, rad, not wrapped.
    pub heading: f64,
    /// Absolute headings of the trailers, rad.
    pub trailers: Vec<f64>,
    /// Forward speed over the ground, m/s.
    pub v_l: f64,
    /// Lateral speed over the ground, m/s, left positive.
    pub v_t: f64,
    /// Yaw rate, rad/s.
    pub yaw: f64,
}

/// A run: columns and rows of the log, and the truth of every row.
#[derive(Debug, Clone, PartialEq)]
pub struct Log {
    /// The columns' names.
    pub columns: Vec<String>,
    /// The rows, full precision.
    pub rows: Vec<Vec<f64>>,
    /// What really happened at each row.
    pub truth: Vec<Truth>,
}

impl Log {
    /// One column by its name.
    ///
    /// # Panics
    /// When there is no such column: a test that asks for it is wrong.
    pub fn column(&self, name: &str) -> Vec<f64> {
        let at = self.columns.iter().position(|column| column == name);
        let at = at.unwrap_or_else(|| panic!("no column `{name}` in {:?}", self.columns));
        self.rows.iter().map(|row| row[at]).collect()
    }

    /// The log as CSV text with so many significant digits.
    pub fn to_csv(&self, digits: usize) -> String {
        let mut text = self.columns.join(",");
        text.push('\n');
        for row in &self.rows {
            for (i, value) in row.iter().enumerate() {
                let comma = if i == 0 { "" } else { "," };
                write!(text, "{comma}{}", rounded(*value, digits)).expect("a String takes all");
            }
            text.push('\n');
        }
        text
    }

    /// Writes the log as CSV with nine significant digits.
    pub fn write_csv(&self, path: impl AsRef<Path>) -> std::io::Result<()> {
        std::fs::write(path, self.to_csv(9))
    }
}

/// The nearest number with so many significant decimal digits.
fn rounded(value: f64, digits: usize) -> f64 {
    let text = format!("{value:.*e}", digits.saturating_sub(1));
    // Adding zero turns −0 into 0.
    text.parse::<f64>().expect("a printed number parses") + 0.0
}
