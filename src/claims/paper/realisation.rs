//! Realisation as an inversion: from any admissible motion back to the coefficients and round again.

use crate::claims::driven::{Creep, model, undefined};
use crate::claims::{Claim, Fault, Statement, Status, Verdict, near, value_said};
use crate::formula::Symbol;
use crate::model::{Model, Trailer};
use proptest::prelude::*;

pub(super) fn claims() -> Vec<Claim> {
    vec![
        Claim::new("realisation", Status::Sampled, "every admissible creeping motion has coefficients, and they give the motion back")
            .at("section 4, Proposition and both theorems; corrected theorems (a)–(c)")
            .about(&[8, 17, 24, 25])
            .under("driven wheels turn, no contact has v_l = 0, the wheels do not stand across their motion")
            .chapter("05b-corrected-single-body")
            .code(&["src/model/equations.rs", "src/effects/catalogue.toml"])
            .tests(&["tests/mechanism_effects.rs", "tests/motion_kinematics.rs"])
            .sample(
                "generated twists and trailer rates of unicycles, differential drives and cars with up to five trailers: \
                 coefficients from velocities of the contacts, put into the model as effects, through the compiled equations",
                &[
                    ("e_rc", "1 - v_l/(r*omega)"),
                    ("e_right", "1 - (v_l + a*yaw/2)/(r*omega_1)"),
                    ("e_left", "1 - (v_l - a*yaw/2)/(r*omega_2)"),
                    ("e_tc", "v_t/v_l"),
                    ("e_front", "tan(atan((v_t + L*yaw)/v_l) - delta)"),
                    ("e_trailer", "w_i/v_i"),
                ],
                |s, sampling| sampling.cases(motions(), Motion::shown, |m| round(s, m)),
            ),
    ]
}

/// A motion of a vehicle in a configuration.
#[derive(Clone, Debug)]
struct Motion {
    vehicle: usize,
    twist: [f64; 3],
    wheels: [f64; 2],
    delta: f64,
    phi: f64,
    /// Bar, hitch, heading behind the one ahead, and rate of each trailer.
    trailers: Vec<(f64, f64, f64, f64)>,
}

