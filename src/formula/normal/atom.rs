//! Atoms, the indeterminates of a normal form, and their products.

use super::fraction::Fraction;
use crate::formula::{Expr, Fun, Symbol};
use std::cmp::Ordering;
use std::sync::Arc;

/// An indeterminate. The first in this order is the leading one; the sine must come before the cosine, so that
/// writing sin² as 1 − cos² makes a monomial smaller.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Atom {
    Sin(Symbol),
    Cos(Symbol),
    /// The arctangent of a quotient with positive coefficient.
    Arctan(Arc<Fraction>),
    Symbol(Symbol),
}

impl Atom {
    /// The atom as a formula.
    pub fn expr(&self) -> Expr {
        let of = |f, s: &Symbol| Expr::call(f, &Expr::sym(s.clone()));
        match self {
            Atom::Sin(s) => of(Fun::Sin, s),
            Atom::Cos(s) => of(Fun::Cos, s),
            Atom::Arctan(u) => Expr::call(Fun::Atan, &u.expr()),
            Atom::Symbol(s) => Expr::sym(s.clone()),
        }
    }
}

/// A product of powers of atoms, ordered by degree and then by the leading atom: an order that products keep.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub(super) struct Monomial {
    degree: u32,
    powers: Vec<(Atom, u32)>,
}

impl Monomial {
    /// A single atom.
    pub fn of(atom: Atom) -> Self {
        Self { degree: 1, powers: vec![(atom, 1)] }
    }

    /// From powers in the order of atoms.
    fn sorted(powers: Vec<(Atom, u32)>) -> Self {
        Self { degree: powers.iter().map(|(_, k)| k).sum(), powers }
    }

    /// The sum of the exponents.
    pub fn degree(&self) -> u32 {
        self.degree
    }

    /// The atoms with their exponents.
    pub fn powers(&self) -> &[(Atom, u32)] {
        &self.powers
    }

    /// The exponent of an atom.
    pub fn exponent(&self, atom: &Atom) -> u32 {
        self.powers.iter().find(|(a, _)| a == atom).map_or(0, |(_, k)| *k)
    }

    /// The atom of a monomial that is nothing but one.
    pub fn as_atom(&self) -> Option<&Atom> {
        match self.powers.as_slice() {
            [(atom, 1)] => Some(atom),
            _ => None,
        }
    }

    /// The product with its squares of sines taken out, and the symbols of those.
    pub fn times(&self, other: &Self) -> (Self, Vec<Symbol>) {
        let mut squares = Vec::new();
        let mut powers = Vec::with_capacity(self.powers.len() + other.powers.len());
        let (mut a, mut b) = (self.powers.as_slice(), other.powers.as_slice());
        while let (Some((x, k)), Some((y, l))) = (a.first(), b.first()) {
            let order = x.cmp(y);
            match (order, x) {
                (Ordering::Less, _) => powers.push((x.clone(), *k)),
                (Ordering::Greater, _) => powers.push((y.clone(), *l)),
                // A sine never stands squared, so that here it does so for the first time.
                (Ordering::Equal, Atom::Sin(s)) => squares.push(s.clone()),
                (Ordering::Equal, _) => powers.push((x.clone(), k + l)),
            }
            a = &a[usize::from(order.is_le())..];
            b = &b[usize::from(order.is_ge())..];
        }
        powers.extend_from_slice(a);
        powers.extend_from_slice(b);
        (Self::sorted(powers), squares)
    }

    /// The product with a power of an atom that is no sine.
    pub fn raised(&self, atom: &Atom, by: u32) -> Self {
        let mut powers = self.powers.clone();
        match powers.binary_search_by(|(a, _)| a.cmp(atom)) {
            Ok(at) => powers[at].1 += by,
            Err(at) => powers.insert(at, (atom.clone(), by)),
        }
        Self { degree: self.degree + by, powers }
    }

    /// The quotient, where it is one.
    pub fn without(&self, other: &Self) -> Option<Self> {
        let divides = other.powers.iter().all(|(a, k)| self.exponent(a) >= *k);
        let rest = || self.powers.iter().map(|(a, k)| (a.clone(), k - other.exponent(a)));
        divides.then(|| Self::sorted(rest().filter(|(_, k)| *k > 0).collect()))
    }

    /// What two monomials have in common.
    pub fn common(&self, other: &Self) -> Self {
        let shared = self.powers.iter().map(|(a, k)| (a.clone(), (*k).min(other.exponent(a))));
        Self::sorted(shared.filter(|(_, k)| *k > 0).collect())
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Monomial {
    fn cmp(&self, other: &Self) -> Ordering {
        let mut pairs = self.powers.iter().zip(&other.powers);
        // Of two atoms the leading one, which is the smaller, makes the greater monomial.
        let mut lexical = || pairs.find_map(|((x, k), (y, l))| Some(y.cmp(x).then(k.cmp(l))).filter(|o| o.is_ne()));
        self.degree.cmp(&other.degree).then_with(|| lexical().unwrap_or(Ordering::Equal))
    }
}
