//! Newton's and Euler's laws with multipliers for hitches and ideal contacts.

use super::machine::{Law, Machine};
use super::motion::State;
use nalgebra::{DMatrix, DVector};

/// A row of constraints: what it says of the velocities, and the rate at which that changes by itself.
struct Row {
    by: Vec<(usize, f64)>,
    bias: f64,
}

/// The inputs at a time and their rates.
pub struct Inputs<'u> {
    pub u: &'u [f64],
    pub rate: &'u [f64],
}

/// The smallest speed, m/s, at which dry friction is what it is at speed: below it is smooth.
const SLOW: f64 = 0.01;

/// m/s².
const GRAVITY: f64 = 9.81;
/// Loads and accelerations are made to agree in so many rounds; each leaves a small share of what the one before left.
const ROUNDS: usize = 6;

impl Machine {
    /// How many velocities there are.
    fn size(&self) -> usize {
        3 * self.solids.len() + self.wheels.len()
    }

    /// Where a place of a body lies from its centre of mass, in the world's axes.
    fn arm(&self, state: &State, body: usize, at: [f64; 2]) -> [f64; 2] {
        let c = self.solids[body].centre;
        let (sin, cos) = state.place[3 * body + 2].sin_cos();
        let [a, b] = [at[0] - c[0], at[1] - c[1]];
        [a * cos - b * sin, a * sin + b * cos]
    }

    /// The velocity there.
    fn velocity(&self, state: &State, body: usize, arm: [f64; 2]) -> [f64; 2] {
        let v = &state.speed[3 * body..];
        [v[0] - v[2] * arm[1], v[1] + v[2] * arm[0]]
    }

    /// Velocity of the reference point of a body, along it and to its left.
    pub fn reference(&self, state: &State, body: usize) -> [f64; 2] {
        let v = self.velocity(state, body, self.arm(state, body, [0.0, 0.0]));
        let (sin, cos) = state.place[3 * body + 2].sin_cos();
        [v[0] * cos + v[1] * sin, v[1] * cos - v[0] * sin]
    }

    /// The place of the reference point of a body.
    pub fn place(&self, state: &State, body: usize) -> [f64; 2] {
        let arm = self.arm(state, body, [0.0, 0.0]);
        [state.place[3 * body] + arm[0], state.place[3 * body + 1] + arm[1]]
    }

    fn masses(&self) -> DVector<f64> {
        let of_solids = self.solids.iter().flat_map(|s| [s.mass, s.mass, s.inertia]);
        DVector::from_iterator(self.size(), of_solids.chain(self.wheels.iter().map(|w| w.inertia)))
    }

    /// A row for the velocity of a place along a direction that turns at a rate.
    fn along(&self, state: &State, body: usize, arm: [f64; 2], e: [f64; 2], turning: f64) -> Row {
        let v = self.velocity(state, body, arm);
        let omega = state.speed[3 * body + 2];
        let k = 3 * body;
        // d/dt(e·v): e turns by its rate, and the place is drawn to the centre.
        let turned = turning * (-e[1] * v[0] + e[0] * v[1]);
        let drawn = -omega * omega * (e[0] * arm[0] + e[1] * arm[1]);
        Row { by: vec![(k, e[0]), (k + 1, e[1]), (k + 2, e[1] * arm[0] - e[0] * arm[1])], bias: turned + drawn }
    }

    fn rows(&self, state: &State, inputs: &Inputs) -> Vec<Row> {
        let mut rows = Vec::new();
        for (i, hitch) in self.hitches.iter().enumerate() {
            let front = self.arm(state, hitch.front, [-hitch.behind, 0.0]);
            let back = self.arm(state, i + 1, [hitch.length, 0.0]);
            for e in [[1.0, 0.0], [0.0, 1.0]] {
                let mut row = self.along(state, hitch.front, front, e, 0.0);
                let other = self.along(state, i + 1, back, e, 0.0);
                row.by.extend(other.by.iter().map(|(k, c)| (*k, -c)));
                row.bias -= other.bias;
                rows.push(row);
            }
        }
        for contact in &self.contacts {
            let (e, turning) = self.heading(state, contact, inputs);
            let arm = self.arm(state, contact.body, contact.at);
            if let Some((wheel, grip)) = contact.rolls
                && grip.law == Law::Ideal
            {
                let mut row = self.along(state, contact.body, arm, e, turning);
                row.by.push((3 * self.solids.len() + wheel, -self.wheels[wheel].radius));
                rows.push(row);
            }
            if contact.side.is_some_and(|grip| grip.law == Law::Ideal) {
                rows.push(self.along(state, contact.body, arm, [-e[1], e[0]], turning));
            }
        }
        rows
    }

