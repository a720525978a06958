//! Slips of units and columns: numbers that no vehicle explains, and what they look like.

use super::motion_ratios::{Ratios, steps};
use super::repairs::Repaired;
use crate::discrepancy::record::local_polynomial::median;
use crate::discrepancy::record::run_record::Record;
use crate::error::Result;
use crate::files::Run;
use crate::model::{Equations, Model};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Rows further apart than this are no log of a motion, s.
pub const SPARSE: f64 = 1.0;
/// A vehicle that moves, or turns, by less than this share of what its model does is not driven by its wheels.
const ROLLS: f64 = 0.02;
/// A model that turns less may do so by the bias and the noise of a gyro, rad/s, root mean square.
const TURNING: f64 = 0.1;
/// Ways that are shorter by more than this have been measured on a globe.
const DEGREES: f64 = 1e-4;
/// How near, as a logarithm, a ratio is to that of a usual slip.
const NEAR: f64 = 0.25;

/// A slip of units or columns, of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Slip {
    /// Name of the run.
    pub run: String,
    /// Its kind.
    pub kind: SlipKind,
}

impl Slip {
    /// Its kind, for scripts.
    pub fn id(&self) -> &'static str {
        match &self.kind {
            SlipKind::AngleBeyondHalfTurn { .. } => "angle-beyond-half-turn",
            SlipKind::TurnsBetweenRows { .. } => "turns-between-rows",
            SlipKind::Mirrored => "mirrored",
            SlipKind::Repair(_) => "repair",
            SlipKind::LoggedTwice { .. } => "logged-twice",
            SlipKind::Stands { .. } => "input-stands",
            SlipKind::Bursts { .. } => "bursts",
            SlipKind::Turning { .. } => "turning",
            SlipKind::Way { .. } => "way",
        }
    }
}

/// The kinds of slips that numbers tell.
#[derive(Clone, Debug, PartialEq)]
pub enum SlipKind {
    /// An angle is beyond half a turn.
    AngleBeyondHalfTurn {
        /// The input.
        role: String,
        /// Its largest value, rad.
        largest: f64,
    },
    /// From row to row, some seconds apart, the vehicle turns by more than half a turn.
    TurnsBetweenRows {
        /// rad
        turn: f64,
        /// s
        step: f64,
    },
    /// The path is the mirror image of the headings.
    Mirrored,
    /// One repair of the data brings them into line with the model.
    Repair(Repaired),
    /// Two inputs are the same in every row, and the vehicle turns.
    LoggedTwice {
        /// Both.
        roles: [String; 2],
        /// Measured way over that of the model.
        way: Option<f64>,
    },
    /// An input stands at one value while the vehicle turns otherwise.
    Stands {
        /// The input.
        role: String,
        /// The value.
        value: f64,
    },
    /// Rows come in bursts: their times are those of arrival.
    Bursts {
        /// Usual time within a burst, and from one to the next, s.
        steps: [f64; 2],
        /// Rates in a burst over those after a pause.
        rates: f64,
    },
    /// The measured turning is so many times the model's.
    Turning {
        /// Measured over modelled.
        ratio: f64,
        /// The usual slip that it looks like.
        cause: TurningCause,
    },
    /// The measured way is so many times the model's.
    Way {
        /// Measured over modelled.
        ratio: f64,
        /// The usual slip that it looks like.
        cause: WayCause,
        /// Whether wheels that spin would do the same.
        may_spin: bool,
    },
}

/// What makes a measured way another than the model's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WayCause {
    /// Position as latitude and longitude.
    PositionInDegrees,
    /// Position in mm.
    PositionInMillimetres,
    /// Position in cm.
    PositionInCentimetres,
    /// A speed in mm/s.
    SpeedInMillimetres,
    /// A wheel's rate in degrees per second.
    RateInDegrees,
    /// A speed in km/h.
    SpeedInKilometresPerHour,
    /// A wheel's rate in turns per second.
    RateInTurns,
    /// A wheel's rate in turns per minute.
    RateInTurnsPerMinute,
    /// A diameter in the place of a radius, or the reverse.
    Diameter,
    /// Time in another unit: rows are far apart.
    TimeUnit,
    /// No usual slip.
    Unknown,
}

/// What makes a measured turning another than the model's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TurningCause {
    /// Heading in degrees.
    HeadingInDegrees,
    /// A yaw rate or an angle in degrees.
    InputInDegrees,
    /// Left and right exchanged, or angles that count clockwise.
    Backwards,
    /// No usual slip.
    Unknown,
}

/// The slip of inputs that say nothing of the motion: an angle is beyond half a turn, or the vehicle turns by more than that
/// from row to row, as a rule, so that nobody knows where it points in between.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn too_sparse<'a>(model: &Model, runs: impl IntoIterator<Item = &'a Run>) -> Result<Option<Slip>> {
    let equations = model.equations(&[])?;
    for run in runs {
        let of = |kind| Slip { run: run.name.clone(), kind };
        if let Some(kind) = beyond_half_a_turn(model, run) {
            return Ok(Some(of(kind)));
        }
        let (turn, step) = between_rows(&equations, run);
        if turn > PI {
            return Ok(Some(of(SlipKind::TurnsBetweenRows { turn, step })));
        }
    }
    Ok(None)
}

