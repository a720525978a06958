//! The slow manifold: states that follow the others where these and the inputs drive them, to first order in their time
//! constants (Kokotović, Khalil and O'Reilly, Singular Perturbation Methods in Control, 1986, ch. 2).

use crate::discrepancy::record::run_record::Record;
use crate::model::Equations;
use crate::motion::{StateSensitivity, Stepper, initial_hidden};
use crate::numerics::bounded_inverse::bounded_inverse;
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// Over this time the slope of an input is taken, s.
const DIFFERENCE: f64 = 1e-4;
/// What a window leaves of a speed at least; where it leaves less, its end says no more of how it began.
pub const FORGOTTEN: f64 = 1e-4;

/// The rates of states h under visible states n, inputs u and parameters p, linearised: h′(n, h, u, p) = 0 gives h₀ and how it
/// moves.
pub(super) struct FastDynamics {
    /// Where they are linearised.
    pub h: Vec<f64>,
    /// How many of the states are visible.
    m: usize,
    /// The rates of all states there, then their derivatives row by row.
    rates_and_slopes: Vec<f64>,
    /// The columns of inputs and of parameters among the derivatives.
    inputs: usize,
    parameters: usize,
    /// Which of all states they are.
    rows: Vec<usize>,
    /// A = ∂h′/∂h.
    own: LU<f64, Dyn, Dyn>,
}

impl FastDynamics {
    /// About the equilibrium; zero where there is none.
    pub fn in_equilibrium(equations: &Equations, p: &[f64], visible: &[f64], u: &[f64]) -> Self {
        Self::about(equations, p, (visible, initial_hidden(equations, p, u, visible)), u)
    }

    fn about(equations: &Equations, p: &[f64], (visible, h): (&[f64], Vec<f64>), u: &[f64]) -> Self {
        Self::of_some(equations, p, (visible, h), u, |_| true)
    }

    /// Of those of the states whose place among them is wanted; the others are as inputs to them.
    fn of_some(
        equations: &Equations,
        p: &[f64],
        (visible, h): (&[f64], Vec<f64>),
        u: &[f64],
        is_wanted: impl Fn(usize) -> bool,
    ) -> Self {
        let (n, m) = (equations.n(), equations.visible);
        let mut workspace = equations.workspace(p);
        let f = equations.rates_and_jacobian(&mut workspace, &[visible, &h].concat(), u);
        let width = n + u.len() + p.len();
        let rows: Vec<usize> = (m..n).filter(|i| is_wanted(i - m)).collect();
        let own = DMatrix::from_fn(rows.len(), rows.len(), |i, j| f[n + rows[i] * width + rows[j]]).lu();
        Self { h, m, rates_and_slopes: f.to_vec(), inputs: u.len(), parameters: p.len(), rows, own }
    }

    fn n(&self) -> usize {
        self.m + self.h.len()
    }

    /// The rates of the visible states.
    fn visible_rates(&self) -> DVector<f64> {
        DVector::from_column_slice(&self.rates_and_slopes[..self.m])
    }

    /// −A⁻¹·∂h′/∂·, the derivatives of h₀ by so many columns from one on.
    fn by(&self, from: usize, columns: usize) -> Option<DMatrix<f64>> {
        let width = self.n() + self.inputs + self.parameters;
        let slope = |i: usize, j: usize| -self.rates_and_slopes[self.n() + self.rows[i] * width + from + j];
        self.own.solve(&DMatrix::from_fn(self.rows.len(), columns, slope)).filter(|by| by.iter().all(|x| x.is_finite()))
    }

    /// ∂h₀/∂n.
    fn by_visible(&self) -> Option<DMatrix<f64>> {
        self.by(0, self.m)
    }

    /// ∂h₀/∂u.
    fn by_inputs(&self) -> Option<DMatrix<f64>> {
        self.by(self.n(), self.inputs)
    }

    /// ∂h₀/∂p.
    pub fn by_parameters(&self) -> Option<DMatrix<f64>> {
        self.by(self.n() + self.inputs, self.parameters)
    }
}

