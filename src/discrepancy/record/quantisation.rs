//! Columns that were rounded: an encoder's ticks in a row, a message with few digits.

use super::local_polynomial::median;
use crate::numerics::usual_step;

/// A step larger than this share of the input, root mean square, is worth a word.
const COARSE: f64 = 0.02;
/// What changes in fewer of its rows is a command that is held, which may have any steps, but for a staircase.
const BUSY: f64 = 0.02;
/// Of the changes of a staircase so many are a single step, and it has so many levels.
const SINGLE: f64 = 0.95;
const LEVELS: usize = 6;
/// With fewer changes nothing is said.
const FEWEST: usize = 20;
/// With so many the data may be asked whether a staircase is a rounded signal.
const FEWEST_OF_STAIRCASE: usize = 4;
/// How near to a whole number of steps a change is, as a share of a step.
const WHOLE: f64 = 0.01;

/// The step of a rounded column; `None` where its values are as good as continuous, or commands.
pub(crate) fn step_of(column: &[f64]) -> Option<f64> {
    rounding(column, COARSE).filter(|r| r.is_busy && r.is_slow).map(|r| r.step)
}

/// The step of a rounded column, if it is larger than a share of the column, root mean square; of a staircase, too, which is
/// a slow signal rounded, or commands that look like one, and, where it may be fast, of a signal that crosses several steps
/// from row to row and has so many levels that no command does.
pub(crate) fn step_above(column: &[f64], share: f64, may_be_fast: bool) -> Option<f64> {
    let is_fine = |r: &Rounding| may_be_fast && r.is_busy && levels(column, r.step) as f64 >= MANY;
    rounding(column, share).filter(|r| r.is_slow || is_fine(r)).map(|r| r.step)
}

/// What a rounded column is like.
struct Rounding {
    step: f64,
    /// Whether it changes too often to be held.
    is_busy: bool,
    /// Whether most of its changes are a single step.
    is_slow: bool,
}

/// The rounding of a column: every change is a whole number of steps.
fn rounding(column: &[f64], share: f64) -> Option<Rounding> {
    let size = root_mean_square(column);
    let (mut changes, step) = changes(column, size);
    let singles = changes.iter().filter(|c| **c < 1.5 * step).count() as f64;
    let is_busy = changes.len() as f64 >= BUSY * column.len() as f64;
    let is_staircase = || singles >= SINGLE * changes.len() as f64 && levels(column, step) >= LEVELS;
    if changes.len() < FEWEST || !(is_busy || is_staircase()) {
        return None;
    }
    let is_whole = |c: &f64| (c / step - (c / step).round()).abs() < WHOLE;
    let coarse = step > share * size && changes.iter().all(is_whole);
    let is_slow = median(&mut changes)? < 1.5 * step;
    coarse.then_some(Rounding { step, is_busy, is_slow })
}

/// The sizes of the changes from row to row, where there are any, and the least of them.
fn changes(column: &[f64], size: f64) -> (Vec<f64>, f64) {
    let each = column.windows(2).map(|w| (w[1] - w[0]).abs());
    let changes: Vec<f64> = each.filter(|c| *c > 1e-9 * size).collect();
    let least = changes.iter().copied().fold(f64::INFINITY, f64::min);
    (changes, least)
}

/// The step of a column whose every change is up or down by the same: a slow signal rounded, or commands.
pub(crate) fn staircase_step(column: &[f64]) -> Option<f64> {
    let (changes, step) = changes(column, root_mean_square(column));
    let is_single = changes.iter().all(|c| (c / step - 1.0).abs() < WHOLE);
    (changes.len() >= FEWEST_OF_STAIRCASE && is_single).then_some(step)
}

/// √(Σ u²/n); no number without any.
pub(crate) fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|u| u * u).sum::<f64>() / values.len() as f64).sqrt()
}

/// How many levels so far apart a column has.
fn levels(column: &[f64], step: f64) -> usize {
    let mut sorted = column.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup_by(|a, b| (*a - *b).abs() < 0.5 * step);
    sorted.len()
}

/// A tick is told where it is at least this share of what is counted between rows, root mean square.
const FINEST: f64 = 0.002;
/// Counts between rows, root mean square, or levels that a person's commands do not have: so many are an encoder's.
const MANY: f64 = 30.0;
/// Share of the intervals that need not be whole: after rows that were lost a mean is that of the last of them.
const LOST: f64 = 0.1;
/// Share of the counts that are odd, at least: of half a tick all would be even.
const ODD: f64 = 0.05;
/// Distances between levels that are tried as the tick.
const TRIED: usize = 20;

