//! Radius, track and wheelbase from a robot's description in URDF.

use crate::error::{Error, Result};
use crate::files::read_text;
use roxmltree::{Document, Node};
use std::collections::BTreeMap;
use std::path::Path;

/// What a robot's description says of its wheels, m.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measures {
    /// The file.
    pub source: String,
    /// Radius of the wheels.
    pub wheel_radius: Option<f64>,
    /// Distance between left and right wheels.
    pub track_width: Option<f64>,
    /// Distance between front and rear wheels.
    pub wheelbase: Option<f64>,
    /// How many wheels have a radius that is not above zero, which is not taken.
    pub without_radius: usize,
}

/// A wheel: its radius, and where it stands on the robot.
struct Wheel {
    radius: Option<f64>,
    x: f64,
    y: f64,
}

/// More joints than these one behind the other are a circle.
const DEEPEST: usize = 100;

impl Measures {
    /// Reads a description: wheels are links whose joint turns and whose name says "wheel".
    ///
    /// ```
    /// use creepage::scaffold::Measures;
    /// let wheel = |side: &str, y: f64| format!(
    ///     "<link name='{side}_wheel'><collision><geometry><cylinder radius='0.033' length='0.018'/></geometry></collision></link>
    ///      <joint name='{side}' type='continuous'><parent link='base'/><child link='{side}_wheel'/><origin xyz='0 {y} 0'/></joint>");
    /// let text = format!("<robot><link name='base'/>{}{}</robot>", wheel("left", 0.08), wheel("right", -0.08));
    /// # let path = std::env::temp_dir().join("creepage-measures.urdf");
    /// std::fs::write(&path, text).unwrap();
    /// let found = Measures::read(&path).unwrap();
    /// assert_eq!((found.wheel_radius, found.track_width), (Some(0.033), Some(0.16)));
    /// ```
    ///
    /// # Errors
    /// When the file is no XML, is not expanded yet, or has no wheel.
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let text = read_text(path)?;
        let document = Document::parse(&text).map_err(|e| {
            let at = e.pos();
            let place = (at.row as usize, at.col as usize);
            Error::input("is not valid XML")
                .at_file(path)
                .at(place.0, place.1)
                .help("give a robot's description in URDF")
        })?;
        let wheels = wheels(&document).map_err(|e| e.at_file(path))?;
        if wheels.is_empty() {
            return Err(Error::input("has no wheel: no joint that turns leads to a link with \"wheel\" in its name")
                .at_file(path)
                .help("leave --urdf out, and put wheel_radius and the others into the model file"));
        }
        let rounded = |v: f64| Some((v * 1e9).round() / 1e9).filter(|v| v.is_finite());
        let spread = |of: &dyn Fn(&Wheel) -> f64| {
            let (least, most) =
                wheels.iter().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
            (most - least > 1e-6).then(|| rounded(most - least)).flatten()
        };
        let mut radii: Vec<f64> = wheels.iter().filter_map(|w| w.radius).filter(|r| *r > 0.0).collect();
        radii.sort_by(f64::total_cmp);
        Ok(Self {
            source: path.display().to_string(),
            wheel_radius: radii.get(radii.len() / 2).copied(),
            track_width: spread(&|w| w.y),
            wheelbase: spread(&|w| w.x),
            without_radius: wheels.iter().filter(|w| w.radius.is_some_and(|r| r <= 0.0)).count(),
        })
    }

    /// The value of a parameter.
    pub(crate) fn of(&self, parameter: &str) -> Option<f64> {
        match parameter {
            "wheel_radius" => self.wheel_radius,
            "track_width" => self.track_width,
            "wheelbase" => self.wheelbase,
            _ => None,
        }
    }
}

impl Measures {
    /// What was left out for a parameter, in words behind its meaning.
    pub(crate) fn left_out(&self, parameter: &str) -> String {
        let wheels = if self.without_radius == 1 { "wheel" } else { "wheels" };
        match (parameter, self.without_radius) {
            ("wheel_radius", n) if n > 0 => format!("; not taken: a radius not above zero of {n} {wheels}"),
            _ => String::new(),
        }
    }
}

fn wheels(document: &Document) -> Result<Vec<Wheel>> {
    let robot = document.root_element();
    let named = |kind: &'static str| robot.children().filter(move |n| n.has_tag_name(kind));
    let links: BTreeMap<&str, Node> = named("link").filter_map(|n| Some((n.attribute("name")?, n))).collect();
    let mut joints: BTreeMap<&str, (&str, [f64; 2], bool)> = BTreeMap::new();
    for joint in named("joint") {
        let link = |kind: &str| joint.children().find(|n| n.has_tag_name(kind)).and_then(|n| n.attribute("link"));
        let (Some(parent), Some(child)) = (link("parent"), link("child")) else { continue };
        let origin = joint.children().find(|n| n.has_tag_name("origin")).and_then(|n| n.attribute("xyz"));
        let turns = matches!(joint.attribute("type"), Some("continuous" | "revolute"));
        joints.insert(child, (parent, place(origin.unwrap_or("0 0 0"))?, turns));
    }
    let is_wheel = |name: &str| {
        let name = name.to_lowercase();
        name.contains("wheel") && !["caster", "castor"].iter().any(|other| name.contains(other))
    };
    let mut found = vec![];
    for (child, (_, _, turns)) in &joints {
        if *turns && is_wheel(child) {
            let [x, y] = on_robot(&joints, child);
            found.push(Wheel { radius: links.get(child).map(|link| radius(link)).transpose()?.flatten(), x, y });
        }
    }
    Ok(found)
}

/// Where a link stands on the robot, joints that stand turned left out of account.
fn on_robot(joints: &BTreeMap<&str, (&str, [f64; 2], bool)>, link: &str) -> [f64; 2] {
    let (mut at, mut link) = ([0.0, 0.0], link);
    for _ in 0..DEEPEST {
        let Some((parent, [x, y], _)) = joints.get(link) else { break };
        at = [at[0] + x, at[1] + y];
        link = parent;
    }
    at
}

fn radius(link: &Node) -> Result<Option<f64>> {
    let shapes =
        ["collision", "visual"].into_iter().flat_map(|kind| link.children().filter(move |n| n.has_tag_name(kind)));
    let round = shapes.flat_map(|n| n.descendants()).find(|n| n.has_tag_name("cylinder") || n.has_tag_name("sphere"));
    round.and_then(|n| n.attribute("radius")).map(number).transpose()
}

fn place(text: &str) -> Result<[f64; 2]> {
    let mut numbers = text.split_whitespace().map(number);
    Ok([numbers.next().unwrap_or(Ok(0.0))?, numbers.next().unwrap_or(Ok(0.0))?])
}

fn number(text: &str) -> Result<f64> {
    text.trim().parse::<f64>().ok().filter(|v| v.is_finite()).ok_or_else(|| {
        let shown = crate::files::shown(text);
        Error::input(format!("\"{shown}\" is not a number"))
            .help("where it is xacro, expand it: xacro robot.urdf.xacro > robot.urdf")
    })
}
