//! The clocks to a tenth of a second: offset and drift at which the motion of both files agrees best.

use super::speed_profile::{Driven, Measured, SPAN};
use crate::files::Clock;
use rayon::prelude::*;

/// Grid of the motion that is compared, s.
const GRID: f64 = 0.2;
/// Grid of the offsets that are tried, s.
const STEP: f64 = 0.1;
/// Longest piece of the inputs that is looked for among all poses, s: longer ones cannot be rigid if clocks drift.
const PIECE: f64 = 120.0;
/// Largest drift that is looked for, seconds a second.
const MOST_DRIFT: f64 = 0.03;
/// A drift that moves the ends of a piece by less than this makes no difference, s.
const SLACK: f64 = 0.3;
/// Shorter files do not tell which offset is theirs, s.
pub(crate) const SHORTEST: f64 = 10.0;
/// Least overlap of both files, s, and as a share of the shorter one.
const OVERLAP: [f64; 2] = [SHORTEST, 0.5];
/// Offsets this close are one, s.
const APART: f64 = 1.5;
/// Offsets that are looked at closely.
const KEPT: usize = 3;
/// Another offset whose disagreement is at most this many times that of the best one is worth a word.
const NEARLY: f64 = 1.5;

/// What the comparison says.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub clock: Clock,
    pub correlation: f64,
    /// Another offset that agrees nearly as well.
    pub other: Option<f64>,
}

/// The inputs' side of a comparison: times and their way and turn.
struct Piece {
    at: f64,
    points: Vec<(f64, [f64; 2])>,
}

/// The best clock; `None` where the files are too short to compare, or nothing moves in one.
///
/// `near` limits the search to offsets within two seconds of it.
pub(crate) fn search(driven: &Driven, measured: &Measured, poses: [f64; 2], near: Option<f64>) -> Option<Found> {
    let (first, last) = (*driven.time.first()?, *driven.time.last()?);
    let (length, span) = (last - first, poses[1] - poses[0]);
    let piece = Piece::liveliest(driven, first, last)?;
    let reach = 0.5 * PIECE.min(length);
    let drifts = spread(MOST_DRIFT, SLACK / reach.max(1.0));
    let low = poses[0] - last;
    let lags = ((length + span) / STEP) as usize + 1;
    let overlap = OVERLAP[0].max(OVERLAP[1] * (2.0 * reach).min(span));
    // Ways and turns are the same whichever time an offset is stated for: that of the piece.
    let score = |offset: f64| -> (f64, f64) {
        let tried = drifts.iter().map(|d| (piece.correlation(measured, offset, *d, overlap), *d));
        tried.fold((f64::NEG_INFINITY, 0.0), |best, one| if one.0 > best.0 { one } else { best })
    };
    let wanted = |offset: &f64| near.is_none_or(|n| (offset - n).abs() <= 2.0);
    let offsets: Vec<f64> = (0..=lags).map(|i| low + STEP * i as f64).filter(wanted).collect();
    let mut scored: Vec<(f64, f64, f64)> = offsets
        .par_iter()
        .map(|o| {
            let (score, drift) = score(*o);
            (score, *o, drift)
        })
        .filter(|(score, _, _)| score.is_finite())
        .collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.abs().total_cmp(&b.1.abs())));
    let mut peaks: Vec<(f64, f64, f64)> = vec![];
    for s in scored {
        if peaks.len() < KEPT && peaks.iter().all(|p| (p.1 - s.1).abs() > APART) {
            peaks.push(s);
        }
    }
    let all = Piece::between(driven, first, last)?;
    let mut better: Vec<(f64, Clock)> = peaks
        .iter()
        .map(|(_, offset, drift)| {
            let clock = Clock { offset: *offset, drift: *drift, at: piece.at };
            climbed(&all, measured, clock.restated(all.at), overlap)
        })
        .collect();
    better.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (correlation, clock) = *better.first()?;
    let close =
        |c: &&(f64, Clock)| 1.0 - c.0 < NEARLY * (1.0 - correlation) && (c.1.offset - clock.offset).abs() > APART;
    let other = better[1..].iter().find(close).map(|c| c.1.offset);
    Some(Found { clock, correlation, other })
}

impl Clock {
    /// The same clock, its offset stated for another time of the inputs.
    pub(crate) fn restated(&self, at: f64) -> Clock {
        Clock { offset: self.offset + self.drift * (at - self.at), at, ..*self }
    }
}

