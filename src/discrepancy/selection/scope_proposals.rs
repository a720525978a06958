//! Scopes that an effect may have, proposed by where it would gain: in time, in a regime, above a speed, in a place.

use super::interval_search::Change;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::evidence::scope_scan::{BlockScores, Blocks, Cumulated};
use crate::discrepancy::localisation::asked_motion::AskedMotion;
use crate::effects::{DrivingRegime, Scope};
use crate::error::Result;
use crate::formula::Expr;
use crate::model::Model;
use std::ops::Range;
use std::sync::OnceLock;

/// Intervals of time at most.
const MOST_INTERVALS: usize = 8;
/// Shares of the rows above which a speed or a growth of the speed is tried as a bound.
const QUANTILES: [f64; 7] = [0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9];
/// Radii of disks that are tried, as shares of the extent of the path.
const RADII: [f64; 8] = [0.06, 0.09, 0.13, 0.19, 0.27, 0.36, 0.5, 0.7];

/// How long the data in a scope, and those outside of it, last at least, s.
pub(crate) const SHORTEST: f64 = 8.0;
/// The same of a scope that the vehicle enters by what it does, so often at least that bears it out.
const SHORTEST_BY_DRIVING: f64 = 4.0;
const TIMES: usize = 4;
/// A growth of the speed below such a share of the largest is none: a speed that is held has hardly any.
const HARDLY: f64 = 0.02;
/// What a scope, or a course, gains in a run that bears it out.
pub(crate) const BORNE_OUT: f64 = 10.0;

/// What the vehicle does in a row: where it is, the speed that the inputs ask for, how it grows, and the yaw rate.
#[derive(Clone, Copy, Debug)]
struct Row {
    place: [f64; 2],
    speed: f64,
    growth: f64,
    yaw: f64,
}

/// The rows of every block, and its beginning and end.
pub(crate) struct BlockRows {
    rows: Vec<Vec<Row>>,
    /// First and last time, s.
    times: Vec<[f64; 2]>,
    /// Blocks in a row that belong to one run.
    runs: Vec<Range<usize>>,
    disks: OnceLock<Disks>,
}

/// The disks of a grid that are neither all of the data nor none, with the share of each block in them.
struct Disks {
    /// How many the grid has.
    of: usize,
    told: Vec<(Scope, Vec<f64>)>,
}

/// A scope and what an effect gains by it, to first order.
#[derive(Clone, Debug)]
pub(crate) struct Proposal {
    pub scope: Scope,
    pub gain: f64,
    /// The share of each block that it takes.
    shares: Vec<f64>,
    /// How many were tried that it is the best of.
    pub of: usize,
}

impl Proposal {
    /// What the effect gains by some of the blocks alone.
    fn gain_within(&self, blocks: &Range<usize>, scores: &BlockScores) -> f64 {
        let own = |(b, share): (usize, &f64)| if blocks.contains(&b) { *share } else { 0.0 };
        scores.gain(&self.shares.iter().enumerate().map(own).collect::<Vec<_>>())
    }
}

impl BlockRows {
    /// Of the blocks of a problem.
    pub fn of(problem: &Problem, model: &Model, blocks: &Blocks) -> Result<Self> {
        let asked = AskedMotion::of(model)?;
        let mut found = Self { rows: vec![], times: vec![], runs: vec![], disks: OnceLock::new() };
        let mut before = None;
        for (block, (run, rows)) in blocks.rows(&problem.plan).into_iter().enumerate() {
            let record = &problem.records[run];
            let row = |i: usize| {
                let [speed, growth, yaw] = asked.at(&record.signals, record.time[i]).speeds();
                Row { place: [record.columns[0][i], record.columns[1][i]], speed, growth, yaw }
            };
            found.rows.push(rows.clone().map(row).collect());
            found.times.push([record.time[rows.start], record.time[rows.end.min(record.time.len() - 1)]]);
            match found.runs.last_mut().filter(|_| before == Some(run)) {
                Some(blocks) => blocks.end = block + 1,
                None => found.runs.push(block..block + 1),
            }
            before = Some(run);
        }
        Ok(found)
    }

