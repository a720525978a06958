//! A case of an ensemble: its rows, its estimated error, and whether that is small enough.

/// What became of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Row by row what a logger would see, [`Ensemble::columns`](crate::motion::Ensemble::columns) without the time; nothing where the motion is undefined.
    pub values: Vec<f64>,
    /// The estimated error, absolute or relative to the size of a state above one; none where the motion is undefined.
    pub error: Option<f64>,
    /// Whether the error is at most the one asked for.
    pub converged: bool,
    pub(super) width: usize,
}

impl Case {
    /// Whether the motion is defined all the way.
    pub fn is_defined(&self) -> bool {
        self.error.is_some()
    }

    /// The row of a time.
    ///
    /// # Panics
    /// When the motion is undefined, or there is no such row: a fault of the caller.
    pub fn row(&self, i: usize) -> &[f64] {
        &self.values[i * self.width..(i + 1) * self.width]
    }
}
