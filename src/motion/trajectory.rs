//! Trajectories of a model and their exact sensitivities at given times.

use super::integrators::radau::{Differences, Retimed, Slopes};
use super::pose_quadrature::PoseQuadrature;
use super::{Drive, Integrator};
use crate::error::{Error, Result};
use crate::model::{Derived, Equations};
use nalgebra::DMatrix;

/// The states at `times` of ż = f(z, u(t − d), p) from z = `z0` at the first of them.
///
/// | symbol | meaning |
/// |---|---|
/// | z | states of [`Equations`], `z0` at `times[0]` |
/// | u | inputs in the order of [`Equations::inputs`] |
/// | d | delay of the inputs, s: they are looked up d in the past |
/// | p | values of [`Equations::free`] |
///
/// Times may rise or fall. The integration restarts where a derivative of an input jumps, so that the
/// method keeps its order. Source: equations (22)–(25) and theory/06-trailers for f.
///
/// # Errors
/// As [`Integrator::solve`]; and when the sizes of `z0`, `p` or the inputs do not fit the equations.
///
/// ```
/// use creepage::model::Model;
/// use creepage::motion::{simulate, Integrator, Signals, Timing};
/// let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
/// let equations = model.equations(&[]).unwrap();
/// // wheel_rate 2 rad/s and yaw_rate 1 rad/s: a circle of radius 1 m.
/// let inputs = Signals::new(&[0.0, 4.0], &[vec![2.0; 2], vec![1.0; 2]], Timing::Sample);
/// let pi = std::f64::consts::PI;
/// let z = simulate(&equations, &[], &inputs, &[0.0; 3], &[0.0, pi], &Integrator::default()).unwrap();
/// assert!(z[1][0].abs() < 1e-9 && (z[1][1] - 2.0).abs() < 1e-9);
/// ```
pub fn simulate(
    equations: &Equations,
    p: &[f64],
    inputs: &impl Drive,
    z0: &[f64],
    times: &[f64],
    integrator: &Integrator,
) -> Result<Vec<Vec<f64>>> {
    kept(times, |see| simulate_by(equations, p, inputs, z0, times, integrator, see))
}

/// As [`simulate`], of states that are seen one after another, each with its time, and not kept.
pub(crate) fn simulate_by(
    equations: &Equations,
    p: &[f64],
    inputs: &impl Drive,
    z0: &[f64],
    times: &[f64],
    integrator: &Integrator,
    see: &mut Look,
) -> Result<()> {
    fits(equations, p, inputs, z0)?;
    let mut rates_at = equations.rates_alone([p]);
    let (delay, own) = delays(equations, &equations.delay_alone(p));
    let knots = knots(equations, inputs, delay, &own);
    let route = Route { knots: &knots, delay, start: z0, times };
    if !equations.derived.is_empty() || !own.is_empty() {
        let (mut u, mut slope) = (vec![0.0; equations.inputs.len()], vec![0.0; equations.inputs.len()]);
        let rhs = |look_up: f64, z: &[f64], rates: &mut [f64]| {
            all_inputs(equations, inputs, look_up, &own, &mut u, &mut slope);
            rates_at.at(z.as_chunks().0, u.as_chunks().0, rates.as_chunks_mut().0);
        };
        return route.follow(integrator, rhs, Differences, see);
    }
    let (mut u, mut values) = (vec![0.0; inputs.channels()], inputs.values());
    let rhs = |look_up: f64, z: &[f64], rates: &mut [f64]| {
        values(look_up, &mut u);
        rates_at.at(z.as_chunks().0, u.as_chunks().0, rates.as_chunks_mut().0);
    };
    match PoseQuadrature::of(equations, p, integrator) {
        Some(mut quadrature) => {
            let mut side_by_side = inputs.values_at();
            let quick = |span: (f64, f64), look_up: &dyn Fn(f64) -> f64, y: &[f64]| {
                quadrature.through(&mut side_by_side, look_up, span, y)
            };
            route.follow_by(quick, integrator, rhs, Differences, see)
        }
        None => route.follow(integrator, rhs, Differences, see),
    }
}

