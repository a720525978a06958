//! The slip angle: between where a body heads and where it goes, from the measured poses alone.

use super::body_velocity::{BodyVelocity, velocities};
use super::mounting::Mounting;
use crate::discrepancy::record::run_record::Record;
use crate::error::Result;
use crate::model::Model;
use crate::motion::{Stepper, initial_hidden};

/// A log with rows further apart tells no slip of tenths of a second, s.
const SLOWEST: f64 = 0.2;
/// With fewer velocities nothing is said.
const FEWEST: usize = 20;
/// A speed tells a direction from this share of the usual highest one on.
const SLOW_SHARE: f64 = 0.5;
/// Slip angles from here on are of a slide, rad: 30°.
const SLIDE: f64 = std::f64::consts::FRAC_PI_6;
/// A stretch of so much slip that is no bump, s.
const LONG_ENOUGH: f64 = 0.4;
/// A share of the time driven from which on a run is of a vehicle that slides.
const SHARE: f64 = 0.1;

/// A run of a vehicle that spins or slides sideways at large angles.
#[derive(Clone, Debug, PartialEq)]
pub struct SlidingRun {
    /// Name of the run.
    pub run: String,
    /// Start and end of the longest slide, s.
    pub span: [f64; 2],
    /// The mean slip angle in it, rad.
    pub angle: f64,
    /// The share of the time driven that it slides in.
    pub share: f64,
}

/// The run that slides longest, of those that slide for more than a small share of the time; none of a vehicle that may
/// move sideways, and where no heading is measured.
///
/// | symbol | meaning |
/// |---|---|
/// | u, w | velocity of the tracked point ahead and to the left, by a local parabola |
/// | o, a | heading offset and lever arm ahead, those that leave least slip in this run |
/// | β | atan2(\|u·sin o + w·cos o − a·φ'\|, \|u·cos o − w·sin o + b·φ'\|), the slip angle of the reference point |
///
/// So neither a mounting that the model does not know nor a creep sideways in proportion to the speed is a slide; and β is
/// judged by its own size, for a noise that is estimated from a slide hides it.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn longest_slide(model: &Model, records: &[Record]) -> Result<Option<SlidingRun>> {
    let mut found: Option<SlidingRun> = None;
    for record in records.iter().filter(|r| r.measures_heading() && r.step() <= SLOWEST) {
        let Some(slide) = sliding(record, model) else { continue };
        let length = |s: &SlidingRun| s.span[1] - s.span[0];
        if found.as_ref().is_none_or(|f| length(f) < length(&slide)) && points_ahead(model, record)? {
            found = Some(slide);
        }
    }
    Ok(found)
}

/// Whether a model's reference point moves the way its body points, whatever the inputs of a run.
fn points_ahead(model: &Model, record: &Record) -> Result<bool> {
    let equations = model.equations(&[])?;
    let mut stepper = Stepper::new(&equations, &record.signals, &[]);
    let (mut memory, pose) = (equations.workspace(&[]), vec![0.0; equations.visible]);
    let mut rates = vec![0.0; equations.n()];
    let (mut most, mut beside) = (0.0_f64, 0.0_f64);
    for i in record.rows.clone().step_by((record.rows.len() / 100).max(1)) {
        let u = stepper.inputs(record.time[i]).to_vec();
        let hidden = initial_hidden(&equations, &[], &u, &pose);
        equations.rates(&mut memory, &[pose.as_slice(), &hidden].concat(), &u, &mut rates);
        most = most.max(rates[0].abs());
        beside = beside.max(rates[1].abs());
    }
    Ok(most > 0.0 && beside <= 1e-9 * most)
}

