//! Nonlinear least squares by the method of Levenberg and Marquardt; undamped it is that of Gauss and Newton.

use super::secant_curvature::SecantCurvature;
use nalgebra::{DMatrix, DVector};

/// A sum of squares, known by its linearisations.
///
/// A linearisation holds residuals and Jacobian in whatever form gives the normal equations; inner unknowns that follow
/// the parameters may have been eliminated from them.
pub trait LeastSquares {
    /// A linearisation: the parameters, and the residuals there with their derivatives.
    type Point;

    /// The information matrix H = JᵀJ and the gradient g = Jᵀr of half the sum of squares.
    fn normal(&self, here: &Self::Point) -> (DMatrix<f64>, DVector<f64>);

    /// The linearisation where a step leads, bounds regarded, inner unknowns moved by a share of what they would;
    /// `None` where the residuals are undefined.
    fn next(&self, here: &Self::Point, step: &DVector<f64>, share: f64) -> Option<Self::Point>;

    /// By how much the sum has fallen after a step of such a share. Without a rule every step is taken.
    fn gain(&self, _here: &Self::Point, _next: &Self::Point, _share: f64) -> f64 {
        f64::INFINITY
    }

    /// A rise of the sum that counts for none; below zero the fall that is needed.
    fn tolerance(&self, _here: &Self::Point) -> f64 {
        0.0
    }

    /// Whether a step is too small to be evaluated. Told is what the last one gained: nothing is known before the first,
    /// and a shortened one gains infinitely much, for it does not say how far the valley is.
    fn is_small(&self, _here: &Self::Point, _step: &DVector<f64>, _last_gain: Option<f64>) -> bool {
        false
    }
}

/// How the damping λ follows success and failure.
#[derive(Clone, Copy, Debug)]
pub struct Damping {
    /// λ of the first step.
    pub first: f64,
    /// λ is divided by this after a step that leads down.
    pub divisor: f64,
    /// λ does not fall below this.
    pub least: f64,
    /// λ is multiplied by this after a step that does not.
    pub factor: f64,
    /// λ is at least this after a step that does not.
    pub raised: f64,
    /// Beyond this λ no step leads down.
    pub most: f64,
    /// Whether the diagonal D is the largest that was seen (Moré).
    pub remembers: bool,
}

impl Damping {
    /// The method of Gauss and Newton: whole steps, and the first that cannot be taken is the end.
    pub const NONE: Self =
        Self { first: 0.0, divisor: 1.0, least: 0.0, factor: 1.0, raised: 1.0, most: 0.0, remembers: false };

    /// Hardly damped, for models that are nearly linear in what is fitted.
    pub const USUAL: Self =
        Self { first: 1e-6, divisor: 10.0, least: 1e-9, factor: 30.0, raised: 1e-3, most: 1e9, remembers: false };
}

/// Where a descent ends.
pub struct Minimum<P> {
    /// The last linearisation.
    pub here: P,
    /// The step from there, which was not evaluated any more; `None` where no step leads down.
    pub step: Option<DVector<f64>>,
    /// Whether that step is small, and not only one too many.
    pub is_settled: bool,
    /// Linearisations behind the first, those of steps not taken included.
    pub evaluations: usize,
}

/// Parameters that are damped so much hardly move: what overshoots then is the inner unknowns.
const DAMPED: f64 = 10.0;
/// What is left of the share of a step after one that led uphill, and by how much it grows after one that did not.
const SHORTENED: f64 = 0.3;
const LENGTHENED: f64 = 3.0;

