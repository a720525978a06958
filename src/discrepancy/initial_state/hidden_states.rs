//! States that no sensor sees: carried along from the start of a log, as far as they hang on it by what the poses show.

use super::hidden_state_fit::PropagatedState;
use crate::discrepancy::record::run_record::Record;
use crate::model::Equations;
use crate::motion::{StateSensitivity, Stepper, initial_hidden};
use nalgebra::{DMatrix, DVector};

/// How long before the first window hidden states are carried from rest, s.
const LEAD: f64 = 3.0;

/// Hidden states and all sensitivities at a row, carried there from rest through what the log says before it; as far as
/// they still hang on how they began, by what the rows after it show.
pub fn before(equations: &Equations, p: &[f64], record: &Record, row: usize, visible: &[f64]) -> StateSensitivity {
    asked(equations, p, record, row, visible).0
}

/// As [`before`], and how many numbers the rows after it were asked for.
pub(crate) fn asked(
    equations: &Equations,
    p: &[f64],
    record: &Record,
    row: usize,
    visible: &[f64],
) -> (StateSensitivity, f64) {
    if equations.n() == equations.visible {
        return (StateSensitivity::default(), 0.0);
    }
    if equations.has_speeds() {
        return (following(equations, p, record, row, visible), 0.0);
    }
    let way = LeadIn::to(equations, p, record, row, visible);
    let rest = way.at_rest();
    let arc = way.along(rest.clone());
    let elsewhere = StateSensitivity { z: rest.z.iter().map(|z| z + 1.0).collect(), s: vec![] };
    let memory = way.along(elsewhere).z.iter().zip(&arc.z).map(|(a, b)| (a - b).abs()).collect();
    PropagatedState { arc, pose: visible, memory }.settled(equations, p, record, row)
}

/// As [`before`], without a look at the rows after it.
pub fn carried(equations: &Equations, p: &[f64], record: &Record, row: usize, visible: &[f64]) -> StateSensitivity {
    if equations.n() == equations.visible {
        return StateSensitivity::default();
    }
    if equations.has_speeds() {
        return following(equations, p, record, row, visible);
    }
    let way = LeadIn::to(equations, p, record, row, visible);
    way.along(way.at_rest())
}

/// Hidden states at the first row of a log, by what the rows after it show.
pub fn at_start(equations: &Equations, record: &Record, pose: &[f64]) -> Vec<f64> {
    if equations.has_speeds() {
        return following(equations, &[], record, 0, pose).z;
    }
    let way = LeadIn::to(equations, &[], record, 0, pose);
    let memory = vec![1.0; equations.n() - equations.visible];
    PropagatedState { arc: way.at_rest(), pose, memory }.settled(equations, &[], record, 0).0.z
}

/// States that follow the speeds which forces change, on the slow manifold to first order in their time constants
/// (Kokotović, Khalil and O'Reilly, Singular Perturbation Methods in Control, 1986, ch. 2), with their slopes by pose,
/// speeds and parameters.
///
/// h = h₀ + A⁻¹·ḣ₀ with h₀ the equilibrium at the speeds and inputs, A = ∂h′/∂h, ḣ₀ = G·n′ + (∂h₀/∂u)·u′ and G = ∂h₀/∂n.
fn following(equations: &Equations, p: &[f64], record: &Record, row: usize, nodes: &[f64]) -> StateSensitivity {
    let mut stepper = Stepper::new(equations, &record.signals, p);
    let (n, m, t) = (equations.n(), equations.visible, record.time[row]);
    let (h, k) = (n - m, stepper.columns());
    let u = stepper.inputs(t).to_vec();
    let slope: Vec<f64> = stepper.inputs(t + DIFFERENCE).iter().zip(&u).map(|(b, a)| (b - a) / DIFFERENCE).collect();
    let mut z = initial_hidden(equations, p, &u, nodes);
    let width = n + u.len() + p.len();
    let mut workspace = equations.workspace(p);
    let f = equations.rates_and_jacobian(&mut workspace, &[nodes, &z].concat(), &u);
    let entry = |i: usize, j: usize| f[n + (m + i) * width + j];
    let by = |from: usize, count: usize| DMatrix::from_fn(h, count, |i, j| -entry(i, from + j));
    let mut s = vec![0.0; n * k];
    let own = DMatrix::from_fn(h, h, |i, j| entry(i, m + j)).lu();
    let slopes = own.solve(&by(0, m)).zip(own.solve(&by(n, u.len()))).zip(own.solve(&by(n + u.len(), p.len())));
    if let Some(((by_nodes, by_inputs), by_p)) = slopes {
        let moving = &by_nodes * DVector::from_column_slice(&f[..m]) + by_inputs * DVector::from_vec(slope);
        let late = own.solve(&moving);
        let all = late.filter(|late| late.iter().chain(by_nodes.iter()).chain(by_p.iter()).all(|v| v.is_finite()));
        for (i, late) in all.iter().flat_map(|late| late.iter().enumerate()) {
            z[i] += late;
            (0..m).for_each(|j| s[(m + i) * k + j] = by_nodes[(i, j)]);
            (0..p.len()).for_each(|j| s[(m + i) * k + m + j] = by_p[(i, j)]);
        }
    }
    StateSensitivity { z, s }
}

