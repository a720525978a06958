//! Targets that are parameters: controllers of ROS 2, a VESC driver, constants of WPILib, JSON.

use super::corrections::{Corrections, lines_of_the_rest, origin, rounded, written};
use super::exported::Exported;
use crate::error::{Error, Result};
use crate::files::ModelFile;
use serde_json::json;
use std::fmt::Write;

/// A target that is a list of parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// ROS 2's `diff_drive_controller`.
    Ros2DiffDrive,
    /// ROS 2's steering controllers.
    Ros2Steering,
    /// Gains and offsets of a VESC driver.
    Vesc,
    /// Constants for WPILib.
    Wpilib,
    /// Numbers for programs.
    Json,
}

/// The gains that a VESC driver has now; one that is not given stands in the text as a factor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gains {
    /// `speed_to_erpm_gain`.
    pub speed_to_erpm: Option<f64>,
    /// `steering_angle_to_servo_gain`.
    pub angle_to_servo: Option<f64>,
    /// `steering_angle_to_servo_offset`.
    pub servo_offset: Option<f64>,
}

impl Target {
    /// The parameters of the controller of ROS 2 that drives the model's vehicle.
    ///
    /// # Errors
    /// When none drives it.
    pub fn of_ros2(file: &ModelFile) -> Result<Exported> {
        let of = |target: Self| target.export(file, Gains::default());
        of(Self::Ros2DiffDrive).or_else(|_| of(Self::Ros2Steering))
    }

    /// A model's parameters for this target.
    ///
    /// # Errors
    /// When the model's vehicle is none that the target drives.
    pub fn export(self, file: &ModelFile, gains: Gains) -> Result<Exported> {
        let found = Corrections::of(file);
        let of = Parameters { file, found: &found, gains };
        match self {
            Self::Ros2DiffDrive => of.diff_drive(),
            Self::Ros2Steering => of.steering(),
            Self::Vesc => of.vesc(),
            Self::Wpilib => of.wpilib(),
            Self::Json => of.json(),
        }
    }
}

struct Parameters<'a> {
    file: &'a ModelFile,
    found: &'a Corrections,
    gains: Gains,
}

