//! Quotients of products of polynomials.

use super::atom::{Atom, Monomial};
use super::poly::{MAX_BITS, Poly};
use crate::formula::Expr;
use crate::formula::rational::{BigInt, BigRational, bits};
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A rational number times whole powers of polynomials; a negative power stands below the line.
///
/// Every polynomial leads with a positive term and is one atom, or shares neither a number nor an atom among its terms.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Fraction {
    coefficient: BigRational,
    factors: Factors,
}

type Factors = BTreeMap<Arc<Poly>, i32>;

impl Fraction {
    /// A rational number.
    pub fn constant(coefficient: BigRational) -> Self {
        Self { coefficient, factors: Factors::new() }
    }

    /// A single atom.
    pub fn atom(atom: Atom) -> Self {
        let factor = Poly::monomial(Monomial::of(atom));
        Self { coefficient: BigRational::one(), factors: [(Arc::new(factor), 1)].into() }
    }

    /// The number, if it is one.
    pub fn as_constant(&self) -> Option<&BigRational> {
        self.factors.is_empty().then_some(&self.coefficient)
    }

    /// The number and the polynomial, if it is a number times one polynomial.
    pub fn as_multiple(&self) -> Option<(&BigRational, &Poly)> {
        let mut factors = self.factors.iter();
        match (factors.next(), factors.next()) {
            (Some((p, 1)), None) => Some((&self.coefficient, p)),
            _ => None,
        }
    }

    /// Whether it is the number zero.
    pub fn is_zero(&self) -> bool {
        self.coefficient.is_zero()
    }

    /// Whether the coefficient is below zero.
    pub fn is_negative(&self) -> bool {
        self.coefficient.is_negative()
    }

    /// Whether it is defined and not zero for almost all values of its symbols.
    pub fn is_surely_nonzero(&self) -> bool {
        !self.is_zero() && self.factors.keys().all(|p| is_surely_nonzero(p))
    }

    /// Whether neither an angle nor an arctangent occurs.
    fn is_rational(&self) -> bool {
        self.factors.keys().flat_map(|p| p.atoms()).all(|a| matches!(a, Atom::Symbol(_)))
    }

    /// −x
    pub fn neg(&self) -> Self {
        Self { coefficient: -&self.coefficient, factors: self.factors.clone() }
    }

    /// xⁿ; nothing for 1/0.
    pub fn power(&self, n: i32) -> Option<Self> {
        if n == 0 {
            return Some(Self::constant(BigRational::one()));
        }
        if n < 0 && !self.is_surely_nonzero() {
            return None;
        }
        let bits = bits(self.coefficient.numerator()).max(bits(self.coefficient.denominator().as_ibig()));
        if bits > 1 && bits.checked_mul(n.unsigned_abs().into())? > MAX_BITS {
            return None;
        }
        let raised = self.factors.iter().map(|(p, k)| Some((p.clone(), k.checked_mul(n)?)));
        Some(Self { coefficient: self.coefficient.pow(n as isize), factors: raised.collect::<Option<_>>()? })
    }

    /// x·y
    pub fn times(&self, other: &Self) -> Option<Self> {
        let (mut product, added) =
            if self.factors.len() < other.factors.len() { (other.clone(), self) } else { (self.clone(), other) };
        product.coefficient *= &added.coefficient;
        if product.is_zero() {
            return Some(Self::constant(BigRational::zero()));
        }
        for (p, k) in &added.factors {
            product.absorb(p, *k)?;
        }
        product.bounded()
    }

    /// x + y, over the least common multiple of what stands below the lines.
    pub fn plus(&self, other: &Self) -> Option<Self> {
        if self.is_zero() || other.is_zero() {
            return Some(if self.is_zero() { other.clone() } else { self.clone() });
        }
        let shared = shared(&self.factors, &other.factors);
        let (a, b) = (expanded(&self.factors, &shared)?, expanded(&other.factors, &shared)?);
        let below = self.coefficient.denominator().as_ibig().lcm(other.coefficient.denominator().as_ibig());
        let above = |v: &BigRational| v.numerator() * (&below / v.denominator().as_ibig());
        let sum = a.combined(&above(&self.coefficient), &above(&other.coefficient), &b)?;
        if sum.is_zero() {
            return Some(Self::constant(BigRational::zero()));
        }
        let mut result = Self { coefficient: BigRational::from_parts_signed(BigInt::one(), below), factors: shared };
        result.absorb_parts(&sum, 1)?;
        result.bounded()
    }

    fn bounded(self) -> Option<Self> {
        (bits(self.coefficient.numerator()).max(bits(self.coefficient.denominator().as_ibig())) <= MAX_BITS)
            .then_some(self)
    }

