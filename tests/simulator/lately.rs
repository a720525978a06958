//! What was worked out for the last times, and is asked for again.

use std::cell::Cell;

/// Values at the last four times: an implicit scheme asks for the same three again and again. No time is the same as
/// what was never asked.
pub struct Lately<T> {
    known: Cell<[(f64, T); 4]>,
    oldest: Cell<usize>,
}

impl<T: Copy + Default> Default for Lately<T> {
    fn default() -> Self {
        Lately { known: Cell::new([(f64::NAN, T::default()); 4]), oldest: Cell::new(0) }
    }
}

impl<T: Copy> Lately<T> {
    /// The value at a time, worked out if it is not among the last.
    pub fn at(&self, t: f64, work_out: impl FnOnce() -> T) -> T {
        let known = self.known.get();
        if let Some((_, value)) = known.iter().find(|(at, _)| *at == t) {
            return *value;
        }
        let value = work_out();
        // Read again: working it out may have asked for others.
        let mut known = self.known.get();
        known[self.oldest.get()] = (t, value);
        self.known.set(known);
        self.oldest.set((self.oldest.get() + 1) % known.len());
        value
    }
}
