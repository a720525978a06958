//! Columns that were rounded: an encoder's ticks in a row, a message with few digits.

use super::local_polynomial::median;

/// A step larger than this share of the input, root mean square, is worth a word.
const COARSE: f64 = 0.02;
/// What changes in fewer of its rows is a command that is held, which may have any steps.
const BUSY: f64 = 0.02;
/// With fewer changes nothing is said.
const FEWEST: usize = 20;
/// How near to a whole number of steps a change is, as a share of a step.
const WHOLE: f64 = 0.01;

/// The step of a rounded column; `None` where its values are as good as continuous, or commands.
///
/// Every change of a rounded signal is a whole number of steps, and where it is sampled often most are a single one.
pub(crate) fn step_of(column: &[f64]) -> Option<f64> {
    let rows = column.len() as f64;
    let size = (column.iter().map(|u| u * u).sum::<f64>() / rows).sqrt();
    let changes = column.windows(2).map(|w| (w[1] - w[0]).abs());
    let mut changes: Vec<f64> = changes.filter(|c| *c > 1e-9 * size).collect();
    if changes.len() < FEWEST || (changes.len() as f64) < BUSY * rows {
        return None;
    }
    let step = changes.iter().copied().fold(f64::INFINITY, f64::min);
    let is_whole = |c: &f64| (c / step - (c / step).round()).abs() < WHOLE;
    let coarse = step > COARSE * size && changes.iter().all(is_whole);
    (coarse && median(&mut changes)? < 1.5 * step).then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(f: impl Fn(f64) -> f64) -> Vec<f64> {
        (0..1000).map(|i| f(0.02 * f64::from(i))).collect()
    }

    #[test]
    fn a_rounded_signal_has_a_step() {
        let wave = |t: f64| 4.0 + 1.5 * (1.3 * t).sin() + 0.4 * (7.0 * t).cos();
        let rounded = |step: f64| step_of(&sampled(|t| (wave(t) / step).round() * step));
        assert!((rounded(0.3).unwrap() - 0.3).abs() < 1e-9);
        // Digits enough for the input's size.
        assert_eq!(rounded(0.01), None);
        assert_eq!(step_of(&sampled(wave)), None);
        // Printed with few digits it is rounded all the same.
        let printed = |t: f64| format!("{:.1}", wave(t)).parse().unwrap();
        assert!((step_of(&sampled(printed)).unwrap() - 0.1).abs() < 1e-9);
    }

    #[test]
    fn commands_may_have_any_steps() {
        // Held for two seconds each; a switch; nothing at all.
        assert_eq!(step_of(&sampled(|t| [0.5, 1.0, 0.0, 1.5][(0.5 * t) as usize % 4])), None);
        assert_eq!(step_of(&sampled(|t| f64::from(u8::from(t > 3.0)))), None);
        assert_eq!(step_of(&sampled(|_| 0.0)), None);
        // As often as you like, but not by single steps: levels of a joystick.
        assert_eq!(step_of(&sampled(|t| 0.1 * f64::from((37.0 * t * t) as u32 % 11))), None);
        assert_eq!(step_of(&[]), None);
    }

    /// A row more than so many is a step up.
    fn staircase(rows: u32, rows_a_step: u32, from: f64) -> Vec<f64> {
        (0..rows).map(|i| from + f64::from(i / rows_a_step)).collect()
    }

    #[test]
    fn a_step_is_told_where_it_is_large_and_usual() {
        // Twenty changes, and a fiftieth of the rows.
        assert_eq!([20, 21].map(|rows| step_of(&staircase(rows, 1, 0.0))), [None, Some(1.0)]);
        assert_eq!([(1000, 49), (1050, 52)].map(|(n, each)| step_of(&staircase(n, each, 0.0))), [Some(1.0), None]);
        // A fiftieth of the size, root mean square.
        assert_eq!([20.0, 48.0, 100.0].map(|from| step_of(&staircase(100, 3, from))), [Some(1.0), None, None]);
        assert_eq!(step_of(&staircase(100, 3, -60.0)), Some(1.0));
        // In whatever unit.
        for unit in [1e-6, 1e6] {
            let column: Vec<f64> = staircase(100, 3, 0.0).iter().map(|u| unit * u).collect();
            assert!((step_of(&column).unwrap() - unit).abs() < 1e-9 * unit);
        }
    }
}
