//! The first rows of a log, looked at column by column.

use crate::files::{Cell, is_iso_8601};

/// What the first rows of a column hold.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sample {
    /// Its finite numbers, in the order of the rows.
    pub numbers: Vec<f64>,
    /// Cells that are a date with a time of day.
    dates: usize,
    /// Cells that are not blank.
    filled: usize,
}

impl Sample {
    /// One for each column of the header.
    pub fn of(columns: usize, rows: &[Vec<String>]) -> Vec<Self> {
        let one = |c: usize| {
            let cells = rows.iter().filter_map(|row| row.get(c)).map(String::as_str);
            let mut found = Self::default();
            for cell in cells {
                match Cell::read(cell.as_bytes()) {
                    Cell::Blank => continue,
                    Cell::Number(value) => found.numbers.push(value),
                    _ => {}
                }
                found.filled += 1;
                found.dates += usize::from(is_iso_8601(cell));
            }
            found
        };
        (0..columns).map(one).collect()
    }

    /// Whether it can hold a quantity: nothing is known of it, or it holds numbers.
    pub fn may_hold_numbers(&self) -> bool {
        self.filled == 0 || 2 * self.numbers.len() > self.filled
    }

    /// Whether it holds dates.
    pub fn holds_dates(&self) -> bool {
        2 * self.dates > self.filled
    }

    /// Whether it never changes.
    pub fn is_constant(&self) -> bool {
        self.numbers.len() > 2 && self.numbers.iter().all(|v| *v == self.numbers[0])
    }

    /// Whether it rises from row to row.
    pub fn rises(&self) -> bool {
        self.numbers.len() > 2 && self.numbers.windows(2).all(|w| w[1] > w[0])
    }

    /// Whether it holds whole numbers alone.
    pub fn is_whole(&self) -> bool {
        !self.numbers.is_empty() && self.numbers.iter().all(|v| v.fract() == 0.0)
    }

    /// Whether it looks like a cumulative count: whole numbers that never go back, over many.
    pub fn is_count(&self) -> bool {
        let on = self.numbers.windows(2).all(|w| w[1] >= w[0]) || self.numbers.windows(2).all(|w| w[1] <= w[0]);
        self.numbers.len() > 20
            && self.is_whole()
            && on
            && (self.numbers[self.numbers.len() - 1] - self.numbers[0]).abs() > 200.0
    }

    /// The largest absolute value.
    pub fn largest(&self) -> f64 {
        self.numbers.iter().fold(0.0, |most, v| most.max(v.abs()))
    }

    /// The usual step from row to row.
    pub fn step(&self) -> f64 {
        let mut steps: Vec<f64> = self.numbers.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
        steps.sort_by(f64::total_cmp);
        steps.get(steps.len() / 2).copied().unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_for_nothing_is_no_cell() {
        let rows: Vec<Vec<String>> = ["1.5", "nan", "NA", "", "2.5", "null"].map(|c| vec![c.to_string()]).to_vec();
        let [sample] = &Sample::of(1, &rows)[..] else { panic!("one column") };
        assert!(sample.may_hold_numbers() && sample.numbers == [1.5, 2.5]);
    }
}