/// Goes down from a linearisation until a step is small, none leads down, or so many were tried.
///
/// A step that leads uphill, or nowhere, is damped; since no damping of the parameters shortens what inner unknowns do,
/// these are moved by a share at last. Steps that go beyond the bottom time and again, since residuals are bent along them, are
/// shortened by the secant of the gradient.
///
/// Source: D. W. Marquardt, *An algorithm for least-squares estimation of nonlinear parameters*, SIAM J. 11 (1963);
/// J. Nocedal, S. J. Wright, *Numerical Optimization*, 10.3.
///
/// ```
/// use creepage::numerics::levenberg_marquardt::{Damping, LeastSquares, minimise};
/// use nalgebra::{DMatrix, DVector, dmatrix, dvector};
/// /// y = b² and y = 2.
/// struct Root;
/// impl LeastSquares for Root {
///     type Point = f64;
///     fn normal(&self, b: &f64) -> (DMatrix<f64>, DVector<f64>) {
///         (dmatrix![4.0 * b * b], dvector![2.0 * b * (b * b - 2.0)])
///     }
///     fn next(&self, b: &f64, step: &DVector<f64>, _: f64) -> Option<f64> {
///         Some(b + step[0])
///     }
/// }
/// let found = minimise(&Root, 1.0, &Damping::NONE, 6);
/// assert!((found.here - 2.0_f64.sqrt()).abs() < 1e-15);
/// ```
pub fn minimise<S: LeastSquares>(
    squares: &S,
    mut here: S::Point,
    rule: &Damping,
    most_steps: usize,
) -> Minimum<S::Point> {
    let (mut damping, mut share, mut last_gain) = (rule.first, 1.0, None);
    let (mut seen, mut evaluations) = (DVector::zeros(0), 0);
    let mut curvature = SecantCurvature::default();
    for steps in 0.. {
        let (information, gradient) = squares.normal(&here);
        let information = curvature.corrected(information, &gradient);
        seen = if rule.remembers && steps > 0 { information.diagonal().sup(&seen) } else { information.diagonal() };
        let step = damped_step(information, &gradient, damping, &seen);
        let is_settled = step.as_ref().is_some_and(|step| squares.is_small(&here, step, last_gain));
        if is_settled || steps == most_steps {
            return Minimum { here, step, is_settled, evaluations };
        }
        evaluations += usize::from(step.is_some());
        let next = step.as_ref().and_then(|step| squares.next(&here, step, share));
        let gain = next.as_ref().map_or(f64::NEG_INFINITY, |next| squares.gain(&here, next, share));
        match next {
            Some(next) if gain >= -squares.tolerance(&here) => {
                last_gain = Some(if share == 1.0 { gain } else { f64::INFINITY });
                if let Some(step) = step.filter(|_| share == 1.0) {
                    curvature.step_taken(step, gradient);
                }
                here = next;
                damping = (damping / rule.divisor).max(rule.least);
                share = f64::min(1.0, LENGTHENED * share);
            }
            _ => {
                // Damping the parameters comes first: only then is it the inner unknowns that overshoot.
                if damping > DAMPED {
                    share *= SHORTENED;
                }
                damping = (rule.factor * damping).max(rule.raised);
            }
        }
        if damping > rule.most {
            break;
        }
    }
    Minimum { here, step: None, is_settled: false, evaluations }
}

