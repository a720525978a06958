//! Direct multiple shooting (Bock and Plitt 1984): the motion over one span of the inputs' splines, with its exact derivatives by
//! where it begins, by the coefficients that act there, and by the duration.

use super::b_spline::BSpline;
use crate::error::Result;
use crate::model::{Derived, Equations};
use crate::motion::{Integrator, integrate};
use nalgebra::DMatrix;

/// The motion of a model under inputs that are splines over a duration.
pub struct Shooting<'a> {
    /// The equations of motion.
    pub equations: &'a Equations,
    /// The values of their free parameters.
    pub parameters: &'a [f64],
    /// When the splines begin, s.
    pub begins: f64,
    /// The splines of all inputs.
    pub spline: BSpline,
    /// Steps of the integration.
    pub integrator: Integrator,
}

/// The end of a span, and its derivatives.
pub struct Span {
    /// The state.
    pub end: Vec<f64>,
    /// By the state at the beginning, then by the coefficients that act on the span, channel by channel, then by the duration.
    pub slopes: DMatrix<f64>,
}

impl Shooting<'_> {
    fn channels(&self) -> usize {
        self.equations.logged()
    }

    /// Inputs at a place of a span, and the derivatives of each by the coefficients that act there.
    fn inputs(&self, coefficients: &[Vec<f64>], span: usize, s: f64, duration: f64) -> Inputs {
        let (weights, slopes) = self.spline.weights(span, s);
        let per_second = self.spline.spans as f64 / duration;
        let of = |c: &[f64], w: &[f64]| w.iter().zip(&c[span..]).map(|(w, c)| w * c).sum::<f64>();
        let mut value: Vec<f64> = coefficients.iter().map(|c| of(c, &weights)).collect();
        let share = (span as f64 + s) / self.spline.spans as f64;
        value.extend(self.equations.derived.iter().map(|derived| match derived {
            Derived::Time => self.begins + share * duration,
            Derived::Rate(c) => of(&coefficients[*c], &slopes) * per_second,
        }));
        Inputs { value, weights, slopes: slopes.map(|w| w * per_second), share }
    }

    /// The inputs at the beginning.
    pub fn first_inputs(&self, coefficients: &[Vec<f64>], duration: f64) -> Vec<f64> {
        self.inputs(coefficients, 0, 0.0, duration).value
    }

    /// The state at the end of a span.
    ///
    /// # Errors
    /// When the motion is undefined on the way.
    pub fn end(&self, start: &[f64], coefficients: &[Vec<f64>], span: usize, duration: f64) -> Result<Vec<f64>> {
        let mut w = self.equations.workspace(self.parameters);
        let length = duration / self.spline.spans as f64;
        let rates = |s: f64, z: &[f64], rates: &mut [f64]| {
            self.equations.rates(&mut w, z, &self.inputs(coefficients, span, s, duration).value, rates);
            rates.iter_mut().for_each(|r| *r *= length);
        };
        let ends = integrate(&[], start, &[0.0, 1.0], &self.integrator, rates, |_, _, _: &mut [f64]| ())?;
        Ok(ends.into_iter().next_back().unwrap_or_default())
    }

    /// The state at the end of a span with its derivatives, from the variational equations.
    ///
    /// # Errors
    /// When the motion, or a derivative of it, is undefined on the way.
    pub fn span(&self, start: &[f64], coefficients: &[Vec<f64>], span: usize, duration: f64) -> Result<Span> {
        let (n, channels) = (self.equations.n(), self.channels());
        let acting = self.spline.degree + 1;
        let width = n + channels * acting + 1;
        let inputs = self.equations.inputs.len();
        let length = duration / self.spline.spans as f64;
        let mut w = self.equations.workspace(self.parameters);
        let rates = |s: f64, y: &[f64], rates: &mut [f64]| {
            let u = self.inputs(coefficients, span, s, duration);
            let (z, by) = y.split_at(n);
            let (f, jacobian) = self.equations.rates_and_jacobian(&mut w, z, &u.value).split_at(n);
            let (rates, slopes) = rates.split_at_mut(n);
            rates.iter_mut().zip(f).for_each(|(r, f)| *r = length * f);
            for (i, row) in jacobian.chunks_exact(n + inputs + self.parameters.len()).enumerate() {
                let (by_z, by_u) = row.split_at(n);
                for (c, column) in by.chunks_exact(n).enumerate() {
                    let carried: f64 = by_z.iter().zip(column).map(|(a, b)| a * b).sum();
                    let forced = match c.checked_sub(n) {
                        None => 0.0,
                        Some(k) if k == channels * acting => f[i] / duration + self.by_duration(by_u, &u, duration),
                        Some(k) => self.by_coefficient(by_u, &u, k / acting, k % acting),
                    };
                    slopes[c * n + i] = length * (carried + forced);
                }
            }
        };
        let identity = DMatrix::<f64>::identity(n, width);
        let y0 = [start, identity.as_slice()].concat();
        let ends = integrate(&[], &y0, &[0.0, 1.0], &self.integrator, rates, |_, _, _: &mut [f64]| ())?;
        let y = ends.into_iter().next_back().unwrap_or_default();
        Ok(Span { end: y[..n].to_vec(), slopes: DMatrix::from_column_slice(n, width, &y[n..]) })
    }

    /// ∂f/∂u·∂u/∂c of a channel's j-th acting coefficient.
    fn by_coefficient(&self, by_u: &[f64], u: &Inputs, channel: usize, j: usize) -> f64 {
        let logged = self.channels();
        let derived = self.equations.derived.iter().zip(&by_u[logged..]);
        let through_rate = |(d, by): (&Derived, &f64)| match d {
            Derived::Rate(c) if *c == channel => by * u.slopes[j],
            _ => 0.0,
        };
        by_u[channel] * u.weights[j] + derived.map(through_rate).sum::<f64>()
    }

    /// ∂f/∂u·∂u/∂T, of inputs that are derived from the others.
    fn by_duration(&self, by_u: &[f64], u: &Inputs, duration: f64) -> f64 {
        let logged = self.channels();
        let of = |(k, d): (usize, &Derived)| match d {
            Derived::Time => by_u[logged + k] * u.share,
            Derived::Rate(_) => -by_u[logged + k] * u.value[logged + k] / duration,
        };
        self.equations.derived.iter().enumerate().map(of).sum()
    }
}

