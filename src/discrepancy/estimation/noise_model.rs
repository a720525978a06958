//! The noise model: variances of the sensor (measurement noise) and of the jumps between windows (process noise).

use crate::model::freedom::Freedom;
use crate::model::{observation, state};
use std::sync::Arc;

/// A component of the noise with its variance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// Its name.
    pub id: &'static str,
    /// The unit of its standard deviation; of process noise over a second.
    pub unit: &'static str,
    /// The variance.
    pub variance: f64,
    /// Whether it is estimated with the parameters.
    pub is_estimated: bool,
    /// Of process noise the variance that the noise of the inputs is known to make.
    pub known: f64,
    /// Of process noise the component of the measurement noise that it is as large as at first.
    scale: Option<usize>,
}

impl Component {
    /// What it has beyond the variance that it is known to have.
    pub fn beyond_known(&self) -> f64 {
        (self.variance - self.known).max(0.0)
    }
}

/// Where a component of the measurement noise starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Its variance.
    pub variance: f64,
    /// Whether any run measures what has it.
    pub is_measured: bool,
    /// Whether the variance is known, and kept.
    pub is_known: bool,
}

/// The components of the noise: those of the sensor as [`observation`] declares them, then those of the process as
/// [`state`] does.
///
/// ```
/// use creepage::discrepancy::estimation::noise_model::NoiseModel;
/// use creepage::discrepancy::estimation::noise_model::Start;
/// // Positions to 2 mm, headings of the body and of a trailer to 1 mrad.
/// let of = |variance: f64| Start { variance, is_measured: true, is_known: false };
/// let noise = NoiseModel::starting(1, [4e-6, 1e-6, 1e-6].map(of));
/// let named = |id: &str| noise.components().iter().find(|c| c.id == id).unwrap().variance;
/// assert_eq!([named("position"), named("across"), named("yaw")], [4e-6, 4e-6, 1e-6]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct NoiseModel {
    components: Vec<Component>,
    /// How many of them are of the sensor.
    sensor: usize,
    /// The component of the process noise that each node jumps by.
    jumps: Arc<[usize]>,
}

/// Errors at the ends of windows that are less than this share of the measurement noise do not show.
const HIDDEN: f64 = 0.03;
/// The smallest jump that is told from none, as a share of the measurement noise: below it the likelihood is flat.
const LEAST_JUMP: f64 = 1e-3;

impl NoiseModel {
    /// The noise of a vehicle with so many trailers. Jumps begin as large as the noise they are told by; what nothing
    /// shows is not estimated.
    pub fn starting(of: impl Into<Freedom>, sensor: impl IntoIterator<Item = Start>) -> Self {
        let of: Freedom = of.into();
        let starts: Vec<Start> = sensor.into_iter().collect();
        let measured = observation::measurement_noise(of.clone()).zip(&starts).map(|(of, start)| Component {
            id: of.id,
            unit: of.unit,
            variance: start.variance,
            is_estimated: start.is_measured && !start.is_known,
            known: 0.0,
            scale: None,
        });
        let used: Vec<&str> = state::nodes(of.clone()).map(|node| state::JUMPS[node.jump].id).collect();
        let is_there = |jump: &state::Jump| used.contains(&jump.id);
        let jumps = state::jumps(of.clone()).iter().map(|jump| Component {
            id: jump.id,
            unit: jump.unit,
            variance: starts[jump.scale].variance,
            is_estimated: is_there(jump) && (jump.is_shown_by_path || starts[jump.scale].is_measured),
            known: 0.0,
            scale: Some(jump.scale),
        });
        let components: Vec<Component> = measured.chain(jumps).collect();
        let sensor = observation::measurement_noise(of.clone()).count();
        let jumps = state::nodes(of).map(|node| node.jump).collect();
        Self { components, sensor, jumps }
    }

    /// All components.
    pub fn components(&self) -> &[Component] {
        &self.components
    }

    /// Those of the measurement noise, as the outputs name them.
    pub fn measurement(&self) -> &[Component] {
        &self.components[..self.sensor]
    }

    /// Those of the quantities measured beside the pose, of so many.
    pub fn of_quantities(&self, quantities: usize) -> &[Component] {
        &self.components[self.sensor - quantities..self.sensor]
    }

    /// Those of the process noise, as the nodes name them.
    pub fn process(&self) -> &[Component] {
        &self.components[self.sensor..]
    }

    /// As [`NoiseModel::measurement`], to be changed.
    pub fn measurement_mut(&mut self) -> &mut [Component] {
        &mut self.components[..self.sensor]
    }

    /// As [`NoiseModel::process`], to be changed.
    pub fn process_mut(&mut self) -> &mut [Component] {
        &mut self.components[self.sensor..]
    }

    /// The variance for each second of the jump of a node.
    pub fn jump(&self, node: usize) -> f64 {
        self.components[self.sensor + self.jumps[node]].variance
    }

    /// Every jump as large as the measurement noise it is told by.
    pub fn with_jumps_of_noise(mut self) -> Self {
        for k in self.sensor..self.components.len() {
            if let Some(noise) = self.noise_below(k) {
                self.components[k].variance = noise;
            }
        }
        self
    }

