//! The numbers of a figure as CSV, rounded so that they are the same on every machine.

/// A table of a figure.
///
/// ```
/// use creepage::figures::{Data, fixed};
/// let mut table = Data::new("paths", &["t [s]", "x [m]"]);
/// table.row([fixed(0.5, 2), fixed(-1e-9, 3)]);
/// assert_eq!((table.suffix().as_str(), table.csv().as_str()), ("-paths", "t [s],x [m]\n0.50,0.000\n"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Data {
    part: &'static str,
    names: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Data {
    /// An empty table; `part` tells the tables of a figure apart and is empty where there is only one.
    pub fn new(part: &'static str, names: &[&str]) -> Self {
        Self { part, names: names.iter().map(ToString::to_string).collect(), rows: Vec::new() }
    }

    /// A table of quantities with their values and units, for a schematic figure.
    pub fn quantities(rows: &[(&str, f64, &str)]) -> Self {
        let mut table = Self::new("", &["quantity", "value", "unit"]);
        rows.iter().for_each(|(name, value, unit)| table.row([(*name).into(), fixed(*value, 6), (*unit).into()]));
        table
    }

    /// Adds a row; a comma within a cell becomes a semicolon.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().map(|c| c.replace(',', ";")).collect());
    }

    /// What stands between the figure's name and the ending of the file.
    pub fn suffix(&self) -> String {
        if self.part.is_empty() { String::new() } else { format!("-{}", self.part) }
    }

    /// The rows without the names.
    pub fn rows(&self) -> &[Vec<String>] {
        &self.rows
    }

    /// The table as CSV.
    pub fn csv(&self) -> String {
        let lines = std::iter::once(&self.names).chain(&self.rows).map(|cells| cells.join(","));
        lines.map(|line| line + "\n").collect()
    }
}

/// A number with so many decimals; zero has no sign, and what is no number is an empty cell.
pub fn fixed(x: f64, decimals: usize) -> String {
    if !x.is_finite() {
        return String::new();
    }
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| c == '0' || c == '.') => rest.into(),
        _ => text,
    }
}

/// A number with so many significant digits, for values of many sizes.
///
/// ```
/// assert_eq!(creepage::figures::scientific(0.000123456, 3), "1.23e-4");
/// ```
pub fn scientific(x: f64, digits: usize) -> String {
    if !x.is_finite() {
        return String::new();
    }
    format!("{x:.*e}", digits.max(1) - 1)
}
