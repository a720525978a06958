//! Curves y = f(x; b), written in the language of formulas and fitted by the steps of the program.

use creepage::discrepancy::estimation::levenberg_marquardt::damped_step;
use creepage::formula::{Expr, Graph, Program, Symbol};
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

/// The residuals and their derivatives at a place.
struct Linear {
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
    fn at(&self, b: &DVector<f64>) -> Option<Linear> {
        let mut r = DVector::zeros(self.data.len());
        let mut j = DMatrix::zeros(self.data.len(), self.parameters);
        let (mut registers, mut out) = (self.program.registers(), vec![0.0; self.parameters + 1]);
        for (i, row) in self.data.iter().enumerate() {
            let inputs = [&[row[1], row.get(2).copied().unwrap_or(0.0), std::f64::consts::PI], b.as_slice()].concat();
            self.program.run(&inputs, &mut registers, &mut out);
            r[i] = out[0] - row[0];
            (0..self.parameters).for_each(|k| j[(i, k)] = out[k + 1]);
        }
        r.iter().chain(j.iter()).all(|v| v.is_finite()).then_some(Linear { r, j })
    }
}

impl Linear {
    fn squares(&self) -> f64 {
        self.r.norm_squared()
    }

    fn step(&self, damping: f64, seen: &DVector<f64>) -> Option<DVector<f64>> {
        damped_step(self.j.tr_mul(&self.j), &self.j.tr_mul(&self.r), damping, seen)
    }

    /// The diagonal of the information matrix.
    fn diagonal(&self) -> DVector<f64> {
        DVector::from_fn(self.j.ncols(), |i, _| self.j.column(i).norm_squared())
    }
}

/// A place, what the curve is there, and the steps it took.
type Reached = (DVector<f64>, Linear, usize);

/// Goes downhill from a start until no step leads further down.
fn descend(curve: &Curve, start: &[f64], mut damping: f64, remember: bool) -> Reached {
    let mut b = DVector::from_column_slice(start);
    let mut here = curve.at(&b).expect("the start is defined");
    let (mut seen, mut steps) = (DVector::zeros(b.len()), 0);
    while damping < 1e16 && steps < 20_000 {
        steps += 1;
        if remember {
            seen = seen.sup(&here.diagonal());
        }
        let tried = here.step(damping, &seen).map(|s| &b + s);
        let next = tried.as_ref().and_then(|b| curve.at(b));
        match (tried, next) {
            (Some(to), Some(next)) if next.squares() < here.squares() => {
                (b, here) = (to, next);
                damping = f64::max(damping / 3.0, 1e-15);
            }
            _ => damping *= 2.0,
        }
    }
    (b, here, steps)
}

/// Fits a problem from a start: with little and with much damping, with and without memory of the diagonal, and of these
/// four the one with the least sum of squares; then by whole steps until they are only rounding.
pub fn fit(problem: &Problem, start: &[f64]) -> Fitted {
    let curve = Curve::of(problem);
    let ways = [(1e-3, false), (1e-3, true), (1.0, false), (1.0, true)];
    let reached = ways.map(|(damping, remember)| descend(&curve, start, damping, remember));
    let steps = reached.iter().map(|r| r.2).sum();
    let best = reached.into_iter().min_by(|a, b| a.1.squares().total_cmp(&b.1.squares()));
    let (mut b, mut here, _) = best.expect("there are four ways");
    let present = DVector::zeros(b.len());
    // The sum of squares is flat at its minimum; the steps still tell.
    for _ in 0..20 {
        let Some(to) = here.step(0.0, &present).map(|s| &b + s) else { break };
        let Some(next) = curve.at(&to) else { break };
        if next.squares() > here.squares() * (1.0 + 1e-9) {
            break;
        }
        (b, here) = (to, next);
    }
    let free = (problem.data.len() - b.len()) as f64;
    let covariance = here.j.tr_mul(&here.j).cholesky().map(|c| c.inverse() * (here.squares() / free));
    let deviation = |i| covariance.as_ref().map_or(f64::NAN, |c| c[(i, i)].sqrt());
    Fitted {
        deviations: (0..b.len()).map(deviation).collect(),
        b: b.as_slice().to_vec(),
        squares: here.squares(),
        steps,
    }
}

/// How many digits agree, at most the 11 that are certified.
pub fn digits(found: &[f64], certified: &[f64]) -> f64 {
    let one = |(f, c): (&f64, &f64)| -((f - c).abs() / c.abs()).log10();
    found.iter().zip(certified).map(one).map(|d| if d.is_nan() { 0.0 } else { d }).fold(11.0, f64::min)
}
