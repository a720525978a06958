//! A normal form as a carrier: quotients of trigonometric polynomials, in which identities are decided.

mod angle;
mod atom;
mod fraction;
mod poly;
mod work;

use super::{BigRational, Exact, Expr, Fun, Scalar, Symbol};
use angle::Angle;
use atom::Atom;
use fraction::Fraction;
use num_traits::Zero;
use std::fmt;
use std::sync::Arc;
pub(crate) use work::with_work_bounded;

/// A quotient of polynomials in symbols, their sines and cosines, with rational coefficients.
///
/// P₁/Q₁ = P₂/Q₂ exactly where P₁Q₂ − P₂Q₁ is zero once sin² is written as 1 − cos²: what is left is unique, and of
/// two factors that are not zero neither is the product. [`Scalar::equals`] and [`identical`] rest on that.
///
/// | formula | here |
/// |---|---|
/// | numbers, symbols, + − · /, whole powers | themselves |
/// | sin, cos, tan, cot of kφ + lψ + … with whole k, l | by the sums of angles; φ may also stand bare |
/// | tan, cot of an angle with k·arctan(u) | by the direction (1, u) |
/// | sin, cos of the same | for even k, and where the numbers u make the length rational: sin(arctan(3/4)) = 3/5 |
/// | arctan(u) elsewhere | a further symbol, odd in u |
/// | other functions of a number | where the result is rational: √4, \|−3\|, arcsin(3/5) = arctan(3/4) |
/// | everything else | undefined: sin(φ/2), sin(1), sin(arctan(e)), √x, eˣ |
///
/// Valid generically: 1/P is defined where P is not zero throughout, and [`Normal::denominator`] tells where it is
/// zero; a factor that cancels is gone. Two values that are equal are so wherever both formulas are defined. Of several
/// arctangents that stand outside of tan and cot the form knows no relation; a division by them is undefined.
///
/// The work is bounded: undefined is also a polynomial of more than 200 000 terms, of a degree above 1000 or with a
/// coefficient above 100 000 binary digits, a product of more than 2 000 000 pairs of terms, more than 100 times an
/// angle.
///
/// ```
/// use creepage::formula::{Expr, Normal, Scalar};
/// let normal = |text: &str| Normal::of(&Expr::parse(text).unwrap());
/// // Creep of a wheel shifts its angle: e ↦ (cot φ − e)/(1 + e cot φ) is a rotation by arctan e.
/// assert!(normal("(cot(phi) - e)/(1 + e*cot(phi))").equals(&normal("cot(phi + atan(e))")));
/// // Two after one another are one of (e + f)/(1 − e f).
/// assert!(normal("tan(atan(e) + atan(f))").equals(&normal("(e + f)/(1 - e*f)")));
/// assert_eq!(normal("1/tan(2*phi) - 1/tan(phi)").to_string(), "-1/(2*sin(phi)*cos(phi))");
/// assert!(!normal("1/(sin(phi)^2 + cos(phi)^2 - 1)").is_defined());
/// ```
#[derive(Clone)]
pub struct Normal(Option<Fraction>);

impl Normal {
    /// A symbol as itself.
    pub fn symbol(name: impl Into<Symbol>) -> Self {
        Self(Some(Fraction::atom(Atom::Symbol(name.into()))))
    }

    /// The normal form of a formula, every symbol as itself.
    ///
    /// ```
    /// use creepage::formula::{Expr, Normal};
    /// let e = Expr::parse("(x^2 - y^2)/(x - y)").unwrap();
    /// assert_eq!(Normal::of(&e).to_string(), "x + y");
    /// ```
    pub fn of(e: &Expr) -> Self {
        e.eval_undefined_as_value(&|s| Self::symbol(s.clone()))
    }

    /// Whether it is zero throughout; what is undefined is not.
    pub fn is_zero(&self) -> bool {
        self.0.as_ref().is_some_and(Fraction::is_zero)
    }

    /// What stands above the line, as a product of powers; 0 of what is undefined.
    pub fn numerator(&self) -> Expr {
        self.0.as_ref().map_or_else(|| Expr::int(0), Fraction::numerator)
    }

