//! The limits e₁ and e₂ between creep and sliding.

use crate::error::{Error, Result};
use std::fmt;
use std::str::FromStr;

/// The coefficients e₂ < 0 < e₁ between which a wheel creeps; at and beyond them it slides.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | e₁ | 1 | upper limit: slipping from here on; side-slip to the left |
/// | e₂ | 1 | lower limit: skidding down from here; side-slip to the right |
///
/// They are inputs. Source: section 5 of the theory.
///
/// ```
/// use creepage::mechanism::Limits;
/// let limits: Limits = "-0.2, 0.3".parse().unwrap();
/// assert_eq!((limits.lower(), limits.upper()), (-0.2, 0.3));
/// assert_eq!(limits.to_string(), "-0.2 to 0.3");
/// assert!(Limits::new(0.0, 0.3).is_err() && "0.3,-0.2".parse::<Limits>().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    lower: f64,
    upper: f64,
}

/// How limits are written.
const EXAMPLE: &str = "write them as -0.2,0.2";

impl Limits {
    /// The limits e₂ and e₁.
    ///
    /// # Errors
    /// When they are not finite, or zero does not lie between them.
    pub fn new(lower: f64, upper: f64) -> Result<Self> {
        let wrong = |what: String| Err(Error::input(what).help(EXAMPLE));
        match (lower, upper) {
            _ if !lower.is_finite() || !upper.is_finite() => {
                wrong(format!("the limits {lower} and {upper} must be finite"))
            }
            _ if lower >= 0.0 => wrong(format!("the lower limit {lower} must be below zero")),
            _ if upper <= 0.0 => wrong(format!("the upper limit {upper} must be above zero")),
            _ => Ok(Self { lower, upper }),
        }
    }

    /// e₂.
    pub fn lower(&self) -> f64 {
        self.lower
    }

    /// e₁.
    pub fn upper(&self) -> f64 {
        self.upper
    }
}

impl FromStr for Limits {
    type Err = Error;

    /// Reads `e2,e1`.
    fn from_str(text: &str) -> Result<Self> {
        let numbers: Option<Vec<f64>> = text.split(',').map(|part| part.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some([lower, upper]) => Self::new(*lower, *upper),
            _ => Err(Error::input("limits are two numbers, the lower and the upper one").help(EXAMPLE)),
        }
    }
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} to {}", self.lower, self.upper)
    }
}