    /// The best scope of every family.
    pub fn proposals(&self, scores: &BlockScores) -> Vec<Proposal> {
        let mut found = match self.runs.len() {
            1 => self.in_time(&scores.cumulated()),
            _ => self.by_all_clocks(scores),
        };
        found.extend(self.in_regimes(scores));
        found.extend(self.above_speed(scores));
        found.extend(self.while_growing(scores));
        found.extend(self.in_disk(scores));
        found.retain(|p| self.is_told(p, scores) && self.is_shared(p, scores));
        found
    }

    /// Whether enough of the data lie in a scope, and enough outside.
    fn is_told(&self, p: &Proposal, scores: &BlockScores) -> bool {
        let durations = self.times.iter().map(|[from, until]| until - from);
        let inside: f64 = durations.clone().zip(&p.shares).map(|(d, share)| d * share).sum();
        let least = inside.min(durations.sum::<f64>() - inside);
        let is_by_driving = !matches!(p.scope, Scope::Times(_) | Scope::Disk(_));
        least >= SHORTEST || is_by_driving && least >= SHORTEST_BY_DRIVING && self.is_repeated(p, scores)
    }

    /// Whether a scope is entered several times, each of which bears it out: what happened once is no rule.
    fn is_repeated(&self, p: &Proposal, scores: &BlockScores) -> bool {
        let n = p.shares.len();
        let begins = (0..n).filter(|b| p.shares[*b] > 0.0 && (*b == 0 || p.shares[b - 1] == 0.0));
        let each = begins.map(|b| b..(b..n).find(|e| p.shares[*e] == 0.0).unwrap_or(n));
        each.filter(|entered| p.gain_within(entered, scores) > BORNE_OUT).count() >= TIMES
    }

    /// Whether more than one run bears a scope out, where there are several: what one run has alone is that run's.
    fn is_shared(&self, p: &Proposal, scores: &BlockScores) -> bool {
        self.runs.len() < 2 || self.runs.iter().filter(|run| p.gain_within(run, scores) > BORNE_OUT).count() > 1
    }

    fn shares(&self, intervals: &[Range<usize>]) -> Vec<f64> {
        (0..self.times.len()).map(|b| f64::from(u8::from(intervals.iter().any(|i| i.contains(&b))))).collect()
    }

    /// Until a time, from a time on, and in more and more intervals.
    fn in_time(&self, sums: &Cumulated) -> Vec<Proposal> {
        let n = sums.blocks;
        let none = sums.taken(&[]);
        let half = |ends: Range<usize>| (ends.clone(), sums.gain_with(&none, &ends, true));
        let best = |all: Vec<(Range<usize>, f64)>| all.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
        let mut found: Vec<Proposal> = vec![];
        let from = best((1..n).map(|k| half(k..n)).collect());
        let until = best((1..n).map(|k| half(0..k)).collect());
        for (ends, gain) in [from, until].into_iter().flatten() {
            let shares = self.shares(std::slice::from_ref(&ends));
            found.push(Proposal { scope: self.times(&[ends]), gain, shares, of: 2 * n });
        }
        let mut intervals: Vec<Range<usize>> = vec![];
        let mut reached = 0.0;
        while intervals.len() < MOST_INTERVALS {
            let taken = sums.taken(&intervals);
            let pairs = (0..n).flat_map(|a| (a + 1..=n).map(move |b| a..b));
            let gains = pairs.filter_map(|ends| {
                let change = Change::of(&intervals, &ends)?;
                let gain = sums.gain_with(&taken, &ends, change == Change::Added);
                Some((change, ends, gain))
            });
            let Some((change, ends, gain)) = gains.max_by(|a, b| a.2.total_cmp(&b.2)) else { break };
            if gain <= reached {
                break;
            }
            (intervals, reached) = (change.made(intervals, ends), gain);
            let shares = self.shares(&intervals);
            found.push(Proposal { scope: self.times(&intervals), gain, shares, of: n * n / 2 });
        }
        found
    }

