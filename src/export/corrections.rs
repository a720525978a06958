//! The corrections that the effects of a model are for the numbers that a controller has.

use crate::files::{EffectEntry, ModelFile};

/// Factors and offsets of a robot's numbers, and the effects that are none.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | `left`, `right` | 1 | what a wheel moves per turn, over what its nominal radius says: (1 + scale)·(1 − e) |
/// | `separation` | 1 | track width over the nominal one |
/// | `base` | 1 | wheelbase over the nominal one |
/// | `steering` | 1, rad | true angle = gain·logged angle + offset |
/// | `place` | m, m, rad | the tracked frame on the body: forward, left, turned |
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Corrections {
    pub left: f64,
    pub right: f64,
    pub separation: f64,
    pub base: f64,
    pub steering: [f64; 2],
    pub place: [f64; 3],
    /// Effects, as the model file has them.
    pub others: Vec<String>,
}

impl Corrections {
    /// The corrections of a model file's effects, in their order.
    pub fn of(file: &ModelFile) -> Self {
        let mut found = Self {
            left: 1.0,
            right: 1.0,
            separation: 1.0,
            base: 1.0,
            steering: [1.0, 0.0],
            place: [file.sensor.lever_arm[0], file.sensor.lever_arm[1], file.sensor.heading_offset],
            others: vec![],
        };
        for entry in &file.effects {
            // What holds in part, or moves, is no number of a controller.
            if entry.scope.is_some() || entry.course.is_some() || !found.take(entry) {
                found.others.push(written(entry));
            }
        }
        found
    }

    /// Takes an effect in, if it is a number that a controller may have.
    fn take(&mut self, entry: &EffectEntry) -> bool {
        let of = |name: &str| entry.parameters.get(name).copied().unwrap_or(0.0);
        match entry.id.as_str() {
            "track-width" => self.separation *= 1.0 + of("scale"),
            "wheel-radius" => self.wheels([1.0 + of("scale"); 2]),
            "rotation-creep" => self.wheels([1.0 - of("e_rc"); 2]),
            "wheel-radius-mismatch" => self.wheels([1.0 + of("scale"), 1.0]),
            "unequal-rotation-creep" => self.wheels([1.0 - of("e_left"), 1.0 - of("e_right")]),
            "wheelbase" => self.base *= 1.0 + of("scale"),
            "steering-gain" => self.steering = self.steering.map(|v| v * (1.0 + of("scale"))),
            "steering-offset" => self.steering[1] += of("offset"),
            "lever-arm" => {
                self.place[0] += of("a");
                self.place[1] += of("b");
            }
            "heading-misalignment" => self.place[2] += of("offset"),
            _ => return false,
        }
        true
    }

    fn wheels(&mut self, [left, right]: [f64; 2]) {
        self.left *= left;
        self.right *= right;
    }

    /// Whether the tracked frame stands on the reference point.
    pub fn is_at_reference(&self) -> bool {
        self.place == [0.0; 3]
    }
}

/// What has no place in a target, and where the tracked frame is unless that is said: lines for comments, and the effects.
pub(super) fn lines_of_the_rest(found: &Corrections, also: &[String], with_place: bool) -> (Vec<String>, Vec<String>) {
    let unsaid: Vec<String> = found.others.iter().chain(also).cloned().collect();
    let mut lines: Vec<String> = unsaid.iter().map(|effect| format!("no place here for {effect}")).collect();
    if with_place && !found.is_at_reference() {
        let [x, y, yaw] = found.place;
        lines.push(format!("the tracked frame on the body: x {x} m, y {y} m, yaw {yaw} rad; in ROS 2"));
        lines.push(format!(
            "ros2 run tf2_ros static_transform_publisher --x {x} --y {y} --yaw {yaw} --frame-id base_link --child-frame-id tracked"
        ));
    }
    (lines, unsaid)
}

/// A number to a billionth of a thousandth: products of a few factors end in digits that mean nothing.
pub(super) fn rounded(v: f64) -> f64 {
    let by_twelve = (v * 1e12).round() / 1e12;
    if by_twelve.is_finite() && v.abs() > 1e-3 { by_twelve } else { v }
}

/// Where a text comes from; no name of a file breaks its line.
pub(super) fn origin(file: &ModelFile) -> String {
    printable(&format!("From {}, by creepage {}.", file.path.display(), env!("CARGO_PKG_VERSION")))
}

fn printable(line: &str) -> String {
    line.chars().map(|c| if c.is_control() { '?' } else { c }).collect()
}

/// An effect in a line, as a model file has it.
pub(super) fn written(entry: &EffectEntry) -> String {
    let on = entry.input.clone().or_else(|| entry.trailer.map(|i| format!("trailer {i}")));
    let on = on.map_or(String::new(), |on| format!(" ({on})"));
    let values: Vec<String> = entry.parameters.iter().map(|(name, v)| format!("{name} = {v}")).collect();
    let scope = entry.scope.as_ref().map_or(String::new(), |s| format!(", {s}"));
    let moving = if entry.course.is_some() { ", moving with time" } else { "" };
    printable(&format!("{}{on}: {}{scope}{moving}", entry.id, values.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects;

    fn of(effects: &str) -> Corrections {
        let head = "vehicle = \"differential-drive\"\n[parameters]\nwheel_radius = 0.1\ntrack_width = 0.4\n";
        let text = format!("{head}[sensor]\nlever_arm = [0.1, 0.0]\n{effects}");
        Corrections::of(&ModelFile::parse(&text, "model.toml", &crate::model::known(effects::all())).unwrap())
    }

    #[test]
    fn effects_on_one_number_are_multiplied() {
        let found =
            of("[[effects]]\nid = \"rotation-creep\"\ne_rc = 0.1\n[[effects]]\nid = \"wheel-radius-mismatch\"\n\
                        scale = 0.02\n[[effects]]\nid = \"lever-arm\"\na = 0.05\nb = -0.02\n\
                        [[effects]]\nid = \"drift\"\nvx = 0.1\nvy = 0.0\n");
        assert_eq!((found.left, found.right), (0.9 * 1.02, 0.9));
        assert!((found.place[0] - 0.15).abs() < 1e-15 && found.place[1] == -0.02 && !found.is_at_reference());
        assert_eq!(found.others, ["drift: vx = 0.1, vy = 0"]);
    }

    #[test]
    fn what_holds_in_part_is_no_number_of_a_controller() {
        let found = of("[[effects]]\nid = \"track-width\"\nscale = 0.1\nscope = { from = 3.0 }\n");
        assert_eq!((found.separation, found.others.len()), (1.0, 1));
    }
}