    /// Without a component of the process noise beyond the variance it is known to have, as far as that is told from none.
    pub fn without_jump(self, c: usize) -> Self {
        self.with_share_of_jump(c, 0.0)
    }

    /// With a share of what a component of the process noise has beyond the variance it is known to have, as far as that is
    /// told from none.
    pub fn with_share_of_jump(mut self, c: usize, share: f64) -> Self {
        let k = self.sensor + c;
        let jump = self.components[k];
        let told = (jump.known.min(jump.variance) + share * jump.beyond_known()).max(self.least(k));
        self.components[k].variance = if jump.known > 0.0 { told.min(jump.variance) } else { told };
        self
    }

    /// Whether errors of the nodes at the ends of windows, of these variances by component, are lost in the measurement noise.
    pub fn hides(&self, variances: &[f64]) -> bool {
        let hidden =
            |(c, v): (usize, &f64)| self.noise_below(self.sensor + c).is_some_and(|noise| *v < HIDDEN * HIDDEN * noise);
        variances.iter().enumerate().all(hidden)
    }

    /// Knowing the variances of the process noise that the noise of the inputs makes.
    pub fn knowing(mut self, known: impl IntoIterator<Item = f64>) -> Self {
        self.process_mut().iter_mut().zip(known).for_each(|(jump, known)| jump.known = known);
        self
    }

    /// One component multiplied by e^step, a jump bounded from below.
    pub(crate) fn moved_by(&self, k: usize, step: f64) -> Self {
        let mut moved = self.clone();
        moved.components[k].variance = (self.components[k].variance * step.exp()).max(self.least(k));
        moved
    }

    /// Whether two sets differ by no more than their estimation could tell.
    pub fn close_to(&self, other: &NoiseModel) -> bool {
        let pairs = self.components.iter().zip(&other.components);
        pairs.into_iter().all(|(a, b)| (a.variance / b.variance).ln().abs() < 0.2)
    }

    /// The smallest variance of a component.
    fn least(&self, k: usize) -> f64 {
        self.noise_below(k).map_or(f64::NEG_INFINITY, |noise| noise * LEAST_JUMP * LEAST_JUMP)
    }

    /// The variance of the measurement noise that a jump is told by.
    fn noise_below(&self, k: usize) -> Option<f64> {
        self.components[k].scale.map(|scale| self.components[scale].variance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::noise_of;

    fn start(variance: f64, is_measured: bool, is_known: bool) -> Start {
        Start { variance, is_measured, is_known }
    }

    fn estimated(noise: &NoiseModel) -> Vec<&str> {
        noise.components().iter().filter(|c| c.is_estimated).map(|c| c.id).collect()
    }

    /// What is known stays, of the rest there is a share.
    #[test]
    fn a_jump_keeps_what_is_known_of_it() {
        let of = |known: f64, share: f64| {
            let noise = noise_of(0, [1e-6; 2], &[1e-6, 1e-4, 1e-4]).knowing([0.0, 0.0, known]);
            noise.with_share_of_jump(2, share).process()[2].variance
        };
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
        close(of(0.0, 0.1), 1e-5);
        close(of(4e-5, 0.1), 4.6e-5);
        // What is known to make more than there is makes all.
        close(of(2e-4, 0.1), 1e-4);
    }

    /// A known variance is kept; yaw shows in the path where no heading is measured, a trailer's heading does not.
    #[test]
    fn what_the_runs_show_is_estimated() {
        let all = [start(4.0, true, false), start(1.0, true, false), start(0.25, true, false)];
        let names = ["position", "heading", "trailer-heading", "along", "across", "yaw", "trailer"];
        assert_eq!(estimated(&NoiseModel::starting(2, all)), names);
        let places = [start(4.0, true, true), start(1.0, false, false), start(0.25, false, false)];
        assert_eq!(estimated(&NoiseModel::starting(1, places)), ["along", "across", "yaw"]);
    }

    #[test]
    fn a_jump_is_told_by_its_noise() {
        let start = [start(4.0, true, false), start(1.0, true, false), start(0.25, true, false)];
        let noise = NoiseModel::starting(2, start);
        assert_eq!([0, 1, 2, 3, 4].map(|node| noise.jump(node)), [4.0, 4.0, 1.0, 0.25, 0.25]);
        let calm = noise.clone().without_jump(3);
        assert!((calm.jump(4) / 0.25e-6 - 1.0).abs() < 1e-12 && calm.jump(3) == calm.jump(4));
        // Bounded from below, and the noise itself is not.
        assert_eq!((calm.moved_by(6, -1.0), calm.moved_by(6, 1.0) == calm), (calm.clone(), false));
        assert!(calm.moved_by(0, -1.0).measurement()[0].variance < 1.5);
        assert_eq!(calm.with_jumps_of_noise(), noise);
        // Of along, across and yaw: a hundredth of the noise they are told by, or a tenth.
        assert!(noise.hides(&[4e-4, 4e-4, 1e-4, 0.0]) && !noise.hides(&[4e-4, 4e-4, 1e-2, 0.0]));
        assert!(noise.close_to(&noise.moved_by(5, 0.19)) && !noise.close_to(&noise.moved_by(5, 0.21)));
    }
}