/// Evenly spaced values from −most to most, zero among them.
fn spread(most: f64, step: f64) -> Vec<f64> {
    let n = (most / step).ceil().min(200.0) as i32;
    (-n..=n).map(|i| most * f64::from(i) / f64::from(n.max(1))).collect()
}

impl Piece {
    fn between(driven: &Driven, from: f64, to: f64) -> Option<Self> {
        let count = ((to - from) / GRID) as usize;
        let point = |i: usize| {
            let t = from + GRID * i as f64;
            driven.around(t).map(|m| (t, m))
        };
        let points: Vec<(f64, [f64; 2])> = (0..=count).filter_map(point).collect();
        (points.len() > 2).then_some(Self { at: 0.5 * (from + to), points })
    }

    /// The piece in which the motion changes most.
    fn liveliest(driven: &Driven, first: f64, last: f64) -> Option<Self> {
        let count = ((last - first) / PIECE).ceil().max(1.0) as usize;
        let length = (last - first) / count as f64;
        let piece = |i: usize| {
            let from = first + length * i as f64;
            Self::between(driven, from, from + length)
        };
        let pieces: Vec<Self> = (0..count).filter_map(piece).collect();
        let all: Vec<[f64; 2]> = pieces.iter().flat_map(|p| p.points.iter().map(|x| x.1)).collect();
        let scale = variances(&all).map(|v| v.max(1e-12));
        let lively = |p: &Piece| {
            let own: Vec<[f64; 2]> = p.points.iter().map(|x| x.1).collect();
            variances(&own).iter().zip(scale).map(|(v, s)| v / s).sum::<f64>()
        };
        pieces.into_iter().max_by(|a, b| lively(a).total_cmp(&lively(b)))
    }

    /// The correlation of both motions at an offset and a drift about the middle of the piece, way and turn together,
    /// each in its own scale; −∞ where too little overlaps or nothing changes.
    fn correlation(&self, measured: &Measured, offset: f64, drift: f64, overlap: f64) -> f64 {
        let mut sums = [[0.0f64; 5]; 2];
        let mut n = 0.0;
        for (t, a) in &self.points {
            let Some(b) = measured.around(t + offset + drift * (t - self.at)) else { continue };
            n += 1.0;
            for c in 0..2 {
                let s = &mut sums[c];
                s[0] += a[c];
                s[1] += b[c];
                s[2] += a[c] * a[c];
                s[3] += b[c] * b[c];
                s[4] += a[c] * b[c];
            }
        }
        if n * GRID < overlap - 2.0 * SPAN {
            return f64::NEG_INFINITY;
        }
        let moments = sums.map(|[a, b, aa, bb, ab]| [aa - a * a / n, bb - b * b / n, ab - a * b / n]);
        // Metres and radians are compared in units of their own spread, of both files together.
        let scaled = moments.iter().map(|m| {
            let scale = (m[0] * m[1]).sqrt();
            if scale > 1e-9 * n { m.map(|x| x / scale) } else { [0.0; 3] }
        });
        let total = scaled.zip(&moments).fold([0.0; 3], |sum, (s, m)| {
            // A channel counts by how much of it is more than nothing.
            let weight = if m[0] > 1e-6 * n && m[1] > 1e-6 * n { 1.0 } else { 0.0 };
            [sum[0] + weight * s[0], sum[1] + weight * s[1], sum[2] + weight * s[2]]
        });
        let correlation = total[2] / (total[0] * total[1]).sqrt();
        if correlation.is_finite() { correlation } else { f64::NEG_INFINITY }
    }
}

fn variances(points: &[[f64; 2]]) -> [f64; 2] {
    let n = points.len().max(1) as f64;
    [0, 1].map(|c| {
        let mean = points.iter().map(|p| p[c]).sum::<f64>() / n;
        points.iter().map(|p| (p[c] - mean).powi(2)).sum::<f64>() / n
    })
}

