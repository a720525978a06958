//! The chain rule at the start of a window: hidden states start it where the windows before it carried them, by the parameters.

use crate::motion::{LaneStates, StateSensitivity};
use nalgebra::DMatrix;

/// ∂h/∂p at the start of a window, of hidden states h whose start has columns of its own among the sensitivities within it.
///
/// | symbol | meaning |
/// |---|---|
/// | S = ∂h/∂p | how the hidden states hang on the parameters where the window starts |
/// | (z, p, h, 1) | columns of what is linearised within the window |
/// | (z, p, 1) | the same once δh = S·δp |
pub(super) struct HiddenStart {
    /// S on the columns (z, p); without rows where h has no columns.
    by: DMatrix<f64>,
}

impl HiddenStart {
    /// Of hidden states that have no columns of their own.
    pub fn none() -> Self {
        Self { by: DMatrix::zeros(0, 0) }
    }

    /// Of hidden states as they were carried to the window, behind so many visible ones.
    pub fn of(carried: &StateSensitivity, visible: usize) -> Self {
        let (h, k) = (carried.z.len(), carried.s.len() / (visible + carried.z.len()));
        let by = |i: usize, c: usize| if c < visible { 0.0 } else { carried.s[(visible + i) * k + c] };
        Self { by: DMatrix::from_fn(h, k, by) }
    }

    /// Tᵀ·G·T with (z, p, h, 1) = T·(z, p, 1).
    pub fn in_gram(&self, gram: DMatrix<f64>) -> DMatrix<f64> {
        let (h, k) = self.by.shape();
        if h == 0 {
            return gram;
        }
        let mut to = DMatrix::zeros(k + h + 1, k + 1);
        to.view_mut((0, 0), (k, k)).fill_with_identity();
        to.view_mut((k, 0), (h, k)).copy_from(&self.by);
        to[(k + h, k)] = 1.0;
        to.tr_mul(&(gram * &to))
    }

    /// The end of the window by (z, p).
    pub fn in_arc(&self, arc: StateSensitivity) -> StateSensitivity {
        let (h, k) = self.by.shape();
        if h == 0 {
            return arc;
        }
        let row = |row: &[f64]| {
            let (known, by_start) = row.split_at(k);
            let carried = |c: usize| (0..h).map(|j| by_start[j] * self.by[(j, c)]).sum::<f64>();
            known.iter().enumerate().map(|(c, s)| s + carried(c)).collect::<Vec<f64>>()
        };
        StateSensitivity { s: arc.s.chunks(k + h).flat_map(row).collect(), z: arc.z }
    }
}

/// States that begin at visible and hidden ones, each with columns of its own: these behind those of the parameters.
pub(super) fn started<'z, const L: usize>(
    columns: usize,
    visible: impl Fn(usize) -> &'z [f64],
    hidden: impl Fn(usize) -> Option<&'z Vec<f64>>,
) -> LaneStates<L> {
    let (m, h) = (visible(0).len(), hidden(0).map_or(0, Vec::len));
    let mut z: Vec<[f64; L]> = (0..m).map(|i| std::array::from_fn(|l| visible(l)[i])).collect();
    z.extend((0..h).map(|i| std::array::from_fn(|l| hidden(l).map_or(0.0, |hidden| hidden[i]))));
    let mut s = vec![[0.0; L]; z.len() * columns];
    (0..m).for_each(|i| s[i * columns + i] = [1.0; L]);
    (0..h).for_each(|i| s[(m + i + 1) * columns - h + i] = [1.0; L]);
    LaneStates { z, s }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two visible states, one parameter, two hidden states.
    fn start() -> HiddenStart {
        let s = vec![1.0, 0.0, 9.0, 0.0, 1.0, 9.0, 9.0, 9.0, 0.5, 9.0, 9.0, -2.0];
        HiddenStart::of(&StateSensitivity { z: vec![0.1, 0.2], s }, 2)
    }

    #[test]
    fn what_hangs_on_a_hidden_start_hangs_on_the_parameters() {
        // Columns (z₁, z₂, p, h₁, h₂): 3 + 0.5·10 − 2·20 by p.
        let arc = StateSensitivity { z: vec![7.0], s: vec![1.0, 2.0, 3.0, 10.0, 20.0] };
        let found = start().in_arc(arc.clone());
        assert_eq!((found.z, found.s), (vec![7.0], vec![1.0, 2.0, -32.0]));
        assert_eq!(HiddenStart::none().in_arc(arc.clone()).s, arc.s);
    }

    #[test]
    fn squares_are_those_of_the_line_by_the_parameters() {
        let square = |line: &[f64]| {
            let line = DMatrix::from_row_slice(1, line.len(), line);
            line.tr_mul(&line)
        };
        let found = start().in_gram(square(&[1.0, 2.0, 3.0, 10.0, 20.0, 4.0]));
        assert_eq!(found, square(&[1.0, 2.0, -32.0, 4.0]));
        assert_eq!(HiddenStart::none().in_gram(found.clone()), found);
    }
}
