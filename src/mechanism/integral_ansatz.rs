//! The ansatz for holonomic integrals: linear combinations of products of parameters, coordinates, sines and cosines.

use super::Point;
use super::exact_linear_algebra::{Echelon, dot, whole_and_positive};
use super::random_points::Samples;
use crate::formula::{BigInt, BigRational, Exact, Expr, Fun, Scalar, Symbol};
use num_traits::{One, Signed, Zero};

/// A product of parameters, a coordinate, and the cosine or sine of an angle; of the last two one may be missing.
#[derive(Clone)]
pub(crate) struct Term {
    /// Parameters with repetition.
    pub parameters: Vec<Symbol>,
    /// The place of the coordinate.
    pub coordinate: Option<usize>,
    /// cos or sin of the coordinate at a place, another one.
    pub factor: Option<(Fun, usize)>,
}

/// Where the functions and the motions are evaluated.
pub(crate) struct Sample {
    /// Coordinates and parameters.
    pub point: Point,
    /// The coordinates as they stand in sines and cosines.
    pub directions: Vec<Exact>,
    /// The coordinates as numbers. An angle and its sine are independent of each other as far as identities go, so
    /// the number of an angle is drawn apart from its direction.
    pub numbers: Vec<BigRational>,
    /// A basis of the velocities the constraints leave.
    pub motions: Vec<Vec<BigRational>>,
}

impl Sample {
    /// A sample at a point where the rows leave these motions.
    pub(crate) fn at(
        point: Point,
        coordinates: &[Symbol],
        motions: Vec<Vec<BigRational>>,
        samples: &mut Samples,
    ) -> Self {
        let mut number = |q: &Symbol| match point.value(q).as_rational() {
            Some(v) if !samples.is_angle(q) => v.clone(),
            _ => samples.number(),
        };
        let numbers = coordinates.iter().map(&mut number).collect();
        let directions = coordinates.iter().map(|q| point.value(q)).collect();
        Self { point, directions, numbers, motions }
    }
}

impl Term {
    /// A coordinate by itself.
    pub(crate) fn plain(coordinate: usize) -> Self {
        Self { parameters: Vec::new(), coordinate: Some(coordinate), factor: None }
    }

    /// The cosine or sine of a coordinate by itself.
    pub(crate) fn circular(f: Fun, angle: usize) -> Self {
        Self { parameters: Vec::new(), coordinate: None, factor: Some((f, angle)) }
    }

    /// The term times parameters.
    pub(crate) fn times(&self, parameters: &[Symbol]) -> Self {
        Self { parameters: parameters.to_vec(), ..self.clone() }
    }

    /// The term as a formula.
    pub(crate) fn expr(&self, coordinates: &[Symbol]) -> Expr {
        let symbol = |q: usize| Expr::sym(coordinates[q].clone());
        let circular = self.factor.map(|(f, w)| Expr::call(f, &symbol(w)));
        let factors = self.parameters.iter().map(|p| Expr::sym(p.clone()));
        let factors = factors.chain(self.coordinate.map(symbol)).chain(circular);
        factors.reduce(|a, b| &a * &b).unwrap_or_else(|| Expr::int(1))
    }

    /// Its derivatives with respect to the coordinates; `None` where one is not exact.
    pub(crate) fn gradient(&self, at: &Sample) -> Option<Vec<BigRational>> {
        let mut parameters = self.parameters.iter().map(|p| at.point.value(p).as_rational().cloned());
        let scale = parameters.try_fold(BigRational::one(), |product, v| Some(product * v?))?;
        let (value, slope) = match self.factor {
            None => (BigRational::one(), BigRational::zero()),
            Some((f, w)) => circular(f, &at.directions[w])?,
        };
        let mut slopes = vec![BigRational::zero(); at.numbers.len()];
        if let Some(q) = self.coordinate {
            slopes[q] = &scale * value;
        }
        if let Some((_, w)) = self.factor {
            let number = self.coordinate.map_or_else(BigRational::one, |q| at.numbers[q].clone());
            slopes[w] += scale * slope * number;
        }
        Some(slopes)
    }
}

