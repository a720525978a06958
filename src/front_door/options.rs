//! Options of a discovery, each with the value that is usual.

use crate::files::Run;

/// How [`discover_with`](crate::discover_with) works; `Options::default()` is what [`discover`](crate::discover) takes.
///
/// | field | unit | meaning |
/// |---|---|---|
/// | `held_out` | | runs that are only judged; where there are none, the last quarter of every run |
/// | `horizons` | s | horizons of the gap; 1, 5 and 30 where there are none |
/// | `seed` | | seed of the noise floor's random numbers |
/// | `clock_offset` | s | about where the clock of the poses reads against that of the inputs, for runs logged in two files |
///
/// ```
/// let options = creepage::Options { horizons: vec![2.0], ..Default::default() };
/// assert_eq!(options.seed, 0);
/// ```
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Runs that are only judged, opened after the last choice is made.
    pub held_out: Vec<Run>,
    /// Horizons of the gap, s.
    pub horizons: Vec<f64>,
    /// Seed of the noise floor's random numbers.
    pub seed: u64,
    /// About where the clock of the poses reads against that of the inputs, s.
    pub clock_offset: Option<f64>,
}
