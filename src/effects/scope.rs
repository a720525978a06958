//! The scope of an effect: when, where or in which regime of driving it holds.
//!
//! An effect that rewrites a definition d as f(d) holds in part as d + g·(f(d) − d), with a gate g of 0 or 1.

use crate::formula::{Expr, Node};
use std::fmt;

/// When, where or in which regime an effect holds.
///
/// | scope | gate |
/// |---|---|
/// | times | H(t − from)·H(until − t), summed over the intervals |
/// | regime | H of the signed speed, of its growth, or of the yaw rate |
/// | above a speed | H(\|v_0\| − above) |
/// | disk | H(radius² − (x − x_0)² − (y − y_0)²) |
/// | where | H(formula) |
///
/// H is Heaviside's step. v_0 and w_0 are the forward speed and the yaw rate that the inputs ask for without any effect.
///
/// ```
/// use creepage::effects::Scope;
/// let late = Scope::Times(vec![[35.3, f64::INFINITY]]);
/// assert_eq!((late.to_string().as_str(), late.cost()), ("from 35.3 s on", 1));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Scope {
    /// Intervals of time, s; an end that is infinite is open.
    Times(Vec<[f64; 2]>),
    /// A regime of driving.
    Regime(DrivingRegime),
    /// Above a speed, m/s.
    Above(f64),
    /// A disk of the plane: x, y and radius, m.
    Disk([f64; 3]),
    /// Where a formula is positive.
    Where(Expr),
}

/// A regime of driving, told by the inputs.
///
/// ```
/// use creepage::effects::DrivingRegime;
/// assert_eq!(DrivingRegime::named("reverse"), Some(DrivingRegime::Reverse));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DrivingRegime {
    /// The vehicle goes forward.
    Forward,
    /// It goes backward.
    Reverse,
    /// Its speed grows, either way.
    SpeedingUp,
    /// Its speed falls, either way.
    SlowingDown,
    /// It turns to the left.
    Left,
    /// It turns to the right.
    Right,
}

const REGIMES: [(DrivingRegime, &str, &str); 6] = [
    (DrivingRegime::Forward, "forward", "v_0"),
    (DrivingRegime::Reverse, "reverse", "-v_0"),
    (DrivingRegime::SpeedingUp, "speeding-up", "sign(v_0)*v_0'"),
    (DrivingRegime::SlowingDown, "slowing-down", "-sign(v_0)*v_0'"),
    (DrivingRegime::Left, "left", "w_0"),
    (DrivingRegime::Right, "right", "-w_0"),
];

impl DrivingRegime {
    /// All of them.
    pub fn all() -> impl Iterator<Item = DrivingRegime> {
        REGIMES.iter().map(|row| row.0)
    }

    /// The regime of that name.
    pub fn named(name: &str) -> Option<DrivingRegime> {
        REGIMES.iter().find(|row| row.1 == name).map(|row| row.0)
    }

    /// Its name in files and reports.
    pub fn name(self) -> &'static str {
        self.row().1
    }

    fn row(self) -> &'static (DrivingRegime, &'static str, &'static str) {
        REGIMES.iter().find(|row| row.0 == self).unwrap_or(&REGIMES[0])
    }
}

impl Scope {
    /// The gate, in which the numbers of the scope stand by their names.
    pub fn gate(&self) -> Expr {
        match self {
            Self::Times(intervals) => {
                let gates = intervals.iter().enumerate().map(|(i, ends)| interval(i + 1, ends));
                gates.fold(Expr::int(0), |sum, gate| &sum + &gate)
            }
            Self::Regime(regime) => step(regime.row().2),
            Self::Above(_) => step("abs(v_0) - above"),
            Self::Disk(_) => step("radius^2 - (x - x_0)^2 - (y - y_0)^2"),
            Self::Where(positive) => {
                parsed("heaviside(it)").substitute(&|s| (s.as_str() == "it").then(|| positive.clone()))
            }
        }
    }

    /// The numbers of the scope by the names they have in its gate.
    pub fn numbers(&self) -> Vec<(String, f64)> {
        match self {
            Self::Times(intervals) => {
                let ends = intervals.iter().enumerate().flat_map(|(i, [from, until])| {
                    [(format!("from_{}", i + 1), *from), (format!("until_{}", i + 1), *until)]
                });
                ends.filter(|(_, t)| t.is_finite()).collect()
            }
            Self::Regime(_) | Self::Where(_) => vec![],
            Self::Above(speed) => vec![("above".into(), *speed)],
            Self::Disk([x, y, radius]) => {
                vec![("x_0".into(), *x), ("y_0".into(), *y), ("radius".into(), *radius)]
            }
        }
    }

