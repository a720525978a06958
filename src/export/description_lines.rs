//! The numbers of a robot's description (URDF) that the findings change, as fragments to put in by hand.

use super::corrections::{Corrections, lines_of_the_rest, rounded};
use super::exported::Exported;
use crate::files::ModelFile;
use std::fmt::Write;

/// The fragments of a description that a model's corrections are; `None` where they change none.
///
/// [`patched_description`](super::patched_description) puts them into a given description.
pub fn description_lines(file: &ModelFile) -> Option<Exported> {
    let found = Corrections::of(file);
    let mut text = String::new();
    let of = |name: &str| file.parameters.get(name).copied();
    let mut line = |comment: &str, element: String| _ = writeln!(text, "<!-- {comment} -->\n{element}");
    if let Some(track) = of("track_width").filter(|_| found.separation != 1.0) {
        let half = rounded(0.5 * track * found.separation);
        line(
            "joints of the wheels: y of the left one, and of the right one",
            format!("<origin xyz=\"0 {half} 0\"/>\n<origin xyz=\"0 {} 0\"/>", -half),
        );
    }
    if let Some(base) = of("wheelbase").filter(|_| found.base != 1.0) {
        let base = rounded(base * found.base);
        line("joints of the front wheels: x from the rear axle", format!("<origin xyz=\"{base} 0 0\"/>"));
    }
    if let Some(radius) = of("wheel_radius") {
        let sides = [("left", found.left), ("right", found.right)];
        let alike = found.left == found.right;
        for (side, factor) in sides.into_iter().filter(|(_, factor)| *factor != 1.0) {
            if alike && side == "right" {
                continue;
            }
            let which = if alike { "wheels".to_string() } else { format!("{side} wheel") };
            line(&format!("shape of the {which}"), format!("<cylinder radius=\"{}\"/>", rounded(radius * factor)));
        }
    }
    if !found.is_at_reference() {
        let [x, y, yaw] = found.place.map(rounded);
        line("joint of the tracked frame", format!("<origin xyz=\"{x} {y} 0\" rpy=\"0 0 {yaw}\"/>"));
    }
    if text.is_empty() {
        return None;
    }
    let (lines, unsaid) = lines_of_the_rest(&found, &[], false);
    lines.iter().for_each(|line| _ = writeln!(text, "<!-- {} -->", line.replace("--", "- -")));
    Some(Exported { text, unsaid })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects;

    fn lines(effects: &str) -> Option<String> {
        let head = "vehicle = \"differential-drive\"\n[parameters]\nwheel_radius = 0.1\ntrack_width = 0.4\n";
        let known = crate::model::known(effects::all());
        description_lines(&ModelFile::parse(&format!("{head}{effects}"), "model.toml", &known).unwrap()).map(|e| e.text)
    }

    #[test]
    fn only_what_changes_is_written() {
        assert_eq!(lines(""), None);
        assert_eq!(lines("[[effects]]\nid = \"drift\"\nvx = 0.1\nvy = 0.0\n"), None);
        let track = lines("[[effects]]\nid = \"track-width\"\nscale = 0.03\n").unwrap();
        assert!(track.contains("xyz=\"0 0.206 0\"") && track.contains("xyz=\"0 -0.206 0\""), "{track}");
        assert!(!track.contains("cylinder"), "{track}");
        let left = lines("[[effects]]\nid = \"wheel-radius-mismatch\"\nscale = 0.02\n").unwrap();
        assert!(left.contains("left wheel") && left.contains("0.102") && !left.contains("right"), "{left}");
        let both = lines("[[effects]]\nid = \"wheel-radius\"\nscale = 0.02\n").unwrap();
        assert_eq!(both.matches("cylinder").count(), 1, "{both}");
    }
}
