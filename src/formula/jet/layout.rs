//! The monomials of a truncated power series, and the table of their products.

use crate::formula::Symbol;
use std::collections::HashMap;

/// The monomials of some variables up to an order, by rising degree; monomial 0 is 1.
///
/// Because the degree rises, a series cut to a lower order is the front part of its coefficients.
///
/// ```
/// use creepage::formula::Layout;
/// let plane = Layout::new(vec!["x".into(), "y".into()], 2);
/// assert_eq!(plane.count(2), 6); // 1, two of degree one, three of degree two
/// assert_eq!(plane.powers(0), [0, 0]);
/// ```
#[derive(Debug, PartialEq)]
pub struct Layout {
    variables: Vec<Symbol>,
    powers: Vec<Vec<u32>>,
    degrees: Vec<usize>,
    /// How many monomials have at most degree 0, 1, 2, …
    counts: Vec<usize>,
    /// The monomial i·j, for every j that keeps it within the order.
    products: Vec<Vec<usize>>,
    /// For each variable and monomial: the monomial divided by the variable.
    quotients: Vec<Vec<Option<usize>>>,
}

impl Layout {
    /// The layout of series in these variables up to an order.
    pub fn new(variables: Vec<Symbol>, order: usize) -> Self {
        let (powers, counts) = monomials(variables.len(), order);
        let degrees: Vec<usize> = powers.iter().map(|m| m.iter().sum::<u32>() as usize).collect();
        let index: HashMap<&[u32], usize> = powers.iter().enumerate().map(|(i, m)| (m.as_slice(), i)).collect();
        let place = |m: Vec<u32>| index.get(m.as_slice()).copied();
        let product = |i: usize, j: usize| place(powers[i].iter().zip(&powers[j]).map(|(a, b)| a + b).collect());
        let products = |i: usize| (0..counts[order - degrees[i]]).filter_map(|j| product(i, j)).collect();
        let products = (0..powers.len()).map(products).collect();
        let quotient = |v: usize, m: &Vec<u32>| {
            let mut lower = m.clone();
            lower[v] = lower[v].checked_sub(1)?;
            place(lower)
        };
        let quotients = (0..variables.len()).map(|v| powers.iter().map(|m| quotient(v, m)).collect()).collect();
        Self { variables, degrees, counts, products, quotients, powers }
    }

    /// The variables.
    pub fn variables(&self) -> &[Symbol] {
        &self.variables
    }

    /// The highest degree kept.
    pub fn order(&self) -> usize {
        self.counts.len() - 1
    }

    /// How many monomials have at most this degree; a degree above the order counts as the order.
    pub fn count(&self, degree: usize) -> usize {
        self.counts[degree.min(self.order())]
    }

    /// The exponents of a monomial, one for each variable.
    pub fn powers(&self, monomial: usize) -> &[u32] {
        &self.powers[monomial]
    }

    /// The monomial with these exponents, if it is kept.
    pub fn monomial(&self, powers: &[u32]) -> Option<usize> {
        self.powers.iter().position(|m| m == powers)
    }

    /// The degree of a monomial.
    pub fn degree(&self, monomial: usize) -> usize {
        self.degrees[monomial]
    }

    /// The products of a monomial with monomials 0, 1, 2, … as far as they are kept.
    pub fn products(&self, monomial: usize) -> &[usize] {
        &self.products[monomial]
    }

    /// The derivative of a monomial with respect to a variable: its exponent and the monomial that is left.
    pub fn derivative(&self, variable: usize, monomial: usize) -> Option<(u32, usize)> {
        Some((self.powers[monomial][variable], self.quotients[variable][monomial]?))
    }
}

/// All exponents of degree 0, 1, …, order, and how many there are up to each degree.
fn monomials(variables: usize, order: usize) -> (Vec<Vec<u32>>, Vec<usize>) {
    let mut all = vec![vec![0; variables]];
    let mut counts = vec![1];
    let mut last = all.clone();
    for _ in 0..order {
        // Raising no variable before the last one already present meets each monomial once.
        let raised = |m: &Vec<u32>| {
            let from = m.iter().rposition(|k| *k > 0).unwrap_or(0);
            let up = |v: usize| m.iter().enumerate().map(|(i, k)| k + u32::from(i == v)).collect();
            (from..variables).map(up).collect::<Vec<Vec<u32>>>()
        };
        last = last.iter().flat_map(raised).collect();
        all.extend(last.iter().cloned());
        counts.push(all.len());
    }
    (all, counts)
}