    /// The times at which it begins and ends, s.
    pub fn edges(&self) -> Vec<f64> {
        let Self::Times(intervals) = self else { return vec![] };
        intervals.iter().flatten().copied().filter(|t| t.is_finite()).collect()
    }

    /// The numbers that a search may move: ends, a bound, centre and radius, and what a formula is compared with.
    pub fn movable(&self) -> Vec<f64> {
        match self {
            Self::Times(_) => self.edges(),
            Self::Regime(_) => vec![],
            Self::Above(speed) => vec![*speed],
            Self::Disk(disk) => disk.to_vec(),
            Self::Where(formula) => bound(formula).map(|(_, bound)| bound).into_iter().collect(),
        }
    }

    /// The scope with other numbers in their places; `None` where they make none.
    pub fn moved(&self, numbers: &[f64]) -> Option<Self> {
        let mut next = numbers.iter().copied();
        match self {
            Self::Times(intervals) => {
                let mut end = |t: f64| if t.is_finite() { next.next() } else { Some(t) };
                let moved = intervals.iter().map(|[a, b]| Some([end(*a)?, end(*b)?])).collect::<Option<Vec<_>>>()?;
                let rising = moved.as_flattened().is_sorted_by(|a, b| a < b);
                rising.then_some(Self::Times(moved))
            }
            Self::Regime(_) => Some(self.clone()),
            Self::Above(_) => next.next().filter(|v| *v > 0.0).map(Self::Above),
            Self::Disk(_) => {
                let disk: [f64; 3] = numbers.try_into().ok()?;
                (disk[2] > 0.0).then_some(Self::Disk(disk))
            }
            Self::Where(formula) => match bound(formula) {
                Some((left, _)) => Expr::parse(&format!("{left} - {:?}", next.next()?)).ok().map(Self::Where),
                None => Some(self.clone()),
            },
        }
    }

    /// The regime in which something grows, and how much of it, where the scope is that it grows by more than that.
    pub(crate) fn regime_beyond(&self) -> Option<(DrivingRegime, f64)> {
        let Self::Where(formula) = self else { return None };
        let (left, bound) = bound(formula)?;
        let grows = |r: &DrivingRegime| parsed(r.row().2) == left;
        DrivingRegime::all().find(grows).map(|regime| (regime, bound))
    }

    /// How many parameters it costs: the numbers that a search may move, and one for a choice among a few.
    pub fn cost(&self) -> usize {
        self.movable().len().max(1)
    }

    /// The scope without intervals, and without gaps between them, that are shorter than `least`, s; `None` where it has
    /// none of these, or nothing would be left.
    pub(crate) fn without_slivers(&self, least: f64) -> Option<Self> {
        let Self::Times(intervals) = self else { return None };
        let mut kept: Vec<[f64; 2]> = vec![];
        for [from, until] in intervals.iter().copied().filter(|[from, until]| until - from >= least) {
            match kept.last_mut().filter(|before| from - before[1] < least) {
                Some(before) => before[1] = until,
                None => kept.push([from, until]),
            }
        }
        (!kept.is_empty() && kept.len() < intervals.len()).then_some(Self::Times(kept))
    }

    /// The scope whose first beginning before a time and whose last end after another are none: nothing is told of them there.
    pub(crate) fn open_beyond(&self, first: f64, last: f64) -> Self {
        let mut opened = self.clone();
        if let Self::Times(intervals) = &mut opened {
            if let Some([from, _]) = intervals.first_mut().filter(|i| i[0] < first) {
                *from = f64::NEG_INFINITY;
            }
            if let Some([_, until]) = intervals.last_mut().filter(|i| i[1] > last) {
                *until = f64::INFINITY;
            }
        }
        opened
    }

    /// Intervals of which the first has no beginning (0), or the last no end (1); `None` where it has none, or is all there would
    /// be.
    pub(crate) fn left_open(&self, end: usize) -> Option<Self> {
        let Self::Times(intervals) = self else { return None };
        let mut intervals = intervals.clone();
        let outer = if end == 0 { intervals.first_mut() } else { intervals.last_mut() };
        let outer = outer.filter(|ends| ends[end].is_finite())?;
        outer[end] = [f64::NEG_INFINITY, f64::INFINITY][end];
        outer[1 - end].is_finite().then_some(Self::Times(intervals))
    }