/// The states at `times` and their derivatives with respect to (z0, p), from the variational equations
/// Ṡ = f_z·S + [0 | f_p − f_u·u̇·∂d/∂p], integrated beside the states.
///
/// | symbol | meaning |
/// |---|---|
/// | S | ∂z/∂(z0, p): a row for each state, columns first for z0, then for p; [1 \| 0] at `times[0]` |
/// | u̇ | slope of the inputs where they are looked up |
///
/// Otherwise as [`simulate`]; the tolerances hold for states and derivatives together. Where f has no
/// derivative (|v| at v = 0), S is undefined and the call fails.
///
/// # Errors
/// As [`simulate`].
///
/// ```
/// use creepage::effects::{self, Applied};
/// use creepage::model::Model;
/// use creepage::motion::{with_sensitivities, Integrator, Signals, Timing};
/// let creep = Applied::new(effects::named("rotation-creep").unwrap(), None, vec![0.1]);
/// let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_effect(creep);
/// let equations = model.equations(&["rotation_creep.e_rc".into()]).unwrap();
/// let inputs = Signals::new(&[0.0, 4.0], &[vec![2.0; 2], vec![0.0; 2]], Timing::Sample);
/// let rows = with_sensitivities(&equations, &[0.1], &inputs, &[0.0; 3], &[0.0, 3.0], &Integrator::default()).unwrap();
/// let (z, s) = &rows[1];
/// // x = r·θ̇·(1 − e)·t: 2.7 m, and −3 m for each unit of e.
/// assert!((z[0] - 2.7).abs() < 1e-9 && (s[(0, 3)] + 3.0).abs() < 1e-9);
/// ```
pub fn with_sensitivities(
    equations: &Equations,
    p: &[f64],
    inputs: &impl Drive,
    z0: &[f64],
    times: &[f64],
    integrator: &Integrator,
) -> Result<Vec<(Vec<f64>, DMatrix<f64>)>> {
    fits(equations, p, inputs, z0)?;
    let (n, m, parameters) = (equations.n(), equations.inputs.len(), p.len());
    let mut w = equations.workspace(p);
    let all_delays = equations.delay(&mut w).to_vec();
    let (delay, own) = delays(equations, &all_delays);
    // The derivatives of each input's whole delay, row by row.
    let by_p = &all_delays[1 + own.len()..];
    let delay_by_p = |c: usize, q: usize| {
        let beside = if c < own.len() { by_p[(1 + c) * parameters + q] } else { 0.0 };
        by_p[q] + beside
    };
    let (mut u, mut slope) = (vec![0.0; m], vec![0.0; m]);
    let rhs = |look_up: f64, y: &[f64], rates: &mut [f64]| {
        all_inputs(equations, inputs, look_up, &own, &mut u, &mut slope);
        let (z, s) = y.split_at(n);
        let (f, jacobian) = equations.rates_and_jacobian(&mut w, z, &u).split_at(n);
        let (rates, s_rates) = rates.split_at_mut(n);
        rates.copy_from_slice(f);
        for (i, row) in jacobian.chunks_exact(n + m + parameters).enumerate() {
            let (by_z, rest) = row.split_at(n);
            let (by_u, by_p) = rest.split_at(m);
            let along_inputs = |q: usize| -> f64 {
                by_u.iter().zip(&slope).enumerate().map(|(c, (by, slope))| by * slope * delay_by_p(c, q)).sum()
            };
            for (c, column) in s.chunks_exact(n).enumerate() {
                let forced = if c < n { 0.0 } else { by_p[c - n] - along_inputs(c - n) };
                s_rates[c * n + i] = dot(by_z, column) + forced;
            }
        }
    };
    let identity = DMatrix::<f64>::identity(n, n + parameters);
    let y0 = [z0, identity.as_slice()].concat();
    let knots = knots(equations, inputs, delay, &own);
    let route = Route { knots: &knots, delay, start: &y0, times };
    let rows = kept(times, |see| route.follow(integrator, rhs, Differences, see))?;
    let split = |y: Vec<f64>| (y[..n].to_vec(), DMatrix::from_column_slice(n, n + parameters, &y[n..]));
    Ok(rows.into_iter().map(split).collect())
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn fits(equations: &Equations, p: &[f64], inputs: &impl Drive, z0: &[f64]) -> Result<()> {
    let pairs = [
        ("initial states", equations.n(), z0.len()),
        ("parameters", equations.free.len(), p.len()),
        ("inputs", equations.logged(), inputs.channels()),
    ];
    match pairs.iter().find(|(_, wanted, given)| wanted != given) {
        Some((what, wanted, given)) => Err(Error::input(format!("{given} {what} are given, the model has {wanted}"))),
        None => Ok(()),
    }
}

/// All inputs that equations ask for, and their slopes: those logged, and what is derived from them. The slope of a rate
/// is left out: it is asked for by a delay that is free alone.
///
/// `own` are the delays that inputs have beside that of all.
pub(crate) fn all_inputs(
    equations: &Equations,
    inputs: &impl Drive,
    t: f64,
    own: &[f64],
    value: &mut [f64],
    slope: &mut [f64],
) {
    let logged = equations.logged();
    inputs.at(t, &mut value[..logged], &mut slope[..logged]);
    let (mut u, mut along) = (vec![0.0; own.len()], vec![0.0; own.len()]);
    for (c, delay) in own.iter().enumerate().filter(|(_, delay)| **delay != 0.0) {
        inputs.at(t - delay, &mut u, &mut along);
        (value[c], slope[c]) = (u[c], along[c]);
    }
    for (k, derived) in equations.derived.iter().enumerate() {
        (value[logged + k], slope[logged + k]) = match derived {
            Derived::Time => (t, 1.0),
            Derived::Rate(c) => (slope[*c], 0.0),
        };
    }
}

/// The delay of all inputs, and those that each has beside it, from what [`Equations::delay`] gives.
pub(crate) fn delays(equations: &Equations, all: &[f64]) -> (f64, Vec<f64>) {
    (all[0], all[1..1 + equations.own_delays].to_vec())
}

/// The delay of every logged input, s: that of all and its own.
pub(crate) fn input_delays(equations: &Equations, p: &[f64]) -> Vec<f64> {
    let (all, own) = delays(equations, &equations.delay_alone(p));
    (0..equations.logged()).map(|i| all + own.get(i).copied().unwrap_or(0.0)).collect()
}

/// Where the inputs are not smooth, and where effects begin and end, at the times at which inputs are looked up.
fn knots(equations: &Equations, inputs: &impl Drive, delay: f64, own: &[f64]) -> Vec<f64> {
    let edges = equations.edges.iter().map(|t| t - delay);
    let late = own.iter().filter(|d| **d != 0.0).flat_map(|d| inputs.knots().iter().map(move |k| k + d));
    let mut all: Vec<f64> = inputs.knots().iter().copied().chain(edges).chain(late).collect();
    if all.len() > inputs.knots().len() {
        all.sort_by(f64::total_cmp);
        all.dedup();
    }
    all
}

/// The states at `times` of ż = f(t, z), from `z0` at the first of them, restarted where a derivative of an input jumps.
///
/// | symbol | meaning |
/// |---|---|
/// | knots | times at which f is not smooth, in rising order |
/// | rates | writes f(t, z); between two knots it is only asked at times strictly between them |
/// | slopes | writes ∂f/∂z row by row; read by [`Method::Radau5`](super::Method::Radau5) alone |
///
/// # Errors
/// As [`Integrator::solve`].
///
/// ```
/// use creepage::motion::{Integrator, integrate};
/// // z' = |t|, whose slope jumps at 0.
/// let rates = |t: f64, _: &[f64], dz: &mut [f64]| dz[0] = t.abs();
/// let z = integrate(&[0.0], &[0.0], &[-1.0, 2.0], &Integrator::default(), rates, |_, _, _: &mut [f64]| ()).unwrap();
/// assert!((z[1][0] - 2.5).abs() < 1e-12);
/// ```
pub fn integrate(
    knots: &[f64],
    z0: &[f64],
    times: &[f64],
    integrator: &Integrator,
    rates: impl FnMut(f64, &[f64], &mut [f64]),
    slopes: impl FnMut(f64, &[f64], &mut [f64]),
) -> Result<Vec<Vec<f64>>> {
    let route = Route { knots, delay: 0.0, start: z0, times };
    kept(times, |see| route.follow(integrator, rates, slopes, see))
}

/// What looks at a time and the states then; what fails there ends the integration.
type Look<'a> = dyn FnMut(f64, &[f64]) -> Result<()> + 'a;

/// All states that are shown, those of each of the times.
fn kept(times: &[f64], show: impl FnOnce(&mut Look) -> Result<()>) -> Result<Vec<Vec<f64>>> {
    let mut rows = Vec::with_capacity(times.len());
    show(&mut |_, y| {
        rows.push(y.to_vec());
        Ok(())
    })?;
    Ok(rows)
}

/// Where an integration begins, and the times it goes through; the inputs' knots are met a delay later.
struct Route<'a> {
    knots: &'a [f64],
    delay: f64,
    start: &'a [f64],
    times: &'a [f64],
}

