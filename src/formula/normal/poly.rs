//! Polynomials in atoms with whole coefficients, each in its only form.

use super::atom::{Atom, Monomial};
use super::work::spend;
use crate::formula::polynomial::signed_sum;
use crate::formula::rational::{BigInt, BigRational, bits};
use crate::formula::{Expr, Symbol};
use num_integer::Integer;
use num_traits::{One, Signed, Zero};
use std::cmp::Ordering;
use std::collections::btree_map::{BTreeMap, Entry};

/// Most terms a polynomial may have.
const MAX_TERMS: usize = 200_000;
/// Most products of two terms that one multiplication or division may take.
const MAX_WORK: usize = 2_000_000;
/// Greatest degree of a term.
const MAX_DEGREE: u32 = 1000;
/// Most binary digits of a coefficient.
pub(super) const MAX_BITS: u64 = 100_000;

/// A sum of whole multiples of monomials. No sine stands squared in it: sin² is written as 1 − cos².
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(super) struct Poly {
    terms: BTreeMap<Monomial, BigInt>,
}

impl Poly {
    /// The number one.
    pub fn one() -> Self {
        Self::monomial(Monomial::default())
    }

    /// A single monomial.
    pub fn monomial(m: Monomial) -> Self {
        Self { terms: [(m, BigInt::one())].into() }
    }

    /// Whether every term has cancelled.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The terms, the greatest last.
    pub fn terms(&self) -> impl DoubleEndedIterator<Item = (&Monomial, &BigInt)> {
        self.terms.iter()
    }

    /// Every atom, as often as it stands in a term.
    pub fn atoms(&self) -> impl Iterator<Item = &Atom> {
        self.terms.keys().flat_map(|m| m.powers().iter().map(|(a, _)| a))
    }

    /// The atom of a polynomial that is nothing but one.
    pub fn as_atom(&self) -> Option<&Atom> {
        let (m, v) = self.lead()?;
        if self.terms.len() == 1 && v.is_one() { m.as_atom() } else { None }
    }

    fn lead(&self) -> Option<(&Monomial, &BigInt)> {
        self.terms.last_key_value()
    }

    fn degree(&self) -> u32 {
        self.lead().map_or(0, |(m, _)| m.degree())
    }

    /// Adds v·m with a v that is not zero.
    fn add_term(&mut self, m: Monomial, v: BigInt) {
        match self.terms.entry(m) {
            Entry::Vacant(place) => drop(place.insert(v)),
            Entry::Occupied(mut place) => {
                *place.get_mut() += v;
                if place.get().is_zero() {
                    place.remove();
                }
            }
        }
    }

    /// Adds v·m·Π(1 − cos²).
    fn add_reduced(&mut self, m: Monomial, squares: &[Symbol], v: BigInt) {
        match squares.split_first() {
            None => self.add_term(m, v),
            Some((s, rest)) => {
                self.add_reduced(m.raised(&Atom::Cos(s.clone()), 2), rest, -&v);
                self.add_reduced(m, rest, v);
            }
        }
    }

    /// Adds v·m·other.
    fn add_multiple(&mut self, m: &Monomial, v: &BigInt, other: &Self) {
        for (n, w) in &other.terms {
            let (product, squares) = m.times(n);
            self.add_reduced(product, &squares, v * w);
        }
    }

    /// Nothing where a bound is passed.
    fn bounded(self) -> Option<Self> {
        let small = self.terms.len() <= MAX_TERMS && self.terms.values().all(|v| bits(v) <= MAX_BITS);
        small.then_some(self)
    }

    /// v·self + w·other with v and w that are not zero.
    pub fn combined(&self, v: &BigInt, w: &BigInt, other: &Self) -> Option<Self> {
        spend(self.terms.len() + other.terms.len())?;
        let mut sum = self.clone();
        sum.terms.values_mut().for_each(|x| *x *= v);
        other.terms.iter().for_each(|(m, x)| sum.add_term(m.clone(), x * w));
        sum.bounded()
    }

