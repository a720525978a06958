//! A formula as a polynomial in its atoms: like terms collected, products multiplied out.

use super::{BigRational, Expr, Fun, Node};
use dashu_base::Inverse;
use num_traits::{One, Signed, Zero};
use std::collections::BTreeMap;

/// A sum of rational multiples of products of atoms.
///
/// An atom is a symbol, a function of something, or a form that is no polynomial (a quotient); so is a product
/// that would take more than 20 000 products of terms: it is not multiplied out. Two formulas with the same
/// polynomial are equal wherever both are defined.
///
/// ```
/// use creepage::formula::{Expr, Polynomial};
/// let p = Polynomial::of(&Expr::parse("(a + b)*(a - b) + b^2").unwrap());
/// assert_eq!(p.expr().to_string(), "a^2");
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Polynomial {
    terms: BTreeMap<Monomial, BigRational>,
}

/// Powers of atoms, each atom named by its printed form.
type Monomial = BTreeMap<Atom, i32>;

/// Most products of two terms that multiplying out one product may take.
const MAX_WORK: usize = 20_000;

#[derive(Clone, Debug)]
struct Atom {
    rank: u8,
    name: String,
    expr: Expr,
}

impl Atom {
    fn new(expr: &Expr) -> Self {
        // Functions print before plain names: cos(delta)*L*phi'.
        let rank = u8::from(matches!(expr.node(), Node::Sym(_)));
        Self { rank, name: expr.to_string(), expr: expr.clone() }
    }

    fn key(&self) -> (u8, &str) {
        (self.rank, &self.name)
    }
}

impl PartialEq for Atom {
    fn eq(&self, other: &Self) -> bool {
        self.key() == other.key()
    }
}
impl Eq for Atom {}
impl PartialOrd for Atom {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Atom {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.key().cmp(&other.key())
    }
}

/// Multiplies a product by a power of an atom.
fn raise(m: &mut Monomial, atom: &Atom, by: i32) {
    *m.entry(atom.clone()).or_insert(0) += by;
    m.retain(|_, k| *k != 0);
}

impl Polynomial {
    /// The polynomial of a formula.
    pub fn of(e: &Expr) -> Self {
        match e.node() {
            Node::Num(v) => Self::constant(v.clone()),
            Node::Neg(x) => Self::of(x).scaled(&-BigRational::one()),
            Node::Add(a, b) => Self::of(a).plus(&Self::of(b)),
            Node::Sub(a, b) => Self::of(a).plus(&Self::of(b).scaled(&-BigRational::one())),
            Node::Mul(a, b) => Self::of(a).times(&Self::of(b)).unwrap_or_else(|| Self::atom(e)),
            Node::Div(a, b) => match b.as_number() {
                Some(v) if !v.is_zero() => Self::of(a).scaled(&v.inv()),
                _ => Self::of(a).times(&Self::atom(&(&Expr::int(1) / b))).unwrap_or_else(|| Self::atom(e)),
            },
            Node::Pow(x, n) if (0..=8).contains(n) => {
                let base = Self::of(x);
                let power = (0..*n).try_fold(Self::constant(BigRational::one()), |p, _| p.times(&base));
                power.unwrap_or_else(|| Self::atom(e))
            }
            Node::Sym(_) | Node::Pow(..) | Node::Call(..) => Self::atom(e),
        }
    }

    fn constant(v: BigRational) -> Self {
        let mut p = Self::default();
        p.add_term(Monomial::new(), v);
        p
    }

    fn atom(e: &Expr) -> Self {
        let mut p = Self::default();
        p.add_term([(Atom::new(e), 1)].into(), BigRational::one());
        p
    }

    fn add_term(&mut self, m: Monomial, v: BigRational) {
        let entry = self.terms.entry(m.clone()).or_insert_with(BigRational::zero);
        *entry += v;
        if entry.is_zero() {
            self.terms.remove(&m);
        }
    }

    fn plus(mut self, other: &Self) -> Self {
        other.terms.iter().for_each(|(m, v)| self.add_term(m.clone(), v.clone()));
        self
    }

    fn scaled(mut self, factor: &BigRational) -> Self {
        self.terms.retain(|_, v| {
            *v *= factor;
            !v.is_zero()
        });
        self
    }

    /// The product; nothing where it is too large.
    fn times(&self, other: &Self) -> Option<Self> {
        if self.terms.len().saturating_mul(other.terms.len()) > MAX_WORK {
            return None;
        }
        let mut product = Self::default();
        for (m, v) in &self.terms {
            for (n, w) in &other.terms {
                let mut joined = m.clone();
                n.iter().for_each(|(a, k)| *joined.entry(a.clone()).or_insert(0) += k);
                product.add_term(joined, v * w);
            }
        }
        Some(product)
    }

    /// Whether every term has cancelled.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The polynomial as a formula, terms and factors in a fixed order.
    pub fn expr(&self) -> Expr {
        let terms: Vec<_> = self.terms.iter().map(|(m, v)| (v.is_negative(), term(m, &v.abs()))).collect();
        signed_sum(&terms)
    }

