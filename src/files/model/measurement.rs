//! `input_timing`, `[sensor]`, `[initial]` and `[noise]`: how a run was measured, and the pose a simulation begins with.

use super::known::KnownVehicle;
use super::parameters::one_per_trailer;
use crate::error::Result;
use crate::files::toml::spanned_table::{Section, Value};
use crate::files::toml::suggestions;

/// What a row of inputs means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InputTiming {
    /// The value at the time of the row.
    #[default]
    Sample,
    /// The mean since the row before, as encoder counts give it.
    IntervalMean,
}

/// Where the measured pose sits on the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sensor {
    /// Forward and left of the reference point, m.
    pub lever_arm: [f64; 2],
    /// Measured heading minus heading of the body, rad.
    pub heading_offset: f64,
    /// Time constant of a low-pass filter of first order that smooths the measured pose, s.
    pub pose_filter: Option<f64>,
}

/// A pose a simulation begins with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Initial {
    /// Position along x, m.
    pub x: f64,
    /// Position along y, m.
    pub y: f64,
    /// Heading, rad.
    pub heading: f64,
    /// Absolute headings of the trailers, rad; those of the tractor when left out.
    pub trailer_headings: Vec<f64>,
}

/// Standard deviations (1 sigma) of the measured pose; to be estimated where there is none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// Of each coordinate, m.
    pub position: Option<f64>,
    /// Of the heading, rad.
    pub heading: Option<f64>,
}

impl InputTiming {
    pub(super) fn read(top: &Section) -> Result<Self> {
        let Some(value) = top.get("input_timing") else { return Ok(Self::default()) };
        match value.text()? {
            "sample" => Ok(Self::Sample),
            "interval-mean" => Ok(Self::IntervalMean),
            other => Err(value.error(format!("unknown input_timing \"{other}\"")).help(suggestions::advice(
                other,
                "it is one of",
                &["sample", "interval-mean"],
            ))),
        }
    }
}

impl Sensor {
    pub(super) fn read(top: &Section) -> Result<Self> {
        let Some(section) = top.section("sensor")? else { return Ok(Self::default()) };
        section.only(&["lever_arm", "heading_offset", "pose_filter"])?;
        let lever_arm = section.get("lever_arm").map_or(Ok([0.0; 2]), |v| pair(&v))?;
        let heading_offset = section.get("heading_offset").map_or(Ok(0.0), |v| v.number())?;
        let pose_filter = section.get("pose_filter").map(|v| time_constant(&v)).transpose()?;
        Ok(Self { lever_arm, heading_offset, pose_filter })
    }
}

fn time_constant(value: &Value) -> Result<f64> {
    let number = value.number()?;
    if number > 0.0 {
        return Ok(number);
    }
    Err(value.error("pose_filter is a time constant above 0 s").help("remove the line where the pose is not filtered"))
}

fn pair(value: &Value) -> Result<[f64; 2]> {
    let example = "lever_arm = [0.0, 0.0], forward and left in metres";
    let numbers: Vec<f64> = value.list(example)?.iter().map(Value::number).collect::<Result<_>>()?;
    let found = numbers.len();
    numbers
        .try_into()
        .map_err(|_| value.error(format!("lever_arm needs 2 numbers, not {found}")).help(format!("write {example}")))
}

impl Initial {
    pub(super) fn read(
        top: &Section,
        vehicle: &KnownVehicle,
        trailers: usize,
        speeds: &[String],
    ) -> Result<Option<Self>> {
        let Some(section) = top.section("initial")? else { return Ok(None) };
        let mut keys = vec!["x", "y", "heading"];
        let own = vehicle.heading.as_deref().filter(|own| section.get(own).is_some());
        keys.extend(own);
        keys.extend(speeds.iter().map(String::as_str));
        keys.extend((trailers > 0).then_some("trailer_headings"));
        section.only(&keys)?;
        let need = |key: &str| section.need(key, &format!("{key} = 0.0 under [initial]"))?.number();
        let place = |key: &str| if vehicle.stays && section.get(key).is_none() { Ok(0.0) } else { need(key) };
        let heading = match (own, section.get("heading")) {
            (Some(own), Some(twice)) => {
                return Err(twice
                    .error(format!("the heading is given twice, as heading and as {own}"))
                    .help("remove one of the two"));
            }
            (own, _) => need(own.unwrap_or("heading"))?,
        };
        let (x, y) = (place("x")?, place("y")?);
        let mut trailer_headings = vec![heading; trailers];
        if let Some(value) = section.get("trailer_headings") {
            trailer_headings =
                value.list("trailer_headings = [0.0]")?.iter().map(Value::number).collect::<Result<_>>()?;
            one_per_trailer(&value, trailer_headings.len(), trailers)?;
        }
        Ok(Some(Self { x, y, heading, trailer_headings }))
    }
}

impl Noise {
    pub(super) fn read(top: &Section) -> Result<Self> {
        let Some(section) = top.section("noise")? else { return Ok(Self::default()) };
        section.only(&["position", "heading"])?;
        let sigma = |key: &str| section.get(key).map(|v| v.positive()).transpose();
        Ok(Self { position: sigma("position")?, heading: sigma("heading")? })
    }
}