/// cos or sin of an angle, and its derivative.
fn circular(f: Fun, angle: &Exact) -> Option<(BigRational, BigRational)> {
    let of = |f: Fun| Exact::call(f, angle).as_rational().cloned();
    let (cos, sin) = (of(Fun::Cos)?, of(Fun::Sin)?);
    Some(if f == Fun::Cos { (cos, -sin) } else { (sin, cos) })
}

/// A rational combination of terms.
#[derive(Clone)]
pub(crate) struct Combination {
    /// Terms with whole factors, none zero.
    pub parts: Vec<(BigInt, Term)>,
}

impl Combination {
    /// Its derivatives with respect to the coordinates.
    pub(crate) fn gradient(&self, at: &Sample) -> Option<Vec<BigRational>> {
        let mut sum = vec![BigRational::zero(); at.numbers.len()];
        for (factor, term) in &self.parts {
            let factor = BigRational::from(factor.clone());
            sum.iter_mut().zip(term.gradient(at)?).for_each(|(s, g)| *s += &factor * g);
        }
        Some(sum)
    }

    /// As a formula.
    pub(crate) fn expr(&self, coordinates: &[Symbol]) -> Expr {
        self.parts.iter().fold(Expr::int(0), |sum, (factor, term)| {
            let size = &Expr::number(&BigRational::from(factor.abs())) * &term.expr(coordinates);
            if factor.is_negative() { &sum - &size } else { &sum + &size }
        })
    }
}

/// All combinations of terms that no motion of the samples changes, those of fewest terms first.
///
/// Each motion q̇ at each sample gives one linear condition Σ c·(∇h·q̇) = 0 on the factors c. Samples are taken until
/// several in a row bring no new condition.
pub(crate) fn unchanged(terms: &[Term], mut sample: impl FnMut() -> Option<Sample>) -> Vec<Combination> {
    let mut conditions = Echelon::new(terms.len());
    let mut idle = 0;
    for _ in 0..20 * (terms.len() + 1) {
        let Some(at) = sample() else { continue };
        let gradients: Option<Vec<_>> = terms.iter().map(|t| t.gradient(&at)).collect();
        let Some(gradients) = gradients else { continue };
        let condition = |motion: &Vec<BigRational>| gradients.iter().map(|g| dot(g, motion)).collect::<Vec<_>>();
        let fresh = at.motions.iter().filter(|m| conditions.insert(&condition(m))).count();
        idle = if fresh == 0 { idle + 1 } else { 0 };
        if idle >= 3 || conditions.rank() == terms.len() {
            break;
        }
    }
    let mut found: Vec<Combination> = conditions.null_space().iter().map(|c| combination(c, terms)).collect();
    found.sort_by_key(|c| c.parts.len());
    found
}

fn combination(factors: &[BigRational], terms: &[Term]) -> Combination {
    let whole = whole_and_positive(factors);
    let parts = whole.into_iter().zip(terms).filter(|(c, _)| !c.is_zero());
    Combination { parts: parts.map(|(c, t)| (c, t.clone())).collect() }
}

/// All products of at most `degree` of the parameters, the shortest first.
pub(crate) fn monomials(parameters: &[Symbol], degree: usize) -> Vec<Vec<Symbol>> {
    let mut all: Vec<Vec<Symbol>> = vec![Vec::new()];
    let mut last = vec![(0, Vec::new())];
    for _ in 0..degree {
        let longer = |(from, m): &(usize, Vec<Symbol>)| {
            let grown = |i: usize| (i, m.iter().chain([&parameters[i]]).cloned().collect());
            (*from..parameters.len()).map(grown).collect::<Vec<_>>()
        };
        last = last.iter().flat_map(longer).collect();
        all.extend(last.iter().map(|(_, m)| m.clone()));
    }
    all
}
