//! Holonomic integrals: functions of the coordinates that the constraints keep constant, found by an ansatz and proved.

use super::distribution_basis::coefficients;
use super::exact_linear_algebra::Echelon;
use super::integral_ansatz::{Combination, Sample, Term, monomials, unchanged};
use super::integral_proof::{follows, needed_rows, written};
use super::random_points::Samples;
use super::{Mechanism, Point, Row};
use crate::formula::{Expr, Fun, Symbol};

/// A function h(q) with ḣ = 0 under the ideal constraints.
#[derive(Clone, Debug)]
pub struct Integral {
    /// h, with parameters as symbols where the search could keep them, else with their values at the point.
    pub formula: Expr,
    /// The places of the constraints of which dh is a combination.
    pub constraints: Vec<usize>,
}

impl Mechanism {
    /// Independent integrals of the ideal constraints.
    ///
    /// | step | functions tried |
    /// |---|---|
    /// | 1 | Σ c·q, the factors c rational |
    /// | 2 | Σ c·q, c·cos w, c·sin w with the angles w |
    /// | 3 | with angles w found constant: Σ c·q, c·q·cos w, c·q·sin w |
    /// | then | each one found again, its factors sums of products of at most two parameters, for all their values |
    ///
    /// Factors come from exact linear algebra at random rational points. Each integral is then proved: dh is a
    /// combination of the rows for all configurations. Constraints without exact values at random points (a root of
    /// what is no square) are left out, so that integrals may be missed but none is invented; a missed one shows as
    /// a disagreement with the growth vector. Source: equation (28) for the two-wheeler; Frobenius.
    ///
    /// ```
    /// use creepage::formula::Exact;
    /// use creepage::mechanism::Point;
    /// use creepage::{model::mechanism, vehicles};
    /// let robot = mechanism(vehicles::named("differential-drive").unwrap(), 0);
    /// let lengths = [("a", 3, 4), ("r_1", 1, 3), ("r_2", 2, 5)];
    /// let at = lengths.iter().fold(Point::default(), |p, (s, a, b)| p.with(*s, Exact::ratio(*a, *b)));
    /// let integrals = robot.integrals(&at);
    /// assert_eq!(integrals.len(), 1);
    /// assert_eq!(integrals[0].formula.to_string(), "r_1*theta_1 - r_2*theta_2 - a*phi");
    /// ```
    pub fn integrals(&self, at: &Point) -> Vec<Integral> {
        let mut search = Search::new(self, at);
        let plain: Vec<Term> = search.order.iter().map(|q| Term::plain(*q)).collect();
        search.round(&plain);
        search.round_with_circular(&plain);
        search.round_with_products(&plain);
        search.found.into_iter().map(|(integral, _)| integral).collect()
    }
}

/// The search: rows that can be evaluated, and what has been found.
struct Search<'a> {
    coordinates: &'a [Symbol],
    rates: Vec<Symbol>,
    /// Coordinates in the order in which they are printed: angles of the body last.
    order: Vec<usize>,
    rows: Vec<(usize, Row)>,
    at: &'a Point,
    samples: Samples,
    /// The most rows that are independent anywhere.
    rank: usize,
    found: Vec<(Integral, Combination)>,
}

impl<'a> Search<'a> {
    fn new(mechanism: &'a Mechanism, at: &'a Point) -> Self {
        let rows = mechanism.ideal_rows();
        let samples = Samples::of(coefficients(&rows));
        let mut order: Vec<usize> = (0..mechanism.coordinates.len()).collect();
        order.sort_by_key(|q| samples.is_angle(&mechanism.coordinates[*q]));
        let mut search = Self {
            coordinates: &mechanism.coordinates,
            rates: mechanism.rates(),
            order,
            rows: rows.into_iter().enumerate().collect(),
            at,
            samples,
            rank: 0,
            found: Vec::new(),
        };
        search.keep_rows_with_values();
        search
    }

    /// Drops rows that have no exact value at random points and finds the rank of the others.
    fn keep_rows_with_values(&mut self) {
        let points: Vec<Point> = (0..6).map(|_| self.samples.point(self.coordinates, self.at)).collect();
        let rates = self.rates.clone();
        self.rows.retain(|(_, row)| points.iter().all(|p| p.row(row, &rates).is_some()));
        let rank = |p: &Point| {
            let values = self.rows.iter().filter_map(|(_, row)| p.row(row, &rates));
            Echelon::of(rates.len(), &values.collect::<Vec<_>>()).rank()
        };
        self.rank = points.iter().map(rank).max().unwrap_or(0);
    }

    fn is_angle(&self, coordinate: usize) -> bool {
        self.samples.is_angle(&self.coordinates[coordinate])
    }

    /// A sample of some rows, with new values for these symbols; none where fewer rows are independent than usual.
    fn sample(&mut self, rows: &[Row], rank: usize, vary: &[Symbol]) -> Option<Sample> {
        let point = self.samples.point(vary, self.at);
        let values: Option<Vec<_>> = rows.iter().map(|r| point.row(r, &self.rates)).collect();
        let echelon = Echelon::of(self.rates.len(), &values?);
        let motions = (echelon.rank() == rank).then(|| echelon.null_space())?;
        Some(Sample::at(point, self.coordinates, motions, &mut self.samples))
    }

    fn all_rows(&self) -> Vec<Row> {
        self.rows.iter().map(|(_, r)| r.clone()).collect()
    }

    /// Samples at the parameters of the point.
    fn reference(&mut self, count: usize) -> Vec<Sample> {
        let (rows, rank, coordinates) = (self.all_rows(), self.rank, self.coordinates);
        (0..10 * count).filter_map(|_| self.sample(&rows, rank, coordinates)).take(count).collect()
    }

