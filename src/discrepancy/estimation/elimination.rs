//! The windows of a run joined: poses and jumps eliminated one window at a time.

use crate::discrepancy::estimation::noise_model::NoiseModel;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// What remains when all poses and jumps are eliminated.
#[derive(Clone, Debug)]
pub struct ReducedForm {
    /// The quadratic form in (δp, 1): twice the negative log likelihood up to constants.
    pub form: DMatrix<f64>,
    /// Logarithm of the determinants that elimination leaves behind.
    pub log_determinant: f64,
    /// Logarithm of the determinants of the jumps alone.
    pub jump_determinant: f64,
    /// Each segment's part of the form.
    pub parts: Vec<DMatrix<f64>>,
    tails: Vec<BackwardPass>,
}

/// What the backward pass needs of one segment.
#[derive(Clone, Debug)]
struct BackwardPass {
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
pub fn eliminate(segments: &[Vec<LinearisedWindow>], v: &NoiseModel, parameters: usize) -> Option<ReducedForm> {
    joined(segments, v, parameters, true)
}

/// The same where nobody asks for the poses.
pub fn eliminate_forward(segments: &[Vec<LinearisedWindow>], v: &NoiseModel, parameters: usize) -> Option<ReducedForm> {
    joined(segments, v, parameters, false)
}

fn joined(
    segments: &[Vec<LinearisedWindow>],
    v: &NoiseModel,
    parameters: usize,
    backward: bool,
) -> Option<ReducedForm> {
    let mut total = ReducedForm::nothing(parameters);
    for windows in segments {
        let mut chain = InformationFilter::new(v, parameters, backward);
        windows.iter().try_for_each(|w| chain.push(w))?;
        total.add(chain)?;
    }
    Some(total)
}

/// The windows of a segment joined one after another.
pub struct InformationFilter<'v> {
    v: &'v NoiseModel,
    parameters: usize,
    /// M, once the first window has come.
    form: Option<DMatrix<f64>>,
    log_determinant: f64,
    /// Whether poses will be asked for: then every window leaves something behind.
    backward: bool,
    jumps: Vec<DMatrix<f64>>,
}

impl<'v> InformationFilter<'v> {
    /// A chain without windows.
    pub fn new(v: &'v NoiseModel, parameters: usize, backward: bool) -> Self {
        Self { v, parameters, form: None, log_determinant: 0.0, backward, jumps: vec![] }
    }

    /// Gives room to further parameters, which no window before depends on.
    pub fn grow(&mut self, more: usize) {
        self.parameters += more;
        self.form = self.form.take().map(|form| {
            let last = form.nrows() - 1;
            form.insert_rows(last, more, 0.0).insert_columns(last, more, 0.0)
        });
    }

    /// Joins the next window.
    pub fn push(&mut self, window: &LinearisedWindow) -> Option<()> {
        let size = window.gram[0].nrows();
        let m = size - 1 - self.parameters;
        let mut form = self.form.take().unwrap_or_else(|| weak(size, m));
        for ((gram, _), noise) in
            window.gram.iter().zip(&window.count).zip(self.v.measurement()).filter(|((_, n), _)| **n > 0)
        {
            let variance = noise.variance;
            form.zip_apply(gram, |f, g| *f += g / variance);
        }
        if let Some(back) = &window.back {
            form = carried(&form, back, m);
            let spread = jump_spread(window, self.v, m);
            let towards = spread.tr_mul(&form.rows(0, m));
            let inner = DMatrix::identity(m, m) + towards.columns(0, m) * &spread;
            let inner = Cholesky::new(inner)?;
            let gain = inner.solve(&towards);
            form.gemm_tr(-1.0, &towards, &gain, 1.0);
            form = symmetric(form);
            self.log_determinant += log_determinant(&inner);
            if self.backward {
                self.jumps.push(spread * gain);
            }
        }
        self.form = Some(form);
        Some(())
    }
}