/// Rows of an angle beyond half a turn that are no gross errors, as a share.
const SOME: f64 = 0.05;

/// Steering angles that no wheel has.
fn beyond_half_a_turn(model: &Model, run: &Run) -> Option<SlipKind> {
    let is_angle = |role: &str| model.vehicle.inputs.get(role).is_some_and(|input| input.unit == "rad");
    let (role, column) = run.roles.iter().zip(&run.inputs).find(|(role, column)| {
        let beyond = column.iter().filter(|u| u.abs() > PI).count();
        is_angle(role) && beyond as f64 > SOME * column.len() as f64
    })?;
    let largest = column.iter().map(|u| u.abs()).fold(0.0, f64::max);
    Some(SlipKind::AngleBeyondHalfTurn { role: role.clone(), largest })
}

/// Medians of the turn between neighbouring rows of the inputs, rad, and of the time, s.
fn between_rows(equations: &Equations, run: &Run) -> (f64, f64) {
    let time = run.input_time();
    let (mut memory, z) = (equations.workspace(&[]), vec![0.0; equations.n()]);
    let (mut u, mut rates) = (vec![0.0; run.inputs.len()], z.clone());
    let (mut turns, mut between) = (vec![], vec![]);
    for (i, pair) in time.windows(2).enumerate() {
        u.iter_mut().zip(&run.inputs).for_each(|(u, column)| *u = column[i]);
        equations.rates(&mut memory, &z, &u, &mut rates);
        let step = pair[1] - pair[0];
        between.push(step);
        // Where the motion is undefined it says nothing of its turns.
        turns.extend(Some((rates[2] * step).abs()).filter(|t| t.is_finite()));
    }
    let usual = |mut values: Vec<f64>| median(&mut values).unwrap_or(0.0);
    (usual(turns), usual(between))
}

/// The slip of a vehicle that hardly moves as its inputs say, or in another direction than it points: it cannot be put to
/// its model.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn another_motion(model: &Model, records: &[Record]) -> Result<Option<Slip>> {
    for (record, ratios) in records.iter().zip(ratios(model, records)?) {
        let kind =
            mirrored(record, &ratios).or_else(|| no_turn_of_its(&ratios)).or_else(|| no_way_of_its(record, &ratios));
        if let Some(kind) = kind {
            return Ok(Some(Slip { run: record.name.clone(), kind }));
        }
    }
    Ok(None)
}

fn mirrored(record: &Record, ratios: &Ratios) -> Option<SlipKind> {
    (record.has_heading() && ratios.is_mirrored()).then_some(SlipKind::Mirrored)
}

fn no_turn_of_its(ratios: &Ratios) -> Option<SlipKind> {
    let turns_so = |r: &f64| r.abs() < ROLLS || usual_turning(*r).is_some();
    ratios
        .turn
        .filter(|r| ratios.yaw_rate > TURNING && turns_so(r))
        .map(|ratio| SlipKind::Turning { ratio, cause: turning_cause(ratio) })
}

fn no_way_of_its(record: &Record, ratios: &Ratios) -> Option<SlipKind> {
    let step = record.step();
    // Along where it points; what carries a vehicle that hardly drives does so in any direction.
    let far = ratios.way.filter(|r| *r > 1.0 / ROLLS && ratios.follows());
    let near = || ratios.way.filter(|r| *r < ROLLS);
    far.map(|ratio| (ratio, false))
        .or_else(|| near().map(|ratio| (ratio, true)))
        .map(|(ratio, may_spin)| SlipKind::Way { ratio, cause: way_cause(ratio, step), may_spin })
}

fn ratios(model: &Model, records: &[Record]) -> Result<Vec<Ratios>> {
    records.par_iter().map(|r| Ok(Ratios::of(&steps(model, r)?, r, r.position_noise()))).collect()
}

/// The usual slip that what was measured looks like beside what the model drives, of the first run that looks like one.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn suspected(model: &Model, records: &[Record]) -> Result<Option<Slip>> {
    for (record, ratios) in records.iter().zip(ratios(model, records)?) {
        let turning = ratios.turn.and_then(|ratio| Some(SlipKind::Turning { ratio, cause: usual_turning(ratio)? }));
        let way = ratios.way.and_then(|ratio| Some(SlipKind::Way { ratio, cause: usual_way(ratio)?, may_spin: false }));
        if let Some(kind) = turning.or(way) {
            return Ok(Some(Slip { run: record.name.clone(), kind }));
        }
    }
    Ok(None)
}

