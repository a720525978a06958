//! How often each kind of thing was met among generated cases.

use std::cell::RefCell;
use std::collections::BTreeMap;

/// Kinds with how often each was met.
#[derive(Default)]
pub struct Met(pub RefCell<BTreeMap<String, usize>>);

impl Met {
    /// A kind that is met, or is not.
    pub fn note(&self, kind: impl Into<String>, is_so: bool) {
        *self.0.borrow_mut().entry(kind.into()).or_default() += usize::from(is_so);
    }

    /// That each kind was met so often.
    pub fn at_least(&self, wanted: &[(&str, usize)]) {
        let found = self.0.borrow();
        for (kind, count) in wanted {
            assert!(found.get(*kind).is_some_and(|n| n >= count), "{kind} of at least {count}: {found:?}");
        }
    }
}
