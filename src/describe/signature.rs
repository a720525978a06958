//! How many coefficients of each form.

use crate::mechanism::{Constraint, Form};
use std::fmt;

/// Numbers of creep coefficients, R^k T^m: of all constraints by form, or of those that realise the motion.
///
/// [`Signature::of`] counts the constraints in each form, one coefficient each; it says nothing about which of them
/// could be integrated. The signature by ranks is that of [`Realised`](super::Realised).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Signature {
    /// k: constraints of type R.
    pub r: usize,
    /// m: constraints of type T.
    pub t: usize,
}

impl Signature {
    /// What is counted, in words.
    pub const COUNTS: &str = "a count, one creep coefficient each; the holonomic and nonholonomic part and the RT \
                              signature by ranks stand below";

    /// The count of a list of constraints.
    pub fn of(constraints: &[Constraint]) -> Self {
        let r = constraints.iter().filter(|c| matches!(c.form, Form::R(_))).count();
        Self { r, t: constraints.len() - r }
    }

    /// In LaTeX's mathematics mode.
    pub fn latex(&self) -> String {
        self.written(|letter, n| if n == 1 { letter.to_string() } else { format!("{letter}^{{{n}}}") }, r"\,")
    }

    fn written(&self, power: impl Fn(char, usize) -> String, between: &str) -> String {
        let present = [('R', self.r), ('T', self.t)].into_iter().filter(|(_, n)| *n > 0);
        present.map(|(letter, n)| power(letter, n)).collect::<Vec<_>>().join(between)
    }
}

impl fmt::Display for Signature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.written(|letter, n| if n == 1 { letter.to_string() } else { format!("{letter}^{n}") }, " "))
    }
}