    /// Until a time, and from a time on, of several runs each by its own clock.
    fn by_all_clocks(&self, scores: &BlockScores) -> Vec<Proposal> {
        let tried = |late: bool| {
            let at = |t: f64| {
                let open = |[from, _]: &[f64; 2]| f64::from(u8::from((*from >= t) == late));
                let shares: Vec<f64> = self.times.iter().map(open).collect();
                let ends = if late { [t, f64::INFINITY] } else { [f64::NEG_INFINITY, t] };
                let some = shares.iter().any(|s| *s > 0.0) && shares.contains(&0.0);
                some.then(|| Proposal {
                    scope: Scope::Times(vec![ends]),
                    gain: scores.gain(&shares),
                    shares,
                    of: self.times.len(),
                })
            };
            best(self.times.iter().filter_map(|[from, _]| at(*from)).collect())
        };
        [true, false].into_iter().flat_map(tried).collect()
    }

    fn times(&self, intervals: &[Range<usize>]) -> Scope {
        let n = self.times.len();
        let from = |b: usize| if b == 0 { f64::NEG_INFINITY } else { self.times[b][0] };
        let until = |b: usize| if b == n { f64::INFINITY } else { self.times[b - 1][1] };
        Scope::Times(intervals.iter().map(|i| [from(i.start), until(i.end)]).collect())
    }

    fn in_regimes(&self, scores: &BlockScores) -> Vec<Proposal> {
        let tried: Vec<Proposal> = DrivingRegime::all()
            .filter_map(|regime| {
                let open = |r: &Row| match regime {
                    DrivingRegime::Forward => r.speed > 0.0,
                    DrivingRegime::Reverse => r.speed < 0.0,
                    DrivingRegime::SpeedingUp => r.speed.signum() * r.growth > 0.0,
                    DrivingRegime::SlowingDown => r.speed.signum() * r.growth < 0.0,
                    DrivingRegime::Left => r.yaw > 0.0,
                    DrivingRegime::Right => r.yaw < 0.0,
                };
                self.proposal(scores, &open, Scope::Regime(regime), 6)
            })
            .collect();
        best(tried)
    }

    fn above_speed(&self, scores: &BlockScores) -> Vec<Proposal> {
        let bounds = self.quantiles(|r| r.speed.abs());
        let tried = bounds.iter().filter(|b| **b > 0.0);
        let above =
            |b: &f64| self.proposal(scores, &|r| r.speed.abs() > *b, Scope::Above(rounded(*b)), QUANTILES.len());
        best(tried.filter_map(above).collect())
    }

    /// While the speed grows, or falls, by more than a bound.
    fn while_growing(&self, scores: &BlockScores) -> Vec<Proposal> {
        let most = self.rows.iter().flatten().map(|r| r.growth.abs()).filter(|g| g.is_finite()).fold(0.0, f64::max);
        let bounds = self.quantiles(|r| if r.growth.abs() > HARDLY * most { r.growth.abs() } else { f64::NAN });
        let mut tried = vec![];
        for bound in bounds.into_iter().map(rounded).filter(|b| *b > 0.0) {
            for (sign, text) in [(1.0, "sign(v_0)*v_0'"), (-1.0, "-sign(v_0)*v_0'")] {
                let Ok(formula) = Expr::parse(&format!("{text} - {bound:?}")) else { continue };
                let open = |r: &Row| sign * r.speed.signum() * r.growth > bound;
                tried.extend(self.proposal(scores, &open, Scope::Where(formula), 2 * QUANTILES.len()));
            }
        }
        best(tried)
    }

