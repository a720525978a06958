//! Runs of a sleigh or a car driven by forces whose contacts give way by a hidden law.
//!
//! The equations of motion are the library's own: what is tested with these runs is whether a *kinematic* model that
//! knows nothing of forces, masses and friction names the creep that follows from them.

use creepage::Result;
use creepage::dynamics::{Dynamics, Masses, Start, simulate_dynamics};
use creepage::formula::Expr;
use creepage::model::Model;
use creepage::motion::{Formulas, Integrator, Method, Table};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

/// What is pushed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// 20 kg on a blade below its centre of mass, pushed along its heading and turned by a torque; about 1 m/s.
    Sleigh,
    /// A car of 1000 kg, its rear axle driven by a torque, its front axle steered; about 8 m/s.
    Car,
}

/// A run to be made.
#[derive(Clone, Debug)]
pub struct Forced {
    /// What is pushed.
    pub body: Body,
    /// The law of every direction, with its parameters; the car's driven wheels roll without slip.
    pub law: &'static str,
    /// Its parameters.
    pub values: Vec<f64>,
    /// How long, s.
    pub seconds: f64,
    /// Rows for each second.
    pub hertz: f64,
    /// Scatter of the measured place, m, and heading, rad, one sigma.
    pub noise: [f64; 2],
    /// Everything drawn follows from it.
    pub seed: u64,
}

/// Speed and turning that the push aims at, of one of two kinds of path, as formulas of t.
fn aims(body: Body, seed: u64) -> [&'static str; 2] {
    match (body, seed % 2) {
        (Body::Sleigh, 0) => ["1 + 0.3*sin(0.31*t)", "0.7*sin(0.4*t) + 0.3*sin(0.93*t)"],
        (Body::Sleigh, _) => ["0.9 + 0.35*sin(0.23*t)", "0.5*sin(0.29*t + 1) - 0.5*cos(0.77*t)"],
        (Body::Car, 0) => ["8 + 2*sin(0.21*t)", "0.09*sin(0.4*t) + 0.05*sin(0.93*t)"],
        (Body::Car, _) => ["7 + 2.5*sin(0.17*t)", "0.08*sin(0.29*t + 1) - 0.07*cos(0.77*t)"],
    }
}

impl Forced {
    /// A run of 60 s at 15 Hz with the scatter of a good camera.
    pub fn new(body: Body, law: &'static str, values: &[f64], seed: u64) -> Self {
        Self { body, law, values: values.to_vec(), seconds: 60.0, hertz: 15.0, noise: [0.002, 0.002], seed }
    }

    /// The vehicle with its hidden friction.
    pub fn dynamics(&self) -> Result<Dynamics> {
        let (vehicle, parameters, masses, forces, contacts): (_, &[(&str, f64)], _, &[&str], &[&str]) = match self.body
        {
            Body::Sleigh => (
                "sleigh",
                &[("mass", 20.0), ("inertia", 2.0), ("mass_offset", 0.0)],
                Masses { mass: 20.0, inertia: 2.0, ..Masses::default() },
                &["force", "yaw_torque"],
                &["blade-direction"],
            ),
            Body::Car => (
                "car",
                &[("wheel_radius", 0.3), ("wheelbase", 2.6)],
                Masses {
                    mass: 1000.0,
                    inertia: 1400.0,
                    mass_offset: 1.2,
                    wheels: [("theta'".into(), 2.0)].into(),
                    ..Masses::default()
                },
                &["wheel_torque"],
                &["rear-axle-direction", "front-axle-direction"],
            ),
        };
        let free = Dynamics::new(&Model::new(vehicle, parameters)?, &masses)?.driven_by(forces)?;
        contacts.iter().try_fold(free, |d, contact| d.with_law(contact, self.law, &self.values))
    }

    /// Forces that lead about where the aims are: what inertia asks for, and what a turning sleigh loses by creeping.
    fn push(&self) -> Result<Vec<Expr>> {
        let [speed, turn] = aims(self.body, self.seed).map(Expr::parse);
        let (speed, turn) = (speed?, turn?);
        let t = "t".into();
        let number = |x: f64| Expr::parse(&format!("{x}"));
        Ok(match self.body {
            Body::Sleigh => {
                let [mass, inertia] = [number(20.0)?, number(2.0)?];
                let lag = match self.law {
                    "viscous" => number(20.0 / self.values[0])?,
                    _ => &number(20.0 / self.values[0])? * &speed,
                };
                let lost = &(&lag * &turn.pow(2)) * &speed;
                vec![&mass * &(&speed.derivative(&t) + &lost), &inertia * &turn.derivative(&t)]
            }
            Body::Car => vec![&number(0.3 * (1000.0 + 2.0 / 0.09))? * &speed.derivative(&t), turn],
        })
    }

    /// The motion as it was, without scatter.
    pub fn truth(&self) -> Result<Table> {
        let rows = (self.seconds * self.hertz) as usize;
        let times: Vec<f64> = (0..=rows).map(|i| i as f64 / self.hertz).collect();
        let at = |formula: &str| Ok::<_, creepage::Error>(Expr::parse(formula)?.eval(&|_| 0.0).unwrap_or(f64::NAN));
        let [speed, turn] = aims(self.body, self.seed);
        let yaw_rate = if self.body == Body::Sleigh { Some(at(turn)?) } else { None };
        let start = Start { pose: vec![0.0; 3], speed: at(speed)?, yaw_rate, ..Start::default() };
        let by = Integrator { method: Method::Radau5, ..Integrator::default() };
        simulate_dynamics(&self.dynamics()?, &Formulas::new(&self.push()?, &[])?, &times, &start, &by)
    }

    /// The log: time, pose with scatter, and the inputs of a kinematic model, as CSV.
    pub fn csv(&self) -> Result<String> {
        let truth = self.truth()?;
        let mut rng = ChaCha8Rng::seed_from_u64(self.seed);
        let scatter = self.noise.map(|sigma| Normal::new(0.0, sigma));
        let names: &[&str] = match self.body {
            Body::Sleigh => &["time", "x", "y", "heading", "speed", "yaw_rate"],
            Body::Car => &["time", "x", "y", "heading", "wheel_rate", "steering_angle"],
        };
        let columns: Vec<&[f64]> = names.iter().filter_map(|n| truth.column(n)).collect();
        let mut text = format!("{}\n", names.join(","));
        for i in 0..truth.rows() {
            let cells: Vec<String> = columns
                .iter()
                .enumerate()
                .map(|(c, column)| {
                    let by = match c {
                        1 | 2 => scatter[0].as_ref().map_or(0.0, |d| d.sample(&mut rng)),
                        3 => scatter[1].as_ref().map_or(0.0, |d| d.sample(&mut rng)),
                        _ => 0.0,
                    };
                    format!("{:.7}", column[i] + by)
                })
                .collect();
            text.push_str(&cells.join(","));
            text.push('\n');
        }
        Ok(text)
    }

    /// The kinematic model of a user who knows nothing of forces.
    pub fn model(&self) -> &'static str {
        match self.body {
            Body::Sleigh => "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n",
            Body::Car => "vehicle = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.6\n",
        }
    }
}
