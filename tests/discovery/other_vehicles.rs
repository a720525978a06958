//! Vehicles beside the usual ones: what is hidden in a simulated run is named, and nothing where nothing is.

use crate::noisy_run::noisy_run;
use creepage::{Model, Report, Run};

const ROWS: usize = 1000;

/// A vehicle: its model file, and its inputs as offset, sizes and frequencies (rad/s) of two waves.
struct Vehicle {
    head: &'static str,
    inputs: &'static [(&'static str, [f64; 5])],
}

const STEERED: Vehicle = Vehicle {
    head: "vehicle = \"four-wheel-steering\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.5\n",
    inputs: &[
        ("wheel_rate", [5.0, 1.5, 0.21, 1.0, 0.57]),
        ("steering_angle", [0.0, 0.25, 0.37, 0.1, 0.83]),
        ("steering_angle_rear", [0.0, 0.12, 0.29, 0.08, 0.71]),
    ],
};
const ACKERMANN: Vehicle = Vehicle {
    head: "vehicle = \"four-wheel-car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.5\ntrack_width = 1.5\n",
    inputs: &[("wheel_rate", [5.0, 1.5, 0.21, 1.0, 0.57]), ("steering_angle", [0.0, 0.3, 0.37, 0.1, 0.83])],
};
const TRACKED: Vehicle = Vehicle {
    head: "vehicle = \"tracked\"\n[parameters]\nwheel_radius = 0.1\ntrack_width = 0.8\nicr_forward_offset = 0.05\nicr_left_offset = -0.02\n",
    inputs: &[("wheel_rate_left", [6.0, 4.0, 0.23, 2.0, 0.61]), ("wheel_rate_right", [6.0, 3.5, 0.37, 2.5, 0.83])],
};
const MECANUM: Vehicle = Vehicle {
    head: "vehicle = \"mecanum\"\n[parameters]\nwheel_radius = 0.05\ntrack_width = 0.4\nwheelbase = 0.3\n",
    inputs: &[
        ("wheel_rate_front_left", [2.0, 5.0, 0.23, 3.0, 0.61]),
        ("wheel_rate_front_right", [2.0, 4.0, 0.37, 4.0, 0.83]),
        ("wheel_rate_rear_left", [2.0, 6.0, 0.29, 2.0, 0.71]),
        ("wheel_rate_rear_right", [2.0, 4.5, 0.41, 3.5, 0.53]),
    ],
};
const OMNI: Vehicle = Vehicle {
    head: "vehicle = \"three-omni\"\nvehicles = \"examples/omni/omni.toml\"\n[parameters]\nwheel_radius = 0.05\ncircle_radius = 0.2\n",
    inputs: &[
        ("wheel_rate_front_right", [3.0, 5.0, 0.23, 3.0, 0.61]),
        ("wheel_rate_front_left", [-3.0, 4.0, 0.37, 4.0, 0.83]),
        ("wheel_rate_rear", [0.0, 6.0, 0.29, 2.0, 0.71]),
    ],
};

impl Vehicle {
    /// The model, with effects in its file or none; read from a folder where relative names lead.
    fn model(&self, hidden: &str) -> Model {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/omni");
        let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
        let text = format!("{}{hidden}", self.head.replace("examples/omni", folder));
        std::fs::write(file.path(), text).unwrap();
        Model::read(file.path()).unwrap()
    }

    /// Fifty seconds of a model that includes what is hidden, with noise.
    fn driven(&self, hidden: &str, noise: f64, seed: u64) -> Run {
        let time: Vec<f64> = (0..ROWS).map(|i| 0.05 * i as f64).collect();
        let column = |[offset, a, p, b, q]: [f64; 5]| -> Vec<f64> {
            time.iter().map(|t| offset + a * (p * t).sin() + b * (q * t + 1.0).cos()).collect()
        };
        let inputs = self.inputs.iter().map(|(role, wave)| (*role, column(*wave))).collect();
        noisy_run(&self.model(hidden), time, inputs, noise, seed)
    }

    fn answer(&self, hidden: &str, seed: u64) -> Report {
        let run = self.driven(hidden, 2e-3, seed);
        creepage::discover(&self.model(""), &[run]).unwrap().report
    }

    /// That one hidden effect is named with its value, and nothing beside it.
    #[track_caller]
    fn names(&self, id: &str, values: &[(&str, f64)]) {
        let lines: String = values.iter().map(|(name, v)| format!("{name} = {v}\n")).collect();
        let report = self.answer(&format!("[[effects]]\nid = \"{id}\"\n{lines}"), 3);
        let found: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
        assert_eq!(found, [id], "{}", report.summary);
        for (name, truth) in values {
            let p = &report.effects[0].parameters[*name];
            assert!((p.value - truth).abs() < 4.0 * p.std.unwrap() && p.std.unwrap() < 0.2 * truth.abs(), "{p:?}");
        }
    }

    #[track_caller]
    fn names_nothing(&self) {
        let report = self.answer("", 4);
        assert!(
            report.effects.is_empty() && report.verdict == creepage::Verdict::NoMissingEffect,
            "{}",
            report.summary
        );
    }
}

#[test]
fn what_both_steered_axles_hide_is_named() {
    STEERED.names("steering-offset", &[("offset", 0.02)]);
    STEERED.names("rotation-creep", &[("e_rc", 0.02)]);
}

#[test]
fn a_car_with_ackermanns_angles_answers_as_a_car() {
    ACKERMANN.names("steering-offset", &[("offset", 0.02)]);
    ACKERMANN.names("lever-arm", &[("a", 0.2), ("b", 0.1)]);
}

#[test]
fn what_tracks_hide_is_named() {
    TRACKED.names("track-width", &[("scale", 0.06)]);
    TRACKED.names("wheel-radius-mismatch", &[("scale", 0.03)]);
}

/// The centres of rotation are not known: the vehicle's own lies elsewhere, as if the sensor did.
#[test]
fn centres_of_rotation_in_another_place_are_a_lever_arm() {
    TRACKED.names("lever-arm", &[("a", 0.08), ("b", -0.05)]);
}

#[test]
fn what_four_mecanum_wheels_hide_is_named() {
    MECANUM.names("track-width", &[("scale", 0.08)]);
    MECANUM.names("lever-arm", &[("a", 0.06), ("b", 0.04)]);
}

#[test]
fn what_three_omni_wheels_hide_is_named() {
    OMNI.names("track-width", &[("scale", 0.05)]);
}

#[test]
fn nothing_is_named_where_nothing_is_hidden() {
    for vehicle in [&STEERED, &ACKERMANN, &TRACKED, &MECANUM, &OMNI] {
        vehicle.names_nothing();
    }
}
