//! A robot's description (URDF) with corrected wheels: radii, places of wheel joints, and the frame that is tracked.

use super::corrections::{Corrections, lines_of_the_rest, rounded};
use super::exported::Exported;
use crate::error::{Error, Result};
use crate::files::robot_description::{number, parsed, wheels};
use crate::files::{ModelFile, read_text};
use roxmltree::{Attribute, Document, Node};
use std::ops::Range;
use std::path::Path;

/// A description in which what the model found of its wheels is put in; all else stays byte for byte.
///
/// A wheel is the link of a joint that turns, with "wheel" in its name, and no castor. Radii of its cylinders and spheres become
/// the model's radius times the correction of its side; its joint's y is multiplied by that of the track, and the x of the wheels
/// ahead is moved by what the wheelbase is longer. `tracked` names the link whose joint gets the place of the tracked frame.
///
/// # Errors
/// When the file is no XML, has no wheel, or no joint of the tracked link.
pub fn patched_description(file: &ModelFile, path: &Path, tracked: Option<&str>) -> Result<Exported> {
    let text = read_text(path)?;
    let document = parsed(&text, path)?;
    let wheels = wheels(&document, path, "give the description of the robot that the model is of")?;
    let found = Corrections::of(file);
    let mut edits: Vec<(Range<usize>, String)> = Vec::new();
    let nominal = file.parameters.get("wheel_radius").copied();
    let rear = wheels.iter().map(|w| w.place[0]).fold(f64::INFINITY, f64::min);
    for wheel in &wheels {
        let side = if wheel.place[1] < 0.0 { found.right } else { found.left };
        if let Some(nominal) = nominal.filter(|_| side != 1.0) {
            let shapes = wheel.link.iter().flat_map(Node::descendants);
            let radii = shapes.filter(|n| n.has_tag_name("cylinder") || n.has_tag_name("sphere"));
            let radii = radii.filter_map(|n| n.attribute_node("radius"));
            edits.extend(radii.map(|a: Attribute| (a.range_value(), rounded(nominal * side).to_string())));
        }
        let moved = [(found.base - 1.0) * (wheel.place[0] - rear), (found.separation - 1.0) * wheel.place[1]];
        if moved != [0.0; 2] {
            edits.push(moved_origin(wheel.joint, moved, path)?);
        }
    }
    let mut place_told = found.is_at_reference();
    if let Some(link) = tracked {
        edits.extend(tracked_frame(&document, link, found.place).map_err(|e| e.at_file(path))?);
        place_told = true;
    }
    let mut also = vec![];
    if found.steering != [1.0, 0.0] {
        also.push(format!("true steering angle = {}*commanded + {} rad", found.steering[0], found.steering[1]));
    }
    if nominal.is_none() && (found.left != 1.0 || found.right != 1.0) {
        also.push("a radius: the model has none".to_string());
    }
    let mut patched = with_edits(&text, edits);
    let (lines, unsaid) = lines_of_the_rest(&found, &also, !place_told);
    // Two dashes would end a comment, and a launch file needs no line for the frame that the description has.
    let lines = lines.iter().filter(|line| !line.starts_with("ros2 "));
    let comment: String =
        lines.map(|line| format!("<!-- {} -->\n", line.trim_end_matches("; in ROS 2").replace("--", "- -"))).collect();
    patched.push_str(&comment);
    Ok(Exported { text: patched, unsaid })
}

/// A text with ranges of it replaced.
fn with_edits(text: &str, mut edits: Vec<(Range<usize>, String)>) -> String {
    edits.sort_by_key(|(range, _)| range.start);
    let mut out = String::with_capacity(text.len());
    let mut at = 0;
    for (range, with) in edits {
        out.push_str(&text[at..range.start]);
        out.push_str(&with);
        at = range.end;
    }
    out.push_str(&text[at..]);
    if !out.ends_with('\n') {
        out.push('\n');
    }
    out
}