/// States h with their derivatives by visible states and parameters, as the steppers carry them.
pub(super) fn arc(h: Vec<f64>, by_visible: &DMatrix<f64>, by_p: &DMatrix<f64>) -> StateSensitivity {
    let (m, k) = (by_visible.ncols(), by_visible.ncols() + by_p.ncols());
    let mut s = vec![0.0; (m + h.len()) * k];
    for (i, line) in s.chunks_exact_mut(k).skip(m).enumerate() {
        line[..m].iter_mut().zip(by_visible.row(i).iter()).for_each(|(s, by)| *s = *by);
        line[m..].iter_mut().zip(by_p.row(i).iter()).for_each(|(s, by)| *s = *by);
    }
    StateSensitivity { z: h, s }
}

/// States that follow the speeds which forces change, at a row, with their slopes by pose, speeds and parameters.
///
/// h = h₀ + A⁻¹·ḣ₀ with h₀ the equilibrium at the speeds and inputs, A = ∂h′/∂h, ḣ₀ = G·n′ + (∂h₀/∂u)·u′ and G = ∂h₀/∂n.
pub fn following(equations: &Equations, p: &[f64], record: &Record, row: usize, nodes: &[f64]) -> StateSensitivity {
    let (m, t) = (equations.visible, record.time[row]);
    let mut stepper = Stepper::new(equations, &record.signals, p);
    let u = stepper.inputs(t).to_vec();
    let later = stepper.inputs(t + DIFFERENCE);
    let slope = DVector::from_iterator(u.len(), later.iter().zip(&u).map(|(b, a)| (b - a) / DIFFERENCE));
    let rest = FastDynamics::in_equilibrium(equations, p, nodes, &u);
    let all = rest.by_visible().zip(rest.by_inputs()).zip(rest.by_parameters());
    let late = all.and_then(|((by_nodes, by_inputs), by_p)| {
        let late = rest.own.solve(&(&by_nodes * rest.visible_rates() + by_inputs * slope))?;
        let h = rest.h.iter().zip(late.iter()).map(|(h, late)| h + late).collect();
        late.iter().all(|x| x.is_finite()).then(|| arc(h, &by_nodes, &by_p))
    });
    late.unwrap_or_else(|| {
        let none = |columns: usize| DMatrix::zeros(rest.h.len(), columns);
        arc(rest.h.clone(), &none(m), &none(p.len()))
    })
}

/// The states that follow the speeds at the start of a window, by those at the end of the one before: a jump of the speeds
/// moves them along the slow manifold, h = h₁ + G·(n − n₁) with G·S_n = S_h.
///
/// G is ∂h₀/∂n in the directions that S_n forgets: G = ∂h₀/∂n + (S_h − ∂h₀/∂n·S_n)·S_n⁻¹.
pub fn moved_along(
    equations: &Equations,
    p: &[f64],
    end: &StateSensitivity,
    begin: &[f64],
    u: &[f64],
) -> StateSensitivity {
    let (n, m) = (equations.n(), equations.visible);
    let (h, k) = (n - m, end.s.len() / n);
    if h == 0 {
        return StateSensitivity { z: vec![], s: vec![0.0; n * k] };
    }
    let all = DMatrix::from_row_slice(n, k, &end.s);
    let of_nodes = all.view((0, 0), (m, m)).into_owned();
    let Some(inverse) = bounded_inverse(&of_nodes, FORGOTTEN) else {
        return arc(end.z[m..].to_vec(), &DMatrix::zeros(h, m), &DMatrix::zeros(h, k - m));
    };
    // What does not hang on the speeds goes on as it was: it has no place on the manifold, and may have no equilibrium.
    let is_moved = equations.moved_by_visible();
    let there = FastDynamics::of_some(equations, p, (&end.z[..m], end.z[m..].to_vec()), u, |i| is_moved[m + i]);
    let mut local = DMatrix::zeros(h, m);
    if let Some(by_visible) = there.by_visible() {
        by_visible.row_iter().zip(&there.rows).for_each(|(row, i)| local.set_row(i - m, &row));
    }
    let mut along = (all.view((m, 0), (h, m)) - &local * &of_nodes) * inverse + &local;
    (0..h).filter(|i| !is_moved[m + i]).for_each(|i| along.row_mut(i).fill(0.0));
    let moved = &along * DVector::from_iterator(m, begin.iter().zip(&end.z).map(|(n, end)| n - end));
    let moved = end.z[m..].iter().zip(moved.iter()).map(|(h, by)| h + by).collect();
    let by_p = all.view((m, m), (h, k - m)) - &along * all.view((0, m), (m, k - m));
    arc(moved, &along, &by_p)
}
