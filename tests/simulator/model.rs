//! The files that go with a log: the model as its user believes it, and the answer.

use super::scenario::{Scenario, Timing};
use super::sensor::Mounting;
use super::vehicle::Vehicle;
use serde_json::{Value, json};

impl Scenario {
    /// The model file of a user who knows nothing of what is hidden.
    pub fn model_toml(&self) -> String {
        let mut lines = vec![
            format!("vehicle = \"{}\"", self.vehicle.name()),
            match self.timing {
                Timing::Sample => "input_timing = \"sample\"".into(),
                Timing::IntervalMean => {
                    "input_timing = \"interval-mean\"   # each row: the mean since the row before".into()
                }
            },
        ];
        lines.push("\n[parameters]".into());
        if let Vehicle::NTrailer { tractor, .. } = self.vehicle {
            lines.push(format!("tractor = \"{}\"", tractor.name()));
        }
        for (name, value) in self.parameters.listed(self.vehicle.tractor()) {
            lines.push(format!("{name} = {value:?}   # m"));
        }
        lines.extend(self.trailer_lines());
        lines.push("\n[columns]".into());
        for (role, column) in self.roles() {
            lines.push(format!("{role} = \"{column}\"   # {}", unit(role)));
        }
        if self.vehicle.trailers() > 0 {
            let columns = self.trailer_columns();
            lines.push(format!("trailer_headings = {columns:?}   # rad, absolute"));
        }
        if self.mounting != Mounting::default() {
            let Mounting { lever_arm, heading_offset } = self.mounting;
            lines.push("\n[sensor]".into());
            lines.push(format!("lever_arm = {lever_arm:?}   # m, forward and left"));
            lines.push(format!("heading_offset = {heading_offset:?}   # rad"));
        }
        lines.join("\n") + "\n"
    }

    fn trailer_lines(&self) -> Vec<String> {
        match &self.vehicle {
            Vehicle::Alone(_) => vec![],
            Vehicle::NTrailer { lengths, hitch_offsets, .. } => {
                let mut lines = vec![format!("trailer_lengths = {lengths:?}   # m, hitch to axle")];
                if hitch_offsets.iter().any(|offset| *offset != 0.0) {
                    lines.push(format!("hitch_offsets = {hitch_offsets:?}   # m, behind the axle ahead"));
                }
                lines
            }
        }
    }

    /// The verdict and effects a discovery should come to, as `{"verdict", "effects"}`.
    pub fn answer(&self) -> Value {
        let verdict = match self.hidden.iter().map(|effect| effect.id()).min() {
            None => "no-missing-effect",
            Some(None) => "unnamed-effect",
            Some(Some(_)) => "missing-effect",
        };
        let effects: Vec<Value> = self
            .hidden
            .iter()
            .filter_map(|effect| {
                let parameters: serde_json::Map<_, _> =
                    effect.parameters().into_iter().map(|(name, value)| (name.to_string(), json!(value))).collect();
                effect.id().map(|id| json!({"id": id, "parameters": parameters}))
            })
            .collect();
        json!({"verdict": verdict, "effects": effects})
    }
}

/// The unit of a column by its role.
fn unit(role: &str) -> &'static str {
    match role {
        "time" => "s",
        "x" | "y" => "m",
        "speed" => "m/s",
        "heading" | "steering_angle" => "rad, counter-clockwise",
        "yaw_rate" => "rad/s, counter-clockwise",
        _ => "rad/s",
    }
}