/// Over this time the slope of an input is taken, s.
const DIFFERENCE: f64 = 1e-4;

/// The states that follow the speeds at the start of a window, by those at the end of the one before: what moves the speeds
/// there moves them along the slow manifold, h = h₁ + G·(n − n₁) with G = S_h·S_n⁻¹.
pub fn moved_along(arc: &StateSensitivity, m: usize, begin: &[f64]) -> StateSensitivity {
    let n = arc.z.len();
    let k = arc.s.len() / n;
    let rows = |from: usize, count: usize, first: usize, width: usize| {
        DMatrix::from_fn(count, width, |i, j| arc.s[(from + i) * k + first + j])
    };
    let mut z = arc.z[m..].to_vec();
    let mut s = vec![0.0; n * k];
    let Some(inverse) = rows(0, m, 0, m).try_inverse() else { return StateSensitivity { z, s } };
    let along = rows(m, n - m, 0, m) * inverse;
    let moved = &along * DVector::from_iterator(m, begin.iter().zip(&arc.z).map(|(n, end)| n - end));
    z.iter_mut().zip(moved.iter()).for_each(|(z, by)| *z += by);
    let by_p = rows(m, n - m, m, k - m) - &along * rows(0, m, m, k - m);
    for i in 0..n - m {
        (0..m).for_each(|j| s[(m + i) * k + j] = along[(i, j)]);
        (m..k).for_each(|j| s[(m + i) * k + j] = by_p[(i, j - m)]);
    }
    StateSensitivity { z, s }
}

/// The rows that hidden states are carried through to one.
struct LeadIn<'a> {
    equations: &'a Equations,
    p: &'a [f64],
    record: &'a Record,
    visible: &'a [f64],
    first: usize,
    row: usize,
}

impl<'a> LeadIn<'a> {
    fn to(equations: &'a Equations, p: &'a [f64], record: &'a Record, row: usize, visible: &'a [f64]) -> Self {
        let time = &record.time;
        let gap = record.gap();
        let joined = |i: &usize| time[i + 1] - time[*i] <= gap && time[row] - time[*i] <= LEAD;
        let first = (0..row).rev().take_while(joined).last().unwrap_or(row);
        Self { equations, p, record, visible, first, row }
    }

    fn stepper(&self) -> Stepper<'a> {
        Stepper::new(self.equations, &self.record.signals, self.p)
    }

    fn at_rest(&self) -> StateSensitivity {
        at_rest(self.equations, self.p, &mut self.stepper(), self.record.time[self.first], self.visible)
    }

    fn along(&self, mut hidden: StateSensitivity) -> StateSensitivity {
        let (mut stepper, time) = (self.stepper(), &self.record.time);
        for i in self.first..self.row {
            // The pose a hidden state sees is the measured one; only the hidden states are carried.
            let z = [self.visible, &hidden.z].concat();
            let mut arc = match hidden.s.is_empty() {
                true => StateSensitivity { z, s: vec![] },
                false => stepper.start(&z, Some(&hidden.s)),
            };
            stepper.advance(&mut arc, time[i], time[i + 1]);
            hidden = StateSensitivity { z: arc.z[self.equations.visible..].to_vec(), s: arc.s };
        }
        hidden
    }
}

/// Hidden states and all sensitivities at a time, the hidden ones in their equilibrium under the inputs there.
///
/// A state that forgets is soon where its inputs drive it; its equilibrium is the best guess of where it is at
/// the start of a log, and depends on p: ∂h/∂p = −(∂h′/∂h)⁻¹·∂h′/∂p. Where there is no equilibrium, it is zero.
pub fn at_rest(equations: &Equations, p: &[f64], stepper: &mut Stepper, t: f64, visible: &[f64]) -> StateSensitivity {
    let (n, m) = (equations.n(), equations.visible);
    let (h, k) = (n - m, stepper.columns());
    let mut arc = StateSensitivity { z: vec![0.0; h], s: vec![0.0; n * k] };
    if h == 0 {
        return arc;
    }
    let u = stepper.inputs(t).to_vec();
    arc.z = initial_hidden(equations, p, &u, visible);
    let width = n + u.len() + p.len();
    let mut workspace = equations.workspace(p);
    let f = equations.rates_and_jacobian(&mut workspace, &[visible, &arc.z].concat(), &u);
    let entry = |i: usize, j: usize| f[n + (m + i) * width + j];
    let slope = DMatrix::from_fn(h, h, |i, j| entry(i, m + j));
    let by_p = slope.lu().solve(&DMatrix::from_fn(h, p.len(), |i, j| entry(i, n + u.len() + j)));
    if let Some(by_p) = by_p.filter(|b| b.iter().all(|x| x.is_finite())) {
        for i in 0..h {
            (0..p.len()).for_each(|j| arc.s[(m + i) * k + m + j] = -by_p[(i, j)]);
        }
    }
    arc
}
