//! Where model and measurement disagree: constraint by constraint, window by window.

use crate::discrepancy::estimation::noise_model::Component;
use crate::discrepancy::estimation::problem::Problem;
use crate::discrepancy::initial_state::heading_from_path::{MeasuredPose, PathHeading};
use crate::discrepancy::initial_state::pose::pose_of;
use crate::discrepancy::record::angle::wrapped;
use crate::discrepancy::record::run_record::Record;
use crate::discrepancy::record::sensor_noise::Noise;
use crate::discrepancy::report::ResidualPicture;
use crate::discrepancy::shooting::linearised_window::LinearisedWindow;
use crate::discrepancy::shooting::window_integration;
use crate::discrepancy::shooting::windows;
use crate::discrepancy::shooting::windows::Segment;
use crate::error::Result;
use crate::model::Model;
use crate::model::freedom::Freedom;
use crate::model::observation::{HEADING, POSITION, TRAILER};
use crate::model::state::{JUMPS, Jump, OF_POSES, jumps, nodes};

/// A stretch shorter than this share of the longest one is no motion to take a heading from.
const HARDLY: f64 = 0.1;

/// What one window says.
#[derive(Clone, Debug)]
pub(crate) struct Window {
    /// The row at which it begins.
    row: usize,
    middle: f64,
    pub span: [f64; 2],
    /// Violated rates: along, across, yaw, trailers.
    pub rates: Vec<f64>,
    /// Mean speed, m/s, and yaw rate, rad/s, measured.
    pub speed: f64,
    pub yaw: f64,
}

/// Violated rates of a run under a model, restarted in every window from smoothed measurements.
///
/// The rate of a constraint is the distance (or angle) by which the model misses the next smoothed pose, along the
/// body, across it and in yaw, over the duration of the window.
#[derive(Clone, Debug, Default)]
pub struct ConstraintResiduals {
    pub(crate) run: String,
    pub(crate) windows: Vec<Window>,
    /// Standard deviation that noise gives each rate, in the order of [`JUMPS`]; none without a window.
    pub(crate) noise: Vec<f64>,
}

