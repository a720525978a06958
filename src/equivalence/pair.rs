//! Two families side by side, and the points at which they are compared.

use super::carrier::Carrier;
use super::family::Family;
use super::points::{Point, Sample};
use super::values::{Values, int};
use crate::formula::Symbol;

/// What the two sides of a comparison have in common.
pub struct Pair<'a> {
    /// The family whose parameters are given.
    pub given: &'a Family,
    /// The family whose parameters are sought.
    pub sought: &'a Family,
    /// Points at which they are compared exactly.
    pub points: &'a [Point],
    /// Points at which numbers may refute a comparison before; none where all is left to the proof.
    pub samples: &'a [Sample],
}

impl Pair<'_> {
    /// Whether both families are smooth at zero.
    pub fn is_regular(&self) -> bool {
        self.given.regular && self.sought.regular
    }

    /// The motion given, its parameters left open.
    pub fn given_at<S: Carrier>(&self, at: &Point<S>) -> Option<Vec<S>> {
        self.given.rows(at, &Values::new(), None)
    }

    /// The motion sought where the unknowns are all zero, or one of them is something else.
    pub fn sought_at<S: Carrier>(
        &self,
        at: &Point<S>,
        unknowns: &[Symbol],
        other: Option<(usize, S)>,
    ) -> Option<Vec<S>> {
        let mut values: Values<S> = self.sought.own.iter().chain(unknowns).map(|s| (s.clone(), int(0))).collect();
        values.extend(other.map(|(j, v)| (unknowns[j].clone(), v)));
        self.sought.rows(at, &values, None)
    }
}
