//! The signature RᵏTᵐ: the number of coefficients of each form.

use crate::mechanism::{Constraint, counted};
use std::fmt;

/// Numbers of creep coefficients, R^k T^m: of all constraints by form, or of those that realise the motion.
///
/// [`Signature::of`] counts the constraints in each form, one coefficient each; it says nothing about which of them
/// could be integrated. The signature by ranks is that of [`Realised`](super::Realised).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signature {
    /// Letters with how many there are, none zero: R, T, other letters of the catalogue, letters of one's own types.
    pub counts: Vec<(char, usize)>,
}

impl Signature {
    /// What is counted, in words.
    pub const COUNTS: &str = "a count, one creep coefficient each; the holonomic and nonholonomic part and the RT \
                              signature by ranks stand below";

    /// The count of a list of constraints.
    pub fn of(constraints: &[Constraint]) -> Self {
        Self { counts: counted(constraints.iter().map(Constraint::letter)) }
    }

    /// How many constraints have this letter.
    ///
    /// ```
    /// use creepage::{describe::Signature, model::mechanism, vehicles};
    /// let car = Signature::of(&mechanism(vehicles::named("car").unwrap(), 0).constraints);
    /// assert_eq!((car.count('R'), car.count('T')), (1, 2));
    /// ```
    pub fn count(&self, letter: char) -> usize {
        self.counts.iter().find(|(l, _)| *l == letter).map_or(0, |(_, n)| *n)
    }

    /// In LaTeX's mathematics mode.
    pub fn latex(&self) -> String {
        self.written(|letter, n| if n == 1 { letter.to_string() } else { format!("{letter}^{{{n}}}") }, r"\,")
    }

    fn written(&self, power: impl Fn(char, usize) -> String, between: &str) -> String {
        self.counts.iter().map(|(letter, n)| power(*letter, *n)).collect::<Vec<_>>().join(between)
    }
}

impl fmt::Display for Signature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.written(|letter, n| if n == 1 { letter.to_string() } else { format!("{letter}^{n}") }, " "))
    }
}