impl ConstraintResiduals {
    /// The violation along a run.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn of(model: &Model, record: &Record, noise: &Noise) -> Result<Self> {
        let equations = model.equations(&[])?;
        let plan = windows::plan(std::slice::from_ref(record));
        let at = |s: &Segment| s.windows.iter().map(|w| MeasuredPose::at(&equations, record, w.start)).collect();
        let placed: Vec<Vec<MeasuredPose>> = plan.iter().map(at).collect();
        let starts = placed.iter().map(|s| s.iter().map(|p| pose_of(&equations, &p.measured)).collect()).collect();
        let linear = window_integration::linearise(&equations, &[], std::slice::from_ref(record), &plan, &starts);
        let mut found = Self { run: record.name.clone(), ..Self::default() };
        let Some(linear) = linear else { return Ok(found) };
        let far = placed.iter().flatten().map(MeasuredPose::reach).fold(0.0, f64::max);
        let mut courses = Vec::new();
        for ((segment, lines), placed) in plan.iter().zip(&linear).zip(&placed) {
            // Along and across a vehicle that shows no heading is nowhere.
            let shown = |k: usize| shows_heading(&placed[k], record, far);
            let judged = |k: usize, l: &LinearisedWindow| !l.mismatch.is_empty() && shown(k) && shown(k + 1);
            for (k, line) in lines.iter().enumerate().filter(|(k, l)| judged(*k, l)) {
                let t = |k: usize| record.time[segment.windows[k].start];
                let window =
                    window(line, record.freedom(), [t(k), t(k + 1)], [&placed[k].measured, &placed[k + 1].measured]);
                found.windows.push(Window { row: segment.windows[k].start, ..window });
                courses.extend(placed[k].course.as_ref().map(PathHeading::share));
            }
        }
        let speeds = variances(placed.iter().flatten());
        found.noise = found.noise_of(record, &plan, &noise.variance, (&courses, &speeds));
        if noise.correlation_time > 1.0 {
            let shown = found.noise_shown();
            found.noise.iter_mut().zip(shown).for_each(|(noise, shown)| *noise = noise.max(shown));
        }
        Ok(found)
    }

    /// Smoothing noise at both ends of a window; a heading off by δ moves the end across by v·W·δ. One that is taken from
    /// the path has the noise of its positions, by the shares of `courses`.
    fn noise_of(
        &self,
        record: &Record,
        plan: &[Segment],
        noise: &[f64],
        (courses, speeds): (&[f64], &[f64]),
    ) -> Vec<f64> {
        let Some(segment) = plan.first().filter(|_| !self.windows.is_empty()) else { return vec![] };
        let count = self.windows.len() as f64;
        let i = segment.windows[segment.windows.len() / 2].start;
        let share: f64 = record.smoothing(i).iter().map(|(_, w)| w * w).sum();
        let duration = self.windows.iter().map(|w| w.span[1] - w.span[0]).sum::<f64>() / count;
        let speed = self.rms_of(|w| w.speed);
        let turned = match record.has_heading() {
            true => share * noise[HEADING],
            false => noise[POSITION] * courses.iter().sum::<f64>() / count,
        };
        let rate = |variance: f64| (2.0 * variance).sqrt() / duration;
        let towed = noise.get(TRAILER).copied().unwrap_or(0.0);
        let [position, heading, trailer] = [share * noise[POSITION], turned, share * towed].map(rate);
        let mut found = vec![position, position.hypot(turned.sqrt() * speed), heading, trailer.hypot(heading)];
        found.resize(JUMPS.len(), 0.0);
        // A speed that is off at a start moves the end of the window, and the speed there.
        let poses = nodes(record.trailers()).len();
        for (k, node) in nodes(record.freedom().clone()).enumerate().skip(poses) {
            let off = speeds.get(k).copied().unwrap_or(0.0);
            if let Some(of_pose) = found[..OF_POSES].get_mut(node.jump - OF_POSES) {
                *of_pose = of_pose.hypot(off.sqrt());
            }
            found[node.jump] = (2.0 * off).sqrt() / duration;
        }
        found
    }

    /// What the windows themselves show of the noise of their poses, whatever its colour: where a window ends in error
    /// the next one begins in it, so that noise makes neighbours miss in opposite ways, cov(w_k, w_{k+1}) = −½·var(w),
    /// and what really happens does not. A heading that is off at a start moves the end across.
    fn noise_shown(&self) -> Vec<f64> {
        let mut shown = self.noise_between();
        let duration = self.rms_of(|w| w.span[1] - w.span[0]);
        let turned = shown[2] * duration / 2.0_f64.sqrt();
        shown[1] = shown[1].hypot(turned * self.rms_of(|w| w.speed));
        shown
    }

    fn noise_between(&self) -> Vec<f64> {
        let follows = |w: &[Window]| w[1].span[0] == w[0].span[1];
        let pairs: Vec<&[Window]> = self.windows.windows(2).filter(|w| follows(w)).collect();
        let shown = |c: usize| {
            let products = pairs.iter().filter(|_| self.has(c)).map(|w| w[0].rates[c] * w[1].rates[c]);
            (-2.0 * products.sum::<f64>() / pairs.len().max(1) as f64).max(0.0).sqrt()
        };
        (0..self.constraints().max(OF_POSES)).map(shown).collect()
    }

    /// The violations along several runs, beside jumps that are known.
    ///
    /// # Errors
    /// When the model's formulas are malformed.
    pub fn beside_jumps(model: &Model, runs: &[Record], noise: &Noise, jumps: &[Component]) -> Result<Vec<Self>> {
        runs.iter().map(|r| Ok(Self::of(model, r, noise)?.beside(jumps))).collect()
    }

    /// The same beside the jumps that are known to be there, which are noise as well.
    fn beside(mut self, jumps: &[Component]) -> Self {
        let duration = self.rms_of(|w| w.span[1] - w.span[0]).max(f64::MIN_POSITIVE);
        self.noise.iter_mut().zip(jumps).for_each(|(noise, jump)| *noise = noise.hypot((jump.known / duration).sqrt()));
        self
    }

    /// Root mean square of something over the windows.
    pub(crate) fn rms_of(&self, what: impl Fn(&Window) -> f64) -> f64 {
        let squares: f64 = self.windows.iter().map(|w| what(w).powi(2)).sum();
        (squares / self.windows.len().max(1) as f64).sqrt()
    }

    pub(crate) fn constraints(&self) -> usize {
        self.windows.first().map_or(0, |w| w.rates.len().min(JUMPS.len()))
    }

    /// Whether the vehicle has a component of the process noise.
    pub(crate) fn has(&self, c: usize) -> bool {
        self.windows.first().is_some_and(|w| w.rates.get(c).is_some_and(|rate| !rate.is_nan()))
    }

    /// Sums over the windows of the squares of the violated rates beyond their noise, of the measured motion and of the
    /// noise: along and across in m²/s², yaw in rad²/s².
    pub fn against_motion(&self) -> [[f64; 3]; 2] {
        let count = self.windows.len() as f64;
        let squares = |miss: f64, motion: f64, noise: f64| {
            let [miss, motion, noise] = [miss, motion, noise].map(|rms| count * rms * rms);
            [(miss - noise).max(0.0), motion, noise]
        };
        let noise = |c: usize| self.noise.get(c).copied().unwrap_or(0.0);
        let missed = self.rms_of(|w| w.rates[0].hypot(w.rates[1]));
        [
            squares(missed, self.rms_of(|w| w.speed), noise(0).hypot(noise(1))),
            squares(self.rms_of(|w| w.rates[2]), self.rms_of(|w| w.yaw), noise(2)),
        ]
    }

    /// Start of the first and end of the last window that is judged, s.
    pub(crate) fn span(&self) -> Option<[f64; 2]> {
        Some([self.windows.first()?.span[0], self.windows.last()?.span[1]])
    }

    /// The violated rates of a constraint, window by window.
    pub(crate) fn rates(&self, c: usize) -> Vec<f64> {
        self.windows.iter().filter_map(|w| w.rates.get(c).copied()).collect()
    }

    /// How many windows are judged.
    pub fn count(&self) -> usize {
        self.windows.len()
    }

    /// This one and another of the same run in the windows that both have: which windows show a heading that nothing
    /// measures may hang on the model.
    pub fn in_common(&self, other: &ConstraintResiduals) -> [ConstraintResiduals; 2] {
        let of = |a: &ConstraintResiduals, b: &ConstraintResiduals| {
            let both = a.windows.iter().filter(|w| b.windows.binary_search_by_key(&w.row, |o| o.row).is_ok());
            ConstraintResiduals { windows: both.cloned().collect(), ..a.clone() }
        };
        [of(self, other), of(other, self)]
    }

    /// The longest stretch in which the vehicle moves sideways of where its model says by more than a share of its
    /// speed: the run, when it begins, when it ends, in s.
    pub fn slide(&self, share: f64) -> Option<(&str, [f64; 2])> {
        let typical = self.rms_of(|w| w.speed);
        let slides = |w: &&Window| {
            let across = w.rates[1].abs();
            across > share * w.speed && w.speed > 0.3 * typical && across > 5.0 * self.noise[1]
        };
        let stretches = self.windows.split(|w| !slides(&w)).filter(|s| !s.is_empty());
        let spans = stretches.map(|s| [s[0].span[0], s[s.len() - 1].span[1]]);
        let longest = spans.max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])))?;
        Some((&self.run, longest))
    }

    /// The pictures of each constraint, before and after.
    pub fn pictures(&self, after: &ConstraintResiduals) -> Vec<ResidualPicture> {
        let [before, after] = self.in_common(after);
        let rates = |v: &ConstraintResiduals, c: usize| v.windows.iter().map(|w| w.rates[c]).collect::<Vec<f64>>();
        let picture = |c: usize| ResidualPicture {
            constraint: JUMPS[c].place.into(),
            run: self.run.clone(),
            unit: JUMPS[c].rate_unit.into(),
            time: before.windows.iter().map(|w| w.middle).collect(),
            before: rates(&before, c),
            after: rates(&after, c),
            noise: self.noise[c],
        };
        (0..before.constraints()).filter(|c| before.has(*c)).map(picture).collect()
    }

    /// Sum of squared violations of a constraint beyond what noise makes of them.
    pub fn excess_power(&self, place: &str) -> f64 {
        let Some(c) = JUMPS.iter().position(|jump: &Jump| jump.place == place) else { return 0.0 };
        if !self.has(c) {
            return 0.0;
        }
        self.windows.iter().map(|w| w.rates[c].powi(2) - self.noise[c].powi(2)).sum()
    }

    /// Root mean square of a violated rate over all windows of some runs, and of what noise makes of it; `None` where no
    /// run has the constraint.
    pub fn rms(all: &[ConstraintResiduals], c: usize) -> Option<(f64, f64)> {
        let of = || all.iter().filter(|v| v.has(c));
        let count = of().map(|v| v.windows.len()).sum::<usize>() as f64;
        let rate: f64 = of().flat_map(|v| &v.windows).map(|w| w.rates[c].powi(2)).sum();
        let noise: f64 = of().map(|v| v.windows.len() as f64 * v.noise[c].powi(2)).sum();
        (count > 0.0).then(|| ((rate / count).sqrt(), (noise / count).sqrt()))
    }

    /// Sum of squared violations of each constraint in units of their noise.
    pub(crate) fn chi_squared(&self, c: usize) -> f64 {
        self.windows.iter().map(|w| (w.rates[c] / self.noise[c]).powi(2)).sum()
    }
}

