//! The files that go with a log: the model as its user believes it, and the answer.

use super::scenario::Scenario;
use super::sensor::Mounting;
use super::vehicle::Vehicle;
use serde_json::{Value, json};

impl Scenario {
    /// The model file of a user who knows nothing of what is hidden.
    pub fn model_toml(&self) -> String {
        let mut lines = vec![
            format!("vehicle = \"{}\"", self.vehicle.name()),
            format!("input_timing = \"{}\"", self.timing.name()),
        ];
        lines.push("\n[parameters]".into());
        if let Vehicle::NTrailer { tractor, .. } = self.vehicle {
            lines.push(format!("tractor = \"{}\"", tractor.name()));
        }
        let listed = self.parameters.listed(self.vehicle.tractor());
        lines.extend(
            listed
                .iter()
                .map(|(name, value)| format!("{name} = {value:?}")),
        );
        lines.extend(self.trailer_lines());
        lines.push("\n[columns]".into());
        lines.extend(
            self.roles()
                .iter()
                .map(|(role, column)| format!("{role} = \"{column}\"")),
        );
        if self.vehicle.trailers() > 0 {
            lines.push(format!("trailer_headings = {:?}", self.trailer_columns()));
        }
        if self.mounting != Mounting::default() {
            lines.push("\n[sensor]".into());
            lines.push(format!("lever_arm = {:?}", self.mounting.lever_arm));
            lines.push(format!(
                "heading_offset = {:?}",
                self.mounting.heading_offset
            ));
        }
        lines.join("\n") + "\n"
    }

    fn trailer_lines(&self) -> Vec<String> {
        match &self.vehicle {
            Vehicle::Alone(_) => vec![],
            Vehicle::NTrailer {
                lengths,
                hitch_offsets,
                ..
            } => {
                let mut lines = vec![format!("trailer_lengths = {lengths:?}")];
                if hitch_offsets.iter().any(|offset| *offset != 0.0) {
                    lines.push(format!("hitch_offsets = {hitch_offsets:?}"));
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
                let parameters: serde_json::Map<_, _> = effect
                    .parameters()
                    .into_iter()
                    .map(|(name, value)| (name.to_string(), json!(value)))
                    .collect();
                effect
                    .id()
                    .map(|id| json!({"id": id, "parameters": parameters}))
            })
            .collect();
        json!({"verdict": verdict, "effects": effects})
    }
}
