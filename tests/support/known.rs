//! The vehicles and effects of the contract, as far as the tests of files need them.

use creepage::files::{Known, KnownEffect, KnownInput, KnownParameter, KnownVehicle};

fn strings(names: &[&str]) -> Vec<String> {
    names.iter().map(|name| name.to_string()).collect()
}

fn vehicle(id: &str, parameters: &[&str], inputs: &[&str]) -> KnownVehicle {
    let input = |role: &&str| KnownInput {
        role: role.to_string(),
        instead: (id == "unicycle" && *role == "wheel_rate").then(|| "speed".to_string()),
        ..KnownInput::default()
    };
    KnownVehicle {
        id: id.into(),
        parameters: strings(parameters),
        inputs: inputs.iter().map(input).collect(),
        trailers: id == "n-trailer",
        tractor: ["unicycle", "differential-drive", "car"].contains(&id),
        ..KnownVehicle::default()
    }
}

fn effect(id: &str, parameters: &[&str], per_trailer: bool) -> KnownEffect {
    let parameter = |name: &&str| KnownParameter { name: name.to_string(), min: -1.0, max: 1.0 };
    KnownEffect { id: id.into(), parameters: parameters.iter().map(parameter).collect(), per_trailer, per_input: false }
}

/// Vehicles and effects by the names of the contract.
pub fn known() -> Known {
    let mut four_wheels = vehicle("four-wheel-car", &["wheel_radius", "wheelbase"], &["wheel_rate", "steering_angle"]);
    four_wheels.optional_parameters = strings(&["track_width"]);
    Known {
        vehicles: vec![
            vehicle("unicycle", &["wheel_radius"], &["wheel_rate", "yaw_rate"]),
            vehicle("differential-drive", &["wheel_radius", "track_width"], &["wheel_rate_left", "wheel_rate_right"]),
            vehicle("car", &["wheel_radius", "wheelbase"], &["wheel_rate", "steering_angle"]),
            four_wheels,
            vehicle("n-trailer", &[], &[]),
            vehicle("disk", &["wheel_radius"], &["wheel_rate"]),
            vehicle(
                "differential-drive-castor",
                &["wheel_radius", "track_width", "castor_offset", "castor_trail", "castor_wheel_radius"],
                &["wheel_rate_left", "wheel_rate_right"],
            ),
            vehicle("sleigh", &["mass", "inertia", "mass_offset"], &[]),
        ],
        effects: vec![
            effect("rotation-creep", &["e_rc"], false),
            effect("lever-arm", &["a", "b"], false),
            effect("trailer-traverse-creep", &["e_tc"], true),
        ],
        terms: vec![],
    }
}
