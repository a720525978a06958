//! Radius, track and wheelbase from a robot's description in URDF.

use crate::error::Result;
use crate::files::read_text;
use crate::files::robot_description::{self, number};
use roxmltree::Node;
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
        let document = robot_description::parsed(&text, path)?;
        let otherwise = "leave --urdf out, and put wheel_radius and the others into the model file";
        let wheels = robot_description::wheels(&document, path, otherwise)?;
        let wheels = wheels.iter().map(Wheel::of).collect::<Result<Vec<_>>>().map_err(|e| e.at_file(path))?;
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

impl Wheel {
    fn of(wheel: &robot_description::Wheel) -> Result<Self> {
        let radius = wheel.link.map(|link| radius(&link)).transpose()?.flatten();
        Ok(Self { radius, x: wheel.place[0], y: wheel.place[1] })
    }
}

fn radius(link: &Node) -> Result<Option<f64>> {
    let shapes =
        ["collision", "visual"].into_iter().flat_map(|kind| link.children().filter(move |n| n.has_tag_name(kind)));
    let round = shapes.flat_map(|n| n.descendants()).find(|n| n.has_tag_name("cylinder") || n.has_tag_name("sphere"));
    round.and_then(|n| n.attribute("radius")).map(number).transpose()
}
