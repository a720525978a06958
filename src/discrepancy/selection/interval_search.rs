//! Intervals of time that grow in number: one more beside those there are, or one cut out of the middle of one of them, and the
//! price of so many edges (binary segmentation; Scott and Knott, 1974).

use super::search::Search;
use crate::discrepancy::estimation::fit::Fit;
use crate::discrepancy::evidence::scope_scan::Blocks;
use crate::effects::{Applied, Scope};
use std::ops::Range;

/// Places within a block that a refined edge may have.
const PLACES: usize = 10;

/// The logarithm of how many more ways there are to place the edges of several intervals along so many blocks than those of one.
pub(super) fn ways_of_more_intervals(scope: &Scope, blocks: usize) -> f64 {
    let Scope::Times(intervals) = scope else { return 0.0 };
    let edges = intervals.iter().flatten().filter(|t| t.is_finite()).count();
    let places = PLACES * blocks;
    (2..edges).map(|k| (places.saturating_sub(k).max(1) as f64 / (k + 1) as f64).ln()).sum::<f64>().max(0.0)
}

impl Search<'_> {
    /// What the scope of an effect costs beside its value: its numbers, and the choice of so many edges.
    pub(super) fn price_of_scope(&self, applied: &Applied, fit: &Fit) -> f64 {
        let blocks = Blocks::of_plan(&self.problem.plan).count;
        let of = |s: &Scope| s.cost() as f64 * fit.sample_size.ln() + 2.0 * ways_of_more_intervals(s, blocks);
        applied.effect.scope.as_ref().map_or(0.0, of)
    }
}

/// How an interval changes others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Change {
    /// It touches none of them, and is one more.
    Added,
    /// It lies in the middle of one of them, the one at that place, and is cut out of it.
    CutOut(usize),
}

impl Change {
    /// Of intervals by one more; `None` where it touches an edge, which is that edge moved.
    pub fn of(intervals: &[Range<usize>], ends: &Range<usize>) -> Option<Self> {
        if intervals.iter().all(|i| ends.end < i.start || i.end < ends.start) {
            return Some(Self::Added);
        }
        intervals.iter().position(|i| i.start < ends.start && ends.end < i.end).map(Self::CutOut)
    }

    /// The intervals after it, in order.
    pub fn made(self, mut intervals: Vec<Range<usize>>, ends: Range<usize>) -> Vec<Range<usize>> {
        match self {
            Self::Added => intervals.push(ends),
            Self::CutOut(k) => {
                intervals.push(ends.end..intervals[k].end);
                intervals[k].end = ends.start;
            }
        }
        intervals.sort_by_key(|i| i.start);
        intervals
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Edges at a hundred places: two of them in 4950 ways, three in 161700, four in 3921225.
    #[test]
    fn more_edges_are_chosen_among_more() {
        let more = |edges: &[[f64; 2]]| ways_of_more_intervals(&Scope::Times(edges.to_vec()), 10);
        assert!((more(&[[1.0, 2.0], [3.0, 4.0]]) - (3_921_225.0_f64 / 4950.0).ln()).abs() < 1e-12);
        assert!((more(&[[f64::NEG_INFINITY, 2.0], [3.0, 4.0]]) - (161_700.0_f64 / 4950.0).ln()).abs() < 1e-12);
        assert_eq!([more(&[[1.0, 2.0]]), more(&[[1.0, f64::INFINITY]])], [0.0; 2]);
        assert_eq!(ways_of_more_intervals(&Scope::Above(1.0), 10), 0.0);
    }

    #[test]
    fn an_interval_is_added_beside_others_or_cut_out_of_one() {
        let all = [2..8, 12..20];
        let with = |ends: Range<usize>| Some(Change::of(&all, &ends)?.made(all.to_vec(), ends));
        assert_eq!(with(9..11), Some(vec![2..8, 9..11, 12..20]));
        assert_eq!(with(4..6), Some(vec![2..4, 6..8, 12..20]));
        // What touches an interval, or ends within it, is another's edge moved.
        assert_eq!([with(8..10), with(0..4), with(2..5), with(0..30)], [None, None, None, None]);
    }
}
