//! Signed motion ratios: ways along the heading and turns, as measured beside as reckoned.

use crate::discrepancy::record::angle::wrapped;
use crate::discrepancy::record::run_record::Record;
use nalgebra::Complex;
use std::f64::consts::SQRT_2;

/// Durations of a window, s: the first one in which the vehicle leaves the noise of its position.
const DURATIONS: [f64; 5] = [1.0, 2.0, 4.0, 8.0, 16.0];
/// Ways so many times the noise of a position have left it.
const OUT_OF_NOISE: f64 = 20.0;
/// Windows that tell anything.
const FEWEST: usize = 8;
/// A vehicle that turns less, root mean square, says nothing of its turns, rad/s.
const TURNING: f64 = 0.05;
/// Turns of a path so many times what the noise of its positions makes have left it.
const TURNS_OUT_OF_NOISE: f64 = 5.0;
/// A path that turns by more from one window to the next turns back, to no side, rad.
const BACK: f64 = 2.5;
/// Ways shorter than this share of the usual one have no direction.
const SHORT: f64 = 0.3;
/// Motion beyond so many times that of nine windows in ten is a jump of the reference.
const JUMP: f64 = 5.0;

/// A window's motion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    /// Displacement, forward and to the left; without a heading forward alone, its length.
    moved: Complex<f64>,
    /// Turn, rad; without a heading that of the way since the window before.
    pub(super) turn: Option<f64>,
}

impl Motion {
    /// The turns of windows that turn in both.
    pub fn turned(reckoned: &[Self], measured: &[Self]) -> impl Iterator<Item = [f64; 2]> {
        reckoned.iter().zip(measured).filter_map(|(r, m)| Some([r.turn?, m.turn?]))
    }
}

/// The windows of a run over which motions are compared.
pub(crate) struct Windows {
    rows: Vec<(usize, usize)>,
    seconds: f64,
    noise: f64,
    has_heading: bool,
}

/// What was measured beside what was reckoned; none of what hardly moves, or hardly turns, in both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SignedRatios {
    /// Of the ways.
    pub way: Option<Ratio>,
    /// Of the turns.
    pub turn: Option<Ratio>,
}

/// Measured on reckoned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratio {
    /// Σ reckoned·measured / Σ reckoned².
    pub slope: f64,
    /// √(Σ measured² / Σ reckoned²).
    pub size: f64,
    /// Σ |measured − reckoned|² / (Σ measured² + Σ reckoned²): 0 where both agree, 1 where they have nothing to do with one
    /// another, 2 where one is the reverse of the other.
    pub unexplained: f64,
    /// The slope about the means, and what share of the sum of squares is about them.
    pub varied: [f64; 2],
}

impl Windows {
    /// Of a run that moves out of its noise; none of another. Without a heading they are as long as its turns need to leave
    /// it as well, where any are.
    pub fn of(record: &Record) -> Option<Self> {
        let noise = record.position_noise();
        let [first, last] = record.span();
        let longest = last - first;
        let mut far = None;
        for seconds in DURATIONS.into_iter().filter(|s| s * FEWEST as f64 <= longest) {
            let windows = Self { rows: rows(record, seconds), seconds, noise, has_heading: record.has_heading() };
            let path = windows.motions([&record.columns[0], &record.columns[1]], None);
            let is_far = usual_way(&path) > OUT_OF_NOISE * SQRT_2 * noise;
            if windows.rows.len() < FEWEST || !is_far {
                continue;
            }
            if record.has_heading() || windows.path_turns(&path) {
                return Some(windows);
            }
            far.get_or_insert(windows);
        }
        far
    }

    /// Whether a path turns out of its noise.
    fn path_turns(&self, path: &[Motion]) -> bool {
        let turns: Vec<f64> = path.iter().filter_map(|m| m.turn).collect();
        let square = turns.iter().map(|t| t * t).sum::<f64>() / turns.len().max(1) as f64;
        turns.len() >= FEWEST && square.sqrt() > self.least_turn(path)
    }

    /// Turns within a window that say anything, root mean square, rad.
    ///
    /// Of a path a turn is that between two ways in a row, (p₂ − p₁) − (p₁ − p₀) over a way: the noise σ of its positions
    /// makes √6·σ over a way of it.
    fn least_turn(&self, measured: &[Motion]) -> f64 {
        let of_noise = 6.0_f64.sqrt() * self.noise / usual_way(measured).max(f64::MIN_POSITIVE);
        let of_path = if self.has_heading { 0.0 } else { TURNS_OUT_OF_NOISE * of_noise };
        (TURNING * self.seconds).max(of_path)
    }