    /// The same with cos²x + sin²x written as one.
    ///
    /// ```
    /// use creepage::formula::{Expr, Polynomial};
    /// let p = Polynomial::of(&Expr::parse("L*cos(x)^2 + L*sin(x)^2 + sin(x)").unwrap());
    /// assert_eq!(p.squares_joined().expr().to_string(), "sin(x) + L");
    /// ```
    pub fn squares_joined(&self) -> Self {
        let mut joined = self.clone();
        while let Some((with_cos, with_sin, rest)) = joined.square_pair() {
            let Some(factor) = joined.terms.remove(&with_cos) else { break };
            joined.terms.remove(&with_sin);
            joined.add_term(rest, factor);
        }
        joined
    }

    /// Two terms m·cos²x and m·sin²x with the same factor, and m.
    fn square_pair(&self) -> Option<(Monomial, Monomial, Monomial)> {
        self.terms.iter().find_map(|(m, v)| {
            m.iter().filter(|(_, k)| **k >= 2).find_map(|(atom, _)| {
                let Node::Call(Fun::Cos, x) = atom.expr.node() else { return None };
                let mut rest = m.clone();
                raise(&mut rest, atom, -2);
                let mut with_sin = rest.clone();
                raise(&mut with_sin, &Atom::new(&Expr::call(Fun::Sin, x)), 2);
                (self.terms.get(&with_sin) == Some(v)).then(|| (m.clone(), with_sin, rest))
            })
        })
    }

    /// Divides both by what every term of both has in common, where the divisor is a single term.
    ///
    /// ```
    /// use creepage::formula::{Expr, Polynomial};
    /// let p = |s| Polynomial::of(&Expr::parse(s).unwrap());
    /// let (top, bottom) = p("a*r*u + a*r*w").cancelled(&p("2*a"));
    /// assert_eq!((top.expr().to_string(), bottom.expr().to_string()), ("r*u/2 + r*w/2".into(), "1".into()));
    /// ```
    pub fn cancelled(&self, divisor: &Polynomial) -> (Polynomial, Polynomial) {
        let mut single = divisor.terms.iter();
        let (Some((m, v)), None) = (single.next(), single.next()) else { return (self.clone(), divisor.clone()) };
        let shared: Monomial = m
            .iter()
            .map(|(a, k)| {
                (a.clone(), self.terms.keys().map(|t| t.get(a).copied().unwrap_or(0)).min().unwrap_or(0).min(*k))
            })
            .collect();
        let reduced = |t: &Monomial| -> Monomial {
            let rest = t.iter().map(|(a, k)| (a.clone(), k - shared.get(a).copied().unwrap_or(0)));
            rest.filter(|(_, k)| *k != 0).collect()
        };
        let top = Polynomial { terms: self.terms.iter().map(|(t, w)| (reduced(t), w / v)).collect() };
        let bottom = Polynomial { terms: [(reduced(m), BigRational::one())].into() };
        (top, bottom)
    }
}

/// The most terms of a sum that are chained one after the other; longer sums are split in halves, so that no recursion
/// goes deep.
const FLAT_TERMS: usize = 200;

/// A sum of terms, with which of them are subtracted.
pub(super) fn signed_sum(terms: &[(bool, Expr)]) -> Expr {
    if terms.len() > FLAT_TERMS {
        let (a, b) = terms.split_at(terms.len() / 2);
        return &signed_sum(a) + &signed_sum(b);
    }
    terms.iter().fold(Expr::int(0), |sum, (negative, term)| if *negative { &sum - term } else { &sum + term })
}

/// A rational multiple of a product: small denominators as a quotient, others as a decimal where they are one.
fn term(m: &Monomial, size: &BigRational) -> Expr {
    let quotient = *size.denominator().as_ibig() <= 9.into();
    let (factor, divisor) = match quotient {
        true => (size.numerator().clone().into(), size.denominator().as_ibig().clone().into()),
        false => (size.clone(), BigRational::one()),
    };
    let (numerators, denominators): (Vec<_>, Vec<_>) = m.iter().partition(|(a, _)| !is_reciprocal(&a.expr));
    let number = (!factor.is_one()).then(|| Expr::number(&factor));
    let top = numerators.iter().fold(number, |p, (a, k)| times(p, a.expr.pow(**k))).unwrap_or_else(|| Expr::int(1));
    let term = denominators.iter().fold(top, |p, (a, k)| &p / &a.expr.children()[1].pow(**k));
    &term / &Expr::number(&divisor)
}

fn times(product: Option<Expr>, factor: Expr) -> Option<Expr> {
    Some(match product {
        None => factor,
        Some(p) => &p * &factor,
    })
}

/// 1/x
fn is_reciprocal(e: &Expr) -> bool {
    matches!(e.node(), Node::Div(a, _) if a.is_one())
}

impl Expr {
    /// The formula multiplied out with like terms collected, as far as [`Polynomial`] goes.
    pub fn tidy(&self) -> Expr {
        Polynomial::of(self).expr()
    }
}
