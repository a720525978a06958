//! What brackets and integrals count of a mechanism at a configuration, as numbers that statements speak of.

use crate::mechanism::{Mechanism, Nonholonomy, Point};

/// A mechanism at a configuration, with its growth vector and its integrals.
#[derive(Clone, Debug)]
pub struct Counted {
    /// What it is called.
    pub name: String,
    /// Coordinates and constraints.
    pub mechanism: Mechanism,
    /// The configuration and the lengths.
    pub at: Point,
    /// Growth vector and integrals.
    pub found: Nonholonomy,
}

impl Counted {
    /// Counts, with brackets of at most a length; nothing where a coefficient has no exact value.
    pub fn of(name: &str, mechanism: Mechanism, at: Point, depth: usize) -> Option<Self> {
        let found = mechanism.nonholonomy(&at, depth).ok()?;
        Some(Self { name: name.to_string(), mechanism, at, found })
    }

    /// A number by its name; a growth vector is written as digits, 2357. Nothing where the numbers are not proved: a
    /// count that brackets and integrals do not agree on is no proof.
    pub fn number(&self, quantity: &str) -> Option<i64> {
        let growth = &self.found.growth;
        if !(growth.is_final && self.found.counts_agree()) {
            return None;
        }
        Some(match quantity {
            "coordinates" => growth.coordinates.len() as i64,
            "rank" => growth.rank as i64,
            "growth" => growth.dimensions.iter().fold(0, |n, d| 10 * n + *d as i64),
            "degree" => growth.degree_of_nonholonomy as i64,
            "holonomic" => self.found.holonomic as i64,
            "nonholonomic" => self.found.nonholonomic as i64,
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Exact;
    use crate::{model::mechanism, vehicles};

    #[test]
    fn a_count_in_doubt_is_no_number() {
        let at = Point::default().with("r", Exact::ratio(1, 2)).with("phi", Exact::half_tangent(1, 3));
        let wheel = vehicles::named("unicycle").unwrap();
        let sure = Counted::of("wheel", mechanism(wheel, 0), at, 4).unwrap();
        let mut disputed = sure.clone();
        disputed.found.holonomic += 1;
        let mut unfinished = sure.clone();
        unfinished.found.growth.is_final = false;
        assert_eq!([sure, disputed, unfinished].map(|c| c.number("rank")), [Some(2), None, None]);
    }
}