const VEHICLES: [(&str, &[(&str, f64)]); 3] = [
    ("unicycle", &[("wheel_radius", 0.5)]),
    ("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.4)]),
    ("car", &[("wheel_radius", 0.3), ("wheelbase", 1.3)]),
];

fn motions() -> impl Strategy<Value = Motion> {
    let trailer = (0.5..2.0f64, -0.3..0.3f64, -0.7..0.7f64, -0.4..0.4f64);
    let twist = (0.5..2.0f64, -0.4..0.4f64, -0.8..0.8f64);
    let wheels = (2.0..8.0f64, 2.0..8.0f64);
    (0..VEHICLES.len(), twist, wheels, -0.4..0.4f64, -3.0..3.0f64, prop::collection::vec(trailer, 0..=5)).prop_map(
        |(vehicle, twist, wheels, delta, phi, trailers)| Motion {
            vehicle,
            twist: [twist.0, twist.1, twist.2],
            wheels: [wheels.0, wheels.1],
            delta,
            phi,
            trailers,
        },
    )
}

impl Motion {
    fn shown(&self) -> Vec<(String, String)> {
        let name = |s: &str| s.to_string();
        vec![
            (name("vehicle"), VEHICLES[self.vehicle].0.into()),
            (name("v_l, v_t, yaw rate"), format!("{:?}", self.twist)),
            (name("wheel rates"), format!("{:?}", self.wheels)),
            (name("delta, phi"), format!("{:?}", [self.delta, self.phi])),
            (name("trailers"), format!("{:?}", self.trailers)),
        ]
    }

    /// Forward and lateral velocity of each trailer's axle, from the rates alone.
    fn trailer_velocities(&self) -> Vec<(f64, f64)> {
        let (mut forward, mut left, mut rate) = (self.twist[0], self.twist[1], self.twist[2]);
        let step = |(length, hitch, beta, own): &(f64, f64, f64, f64)| {
            let sideways = left - hitch * rate;
            let (sin, cos) = beta.sin_cos();
            (forward, left) = (forward * cos - sideways * sin, forward * sin + sideways * cos - length * own);
            rate = *own;
            (forward, left)
        };
        self.trailers.iter().map(step).collect()
    }

    fn headings(&self) -> Vec<f64> {
        let step = |heading: &mut f64, beta: &f64| {
            *heading -= beta;
            Some(*heading)
        };
        self.trailers.iter().map(|t| &t.2).scan(self.phi, step).collect()
    }

    fn value(&self, name: &str) -> Option<f64> {
        let parameters = VEHICLES[self.vehicle].1;
        Some(match name {
            "v_l" => self.twist[0],
            "v_t" => self.twist[1],
            "yaw" => self.twist[2],
            "r" => parameters[0].1,
            "a" | "L" => parameters.get(1)?.1,
            "omega" | "omega_1" => self.wheels[0],
            "omega_2" => self.wheels[1],
            "delta" => self.delta,
            _ => return None,
        })
    }

    /// The model with the coefficients that a statement gives to this motion.
    fn creeping(&self, s: &Statement) -> Result<Model, Fault> {
        let said = |name: &str| value_said(s, name, &|n| self.value(n));
        let mut creeps: Vec<Creep> = vec![("traverse-creep", None, vec![said("e_tc")?])];
        match VEHICLES[self.vehicle].0 {
            // Values in alphabetical order: e_left, e_right.
            "differential-drive" => {
                creeps.push(("unequal-rotation-creep", None, vec![said("e_left")?, said("e_right")?]))
            }
            "car" => {
                creeps.push(("rotation-creep", None, vec![said("e_rc")?]));
                creeps.push(("front-traverse-creep", None, vec![said("e_front")?]));
            }
            _ => creeps.push(("rotation-creep", None, vec![said("e_rc")?])),
        }
        for (i, (v, w)) in self.trailer_velocities().into_iter().enumerate() {
            if v.abs() < 0.1 {
                return Err(Fault::Outside);
            }
            let at = |name: &str| match name {
                "v_i" => Some(v),
                "w_i" => Some(w),
                _ => None,
            };
            creeps.push(("trailer-traverse-creep", Some(i + 1), vec![value_said(s, "e_trailer", &at)?]));
        }
        let trailers: Vec<Trailer> = self.trailers.iter().map(|t| Trailer { length: t.0, hitch: t.1 }).collect();
        let (vehicle, parameters) = VEHICLES[self.vehicle];
        model(vehicle, parameters, &trailers, &creeps).map_err(|e| undefined(&e))
    }
}

fn round(s: &Statement, m: &Motion) -> Verdict {
    let model = m.creeping(s)?;
    let equations = model.equations(&[]).map_err(|e| undefined(&e))?;
    let mut w = equations.workspace(&[]);
    let z: Vec<f64> = [0.0, 0.0, m.phi].into_iter().chain(m.headings()).collect();
    let input = |name: &Symbol| match name.as_str() {
        "yaw_rate" => m.twist[2],
        "steering_angle" => m.delta,
        "wheel_rate_left" => m.wheels[1],
        _ => m.wheels[0],
    };
    let u: Vec<f64> = equations.inputs.iter().map(input).collect();
    let mut rates = vec![0.0; equations.n()];
    equations.rates(&mut w, &z, &u, &mut rates);
    let (sin, cos) = m.phi.sin_cos();
    near("x'", rates[0], m.twist[0] * cos - m.twist[1] * sin, 1e-9)?;
    near("y'", rates[1], m.twist[0] * sin + m.twist[1] * cos, 1e-9)?;
    near("phi'", rates[2], m.twist[2], 1e-9)?;
    m.trailers.iter().zip(&rates[3..]).try_for_each(|(t, found)| near("phi_i'", *found, t.3, 1e-9))
}
