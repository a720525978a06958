//! Commands that a robot is given sample by sample, and follows in straight lines from one to the next (first-order hold).

use crate::motion::Drive;

/// Commands over time; before the first and behind the last they stay.
#[derive(Clone, Debug, PartialEq)]
pub struct Commands {
    times: Vec<f64>,
    /// A row of inputs a time.
    rows: Vec<Vec<f64>>,
}

impl Commands {
    /// A first command.
    pub fn from(time: f64, row: Vec<f64>) -> Self {
        Self { times: vec![time], rows: vec![row] }
    }

    /// The command that is to be reached at a later time.
    pub fn then(&mut self, time: f64, row: Vec<f64>) {
        self.times.push(time);
        self.rows.push(row);
    }

    /// Every command, the first ahead.
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }
}

impl Drive for Commands {
    fn at(&self, t: f64, value: &mut [f64], slope: &mut [f64]) {
        let i = self.times.partition_point(|k| *k <= t);
        slope.fill(0.0);
        if i == 0 || i == self.times.len() {
            let row = if i == 0 { &self.rows[0] } else { &self.rows[i - 1] };
            value[..row.len()].copy_from_slice(row);
            return;
        }
        let span = self.times[i] - self.times[i - 1];
        let share = (t - self.times[i - 1]) / span;
        for (c, (from, to)) in self.rows[i - 1].iter().zip(&self.rows[i]).enumerate() {
            value[c] = from + share * (to - from);
            slope[c] = (to - from) / span;
        }
    }

    fn knots(&self) -> &[f64] {
        &self.times
    }

    fn channels(&self) -> usize {
        self.rows[0].len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_joined_by_lines_and_stay_at_both_ends() {
        let mut commands = Commands::from(1.0, vec![2.0, 0.0]);
        commands.then(1.5, vec![3.0, -1.0]);
        let at = |t: f64| {
            let (mut value, mut slope) = ([9.0; 2], [9.0; 2]);
            commands.at(t, &mut value, &mut slope);
            (value, slope)
        };
        assert_eq!(at(0.0), ([2.0, 0.0], [0.0; 2]));
        assert_eq!(at(1.25), ([2.5, -0.5], [2.0, -2.0]));
        assert_eq!(at(1.5), ([3.0, -1.0], [0.0; 2]));
        assert_eq!((commands.channels(), commands.knots()), (2, &[1.0, 1.5][..]));
    }
}
