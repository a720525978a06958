//! Exact numbers as a carrier: rationals of any size, and angles as rational points of the circle.

use super::rational::{BigInt, BigRational, nearest_f64};
use super::{Fun, Scalar};
use dashu_base::Inverse;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::f64::consts::TAU;
use std::fmt;

/// A rational number, or an angle known by its direction (x, y) with whole x and y.
///
/// | value | read as |
/// |---|---|
/// | number | a rational of any size; nothing is rounded and nothing overflows |
/// | angle | the direction of (x, y) and a count of whole turns; the zero angle is the number 0, a whole turn is not |
/// | undefined | a division by zero, or a result that is neither (√2, sin 1, half of an angle) |
///
/// The tangent of an angle is always rational; its sine and cosine are where x² + y² is a square, as it is for
/// [`Exact::half_tangent`]. Angles may be added and taken a whole number of times. What lies outside is
/// undefined and never rounded, so that an equality of two defined values is a proof at that point.
///
/// ```
/// use creepage::formula::{Exact, Expr};
/// let q1 = Expr::parse("(cot(phi) - e)/(1 + e*cot(phi))").unwrap();
/// let q2 = Expr::parse("cot(phi + atan(e))").unwrap();
/// let at = |s: &str| if s == "phi" { Exact::half_tangent(1, 3) } else { Exact::ratio(2, 7) };
/// let (a, b) = (q1.eval(&|s| at(s.as_str())).unwrap(), q2.eval(&|s| at(s.as_str())).unwrap());
/// assert_eq!((a.to_string(), b.to_string()), ("22/29".into(), "22/29".into()));
/// ```
#[derive(Clone, Debug)]
pub struct Exact(Value);

#[derive(Clone, Debug, PartialEq)]
enum Value {
    Number(BigRational),
    /// A positive multiple of (cos, sin), without common factor, within (−π, π], and whole turns; never zero.
    Angle(BigInt, BigInt, BigInt),
    Undefined,
}

impl Exact {
    /// The number p/q; undefined for q = 0.
    pub fn ratio(p: i64, q: i64) -> Self {
        match q {
            0 => Self::undefined(),
            _ => Self::rational(BigRational::from_parts_signed(p.into(), q.into())),
        }
    }

    /// A rational number.
    pub fn rational(value: BigRational) -> Self {
        Self(Value::Number(value))
    }

    /// The angle whose half has the tangent p/q: cos = (q² − p²)/(q² + p²), sin = 2pq/(q² + p²); q = 0 is half a turn.
    pub fn half_tangent(p: i64, q: i64) -> Self {
        let (p, q) = (BigInt::from(p), BigInt::from(q));
        Self::direction(&q * &q - &p * &p, BigInt::from(2) * p * q)
    }

    /// The angle of the direction (x, y) within (−π, π]; undefined for (0, 0).
    pub fn direction(x: BigInt, y: BigInt) -> Self {
        Self::turned(x, y, BigInt::zero())
    }

    /// The same and whole turns.
    fn turned(x: BigInt, y: BigInt, turns: BigInt) -> Self {
        if x.is_zero() && y.is_zero() {
            return Self::undefined();
        }
        if y.is_zero() && x.is_positive() && turns.is_zero() {
            return Self::rational(BigRational::zero());
        }
        let common = x.gcd(&y);
        Self(Value::Angle(x / &common, y / common, turns))
    }

    /// The number, if it is one.
    pub fn as_rational(&self) -> Option<&BigRational> {
        match &self.0 {
            Value::Number(v) => Some(v),
            _ => None,
        }
    }

    /// The direction of an angle, whatever its whole turns; the number 0 is the direction of x.
    pub fn as_direction(&self) -> Option<(BigInt, BigInt)> {
        match &self.0 {
            Value::Angle(x, y, _) => Some((x.clone(), y.clone())),
            Value::Number(v) if v.is_zero() => Some((BigInt::one(), BigInt::zero())),
            _ => None,
        }
    }

    /// The value to about fifteen digits.
    pub fn to_f64(&self) -> f64 {
        match &self.0 {
            Value::Number(v) => nearest_f64(v),
            Value::Angle(x, y, turns) => {
                // A quotient of the two is exact enough and cannot overflow.
                let size = BigRational::from(x.abs().max(y.abs()));
                let part = |v: &BigInt| nearest_f64(&(BigRational::from(v.clone()) / &size));
                part(y).atan2(part(x)) + TAU * nearest_f64(&BigRational::from(turns.clone()))
            }
            Value::Undefined => f64::NAN,
        }
    }

    fn undefined() -> Self {
        Self(Value::Undefined)
    }

    fn of(value: Option<BigRational>) -> Self {
        value.map_or_else(Self::undefined, Self::rational)
    }
}

/// √v where it is rational.
pub(super) fn root(v: &BigRational) -> Option<BigRational> {
    let whole = |n: &BigInt| {
        let root = num_integer::Roots::sqrt(n);
        (&root * &root == *n).then_some(root)
    };
    if v.is_negative() {
        return None;
    }
    Some(BigRational::from_parts_signed(whole(v.numerator())?, whole(v.denominator().as_ibig())?))
}

fn quotient(a: &BigInt, b: &BigInt) -> Option<BigRational> {
    (!b.is_zero()).then(|| BigRational::from_parts_signed(a.clone(), b.clone()))
}

/// cos and sin of a direction where they are rational.
fn unit_vector(x: &BigInt, y: &BigInt) -> Option<(BigRational, BigRational)> {
    let size = root(&BigRational::from(x * x + y * y))?;
    let part = |v: &BigInt| BigRational::from(v.clone()) / &size;
    Some((part(x), part(y)))
}

