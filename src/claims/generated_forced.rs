//! Generated vehicles with masses, driven by forces, for claims about their motion.

use crate::dynamics::{Dynamics, Masses, Start, TrailerMass, simulate_dynamics};
use crate::error::{Error, Result};
use crate::formula::Expr;
use crate::model::{Model, Trailer};
use crate::motion::{Formulas, Integrator, Method, Table};
use proptest::prelude::*;

/// A vehicle with masses, torques and a start; a run lasts one second.
#[derive(Clone, Debug)]
pub struct Pushed {
    vehicle: usize,
    trailers: Vec<[f64; 2]>,
    masses: Vec<f64>,
    offset: f64,
    push: [f64; 2],
    speed: f64,
    turn: f64,
    friction: f64,
}

/// Vehicles with their parameters and what drives them.
type Known = (&'static str, &'static [(&'static str, f64)], &'static [&'static str]);
const VEHICLES: [Known; 5] = [
    ("disk", &[("wheel_radius", 0.5)], &["wheel_torque"]),
    ("sleigh", &[("mass", 1.0), ("inertia", 1.0), ("mass_offset", 0.1)], &["force"]),
    ("unicycle", &[("wheel_radius", 0.5)], &["wheel_torque", "yaw_torque"]),
    (
        "differential-drive",
        &[("wheel_radius", 0.4), ("track_width", 0.8)],
        &["wheel_torque_left", "wheel_torque_right"],
    ),
    ("car", &[("wheel_radius", 0.4), ("wheelbase", 1.2)], &["wheel_torque"]),
];

/// Pushed vehicles, with up to two trailers where they can pull.
pub fn pushed() -> impl Strategy<Value = Pushed> {
    let trailers = prop::collection::vec([0.6..1.5f64, -0.2..0.3f64], 0..=2);
    let masses = prop::collection::vec(0.5..2.0f64, 8);
    let numbers = (-0.3..0.3f64, [0.3..1.5f64, -0.5..0.5f64], 0.5..1.5f64, -0.8..0.8f64, 5.0..20.0f64);
    (0..VEHICLES.len(), trailers, masses, numbers).prop_map(
        |(vehicle, trailers, masses, (offset, push, speed, turn, friction))| Pushed {
            vehicle,
            trailers: if vehicle < 2 { vec![] } else { trailers },
            masses,
            offset,
            push,
            speed,
            turn,
            friction,
        },
    )
}

/// What became of the energy in a run, J.
pub struct Energies {
    /// At the end, less that at the start.
    pub gained: f64,
    /// Done by the inputs.
    pub work: f64,
    /// Done by friction: negative.
    pub friction: f64,
}

impl Pushed {
    /// What it is, for people.
    pub fn shown(&self) -> Vec<(String, String)> {
        let line = |name: &str, text: String| (name.to_string(), text);
        vec![
            line("vehicle", VEHICLES[self.vehicle].0.into()),
            line("trailers", format!("{:?}", self.trailers)),
            line("masses and inertias", format!("{:?}", self.masses)),
            line("centre of mass", self.offset.to_string()),
            line("push", format!("{:?}", self.push)),
            line("speed, turn", format!("{}, {}", self.speed, self.turn)),
            line("friction", self.friction.to_string()),
        ]
    }

    /// The coefficient of its friction.
    pub fn friction(&self) -> f64 {
        self.friction
    }

    /// It with viscous friction in every contact, or with ideal ones.
    pub fn dynamics(&self, friction: Option<f64>) -> Result<Dynamics> {
        let (vehicle, parameters, forces) = VEHICLES[self.vehicle];
        let trailers: Vec<Trailer> =
            self.trailers.iter().map(|[length, hitch]| Trailer { length: *length, hitch: *hitch }).collect();
        let model = Model::new(vehicle, parameters)?.with_trailers(&trailers);
        let rates = ["theta'", "theta_1'", "theta_2'"];
        let trailer = |i: usize| TrailerMass {
            mass: self.masses[4 + i],
            inertia: self.masses[6 + i],
            mass_offset: self.offset / 2.0,
        };
        let masses = Masses {
            mass: self.masses[0],
            inertia: self.masses[1],
            mass_offset: self.offset,
            wheels: rates.iter().map(|r| ((*r).into(), self.masses[2] / 5.0)).collect(),
            trailers: (0..self.trailers.len()).map(trailer).collect(),
            ..Masses::default()
        };
        let dynamics = Dynamics::new(&model, &masses)?.driven_by(forces)?;
        friction.map_or(Ok(dynamics.clone()), |b| dynamics.with_laws("viscous", &[b]))
    }

    /// The run, begun without slip.
    pub fn run(&self, friction: Option<f64>, times: &[f64]) -> Result<Table> {
        let dynamics = self.dynamics(friction)?;
        let channels = dynamics.inputs().len();
        let texts = ["c_0 + c_1*sin(2*t)", "c_0/2 - c_1*cos(3*t)"];
        let steering = dynamics.inputs().iter().any(|i| i == "steering_angle");
        let text = |i: usize| if steering && i + 1 == channels { "c_2/2 + c_1*sin(t)/4" } else { texts[i % 2] };
        let formulas: Vec<Expr> = (0..channels).map(|i| Expr::parse(text(i))).collect::<Result<_>>()?;
        let constants = [("c_0".into(), self.push[0]), ("c_1".into(), self.push[1]), ("c_2".into(), self.turn)];
        let free = ["sleigh", "unicycle"].contains(&VEHICLES[self.vehicle].0);
        let start = Start {
            pose: vec![0.1; 3 + self.trailers.len()],
            speed: self.speed,
            yaw_rate: free.then_some(self.turn),
            ..Start::default()
        };
        let method = if friction.is_some() { Method::Radau5 } else { Method::Dop853 };
        let by = Integrator { method, ..Integrator::default() };
        simulate_dynamics(&dynamics, &Formulas::new(&formulas, &constants)?, times, &start, &by)
    }

    /// The energies of a run with its friction.
    pub fn energies(&self) -> Result<Energies> {
        const STEPS: u32 = 200;
        let times: Vec<f64> = (0..=STEPS).map(|i| f64::from(i) / f64::from(STEPS)).collect();
        let run = self.run(Some(self.friction), &times)?;
        let column = |name: &str| run.column(name).ok_or_else(|| Error::run(format!("the run has no {name}")));
        let energy = column("energy")?;
        Ok(Energies {
            gained: energy[energy.len() - 1] - energy[0],
            work: simpson(column("input_power")?, 1.0 / f64::from(STEPS)),
            friction: simpson(column("friction_power")?, 1.0 / f64::from(STEPS)),
        })
    }
}

/// Simpson's rule over an even number of steps.
fn simpson(y: &[f64], step: f64) -> f64 {
    let inner = |i: usize| if i % 2 == 1 { 4.0 } else { 2.0 };
    let weight = |i: usize| if i == 0 || i + 1 == y.len() { 1.0 } else { inner(i) };
    y.iter().enumerate().map(|(i, y)| weight(i) * y).sum::<f64>() * step / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sleigh() -> Pushed {
        Pushed {
            vehicle: 1,
            trailers: vec![],
            masses: vec![1.0; 8],
            offset: 0.25,
            push: [0.5, -0.125],
            speed: 1.5,
            turn: -0.75,
            friction: 12.0,
        }
    }

    #[test]
    fn a_case_is_shown_with_all_its_numbers() {
        let shown = sleigh().shown();
        let said = |name: &str| shown.iter().find(|(n, _)| n == name).map(|(_, text)| text.as_str());
        assert_eq!((said("vehicle"), said("trailers")), (Some("sleigh"), Some("[]")));
        assert_eq!((said("centre of mass"), said("push")), (Some("0.25"), Some("[0.5, -0.125]")));
        assert_eq!((said("speed, turn"), said("friction")), (Some("1.5, -0.75"), Some("12")));
        assert_eq!(shown.len(), 7);
    }

    /// ∫ x³ from 0 to 2 is 4: Simpson's rule is exact for cubics.
    #[test]
    fn simpson_is_exact_for_cubics() {
        let y: Vec<f64> = (0..=4).map(|i| (0.5 * f64::from(i)).powi(3)).collect();
        assert!((simpson(&y, 0.5) - 4.0).abs() < 1e-14);
    }

    /// What a run gains is what the inputs give and friction leaves, and a run begins as it is told.
    #[test]
    fn a_run_begins_as_it_is_told_and_its_energies_add_up() {
        let run = sleigh().run(None, &[0.0, 0.5]).unwrap();
        let first = |name: &str| run.column(name).unwrap()[0];
        let begins = [("x", 0.1), ("y", 0.1), ("heading", 0.1), ("speed", 1.5), ("yaw_rate", -0.75)];
        assert!(begins.iter().all(|(name, told)| (first(name) - told).abs() < 1e-12), "{run:?}");
        let e = sleigh().energies().unwrap();
        assert!((e.gained - e.work - e.friction).abs() < 1e-8, "{} {} {}", e.gained, e.work, e.friction);
        assert!(e.work > 0.1 && e.friction < -0.05, "{} {}", e.work, e.friction);
    }
}
