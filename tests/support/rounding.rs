//! A carrier of the tests' own: a value with a bound on what rounding may have done to it.

use super::tree::function;
use creepage::formula::{BigRational, Fun, Scalar};

/// NaN for what is not finite.
pub fn finite(x: f64) -> f64 {
    if x.is_finite() { x } else { f64::NAN }
}

/// A value and how far off it may be; undefined also where rounding decides whether there is a value.
#[derive(Clone, Copy, Debug)]
pub struct Rounded {
    pub value: f64,
    pub error: f64,
}

const UNIT: f64 = 4.0 * f64::EPSILON;

impl Rounded {
    pub fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    fn new(value: f64, error: f64) -> Self {
        let error = error + UNIT * value.abs() + f64::MIN_POSITIVE;
        // A bound of first order must stay small, and a large value leave room for its derivatives.
        let known = value.abs() < 1e60 && error < 1e-6 * (1.0 + value.abs());
        if known { Self { value, error } } else { Self { value: f64::NAN, error: f64::NAN } }
    }

    fn nowhere() -> Self {
        Self::exact(f64::NAN)
    }

    /// Whether another reading of the same formula may have this value.
    pub fn allows(&self, other: f64, slack: f64) -> bool {
        (self.value - other).abs() <= slack * (self.error + UNIT * self.value.abs() + f64::MIN_POSITIVE)
    }

    fn scaled(&self, value: f64, slope: f64) -> Self {
        Self::new(value, 2.0 * self.error * slope.abs())
    }

    /// Whether the true value surely lies where `holds` holds.
    fn surely(&self, holds: impl Fn(f64) -> bool) -> bool {
        let reach = 1e-9 * (1.0 + self.value.abs()) + 4.0 * self.error;
        holds(self.value - reach) && holds(self.value + reach)
    }

    /// Whether the argument is away from every jump and singularity of a function, or exact.
    fn is_safe(&self, f: Fun) -> bool {
        self.value.abs() < 1e4
            && match f {
                Fun::Tan => self.value.cos().abs() > 1e-4,
                Fun::Cot => self.value.sin().abs() > 1e-4,
                Fun::Asin | Fun::Acos => self.surely(|x| x.abs() < 1.0),
                Fun::Ln | Fun::Sqrt => self.surely(|x| x > 0.0),
                Fun::Abs | Fun::Sign | Fun::Step => self.surely(|x| x > 0.0) || self.surely(|x| x < 0.0),
                _ => true,
            }
    }
}

/// f′(x)
fn slope(f: Fun, x: f64) -> f64 {
    match f {
        Fun::Sin => x.cos(),
        Fun::Cos => x.sin(),
        Fun::Tan => x.cos().powi(-2),
        Fun::Cot => x.sin().powi(-2),
        Fun::Asin | Fun::Acos => (1.0 - x * x).sqrt().recip(),
        Fun::Atan | Fun::Tanh | Fun::Abs => 1.0,
        Fun::Exp => x.exp(),
        Fun::Ln => x.recip(),
        Fun::Sqrt => 0.5 / x.sqrt(),
        Fun::Sign | Fun::Step => 0.0,
    }
}

impl Scalar for Rounded {
    fn number(value: &BigRational) -> Self {
        let value = f64::number(value);
        Self::new(value, 0.0)
    }
    fn add(&self, o: &Self) -> Self {
        let parts = UNIT * (self.value.abs() + o.value.abs());
        Self::new(self.value + o.value, self.error + o.error + parts)
    }
    fn neg(&self) -> Self {
        Self { value: -self.value, error: self.error }
    }
    fn mul(&self, o: &Self) -> Self {
        let error = self.value.abs() * o.error + o.value.abs() * self.error + self.error * o.error;
        Self::new(self.value * o.value, error)
    }
    fn recip(&self) -> Self {
        if !self.surely(|x| x > 0.0) && !self.surely(|x| x < 0.0) {
            return Self::nowhere();
        }
        self.scaled(self.value.recip(), self.value.powi(-2))
    }
    fn call(f: Fun, x: &Self) -> Self {
        if x.is_safe(f) { x.scaled(function(f, x.value), slope(f, x.value)) } else { Self::nowhere() }
    }
    fn is_defined(&self) -> bool {
        self.value.is_finite()
    }
    fn equals(&self, other: &Self) -> bool {
        self.value == other.value
    }
}
