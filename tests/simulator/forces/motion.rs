//! A motion: the classical Runge–Kutta method with constraints projected after every step.

use super::machine::{Law, Machine, NEARLY_AT_REST};
use super::newton::Inputs;

/// Places of the centres of mass with headings, body by body; velocities in the same order, then rates of the wheels.
#[derive(Clone, Debug)]
pub struct State {
    pub place: Vec<f64>,
    pub speed: Vec<f64>,
    /// The side force that has built up at every contact, where it does not follow at once.
    pub built: Vec<f64>,
}

/// A machine slows down by no more than this from one row to the next, m/s.
const SLOWER_BY: f64 = 0.2;

/// Inputs as a function of time: values and rates.
pub type Signal<'s> = &'s dyn Fn(f64) -> (Vec<f64>, Vec<f64>);

impl Machine {
    /// The largest step from a state, s: well below the fastest answer of any contact until the next row.
    pub fn step(&self, state: &State) -> f64 {
        let mut fastest: f64 = 50.0;
        for contact in &self.contacts {
            let solid = &self.solids[contact.body];
            let light = 1.0 / solid.mass + (0.5 + contact.at[0].abs() + contact.at[1].abs()).powi(2) / solid.inertia;
            let [along, across] = [0, 1].map(|k| state.speed[3 * contact.body + k]);
            let slowest = (along.hypot(across) - SLOWER_BY).clamp(NEARLY_AT_REST, 0.3);
            let stiff = |law: Law| match law {
                Law::Ideal => 0.0,
                Law::Viscous(b) => b,
                Law::Rocard(k) => k / slowest,
            };
            fastest = fastest.max(contact.side.map_or(0.0, |g| stiff(g.law) * light));
            if let Some((wheel, grip)) = contact.rolls {
                let w = &self.wheels[wheel];
                fastest = fastest.max(stiff(grip.law) * (light + w.radius * w.radius / w.inertia));
            }
        }
        (0.1 / fastest).min(2e-3)
    }

    fn rates(&self, state: &State, t: f64, inputs: Signal) -> State {
        let (u, rate) = inputs(t);
        let inputs = Inputs { u: &u, rate: &rate };
        let speed = self.accelerations(state, &inputs);
        State { place: state.speed[..state.place.len()].to_vec(), speed, built: self.building(state, &inputs) }
    }
}

fn moved(state: &State, by: &State, h: f64) -> State {
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + h * b).collect();
    State {
        place: sum(&state.place, &by.place),
        speed: sum(&state.speed, &by.speed),
        built: sum(&state.built, &by.built),
    }
}

/// A machine from one time to another.
pub fn advance(machine: &Machine, state: &mut State, from: f64, to: f64, inputs: Signal) {
    let steps = ((to - from) / machine.step(state)).ceil().max(1.0);
    let h = (to - from) / steps;
    for i in 0..steps as usize {
        let t = from + h * i as f64;
        let k1 = machine.rates(state, t, inputs);
        let k2 = machine.rates(&moved(state, &k1, h / 2.0), t + h / 2.0, inputs);
        let k3 = machine.rates(&moved(state, &k2, h / 2.0), t + h / 2.0, inputs);
        let k4 = machine.rates(&moved(state, &k3, h), t + h, inputs);
        let mut next = state.clone();
        for (k, weight) in [(&k1, 1.0), (&k2, 2.0), (&k3, 2.0), (&k4, 1.0)] {
            next = moved(&next, k, h * weight / 6.0);
        }
        let (u, rate) = inputs(t + h);
        machine.project(&mut next, &Inputs { u: &u, rate: &rate });
        *state = next;
    }
}