/// Inputs at a time.
struct Inputs {
    /// Logged ones, then derived ones.
    value: Vec<f64>,
    /// The weights of the coefficients that act.
    weights: [f64; 4],
    /// Their slopes, by a second.
    slopes: [f64; 4],
    /// The share of the duration that has passed.
    share: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Applied, named};
    use crate::model::Model;

    /// All derivatives beside central differences, for a car with a slide that builds up.
    #[test]
    fn derivatives_are_those_of_the_motion() {
        let model = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.0)]).unwrap();
        let model = model.with_effect(Applied::new(named("relaxation-length").unwrap(), None, vec![0.4, 0.1]));
        let equations = model.equations(&[]).unwrap();
        let spline = BSpline { degree: 3, spans: 4 };
        let integrator = Integrator::default();
        let shooting = Shooting { equations: &equations, parameters: &[], begins: 0.0, spline, integrator };
        let c: Vec<Vec<f64>> = (0..2)
            .map(|ch| (0..7).map(|j| 0.4 + 0.2 * ((ch * 7 + j) as f64).sin() + 2.0 * (1 - ch) as f64).collect())
            .collect();
        let start = vec![0.1, -0.2, 0.3, 0.02];
        let found = shooting.span(&start, &c, 1, 5.0).unwrap();
        let plain = shooting.end(&start, &c, 1, 5.0).unwrap();
        assert!(found.end.iter().zip(&plain).all(|(a, b)| (a - b).abs() < 1e-9));
        let step = 1e-5;
        let moved = |k: usize, by: f64| {
            let (mut start, mut c, mut duration) = (start.clone(), c.clone(), 5.0);
            match k {
                k if k < 4 => start[k] += by,
                12 => duration += by,
                k => c[(k - 4) / 4][1 + (k - 4) % 4] += by,
            }
            shooting.end(&start, &c, 1, duration).unwrap()
        };
        for k in 0..13 {
            let (ahead, behind) = (moved(k, step), moved(k, -step));
            for i in 0..4 {
                let difference = (ahead[i] - behind[i]) / (2.0 * step);
                assert!(
                    (found.slopes[(i, k)] - difference).abs() < 1e-6,
                    "{i} {k}: {} {difference}",
                    found.slopes[(i, k)]
                );
            }
        }
    }
}
