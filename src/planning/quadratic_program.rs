//! Convex quadratic programs by the interior-point method of the crate `clarabel` (Goulart and Chen 2024).

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};

/// min ½·xᵀPx + qᵀx with A·x = b and C·x ≤ d; matrices as lists of (row, column, value), P's upper half.
#[derive(Clone, Debug, Default)]
pub struct QuadraticProgram {
    /// P.
    pub quadratic: Vec<(usize, usize, f64)>,
    /// q, whose length is that of x.
    pub linear: Vec<f64>,
    /// A.
    pub equal: Vec<(usize, usize, f64)>,
    /// b.
    pub equal_to: Vec<f64>,
    /// C.
    pub below: Vec<(usize, usize, f64)>,
    /// d.
    pub below_of: Vec<f64>,
}

/// The solution, and the largest multiplier of an equation.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// x.
    pub x: Vec<f64>,
    /// max |λ| over A·x = b.
    pub multiplier: f64,
}

impl QuadraticProgram {
    /// The same program with a share of b.
    pub fn with_share(&self, share: f64) -> Self {
        Self { equal_to: self.equal_to.iter().map(|b| share * b).collect(), ..self.clone() }
    }

    /// The solution to an accuracy; none where there is no feasible point.
    pub fn solution(&self, accuracy: f64) -> Option<Solution> {
        let (n, equations, bounds) = (self.linear.len(), self.equal_to.len(), self.below_of.len());
        let p = csc(n, n, &self.quadratic);
        let lowered = self.below.iter().map(|(i, j, v)| (equations + i, *j, *v));
        let a = csc(equations + bounds, n, &self.equal.iter().copied().chain(lowered).collect::<Vec<_>>());
        let b = [&self.equal_to[..], &self.below_of].concat();
        let cones = [SupportedConeT::ZeroConeT(equations), SupportedConeT::NonnegativeConeT(bounds)];
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .max_threads(1)
            .tol_gap_abs(accuracy)
            .tol_gap_rel(accuracy)
            .tol_feas(accuracy)
            .build()
            .ok()?;
        let mut solver = DefaultSolver::new(&p, &self.linear, &a, &b, &cones, settings).ok()?;
        solver.solve();
        let solved = matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
        let multiplier = solver.solution.z[..equations].iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        let x = solver.solution.x.clone();
        (solved && x.iter().all(|v| v.is_finite())).then_some(Solution { x, multiplier })
    }
}

fn csc(rows: usize, columns: usize, entries: &[(usize, usize, f64)]) -> CscMatrix<f64> {
    let of = |k: fn(&(usize, usize, f64)) -> usize| entries.iter().map(k).collect::<Vec<_>>();
    let values = entries.iter().map(|e| e.2).collect();
    CscMatrix::new_from_triplets(rows, columns, of(|e| e.0), of(|e| e.1), values)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_on_a_line_below_a_bound() {
        // The point of x + y = 2 nearest to (2, 2) with x ≤ 1/2.
        let program = QuadraticProgram {
            quadratic: vec![(0, 0, 1.0), (1, 1, 1.0)],
            linear: vec![-2.0, -2.0],
            equal: vec![(0, 0, 1.0), (0, 1, 1.0)],
            equal_to: vec![2.0],
            below: vec![(0, 0, 1.0)],
            below_of: vec![0.5],
        };
        let found = program.solution(1e-11).unwrap();
        assert!((found.x[0] - 0.5).abs() < 1e-8 && (found.x[1] - 1.5).abs() < 1e-8, "{found:?}");
        let none = QuadraticProgram { below: vec![(0, 0, 1.0), (1, 0, -1.0)], below_of: vec![0.5, -1.0], ..program };
        assert_eq!(none.solution(1e-11), None);
    }
}