/// The distance between two ticks of a counter whose means between rows are a column; `None` where it counts nothing.
///
/// What was counted between two rows is a whole number of ticks, whatever the time between them.
pub(crate) fn tick_of(time: &[f64], means: &[f64]) -> Option<f64> {
    let intervals: Vec<f64> = time.windows(2).map(|w| w[1] - w[0]).collect();
    let counted: Vec<f64> = intervals.iter().zip(means.iter().skip(1)).map(|(dt, u)| dt * u).collect();
    let size = root_mean_square(&counted);
    let mut levels = counted.clone();
    levels.sort_by(f64::total_cmp);
    let mut gaps: Vec<f64> = levels.windows(2).map(|w| w[1] - w[0]).filter(|gap| *gap > FINEST * size).collect();
    gaps.sort_by(f64::total_cmp);
    gaps.dedup_by(|a, b| *a < (1.0 + WHOLE) * *b);
    // Commands and rounded values come in steps of their own, and what they sum up to does where the intervals are alike;
    // a counter that is a tick too high is one too low soon after.
    let usual = usual_step(time)?;
    let alike = intervals.iter().filter(|dt| (**dt - usual).abs() < WHOLE * usual).count() as f64;
    let may_be_commands = alike > (1.0 - LOST) * intervals.len() as f64;
    gaps.into_iter().take(TRIED).find(|gap| {
        let changes = changes_of_counts(&counted, *gap);
        changes.is_some_and(|c| !may_be_commands || size > MANY * gap || alternates(&c))
    })
}

/// Whether changes are single and one up mostly follows one down.
fn alternates(changes: &[f64]) -> bool {
    let turns = changes.windows(2).filter(|w| w[0] * w[1] < 0.0).count();
    let usual = median(&mut changes.iter().map(|c| c.abs()).collect::<Vec<f64>>());
    usual.is_some_and(|c| c < 1.5) && 2 * turns > changes.len()
}

