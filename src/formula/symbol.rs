//! A name in a formula.

use super::Fun;
use std::fmt;
use std::sync::Arc;

/// A name: letters, digits, `_` and `.`, with trailing primes for rates (`phi'` is the rate of `phi`).
///
/// ```
/// use creepage::formula::Symbol;
/// assert_eq!(Symbol::new("phi").rate().as_str(), "phi'");
/// ```
#[derive(Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Symbol(Arc<str>);

impl Symbol {
    /// The symbol of that name.
    pub fn new(name: &str) -> Self {
        Self(Arc::from(name))
    }

    /// The name.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The symbol of the time derivative: one more prime.
    pub fn rate(&self) -> Self {
        Self::new(&format!("{}'", self.0))
    }

    /// Whether a formula could hold this name: it reads back as one symbol.
    pub fn is_well_formed(&self) -> bool {
        let stem = self.0.trim_end_matches('\'');
        stem.starts_with(is_start) && stem.chars().all(is_inner) && Fun::named(&self.0).is_none()
    }
}

/// Whether a name may begin with this character.
pub(super) fn is_start(c: char) -> bool {
    c.is_alphabetic() || c == '_'
}

/// Whether a name may go on with this character.
pub(super) fn is_inner(c: char) -> bool {
    c.is_alphanumeric() || c == '_' || c == '.'
}

impl fmt::Display for Symbol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl fmt::Debug for Symbol {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}`", self.0)
    }
}

impl From<&str> for Symbol {
    fn from(name: &str) -> Self {
        Self::new(name)
    }
}
