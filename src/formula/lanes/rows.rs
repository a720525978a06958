//! Memory for lanes, aligned to cache lines.

use std::ops::{Deref, DerefMut};

/// Numbers in a line of the processor's memory: a vector across two of them takes twice as long to read or write.
const LINE: usize = 8;

/// Rows of `L` lanes, zero at first, that begin where a line of the processor's memory does.
///
/// ```
/// use creepage::formula::Rows;
/// let mut rows = Rows::<16>::new(3);
/// rows[2][15] = 1.0;
/// assert_eq!((rows.len(), rows[2][15], rows.as_ptr() as usize % 64), (3, 1.0, 0));
/// ```
#[derive(Debug)]
pub struct Rows<const L: usize> {
    numbers: Vec<f64>,
    /// Where the first row begins.
    first: usize,
    rows: usize,
}

impl<const L: usize> Rows<L> {
    /// So many rows.
    pub fn new(rows: usize) -> Self {
        // Rows that are no whole lines gain nothing.
        let spare = if L.is_multiple_of(LINE) { LINE } else { 0 };
        let numbers = vec![0.0; rows * L + spare];
        let beyond = numbers.as_ptr() as usize / size_of::<f64>() % LINE;
        Self { first: if spare == 0 { 0 } else { (LINE - beyond) % LINE }, numbers, rows }
    }
}

impl<const L: usize> Default for Rows<L> {
    fn default() -> Self {
        Self::new(0)
    }
}

impl<const L: usize> Clone for Rows<L> {
    fn clone(&self) -> Self {
        let mut copy = Self::new(self.rows);
        copy.copy_from_slice(self);
        copy
    }
}

impl<const L: usize> Deref for Rows<L> {
    type Target = [[f64; L]];
    #[inline(always)]
    fn deref(&self) -> &[[f64; L]] {
        self.numbers[self.first..][..self.rows * L].as_chunks().0
    }
}

impl<const L: usize> DerefMut for Rows<L> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [[f64; L]] {
        self.numbers[self.first..][..self.rows * L].as_chunks_mut().0
    }
}
