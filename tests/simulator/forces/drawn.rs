//! Makes of machines with dimensions drawn around usual ones, and the model files of users who know them.

use super::machine::{Contact, Grip, Hitch, Law, Machine, Solid, Wheel};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use std::f64::consts::TAU;

/// A make of machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Make {
    /// A blade that force and torque push.
    Sleigh,
    /// One wheel, driven and turned.
    Wheel,
    /// Two wheels driven by torques.
    DifferentialDrive,
    /// A rear-driven car with side forces by slip angle.
    Car,
    /// A rear-driven car with viscous tyres that pulls two trailers.
    Train,
    /// Four driven wheels that do not steer.
    SkidSteer,
}

/// Every make.
pub const MAKES: [Make; 6] =
    [Make::Sleigh, Make::Wheel, Make::DifferentialDrive, Make::Car, Make::Train, Make::SkidSteer];

/// A machine with its model file and how it is driven.
pub struct Drawn {
    pub machine: Machine,
    /// The model file, without a section for the initial pose.
    pub model: String,
    /// Roles of the inputs.
    pub roles: Vec<&'static str>,
    /// The usual size of each input.
    pub sizes: Vec<f64>,
    /// The speed to begin with, m/s.
    pub speed: f64,
    /// Standard deviations of position, m, and headings, rad.
    pub noise: [f64; 2],
}

/// A number for a model file: what the machine has is what the file says.
fn rounded(value: f64) -> f64 {
    format!("{value:.3}").parse().unwrap_or(value)
}

fn solid(mass: f64, inertia: f64, ahead: f64) -> Solid {
    Solid { mass: rounded(mass), inertia: rounded(inertia), centre: [rounded(ahead), 0.0] }
}

fn wheel(radius: f64, inertia: f64, input: usize) -> Wheel {
    Wheel {
        radius: rounded(radius),
        inertia: rounded(inertia),
        input: Some(input),
        gain: 1.0,
        viscous: 0.0,
        coulomb: 0.0,
        play: 0.0,
    }
}

fn viscous(b: f64) -> Grip {
    Grip::of(Law::Viscous(rounded(b)))
}

fn law(grip: Grip) -> String {
    match grip.law {
        Law::Ideal => "{ law = \"ideal\" }".into(),
        Law::Viscous(b) => format!("{{ law = \"viscous\", coefficient = {b:?} }}"),
        Law::Rocard(k) => format!("{{ law = \"rocard\", stiffness = {k:?} }}"),
    }
}

impl Make {
    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sleigh => "sleigh",
            Self::Wheel => "wheel",
            Self::DifferentialDrive => "differential-drive",
            Self::Car => "car",
            Self::Train => "car-2-trailers",
            Self::SkidSteer => "skid-steer",
        }
    }

    /// Dimensions drawn around usual ones.
    pub fn drawn(self, random: &mut ChaCha8Rng) -> Drawn {
        match self {
            Self::Sleigh => sleigh(random),
            Self::Wheel => one_wheel(random),
            Self::DifferentialDrive => differential_drive(random),
            Self::Car => car(random),
            Self::Train => train(random),
            Self::SkidSteer => skid_steer(random),
        }
    }
}

/// About a number: between two thirds of it and one and a half.
fn about(random: &mut ChaCha8Rng, usual: f64) -> f64 {
    usual * 2f64.powf(random.random_range(-0.58..0.58))
}

/// The masses of a body on wheels as the section of a model file.
fn weights(body: &Solid, wheel: &Wheel) -> String {
    format!(
        "[dynamics]\nmass = {:?}\ninertia = {:?}\nmass_offset = {:?}\nwheel_inertia = {:?}\n",
        body.mass, body.inertia, body.centre[0], wheel.inertia
    )
}

fn sleigh(random: &mut ChaCha8Rng) -> Drawn {
    let (mass, radius) = (about(random, 20.0), about(random, 0.35));
    let body = solid(mass, mass * radius * radius, random.random_range(0.1..0.3));
    let side = match random.random() {
        true => Grip::of(Law::Ideal),
        false => viscous(about(random, 6.0) * mass),
    };
    let blade = Contact { body: 0, at: [0.0; 2], steered: None, rolls: None, side: Some(side) };
    let mut machine = Machine::of(vec![body], vec![], vec![blade], vec![]);
    machine.pushes = [Some(0), None, Some(1)];
    // A runner on ice is braked a little.
    let model = format!(
        "vehicle = \"sleigh\"\n[parameters]\nmass = {:?}\ninertia = {:?}\nmass_offset = {:?}\n[dynamics]\n\
         inputs = [\"force\", \"yaw_torque\"]\n[dynamics.friction]\ndirection = {}\n",
        body.mass,
        body.inertia,
        body.centre[0],
        law(side)
    );
    let (force, torque) = (0.5 * body.mass, 0.4 * body.inertia);
    Drawn {
        machine,
        model,
        roles: vec!["force", "yaw_torque"],
        sizes: vec![force, torque],
        speed: 1.5,
        noise: [0.003, 0.002],
    }
}

