//! Realisation as an inversion: from any admissible motion back to the coefficients and round again.

use crate::claims::generated::{Contact, Moving, moving};
use crate::claims::simulated::{Creep, model, undefined};
use crate::claims::{Claim, Fault, Statement, Status, Verdict, near, value_said};
use crate::formula::{Exact, Expr, Symbol};
use crate::model::{Model, Trailer};
use crate::vehicles::Definition;
use proptest::prelude::*;

pub(crate) fn claims() -> Vec<Claim> {
    vec![
        Claim::new("realisation", Status::Sampled, "every admissible creeping motion has coefficients, and they give the motion back")
            .at("section 4, Proposition and both theorems; corrected theorems (a)–(c)")
            .about(&[8, 17, 24, 25])
            .under("driven wheels turn, no contact has v_l = 0, the wheels do not stand across their motion")
            .chapter("05b-corrected-single-body")
            .code(&[
                "src/model/equations.rs",
                "src/model/constraints.rs",
                "src/effects/catalogue.toml",
                "src/claims/generated/moving.rs",
            ])
            .tests(&["tests/mechanism/effects.rs", "tests/motion/kinematics.rs", "tests/claims/generated.rs"])
            .sample(
                "generated twists and trailer rates of unicycles, differential drives and cars with up to five trailers, \
                 every wheel of its own radius and fixed at its own angle: coefficients from velocities of the contacts, \
                 put into the model as effects, through the compiled equations",
                &[
                    ("e_rc", "1 - (v_l*cos(mu) + v_t*sin(mu))/(r*omega)"),
                    ("e_right", "1 - ((v_l + a*yaw/2)*cos(mu_1) + v_t*sin(mu_1))/(r_1*omega_1)"),
                    ("e_left", "1 - ((v_l - a*yaw/2)*cos(mu_2) + v_t*sin(mu_2))/(r_2*omega_2)"),
                    ("e_tc", "tan(atan(v_t/v_l) - mu)"),
                    ("e_front", "tan(atan((v_t + L*yaw)/v_l) - delta)"),
                    ("e_trailer", "w_i/v_i"),
                ],
                |s, sampling| sampling.cases(motions(), Motion::shown, |m| round(s, m)),
            )
            .sample(
                "generated vehicles in any motion, exactly, with up to three more wheels anywhere at any heading, castors, and \
                 up to ten trailers: the coefficients of velocities, radius and rate of each contact make every row vanish",
                &[("e_rc", "1 - v_l/(r*omega)"), ("e_tc", "v_t/v_l")],
                |s, sampling| sampling.cases(moving(3, 10), Moving::shown, |m| vanish(s, m)),
            ),
    ]
}

/// A motion of a vehicle in a configuration.
#[derive(Clone, Debug)]
struct Motion {
    vehicle: usize,
    /// Of the wheel, or of the right and the left one.
    radii: [f64; 2],
    /// Track or wheelbase.
    size: f64,
    /// Angles at which the wheels are fixed, in the order of the description.
    mounted: [f64; 3],
    twist: [f64; 3],
    wheels: [f64; 2],
    delta: f64,
    phi: f64,
    /// Bar, hitch, heading behind the one ahead, and rate of each trailer.
    trailers: Vec<(f64, f64, f64, f64)>,
}

const VEHICLES: [&str; 3] = ["unicycle", "differential-drive", "car"];