    /// What stands below the line, as a product of powers; 0 of what is undefined.
    ///
    /// ```
    /// use creepage::formula::{Expr, Normal};
    /// let e = Expr::parse("1/x + y/(x*(x + 1))").unwrap();
    /// assert_eq!(Normal::of(&e).denominator().to_string(), "x*(x + 1)");
    /// ```
    pub fn denominator(&self) -> Expr {
        self.0.as_ref().map_or_else(|| Expr::int(0), Fraction::denominator)
    }
}

/// Whether two formulas are equal wherever both are defined; `None` where the normal form cannot tell.
///
/// | answer | meaning |
/// |---|---|
/// | `Some(true)` | equal at every point where both are defined: a proof |
/// | `Some(false)` | both are defined almost everywhere, and differ almost everywhere |
/// | `None` | outside of the fragment of [`Normal`], too large, or a question about relations of arctangents |
///
/// ```
/// use creepage::formula::{Expr, identical};
/// let ask = |a: &str, b: &str| identical(&Expr::parse(a).unwrap(), &Expr::parse(b).unwrap());
/// assert_eq!(ask("sin(a + b)^2 - sin(a - b)^2", "sin(2*a)*sin(2*b)"), Some(true));
/// assert_eq!(ask("tan(phi)", "sin(phi)"), Some(false));
/// assert_eq!(ask("exp(x)*exp(-x)", "1"), None);
/// ```
pub fn identical(a: &Expr, b: &Expr) -> Option<bool> {
    let difference = Normal::of(a).sub(&Normal::of(b)).0?;
    match difference.is_zero() {
        true => Some(true),
        false => difference.is_surely_nonzero().then_some(false),
    }
}

/// arctan u, odd in u.
fn arctan(u: &Fraction) -> Fraction {
    match (u.is_zero(), u.is_negative()) {
        (true, _) => u.clone(),
        (_, true) => Fraction::atom(Atom::Arctan(Arc::new(u.neg()))).neg(),
        (_, false) => Fraction::atom(Atom::Arctan(Arc::new(u.clone()))),
    }
}

/// A function of a number, as far as its value is a number or the arctangent of one.
fn of_number(f: Fun, v: &BigRational) -> Option<Fraction> {
    let value = Exact::call(f, &Exact::rational(v.clone()));
    if let Some(number) = value.as_rational() {
        return Some(Fraction::constant(number.clone()));
    }
    // Arcsine and arccosine of a direction to the right lie within a quarter of a turn.
    let (x, y) = value.as_direction().filter(|(x, _)| *x > Zero::zero())?;
    Some(arctan(&Fraction::constant(BigRational::from_parts_signed(y, x))))
}

fn call(f: Fun, x: &Fraction) -> Option<Fraction> {
    match f {
        Fun::Sin => Angle::of(x)?.cos_sin().map(|(_, sin)| sin),
        Fun::Cos => Angle::of(x)?.cos_sin().map(|(cos, _)| cos),
        Fun::Tan => Angle::of(x)?.tan(),
        Fun::Cot => Angle::of(x)?.cot(),
        Fun::Atan => Some(arctan(x)),
        _ => of_number(f, x.as_constant()?),
    }
}

impl Scalar for Normal {
    fn number(value: &BigRational) -> Self {
        Self(Some(Fraction::constant(value.clone())))
    }

    fn add(&self, other: &Self) -> Self {
        Self(self.0.as_ref().zip(other.0.as_ref()).and_then(|(a, b)| a.plus(b)))
    }

    fn neg(&self) -> Self {
        Self(self.0.as_ref().map(Fraction::neg))
    }

    fn mul(&self, other: &Self) -> Self {
        Self(self.0.as_ref().zip(other.0.as_ref()).and_then(|(a, b)| a.times(b)))
    }

    fn recip(&self) -> Self {
        self.powi(-1)
    }

    fn powi(&self, n: i32) -> Self {
        Self(self.0.as_ref().and_then(|x| x.power(n)))
    }

    fn call(f: Fun, x: &Self) -> Self {
        Self(x.0.as_ref().and_then(|x| call(f, x)))
    }

    /// Generic: whether there is a value almost everywhere. 1/P is defined where P is not zero throughout.
    fn is_defined(&self) -> bool {
        self.0.is_some()
    }

    /// Equal wherever both are defined.
    fn equals(&self, other: &Self) -> bool {
        self.sub(other).is_zero()
    }
}

impl fmt::Display for Normal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Some(value) => write!(f, "{}", value.expr()),
            None => f.write_str("undefined"),
        }
    }
}

impl fmt::Debug for Normal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}