/// The origin of a joint moved forward and left.
fn moved_origin(joint: Node, [forward, left]: [f64; 2], path: &Path) -> Result<(Range<usize>, String)> {
    let xyz = joint.children().find(|n| n.has_tag_name("origin")).and_then(|n| n.attribute_node("xyz"));
    let name = joint.attribute("name").unwrap_or_default();
    let xyz = xyz.ok_or_else(|| {
        Error::input(format!("the joint {} of a wheel has no origin that could be moved", crate::files::shown(name)))
            .at_file(path)
            .help("give it <origin xyz=\"x y z\"/>")
    })?;
    let mut at = numbers(xyz.value())?;
    at.resize(3, 0.0);
    (at[0], at[1]) = (at[0] + forward, at[1] + left);
    Ok((xyz.range_value(), spaced(&at)))
}

/// The origin of the joint of the tracked link at a place: x, y and yaw; height, roll and pitch stay.
fn tracked_frame(document: &Document, link: &str, [x, y, yaw]: [f64; 3]) -> Result<Vec<(Range<usize>, String)>> {
    let joints = document.root_element().children().filter(|n| n.has_tag_name("joint"));
    let leads = |n: &Node| n.children().any(|c| c.has_tag_name("child") && c.attribute("link") == Some(link));
    let origin = joints.clone().find(leads).and_then(|j| j.children().find(|n| n.has_tag_name("origin")));
    let origin = origin.ok_or_else(|| {
        Error::input(format!("no joint with an origin leads to the link {}", crate::files::shown(link)))
            .help("name the link of the tracked frame; its joint needs <origin xyz=\"0 0 0\" rpy=\"0 0 0\"/>")
    })?;
    let mut edits = vec![];
    let mut of = |name: &str, values: [(usize, f64); 2]| -> Result<bool> {
        let Some(attribute) = origin.attribute_node(name) else { return Ok(false) };
        let mut numbers = numbers(attribute.value())?;
        numbers.resize(3, 0.0);
        values.into_iter().for_each(|(k, v)| numbers[k] = v);
        edits.push((attribute.range_value(), spaced(&numbers)));
        Ok(true)
    };
    let placed = of("xyz", [(0, x), (1, y)])?;
    let turned = of("rpy", [(2, yaw), (2, yaw)])?;
    match (placed || x == 0.0 && y == 0.0) && (turned || yaw == 0.0) {
        true => Ok(edits),
        false => {
            Err(Error::input(format!("the origin of the joint of {} has no xyz or no rpy", crate::files::shown(link)))
                .help("write <origin xyz=\"0 0 0\" rpy=\"0 0 0\"/>"))
        }
    }
}

fn numbers(text: &str) -> Result<Vec<f64>> {
    text.split_whitespace().map(number).collect()
}