fn one_wheel(random: &mut ChaCha8Rng) -> Drawn {
    let (mass, radius) = (about(random, 30.0), about(random, 0.3));
    let body = solid(mass, mass * 0.1, 0.0);
    let (roll, side) = (viscous(about(random, 10.0) * mass), viscous(about(random, 6.0) * mass));
    let wheel = wheel(radius, 0.1 * mass * radius * radius, 0);
    let contact = Contact { body: 0, at: [0.0; 2], steered: None, rolls: Some((0, roll)), side: Some(side) };
    let mut machine = Machine::of(vec![body], vec![wheel], vec![contact], vec![]);
    machine.pushes = [None, None, Some(1)];
    let model = format!(
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = {:?}\n{}inputs = [\"wheel_torque\", \"yaw_torque\"]\n[dynamics.friction]\nrolling = {}\n\
         direction = {}\n",
        wheel.radius,
        weights(&body, &wheel),
        law(roll),
        law(side)
    );
    let sizes = vec![0.5 * body.mass * wheel.radius, 0.4 * body.inertia];
    Drawn { machine, model, roles: vec!["wheel_torque", "yaw_torque"], sizes, speed: 1.5, noise: [0.003, 0.002] }
}

fn differential_drive(random: &mut ChaCha8Rng) -> Drawn {
    let (mass, radius, track) = (about(random, 20.0), about(random, 0.1), rounded(about(random, 0.5)));
    let body = solid(mass, mass * track * track / 4.0, random.random_range(-0.1..0.15));
    let (roll, side) = (viscous(about(random, 10.0) * mass), viscous(about(random, 7.0) * mass));
    let spin = 0.05 * mass * radius * radius;
    let wheels = vec![wheel(radius, spin, 1), wheel(radius, spin, 0)];
    let touch =
        |left: f64, i: usize| Contact { body: 0, at: [0.0, left], steered: None, rolls: Some((i, roll)), side: None };
    let axle = Contact { body: 0, at: [0.0; 2], steered: None, rolls: None, side: Some(side) };
    let contacts = vec![touch(-track / 2.0, 0), touch(track / 2.0, 1), axle];
    let machine = Machine::of(vec![body], wheels.clone(), contacts, vec![]);
    let model = format!(
        "vehicle = \"differential-drive\"\n[parameters]\nwheel_radius = {:?}\ntrack_width = {track:?}\n{}inputs = [\"wheel_torque_left\", \"wheel_torque_right\"]\n[dynamics.friction]\nrolling = {}\ndirection = {}\n",
        wheels[0].radius,
        weights(&body, &wheels[0]),
        law(roll),
        law(side)
    );
    let size = 0.15 * body.mass * wheels[0].radius;
    let roles = vec!["wheel_torque_left", "wheel_torque_right"];
    Drawn { machine, model, roles, sizes: vec![size; 2], speed: 1.0, noise: [0.002, 0.002] }
}

struct Chassis {
    body: Solid,
    wheel: Wheel,
    base: f64,
    contacts: Vec<Contact>,
    friction: String,
}

fn chassis(random: &mut ChaCha8Rng, side: impl Fn(&mut ChaCha8Rng, f64) -> Grip) -> Chassis {
    let (mass, base) = (about(random, 1200.0), rounded(about(random, 2.6)));
    let body = solid(mass, mass * base * base / 4.5, base * random.random_range(0.35..0.55));
    let (rear, front) = (side(random, mass), side(random, mass));
    let roll = viscous(about(random, 12.0) * mass);
    let radius = about(random, 0.3);
    let wheel = wheel(radius, 0.02 * mass * radius * radius, 0);
    let contacts = vec![
        Contact { body: 0, at: [0.0; 2], steered: None, rolls: Some((0, roll)), side: Some(rear) },
        Contact { body: 0, at: [base, 0.0], steered: Some(1), rolls: None, side: Some(front) },
    ];
    let friction = format!(
        "[dynamics.friction]\nrolling = {}\nrear-axle-direction = {}\nfront-axle-direction = {}\n",
        law(roll),
        law(rear),
        law(front)
    );
    Chassis { body, wheel, base, contacts, friction }
}

fn car(random: &mut ChaCha8Rng) -> Drawn {
    let Chassis { body, wheel, base, contacts, friction } =
        chassis(random, |random, mass| Grip::of(Law::Rocard(rounded(about(random, 45.0) * mass))));
    let model = format!(
        "vehicle = \"car\"\n[parameters]\nwheel_radius = {:?}\nwheelbase = {base:?}\n{}inputs = [\"wheel_torque\"]\n{friction}",
        wheel.radius,
        weights(&body, &wheel)
    );
    let machine = Machine::of(vec![body], vec![wheel], contacts, vec![]);
    let sizes = vec![0.5 * body.mass * wheel.radius, 0.06];
    Drawn { machine, model, roles: vec!["wheel_torque", "steering_angle"], sizes, speed: 7.0, noise: [0.01, 0.002] }
}

fn train(random: &mut ChaCha8Rng) -> Drawn {
    let Chassis { body, wheel, base, mut contacts, friction } =
        chassis(random, |random, mass| viscous(about(random, 9.0) * mass));
    let mut solids = vec![body];
    let (mut lengths, mut hitches) = (vec![], vec![]);
    let side = viscous(about(random, 5.0) * body.mass);
    for i in 0..2 {
        let length = rounded(about(random, 2.5));
        let behind = rounded(random.random_range(0.1..0.6));
        let mass = about(random, 500.0);
        solids.push(solid(mass, mass * length * length / 6.0, random.random_range(0.0..0.4)));
        hitches.push(Hitch { front: i, behind, length });
        lengths.push(length);
        contacts.push(Contact { body: i + 1, at: [0.0; 2], steered: None, rolls: None, side: Some(side) });
    }
    let each = |f: &dyn Fn(usize) -> f64| format!("[{:?}, {:?}]", f(0), f(1));
    let model = format!(
        "vehicle = \"n-trailer\"\ntractor = \"car\"\n[parameters]\nwheel_radius = {:?}\nwheelbase = {base:?}\n\
         trailer_lengths = {}\nhitch_offsets = {}\n[columns]\ntrailer_headings = [\"trailer_1\", \"trailer_2\"]\n{}trailer_masses = {}\n\
         trailer_inertias = {}\ntrailer_mass_offsets = {}\ninputs = [\"wheel_torque\"]\n{friction}\
         trailer-1-direction = {}\ntrailer-2-direction = {}\n",
        wheel.radius,
        each(&|i| lengths[i]),
        each(&|i| hitches[i].behind),
        weights(&body, &wheel),
        each(&|i| solids[i + 1].mass),
        each(&|i| solids[i + 1].inertia),
        each(&|i| solids[i + 1].centre[0]),
        law(side),
        law(side)
    );
    let sizes = vec![0.4 * (body.mass + 1000.0) * wheel.radius, 0.08];
    let machine = Machine::of(solids, vec![wheel], contacts, hitches);
    Drawn { machine, model, roles: vec!["wheel_torque", "steering_angle"], sizes, speed: 6.0, noise: [0.01, 0.002] }
}

fn skid_steer(random: &mut ChaCha8Rng) -> Drawn {
    let (mass, radius) = (about(random, 50.0), about(random, 0.15));
    let (track, base) = (rounded(about(random, 0.6)), rounded(about(random, 0.5)));
    let body = solid(mass, mass * (track * track + base * base) / 8.0, random.random_range(-0.05..0.05));
    let (roll, side) = (viscous(about(random, 6.0) * mass), viscous(about(random, 2.0) * mass));
    let spin = 0.03 * mass * radius * radius;
    let mut contacts = Vec::new();
    for (i, [ahead, left]) in [[1.0, -1.0], [1.0, 1.0], [-1.0, -1.0], [-1.0, 1.0]].into_iter().enumerate() {
        let at = [ahead * base / 2.0, left * track / 2.0];
        contacts.push(Contact { body: 0, at, steered: None, rolls: Some((i, roll)), side: None });
    }
    for ahead in [1.0, -1.0] {
        let at = [ahead * base / 2.0, 0.0];
        contacts.push(Contact { body: 0, at, steered: None, rolls: None, side: Some(side) });
    }
    let wheels: Vec<Wheel> = (0..4).map(|i| wheel(radius, spin, i)).collect();
    let roles = vec![
        "wheel_torque_front_right",
        "wheel_torque_front_left",
        "wheel_torque_rear_right",
        "wheel_torque_rear_left",
    ];
    let model = format!(
        "vehicle = \"skid-steer\"\n[parameters]\nwheel_radius = {:?}\ntrack_width = {track:?}\nwheelbase = {base:?}\n\
         {}inputs = {roles:?}\n\
         [dynamics.friction]\nrolling = {}\ndirection = {}\n",
        wheels[0].radius,
        weights(&body, &wheels[0]),
        law(roll),
        law(side)
    );
    let size = 0.2 * body.mass * wheels[0].radius;
    let machine = Machine::of(vec![body], wheels, contacts, vec![]);
    Drawn { machine, model, roles, sizes: vec![size; 4], speed: 0.8, noise: [0.003, 0.002] }
}

/// An input as a sum of slow sinusoids: values and rates.
#[derive(Clone, Debug)]
pub struct Wave(Vec<[f64; 3]>);

impl Wave {
    /// Of a usual size.
    pub fn drawn(random: &mut ChaCha8Rng, size: f64) -> Self {
        let one = |_| {
            let frequency = random.random_range(0.03..0.3);
            [size * random.random_range(0.3..0.7), TAU * frequency, random.random_range(0.0..TAU)]
        };
        Self((0..5).map(one).collect())
    }

    /// Value and rate.
    pub fn at(&self, t: f64) -> [f64; 2] {
        let add =
            |sum: [f64; 2], [a, w, p]: &[f64; 3]| [sum[0] + a * (w * t + p).sin(), sum[1] + a * w * (w * t + p).cos()];
        self.0.iter().fold([0.0; 2], add)
    }
}
