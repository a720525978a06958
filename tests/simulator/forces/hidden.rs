//! What the machine has and the model file does not say.

use super::drawn::Make;
use super::machine::{Grip, Machine};
use rand::Rng;
use rand_chacha::ChaCha8Rng;

/// A hidden effect of the library by its id, with the values of its parameters.
#[derive(Clone, Debug)]
pub struct Secret {
    pub id: &'static str,
    pub trailer: Option<usize>,
    pub values: Vec<(&'static str, f64)>,
}

const G: f64 = 9.81;

/// The effects that a make may hide, each with the trailer it belongs to.
pub fn secrets(make: Make) -> Vec<(&'static str, Option<usize>)> {
    let mut ids =
        vec!["mass", "inertia", "mass-centre-ahead", "rolling-resistance", "viscous-drag", "air-drag", "hill"];
    ids.push("turning-drag");
    ids.push("mass-centre-aside");
    if make != Make::Sleigh {
        ids.extend([
            "drive-gain",
            "back-emf",
            "drive-friction",
            "gear-backlash",
            "traction",
            "traction-limit",
            "cornering-stiffness-rear",
        ]);
        ids.extend(["side-grip-limit", "relaxation"]);
    }
    if matches!(make, Make::Car | Make::Train | Make::SkidSteer) {
        ids.extend(["cornering-stiffness-front", "load-transfer"]);
    }
    let mut found: Vec<_> = ids.into_iter().map(|id| (id, None)).collect();
    if make == Make::Train {
        let own = ["trailer-mass", "trailer-drag", "trailer-cornering-stiffness"];
        found.extend(own.into_iter().flat_map(|id| [(id, Some(1)), (id, Some(2))]));
    }
    found
}

impl Secret {
    /// Its values, of either sign where they have one.
    pub fn drawn(id: &'static str, trailer: Option<usize>, random: &mut ChaCha8Rng) -> Self {
        let mut between = |a: f64, b: f64| random.random_range(a..b);
        let sign = if between(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 };
        let values = match id {
            "mass" | "inertia" | "trailer-mass" => vec![("scale", sign * between(0.15, 0.4))],
            "mass-centre-ahead" | "mass-centre-aside" => vec![("offset", sign * between(0.04, 0.12))],
            "drive-gain" => vec![("scale", sign * between(0.08, 0.3))],
            "back-emf" | "viscous-drag" => vec![("rate", between(0.05, 0.25))],
            "drive-friction" | "rolling-resistance" => vec![("coefficient", between(0.004, 0.012))],
            "gear-backlash" => vec![("lost", between(0.03, 0.12))],
            "air-drag" => vec![("c", between(0.01, 0.06))],
            "turning-drag" => vec![("rate", between(0.2, 0.6))],
            "hill" => vec![("grade", between(0.005, 0.02)), ("downhill", between(-3.1, 3.1))],
            "traction" | "cornering-stiffness-rear" | "cornering-stiffness-front" | "trailer-cornering-stiffness" => {
                vec![("scale", sign * between(0.25, 0.5))]
            }
            "side-grip-limit" | "traction-limit" => vec![("softness", between(0.6, 1.6))],
            "trailer-drag" => vec![("rate", between(0.1, 0.4))],
            "load-transfer" => vec![("height", between(0.2, 0.6))],
            "relaxation" => vec![("length", between(0.15, 0.6))],
            other => panic!("no secret is called {other}"),
        };
        Self { id, trailer, values }
    }

    fn value(&self, name: &str) -> f64 {
        self.values.iter().find(|(n, _)| *n == name).map_or(f64::NAN, |(_, v)| *v)
    }

    /// The machine with it.
    pub fn hide(&self, machine: &mut Machine) {
        let body = machine.solids[0];
        let i = self.trailer.unwrap_or(0);
        let scale = 1.0 + self.value("scale");
        let rate = self.value("rate");
        match self.id {
            "mass" | "trailer-mass" => machine.solids[i].mass *= scale,
            "inertia" => machine.solids[0].inertia *= scale,
            "mass-centre-ahead" => machine.solids[0].centre[0] += self.value("offset"),
            "mass-centre-aside" => machine.solids[0].centre[1] += self.value("offset"),
            "drive-gain" => machine.wheels.iter_mut().for_each(|w| w.gain *= scale),
            "back-emf" => machine.wheels.iter_mut().for_each(|w| w.viscous = rate * body.mass * w.radius * w.radius),
            "drive-friction" => {
                let share = self.value("coefficient");
                machine.wheels.iter_mut().for_each(|w| w.coulomb = share * body.mass * G * w.radius);
            }
            "gear-backlash" => {
                machine.wheels.iter_mut().for_each(|w| w.play = self.value("lost") * body.mass * w.radius)
            }
            "rolling-resistance" => machine.rolling = self.value("coefficient") * body.mass * G,
            "viscous-drag" => machine.drag[0] = rate * body.mass,
            "air-drag" => machine.drag[1] = self.value("c") * body.mass,
            "turning-drag" => machine.turning = rate * body.inertia,
            "load-transfer" => machine.height = self.value("height"),
            "relaxation" => machine.relaxation = self.value("length"),
            "hill" => {
                let (sin, cos) = self.value("downhill").sin_cos();
                machine.hill = [cos, sin].map(|e| G * self.value("grade") * body.mass * e);
            }
            "trailer-drag" => machine.trailing[i - 1] = rate * machine.solids[i].mass,
            _ => self.loosen(machine, body.mass),
        }
    }

    /// The contacts with it.
    fn loosen(&self, machine: &mut Machine, mass: f64) {
        let scale = 1.0 + self.value("scale");
        let limit = mass / self.value("softness");
        let of_trailer = self.trailer.unwrap_or(0);
        for c in &mut machine.contacts {
            let rolls = |c: &mut super::machine::Contact, f: &dyn Fn(Grip) -> Grip| {
                c.rolls = c.rolls.map(|(w, grip)| (w, f(grip)));
            };
            match self.id {
                "traction" => rolls(c, &|grip| grip.scaled(scale)),
                "traction-limit" => rolls(c, &|grip| Grip { limit, ..grip }),
                "side-grip-limit" => c.side = c.side.map(|grip| Grip { limit, ..grip }),
                "cornering-stiffness-rear" if c.body == 0 && c.at[0] <= 0.0 => c.side = c.side.map(|g| g.scaled(scale)),
                "cornering-stiffness-front" if c.body == 0 && c.at[0] > 0.0 => c.side = c.side.map(|g| g.scaled(scale)),
                "trailer-cornering-stiffness" if c.body == of_trailer => c.side = c.side.map(|g| g.scaled(scale)),
                _ => {}
            }
        }
    }
}
