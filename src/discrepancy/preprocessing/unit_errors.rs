//! Slips of units and columns: numbers that no vehicle explains, and what they look like.

use super::motion_ratios::{Ratios, steps};
use crate::discrepancy::record::local_polynomial::median;
use crate::discrepancy::record::run_record::Record;
use crate::error::Result;
use crate::files::Run;
use crate::model::{Equations, Model};
use crate::number_format::significant;
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

/// Why inputs say nothing of the motion: an angle is beyond half a turn, or the vehicle turns by more than that from row to
/// row, as a rule, so that nobody knows where it points in between.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn too_sparse<'a>(model: &Model, runs: impl IntoIterator<Item = &'a Run>) -> Result<Option<String>> {
    let equations = model.equations(&[])?;
    for run in runs {
        if let Some(why) = beyond_half_a_turn(model, run) {
            return Ok(Some(why));
        }
        let (turn, step) = between_rows(&equations, run);
        if turn > PI {
            let [turn, step] = [turn, step].map(|x| significant(x, 3));
            return Ok(Some(format!(
                "The inputs of {} turn the vehicle by {turn} rad from row to row, in {step} s, so these rows do not show \
                 how it moves: is time in seconds, and are the inputs in SI units?",
                run.name
            )));
        }
    }
    Ok(None)
}

/// Rows of an angle beyond half a turn that are no gross errors, as a share.
const SOME: f64 = 0.05;

/// Steering angles that no wheel has.
fn beyond_half_a_turn(model: &Model, run: &Run) -> Option<String> {
    let is_angle = |role: &str| model.vehicle.inputs.get(role).is_some_and(|input| input.unit == "rad");
    let (role, column) = run.roles.iter().zip(&run.inputs).find(|(role, column)| {
        let beyond = column.iter().filter(|u| u.abs() > PI).count();
        is_angle(role) && beyond as f64 > SOME * column.len() as f64
    })?;
    let largest = column.iter().map(|u| u.abs()).fold(0.0, f64::max);
    Some(format!(
        "In {} {role} reaches {} rad, more than half a turn: is it in degrees, or the angle of the steering wheel?",
        run.name,
        significant(largest, 3)
    ))
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

/// Why a vehicle that hardly moves as its inputs say, or in another direction than it points, cannot be put to its model.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn another_motion(model: &Model, records: &[Record]) -> Result<Option<String>> {
    for (record, ratios) in records.iter().zip(ratios(model, records)?) {
        if record.has_heading && ratios.is_mirrored() {
            return Ok(Some(format!(
                "In {} the path is the mirror image of what the headings say: are x and y swapped, does one of them have \
                 the wrong sign, or does the heading count clockwise?",
                record.name
            )));
        }
        let no_turn_of_its = |r: &f64| ratios.yaw_rate > TURNING && (r.abs() < ROLLS || usual_turn(*r).is_some());
        if let Some(ratio) = ratios.turn.filter(no_turn_of_its) {
            return Ok(Some(format!("In {} {}", record.name, wrong_turn(ratio))));
        }
        // Along where it points; what carries a vehicle that hardly drives does so in any direction.
        if let Some(ratio) = ratios.way.filter(|r| *r > 1.0 / ROLLS && ratios.follows()) {
            return Ok(Some(format!("In {} {}", record.name, wrong_way(ratio, record.step()))));
        }
        if let Some(ratio) = ratios.way.filter(|r| *r < ROLLS) {
            return Ok(Some(format!(
                "In {} {}, or do the wheels spin?",
                record.name,
                wrong_way(ratio, record.step()).trim_end_matches('?')
            )));
        }
    }
    Ok(None)
}

fn ratios(model: &Model, records: &[Record]) -> Result<Vec<Ratios>> {
    records.par_iter().map(|r| Ok(Ratios::of(&steps(model, r)?, r, r.position_noise()))).collect()
}

/// The usual slip that what was measured looks like beside what the model drives, of the first run that looks like one.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn suspected(model: &Model, records: &[Record]) -> Result<Option<String>> {
    for (record, ratios) in records.iter().zip(ratios(model, records)?) {
        let turn = ratios.turn.and_then(|r| Some(turned(r, usual_turn(r)?)));
        let way = ratios.way.and_then(|r| Some(gone(r, usual_way(r)?)));
        if let Some(says) = turn.or(way) {
            return Ok(Some(format!("in {} {says}", record.name)));
        }
    }
    Ok(None)
}

