//! States that no sensor sees: carried along from the start of a log, as far as they hang on it by what the poses show.

use super::hidden_state_fit::PropagatedState;
use super::slow_manifold::{self, FastDynamics, following};
use crate::discrepancy::record::run_record::Record;
use crate::model::Equations;
use crate::motion::{StateSensitivity, Stepper};
use nalgebra::DMatrix;

/// How long before the first window hidden states are carried from rest, s.
const LEAD: f64 = 3.0;
/// The same of states that hang on the inputs alone and may keep what these did long ago, s.
const MEMORY: f64 = 20.0;

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
        return (under_forces(equations, p, record, row, visible), 0.0);
    }
    let way = LeadIn::to(equations, p, record, row, visible, LEAD);
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
        return under_forces(equations, p, record, row, visible);
    }
    let way = LeadIn::to(equations, p, record, row, visible, LEAD);
    way.along(way.at_rest())
}

/// Hidden states at the first row of a log, by what the rows after it show.
pub fn at_start(equations: &Equations, record: &Record, pose: &[f64]) -> Vec<f64> {
    if equations.has_speeds() {
        return under_forces(equations, &[], record, 0, pose).z;
    }
    let way = LeadIn::to(equations, &[], record, 0, pose, LEAD);
    let memory = vec![1.0; equations.n() - equations.visible];
    PropagatedState { arc: way.at_rest(), pose, memory }.settled(equations, &[], record, 0).0.z
}

/// Hidden states of a vehicle that forces move: they follow the speeds that are free there; what hangs on the inputs alone, as the
/// teeth of a gear with play do, is where the log before has left it.
fn under_forces(equations: &Equations, p: &[f64], record: &Record, row: usize, nodes: &[f64]) -> StateSensitivity {
    let mut found = following(equations, p, record, row, nodes);
    let is_moved = equations.moved_by_visible();
    if is_moved.iter().all(|moved| *moved) {
        return found;
    }
    let way = LeadIn::to(equations, p, record, row, nodes, MEMORY);
    let rest = way.at_rest();
    // Without parameters there is nothing that they hang on.
    let left = way.along(if p.is_empty() { StateSensitivity { s: vec![], ..rest } } else { rest });
    let (m, columns) = (equations.visible, found.s.len() / equations.n());
    for i in (m..equations.n()).filter(|i| !is_moved[*i]) {
        found.z[i - m] = left.z[i - m];
        let own = i * columns..(i + 1) * columns;
        match left.s.get(own.clone()) {
            Some(by) => found.s[own].copy_from_slice(by),
            None => found.s[own].fill(0.0),
        }
    }
    found
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
    /// To a row, from rows at most so many seconds before it.
    fn to(
        equations: &'a Equations,
        p: &'a [f64],
        record: &'a Record,
        row: usize,
        visible: &'a [f64],
        lead: f64,
    ) -> Self {
        let time = &record.time;
        let gap = record.gap();
        let joined = |i: &usize| time[i + 1] - time[*i] <= gap && time[row] - time[*i] <= lead;
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
    if n == m {
        return StateSensitivity { z: vec![], s: vec![0.0; n * stepper.columns()] };
    }
    let u = stepper.inputs(t).to_vec();
    let rest = FastDynamics::in_equilibrium(equations, p, visible, &u);
    let none = |columns: usize| DMatrix::zeros(n - m, columns);
    let by_p = rest.by_parameters().unwrap_or_else(|| none(p.len()));
    slow_manifold::arc(rest.h, &none(m), &by_p)
}

#[cfg(test)]
mod tests {
    use super::super::slow_manifold::moved_along;
    use super::*;
    use crate::effects::{Applied, named};
    use crate::model::Model;
    use crate::model::forces::{Dynamics, Masses};
    use crate::motion::Timing;

    /// A wheel with play in its gear, whose torque falls from 1 through zero at 0.5 s to −1 at 1 s, and stays.
    fn wheel() -> (Equations, Record) {
        let disk = Model::new("unicycle", &[("wheel_radius", 0.1)]).unwrap();
        let wheels = [("theta'".into(), 0.05)].into();
        let masses = Masses { mass: 20.0, inertia: 1.0, wheels, ..Masses::default() };
        let disk = Dynamics::new(&disk, &masses).unwrap().driven_by(&["wheel_torque", "yaw_torque"]).unwrap();
        let disk = disk.with_laws("viscous", &[200.0]).unwrap().model().unwrap();
        let play = Applied::new(named("gear-backlash").unwrap(), None, vec![0.5]).freed();
        let time: Vec<f64> = (0..80).map(|i| 0.025 * f64::from(i)).collect();
        let of = |f: &dyn Fn(f64) -> f64| time.iter().map(|t| f(*t)).collect::<Vec<f64>>();
        let inputs = [of(&|t| (1.0 - 2.0 * t).max(-1.0)), of(&|_| 0.1)];
        let record = Record::new(
            "run",
            time.clone(),
            vec![of(&|t| t), of(&|_| 0.0), of(&|_| 0.0)],
            true,
            &inputs,
            Timing::Sample,
        );
        (disk.with_effect(play).free_equations().unwrap(), record)
    }

    /// 1 s after it left its flank the impulse −∫τ is 0.25 + 0.5 N·m·s, of the 2·ℓ·m·r = 2 that lie between the flanks: 1 − 0.75 of
    /// the half. By ℓ it moves as the way does. Steps that begin on a flank are good to the square of their length.
    #[test]
    fn teeth_stand_where_the_log_before_has_left_them() {
        let (equations, record) = wheel();
        let (p, nodes) = ([0.5], [0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
        let found = carried(&equations, &p, &record, 60, &nodes[..equations.visible]);
        let gap = equations.states[equations.visible..].iter().position(|s| s.as_str().contains("gap")).unwrap();
        assert!((found.z[gap] - 0.25).abs() < 0.025 * 0.025, "{:?}", found.z);
        let columns = equations.visible + 1;
        let by_p = found.s[(equations.visible + gap + 1) * columns - 1];
        assert!((by_p - 0.75 / 0.5).abs() < 4.0 * 0.025 * 0.025, "{by_p}");
        // A jump of the speeds, of which the window before has forgotten how they began, leaves them there and moves the wheel.
        let m = equations.visible;
        let mut end = StateSensitivity { z: [&nodes[..m], &found.z].concat(), s: found.s.clone() };
        (0..equations.n()).for_each(|i| end.s[i * columns..i * columns + m].fill(0.0));
        (0..equations.poses).for_each(|i| end.s[i * columns + i] = 1.0);
        let mut begin = nodes[..equations.visible].to_vec();
        begin[3] += 0.2;
        let next = moved_along(&equations, &p, &end, &begin, &[-1.0, 0.1]);
        assert_eq!(next.z[gap], found.z[gap]);
        assert!((next.z[1 - gap] - found.z[1 - gap] - 2.0).abs() < 1e-3, "{:?} {:?}", next.z, found.z);
    }
}