/// Whether a heading is measured, or told by the path: not where the vehicle hardly moves against the rest of the run.
fn shows_heading(placed: &MeasuredPose, record: &Record, far: f64) -> bool {
    placed.course.as_ref().is_none_or(|c| c.is_told(record) && c.reach > HARDLY * far)
}

/// The mean variances of pose and speeds where speeds are not measured; none where there are no such speeds.
fn variances<'p>(placed: impl Iterator<Item = &'p MeasuredPose>) -> Vec<f64> {
    let all: Vec<_> = placed.filter_map(|p| p.speeds.as_ref()).map(|fit| fit.covariance.diagonal()).collect();
    let size = all.first().map_or(0, |d| d.len());
    (0..size).map(|i| all.iter().map(|d| d[i]).sum::<f64>() / all.len() as f64).collect()
}

fn window(line: &LinearisedWindow, of: &Freedom, span: [f64; 2], [from, to]: [&[f64]; 2]) -> Window {
    // By component of the process noise; the first node that has it counts.
    let mut rates = vec![f64::NAN; jumps(of.clone()).len()];
    for (node, m) in nodes(of.clone()).zip(&line.mismatch) {
        if rates[node.jump].is_nan() {
            rates[node.jump] = m / line.duration;
        }
    }
    let travelled = (to[0] - from[0]).hypot(to[1] - from[1]);
    Window {
        row: 0,
        middle: 0.5 * (span[0] + span[1]),
        span,
        rates,
        speed: travelled / line.duration,
        yaw: wrapped(to[2] - from[2]) / line.duration,
    }
}