    /// Whether two scopes are of one kind, whatever their numbers.
    pub fn is_like(&self, other: &Scope) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }
}

/// What a formula takes a number away from, and that number.
fn bound(formula: &Expr) -> Option<(Expr, f64)> {
    let Node::Sub(left, right) = formula.node() else { return None };
    right.as_number()?;
    Some((left.clone(), right.eval(&|_| f64::NAN)?))
}

fn parsed(text: &str) -> Expr {
    // The texts are a part of the program; a test reads every one.
    Expr::parse(text).unwrap_or_else(|e| unreachable!("{e}"))
}

fn step(of: &str) -> Expr {
    parsed(&format!("heaviside({of})"))
}

fn interval(i: usize, [from, until]: &[f64; 2]) -> Expr {
    // The inputs, and with them the time, are looked up `delay` seconds in the past.
    let begun = from.is_finite().then(|| step(&format!("t + delay - from_{i}")));
    let open = until.is_finite().then(|| step(&format!("until_{i} - t - delay")));
    begun.into_iter().chain(open).fold(Expr::int(1), |all, gate| &all * &gate)
}

impl fmt::Display for Scope {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let one = |[from, until]: &[f64; 2]| match (from.is_finite(), until.is_finite()) {
            (true, false) => format!("from {} s on", short(*from)),
            (false, true) => format!("until {} s", short(*until)),
            _ => format!("from {} to {} s", short(*from), short(*until)),
        };
        match self {
            Self::Times(intervals) => f.write_str(&intervals.iter().map(one).collect::<Vec<_>>().join(" and ")),
            Self::Regime(DrivingRegime::Forward) => f.write_str("forward"),
            Self::Regime(DrivingRegime::Reverse) => f.write_str("in reverse"),
            Self::Regime(DrivingRegime::Left) => f.write_str("in left turns"),
            Self::Regime(DrivingRegime::Right) => f.write_str("in right turns"),
            Self::Regime(regime) => write!(f, "while {}", regime.name().replace('-', " ")),
            Self::Above(speed) => write!(f, "above {} m/s", short(*speed)),
            Self::Disk([x, y, r]) => write!(f, "within {} m of ({}, {})", short(*r), short(*x), short(*y)),
            Self::Where(formula) => write!(f, "where {formula} > 0"),
        }
    }
}

