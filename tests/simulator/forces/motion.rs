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
    /// Where the teeth of every wheel's gear stand in their play: the impulse spent on the way from its middle.
    pub gap: Vec<f64>,
    /// The mean torque that goes into crossing the play, over the step.
    pub taken: Vec<f64>,
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
        let place = state.speed[..state.place.len()].to_vec();
        State { place, speed, built: self.building(state, &inputs), gap: vec![], taken: vec![] }
    }

    /// The teeth of the gears, over a step: the motor pushes them until they meet, and only then the wheel.
    fn cross(&self, state: &mut State, t: f64, h: f64, inputs: Signal) {
        let torques = [0.0, h / 2.0, h].map(|later| inputs(t + later).0);
        for (i, wheel) in self.wheels.iter().enumerate() {
            let Some(k) = wheel.input.filter(|_| wheel.play > 0.0) else { continue };
            let impulse = wheel.gain * h * (torques[0][k] + 4.0 * torques[1][k] + torques[2][k]) / 6.0;
            let next = (state.gap[i] + impulse).clamp(-wheel.play, wheel.play);
            state.taken[i] = (next - state.gap[i]) / h;
            state.gap[i] = next;
        }
    }
}

fn moved(state: &State, by: &State, h: f64) -> State {
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + h * b).collect();
    State {
        place: sum(&state.place, &by.place),
        speed: sum(&state.speed, &by.speed),
        built: sum(&state.built, &by.built),
        gap: state.gap.clone(),
        taken: state.taken.clone(),
    }
}

/// A machine from one time to another.
pub fn advance(machine: &Machine, state: &mut State, from: f64, to: f64, inputs: Signal) {
    let steps = ((to - from) / machine.step(state)).ceil().max(1.0);
    let h = (to - from) / steps;
    for i in 0..steps as usize {
        let t = from + h * i as f64;
        machine.cross(state, t, h, inputs);
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