impl Problem {
    /// Violations along every run of a problem.
    ///
    /// # Errors
    /// As [`ConstraintResiduals::of`].
    pub fn violations(&self, model: &Model, noise: &Noise) -> Result<Vec<ConstraintResiduals>> {
        ConstraintResiduals::beside_jumps(model, &self.records, noise, self.variances.process())
    }
}

#[cfg(test)]
impl ConstraintResiduals {
    /// A run of windows of one second at 1 m/s without noise, given how far each ends across of where its model says.
    pub(crate) fn across(run: &str, missed: &[f64]) -> Self {
        let window = |(k, across): (usize, &f64)| Window {
            row: k,
            middle: k as f64 + 0.5,
            span: [k as f64, k as f64 + 1.0],
            rates: vec![0.0, *across, 0.0],
            speed: 1.0,
            yaw: 0.0,
        };
        Self {
            run: run.into(),
            windows: missed.iter().enumerate().map(window).collect(),
            noise: vec![0.0; JUMPS.len()],
        }
    }
}

/// The share of a constraint's violation on some data that is gone, noise apart and in the windows that both models
/// have: at most one, negative where it grew.
pub fn reduction(place: &str, before: &[ConstraintResiduals], after: &[ConstraintResiduals]) -> f64 {
    let both = before.iter().zip(after).map(|(before, after)| before.in_common(after).map(|v| v.excess_power(place)));
    let [before, after] = both.fold([0.0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]]);
    if before > 0.0 { (1.0 - after / before).clamp(-1.0, 1.0) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Windows of the poses' own errors miss in opposite ways one after another, what happens to the vehicle does not.
    #[test]
    fn noise_is_told_from_motion_by_its_neighbours() {
        // Errors of the poses, and the windows between them.
        let poses = [0.3, -0.1, 0.4, 0.2, -0.5, 0.1, -0.2, 0.6, -0.4, 0.0, 0.5, -0.3];
        let missed: Vec<f64> = poses.windows(2).map(|p| p[1] - p[0]).collect();
        let noise = ConstraintResiduals::across("", &missed).noise_between();
        let products: f64 = missed.windows(2).map(|w| w[0] * w[1]).sum();
        assert!((noise[1] - (-2.0 * products / 10.0).sqrt()).abs() < 1e-12 && noise[1] > 0.3, "{noise:?}");
        assert_eq!(ConstraintResiduals::across("", &[0.2; 12]).noise_shown(), [0.0; 4]);
        // Headings off by ±0.1, at 1 m/s for a second.
        let mut turned = ConstraintResiduals::across("", &[0.0; 12]);
        turned.windows.iter_mut().enumerate().for_each(|(k, w)| w.rates[2] = if k % 2 == 0 { 0.2 } else { -0.2 });
        let noise = turned.noise_shown();
        assert!((noise[2] - 0.08_f64.sqrt()).abs() < 1e-12 && (noise[1] - 0.2).abs() < 1e-12, "{noise:?}");
        // Windows on both sides of a hole have no pose in common.
        let mut apart = ConstraintResiduals::across("", &[0.5, -0.5, 0.5, -0.5]);
        apart.windows.iter_mut().for_each(|w| w.span = w.span.map(|t| 2.0 * t));
        apart.windows.iter_mut().for_each(|w| w.span[1] -= 1.0);
        assert_eq!(apart.noise_shown(), [0.0; 4]);
    }

    #[test]
    fn two_models_are_compared_in_the_windows_that_both_have() {
        let (mut before, mut after) =
            (ConstraintResiduals::across("", &[1.0; 6]), ConstraintResiduals::across("", &[0.5; 6]));
        before.windows.remove(1);
        after.windows.drain(3..5);
        let rows = |v: &ConstraintResiduals| v.windows.iter().map(|w| w.row).collect::<Vec<_>>();
        let [b, a] = before.in_common(&after);
        assert_eq!((rows(&b), rows(&a)), (vec![0, 2, 5], vec![0, 2, 5]));
        let pictures = before.pictures(&after);
        assert_eq!(pictures[1].time, [0.5, 2.5, 5.5]);
        assert_eq!((&pictures[1].before[..], &pictures[1].after[..]), (&[1.0; 3][..], &[0.5; 3][..]));
    }

    /// Four windows at first and eight later; what hardly moves, or is within its noise, slides nowhere.
    #[test]
    fn the_longest_slide_is_told_from_its_beginning_to_its_end() {
        let mut missed = [0.0; 30];
        missed[0..4].fill(0.8);
        missed[20..28].fill(-0.8);
        let mut violation = ConstraintResiduals::across("a.csv", &missed);
        violation.windows.iter_mut().for_each(|w| w.speed = 2.0);
        assert_eq!(violation.slide(0.3), Some(("a.csv", [20.0, 28.0])));
        assert_eq!(violation.slide(0.5), None);
        violation.noise[1] = 0.159;
        assert_eq!(violation.slide(0.3), Some(("a.csv", [20.0, 28.0])));
        violation.noise[1] = 0.161;
        assert_eq!(violation.slide(0.3), None);
        violation.noise[1] = 0.0;
        violation.windows[20..28].iter_mut().for_each(|w| w.speed = 0.5);
        assert_eq!(violation.slide(0.3), Some(("a.csv", [0.0, 4.0])));
    }
}