    /// The disks of the grid, which are the same for every effect.
    fn disks(&self) -> Disks {
        let all = || self.rows.iter().flatten().map(|r| r.place);
        let side = |k: usize| all().map(move |p| p[k]);
        let extent = |k: usize| side(k).fold(f64::NEG_INFINITY, f64::max) - side(k).fold(f64::INFINITY, f64::min);
        let extent = extent(0).max(extent(1));
        let centres: Vec<[f64; 2]> =
            self.rows.iter().filter_map(|rows| rows.get(rows.len() / 2)).map(|r| r.place).collect();
        let grid = centres.iter().flat_map(|c| RADII.map(|share| (*c, share * extent)));
        let told = grid.filter_map(|(c, r)| Some((disk_of(c, r), self.told_shares(&within(c, r))?))).collect();
        Disks { of: centres.len() * RADII.len(), told }
    }

    fn in_disk(&self, scores: &BlockScores) -> Vec<Proposal> {
        let Disks { of, told } = self.disks.get_or_init(|| self.disks());
        let gains = told.iter().map(|(disk, shares)| (scores.gain(shares), disk, shares));
        let Some((gain, disk, shares)) = gains.max_by(|a, b| a.0.total_cmp(&b.0)) else { return vec![] };
        let mut found = Proposal { scope: disk.clone(), gain, shares: shares.clone(), of: *of };
        let disk = |centre: [f64; 2], radius: f64| {
            self.proposal(scores, &within(centre, radius), disk_of(centre, radius), *of)
        };
        // From the best of the grid on, by steps of its own radius.
        for step in [0.3, 0.15, 0.08] {
            let Scope::Disk([x, y, radius]) = found.scope else { break };
            let moves = [-1.0, 0.0, 1.0].map(|a| step * a * radius);
            let near = moves.iter().flat_map(|dx| moves.iter().flat_map(move |dy| moves.map(|dr| [*dx, *dy, dr])));
            let tried: Vec<Proposal> = near.filter_map(|[dx, dy, dr]| disk([x + dx, y + dy], radius + dr)).collect();
            found = best(tried.into_iter().chain([found]).collect()).swap_remove(0);
        }
        vec![found]
    }

    /// The scope of those rows, unless it is all of them or none.
    fn proposal(&self, scores: &BlockScores, open: &dyn Fn(&Row) -> bool, scope: Scope, of: usize) -> Option<Proposal> {
        let shares = self.told_shares(open)?;
        Some(Proposal { scope, gain: scores.gain(&shares), shares, of })
    }

    /// The share of each block that is open, unless it is all of them or none.
    fn told_shares(&self, open: &dyn Fn(&Row) -> bool) -> Option<Vec<f64>> {
        let share = |rows: &Vec<Row>| rows.iter().filter(|r| open(r)).count() as f64 / rows.len().max(1) as f64;
        let shares: Vec<f64> = self.rows.iter().map(share).collect();
        let whole = shares.iter().sum::<f64>() / shares.len().max(1) as f64;
        (0.02..0.98).contains(&whole).then_some(shares)
    }

    fn quantiles(&self, of: impl Fn(&Row) -> f64) -> Vec<f64> {
        let mut all: Vec<f64> = self.rows.iter().flatten().map(of).filter(|v| v.is_finite()).collect();
        all.sort_by(f64::total_cmp);
        let at = |q: f64| all.get((q * all.len() as f64) as usize).copied();
        QUANTILES.into_iter().filter_map(at).collect()
    }
}

/// Whether a row lies within a disk.
fn within([x, y]: [f64; 2], radius: f64) -> impl Fn(&Row) -> bool {
    move |r| (r.place[0] - x).powi(2) + (r.place[1] - y).powi(2) < radius * radius
}

fn disk_of([x, y]: [f64; 2], radius: f64) -> Scope {
    Scope::Disk([x, y, radius].map(rounded))
}

fn best(tried: Vec<Proposal>) -> Vec<Proposal> {
    tried.into_iter().max_by(|a, b| a.gain.total_cmp(&b.gain)).into_iter().collect()
}

/// A number for people: three digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.2e}").parse().unwrap_or(x)
}
