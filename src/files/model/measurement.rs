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
    /// A low-pass filter of first order that smooths the measured pose.
    pub pose_filter: Option<PoseFilter>,
}

/// A low-pass filter of first order that smooths the measured pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PoseFilter {
    /// In continuous time, τ·ż + z = w: its time constant, s.
    Continuous(f64),
    /// Exponential smoothing of the rows, z = α·w + (1 − α)·z₋: the share α of the new pose.
    OfRows(f64),
}

impl PoseFilter {
    /// What the filter is called in a model file, and its number.
    pub fn entry(self) -> (&'static str, f64) {
        match self {
            Self::Continuous(time_constant) => ("pose_filter", time_constant),
            Self::OfRows(share) => ("pose_smoothing", share),
        }
    }

    /// The weight of a row in the pose before the filter, of rows so many s apart; the row before it has what lacks to one.
    pub fn weight(self, step: f64) -> f64 {
        match self {
            Self::Continuous(time_constant) => 0.5 + time_constant / step,
            Self::OfRows(share) => 1.0 / share,
        }
    }
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
        section.only(&["lever_arm", "heading_offset", "pose_filter", "pose_smoothing"])?;
        let lever_arm = section.get("lever_arm").map_or(Ok([0.0; 2]), |v| pair(&v))?;
        let heading_offset = section.get("heading_offset").map_or(Ok(0.0), |v| v.number())?;
        let pose_filter = pose_filter(&section)?;
        Ok(Self { lever_arm, heading_offset, pose_filter })
    }
}

/// The filter of the pose, by either of its keys.
fn pose_filter(section: &Section) -> Result<Option<PoseFilter>> {
    let (continuous, of_rows) = (section.get("pose_filter"), section.get("pose_smoothing"));
    match (continuous, of_rows) {
        (None, None) => Ok(None),
        (Some(_), Some(twice)) => Err(twice
            .error("the filter of the pose is given twice, as pose_filter and as pose_smoothing")
            .help("remove one of the two")),
        (Some(value), None) => match value.number()? {
            number if number > 0.0 => Ok(Some(PoseFilter::Continuous(number))),
            _ => Err(value
                .error("pose_filter is a time constant above 0 s")
                .help("remove the line where the pose is not filtered")),
        },
        (None, Some(value)) => match value.number()? {
            number if number > 0.0 && number < 1.0 => Ok(Some(PoseFilter::OfRows(number))),
            _ => Err(value
                .error("pose_smoothing is the share of the new pose in a row, between 0 and 1")
                .help("remove the line where the pose is not filtered")),
        },
    }
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