/// What the counts change by where they change, if what was counted is in whole numbers of a distance, as a counter's are.
fn changes_of_counts(counted: &[f64], gap: f64) -> Option<Vec<f64>> {
    let is_whole = |w: &&f64| (**w / gap - (**w / gap).round()).abs() < WHOLE;
    let whole: Vec<f64> = counted.iter().filter(is_whole).map(|w| (w / gap).round()).collect();
    let all = counted.len() as f64;
    let odd = whole.iter().filter(|n| n.rem_euclid(2.0) == 1.0).count() as f64;
    let changes: Vec<f64> = whole.windows(2).map(|w| w[1] - w[0]).filter(|c| *c != 0.0).collect();
    let is_busy = changes.len() >= FEWEST && changes.len() as f64 >= BUSY * all;
    (is_busy && whole.len() as f64 >= (1.0 - LOST) * all && odd >= ODD * all).then_some(changes)
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

    /// A signal that crosses several steps in a row is rounded by its many levels; a joystick has few.
    #[test]
    fn a_fast_signal_is_rounded_by_its_levels() {
        let fast = |step: f64| sampled(|t| ((4.0 * (5.0 * t).sin() + 3.0 * (8.3 * t).cos()) / step).round() * step);
        assert!((step_above(&fast(0.05), 0.002, true).unwrap() - 0.05).abs() < 1e-9);
        assert_eq!(step_of(&fast(0.05)), None);
        // A counter's means may lie on a grid by chance.
        assert_eq!(step_above(&fast(0.05), 0.002, false), None);
        assert_eq!(step_above(&sampled(|t| 0.1 * f64::from((37.0 * t * t) as u32 % 11)), 0.002, true), None);
        assert_eq!(step_above(&sampled(|t| 4.0 * (5.0 * t).sin()), 0.002, true), None);
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
        // Rarer, if it goes up and down by single steps over many levels, as no command does.
        let rare = |most: u32| -> Vec<f64> {
            (0..20_000).map(|i| 5.0 + f64::from(most) * (1e-3 * f64::from(i)).sin()).map(f64::round).collect()
        };
        assert_eq!([1, 4].map(|most| step_above(&rare(most), COARSE, false)), [None, Some(1.0)]);
        assert_eq!(step_of(&rare(4)), None);
        // A fiftieth of the size, root mean square.
        assert_eq!([20.0, 48.0, 100.0].map(|from| step_of(&staircase(100, 3, from))), [Some(1.0), None, None]);
        assert_eq!(step_of(&staircase(100, 3, -60.0)), Some(1.0));
        // In whatever unit.
        for unit in [1e-6, 1e6] {
            let column: Vec<f64> = staircase(100, 3, 0.0).iter().map(|u| unit * u).collect();
            assert!((step_of(&column).unwrap() - unit).abs() < 1e-9 * unit);
        }
    }

    /// Commands may be a staircase as well: that is for the data to say.
    #[test]
    fn a_staircase_goes_up_and_down_by_one_step() {
        let wave = |of: f64| sampled(move |t| ((0.07 * (0.9 * t).sin() + 0.04 * (2.3 * t).cos()) / of).round() * of);
        assert!((staircase_step(&wave(0.1)).unwrap() - 0.1).abs() < 1e-9);
        assert_eq!(staircase_step(&sampled(|t| [0.3, 0.0, -0.3, 0.0][(0.5 * t) as usize % 4])), Some(0.3));
        // Two steps at once, too few changes, none.
        assert_eq!(staircase_step(&sampled(|t| [0.5, 1.0, 0.0, 1.5][(0.5 * t) as usize % 4])), None);
        assert_eq!(staircase_step(&[0.0, 1.0, 2.0, 1.0]), None);
        assert_eq!(staircase_step(&[0.3; 100]), None);
    }

    /// Means of an encoder whose ticks are so far apart, counted over intervals that differ.
    fn counted(tick: f64, intervals: &[f64], speed: impl Fn(f64) -> f64) -> Vec<f64> {
        let (mut t, mut angle, mut last) = (0.0, 0.3 * tick, 0.0);
        let mut mean = |dt: &f64| {
            angle += dt * speed(t + 0.5 * dt);
            t += dt;
            let ticks = (angle / tick).floor();
            (ticks - std::mem::replace(&mut last, ticks)) * tick / dt
        };
        intervals.iter().map(&mut mean).collect()
    }

    fn summed(intervals: &[f64]) -> Vec<f64> {
        intervals
            .iter()
            .scan(0.0, |t, dt| {
                *t += dt;
                Some(*t)
            })
            .collect()
    }

    /// The means of a counter are on no grid where the intervals differ; what was counted is.
    #[test]
    fn a_counter_has_a_tick_whatever_the_intervals() {
        let regular = vec![0.02; 1000];
        let uneven: Vec<f64> = (0..1000).map(|i| 0.02 + 0.008 * f64::sin(f64::from(i * i))).collect();
        let tick_of = |intervals: &[f64], means: &[f64]| super::tick_of(&summed(intervals), means);
        let wave = |t: f64| 4.0 + 1.5 * (1.3 * t).sin();
        for intervals in [&regular, &uneven] {
            for tick in [0.08, 0.01, 0.001] {
                let found = tick_of(intervals, &counted(tick, intervals, wave)).unwrap();
                assert!((found / tick - 1.0).abs() < 1e-6, "{tick}: {found}");
            }
            // So many that none shows, and what was never counted.
            assert_eq!(tick_of(intervals, &counted(1e-5, intervals, wave)), None);
            assert_eq!(tick_of(intervals, &sampled(wave)), None);
        }
        // Backwards, and after lost rows whose counts nobody has.
        let mut both = counted(0.01, &uneven, |t| 3.0 * (0.5 * t).sin());
        both.iter_mut().step_by(11).for_each(|u| *u *= 0.73);
        assert!((tick_of(&uneven, &both).unwrap() / 0.01 - 1.0).abs() < 1e-6);
        both.iter_mut().skip(1).step_by(11).for_each(|u| *u *= 0.73);
        assert_eq!(tick_of(&uneven, &both), None);
    }

    #[test]
    fn commands_count_nothing() {
        let regular: Vec<f64> = (0..1000).map(|i| 0.02 * f64::from(i)).collect();
        assert_eq!(tick_of(&regular, &sampled(|t| [0.5, 1.0, 0.0, 1.5][(0.5 * t) as usize % 4])), None);
        assert_eq!(tick_of(&regular, &sampled(|t| 0.1 * f64::from((37.0 * t * t) as u32 % 11))), None);
        assert_eq!(tick_of(&regular, &sampled(|_| 0.0)), None);
        // Rounded it is not counted.
        assert_eq!(tick_of(&regular, &sampled(|t| ((4.0 + 1.5 * (1.3 * t).sin()) / 0.3).round() * 0.3)), None);
        assert_eq!(tick_of(&[], &[]), None);
    }
}