impl Parameters<'_> {
    fn parameter(&self, name: &str, target: &str) -> Result<f64> {
        self.file.parameters.get(name).copied().ok_or_else(|| {
            let vehicle = &self.file.vehicle;
            Error::input(format!("{target} takes a vehicle with a {name}, and {vehicle} has none"))
                .at_file(&self.file.path)
                .help("see the targets in `creepage export --help`")
        })
    }

    /// That the model's vehicle is one that the target drives.
    fn drives(&self, vehicles: &[&str], target: &str) -> Result<()> {
        match vehicles.contains(&self.file.vehicle.as_str()) {
            true => Ok(()),
            false => Err(Error::input(format!(
                "{target} drives {}, the model is a {}",
                vehicles.join(", "),
                self.file.vehicle
            ))
            .at_file(&self.file.path)
            .help("see the targets in `creepage export --help`")),
        }
    }

    fn head(&self, comment: &str) -> String {
        format!("{comment} {}\n", origin(self.file))
    }

    /// What has no place in a target, as comments, and by name.
    fn rest(&self, text: &mut String, comment: &str, also: &[String]) -> Vec<String> {
        let (lines, unsaid) = lines_of_the_rest(self.found, also, true);
        lines.iter().for_each(|line| text.push_str(&format!("{comment} {line}\n")));
        unsaid
    }

    fn diff_drive(&self) -> Result<Exported> {
        self.drives(&["differential-drive", "differential-drive-castor"], "ros2-diff-drive")?;
        let (radius, track) =
            (self.parameter("wheel_radius", "ros2-diff-drive")?, self.parameter("track_width", "ros2-diff-drive")?);
        let mut text = self.head("#");
        let _ = write!(
            text,
            "diff_drive_controller:\n  ros__parameters:\n    wheel_separation: {}\n    wheel_radius: {}\n    \
             wheel_separation_multiplier: {}\n    left_wheel_radius_multiplier: {}\n    right_wheel_radius_multiplier: {}\n",
            real(track),
            real(radius),
            real(self.found.separation),
            real(self.found.left),
            real(self.found.right)
        );
        let unsaid = self.rest(&mut text, "#", &[]);
        Ok(Exported { text, unsaid })
    }

    fn steering(&self) -> Result<Exported> {
        self.drives(&["car", "four-wheel-car", "tricycle"], "ros2-steering")?;
        let (radius, base) =
            (self.parameter("wheel_radius", "ros2-steering")?, self.parameter("wheelbase", "ros2-steering")?);
        let (radius, base) = (radius * self.found.left, base * self.found.base);
        let mut text = self.head("#");
        let track = self.file.parameters.get("track_width").map(|track| track * self.found.separation);
        match (self.file.vehicle.as_str(), track) {
            ("tricycle", _) => {
                let _ = write!(
                    text,
                    "tricycle_controller:\n  ros__parameters:\n    wheelbase: {}\n    wheel_radius: {}\n",
                    real(base),
                    real(radius)
                );
            }
            (_, Some(track)) => {
                let _ = write!(
                    text,
                    "ackermann_steering_controller:\n  ros__parameters:\n    wheelbase: {}\n    traction_track_width: {}\n    \
                     steering_track_width: {}\n    traction_wheels_radius: {}\n",
                    real(base),
                    real(track),
                    real(track),
                    real(radius)
                );
            }
            _ => {
                let _ = write!(
                    text,
                    "bicycle_steering_controller:\n  ros__parameters:\n    wheelbase: {}\n    traction_wheel_radius: {}\n",
                    real(base),
                    real(radius)
                );
            }
        }
        let [gain, offset] = self.found.steering;
        let mut also = vec![];
        if self.found.steering != [1.0, 0.0] {
            also.push(format!("true steering angle = {gain}*commanded + {offset} rad: put it into the steering joint"));
        }
        let unsaid = self.rest(&mut text, "#", &also);
        Ok(Exported { text, unsaid })
    }

    fn vesc(&self) -> Result<Exported> {
        self.drives(&["car", "four-wheel-car", "tricycle"], "vesc")?;
        let base = self.parameter("wheelbase", "vesc")? * self.found.base;
        let mut text = self.head("#");
        let ([gain, offset], speed) = (self.found.steering, self.found.left);
        text.push_str("# commands are corrected: the vehicle then does what it is told\n");
        // v = k·v_logged: for a speed that is wanted the motor turns 1/k as fast.
        let mut line = |name: &str, value: Option<f64>, otherwise: String| {
            let _ = match value {
                Some(value) => writeln!(text, "{name}: {}", real(value)),
                None => writeln!(text, "# {name}: {otherwise}"),
            };
        };
        line(
            "speed_to_erpm_gain",
            self.gains.speed_to_erpm.map(|g| g / speed),
            format!("the one you have, times {}", 1.0 / speed),
        );
        let servo = self.gains.angle_to_servo.map(|g| g / gain);
        line("steering_angle_to_servo_gain", servo, format!("the one you have, times {}", 1.0 / gain));
        let moved = self.gains.angle_to_servo.zip(self.gains.servo_offset).map(|(g, o)| o - g * offset / gain);
        let by = format!("the one you have, less {} times the gain you have", offset / gain);
        line("steering_angle_to_servo_offset", moved, by);
        line("wheelbase", Some(base), String::new());
        let unsaid = self.rest(&mut text, "#", &[]);
        Ok(Exported { text, unsaid })
    }

    fn wpilib(&self) -> Result<Exported> {
        self.drives(&["differential-drive", "differential-drive-castor"], "wpilib")?;
        let (radius, track) = (self.parameter("wheel_radius", "wpilib")?, self.parameter("track_width", "wpilib")?);
        let mut text = self.head("//");
        let numbers = [
            ("kTrackwidthMeters", track * self.found.separation),
            ("kLeftWheelRadiusMeters", radius * self.found.left),
            ("kRightWheelRadiusMeters", radius * self.found.right),
        ];
        for (name, value) in numbers {
            let _ = writeln!(text, "public static final double {name} = {};", real(value));
        }
        text.push_str(
            "// new DifferentialDriveKinematics(kTrackwidthMeters); metres per turn: 2*Math.PI*radius of each side\n",
        );
        let unsaid = self.rest(&mut text, "//", &[]);
        Ok(Exported { text, unsaid })
    }

    fn json(&self) -> Result<Exported> {
        let found = self.found;
        let effects: Vec<_> = self
            .file
            .effects
            .iter()
            .map(|e| {
                json!({
                    "id": e.id, "on": e.input, "trailer": e.trailer, "parameters": e.parameters,
                    "scope": e.scope.as_ref().map(ToString::to_string), "says": written(e),
                })
            })
            .collect();
        let whole = json!({
            "schema": 1,
            "vehicle": self.file.vehicle,
            "parameters": self.file.parameters,
            "corrections": {
                "left_wheel_radius_multiplier": found.left, "right_wheel_radius_multiplier": found.right,
                "wheel_separation_multiplier": found.separation, "wheelbase_multiplier": found.base,
                "steering_gain": found.steering[0], "steering_offset": found.steering[1],
                "tracked_frame": { "x": found.place[0], "y": found.place[1], "yaw": found.place[2] },
            },
            "effects": effects,
            "provenance": { "version": env!("CARGO_PKG_VERSION"), "model_sha256": self.file.sha256 },
        });
        Ok(Exported { text: format!("{whole:#}\n"), unsaid: vec![] })
    }
}

/// A number that reads as a real one in YAML and in Java, without the digits that rounding makes.
fn real(v: f64) -> String {
    format!("{:?}", rounded(v))
}
