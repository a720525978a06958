//! The observation: what is measured of a vehicle, output by output, and which noise the sensor adds to each.

use super::freedom::{Freedom, Speed};
use super::trailer::trailer_heading;
use crate::formula::Symbol;

/// A component of the measurement noise: outputs that name the same one share a variance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SensorNoise {
    /// Its name.
    pub id: &'static str,
    /// The unit of its standard deviation.
    pub unit: &'static str,
}

/// Where a component of the measurement noise stands among those of [`sensor_noise`]: of a position.
pub const POSITION: usize = 0;
/// Of the body's heading.
pub const HEADING: usize = 1;
/// Of a trailer's heading.
pub const TRAILER: usize = 2;

/// Of a speed of the body.
pub const SPEED: usize = 3;
/// Of a yaw rate, or the rate of a wheel.
pub const RATE: usize = 4;

const SENSOR_NOISE: [SensorNoise; 5] = [
    SensorNoise { id: "position", unit: "m" },
    SensorNoise { id: "heading", unit: "rad" },
    SensorNoise { id: "trailer-heading", unit: "rad" },
    SensorNoise { id: "speed", unit: "m/s" },
    SensorNoise { id: "rate", unit: "rad/s" },
];

/// An output of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    source: Source,
    /// Whether it is an angle, of which whole turns say nothing.
    pub is_angle: bool,
    /// Its component of the measurement noise, a place among those of [`sensor_noise`].
    pub noise: usize,
}

/// The formula of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Source {
    /// A definition of the model: the state as the sensor sees it.
    Definition(&'static str),
    /// The heading of a trailer, as it is.
    Trailer(usize),
    /// One of the speeds that forces change, as it is.
    Speed(usize),
}

/// What a sensor on the body measures.
const BODY: [Output; 3] = [
    Output { source: Source::Definition("x_m"), is_angle: false, noise: POSITION },
    Output { source: Source::Definition("y_m"), is_angle: false, noise: POSITION },
    Output { source: Source::Definition("heading_m"), is_angle: true, noise: HEADING },
];

/// The outputs that are a place in the plane.
pub const PLACE: [usize; 2] = [0, 1];
/// The output that is the body's heading; a log may lack its column.
pub const BODY_HEADING: usize = 2;

impl Output {
    /// The definition or state that it is; `speeds` are the names of those that forces change.
    pub fn symbol_among(&self, speeds: &[Symbol]) -> Symbol {
        match self.source {
            Source::Definition(name) => Symbol::from(name),
            Source::Trailer(i) => trailer_heading(i),
            Source::Speed(i) => speeds[i].clone(),
        }
    }

    /// The definition or state that it is, of a vehicle whose inputs say how it moves.
    pub fn symbol(&self) -> Symbol {
        self.symbol_among(&[])
    }

    /// Its unit.
    pub fn unit(&self) -> &'static str {
        SENSOR_NOISE[self.noise].unit
    }
}

/// The outputs of a vehicle with so many trailers, in the order of the equations.
///
/// | output | unit | noise | angle |
/// |---|---|---|---|
/// | `x_m`, `y_m` | m | position | no |
/// | `heading_m` | rad | heading | yes |
/// | `phi_1`, `phi_2` … | rad | trailer-heading | yes |
///
/// ```
/// use creepage::model::observation::outputs;
/// let names: Vec<String> = outputs(1).map(|y| y.symbol().to_string()).collect();
/// assert_eq!(names, ["x_m", "y_m", "heading_m", "phi_1"]);
/// assert_eq!(outputs(1).map(|y| y.unit()).collect::<Vec<_>>(), ["m", "m", "rad", "rad"]);
/// ```
pub fn outputs(of: impl Into<Freedom>) -> impl Iterator<Item = Output> {
    let of = of.into();
    let of_trailer = |i: usize| Output { source: Source::Trailer(i), is_angle: true, noise: TRAILER };
    let trailers = (1..=of.trailers).map(of_trailer);
    let speeds = (0..of.speeds.len()).map(move |i| Output {
        source: Source::Speed(i),
        is_angle: false,
        noise: if matches!(of.speeds[i], Speed::Along | Speed::Across) { SPEED } else { RATE },
    });
    BODY.into_iter().chain(trailers).chain(speeds)
}

/// What a log has of a vehicle: which of its outputs have a column, and which of these a sensor measures.
///
/// ```
/// use creepage::model::observation::{BODY_HEADING, Observation};
/// let log = Observation::new(2, false, 3);
/// assert_eq!(log.measured(), [0, 1, 3]);
/// assert!(!log.measures(BODY_HEADING));
/// // On a line the place along it is all there is to measure.
/// let line = Observation::new(0, true, 3).defining([1, BODY_HEADING]);
/// assert_eq!((line.columns(), line.measured()), (&[0, 1, 2][..], &[0][..]));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    freedom: Freedom,
    columns: Vec<usize>,
    measured: Vec<usize>,
}

impl Observation {
    /// Of a vehicle with so many trailers so many columns, in the order of the outputs; the body's heading may lack one.
    pub fn new(of: impl Into<Freedom>, has_heading: bool, columns: usize) -> Self {
        let freedom = of.into();
        let all = (0..outputs(freedom.clone()).count()).filter(|i| has_heading || *i != BODY_HEADING);
        let columns: Vec<usize> = all.take(columns).collect();
        Self { freedom, measured: columns.clone(), columns }
    }

    /// The same where the columns of some outputs hold what is so by definition: they are known and not measured.
    pub fn defining(mut self, outputs: impl IntoIterator<Item = usize>) -> Self {
        let defined: Vec<usize> = outputs.into_iter().collect();
        self.measured.retain(|i| !defined.contains(i));
        self
    }

    /// How many trailers the vehicle has, measured or not.
    pub fn trailers(&self) -> usize {
        self.freedom.trailers
    }

    /// What of the vehicle is free at the start of every window.
    pub fn freedom(&self) -> &Freedom {
        &self.freedom
    }

    /// The outputs that have a column, column by column.
    pub fn columns(&self) -> &[usize] {
        &self.columns
    }

    /// The outputs that a sensor measures, in the order of their columns.
    pub fn measured(&self) -> &[usize] {
        &self.measured
    }

    /// Whether an output has a column, measured or by definition.
    pub fn knows(&self, output: usize) -> bool {
        self.columns.contains(&output)
    }

    /// Whether a sensor measures an output.
    pub fn measures(&self, output: usize) -> bool {
        self.measured.contains(&output)
    }

    /// Whether the heading of a trailer has a column.
    pub fn measures_trailers(&self) -> bool {
        self.measured.iter().any(|i| *i > BODY_HEADING && *i <= BODY_HEADING + self.freedom.trailers)
    }
}

/// The noise of a quantity that a model file declares; each has a component of its own, in the quantity's unit.
const QUANTITY_NOISE: SensorNoise = SensorNoise { id: "measured", unit: "" };

/// The components of the measurement noise of these outputs, then those of the quantities measured beside the pose.
pub fn measurement_noise(of: impl Into<Freedom>) -> impl Iterator<Item = SensorNoise> {
    let of = of.into();
    let quantities = of.quantities.len();
    sensor_noise(of).iter().copied().chain(std::iter::repeat_n(QUANTITY_NOISE, quantities))
}

/// The components of the measurement noise that these outputs have.
pub fn sensor_noise(of: impl Into<Freedom>) -> &'static [SensorNoise] {
    let last = outputs(of).map(|y| y.noise).max().unwrap_or(POSITION);
    &SENSOR_NOISE[..=last]
}
