//! How a run was driven: its windows by the model, beside what was measured.

use crate::discrepancy::record::angle::wrapped;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::shooting::rollout::Rollout;
use crate::error::Result;
use crate::model::Model;
use crate::model::observation::BODY_HEADING;
use nalgebra::Complex;

/// Windows over which ways and turns are told, s.
const WINDOW: f64 = 1.0;
/// Turns within a window that are no turns, rad.
pub const STRAIGHT: f64 = 0.01;
/// Ways this many times as long as the noise of a position count.
const OUT_OF_NOISE: f64 = 20.0;
/// Directions that are less alike are not the same.
const UNLIKE: f64 = 0.9;
/// A mirror image comes so much nearer.
const MIRRORED: f64 = 0.1;

/// A window by the model and by the measurements.
pub struct Step {
    /// Forward way by the model, m.
    pub way: f64,
    /// Turn by the model, rad.
    pub turn: f64,
    measured_way: f64,
    measured_turn: f64,
    /// Displacements along x and y by the model and by the measurements, m.
    moved: [Complex<f64>; 2],
    /// How long it takes.
    pub seconds: f64,
}

/// What was measured over what the model drives.
#[derive(Clone, Copy, Debug)]
pub struct Ratios {
    /// Of the ways; none where the model does not move.
    pub way: Option<f64>,
    /// Of the turns; none where the model hardly turns or no heading is measured.
    pub turn: Option<f64>,
    /// Root mean square of the yaw rates by the model, rad/s.
    pub yaw_rate: f64,
    /// How alike the directions are, from 0 to 1, and how alike they would be if one of both were a mirror image.
    pub alike: [f64; 2],
}

/// The windows of a run that the model and the measurements say something of.
///
/// # Errors
/// When the model's formulas are malformed.
pub fn steps(model: &Model, record: &Record) -> Result<Vec<Step>> {
    Ok(steps_along(&Rollout::new(model, record)?))
}

/// The same of a model that is already put along the run.
pub(crate) fn steps_along(predictor: &Rollout) -> Vec<Step> {
    let (_, time) = predictor.rows();
    let step = |((from, to), [first, last]): ((usize, usize), [Vec<f64>; 2])| {
        let (a, b) = (predictor.measured(from), predictor.measured(to));
        let way = |p: &[f64], q: &[f64], heading: f64| (q[0] - p[0]) * heading.cos() + (q[1] - p[1]) * heading.sin();
        let chord = |p: &[f64], q: &[f64]| {
            let length = (q[0] - p[0]).hypot(q[1] - p[1]);
            let middle = p[BODY_HEADING] + 0.5 * wrapped(q[BODY_HEADING] - p[BODY_HEADING]);
            length.copysign(way(p, q, middle))
        };
        let step = Step {
            way: chord(&first, &last),
            turn: last[BODY_HEADING] - first[BODY_HEADING],
            measured_way: chord(&a, &b),
            measured_turn: b[BODY_HEADING] - a[BODY_HEADING],
            moved: [[&first, &last], [&a, &b]].map(|[from, to]| Complex::new(to[0] - from[0], to[1] - from[1])),
            seconds: time[to] - time[from],
        };
        [step.way, step.turn, step.measured_way].iter().all(|x| x.is_finite()).then_some(step)
    };
    let windows = predictor.windows(WINDOW);
    let ends = predictor.paths(&windows);
    windows.into_iter().zip(ends).filter_map(step).collect()
}

impl Ratios {
    /// Whether the vehicle moves where it points.
    pub fn follows(&self) -> bool {
        self.alike[0] > UNLIKE
    }

    /// Whether the path is the mirror image of what the headings say. Where the vehicle hardly turns nobody can tell.
    pub fn is_mirrored(&self) -> bool {
        let [direct, mirrored] = self.alike;
        !self.follows() && 1.0 - mirrored < MIRRORED * (1.0 - direct)
    }

    /// Of the windows of a run whose position has some noise.
    pub fn of(steps: &[Step], record: &Record, noise: f64) -> Self {
        let far = |s: &&Step| s.way.abs().max(s.measured_way.abs()) > OUT_OF_NOISE * noise;
        let sum = |f: &dyn Fn(&Step) -> f64| steps.iter().filter(far).map(f).sum::<f64>();
        let ways = [sum(&|s| s.measured_way.abs()), sum(&|s| s.way.abs())];
        let squares = steps.iter().map(|s| s.turn * s.turn).sum::<f64>();
        let turned = squares > steps.len() as f64 * STRAIGHT * STRAIGHT;
        let sizes = [0, 1].map(|k| sum(&|s| s.moved[k].norm_sqr()));
        let alike = |product: &dyn Fn(Complex<f64>, Complex<f64>) -> Complex<f64>| {
            let total: Complex<f64> = steps.iter().filter(far).map(|s| product(s.moved[0], s.moved[1])).sum();
            total.norm() / (sizes[0] * sizes[1]).sqrt().max(f64::MIN_POSITIVE)
        };
        let seconds = steps.iter().map(|s| s.seconds * s.seconds).sum::<f64>();
        Self {
            yaw_rate: (squares / seconds.max(f64::MIN_POSITIVE)).sqrt(),
            alike: [alike(&|model, measured| model.conj() * measured), alike(&|model, measured| model * measured)],
            way: (ways[1] > 0.0).then(|| ways[0] / ways[1]).filter(|r| r.is_finite()),
            turn: (turned && record.has_heading())
                .then(|| steps.iter().map(|s| s.turn * s.measured_turn).sum::<f64>() / squares),
        }
    }
}
