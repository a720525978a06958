//! Curves y = f(x; b), written in the language of formulas and fitted by the steps of the program.

use creepage::formula::{Expr, Graph, Program, Symbol};
use creepage::numerics::levenberg_marquardt::{Damping, LeastSquares, minimise};
use nalgebra::{DMatrix, DVector};

/// A problem of least squares with its certified answer.
pub struct Problem {
    /// Its name.
    pub name: String,
    /// f in the language, of x, x2, pi and b1, b2, ….
    pub model: String,
    /// Rows of y, x and perhaps x2.
    pub data: Vec<Vec<f64>>,
    /// Where to begin: two places.
    pub starts: [Vec<f64>; 2],
    /// The certified parameters.
    pub certified: Vec<f64>,
    /// Their certified standard deviations.
    pub deviations: Vec<f64>,
    /// The certified sum of squared residuals.
    pub squares: f64,
}

/// Where a fit ends.
pub struct Fitted {
    pub b: Vec<f64>,
    pub deviations: Vec<f64>,
    pub squares: f64,
    pub steps: usize,
}

/// f and its exact derivatives, compiled.
struct Curve<'a> {
    program: Program,
    data: &'a [Vec<f64>],
    parameters: usize,
}

/// A place, the residuals there and their derivatives.
struct Linear {
    b: DVector<f64>,
    r: DVector<f64>,
    j: DMatrix<f64>,
}

impl<'a> Curve<'a> {
    fn of(problem: &'a Problem) -> Self {
        let names: Vec<Symbol> = (1..=problem.certified.len()).map(|i| format!("b{i}").as_str().into()).collect();
        let mut graph = Graph::default();
        let value = graph.insert(&Expr::parse(&problem.model).unwrap());
        let slopes: Vec<_> = names.iter().flat_map(|b| graph.derivatives(&[value], b)).collect();
        let inputs = [&["x".into(), "x2".into(), "pi".into()], &names[..]].concat();
        let program = Program::compile(&graph, &inputs, &[&[value], &slopes[..]].concat()).unwrap();
        Self { program, data: &problem.data, parameters: names.len() }
    }

    /// `None` where f is undefined.
    fn at(&self, b: DVector<f64>) -> Option<Linear> {
        let mut r = DVector::zeros(self.data.len());
        let mut j = DMatrix::zeros(self.data.len(), self.parameters);
        let (mut registers, mut out) = (self.program.registers(), vec![0.0; self.parameters + 1]);
        for (i, row) in self.data.iter().enumerate() {
            let inputs = [&[row[1], row.get(2).copied().unwrap_or(0.0), std::f64::consts::PI], b.as_slice()].concat();
            self.program.run(&inputs, &mut registers, &mut out);
            r[i] = out[0] - row[0];
            (0..self.parameters).for_each(|k| j[(i, k)] = out[k + 1]);
        }
        r.iter().chain(j.iter()).all(|v| v.is_finite()).then_some(Linear { b, r, j })
    }
}

/// With a damping to begin with, and with or without memory of the diagonal.
fn rule(first: f64, remembers: bool) -> Damping {
    Damping { first, divisor: 3.0, least: 1e-15, factor: 2.0, raised: 0.0, most: 1e16, remembers }
}

/// The squares of a curve's residuals, of which a rise by some share of the sum counts for none.
struct Squares<'a> {
    curve: &'a Curve<'a>,
    rise: f64,
}

impl LeastSquares for Squares<'_> {
    type Point = Linear;

    fn normal(&self, here: &Linear) -> (DMatrix<f64>, DVector<f64>) {
        (here.j.tr_mul(&here.j), here.j.tr_mul(&here.r))
    }

    fn next(&self, here: &Linear, step: &DVector<f64>, _: f64) -> Option<Linear> {
        self.curve.at(&here.b + step)
    }

    fn gain(&self, here: &Linear, next: &Linear, _: f64) -> f64 {
        here.r.norm_squared() - next.r.norm_squared()
    }

    /// Where no rise counts for none, every step leads further down than the last.
    fn tolerance(&self, here: &Linear) -> f64 {
        if self.rise > 0.0 { self.rise * here.r.norm_squared() } else { -f64::MIN_POSITIVE }
    }
}

/// Fits a problem from a start: with little and with much damping, with and without memory of the diagonal, and of these
/// four the one with the least sum of squares; then by whole steps.
pub fn fit(problem: &Problem, start: &[f64]) -> Fitted {
    let curve = Curve::of(problem);
    let ways = [(1e-3, false), (1e-3, true), (1.0, false), (1.0, true)];
    let first = || curve.at(DVector::from_column_slice(start)).expect("the start is defined");
    let [downhill, level] = [0.0, 1e-9].map(|rise| Squares { curve: &curve, rise });
    let reached = ways.map(|(damping, remembers)| minimise(&downhill, first(), &rule(damping, remembers), 20_000));
    let steps = reached.iter().map(|r| r.evaluations).sum();
    let best = reached.into_iter().map(|r| r.here).min_by(|a, b| a.r.norm_squared().total_cmp(&b.r.norm_squared()));
    // The sum of squares is flat at its minimum; the steps still tell.
    let here = minimise(&level, best.expect("there are four ways"), &Damping::NONE, 20).here;
    let squares = here.r.norm_squared();
    let free = (problem.data.len() - here.b.len()) as f64;
    let covariance = here.j.tr_mul(&here.j).cholesky().map(|c| c.inverse() * (squares / free));
    let deviation = |i| covariance.as_ref().map_or(f64::NAN, |c| c[(i, i)].sqrt());
    Fitted { deviations: (0..here.b.len()).map(deviation).collect(), b: here.b.as_slice().to_vec(), squares, steps }
}

/// How many digits agree, at most the 11 that are certified.
pub fn digits(found: &[f64], certified: &[f64]) -> f64 {
    let one = |(f, c): (&f64, &f64)| -((f - c).abs() / c.abs()).log10();
    found.iter().zip(certified).map(one).map(|d| if d.is_nan() { 0.0 } else { d }).fold(11.0, f64::min)
}
