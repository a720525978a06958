//! The vehicles, their nominal parameters and the columns their inputs are logged under.

use super::profile::Profile;
use super::signal::Signal;

/// A vehicle without trailers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tractor {
    /// One wheel, or any robot logged as speed and yaw rate.
    Unicycle,
    /// Two driven wheels on one axle.
    DifferentialDrive,
    /// The front wheel is driven and steered.
    Tricycle,
    /// Rear driven, one virtual steered wheel in front.
    Car,
    /// Rear driven, two front wheels steered after Ackermann; logged as one virtual angle.
    FourWheelCar,
}

impl Tractor {
    /// The name in a model file.
    pub fn name(self) -> &'static str {
        match self {
            Tractor::Unicycle => "unicycle",
            Tractor::DifferentialDrive => "differential-drive",
            Tractor::Tricycle => "tricycle",
            Tractor::Car => "car",
            Tractor::FourWheelCar => "four-wheel-car",
        }
    }

    /// Whether the yaw rate comes from a steered wheel.
    pub fn is_steered(self) -> bool {
        !matches!(self, Tractor::Unicycle | Tractor::DifferentialDrive)
    }
}

/// A vehicle, with or without trailers.
#[derive(Debug, Clone, PartialEq)]
pub enum Vehicle {
    /// A vehicle that pulls nothing.
    Alone(Tractor),
    /// A tractor and its trailers.
    NTrailer {
        /// What pulls.
        tractor: Tractor,
        /// Hitch to axle of each trailer, m.
        lengths: Vec<f64>,
        /// Hitch behind the axle ahead of it, m, for each trailer.
        hitch_offsets: Vec<f64>,
    },
}

impl Vehicle {
    /// What pulls.
    pub fn tractor(&self) -> Tractor {
        match self {
            Vehicle::Alone(tractor) | Vehicle::NTrailer { tractor, .. } => *tractor,
        }
    }

    /// The number of trailers.
    pub fn trailers(&self) -> usize {
        match self {
            Vehicle::Alone(_) => 0,
            Vehicle::NTrailer { lengths, .. } => lengths.len(),
        }
    }

    /// The name in a model file.
    pub fn name(&self) -> &'static str {
        match self {
            Vehicle::Alone(tractor) => tractor.name(),
            Vehicle::NTrailer { .. } => "n-trailer",
        }
    }
}

impl From<Tractor> for Vehicle {
    fn from(tractor: Tractor) -> Self {
        Vehicle::Alone(tractor)
    }
}

/// The nominal dimensions the user believes in; each vehicle reads its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameters {
    /// Radius of the driven wheels, m.
    pub wheel_radius: f64,
    /// Rear axle to front axle, m.
    pub wheelbase: f64,
    /// Left to right wheel, m.
    pub track_width: f64,
}

impl Parameters {
    /// Dimensions usual for the vehicle.
    pub fn usual(tractor: Tractor) -> Self {
        let (wheel_radius, wheelbase, track_width) = match tractor {
            Tractor::Unicycle => (0.5, f64::NAN, f64::NAN),
            Tractor::DifferentialDrive => (0.1, f64::NAN, 0.4),
            Tractor::Tricycle => (0.2, 1.3, f64::NAN),
            Tractor::Car => (0.3, 2.6, f64::NAN),
            Tractor::FourWheelCar => (0.3, 2.6, 1.5),
        };
        Parameters { wheel_radius, wheelbase, track_width }
    }

    /// The names and values (m) a model file of this vehicle holds.
    pub fn listed(&self, tractor: Tractor) -> Vec<(&'static str, f64)> {
        let all =
            [("wheel_radius", self.wheel_radius), ("wheelbase", self.wheelbase), ("track_width", self.track_width)];
        let used: &[usize] = match tractor {
            Tractor::Unicycle => &[0],
            Tractor::DifferentialDrive => &[0, 2],
            Tractor::Tricycle | Tractor::Car => &[0, 1],
            Tractor::FourWheelCar => &[0, 1, 2],
        };
        used.iter().map(|&i| all[i]).collect()
    }
}

/// One logged input: its role in the model file, its column and its signal.
#[derive(Debug, Clone)]
pub struct Channel {
    /// The role, e.g. `wheel_rate`.
    pub role: &'static str,
    /// The column's name in the CSV, e.g. `theta_dot`.
    pub column: &'static str,
    /// The value over time, in rad/s, m/s or rad.
    pub signal: Signal,
}

/// The two inputs as logged for a profile, by the nominal dimensions; the first drives.
pub fn channels(tractor: Tractor, nominal: &Parameters, profile: &Profile, as_speed: bool) -> [Channel; 2] {
    let Profile { speed, turn } = profile.clone();
    let channel = |role, column, signal| Channel { role, column, signal };
    let radius = nominal.wheel_radius;
    let drive = if as_speed {
        channel("speed", "speed", speed.clone())
    } else {
        channel("wheel_rate", "theta_dot", speed.clone() * (1.0 / radius))
    };
    match tractor {
        Tractor::Unicycle => [drive, channel("yaw_rate", "phi_dot", turn)],
        Tractor::DifferentialDrive => {
            let rim = turn * (0.5 * nominal.track_width);
            let rate = |along: Signal| along * (1.0 / radius);
            let left = rate(speed.clone() + -rim.clone());
            [
                channel("wheel_rate_left", "omega_left", left),
                channel("wheel_rate_right", "omega_right", rate(speed + rim)),
            ]
        }
        Tractor::Tricycle | Tractor::Car | Tractor::FourWheelCar => [drive, channel("steering_angle", "delta", turn)],
    }
}
