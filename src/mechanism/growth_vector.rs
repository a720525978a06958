//! The growth vector of a distribution at a point, by exact Lie brackets (Chow's theorem).

use super::distribution_basis::{Frame, coefficients, frame, rank_changes, shape_coordinates};
use super::exact_linear_algebra::Echelon;
use super::random_points::Samples;
use super::vector_field::{Calculus, Field};
use super::{Mechanism, Point, Row};
use crate::error::Result;
use crate::formula::Symbol;
use std::collections::HashSet;

/// The growth vector of a mechanism at a point.
///
/// | symbol | meaning |
/// |---|---|
/// | Δ | the velocities the ideal constraints leave, A(q)·q̇ = 0 |
/// | Δᵏ⁺¹ | Δᵏ + [Δ, Δᵏ] |
/// | growth vector | dim Δ, dim Δ², … at the point, until it no longer grows |
/// | degree of nonholonomy | the first k with the final dimension |
///
/// Valid where the number of independent constraints is constant near the point. All numbers are exact. Source:
/// Frobenius and Chow; Jean, The car with n trailers, ESAIM:COCV 1 (1996), for the vectors of trailers.
///
/// ```
/// use creepage::formula::Exact;
/// use creepage::mechanism::Point;
/// use creepage::{model::mechanism, vehicles};
/// let wheel = mechanism(vehicles::named("unicycle").unwrap(), 0);
/// let at = Point::default().with("r", Exact::ratio(1, 2)).with("phi", Exact::half_tangent(1, 3));
/// let growth = wheel.growth(&at, 4, 9).unwrap();
/// assert_eq!(growth.dimensions, [2, 3, 4]);
/// assert_eq!(growth.degree_of_nonholonomy, 3);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Growth {
    /// The coordinates, whose number is n.
    pub coordinates: Vec<Symbol>,
    /// How many ideal constraints are independent.
    pub rank: usize,
    /// dim Δ, dim Δ², …, up to the first that has the last dimension.
    pub dimensions: Vec<usize>,
    /// The number of dimensions listed.
    pub degree_of_nonholonomy: usize,
    /// Whether the last dimension is proved final: it is the most that the known integrals leave, or Δ has no brackets.
    /// Otherwise the brackets up to the depth asked for bring nothing more, and longer ones were not looked at.
    pub is_final: bool,
}

impl Mechanism {
    /// How many ideal constraints are independent at a point.
    ///
    /// # Errors
    /// When a constraint has no exact value there.
    pub fn rank(&self, at: &Point) -> Result<usize> {
        let rates = self.rates();
        Ok(Echelon::of(rates.len(), &at.matrix(&self.ideal_rows(), &rates)?).rank())
    }

    /// The rates of the coordinates, in their order.
    pub fn rates(&self) -> Vec<Symbol> {
        self.coordinates.iter().map(Symbol::rate).collect()
    }

    /// The growth vector at a point.
    ///
    /// Every Δᵏ is tangent to the level sets of the integrals, so its dimension is at most `bound` = n − (number of
    /// independent integrals); reaching the bound ends the search with proof. Left-normed brackets span Δᵏ; of these
    /// only those that vanish as series, or repeat another up to a constant factor, are left out. `depth` is the
    /// length of the longest brackets tried.
    ///
    /// # Errors
    /// When a constraint has no exact value at the point, or fewer are independent there than near it.
    pub fn growth(&self, at: &Point, bound: usize, depth: usize) -> Result<Growth> {
        let rows = self.ideal_rows();
        self.constant_rank(&rows, at)?;
        let shape = shape_coordinates(&rows, &self.coordinates);
        let variables = shape.iter().filter_map(|s| self.coordinates.iter().position(|q| q == s));
        let variables: Vec<usize> = variables.collect();
        let mut longest = 2;
        loop {
            // Short series first: the order needed is known only when the bound is reached.
            let frame = frame(&rows, &self.coordinates, at, longest - 1)?;
            let mut dimensions = dimensions(&frame, &variables, bound, longest);
            let last = dimensions.last().copied().unwrap_or(0);
            let is_final = last >= bound || frame.fields.len() < 2;
            if is_final || longest >= depth {
                dimensions.truncate(dimensions.iter().position(|d| *d == last).map_or(1, |p| p + 1));
                return Ok(self.grown(dimensions, is_final));
            }
            longest += 1;
        }
    }

    fn grown(&self, dimensions: Vec<usize>, is_final: bool) -> Growth {
        Growth {
            coordinates: self.coordinates.clone(),
            rank: self.coordinates.len() - dimensions.first().copied().unwrap_or(0),
            degree_of_nonholonomy: dimensions.len(),
            dimensions,
            is_final,
        }
    }

    /// An error when more constraints are independent at some other configuration than at the point.
    ///
    /// The series cannot tell a coefficient that is zero from one that is flat at the point; other points can.
    fn constant_rank(&self, rows: &[Row], at: &Point) -> Result<()> {
        let here = self.rank(at)?;
        let mut samples = Samples::of(coefficients(rows));
        let rates = self.rates();
        for _ in 0..4 {
            let elsewhere = samples.point(&self.coordinates, at);
            // Where a root is not rational nothing is said.
            let Ok(matrix) = elsewhere.matrix(rows, &rates) else { continue };
            if Echelon::of(rates.len(), &matrix).rank() > here {
                return Err(rank_changes());
            }
        }
        Ok(())
    }
}

/// dim Δ, dim Δ², … for brackets up to a length, or until the bound is reached.
fn dimensions(frame: &Frame, variables: &[usize], bound: usize, longest: usize) -> Vec<usize> {
    let calculus = Calculus { layout: &frame.layout, coordinates: variables.to_vec() };
    let mut reached = Echelon::new(frame.fields.first().map_or(0, |f| f.value().len()));
    frame.fields.iter().for_each(|f| {
        reached.insert_whole(f.value());
    });
    let mut dimensions = vec![reached.rank()];
    let mut level = frame.fields.clone();
    for length in 2..=longest {
        if reached.rank() >= bound || level.is_empty() {
            break;
        }
        level = brackets(&frame.fields, &level, &calculus, longest - length);
        level.iter().for_each(|f| {
            reached.insert_whole(f.value());
        });
        dimensions.push(reached.rank());
    }
    dimensions
}

/// The brackets of all fields with those of a level, without zeros and repetitions.
fn brackets(fields: &[Field], level: &[Field], calculus: &Calculus, degree: usize) -> Vec<Field> {
    let mut met = HashSet::new();
    let pairs = level.iter().flat_map(|y| fields.iter().map(move |x| (x, y)));
    let found = pairs.map(|(x, y)| x.bracket(y, calculus, degree));
    found.filter(|f| !f.is_zero() && met.insert(f.clone())).collect()
}