/// The step −(H + λ·D)⁻¹·g of a sum of squares; `None` where no step is defined.
///
/// | symbol | meaning |
/// |---|---|
/// | H | information matrix, JᵀJ weighted by the variances |
/// | g | gradient Jᵀr of half the sum of squares |
/// | λ | damping: 0 is the step of Gauss and Newton, much of it a short step downhill |
/// | D | the diagonal of H, or what was `seen` of it before where that is larger: a parameter that the residuals cease to depend on does not run away |
///
/// A parameter without information stays where it is.
///
/// Source: D. W. Marquardt, *An algorithm for least-squares estimation of nonlinear parameters*, SIAM J. 11 (1963); D as
/// in J. J. Moré, *The Levenberg–Marquardt algorithm: implementation and theory* (1978).
fn damped_step(
    mut information: DMatrix<f64>,
    gradient: &DVector<f64>,
    damping: f64,
    seen: &DVector<f64>,
) -> Option<DVector<f64>> {
    for i in 0..information.nrows() {
        let d = information[(i, i)];
        information[(i, i)] = match seen[i] > d {
            true => d + damping * seen[i],
            false if d != 0.0 => d * (1.0 + damping),
            false => 1.0,
        };
    }
    let step = -information.cholesky()?.solve(gradient);
    step.iter().all(|x| x.is_finite()).then_some(step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{dmatrix, dvector};

    /// Residuals of one value, which is also what they are linearised at.
    struct Line<F>(F);

    impl<F: Fn(f64) -> Option<[f64; 2]>> LeastSquares for Line<F> {
        type Point = (f64, [f64; 2]);

        fn normal(&self, (_, [r, slope]): &Self::Point) -> (DMatrix<f64>, DVector<f64>) {
            (dmatrix![slope * slope], dvector![slope * r])
        }

        fn next(&self, (b, _): &Self::Point, step: &DVector<f64>, _: f64) -> Option<Self::Point> {
            Some((b + step[0], self.0(b + step[0])?))
        }

        fn gain(&self, (_, here): &Self::Point, (_, next): &Self::Point, _: f64) -> f64 {
            here[0] * here[0] - next[0] * next[0]
        }

        fn is_small(&self, _: &Self::Point, step: &DVector<f64>, _: Option<f64>) -> bool {
            step[0].abs() < 1e-12
        }
    }

    const RULE: Damping =
        Damping { first: 0.0, divisor: 10.0, least: 0.0, factor: 30.0, raised: 1e-4, most: 1e12, remembers: false };

    /// Whole steps of arctan b = 0 lead further and further away from b = 3; damped ones come home.
    #[test]
    fn a_step_that_leads_uphill_is_damped() {
        let arctan = |b: f64| Some([b.atan(), 1.0 / (1.0 + b * b)]);
        let start = (3.0, arctan(3.0).unwrap());
        let found = minimise(&Line(arctan), start, &RULE, 100);
        assert!(found.is_settled && found.here.0.abs() < 1e-9 && found.evaluations < 20, "{}", found.here.0);
        let once = minimise(&Line(arctan), start, &Damping::NONE, 100);
        assert!(once.step.is_none() && once.here.0 == 3.0 && once.evaluations == 1);
    }

    /// Residuals bent towards the bottom: r = (b, 1 + 0.45·b²) has 1.9 times the curvature of JᵀJ there, and whole steps lead
    /// from b nearly to −b.
    #[test]
    fn a_step_that_goes_beyond_is_shortened() {
        struct Bent;
        impl LeastSquares for Bent {
            type Point = f64;

            fn normal(&self, b: &f64) -> (DMatrix<f64>, DVector<f64>) {
                let (bent, slope) = (1.0 + 0.45 * b * b, 0.9 * b);
                (dmatrix![1.0 + slope * slope], dvector![b + bent * slope])
            }

            fn next(&self, b: &f64, step: &DVector<f64>, share: f64) -> Option<f64> {
                Some(b + share * step[0])
            }

            fn is_small(&self, _: &f64, step: &DVector<f64>, _: Option<f64>) -> bool {
                step[0].abs() < 1e-9
            }
        }
        let found = minimise(&Bent, 0.1, &Damping::NONE, 100);
        assert!(found.is_settled && found.here.abs() < 1e-9 && found.evaluations < 9, "{}", found.evaluations);
    }

    /// √b = 1 from b = 9 steps to −3, where there is no root.
    #[test]
    fn a_step_to_nowhere_is_damped() {
        let root = |b: f64| (b >= 0.0).then(|| [b.sqrt() - 1.0, 0.5 / b.sqrt()]);
        let start = (9.0, root(9.0).unwrap());
        let found = minimise(&Line(root), start, &RULE, 100);
        assert!(found.is_settled && (found.here.0 - 1.0).abs() < 1e-9);
        assert!(minimise(&Line(root), start, &Damping::NONE, 100).step.is_none());
    }

    /// The last of so many steps is told and not evaluated.
    #[test]
    fn steps_are_counted() {
        let square = |b: f64| Some([b * b - 2.0, 2.0 * b]);
        let found = minimise(&Line(square), (1.0, [-1.0, 2.0]), &RULE, 2);
        assert_eq!((found.evaluations, found.is_settled, found.here.0), (2, false, 1.5 - 0.25 / 3.0));
        assert!((found.here.0 + found.step.unwrap()[0] - 2.0_f64.sqrt()).abs() < 1e-5);
    }

    #[test]
    fn a_step_is_as_short_as_it_is_damped_and_as_long_as_the_slope_that_was_seen() {
        let step =
            |damping: f64, seen: f64| damped_step(dmatrix![4.0], &dvector![-4.0], damping, &dvector![seen]).unwrap()[0];
        assert_eq!([step(0.0, 0.0), step(3.0, 0.0), step(1.0, 12.0)], [1.0, 0.25, 0.25]);
        assert_eq!(damped_step(dmatrix![0.0], &dvector![0.0], 0.0, &dvector![0.0]).unwrap()[0], 0.0);
        assert!(damped_step(dmatrix![-1.0], &dvector![1.0], 1.0, &dvector![0.0]).is_none());
    }
}