    /// The motions of a pose.
    pub fn motions(&self, [x, y]: [&[f64]; 2], heading: Option<&[f64]>) -> Vec<Motion> {
        let moved = |(from, to): (usize, usize)| Complex::new(x[to] - x[from], y[to] - y[from]);
        let usual =
            (self.rows.iter().map(|w| moved(*w).norm_sqr()).sum::<f64>() / self.rows.len().max(1) as f64).sqrt();
        let one = |(k, (from, to)): (usize, &(usize, usize))| match heading {
            Some(h) => {
                let along = moved((*from, *to)) * Complex::from_polar(1.0, -0.5 * (h[*from] + h[*to]));
                Motion { moved: along, turn: Some(h[*to] - h[*from]) }
            }
            None => {
                let here = moved((*from, *to));
                let before = k.checked_sub(1).map(|k| self.rows[k]).filter(|w| w.1 == *from).map(moved);
                let is_long = |d: &Complex<f64>| d.norm() > SHORT * usual;
                let turn = before.filter(is_long).filter(|_| is_long(&here)).map(|d| wrapped((here * d.conj()).arg()));
                let turn = turn.filter(|turn| turn.abs() < BACK);
                Motion { moved: Complex::new(here.norm(), 0.0), turn }
            }
        };
        self.rows.iter().enumerate().map(one).collect()
    }

    /// The same of positions in another unit, of so many metres each.
    pub fn in_unit(&self, metres: f64) -> Self {
        Self { rows: self.rows.clone(), noise: metres * self.noise, ..*self }
    }

    /// Measured beside reckoned.
    pub fn ratios(&self, reckoned: &[Motion], measured: &[Motion]) -> SignedRatios {
        let mut sizes: Vec<f64> = measured.iter().map(|m| m.moved.norm()).collect();
        let most = (sizes.len() * 9 / 10).min(sizes.len() - 1);
        let jump = JUMP * *sizes.select_nth_unstable_by(most, f64::total_cmp).1;
        let pairs = || reckoned.iter().zip(measured).filter(|(_, m)| m.moved.norm() <= jump);
        let ways: Vec<_> = pairs().map(|(r, m)| [r.moved, m.moved]).collect();
        let turns: Vec<_> =
            pairs().filter_map(|(r, m)| Some([r.turn?, m.turn?].map(|turn| Complex::new(turn, 0.0)))).collect();
        SignedRatios {
            way: Ratio::of(&ways, OUT_OF_NOISE * self.noise),
            turn: Ratio::of(&turns, self.least_turn(measured)),
        }
    }

    /// How much of the measured turning is not in proportion to the measured way, and its root mean square, rad/s.
    pub fn turning_of_its_own(&self, measured: &[Motion]) -> [f64; 2] {
        let each: Vec<[f64; 2]> = measured.iter().filter_map(|m| Some([m.moved.re, m.turn?])).collect();
        let sum = |a: usize, b: usize| each.iter().map(|m| m[a] * m[b]).sum::<f64>();
        let (ways, turns, both) = (sum(0, 0), sum(1, 1), sum(0, 1));
        let share = 1.0 - both * both / (ways * turns).max(f64::MIN_POSITIVE);
        [share, (turns / each.len().max(1) as f64).sqrt() / self.seconds]
    }
}

/// Root mean square of ways, m.
fn usual_way(path: &[Motion]) -> f64 {
    (path.iter().map(|m| m.moved.norm_sqr()).sum::<f64>() / path.len().max(1) as f64).sqrt()
}

fn rows(record: &Record, seconds: f64) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    for segment in record.segments(0.0) {
        let mut start = segment.start;
        for i in segment {
            if record.time[i] - record.time[start] >= seconds - 0.5 * record.step() {
                found.push((start, i));
                start = i;
            }
        }
    }
    found
}

impl Ratio {
    /// Of pairs of which one is larger than a floor, root mean square.
    fn of(pairs: &[[Complex<f64>; 2]], floor: f64) -> Option<Self> {
        let n = pairs.len() as f64;
        let product = |a: Complex<f64>, b: Complex<f64>| (a.conj() * b).re;
        let sum = |a: usize, b: usize| pairs.iter().map(|p| product(p[a], p[b])).sum::<f64>();
        let [rr, rm, mm] = [sum(0, 0), sum(0, 1), sum(1, 1)];
        if pairs.len() < FEWEST || rr.max(mm) < n * floor * floor {
            return None;
        }
        let mean = [0, 1].map(|k| pairs.iter().map(|p| p[k]).sum::<Complex<f64>>() / n);
        let about = |a: usize, b: usize, all: f64| all - n * product(mean[a], mean[b]);
        let varied =
            [about(0, 1, rm) / about(0, 0, rr).max(f64::MIN_POSITIVE), about(0, 0, rr) / rr.max(f64::MIN_POSITIVE)];
        let (slope, size) = (rm / rr.max(f64::MIN_POSITIVE), (mm / rr.max(f64::MIN_POSITIVE)).sqrt());
        Some(Self { slope, size, unexplained: (rr + mm - 2.0 * rm) / (rr + mm), varied })
    }
}

impl SignedRatios {
    /// The ratios there are.
    pub fn each(&self) -> impl Iterator<Item = Ratio> {
        self.way.into_iter().chain(self.turn)
    }

    /// The largest unexplained share.
    pub fn unexplained(&self) -> f64 {
        self.each().map(|r| r.unexplained).fold(0.0, f64::max)
    }
}
