//! Covariates of runs: tags as contrasts to the most common level (Searle 1987, treatment coding), numbers and dates as
//! slopes about their mean.

use crate::files::iso_8601;
use std::collections::{BTreeMap, BTreeSet};

/// Nanoseconds of a day.
const DAY: f64 = 86_400e9;

/// A tag of the runs as columns of a design.
#[derive(Clone, Debug, PartialEq)]
pub struct Covariate {
    /// The tag.
    pub tag: String,
    /// What its columns are.
    pub kind: Kind,
    /// The columns of each run.
    pub rows: Vec<Vec<f64>>,
}

/// What the columns of a covariate are.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// One column: the number less its mean.
    Number {
        /// The mean that was subtracted.
        mean: f64,
    },
    /// One column: days since the mean date.
    Date,
    /// A column for each level but the most common one.
    Levels {
        /// The most common level.
        against: String,
        /// The others, in the order of their columns.
        levels: Vec<String>,
    },
}

impl Covariate {
    /// Its columns.
    pub fn width(&self) -> usize {
        self.rows.first().map_or(0, Vec::len)
    }

    /// The tag of runs as a covariate; none where a run lacks it, all are alike, or nearly every run has a value of its own.
    pub fn of(tag: &str, values: &[Option<&str>]) -> Option<Self> {
        let values: Option<Vec<&str>> = values.iter().map(|v| v.filter(|v| !v.is_empty())).collect();
        let values = values?;
        let distinct: BTreeSet<&str> = values.iter().copied().collect();
        if distinct.len() < 2 {
            return None;
        }
        let numbers: Option<Vec<f64>> = values.iter().map(|v| v.parse().ok().filter(|v: &f64| v.is_finite())).collect();
        if let Some(numbers) = numbers.filter(|_| distinct.len() > 2) {
            let mean = numbers.iter().sum::<f64>() / numbers.len() as f64;
            return Some(Self::slope(tag, Kind::Number { mean }, &numbers, mean));
        }
        let days: Option<Vec<f64>> = values.iter().map(|v| days(v)).collect();
        if let Some(days) = days {
            let mean = days.iter().sum::<f64>() / days.len() as f64;
            return Some(Self::slope(tag, Kind::Date, &days, mean));
        }
        Self::contrasts(tag, &values)
    }

    fn slope(tag: &str, kind: Kind, values: &[f64], mean: f64) -> Self {
        Self { tag: tag.into(), kind, rows: values.iter().map(|v| vec![v - mean]).collect() }
    }

    fn contrasts(tag: &str, values: &[&str]) -> Option<Self> {
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        values.iter().for_each(|v| *counts.entry(v).or_default() += 1);
        if counts.values().any(|n| *n < 2) || counts.len() > (values.len() / 5).max(2) {
            return None;
        }
        let against = counts.iter().max_by(|a, b| a.1.cmp(b.1).then(b.0.cmp(a.0)))?.0.to_string();
        let levels: Vec<String> = counts.keys().filter(|l| **l != against).map(|l| l.to_string()).collect();
        let row = |v: &&str| levels.iter().map(|l| f64::from(u8::from(l == v))).collect();
        Some(Self { tag: tag.into(), rows: values.iter().map(row).collect(), kind: Kind::Levels { against, levels } })
    }
}

/// Days since 1970 of a date, with a time of day behind it or without.
pub fn days(text: &str) -> Option<f64> {
    let found = iso_8601(text).or_else(|| iso_8601(&format!("{text}T00:00:00")));
    found.map(|nanoseconds| nanoseconds as f64 / DAY)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(values: &[&str]) -> Option<Covariate> {
        Covariate::of("tag", &values.iter().map(|v| Some(*v)).collect::<Vec<_>>())
    }

    #[test]
    fn dates_are_days() {
        assert_eq!(
            ["1970-01-01", "2026-11-28", "2024-03-01T08:00:00Z"].map(days),
            [Some(0.0), Some(20785.0), Some(19783.0 + 1.0 / 3.0)]
        );
        assert_eq!(["2026-13-01", "28.11.2026", "2026-1-1", "soon"].map(days), [None; 4]);
        let dated = of(&["2026-01-01", "2026-01-03", "2026-01-05"]).unwrap();
        assert_eq!((dated.kind, dated.rows), (Kind::Date, vec![vec![-2.0], vec![0.0], vec![2.0]]));
    }

    #[test]
    fn numbers_are_slopes_and_words_are_contrasts_to_the_most_common() {
        assert_eq!(of(&["1", "2", "6"]).unwrap().kind, Kind::Number { mean: 3.0 });
        let floor = of(&["tile", "tile", "wood", "tile", "wood"]).unwrap();
        assert_eq!(floor.rows.concat(), [0.0, 0.0, 1.0, 0.0, 1.0]);
        let Kind::Levels { against, levels } = floor.kind else { panic!() };
        assert_eq!((against.as_str(), levels), ("tile", vec!["wood".to_string()]));
    }

    #[test]
    fn what_tells_runs_apart_one_by_one_or_not_at_all_is_no_covariate() {
        assert_eq!(of(&["a", "a", "a"]), None);
        assert_eq!(of(&["a", "b", "c", "d", "e", "f"]), None);
        assert_eq!(Covariate::of("tag", &[Some("1"), None, Some("3")]), None);
    }
}