/// What makes the model drive another way than was measured, where rows are some time apart.
pub fn way_cause(ratio: f64, step: f64) -> WayCause {
    if step > SPARSE { WayCause::TimeUnit } else { usual_way(ratio).unwrap_or(WayCause::Unknown) }
}

fn usual_way(ratio: f64) -> Option<WayCause> {
    let near = |x: f64| (ratio / x).ln().abs() < NEAR;
    Some(match () {
        // A degree of latitude is 111 km.
        () if ratio < DEGREES => WayCause::PositionInDegrees,
        () if near(1e3) => WayCause::PositionInMillimetres,
        () if near(1e2) => WayCause::PositionInCentimetres,
        () if near(1e-3) => WayCause::SpeedInMillimetres,
        () if near(PI / 180.0) => WayCause::RateInDegrees,
        () if near(1.0 / 3.6) => WayCause::SpeedInKilometresPerHour,
        () if near(TAU) => WayCause::RateInTurns,
        () if near(TAU / 60.0) => WayCause::RateInTurnsPerMinute,
        () if near(0.5) || near(2.0) => WayCause::Diameter,
        () => return None,
    })
}

/// What makes the model turn otherwise than was measured.
pub fn turning_cause(ratio: f64) -> TurningCause {
    let unknown = if ratio < 0.0 { TurningCause::Backwards } else { TurningCause::Unknown };
    usual_turning(ratio).unwrap_or(unknown)
}

fn usual_turning(ratio: f64) -> Option<TurningCause> {
    let degrees = 180.0 / PI;
    let near = |x: f64| ratio * x > 0.0 && (ratio / x).ln().abs() < NEAR;
    Some(match () {
        () if near(degrees) || near(-degrees) => TurningCause::HeadingInDegrees,
        () if near(1.0 / degrees) || near(-1.0 / degrees) => TurningCause::InputInDegrees,
        () if near(-1.0) => TurningCause::Backwards,
        () => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::ModelFile;

    #[test]
    fn an_angle_beyond_half_a_turn_is_none_of_a_wheel() {
        let text = "vehicle = \"car\"\n[parameters]\nwheel_radius = 0.3\nwheelbase = 2.6\n";
        let file = ModelFile::parse(text, "model.toml", &crate::model::known(crate::effects::all())).unwrap();
        let said = |angle: &dyn Fn(i32) -> f64| {
            let rows: Vec<String> = (0..100).map(|i| format!("{},0,0,0,9,{}", 0.1 * f64::from(i), angle(i))).collect();
            let log = format!("time,x,y,heading,wheel_rate,steering_angle\n{}\n", rows.join("\n"));
            let run = Run::parse("run.csv", &log, &file).unwrap();
            let model = Model::from_file(&file, crate::effects::all(), &run.roles).unwrap();
            too_sparse(&model, [&run]).unwrap()
        };
        let degrees = said(&|i| 20.0 * (0.1 * f64::from(i)).sin()).unwrap().kind;
        let SlipKind::AngleBeyondHalfTurn { role, largest } = degrees else { panic!("{degrees:?}") };
        assert!(role == "steering_angle" && (largest - 20.0).abs() < 0.01, "{role} {largest}");
        assert_eq!(said(&|i| 0.5 * (0.1 * f64::from(i)).sin()), None);
        // A gross error here and there is no unit.
        assert_eq!(said(&|i| if i % 25 == 3 { 50.0 } else { 0.1 }), None);
    }

    #[test]
    fn usual_slips_of_units_are_told_by_their_ratio() {
        use TurningCause::{Backwards, HeadingInDegrees, InputInDegrees};
        for (ratio, cause) in [
            (1010.0, WayCause::PositionInMillimetres),
            (90.0, WayCause::PositionInCentimetres),
            (0.0009, WayCause::SpeedInMillimetres),
            (1.2e-5, WayCause::PositionInDegrees),
            (0.0175, WayCause::RateInDegrees),
            (0.1, WayCause::RateInTurnsPerMinute),
            (6.3, WayCause::RateInTurns),
            (0.27, WayCause::SpeedInKilometresPerHour),
            (0.51, WayCause::Diameter),
            (2.1, WayCause::Diameter),
            (0.7, WayCause::Unknown),
        ] {
            assert_eq!(way_cause(ratio, 0.1), cause, "{ratio}");
        }
        assert_eq!(way_cause(0.001, 1.1), WayCause::TimeUnit);
        assert_eq!(usual_way(0.7), None);
        for (ratio, cause) in [
            (57.0, HeadingInDegrees),
            (-57.0, HeadingInDegrees),
            (-0.0175, InputInDegrees),
            (-1.02, Backwards),
            (-0.4, Backwards),
            (0.0175, InputInDegrees),
            (0.6, TurningCause::Unknown),
        ] {
            assert_eq!(turning_cause(ratio), cause, "{ratio}");
        }
        assert_eq!((usual_turning(-0.4), usual_turning(0.6), usual_turning(1.0)), (None, None, None));
    }
}