impl Route<'_> {
    /// Integrates from the first time through all times, restarting where a knot, delayed, is passed.
    ///
    /// `rhs` gets the time at which the inputs are to be looked up. It is kept strictly between the knots around
    /// the span: at the end of a span rounding would else look across the knot, at the other piece's slope.
    fn follow(
        &self,
        integrator: &Integrator,
        rhs: impl FnMut(f64, &[f64], &mut [f64]),
        slopes: impl Slopes,
        see: &mut Look,
    ) -> Result<()> {
        self.follow_by(|_, _, _| None, integrator, rhs, slopes, see)
    }

    /// The same by a quicker way, given a span, how to look inputs up and the state, wherever it gives an end.
    fn follow_by(
        &self,
        mut quick: impl FnMut((f64, f64), &dyn Fn(f64) -> f64, &[f64]) -> Option<Vec<f64>>,
        integrator: &Integrator,
        mut rhs: impl FnMut(f64, &[f64], &mut [f64]),
        mut slopes: impl Slopes,
        see: &mut Look,
    ) -> Result<()> {
        let mut walk = integrator.walk()?;
        let Self { knots, delay, start, times } = *self;
        if !delay.is_finite() {
            return Err(Error::run("the delay of the inputs is undefined"));
        }
        let mut y = start.to_vec();
        let mut last = times.first().copied().unwrap_or(0.0);
        for time in times {
            for (from, to) in spans(knots, delay, last, *time) {
                let after = knots.partition_point(|k| *k <= (from + to) / 2.0 - delay);
                let low = if after == 0 { f64::NEG_INFINITY } else { knots[after - 1].next_up() };
                let high = knots.get(after).map_or(f64::INFINITY, |k| k.next_down());
                let look_up = |t: f64| (t - delay).max(low).min(high);
                if let Some(end) = quick((from, to), &look_up, &y) {
                    y = end;
                    continue;
                }
                let mut rhs = |t: f64, y: &[f64], rates: &mut [f64]| rhs(look_up(t), y, rates);
                let mut slopes = Retimed { slopes: &mut slopes, time: look_up, factor: 1.0 };
                y = walk.span(&mut rhs, &mut slopes, from, to, &y)?;
            }
            see(*time, &y)?;
            last = *time;
        }
        Ok(())
    }
}

/// The way from one time to another cut at the delayed knots.
fn spans(knots: &[f64], delay: f64, from: f64, to: f64) -> Vec<(f64, f64)> {
    let (low, high) = (from.min(to), from.max(to));
    let begin = knots.partition_point(|k| k + delay <= low);
    let inner = knots[begin..].iter().map(|k| k + delay).take_while(|k| *k < high);
    let mut ends: Vec<f64> = inner.chain([high]).collect();
    ends.insert(0, low);
    if from > to {
        ends.reverse();
    }
    ends.windows(2).map(|w| (w[0], w[1])).collect()
}