/// Uphill from a clock, over the whole of the inputs, with steps that halve.
fn climbed(all: &Piece, measured: &Measured, from: Clock, overlap: f64) -> (f64, Clock) {
    let reach = all.points.last().map_or(1.0, |p| p.0 - all.at).max(1.0);
    let value = |c: &Clock| all.correlation(measured, c.offset, c.drift, overlap);
    let mut best = (value(&from), from);
    let mut step = 0.4;
    while step > 0.04 {
        let before = best.0;
        for (d_offset, d_drift) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let offset = best.1.offset + step * d_offset;
            let drift = (best.1.drift + step / reach * d_drift).clamp(-1.2 * MOST_DRIFT, 1.2 * MOST_DRIFT);
            let next = Clock { offset, drift, ..best.1 };
            let score = value(&next);
            if score > best.0 {
                best = (score, next);
            }
        }
        if best.0 <= before {
            step *= 0.5;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn drifts_are_spread_about_none() {
        let all = spread(0.03, 0.01);
        assert_eq!(all.len(), 7);
        assert_eq!((all[0], all[3], all[6]), (-0.03, 0.0, 0.03));
    }

    #[test]
    fn a_clock_says_the_same_from_another_time() {
        let clock = Clock { offset: 0.3, drift: 0.01, at: 50.0 };
        let other = clock.restated(80.0);
        assert!((other.offset - 0.6).abs() < 1e-12);
        assert!((clock.of(12.0) - other.of(12.0)).abs() < 1e-12);
    }

    #[test]
    fn variances_are_those_about_the_mean() {
        assert_eq!(variances(&[[1.0, 5.0], [3.0, 5.0], [5.0, 5.0], [7.0, 5.0]]), [5.0, 0.0]);
        assert_eq!(variances(&[]), [0.0; 2]);
    }

    /// Inputs of a minute and poses of two, at a grid fine enough to be any clock's.
    fn two_files(driven: impl Fn(f64) -> [f64; 2], measured: impl Fn(f64) -> [f64; 2]) -> (Driven, Measured) {
        let grid = |first: f64, rows: u32| (0..rows).map(move |i| first + 0.05 * f64::from(i)).collect::<Vec<f64>>();
        let sampled = |time: &[f64], f: &dyn Fn(f64) -> [f64; 2]| time.iter().map(|t| f(*t)).collect::<Vec<_>>();
        let (inputs, poses) = (grid(100.0, 1200), grid(0.0, 2400));
        (Driven::sampled(&inputs, &sampled(&inputs, &driven)), Measured::sampled(0.05, &sampled(&poses, &measured)))
    }

    fn lively(t: f64) -> [f64; 2] {
        [1.0 + (0.31 * t + (0.05 * t).sin()).sin(), (0.17 * t + 2.0 * (0.03 * t).cos()).cos()]
    }

    #[test]
    fn motion_agrees_at_its_own_offset_and_drift() {
        let (driven, measured) = two_files(lively, |t| lively((t - 40.0) / 1.01 + 100.0));
        let all = Piece::between(&driven, 110.0, 150.0).unwrap();
        let times: Vec<f64> = all.points.iter().map(|p| p.0).collect();
        assert_eq!((times.len(), times[0], all.at), (201, 110.0, 130.0));
        assert!((times[200] - 150.0).abs() < 1e-9);
        // t + offset + drift·(t − 130) with offset = 40 + 1.01·30 − 130.
        let at = |offset: f64, drift: f64| all.correlation(&measured, offset, drift, 10.0);
        assert!(at(-59.7, 0.01) > 0.9999, "{}", at(-59.7, 0.01));
        assert!(at(-59.7, 0.0) < 0.9999 && at(-59.7, -0.01) < at(-59.7, 0.0) && at(-59.2, 0.01) < 0.999);
        // Seven of forty seconds overlap.
        assert_eq!(at(-143.0, 0.01), f64::NEG_INFINITY);
        let found = search(&driven, &measured, [0.0, 119.95], None).unwrap();
        assert!((found.clock.restated(130.0).offset + 59.7).abs() < 0.1 && found.other.is_none(), "{found:?}");
    }

    #[test]
    fn what_goes_on_in_circles_has_another_clock() {
        let turns = |t: f64| [1.0, (TAU * t / 20.0).cos()];
        let (driven, measured) = two_files(turns, |t| [1.0, turns(t)[1] + 0.1 * (7.3 * t).sin()]);
        let found = search(&driven, &measured, [0.0, 119.95], None).unwrap();
        let apart = (found.clock.offset - found.other.unwrap()).abs() / 20.0;
        assert!((apart - apart.round()).abs() < 0.02 && apart > 0.9, "{found:?}");
    }
}