/// Numbers with blanks between.
fn spaced(values: &[f64]) -> String {
    values.iter().map(|v| rounded(*v).to_string()).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects;

    const ROBOT: &str = "<?xml version='1.0'?>\n<robot name='r'>\n  <link name='base'/>\n  \
        <link name='left_wheel'><collision><geometry><cylinder radius='0.06' length='0.02'/></geometry></collision></link>\n  \
        <link name='right_wheel'><visual><geometry><cylinder radius=\"0.06\" length='0.02'/></geometry></visual></link>\n  \
        <link name='caster_wheel'><visual><geometry><sphere radius='0.02'/></geometry></visual></link>\n  \
        <joint name='l' type='continuous'><parent link='base'/><child link='left_wheel'/><origin xyz='0 0.16 0.01'/></joint>\n  \
        <joint name='r' type='continuous'><parent link='base'/><child link='right_wheel'/><origin xyz='0 -0.16 0.01'/></joint>\n  \
        <joint name='c' type='continuous'><parent link='base'/><child link='caster_wheel'/><origin xyz='0.1 0 0'/></joint>\n  \
        <joint name='m' type='fixed'><parent link='base'/><child link='marker'/><origin xyz='0 0 0.3' rpy='0 0 0'/></joint>\n\
        </robot>\n";

    fn patched(effects: &str, tracked: Option<&str>, robot: &str) -> Result<Exported> {
        let head = "vehicle = \"differential-drive\"\n[parameters]\nwheel_radius = 0.06\ntrack_width = 0.32\n";
        let file =
            ModelFile::parse(&format!("{head}{effects}"), "m.toml", &crate::model::known(effects::all())).unwrap();
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("robot.urdf");
        std::fs::write(&path, robot).unwrap();
        patched_description(&file, &path, tracked)
    }

    #[test]
    fn wheels_are_corrected_and_all_else_stays() {
        let effects = "[[effects]]\nid = \"track-width\"\nscale = 0.05\n[[effects]]\nid = \"wheel-radius-mismatch\"\n\
                       scale = -0.1\n[[effects]]\nid = \"lever-arm\"\na = 0.07\nb = -0.01\n\
                       [[effects]]\nid = \"heading-misalignment\"\noffset = 0.02\n";
        let found = patched(effects, Some("marker"), ROBOT).unwrap();
        let wanted = ROBOT
            .replacen("radius='0.06'", "radius='0.054'", 1)
            .replace("0 0.16 0.01", "0 0.168 0.01")
            .replace("0 -0.16 0.01", "0 -0.168 0.01")
            .replace("xyz='0 0 0.3' rpy='0 0 0'", "xyz='0.07 -0.01 0.3' rpy='0 0 0.02'");
        assert_eq!((found.text.as_str(), found.unsaid.len()), (wanted.as_str(), 0));
        // Without a name for it the frame stands in a comment.
        let told = patched(effects, None, ROBOT).unwrap().text;
        assert!(told.contains("<!-- the tracked frame on the body: x 0.07 m, y -0.01 m, yaw 0.02 rad"), "{told}");
        assert!(!told.contains("static_transform_publisher"), "{told}");
        assert_eq!(patched("", None, ROBOT).unwrap().text, ROBOT);
        Document::parse(&told).unwrap();
    }

    /// A wheel on an arm: its place is that on the robot, and its own joint makes up for the whole.
    #[test]
    fn a_wheel_that_hangs_on_an_arm_is_moved_by_what_its_place_asks_for() {
        let arm = "<link name='arm'/><joint name='a' type='fixed'><parent link='base'/><child link='arm'/>\
                   <origin xyz='0 -0.1 0'/></joint>";
        let mounted = ROBOT.replace("</robot>", &format!("{arm}</robot>")).replace(
            "<parent link='base'/><child link='right_wheel'/><origin xyz='0 -0.16 0.01'/>",
            "<parent link='arm'/><child link='right_wheel'/><origin xyz='0 -0.06 0.01'/>",
        );
        let effects = "[[effects]]\nid = \"track-width\"\nscale = 0.05\n[[effects]]\nid = \"unequal-rotation-creep\"\n\
                       e_left = 0.0\ne_right = 0.1\n";
        let found = patched(effects, None, &mounted).unwrap().text;
        assert!(found.contains("xyz='0 -0.068 0.01'") && found.contains("xyz='0 -0.1 0'"), "{found}");
        assert!(found.contains("radius=\"0.054\"") && found.contains("radius='0.06'"), "{found}");
    }

    #[test]
    fn what_is_no_description_is_told() {
        let track = "[[effects]]\nid = \"track-width\"\nscale = 0.05\n";
        let fails = |robot: &str, tracked: Option<&str>, says: &str| {
            let e = patched(track, tracked, robot).unwrap_err();
            assert!(e.exit_code() == 2 && e.to_string().contains(says), "{e}");
        };
        fails("wheels", None, "not valid XML");
        fails("<robot/>", None, "has no wheel");
        fails(&ROBOT.replace("0 0.16 0.01", "0 ${y} 0"), None, "expand it");
        fails(ROBOT, Some("lidar"), "no joint with an origin leads to the link lidar");
    }
}