fn motions() -> impl Strategy<Value = Motion> {
    let trailer = (0.5..2.0f64, -0.3..0.3f64, -0.7..0.7f64, -0.4..0.4f64);
    let twist = [0.5..2.0f64, -0.4..0.4f64, -0.8..0.8f64];
    let wheels = [2.0..8.0f64, 2.0..8.0f64];
    let made = ([0.1..0.5f64, 0.1..0.5f64], 0.3..1.3f64, prop::array::uniform3(-0.6..0.6f64));
    let stands = (-0.4..0.4f64, -3.0..3.0f64);
    (0..VEHICLES.len(), made, twist, wheels, stands, prop::collection::vec(trailer, 0..=5)).prop_map(
        |(vehicle, (radii, size, mounted), twist, wheels, (delta, phi), trailers)| Motion {
            vehicle,
            radii,
            size,
            mounted,
            twist,
            wheels,
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
            (name("vehicle"), VEHICLES[self.vehicle].into()),
            (name("radii, size"), format!("{:?}, {}", self.radii, self.size)),
            (name("mounted at"), format!("{:?}", self.mounted)),
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
        let axle = if self.is_differential() { 2 } else { 0 };
        Some(match name {
            "v_l" => self.twist[0],
            "v_t" => self.twist[1],
            "yaw" => self.twist[2],
            "r" | "r_1" => self.radii[0],
            "r_2" => self.radii[1],
            "a" | "L" => self.size,
            "mu" => self.mounted[axle],
            "mu_1" => self.mounted[0],
            "mu_2" => self.mounted[1],
            "omega" | "omega_1" => self.wheels[0],
            "omega_2" => self.wheels[1],
            "delta" => self.delta,
            _ => return None,
        })
    }

    fn is_differential(&self) -> bool {
        VEHICLES[self.vehicle] == "differential-drive"
    }

    /// The vehicle with its lengths, every wheel that is not steered fixed at its angle.
    fn bare(&self, trailers: &[Trailer], creeps: &[Creep]) -> crate::Result<Model> {
        let (radius, size) = (("wheel_radius", self.radii[0]), self.size);
        let mut model = match VEHICLES[self.vehicle] {
            "differential-drive" => {
                let ratio: Creep = ("wheel-radius-mismatch", None, vec![self.radii[1] / self.radii[0] - 1.0]);
                model("differential-drive", &[radius, ("track_width", size)], trailers, &[creeps, &[ratio]].concat())
            }
            "car" => model("car", &[radius, ("wheelbase", size)], trailers, creeps),
            id => model(id, &[radius], trailers, creeps),
        }?;
        for (i, wheel) in model.vehicle.wheels.iter_mut().enumerate().filter(|(_, w)| w.steering.is_none()) {
            let (angle, given) = (Symbol::new(&format!("mounted_{i}")), format!("mounting_angle_{i}"));
            let formula = Expr::sym(given.as_str());
            let defined = Definition { formula, unit: "rad".into(), meaning: format!("heading of the {}", wheel.name) };
            wheel.steering = Some(angle.clone());
            model.vehicle.define.insert(angle, defined);
            model.parameters.insert(given, self.mounted[i]);
        }
        Ok(model)
    }

    /// The model with the coefficients that a statement gives to this motion.
    fn creeping(&self, s: &Statement) -> Result<Model, Fault> {
        let said = |name: &str| value_said(s, name, &|n| self.value(n));
        let mut creeps: Vec<Creep> = vec![("traverse-creep", None, vec![said("e_tc")?])];
        match VEHICLES[self.vehicle] {
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
        self.bare(&trailers, &creeps).map_err(|e| undefined(&e))
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

/// Puts the coefficients that a statement gives to a motion into the rows.
fn vanish(s: &Statement, m: &Moving) -> Verdict {
    let mut at = m.vehicle.point();
    for contact in m.contacts() {
        for (name, value) in coefficients(s, &contact)? {
            at.set(name, value);
        }
    }
    m.vehicle.mechanism().constraints.iter().try_for_each(|c| {
        let left = c.row().expr().eval(&|name: &Symbol| m.rate(name).unwrap_or_else(|| at.value(name)));
        match left.as_ref().and_then(Exact::as_rational) {
            Some(v) if num_traits::Zero::is_zero(v) => Ok(()),
            Some(v) => Err(Fault::False(format!("the row of {} is {v}", c.name))),
            None => Err(Fault::Undefined(format!("the row of {} has no value", c.name))),
        }
    })
}

/// The coefficients of a contact by name.
fn coefficients(s: &Statement, contact: &Contact) -> Result<Vec<(Symbol, Exact)>, Fault> {
    let rolls = contact.rolls.as_ref();
    let value = |name: &Symbol| match (name.as_str(), rolls) {
        ("v_l", _) => contact.along.clone(),
        ("v_t", _) => contact.across.clone(),
        ("r", Some((radius, ..))) => radius.clone(),
        ("omega", Some((_, rate, _))) => rate.clone(),
        _ => Exact::ratio(0, 0),
    };
    let named = [("e_rc", rolls.map(|(.., e)| e)), ("e_tc", contact.directed.as_ref())];
    let wanted = named.into_iter().filter_map(|(said, name)| Some((said, name?)));
    wanted
        .map(|(said, name)| {
            let formula = s.said_of(said).ok_or_else(|| Fault::Undefined(format!("nothing is said of {said}")))?;
            // A contact that rests, or moves sideways only, has no coefficient.
            Ok((name.clone(), formula.eval(&value).ok_or(Fault::Outside)?))
        })
        .collect()
}
