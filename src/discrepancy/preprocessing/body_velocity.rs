//! The velocity of a body in its own axes, from the measured poses alone.

use crate::discrepancy::record::local_polynomial;
use crate::discrepancy::record::run_record::Record;
use crate::model::observation::{BODY_HEADING, PLACE};
use std::ops::Range;

/// Half width of the local parabola that velocities are taken from, s; as many steps where rows are further apart.
const HALF_WIDTH: f64 = 0.25;
const HALF_WIDTH_STEPS: f64 = 3.5;
/// Velocities are looked at no more often, s, and at so many times of a log at most.
const OFTEN: f64 = 0.05;
const MOST: f64 = 3000.0;
/// A speed this many times its own deviation tells a direction.
const OUT_OF_NOISE: f64 = 6.0;

/// The velocity of the tracked point in the axes of the measured heading.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BodyVelocity {
    /// s
    pub time: f64,
    /// Ahead and to the left, m/s.
    pub ahead: f64,
    pub left: f64,
    /// rad/s
    pub yaw_rate: f64,
    /// The deviation that the noise of the positions gives it, m/s.
    pub noise: f64,
}

impl BodyVelocity {
    /// The speed, m/s.
    pub fn speed(&self) -> f64 {
        self.ahead.hypot(self.left)
    }

    /// Whether the speed is out of the noise, and beyond a limit.
    pub fn tells(&self, limit: f64) -> bool {
        self.speed() > limit.max(OUT_OF_NOISE * self.noise)
    }
}

/// Velocities along a run, no more than so many.
pub(crate) fn velocities(record: &Record) -> Vec<BodyVelocity> {
    let segments = record.segments(0.0);
    let lasts: f64 = segments.iter().map(|s| record.time[s.end - 1] - record.time[s.start]).sum();
    let apart = OFTEN.max(lasts / MOST);
    let mut found: Vec<BodyVelocity> = vec![];
    for segment in segments {
        let mut next = f64::NEG_INFINITY;
        for i in segment.clone() {
            if record.time[i] < next {
                continue;
            }
            next = record.time[i] + apart;
            found.extend(velocity(record, &segment, i));
        }
    }
    found
}

/// The velocity at a row.
fn velocity(record: &Record, rows: &Range<usize>, i: usize) -> Option<BodyVelocity> {
    let half = HALF_WIDTH.max(HALF_WIDTH_STEPS * record.step());
    let slope = local_polynomial::parabola(&record.time, rows.clone(), i, half, 1)?;
    let value = local_polynomial::parabola(&record.time, rows.clone(), i, half, 0)?;
    let [x, y] = PLACE.map(|c| local_polynomial::value(&record.columns[c], &slope));
    let heading = &record.columns[BODY_HEADING];
    let (sin, cos) = local_polynomial::value(heading, &value).sin_cos();
    Some(BodyVelocity {
        time: record.time[i],
        ahead: x * cos + y * sin,
        left: y * cos - x * sin,
        yaw_rate: local_polynomial::value(heading, &slope),
        noise: record.position_noise() * slope.iter().map(|(_, w)| w * w).sum::<f64>().sqrt(),
    })
}
