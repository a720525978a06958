//! Sine, cosine and tangent of whole combinations of symbols and arctangents.

use super::atom::{Atom, Monomial};
use super::fraction::Fraction;
use crate::formula::exact::root;
use crate::formula::{BigInt, BigRational};
use dashu_base::Inverse;
use num_traits::{One, Pow, ToPrimitive};
use std::sync::Arc;

/// Most times an angle may be taken.
const MAX_TIMES: i32 = 100;

/// A whole combination of symbols and arctangents.
pub(super) struct Angle(Vec<(Atom, i32)>);

/// A multiple of (cos, sin).
struct Direction {
    x: Fraction,
    y: Fraction,
}

impl Angle {
    /// The angle, where a quotient is one.
    pub fn of(value: &Fraction) -> Option<Self> {
        if value.is_zero() {
            return Some(Self(vec![]));
        }
        let (size, p) = value.as_multiple()?;
        let part = |m: &Monomial, v: &BigInt| {
            let times = size * BigRational::from(v.clone());
            let times = if times.is_int() {
                times.numerator().to_i32().filter(|k| k.abs() <= MAX_TIMES)?
            } else {
                return None;
            };
            m.as_atom().filter(|a| matches!(a, Atom::Symbol(_) | Atom::Arctan(_))).map(|a| (a.clone(), times))
        };
        p.terms().map(|(m, v)| part(m, v)).collect::<Option<_>>().map(Self)
    }

    /// tan; nothing where the cosine is zero throughout.
    pub fn tan(&self) -> Option<Fraction> {
        let Direction { x, y } = self.direction(|atom, times| plain(atom).power(times))?;
        y.times(&x.power(-1)?)
    }

    /// cot; nothing where the sine is zero throughout.
    pub fn cot(&self) -> Option<Fraction> {
        let Direction { x, y } = self.direction(|atom, times| plain(atom).power(times))?;
        x.times(&y.power(-1)?)
    }

    /// (cos, sin) where the length of the direction is rational; its sign is known by then.
    pub fn cos_sin(&self) -> Option<(Fraction, Fraction)> {
        let Direction { x, y } = self.direction(of_known_length)?;
        let scale = Fraction::constant(root(&self.constant_square())?.inv());
        Some((x.times(&scale)?, y.times(&scale)?))
    }

    fn direction(&self, part: impl Fn(&Atom, i32) -> Option<Direction>) -> Option<Direction> {
        self.0.iter().try_fold(Direction::zero(), |sum, (atom, times)| sum.plus(&part(atom, *times)?))
    }

    /// The square of the length that the arctangents of numbers bring in: Π(1 + u²)ᵏ.
    fn constant_square(&self) -> BigRational {
        let parts = self.0.iter().filter_map(|(atom, times)| match atom {
            Atom::Arctan(u) => u.as_constant().map(|u| (BigRational::one() + u * u).pow(times.unsigned_abs() as isize)),
            _ => None,
        });
        parts.fold(BigRational::one(), |product, part| product * part)
    }
}

fn number(n: i64) -> Fraction {
    Fraction::constant(BigRational::from(n))
}

/// (cos, sin) of a symbol, (1, u) of the arctangent of u.
fn plain(atom: &Atom) -> Direction {
    match atom {
        Atom::Arctan(u) => Direction { x: number(1), y: Fraction::clone(u) },
        Atom::Symbol(s) | Atom::Sin(s) | Atom::Cos(s) => {
            Direction { x: Fraction::atom(Atom::Cos(s.clone())), y: Fraction::atom(Atom::Sin(s.clone())) }
        }
    }
}

/// A direction of length one, or of the length √(1 + u²)ᵏ with a number u.
///
/// The arctangent of a variable u has the length √(1 + u²), so that only even multiples of it belong here:
/// cos(2 arctan u) = (1 − u²)/(1 + u²), sin(2 arctan u) = 2u/(1 + u²).
fn of_known_length(atom: &Atom, times: i32) -> Option<Direction> {
    match atom {
        Atom::Arctan(u) if u.as_constant().is_none() => {
            let twice = doubled(u)?;
            if times % 2 == 0 { twice.power(times / 2) } else { None }
        }
        _ => plain(atom).power(times),
    }
}

/// The direction of 2 arctan u, of length one.
fn doubled(u: &Arc<Fraction>) -> Option<Direction> {
    let square = u.times(u)?;
    let length = number(1).plus(&square)?.power(-1)?;
    let x = number(1).plus(&square.neg())?.times(&length)?;
    Some(Direction { x, y: number(2).times(u)?.times(&length)? })
}

impl Direction {
    /// The direction of the zero angle.
    fn zero() -> Self {
        Self { x: number(1), y: number(0) }
    }

    /// Directions are added as complex numbers are multiplied.
    fn plus(&self, other: &Self) -> Option<Self> {
        let x = self.x.times(&other.x)?.plus(&self.y.times(&other.y)?.neg())?;
        let y = self.x.times(&other.y)?.plus(&self.y.times(&other.x)?)?;
        Some(Self { x, y })
    }

    /// The angle a whole number of times.
    fn power(&self, n: i32) -> Option<Self> {
        let once = Self { x: self.x.clone(), y: if n < 0 { self.y.neg() } else { self.y.clone() } };
        (0..n.unsigned_abs()).try_fold(Self::zero(), |sum, _| sum.plus(&once))
    }
}
