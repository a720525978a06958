//! The makes of vehicle a case is drawn from, and which effects apply to each.

use crate::simulator::{Parameters, Scenario, Tractor, Vehicle};
use creepage::effects;
use creepage::files::ModelFile;
use creepage::model::{self, Model};
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use std::sync::LazyLock;

/// A vehicle with its sensors.
#[derive(Clone, Copy, Debug)]
pub struct Make {
    /// Name in tables.
    pub name: &'static str,
    /// What pulls.
    pub tractor: Tractor,
    /// How many trailers it pulls.
    pub trailers: usize,
    /// Whether a unicycle logs a speed instead of a wheel rate.
    pub by_speed: bool,
    /// Whether the heading is measured; a GPS has none.
    pub heading: bool,
}

const fn make(name: &'static str, tractor: Tractor, trailers: usize) -> Make {
    Make { name, tractor, trailers, by_speed: false, heading: true }
}

const fn without_heading(make: Make, name: &'static str) -> Make {
    Make { name, heading: false, ..make }
}

/// Every make.
pub const MAKES: [Make; 14] = [
    make("unicycle", Tractor::Unicycle, 0),
    Make { by_speed: true, ..make("unicycle-by-speed", Tractor::Unicycle, 0) },
    without_heading(make("", Tractor::Unicycle, 0), "unicycle-gps"),
    make("differential-drive", Tractor::DifferentialDrive, 0),
    without_heading(make("", Tractor::DifferentialDrive, 0), "differential-drive-gps"),
    make("tricycle", Tractor::Tricycle, 0),
    make("car", Tractor::Car, 0),
    without_heading(make("", Tractor::Car, 0), "car-gps"),
    make("four-wheel-car", Tractor::FourWheelCar, 0),
    make("car-1-trailer", Tractor::Car, 1),
    make("car-2-trailers", Tractor::Car, 2),
    make("unicycle-1-trailer", Tractor::Unicycle, 1),
    make("differential-drive-1-trailer", Tractor::DifferentialDrive, 1),
    make("differential-drive-2-trailers", Tractor::DifferentialDrive, 2),
];

/// An effect of the library by its id, and the trailer it belongs to where it belongs to one.
pub type Target = (&'static str, Option<usize>);

impl Make {
    /// The vehicle with dimensions drawn around the usual ones, m.
    pub fn drawn(&self, random: &mut ChaCha8Rng) -> (Vehicle, Parameters) {
        let mut around = |usual: f64| usual * 2f64.powf(random.random_range(-0.6..0.6));
        let usual = Parameters::usual(self.tractor);
        let parameters = Parameters {
            wheel_radius: around(usual.wheel_radius),
            wheelbase: around(usual.wheelbase),
            track_width: around(usual.track_width),
        };
        let length = match self.tractor {
            Tractor::Unicycle => 1.0,
            Tractor::DifferentialDrive => 0.6,
            _ => 3.2,
        };
        let lengths: Vec<f64> = (0..self.trailers).map(|_| around(length)).collect();
        let hitches = random.random::<bool>();
        let hitch_offsets =
            lengths.iter().map(|l| if hitches { l * random.random_range(0.05..0.3) } else { 0.0 }).collect();
        (self.vehicle(lengths, hitch_offsets), parameters)
    }

    fn vehicle(&self, lengths: Vec<f64>, hitch_offsets: Vec<f64>) -> Vehicle {
        let tractor = self.tractor;
        if self.trailers == 0 { tractor.into() } else { Vehicle::NTrailer { tractor, lengths, hitch_offsets } }
    }

    /// The effects of the library that apply to it and that its sensors could show at all.
    fn targets(&self) -> Vec<Target> {
        let plain = self.vehicle(vec![1.0; self.trailers], vec![0.0; self.trailers]);
        let scenario = Scenario { logs_speed: self.by_speed, logs_heading: self.heading, ..Scenario::new(plain, 0) };
        let file = ModelFile::parse(&scenario.model_toml(), "model.toml", &model::known(effects::all()))
            .expect("the simulator writes model files that are valid");
        let poses = ["time", "x", "y", "heading"];
        let roles = scenario.roles().into_iter().map(|(role, _)| role).filter(|role| !poses.contains(role));
        let roles: Vec<String> = roles.map(String::from).collect();
        let model = Model::from_file(&file, effects::all(), &roles).expect("every make is a vehicle of the library");
        // What is asked for in the place of its limit is made by forces: tests/discovery/forces.rs.
        let first = model.applicable(effects::all()).into_iter().filter(|(e, _)| e.limit.is_none());
        let applicable = first.map(|(e, trailer)| (e.id.as_str(), trailer));
        let simulated = applicable.filter(|(id, _)| super::secret::has_law(id));
        let is_told = |id: &str| (self.heading || !self.is_a_start_heading(id)) && !self.is_shared_with_steering(id);
        simulated.filter(|(id, _)| is_told(id)).collect()
    }

    /// Gravity along the way acts on what the rear axle rolls; a driven front wheel shares it with the steering.
    fn is_shared_with_steering(&self, id: &str) -> bool {
        id == "grade" && self.tractor == Tractor::Tricycle
    }

    /// Without a measured heading these effects are the same as another heading at the start.
    fn is_a_start_heading(&self, id: &str) -> bool {
        id == "heading-misalignment" || (id == "traverse-creep" && !self.tractor.is_steered())
    }
}

/// The targets of every make, in the order of [`MAKES`].
pub static TARGETS: LazyLock<Vec<Vec<Target>>> = LazyLock::new(|| MAKES.iter().map(Make::targets).collect());

/// Every make with every target.
pub static PAIRINGS: LazyLock<Vec<(usize, Target)>> = LazyLock::new(|| {
    TARGETS.iter().enumerate().flat_map(|(m, targets)| targets.iter().map(move |t| (m, *t))).collect()
});

/// Effects that act at once, on the motion and not on what is measured: they can begin and end.
const ACT_AT_ONCE: [&str; 19] = [
    "odometry-yaw-per-speed",
    "odometry-speed-per-yaw",
    "grade",
    "saturating-creep",
    "rotation-creep",
    "wheel-radius",
    "traverse-creep",
    "front-traverse-creep",
    "load-dependent-creep",
    "yaw-rate-bias",
    "yaw-rate-scale",
    "track-width",
    "wheel-radius-mismatch",
    "steering-offset",
    "steering-gain",
    "understeer",
    "wheelbase",
    "drift",
    "side-slope",
];

/// Every make without trailers with every target that can begin and end.
pub static WITHOUT_STATE: LazyLock<Vec<(usize, Target)>> = LazyLock::new(|| {
    let some = PAIRINGS.iter().filter(|(make, (id, _))| MAKES[*make].trailers == 0 && ACT_AT_ONCE.contains(id));
    some.copied().collect()
});