    /// Looks for integrals among combinations of terms and keeps those independent of what is known.
    fn round(&mut self, terms: &[Term]) {
        let (rows, rank, coordinates) = (self.all_rows(), self.rank, self.coordinates);
        let candidates = unchanged(terms, || self.sample(&rows, rank, coordinates));
        let samples = self.reference(3);
        for candidate in candidates {
            if self.is_new(&candidate, &samples) {
                let proved = self.for_all_parameters(&candidate, &samples);
                let proved = proved.or_else(|| self.at_these_parameters(&candidate, &samples));
                self.found.extend(proved);
            }
        }
    }

    /// Whether the gradient is independent of those of the integrals found.
    fn is_new(&self, candidate: &Combination, samples: &[Sample]) -> bool {
        samples.first().is_some_and(|at| {
            let mut known = Echelon::new(self.coordinates.len());
            self.found.iter().filter_map(|(_, c)| c.gradient(at)).for_each(|g| {
                known.insert(&g);
            });
            candidate.gradient(at).is_some_and(|g| known.insert(&g))
        })
    }

    /// Looks for integrals with cosines and sines of angles.
    fn round_with_circular(&mut self, plain: &[Term]) {
        if self.found.len() < self.rank {
            let angles: Vec<usize> = self.order.iter().copied().filter(|w| self.is_angle(*w)).collect();
            let circular = angles.iter().flat_map(|w| [Fun::Cos, Fun::Sin].map(|f| Term::circular(f, *w)));
            self.round(&plain.iter().cloned().chain(circular).collect::<Vec<_>>());
        }
    }

    /// Looks for integrals with products of coordinates and cosines or sines of constant angles.
    fn round_with_products(&mut self, plain: &[Term]) {
        let constant = self.constant_coordinates();
        let turning: Vec<usize> = constant.iter().copied().filter(|w| self.is_angle(*w)).collect();
        if turning.is_empty() || self.found.len() >= self.rank {
            return;
        }
        // What is constant gives nothing new as a factor of itself.
        let moving = plain.iter().filter(|t| t.coordinate.is_some_and(|q| !constant.contains(&q)));
        let factors = turning.iter().flat_map(|w| [(Fun::Cos, *w), (Fun::Sin, *w)]).map(Some);
        let factors: Vec<_> = std::iter::once(None).chain(factors).collect();
        let products = |t: &Term| factors.iter().map(|f| Term { factor: *f, ..t.clone() }).collect::<Vec<_>>();
        self.round(&moving.flat_map(products).collect::<Vec<_>>());
    }

    /// The places among the rows of those the candidate follows from.
    fn rows_for(&self, candidate: &Combination, samples: &[Sample]) -> Option<Vec<usize>> {
        let values = |at: &Sample| {
            let matrix: Option<Vec<_>> = self.rows.iter().map(|(_, r)| at.point.row(r, &self.rates)).collect();
            Some((matrix?, candidate.gradient(at)?))
        };
        needed_rows(self.rows.len(), &samples.iter().map(values).collect::<Option<Vec<_>>>()?)
    }

    /// The candidate with factors that are products of parameters, if there is such a one.
    fn for_all_parameters(&mut self, candidate: &Combination, samples: &[Sample]) -> Option<(Integral, Combination)> {
        let places = self.rows_for(candidate, samples)?;
        let rows: Vec<Row> = places.iter().map(|p| self.rows[*p].1.clone()).collect();
        let symbols: std::collections::BTreeSet<Symbol> = coefficients(&rows).flat_map(Expr::symbols).collect();
        let is_length = |s: &&Symbol| !self.coordinates.contains(s) && !self.samples.is_angle(s);
        let parameters: Vec<Symbol> = symbols.iter().filter(is_length).cloned().collect();
        let vary: Vec<Symbol> = symbols.iter().chain(self.coordinates).cloned().collect();
        for degree in 0..=2 {
            let products = monomials(&parameters, degree);
            let support = candidate.parts.iter().map(|(_, t)| t);
            let terms: Vec<Term> = support.flat_map(|t| products.iter().map(|m| t.times(m))).collect();
            let general = unchanged(&terms, || self.sample(&rows, rows.len(), &vary));
            let proved = general.into_iter().filter(|h| self.is_new(h, samples));
            let mut proved = proved.filter_map(|h| self.proved(h, &places, &rows, samples));
            if let Some(found) = proved.next() {
                return Some(found);
            }
        }
        None
    }

    /// The candidate at the parameters of the point.
    fn at_these_parameters(&self, candidate: &Combination, samples: &[Sample]) -> Option<(Integral, Combination)> {
        let places = self.rows_for(candidate, samples)?;
        let value = |s: &Symbol| match self.coordinates.contains(s) {
            true => None,
            false => written(&self.at.value(s)),
        };
        let rows: Vec<Row> = places.iter().map(|p| self.rows[*p].1.substitute(&value)).collect();
        self.proved(candidate.clone(), &places, &rows, samples)
    }

    fn proved(
        &self,
        h: Combination,
        places: &[usize],
        rows: &[Row],
        samples: &[Sample],
    ) -> Option<(Integral, Combination)> {
        let formula = h.expr(self.coordinates);
        let constraints = places.iter().map(|p| self.rows[*p].0).collect();
        follows(&formula, rows, self.coordinates, samples).then_some((Integral { formula, constraints }, h))
    }

    /// Coordinates that are integrals by themselves.
    fn constant_coordinates(&self) -> Vec<usize> {
        let single = |c: &Combination| match c.parts.as_slice() {
            [(_, term)] => term.coordinate,
            _ => None,
        };
        self.found.iter().filter_map(|(_, c)| single(c)).collect()
    }
}