/// Why the model drives another way than was measured, where rows are some time apart.
pub fn wrong_way(ratio: f64, step: f64) -> String {
    let unknown = if step > SPARSE {
        "is time in seconds?"
    } else {
        "check wheel_radius and the units of position and wheel rate"
    };
    gone(ratio, usual_way(ratio).filter(|_| step <= SPARSE).unwrap_or(unknown))
}

fn gone(ratio: f64, why: &str) -> String {
    format!("the measured way is {} times what the model drives: {why}", significant(ratio, 3))
}

fn usual_way(ratio: f64) -> Option<&'static str> {
    let near = |x: f64| (ratio / x).ln().abs() < NEAR;
    Some(match () {
        // A degree of latitude is 111 km.
        () if ratio < DEGREES => "is the position in degrees of latitude and longitude?",
        () if near(1e3) => "is the position in millimetres?",
        () if near(1e2) => "is the position in centimetres?",
        () if near(1e-3) => "is a speed in millimetres per second?",
        () if near(PI / 180.0) => "is the wheel rate in degrees per second?",
        () if near(1.0 / 3.6) => "is the speed in km/h?",
        () if near(TAU) => "is the wheel rate in turns per second?",
        () if near(TAU / 60.0) => "is the wheel rate in turns per minute, or wheel_radius wrong?",
        () if near(0.5) || near(2.0) => "is wheel_radius a diameter, or the other way round?",
        () => return None,
    })
}

/// Why the model turns otherwise than was measured.
pub fn wrong_turn(ratio: f64) -> String {
    let unknown = match ratio < 0.0 {
        true => BACKWARDS,
        false => "check track_width or wheelbase, and the units of heading and yaw rate",
    };
    turned(ratio, usual_turn(ratio).unwrap_or(unknown))
}

const BACKWARDS: &str = "are left and right swapped, or do angles count clockwise?";

fn turned(ratio: f64, why: &str) -> String {
    format!("the measured turning is {} times the model's: {why}", significant(ratio, 3))
}

fn usual_turn(ratio: f64) -> Option<&'static str> {
    let degrees = 180.0 / PI;
    let near = |x: f64| ratio * x > 0.0 && (ratio / x).ln().abs() < NEAR;
    Some(match () {
        () if near(degrees) || near(-degrees) => "is the heading in degrees?",
        () if near(1.0 / degrees) || near(-1.0 / degrees) => "is the yaw rate, or the angle, in degrees?",
        () if near(-1.0) => BACKWARDS,
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
        let degrees = said(&|i| 20.0 * (0.1 * f64::from(i)).sin()).unwrap();
        assert!(degrees.contains("steering_angle reaches 20.0 rad") && degrees.contains("degrees"), "{degrees}");
        assert_eq!(said(&|i| 0.5 * (0.1 * f64::from(i)).sin()), None);
        // A gross error here and there is no unit.
        assert_eq!(said(&|i| if i % 25 == 3 { 50.0 } else { 0.1 }), None);
    }

    #[test]
    fn usual_slips_of_units_are_named() {
        for (ratio, word) in [
            (1010.0, "millimetres?"),
            (90.0, "centimetres?"),
            (0.0009, "millimetres per second?"),
            (1.2e-5, "latitude and longitude?"),
            (0.0175, "degrees per second?"),
            (0.1, "per minute"),
            (6.3, "turns per second"),
            (0.27, "km/h"),
            (0.51, "diameter"),
            (2.1, "diameter"),
            (0.7, "wheel_radius"),
        ] {
            assert!(wrong_way(ratio, 0.1).contains(word), "{ratio}: {}", wrong_way(ratio, 0.1));
        }
        assert!(wrong_way(0.001, 1.1).contains("is time in seconds?"));
        assert_eq!(usual_way(0.7), None);
        for (ratio, word) in [
            (57.0, "heading in degrees"),
            (-57.0, "heading in degrees"),
            (-0.0175, "yaw rate"),
            (-1.02, "swapped"),
            (-0.4, "swapped"),
            (0.0175, "yaw rate"),
            (0.6, "track_width"),
        ] {
            assert!(wrong_turn(ratio).contains(word), "{ratio}: {}", wrong_turn(ratio));
        }
        assert_eq!((usual_turn(-0.4), usual_turn(0.6), usual_turn(1.0)), (None, None, None));
    }
}