    /// The product.
    pub fn times(&self, other: &Self) -> Option<Self> {
        let work = self.terms.len().checked_mul(other.terms.len())?;
        if work > MAX_WORK || self.degree() + other.degree() > MAX_DEGREE {
            return None;
        }
        spend(work)?;
        let mut product = Self::default();
        self.terms.iter().for_each(|(m, v)| product.add_multiple(m, v, other));
        product.bounded()
    }

    /// selfⁿ by repeated squaring.
    pub fn power(&self, n: u32) -> Option<Self> {
        match n {
            0 => Some(Self::one()),
            1 => Some(self.clone()),
            _ => {
                let half = self.power(n / 2)?;
                let square = half.times(&half)?;
                if n % 2 == 1 { square.times(self) } else { Some(square) }
            }
        }
    }

    /// The whole number, the monomial and the polynomial that make it up; the last shares no more, and leads with a
    /// positive term.
    pub fn parts(&self) -> (BigInt, Monomial, Self) {
        let size = self.terms.values().fold(BigInt::zero(), |g, v| g.gcd(v));
        let negative = self.lead().is_some_and(|(_, v)| v.is_negative());
        let content = if negative { -size } else { size };
        let shared = self.terms.keys().cloned().reduce(|a, b| a.common(&b)).unwrap_or_default();
        let part = |(m, v): (&Monomial, &BigInt)| Some((m.without(&shared)?, v / &content));
        let terms = self.terms.iter().filter_map(part).collect();
        (content, shared, Self { terms })
    }

    /// The quotient where division by the leading term finds one; not every quotient of sines and cosines is found.
    pub fn divided_by(&self, divisor: &Self) -> Option<Self> {
        if let Some(Atom::Sin(s)) = divisor.as_atom() {
            return self.divided_by_sine(s);
        }
        let (lead, size) = divisor.lead()?;
        let (mut rest, mut quotient) = (self.clone(), Self::default());
        let steps = MAX_WORK / divisor.terms.len();
        while let Some((m, v)) = rest.lead() {
            let (m, (ratio, remainder)) = (m.without(lead)?, v.div_rem(size));
            if !remainder.is_zero() || quotient.terms.len() >= steps {
                return None;
            }
            spend(divisor.terms.len())?;
            // The leading term goes away and every other change is smaller: the loop ends.
            rest.add_multiple(&m, &-&ratio, divisor);
            quotient.add_term(m, ratio);
        }
        Some(quotient)
    }

    /// (A + B sin)/sin = B + A·sin/(1 − cos²)
    fn divided_by_sine(&self, s: &Symbol) -> Option<Self> {
        let sine = Monomial::of(Atom::Sin(s.clone()));
        let (with, free): (BTreeMap<_, _>, BTreeMap<_, _>) =
            self.terms.clone().into_iter().partition(|(m, _)| m.without(&sine).is_some());
        let mut square = Self::monomial(Monomial::default().raised(&Atom::Cos(s.clone()), 2));
        square.add_term(Monomial::default(), -BigInt::one());
        let mut quotient = Self::default();
        quotient.add_multiple(&sine, &-BigInt::one(), &Self { terms: free }.divided_by(&square)?);
        for (m, v) in with {
            quotient.add_term(m.without(&sine)?, v);
        }
        Some(quotient)
    }

    /// The polynomial as a formula, the greatest term first.
    pub fn expr(&self) -> Expr {
        let terms: Vec<_> = self.terms.iter().rev().map(|(m, v)| (v.is_negative(), term(m, &v.abs()))).collect();
        signed_sum(&terms)
    }
}

fn term(m: &Monomial, size: &BigInt) -> Expr {
    let factors = m.powers().iter().map(|(a, k)| a.expr().pow(i32::try_from(*k).unwrap_or(i32::MAX)));
    // Not a fold from the number: 1·x and x·1 are x, but 2·(x·y) prints its parentheses.
    factors.fold(Expr::number(&BigRational::from(size.clone())), |product, factor| &product * &factor)
}

/// Short polynomials first, and of those the leading atom: products are printed in this order.
impl Ord for Poly {
    fn cmp(&self, other: &Self) -> Ordering {
        self.terms.len().cmp(&other.terms.len()).then_with(|| other.terms.iter().rev().cmp(self.terms.iter().rev()))
    }
}

impl PartialOrd for Poly {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