    /// Multiplies by a power of any polynomial but zero.
    fn absorb_parts(&mut self, p: &Poly, k: i32) -> Option<()> {
        let (content, shared, rest) = p.parts();
        self.coefficient *= BigRational::from(content).pow(k as isize);
        for (atom, l) in shared.powers() {
            self.absorb(&Arc::new(Poly::monomial(Monomial::of(atom.clone()))), k.checked_mul(l.to_i32()?)?)?;
        }
        if rest == Poly::one() { Some(()) } else { self.absorb(&Arc::new(rest), k) }
    }

    /// Multiplies by a power of a polynomial of the kind that is kept, and cancels what is seen to cancel.
    fn absorb(&mut self, p: &Arc<Poly>, k: i32) -> Option<()> {
        if !self.factors.contains_key(p)
            && let Some((q, quotient, above)) = self.opposite(p, k)
        {
            // pᵏ·qˡ with p = q·quotient, or q = p·quotient: as many as there are of both meet.
            let meet = k.unsigned_abs().min(self.factors.get(&q)?.unsigned_abs()).to_i32()? * k.signum();
            self.raise(&q, meet)?;
            self.absorb_parts(&quotient, if above { meet } else { -meet })?;
            return if k == meet { Some(()) } else { self.absorb(p, k - meet) };
        }
        self.raise(p, k)
    }

    /// A factor on the other side of the line that divides p, or that p divides, with the quotient.
    fn opposite(&self, p: &Arc<Poly>, k: i32) -> Option<(Arc<Poly>, Poly, bool)> {
        let others = self.factors.iter().filter(|(_, l)| l.signum() != k.signum());
        others.map(|(q, _)| q).find_map(|q| {
            let (up, down) = (quotient(p, q).map(|d| (d, true)), || quotient(q, p).map(|d| (d, false)));
            up.or_else(down).map(|(d, above)| (q.clone(), d, above))
        })
    }

    fn raise(&mut self, p: &Arc<Poly>, by: i32) -> Option<()> {
        let power = self.factors.entry(p.clone()).or_insert(0);
        *power = power.checked_add(by)?;
        if *power == 0 {
            self.factors.remove(p);
        }
        Some(())
    }

    /// What stands above the line.
    pub fn numerator(&self) -> Expr {
        product(self.coefficient.numerator(), self.factors.iter().map(|(p, k)| (p, *k)))
    }

    /// What stands below the line.
    pub fn denominator(&self) -> Expr {
        product(self.coefficient.denominator().as_ibig(), self.factors.iter().map(|(p, k)| (p, k.saturating_neg())))
    }

    /// The quotient as a formula.
    pub fn expr(&self) -> Expr {
        &self.numerator() / &self.denominator()
    }
}

/// A polynomial with one arctangent at most, and that of a quotient of symbols.
///
/// Such an arctangent is transcendental over the symbols, their sines and cosines: it is half the logarithm of
/// (1 + iu)/(1 − iu), a quotient of symbols, which no product of powers of eⁱˣ is (a constant u: theorem of Lindemann).
/// Among several there are relations, arctan(3/4) = 2 arctan(1/3), that the form does not show.
fn is_surely_nonzero(p: &Poly) -> bool {
    let mut arctans = p.atoms().filter_map(|a| if let Atom::Arctan(u) = a { Some(u) } else { None });
    let Some(first) = arctans.next() else { return true };
    first.is_rational() && arctans.all(|u| u == first)
}

/// p/q; of single atoms only a sine can divide what it does not stand in.
fn quotient(p: &Poly, q: &Poly) -> Option<Poly> {
    match q.as_atom() {
        Some(Atom::Sin(_)) | None => p.divided_by(q),
        Some(_) => None,
    }
}

/// Of every factor the lower of both powers, where one is missing zero.
fn shared(a: &Factors, b: &Factors) -> Factors {
    let lower = |p: &Arc<Poly>| a.get(p).copied().unwrap_or(0).min(b.get(p).copied().unwrap_or(0));
    a.keys().chain(b.keys()).map(|p| (p.clone(), lower(p))).filter(|(_, k)| *k != 0).collect()
}

/// The product of what is left when the shared powers are taken out.
fn expanded(factors: &Factors, shared: &Factors) -> Option<Poly> {
    let mut product = Poly::one();
    for p in factors.keys().chain(shared.keys().filter(|p| !factors.contains_key(*p))) {
        let power = |of: &Factors| of.get(p).copied().unwrap_or(0);
        let left = power(factors).checked_sub(power(shared))?.to_u32()?;
        product = product.times(&p.power(left)?)?;
    }
    Some(product)
}

/// A whole number times the positive powers.
fn product<'a>(size: &BigInt, factors: impl Iterator<Item = (&'a Arc<Poly>, i32)>) -> Expr {
    let number = Expr::number(&BigRational::from(size.clone()));
    factors.filter(|(_, k)| *k > 0).fold(number, |product, (p, k)| &product * &p.expr().pow(k))
}