fn short(number: f64) -> String {
    let rounded = (number * 100.0).round() / 100.0;
    if rounded == 0.0 && number != 0.0 { crate::number_format::significant(number, 2) } else { rounded.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The value of a gate at a place, a time, a speed and a yaw rate, and the growth of the speed.
    fn open(scope: &Scope, [x, y, t, v, w, a]: [f64; 6]) -> f64 {
        let numbers = scope.numbers();
        let value = |name: &str| match name {
            "x" => x,
            "y" => y,
            "t" => t - 0.5,
            "delay" => 0.5,
            "v_0" => v,
            "w_0" => w,
            "v_0'" => a,
            name => numbers.iter().find(|(n, _)| n == name).unwrap().1,
        };
        scope.gate().eval(&|s| value(s.as_str())).unwrap()
    }

    #[test]
    fn an_end_is_left_open_where_the_other_remains() {
        let of = |ends: &[[f64; 2]]| Scope::Times(ends.to_vec());
        let (early, late) = (f64::NEG_INFINITY, f64::INFINITY);
        let two = of(&[[1.0, 2.0], [3.0, 4.0]]);
        assert_eq!(two.left_open(0), Some(of(&[[early, 2.0], [3.0, 4.0]])));
        assert_eq!(two.left_open(1), Some(of(&[[1.0, 2.0], [3.0, late]])));
        // What neither begins nor ends is no scope.
        assert_eq!([of(&[[early, 2.0]]).left_open(1), of(&[[3.0, late]]).left_open(0)], [None, None]);
        assert_eq!([of(&[[early, 2.0]]).left_open(0), Scope::Above(1.0).left_open(1)], [None, None]);
    }

    #[test]
    fn slivers_are_left_out_and_gaps_closed() {
        let of = |intervals: &[[f64; 2]]| Scope::Times(intervals.to_vec());
        let simpler = |intervals: &[[f64; 2]]| of(intervals).without_slivers(0.3);
        let touching = [[2.0, 5.0], [5.1, f64::INFINITY]];
        assert_eq!(simpler(&touching), Some(of(&[[2.0, f64::INFINITY]])));
        assert_eq!(simpler(&[[1.0, 1.2], [2.0, 5.0]]), Some(of(&[[2.0, 5.0]])));
        assert_eq!(simpler(&[[1.0, 2.0], [2.2, 2.3], [2.5, 5.0]]), Some(of(&[[1.0, 2.0], [2.5, 5.0]])));
        assert_eq!((simpler(&[[1.0, 2.0], [2.4, 5.0]]), simpler(&[[1.0, 1.1]])), (None, None));
        assert_eq!(Scope::Above(1.0).without_slivers(0.3), None);
    }

    #[test]
    fn ends_beyond_the_data_are_left_open() {
        let opened = |intervals: &[[f64; 2]]| Scope::Times(intervals.to_vec()).open_beyond(1.0, 9.0);
        let (never, always) = (f64::INFINITY, f64::NEG_INFINITY);
        assert_eq!(opened(&[[2.0, 9.5]]), Scope::Times(vec![[2.0, never]]));
        assert_eq!(opened(&[[0.5, 3.0], [4.0, 8.0]]), Scope::Times(vec![[always, 3.0], [4.0, 8.0]]));
        assert_eq!(opened(&[[2.0, 3.0], [4.0, 9.1]]), Scope::Times(vec![[2.0, 3.0], [4.0, never]]));
        assert_eq!(Scope::Above(0.5).open_beyond(1.0, 9.0), Scope::Above(0.5));
    }

    #[test]
    fn gates_are_open_where_their_words_say() {
        let at = |t: f64| [0.0, 0.0, t, 0.0, 0.0, 0.0];
        let two = Scope::Times(vec![[1.0, 2.0], [4.0, f64::INFINITY]]);
        assert_eq!([0.5, 1.5, 3.0, 9.0].map(|t| open(&two, at(t))), [0.0, 1.0, 0.0, 1.0]);
        assert_eq!((two.edges(), two.cost()), (vec![1.0, 2.0, 4.0], 3));
        assert_eq!(two.to_string(), "from 1 to 2 s and from 4 s on");
        let driving = [-1.0, 0.3, 0.2];
        let open_in = DrivingRegime::all().filter(|r| {
            let [v, w, a] = driving;
            open(&Scope::Regime(*r), [0.0, 0.0, 0.0, v, w, a]) == 1.0
        });
        assert_eq!(open_in.map(DrivingRegime::name).collect::<Vec<_>>(), ["reverse", "slowing-down", "left"]);
        let disk = Scope::Disk([2.0, -1.0, 0.5]);
        assert_eq!([2.4, 2.6].map(|x| open(&disk, [x, -1.0, 0.0, 0.0, 0.0, 0.0])), [1.0, 0.0]);
        let fast = Scope::Above(1.2);
        assert_eq!([-1.3, 1.1].map(|v| open(&fast, [0.0, 0.0, 0.0, v, 0.0, 0.0])), [1.0, 0.0]);
        let far = Scope::Where(Expr::parse("x - 3").unwrap());
        assert_eq!([2.0, 4.0].map(|x| open(&far, [x, 0.0, 0.0, 0.0, 0.0, 0.0])), [0.0, 1.0]);
    }

    #[test]
    fn a_search_moves_the_numbers_of_a_scope() {
        let two = Scope::Times(vec![[f64::NEG_INFINITY, 2.0], [4.0, 5.0]]);
        assert_eq!(two.movable(), [2.0, 4.0, 5.0]);
        assert_eq!(two.moved(&[1.0, 4.0, 6.0]), Some(Scope::Times(vec![[f64::NEG_INFINITY, 1.0], [4.0, 6.0]])));
        assert_eq!(two.moved(&[4.5, 4.0, 6.0]), None);
        let fast = Scope::Where(Expr::parse("sign(v_0)*v_0' - 0.05").unwrap());
        assert_eq!((fast.movable(), fast.cost()), (vec![0.05], 1));
        assert_eq!(fast.regime_beyond(), Some((DrivingRegime::SpeedingUp, 0.05)));
        assert_eq!(fast.moved(&[0.25]).unwrap().to_string(), "where sign(v_0)*v_0' - 0.25 > 0");
        assert_eq!(Scope::Disk([0.0, 1.0, 2.0]).moved(&[0.0, 1.0, -2.0]), None);
    }

    #[test]
    fn every_regime_is_found_under_its_name() {
        assert!(DrivingRegime::all().all(|r| DrivingRegime::named(r.name()) == Some(r)));
    }
}