    fn heading(&self, state: &State, contact: &super::machine::Contact, inputs: &Inputs) -> ([f64; 2], f64) {
        let k = 3 * contact.body + 2;
        let [angle, rate] = contact.steered.map_or([0.0; 2], |i| [inputs.u[i], inputs.rate[i]]);
        let (sin, cos) = (state.place[k] + angle).sin_cos();
        ([cos, sin], state.speed[k] + rate)
    }

    /// Everything that pushes, while the towing body speeds up by so much, m/s².
    fn pushed(&self, state: &State, inputs: &Inputs, growth: f64) -> DVector<f64> {
        let mut q = DVector::zeros(self.size());
        let mut push = |body: usize, arm: [f64; 2], f: [f64; 2]| {
            q[3 * body] += f[0];
            q[3 * body + 1] += f[1];
            q[3 * body + 2] += arm[0] * f[1] - arm[1] * f[0];
        };
        let mut torques = vec![0.0; self.wheels.len()];
        for (i, contact) in self.contacts.iter().enumerate() {
            let (e, _) = self.heading(state, contact, inputs);
            let arm = self.arm(state, contact.body, contact.at);
            let [along, left] = self.sliding(state, contact, inputs);
            if let Some((wheel, grip)) = contact.rolls {
                let spin = state.speed[3 * self.solids.len() + wheel];
                let radius = self.wheels[wheel].radius;
                let f = grip.force(along - radius * spin, along);
                push(contact.body, arm, [f * e[0], f * e[1]]);
                torques[wheel] -= radius * f;
            }
            if let Some(grip) = contact.side {
                let at_once = grip.scaled(self.load(contact, growth)).force(left, along);
                let f = if self.relaxation > 0.0 { state.built[i] } else { at_once };
                push(contact.body, arm, [-f * e[1], f * e[0]]);
            }
        }
        let (sin, cos) = state.place[2].sin_cos();
        let [ahead, _] = self.reference(state, 0);
        let of = |i: usize| self.pushes[i].map_or(0.0, |k| inputs.u[k]);
        let braked = self.rolling * (ahead / SLOW).tanh() + self.drag[0] * ahead + self.drag[1] * ahead * ahead.abs();
        let (f, g) = (of(0) - braked, of(1));
        push(0, [0.0; 2], [f * cos - g * sin + self.hill[0], f * sin + g * cos + self.hill[1]]);
        for (i, drag) in self.trailing.iter().enumerate() {
            let (sin, cos) = state.place[3 * (i + 1) + 2].sin_cos();
            let f = -drag * self.reference(state, i + 1)[0];
            push(i + 1, self.arm(state, i + 1, [0.0; 2]), [f * cos, f * sin]);
        }
        q[2] += of(2) - self.turning * state.speed[2];
        for (i, wheel) in self.wheels.iter().enumerate() {
            let spin = state.speed[3 * self.solids.len() + i];
            let driven = wheel.input.map_or(0.0, |k| wheel.gain * inputs.u[k]);
            let rub = wheel.coulomb * (wheel.radius * spin / SLOW).tanh();
            q[3 * self.solids.len() + i] += torques[i] + driven - state.taken[i] - wheel.viscous * spin - rub;
        }
        q
    }

    /// The velocity of a contact along its wheel and to its left.
    fn sliding(&self, state: &State, contact: &super::machine::Contact, inputs: &Inputs) -> [f64; 2] {
        let (e, _) = self.heading(state, contact, inputs);
        let v = self.velocity(state, contact.body, self.arm(state, contact.body, contact.at));
        [v[0] * e[0] + v[1] * e[1], v[1] * e[0] - v[0] * e[1]]
    }