/// The longest slide of a run, where it slides for more than a small share of the time.
fn sliding(record: &Record, model: &Model) -> Option<SlidingRun> {
    let all = velocities(record);
    let mut speeds: Vec<f64> = all.iter().map(BodyVelocity::speed).collect();
    if speeds.len() < FEWEST {
        return None;
    }
    let high = speeds.len() * 9 / 10;
    let limit = SLOW_SHARE * *speeds.select_nth_unstable_by(high, f64::total_cmp).1;
    let telling: Vec<BodyVelocity> = all.iter().filter(|v| v.tells(limit)).copied().collect();
    let mounting = Mounting::of(&telling, model)?;
    let own: Vec<BodyVelocity> = all.iter().map(|v| mounting.at_reference(v)).filter(|v| v.tells(limit)).collect();
    let angle = |v: &BodyVelocity| v.left.abs().atan2(v.ahead.abs());
    let slides = |v: &&BodyVelocity| angle(v) > SLIDE;
    let share = own.iter().filter(slides).count() as f64 / own.len().max(1) as f64;
    let stretches = own.chunk_by(|a, b| slides(&a) && slides(&b) && b.time - a.time <= record.gap());
    let length = |s: &&[BodyVelocity]| s[s.len() - 1].time - s[0].time;
    let longest = stretches.max_by(|a, b| length(a).total_cmp(&length(b)))?;
    (share > SHARE && length(&longest) >= LONG_ENOUGH).then(|| SlidingRun {
        run: record.name.clone(),
        span: [longest[0].time, longest[longest.len() - 1].time],
        angle: longest.iter().map(angle).sum::<f64>() / longest.len() as f64,
        share,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::unicycle;
    use crate::motion::Timing;

    /// A body that weaves about a lane at 5 m/s, and slides at an angle β from second to second; tracked by a sensor
    /// that is off the reference point and turned. It rolls at first, slides from 20 to 24 s and from 40 to 43 s.
    fn slider(beta: f64, arm: [f64; 2], turned: f64, noise: f64) -> Record {
        let (step, n) = (0.02, 3000);
        let slip = |t: f64| {
            let bump = |from: f64, to: f64| (4.0 * (t - from)).tanh() - (4.0 * (t - to)).tanh();
            0.5 * beta * (bump(20.0, 24.0) - bump(40.0, 43.0))
        };
        let (mut x, mut y, mut phi) = (0.0, 0.0, 0.3_f64);
        let mut columns = vec![vec![]; 3];
        let time: Vec<f64> = (0..n).map(|i| step * f64::from(i)).collect();
        for (i, t) in time.iter().enumerate() {
            let off = |c: usize| noise * ((i * i) as f64 + 7.0 * c as f64).sin();
            let (sin, cos) = phi.sin_cos();
            columns[0].push(x + arm[0] * cos - arm[1] * sin + off(0));
            columns[1].push(y + arm[0] * sin + arm[1] * cos + off(1));
            columns[2].push(phi + turned);
            let course = phi - slip(*t);
            x += 5.0 * step * course.cos();
            y += 5.0 * step * course.sin();
            phi += step * 0.5 * (0.4 * t).sin();
        }
        let inputs = [time.iter().map(|_| 10.0).collect(), time.iter().map(|t| 0.5 * (0.4 * t).sin()).collect()];
        Record::new("run", time, columns, true, &inputs, Timing::Sample)
    }

    fn found(record: Record) -> Option<SlidingRun> {
        longest_slide(&unicycle(&[]), &[record]).unwrap()
    }

    #[test]
    fn a_car_that_drifts_is_found_wherever_its_sensor_sits() {
        for (arm, turned, noise) in [([0.0; 2], 0.0, 1e-3), ([1.2, -0.4], 0.6, 1e-3), ([0.0; 2], 3.0, 0.02)] {
            let slide = found(slider(0.7, arm, turned, noise)).unwrap();
            assert!((slide.span[0] - 20.0).abs() < 0.5 && (slide.span[1] - 24.0).abs() < 0.5, "{slide:?}");
            assert!((slide.angle - 0.7).abs() < 0.1 && (slide.share - 7.0 / 60.0).abs() < 0.02, "{slide:?}");
        }
    }

    #[test]
    fn creep_and_a_turned_sensor_are_no_slide() {
        for (beta, turned) in [(0.14, 0.0), (0.3, 0.0), (0.0, 0.8), (0.0, std::f64::consts::PI), (0.14, -1.5)] {
            assert_eq!(found(slider(beta, [0.5, 0.2], turned, 1e-3)), None, "{beta} {turned}");
        }
    }

    /// Without a heading no slip is measured, and a vehicle that the model lets slide is not judged by it.
    #[test]
    fn only_a_vehicle_that_points_where_it_goes_is_judged() {
        let slides = slider(0.7, [0.0; 2], 0.0, 1e-3);
        let blind = Record::new(
            "run",
            slides.time.clone(),
            slides.columns[..2].to_vec(),
            false,
            &[vec![10.0; slides.time.len()], vec![0.1; slides.time.len()]],
            Timing::Sample,
        );
        assert_eq!(found(blind), None);
        let known = unicycle(&[("traverse-creep", &[0.1])]).fixed();
        assert_eq!(longest_slide(&known, &[slides]).unwrap(), None);
    }
}
