//! Unit exponents as a carrier: the units of a formula, or why it has none.

use super::{BigRational, Fun, Scalar};
use num_rational::Rational32;
use num_traits::{CheckedAdd, CheckedMul, Zero};
use std::fmt;

/// Exponents of metre, second and kilogram; a radian is a number, so that r·θ is a length.
///
/// | value | meaning |
/// |---|---|
/// | known | m^a·s^b·kg^c |
/// | any | the number zero, which may stand for zero of any unit |
/// | undefined | the formula adds unlike units or takes the sine of a length |
///
/// ```
/// use creepage::formula::{Expr, Unit};
/// let unit = |s: &str| match s { "r" => Unit::parse("m").unwrap(), _ => Unit::parse("rad/s").unwrap() };
/// let v = Expr::parse("r*theta'").unwrap();
/// assert_eq!(v.eval(&|s| unit(s.as_str())).unwrap().to_string(), "m/s");
/// assert!(Expr::parse("r + theta'").unwrap().eval(&|s| unit(s.as_str())).is_none());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Unit(Kind);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Known([Rational32; 3]),
    Any,
    Undefined,
}

const NAMES: [&str; 3] = ["m", "s", "kg"];
/// A newton in metres, seconds and kilograms.
const NEWTON: [i32; 3] = [1, -2, 1];

impl Unit {
    /// A pure number.
    pub fn number_unit() -> Self {
        Unit(Kind::Known([Rational32::zero(); 3]))
    }

    /// Reads `m`, `rad/s`, `kg*m^2`, `s^2/m^2`, `N*m`, `1`; `None` when it is no unit.
    pub fn parse(text: &str) -> Option<Self> {
        let mut exponents = [Rational32::zero(); 3];
        let mut sign = 1;
        for (i, part) in text.split('/').enumerate() {
            for factor in part.split('*') {
                let (name, power) = factor.trim().split_once('^').unwrap_or((factor.trim(), "1"));
                let power: i32 = power.parse().ok().filter(|p: &i32| p.abs() < 100)?;
                match NAMES.iter().position(|n| *n == name) {
                    Some(k) => exponents[k] += Rational32::from(sign * power),
                    None if name == "N" => {
                        for (exponent, of_force) in exponents.iter_mut().zip(NEWTON) {
                            *exponent += Rational32::from(sign * power * of_force);
                        }
                    }
                    None if name == "rad" || name == "1" => {}
                    None => return None,
                }
            }
            if i == 0 {
                sign = -1;
            }
        }
        Some(Unit(Kind::Known(exponents)))
    }

    /// Whether a formula of this unit may stand where `wanted` is asked for.
    pub fn fits(&self, wanted: &Unit) -> bool {
        match (self.0, wanted.0) {
            (Kind::Known(a), Kind::Known(b)) => a == b,
            (Kind::Any, Kind::Known(_)) => true,
            _ => false,
        }
    }

    fn map(self, f: impl Fn(Rational32) -> Option<Rational32>) -> Self {
        let Kind::Known(e) = self.0 else { return self };
        match (f(e[0]), f(e[1]), f(e[2])) {
            (Some(a), Some(b), Some(c)) => Unit(Kind::Known([a, b, c])),
            _ => Unit(Kind::Undefined),
        }
    }
}

impl Scalar for Unit {
    fn number(value: &BigRational) -> Self {
        if value.is_zero() { Unit(Kind::Any) } else { Self::number_unit() }
    }
    fn add(&self, other: &Self) -> Self {
        match (self.0, other.0) {
            (Kind::Any, x) | (x, Kind::Any) => Unit(x),
            (Kind::Known(a), Kind::Known(b)) if a == b => *self,
            _ => Unit(Kind::Undefined),
        }
    }
    fn neg(&self) -> Self {
        *self
    }
    fn mul(&self, other: &Self) -> Self {
        match (self.0, other.0) {
            (Kind::Undefined, _) | (_, Kind::Undefined) => Unit(Kind::Undefined),
            (Kind::Any, _) | (_, Kind::Any) => Unit(Kind::Any),
            (Kind::Known(a), Kind::Known(b)) => {
                let sum = |k: usize| a[k].checked_add(&b[k]);
                match (sum(0), sum(1), sum(2)) {
                    (Some(x), Some(y), Some(z)) => Unit(Kind::Known([x, y, z])),
                    _ => Unit(Kind::Undefined),
                }
            }
        }
    }
    fn recip(&self) -> Self {
        match self.0 {
            Kind::Known(_) => self.powi(-1),
            _ => Unit(Kind::Undefined),
        }
    }
    fn powi(&self, n: i32) -> Self {
        if n < 0 && self.0 == Kind::Any {
            return Unit(Kind::Undefined);
        }
        if n == 0 && self.0 == Kind::Any {
            return Self::number_unit();
        }
        self.map(|e| e.checked_mul(&Rational32::from(n)))
    }
    fn call(f: Fun, x: &Self) -> Self {
        let plain = x.fits(&Self::number_unit());
        match f {
            Fun::Abs => *x,
            Fun::Sqrt => x.map(|e| e.checked_mul(&Rational32::new(1, 2))),
            Fun::Sign | Fun::Step if x.is_defined() => Self::number_unit(),
            Fun::Sin | Fun::Tan | Fun::Asin | Fun::Atan | Fun::Tanh if plain => *x,
            Fun::Ln | Fun::Cot if x.0 == Kind::Any => Unit(Kind::Undefined),
            _ if plain => Self::number_unit(),
            _ => Unit(Kind::Undefined),
        }
    }
    fn is_defined(&self) -> bool {
        self.0 != Kind::Undefined
    }
    fn equals(&self, other: &Self) -> bool {
        self.is_defined() && self.0 == other.0
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let exponents = match self.0 {
            Kind::Known(e) => e,
            Kind::Any => return f.write_str("any"),
            Kind::Undefined => return f.write_str("undefined"),
        };
        let one = Rational32::from(1);
        let side = |positive: bool| -> Vec<String> {
            let wanted =
                NAMES.iter().zip(exponents).filter(|(_, e)| !e.is_zero() && (*e > Rational32::zero()) == positive);
            wanted
                .map(|(name, e)| {
                    let e = if positive { e } else { -e };
                    match e {
                        e if e == one => (*name).to_string(),
                        e if e.is_integer() => format!("{name}^{e}"),
                        e => format!("{name}^({e})"),
                    }
                })
                .collect()
        };
        let (above, below) = (side(true).join("*"), side(false).join("/"));
        match (above.is_empty(), below.is_empty()) {
            (true, true) => f.write_str("1"),
            (false, true) => f.write_str(&above),
            (true, false) => write!(f, "1/{below}"),
            (false, false) => write!(f, "{above}/{below}"),
        }
    }
}
