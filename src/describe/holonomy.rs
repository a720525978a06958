//! The holonomic and the nonholonomic constraints of a model, by growth vector and integrals.

use super::found::Found;
use crate::formula::Expr;
use crate::mechanism::{Mechanism, Nonholonomy, Point};

/// The length of the longest Lie brackets that are computed; where they still add a dimension, the description says so.
const MAX_BRACKET_LENGTH: usize = 9;

/// How many of the ideal constraints restrict where a vehicle can go, and how many only how it gets there.
///
/// | number | meaning |
/// |---|---|
/// | rank | independent ideal constraints |
/// | growth | dim Δ, dim Δ², … of the motions Δ that they leave |
/// | holonomic | what no bracket leaves: n minus the last dimension |
/// | nonholonomic | rank minus holonomic |
///
/// Valid at a general configuration of the model, creep zero. Source: Frobenius and Chow; equation (28) for the
/// integral of the two-wheeler.
///
/// ```
/// use creepage::{describe::Structure, model::Model};
/// let robot = Model::new("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.5)]).unwrap();
/// let found = Structure::of(&robot).unwrap().holonomy.unwrap();
/// assert_eq!((found.rank, found.holonomic, found.nonholonomic), (3, 1, 2));
/// assert_eq!(found.growth, [2, 3, 4]);
/// assert_eq!(found.integrals[0].to_string(), "r_1*theta_1 - r_2*theta_2 - a*phi");
/// ```
#[derive(Clone, Debug)]
pub struct Holonomy {
    /// Independent ideal constraints.
    pub rank: usize,
    /// The growth vector.
    pub growth: Vec<usize>,
    /// The first bracket length with the last dimension.
    pub degree: usize,
    /// Constraints that can be integrated.
    pub holonomic: usize,
    /// Constraints that cannot.
    pub nonholonomic: usize,
    /// Functions that stay constant without creep. Fewer than `holonomic` only where the motion has one dimension and
    /// is integrable whatever it is.
    pub integrals: Vec<Expr>,
}

impl Holonomy {
    /// The same numbers at two configurations, or in words what is known.
    pub(super) fn of(mechanism: &Mechanism, points: &[Point; 2]) -> Found<Self> {
        let at = |p: &Point| {
            mechanism.nonholonomy(p, MAX_BRACKET_LENGTH).map_err(|e| e.message().to_string()).and_then(Self::settled)
        };
        Self::agreed(at(&points[0])?, at(&points[1])?)
    }

    /// What two configurations say alike.
    fn agreed(first: Self, second: Self) -> Found<Self> {
        match first.numbers() == second.numbers() {
            true => Ok(first),
            false => Err(format!(
                "two general configurations differ, with growth vectors {} and {}",
                vector(&first.growth),
                vector(&second.growth)
            )),
        }
    }

    /// The numbers, where they are proved.
    pub(super) fn settled(found: Nonholonomy) -> Found<Self> {
        if !found.growth.is_final {
            return Err(format!(
                "of {} independent constraints at least {} and at most {} are holonomic: integrals bound the number \
                 from below, brackets of up to {MAX_BRACKET_LENGTH} from above, and the two do not agree",
                found.growth.rank,
                found.integrals.len(),
                found.holonomic
            ));
        }
        Ok(Self {
            rank: found.growth.rank,
            degree: found.growth.degree_of_nonholonomy,
            growth: found.growth.dimensions,
            holonomic: found.holonomic,
            nonholonomic: found.nonholonomic,
            integrals: found.integrals.into_iter().map(|i| i.formula).collect(),
        })
    }

    fn numbers(&self) -> (usize, &[usize], usize, usize, usize) {
        (self.rank, &self.growth, self.degree, self.holonomic, self.integrals.len())
    }
}

/// (2, 3, 4)
pub(super) fn vector(numbers: &[usize]) -> String {
    let numbers: Vec<String> = numbers.iter().map(ToString::to_string).collect();
    format!("({})", numbers.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::Growth;

    #[test]
    fn counts_that_do_not_agree_are_said_in_words() {
        let growth = Growth {
            coordinates: vec![],
            rank: 4,
            dimensions: vec![2, 3, 4],
            degree_of_nonholonomy: 3,
            is_final: false,
        };
        let found = Nonholonomy { growth, integrals: vec![], holonomic: 2, nonholonomic: 2 };
        let words = Holonomy::settled(found.clone()).unwrap_err();
        assert!(words.contains("of 4 independent constraints at least 0 and at most 2 are holonomic"), "{words}");
        let growth = Growth { is_final: true, ..found.growth.clone() };
        assert_eq!(Holonomy::settled(Nonholonomy { growth, ..found }).unwrap().holonomic, 2);
    }

    #[test]
    fn configurations_that_differ_settle_nothing() {
        let car = |growth: &[usize]| Holonomy {
            rank: 2,
            growth: growth.to_vec(),
            degree: growth.len(),
            holonomic: 0,
            nonholonomic: 2,
            integrals: vec![],
        };
        assert_eq!(Holonomy::agreed(car(&[2, 3, 4]), car(&[2, 3, 4])).unwrap().degree, 3);
        let words = Holonomy::agreed(car(&[2, 3, 4]), car(&[2, 3, 3, 4])).unwrap_err();
        assert!(words.contains("(2, 3, 4) and (2, 3, 3, 4)"), "{words}");
    }
}
