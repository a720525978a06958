//! A robot's description in URDF: its wheels, each with its joint, its link and its place on the robot.

use super::shown;
use crate::error::{Error, Result};
use roxmltree::{Document, Node};
use std::collections::BTreeMap;
use std::path::Path;

/// A wheel: the link of a joint that turns, with "wheel" in its name, and no castor.
pub(crate) struct Wheel<'d> {
    /// Where it stands on the robot, forward and left, m.
    pub place: [f64; 2],
    pub joint: Node<'d, 'd>,
    /// Its link, where the description has it.
    pub link: Option<Node<'d, 'd>>,
}

/// More joints than these one behind the other are a circle.
const DEEPEST: usize = 100;

/// The document of a text.
///
/// # Errors
/// When it is no XML.
pub(crate) fn parsed<'t>(text: &'t str, path: &Path) -> Result<Document<'t>> {
    Document::parse(text).map_err(|e| {
        let at = e.pos();
        Error::input("is not valid XML")
            .at_file(path)
            .at(at.row as usize, at.col as usize)
            .help("give a robot's description in URDF")
    })
}

/// The wheels of a description.
///
/// # Errors
/// When a place is no number, or there is no wheel; `otherwise` says what to do without one.
pub(crate) fn wheels<'d>(document: &'d Document<'d>, path: &Path, otherwise: &str) -> Result<Vec<Wheel<'d>>> {
    let robot = document.root_element();
    let named = |kind: &'static str| robot.children().filter(move |n| n.has_tag_name(kind));
    let links: BTreeMap<&str, Node> = named("link").filter_map(|n| Some((n.attribute("name")?, n))).collect();
    let mut joints: BTreeMap<&str, (&str, [f64; 2], Node)> = BTreeMap::new();
    for joint in named("joint") {
        let link = |kind: &str| joint.children().find(|n| n.has_tag_name(kind)).and_then(|n| n.attribute("link"));
        let (Some(parent), Some(child)) = (link("parent"), link("child")) else { continue };
        let origin = joint.children().find(|n| n.has_tag_name("origin")).and_then(|n| n.attribute("xyz"));
        joints.insert(child, (parent, place(origin.unwrap_or("0 0 0")).map_err(|e| e.at_file(path))?, joint));
    }
    let turns = |joint: &Node| matches!(joint.attribute("type"), Some("continuous" | "revolute"));
    let wheel = |(child, (_, _, joint)): (&&str, &(&str, [f64; 2], Node<'d, 'd>))| Wheel {
        place: on_robot(&joints, child),
        joint: *joint,
        link: links.get(child).copied(),
    };
    let found: Vec<Wheel> =
        joints.iter().filter(|(child, (_, _, joint))| turns(joint) && is_wheel(child)).map(wheel).collect();
    match found.is_empty() {
        true => Err(Error::input("has no wheel: no joint that turns leads to a link with \"wheel\" in its name")
            .at_file(path)
            .help(otherwise)),
        false => Ok(found),
    }
}

fn is_wheel(name: &str) -> bool {
    let name = name.to_lowercase();
    name.contains("wheel") && !["caster", "castor"].iter().any(|other| name.contains(other))
}

/// Where a link stands on the robot, joints that stand turned left out of account.
fn on_robot(joints: &BTreeMap<&str, (&str, [f64; 2], Node)>, link: &str) -> [f64; 2] {
    let (mut at, mut link) = ([0.0, 0.0], link);
    for _ in 0..DEEPEST {
        let Some((parent, [x, y], _)) = joints.get(link) else { break };
        at = [at[0] + x, at[1] + y];
        link = parent;
    }
    at
}

fn place(text: &str) -> Result<[f64; 2]> {
    let mut numbers = text.split_whitespace().map(number);
    Ok([numbers.next().unwrap_or(Ok(0.0))?, numbers.next().unwrap_or(Ok(0.0))?])
}

/// A number of a description.
///
/// # Errors
/// When it is none, as where it is still to be expanded.
pub(crate) fn number(text: &str) -> Result<f64> {
    text.trim().parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(|| {
        Error::input(format!("\"{}\" is not a number", shown(text)))
            .help("where it is xacro, expand it: xacro robot.urdf.xacro > robot.urdf")
    })
}