/// A direction of rational components.
fn pointing(x: &BigRational, y: &BigRational) -> Exact {
    let common = x.denominator().as_ibig().lcm(y.denominator().as_ibig());
    let whole = |v: &BigRational| (v * BigRational::from(common.clone())).trunc();
    Exact::direction(whole(x), whole(y))
}

fn of_number(f: Fun, v: &BigRational) -> Exact {
    let one = BigRational::one;
    let at_zero = |value: BigRational| Exact::of(v.is_zero().then_some(value));
    match f {
        Fun::Sin | Fun::Tan | Fun::Tanh => at_zero(BigRational::zero()),
        Fun::Cos | Fun::Exp => at_zero(one()),
        Fun::Cot => Exact::undefined(),
        Fun::Atan => pointing(&one(), v),
        Fun::Asin => root(&(one() - v * v)).map_or_else(Exact::undefined, |c| pointing(&c, v)),
        Fun::Acos => root(&(one() - v * v)).map_or_else(Exact::undefined, |s| pointing(v, &s)),
        Fun::Ln => Exact::of(v.is_one().then(BigRational::zero)),
        Fun::Sqrt => Exact::of(root(v)),
        Fun::Abs => Exact::rational(v.abs()),
        Fun::Sign => Exact::rational(v.signum()),
        Fun::Step => Exact::rational(if v.is_positive() { one() } else { BigRational::zero() }),
    }
}

fn of_angle(f: Fun, x: &BigInt, y: &BigInt) -> Exact {
    Exact::of(match f {
        Fun::Sin => unit_vector(x, y).map(|(_, sin)| sin),
        Fun::Cos => unit_vector(x, y).map(|(cos, _)| cos),
        Fun::Tan => quotient(y, x),
        Fun::Cot => quotient(x, y),
        _ => None,
    })
}

impl Scalar for Exact {
    fn number(value: &BigRational) -> Self {
        Self::rational(value.clone())
    }

    fn add(&self, other: &Self) -> Self {
        use Value::{Angle, Number};
        match (&self.0, &other.0) {
            (Number(a), Number(b)) => Self::rational(a + b),
            (Number(a), Angle(..)) if a.is_zero() => other.clone(),
            (Angle(..), Number(b)) if b.is_zero() => self.clone(),
            // Directions are added as complex numbers are multiplied.
            (Angle(a, b, k), Angle(c, d, l)) => {
                let (x, y) = (a * c - b * d, a * d + b * c);
                let turns = k + l + passed((a, b), (c, d), (&x, &y));
                Self::turned(x, y, turns)
            }
            _ => Self::undefined(),
        }
    }

    fn neg(&self) -> Self {
        match &self.0 {
            Value::Number(v) => Self::rational(-v),
            // Half a turn is its own opposite direction.
            Value::Angle(x, y, turns) if y.is_zero() && x.is_negative() => {
                Self::turned(x.clone(), BigInt::zero(), -turns - BigInt::one())
            }
            Value::Angle(x, y, turns) => Self::turned(x.clone(), -y, -turns),
            Value::Undefined => Self::undefined(),
        }
    }

    fn mul(&self, other: &Self) -> Self {
        use Value::{Angle, Number};
        match (&self.0, &other.0) {
            (Number(a), Number(b)) => Self::rational(a * b),
            (Number(n), Angle(..)) => times(n, other),
            (Angle(..), Number(n)) => times(n, self),
            _ => Self::undefined(),
        }
    }

    fn recip(&self) -> Self {
        Self::of(self.as_rational().filter(|v| !v.is_zero()).map(Inverse::inv))
    }

    fn call(f: Fun, x: &Self) -> Self {
        match &x.0 {
            Value::Number(v) => of_number(f, v),
            Value::Angle(a, b, _) => of_angle(f, a, b),
            Value::Undefined => Self::undefined(),
        }
    }

    fn is_defined(&self) -> bool {
        self.0 != Value::Undefined
    }

    fn equals(&self, other: &Self) -> bool {
        self.is_defined() && self.0 == other.0
    }
}

/// An angle a whole number of times; a thousand turns are as many as a formula can hold.
fn times(n: &BigRational, angle: &Exact) -> Exact {
    let count = if n.is_int() { n.numerator().to_i32().filter(|k| k.abs() <= 1000) } else { None };
    let Some(count) = count else { return Exact::undefined() };
    let once = if count < 0 { angle.neg() } else { angle.clone() };
    (0..count.unsigned_abs()).fold(Exact::ratio(0, 1), |sum, _| sum.add(&once))
}

/// The whole turns by which the sum of two angles within (−π, π] passes that range.
fn passed(a: (&BigInt, &BigInt), b: (&BigInt, &BigInt), sum: (&BigInt, &BigInt)) -> i32 {
    let below = |(_, y): (&BigInt, &BigInt)| y.is_negative();
    let half = |(x, y): (&BigInt, &BigInt)| y.is_zero() && x.is_negative();
    match (below(a), below(b)) {
        // Of two angles from zero on the sum is, too; only two half turns come back to the direction of x.
        (false, false) => i32::from(below(sum) || (half(a) && half(b))),
        (true, true) => -i32::from(!below(sum)),
        _ => 0,
    }
}

/// `p/q` for a number, `angle(x, y)` for an angle, `angle(x, y) + k turns` beyond (−π, π].
impl fmt::Display for Exact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Value::Number(v) => write!(f, "{v}"),
            Value::Angle(x, y, k) if k.is_zero() => write!(f, "angle({x}, {y})"),
            Value::Angle(x, y, k) => write!(f, "angle({x}, {y}) + {k} turns"),
            Value::Undefined => f.write_str("undefined"),
        }
    }
}