    /// How fast the side forces build up.
    pub fn building(&self, state: &State, inputs: &Inputs) -> Vec<f64> {
        let of = |(i, contact): (usize, &super::machine::Contact)| {
            let Some(grip) = contact.side.filter(|_| self.relaxation > 0.0) else { return 0.0 };
            let [along, left] = self.sliding(state, contact, inputs);
            (grip.force(left, along) - state.built[i]) * along.abs() / self.relaxation
        };
        self.contacts.iter().enumerate().map(of).collect()
    }

    /// The load of a contact as a share of what it is at a steady speed.
    fn load(&self, contact: &super::machine::Contact, growth: f64) -> f64 {
        let moved = 2.0 * self.height * growth / GRAVITY;
        match contact.body {
            0 if contact.at[0] > 0.0 => 1.0 - moved,
            0 => 1.0 + moved,
            _ => 1.0,
        }
    }

    /// Accelerations; where load moves with them, those that agree with their own loads.
    pub fn accelerations(&self, state: &State, inputs: &Inputs) -> Vec<f64> {
        let (sin, cos) = state.place[2].sin_cos();
        let mut found = self.accelerations_at(state, inputs, 0.0);
        let rounds = if self.height == 0.0 { 0 } else { ROUNDS };
        for _ in 0..rounds {
            found = self.accelerations_at(state, inputs, found[0] * cos + found[1] * sin);
        }
        found
    }

    fn accelerations_at(&self, state: &State, inputs: &Inputs, growth: f64) -> Vec<f64> {
        let (n, rows) = (self.size(), self.rows(state, inputs));
        let (masses, push) = (self.masses(), self.pushed(state, inputs, growth));
        let m = rows.len();
        let mut matrix = DMatrix::zeros(n + m, n + m);
        let mut side = DVector::zeros(n + m);
        for i in 0..n {
            matrix[(i, i)] = masses[i];
            side[i] = push[i];
        }
        for (r, row) in rows.iter().enumerate() {
            for (k, c) in &row.by {
                matrix[(n + r, *k)] += c;
                matrix[(*k, n + r)] += c;
            }
            side[n + r] = -row.bias;
        }
        let solved = matrix.lu().solve(&side).expect("constraints of a machine are independent");
        solved.as_slice()[..n].to_vec()
    }

    /// The velocities nearest in kinetic energy that hitches and ideal contacts admit, and bodies that hang together.
    pub fn project(&self, state: &mut State, inputs: &Inputs) {
        let n = self.size();
        let masses = self.masses();
        let lighter = |rows: &[Row], off: &DVector<f64>| -> DVector<f64> {
            let j = DMatrix::from_fn(rows.len(), n, |r, k| {
                rows[r].by.iter().filter(|(i, _)| *i == k).map(|(_, c)| c).sum()
            });
            let weighted = DMatrix::from_fn(n, rows.len(), |k, r| j[(r, k)] / masses[k]);
            let inner = (&j * &weighted).lu().solve(off).expect("constraints of a machine are independent");
            weighted * inner
        };
        let pins = 2 * self.hitches.len();
        if pins > 0 {
            let rows = &self.rows(state, inputs)[..pins];
            let mut off = DVector::zeros(pins);
            for (i, hitch) in self.hitches.iter().enumerate() {
                let front = self.arm(state, hitch.front, [-hitch.behind, 0.0]);
                let back = self.arm(state, i + 1, [hitch.length, 0.0]);
                for c in 0..2 {
                    off[2 * i + c] =
                        state.place[3 * hitch.front + c] + front[c] - state.place[3 * (i + 1) + c] - back[c];
                }
            }
            let by = lighter(rows, &off);
            (0..state.place.len()).for_each(|k| state.place[k] -= by[k]);
        }
        let rows = self.rows(state, inputs);
        if !rows.is_empty() {
            let off = DVector::from_iterator(
                rows.len(),
                rows.iter().map(|row| row.by.iter().map(|(k, c)| c * state.speed[*k]).sum()),
            );
            let by = lighter(&rows, &off);
            (0..n).for_each(|k| state.speed[k] -= by[k]);
        }
    }
}
