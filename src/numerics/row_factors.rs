//! LU factors with partial pivoting, row by row on reused memory (Golub and Van Loan, Matrix Computations, 3.4), for small
//! systems that are solved thousands of times.

/// The factors of a square matrix.
#[derive(Clone, Debug, Default)]
pub struct RowFactors {
    n: usize,
    factors: Vec<f64>,
    /// The row that stood first among those left, of each step.
    pivots: Vec<usize>,
}

impl RowFactors {
    /// Factors a matrix given by its entries; whether it is regular and finite.
    pub fn factor(&mut self, n: usize, entry: impl Fn(usize, usize) -> f64) -> bool {
        self.n = n;
        self.factors.clear();
        (0..n).for_each(|row| self.factors.extend((0..n).map(|col| entry(row, col))));
        self.pivots.clear();
        for k in 0..n {
            let size = |row: usize| self.factors[row * n + k].abs();
            let pivot = (k + 1..n).fold(k, |best, row| if size(row) > size(best) { row } else { best });
            if size(pivot) == 0.0 || !size(pivot).is_finite() {
                return false;
            }
            self.pivots.push(pivot);
            swap(&mut self.factors, n, k, pivot);
            let (above, below) = self.factors.split_at_mut((k + 1) * n);
            let first = &above[k * n + k..];
            for row in below.chunks_exact_mut(n) {
                let factor = row[k] / first[0];
                row[k] = factor;
                if factor != 0.0 {
                    row[k + 1..].iter_mut().zip(&first[1..]).for_each(|(a, b)| *a -= factor * b);
                }
            }
        }
        self.factors.iter().all(|v| v.is_finite())
    }

    /// Solves for right-hand sides side by side, n rows of them, in their place.
    pub fn solve(&self, sides: &mut [f64]) {
        let n = self.n;
        let width = sides.len() / n.max(1);
        for (k, pivot) in self.pivots.iter().enumerate() {
            swap(sides, width, k, *pivot);
        }
        for k in 0..n {
            let (done, rest) = sides.split_at_mut((k + 1) * width);
            for (row, side) in rest.chunks_exact_mut(width).enumerate() {
                take(side, self.factors[(k + 1 + row) * n + k], &done[k * width..]);
            }
        }
        for k in (0..n).rev() {
            let (above, rest) = sides.split_at_mut(k * width);
            let pivot = self.factors[k * n + k];
            rest[..width].iter_mut().for_each(|x| *x /= pivot);
            for (row, side) in above.chunks_exact_mut(width).enumerate() {
                take(side, self.factors[row * n + k], &rest[..width]);
            }
        }
    }
}

/// a −= factor·b
fn take(a: &mut [f64], factor: f64, b: &[f64]) {
    if factor != 0.0 {
        a.iter_mut().zip(b).for_each(|(a, b)| *a -= factor * b);
    }
}

fn swap(rows: &mut [f64], width: usize, one: usize, other: usize) {
    if one < other {
        let (head, tail) = rows.split_at_mut(other * width);
        head[one * width..(one + 1) * width].swap_with_slice(&mut tail[..width]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    /// As the library of linear algebra solves them, with zeros where a pivot would be taken without a look.
    #[test]
    fn solutions_are_those_of_the_library() {
        let mut factors = RowFactors::default();
        for n in 1..12 {
            let entry =
                |i: usize, j: usize| if i == j { 0.0 } else { ((7 * i + 3 * j) as f64).sin() } + (n == 1) as u8 as f64;
            let side = |i: usize, j: usize| (1.3 * i as f64 + j as f64).cos();
            assert!(factors.factor(n, entry), "{n}");
            let mut found: Vec<f64> = (0..3 * n).map(|at| side(at / 3, at % 3)).collect();
            factors.solve(&mut found);
            let expected = DMatrix::from_fn(n, n, entry).lu().solve(&DMatrix::from_fn(n, 3, side)).unwrap();
            for (at, found) in found.iter().enumerate() {
                let expected = expected[(at / 3, at % 3)];
                assert!((found - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{n}: {found} {expected}");
            }
        }
    }

    #[test]
    fn what_is_singular_or_undefined_has_no_factors() {
        let mut factors = RowFactors::default();
        assert!(!factors.factor(3, |i, j| (i * j) as f64));
        assert!(!factors.factor(2, |i, j| if i == 1 && j == 1 { f64::NAN } else { 1.0 + (i + 2 * j) as f64 }));
    }
}
