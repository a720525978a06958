//! The windows of a run joined: poses and jumps eliminated one window at a time.

use super::windows::Linear;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Variances of the statistical model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variances {
    /// Of a measured position (m²), heading and trailer heading (rad²).
    pub noise: [f64; 3],
    /// Of the jump, for each second: along, across (m²/s), yaw, trailer heading (rad²/s).
    pub jump: [f64; 4],
}

impl Variances {
    /// Whether two sets differ by no more than their estimation could tell.
    pub fn close_to(&self, other: &Variances) -> bool {
        let pairs = self.noise.iter().zip(&other.noise).chain(self.jump.iter().zip(&other.jump));
        pairs.into_iter().all(|(a, b)| (a / b).ln().abs() < 0.2)
    }
}

/// What remains when all poses and jumps are eliminated.
#[derive(Clone, Debug)]
pub struct Eliminated {
    /// The quadratic form in (δp, 1): twice the negative log likelihood up to constants.
    pub form: DMatrix<f64>,
    /// Logarithm of the determinants that elimination leaves behind.
    pub log_determinant: f64,
    /// Logarithm of the determinants of the jumps alone.
    pub jump_determinant: f64,
    /// Each segment's part of the form.
    pub parts: Vec<DMatrix<f64>>,
    tails: Vec<Tail>,
}

/// What the backward pass needs of one segment.
#[derive(Clone, Debug)]
struct Tail {
    /// Jump at the end of each window as a function of (δz next, δp, 1).
    jumps: Vec<DMatrix<f64>>,
    /// δz of the last window as a function of (δp, 1).
    last: DMatrix<f64>,
}

/// A vanishing information on every pose, so that a pose nothing measures does not break the elimination.
const WEAK: f64 = 1e-9;

/// Eliminates the poses of all windows.
///
/// With M the quadratic form in (δz, δp, 1) of everything up to a window's end, a jump w = G·a, a ~ N(0, 1),
/// turns it into M − M_z·G(1 + Gᵀ·M_zz·G)⁻¹Gᵀ·M_z: regular for q = 0 as for q → ∞.
pub fn eliminate(segments: &[Vec<Linear>], v: &Variances, parameters: usize) -> Option<Eliminated> {
    let mut total = Eliminated {
        form: DMatrix::zeros(parameters + 1, parameters + 1),
        log_determinant: 0.0,
        jump_determinant: 0.0,
        parts: Vec::with_capacity(segments.len()),
        tails: Vec::with_capacity(segments.len()),
    };
    for windows in segments {
        eliminate_segment(windows, v, parameters, &mut total)?;
    }
    Some(total)
}

fn eliminate_segment(windows: &[Linear], v: &Variances, parameters: usize, total: &mut Eliminated) -> Option<()> {
    let size = windows.first()?.gram[0].nrows();
    let m = size - 1 - parameters;
    let mut form: DMatrix<f64> = DMatrix::zeros(size, size);
    (0..m).for_each(|i| form[(i, i)] = WEAK);
    let mut jumps = Vec::with_capacity(windows.len());
    for window in windows {
        for (gram, noise) in window.gram.iter().zip(v.noise) {
            form += gram / noise;
        }
        let Some(back) = &window.back else { continue };
        form = carried(&form, back, m);
        let spread = jump_spread(window, v, m);
        let towards = spread.tr_mul(&form.rows(0, m));
        let inner = DMatrix::identity(m, m) + towards.columns(0, m) * &spread;
        let inner = Cholesky::new(inner)?;
        let gain = inner.solve(&towards);
        form = symmetric(form - towards.tr_mul(&gain));
        let determinant = log_determinant(&inner);
        total.log_determinant += determinant;
        total.jump_determinant += determinant;
        jumps.push(spread * gain);
    }
    let poses = Cholesky::new(form.view((0, 0), (m, m)).into_owned())?;
    let right = form.view((0, m), (m, parameters + 1)).into_owned();
    let solved = poses.solve(&right);
    let part = form.view((m, m), (parameters + 1, parameters + 1)) - right.tr_mul(&solved);
    total.form += &part;
    total.parts.push(part);
    total.log_determinant += log_determinant(&poses);
    total.tails.push(Tail { jumps, last: -solved });
    Some(())
}

/// The form in terms of the end of the window instead of its start.
fn carried(form: &DMatrix<f64>, back: &DMatrix<f64>, m: usize) -> DMatrix<f64> {
    let size = form.nrows();
    let mut t = DMatrix::identity(size, size);
    t.rows_mut(0, m).copy_from(back);
    symmetric(t.tr_mul(form) * t)
}

/// Rounding makes a form lopsided, and a chain that runs against a contracting motion makes that grow.
fn symmetric(mut form: DMatrix<f64>) -> DMatrix<f64> {
    for i in 0..form.nrows() {
        for j in 0..i {
            let mean = 0.5 * (form[(i, j)] + form[(j, i)]);
            form[(i, j)] = mean;
            form[(j, i)] = mean;
        }
    }
    form
}

/// G: columns are the body's axes scaled by the jump's standard deviations.
fn jump_spread(window: &Linear, v: &Variances, m: usize) -> DMatrix<f64> {
    let mut spread = window.axes.clone();
    for i in 0..m {
        spread.column_mut(i).scale_mut((v.jump[i.min(3)] * window.duration).sqrt());
    }
    spread
}

fn log_determinant(c: &Cholesky<f64, Dyn>) -> f64 {
    2.0 * c.l_dirty().diagonal().iter().map(|x| x.ln()).sum::<f64>()
}

impl Eliminated {
    /// Twice the negative log likelihood's quadratic part at δp = 0, poses at their best.
    pub fn cost(&self) -> f64 {
        let p = self.form.nrows() - 1;
        self.form[(p, p)]
    }

    /// Information matrix of the parameters and the gradient of half the cost.
    pub fn normal(&self) -> (DMatrix<f64>, DVector<f64>) {
        let p = self.form.nrows() - 1;
        (self.form.view((0, 0), (p, p)).into_owned(), self.form.view((0, p), (p, 1)).column(0).into_owned())
    }

    /// The corrections of all starts that belong to a correction of the parameters.
    pub fn corrections(&self, segments: &[Vec<Linear>], delta: &DVector<f64>) -> Vec<Vec<DVector<f64>>> {
        let one = delta.clone().push(1.0);
        let of_segment = |(tail, windows): (&Tail, &Vec<Linear>)| {
            let mut z = &tail.last * &one;
            let mut found = vec![z.clone()];
            for (window, jump) in windows.iter().rev().skip(1).zip(tail.jumps.iter().rev()) {
                let Some(back) = &window.back else { break };
                let here = stacked(&z, &one);
                let before = &z - jump * here;
                z = back * stacked(&before, &one);
                found.push(z.clone());
            }
            found.reverse();
            found
        };
        self.tails.iter().zip(segments).map(of_segment).collect()
    }
}

fn stacked(z: &DVector<f64>, rest: &DVector<f64>) -> DVector<f64> {
    DVector::from_iterator(z.len() + rest.len(), z.iter().chain(rest.iter()).copied())
}
