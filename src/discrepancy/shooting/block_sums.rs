//! Sums of residuals over blocks of rows, from which their autocorrelation is estimated.

/// Rows in a block: two, four, … two to this power.
pub(crate) const SCALES: usize = 6;

/// Squared sums of residuals over blocks of neighbouring rows, for blocks of two, four, eight … rows.
#[derive(Clone, Copy, Debug, Default)]
pub struct Blocks {
    pub(crate) squares: [f64; SCALES],
    pub(crate) count: [usize; SCALES],
}

/// The blocks of one column that are not full yet.
#[derive(Clone, Copy, Debug, Default)]
pub struct Run {
    open: [f64; SCALES],
    rows: usize,
}

impl Run {
    /// Takes the next row's residual and hands over the blocks that it fills.
    pub fn push(&mut self, residual: f64, to: &mut Blocks) {
        self.rows += 1;
        for k in 0..SCALES {
            self.open[k] += residual;
            if self.rows.is_multiple_of(2 << k) {
                to.squares[k] += self.open[k].powi(2);
                to.count[k] += 1;
                self.open[k] = 0.0;
            }
        }
    }
}