impl ReducedForm {
    /// Of no segments.
    pub fn nothing(parameters: usize) -> Self {
        Self {
            form: DMatrix::zeros(parameters + 1, parameters + 1),
            log_determinant: 0.0,
            jump_determinant: 0.0,
            parts: vec![],
            tails: vec![],
        }
    }

    /// Eliminates the last pose of a segment and adds what remains.
    pub fn add(&mut self, chain: InformationFilter) -> Option<()> {
        let form = chain.form?;
        let rest = chain.parameters + 1;
        let m = form.nrows() - rest;
        let poses = Cholesky::new(form.view((0, 0), (m, m)).into_owned())?;
        let right = form.view((0, m), (m, rest)).into_owned();
        let solved = poses.solve(&right);
        let part = form.view((m, m), (rest, rest)) - right.tr_mul(&solved);
        self.form += &part;
        self.parts.push(part);
        self.log_determinant += chain.log_determinant + log_determinant(&poses);
        self.jump_determinant += chain.log_determinant;
        self.tails.push(BackwardPass { jumps: chain.jumps, last: -solved });
        Some(())
    }
}

fn weak(size: usize, m: usize) -> DMatrix<f64> {
    let mut form = DMatrix::zeros(size, size);
    (0..m).for_each(|i| form[(i, i)] = WEAK);
    form
}

/// The form in terms of the end of the window instead of its start: with δz = B·δz̃ + C·(δp, 1), its blocks become
/// Bᵀ·M_zz·B, Bᵀ(M_zz·C + M_zr) and M_rr + Cᵀ(M_zz·C + M_zr) + M_rz·C.
fn carried(form: &DMatrix<f64>, back: &DMatrix<f64>, m: usize) -> DMatrix<f64> {
    let rest = form.nrows() - m;
    let (b, c) = (back.columns(0, m), back.columns(m, rest));
    let along = form.view((0, 0), (m, m)) * c + form.view((0, m), (m, rest));
    let mut moved = form.clone();
    moved.view_mut((0, 0), (m, m)).copy_from(&b.tr_mul(&(form.view((0, 0), (m, m)) * b)));
    let across = b.tr_mul(&along);
    moved.view_mut((0, m), (m, rest)).copy_from(&across);
    moved.view_mut((m, 0), (rest, m)).copy_from(&across.transpose());
    let mut corner = moved.view_mut((m, m), (rest, rest));
    corner.gemm_tr(1.0, &c, &along, 1.0);
    corner.gemm_tr(1.0, &form.view((0, m), (m, rest)), &c, 1.0);
    symmetric(moved)
}

/// Rounding makes a form lopsided, and a chain that runs against a contracting motion makes that grow.
fn symmetric(mut form: DMatrix<f64>) -> DMatrix<f64> {
    for j in 0..form.nrows() {
        for i in j + 1..form.nrows() {
            let mean = 0.5 * (form[(i, j)] + form[(j, i)]);
            form[(i, j)] = mean;
            form[(j, i)] = mean;
        }
    }
    form
}

/// G: columns are the body's axes scaled by the jump's standard deviations.
fn jump_spread(window: &LinearisedWindow, v: &NoiseModel, m: usize) -> DMatrix<f64> {
    let mut spread = window.axes.clone();
    for i in 0..m {
        spread.column_mut(i).scale_mut((v.jump(i) * window.duration).sqrt());
    }
    spread
}

fn log_determinant(c: &Cholesky<f64, Dyn>) -> f64 {
    2.0 * c.l_dirty().diagonal().iter().map(|x| x.ln()).sum::<f64>()
}

impl ReducedForm {
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
    pub fn corrections(&self, segments: &[Vec<LinearisedWindow>], delta: &DVector<f64>) -> Vec<Vec<DVector<f64>>> {
        let one = delta.clone().push(1.0);
        let of_segment = |(tail, windows): (&BackwardPass, &Vec<LinearisedWindow>)| {
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
