//! A pose that a low-pass filter has smoothed, as it was before the filter (Oppenheim and Willsky, *Signals and Systems*,
//! chapter 6): a filter of first order in continuous time, τ·ż + z = w, by Tustin's rule at the middle between two rows, and
//! exponential smoothing of the rows, z = α·w + (1 − α)·z₋.

use super::run::{Apart, Deviations, Run};
use crate::files::{PoseFilter, Sensor};
use crate::numerics::usual_step;

/// Rows so many times as far apart as usual are the two sides of a gap, between which a filter is not followed.
const GAP: f64 = 3.0;

impl Run {
    /// The run with its pose as it was before a low-pass filter of first order.
    ///
    /// | filter | the pose before it | at |
    /// |---|---|---|
    /// | in continuous time | w = (z + z₋)/2 + τ·(z − z₋)/Δt | the middle of both rows |
    /// | exponential smoothing | w = z + (1 − α)/α·(z − z₋) | the later row |
    ///
    /// | symbol | unit | meaning |
    /// |---|---|---|
    /// | z, z₋ | m, rad | a coordinate of the pose in a row, and in the row before |
    /// | w | m, rad | the same before the filter |
    /// | τ, Δt | s | time constant, time between the rows |
    /// | α | 1 | share of the new pose |
    ///
    /// Valid for rows that are closer than τ. Noise of the rows grows by about √2·τ/Δt, or √2/α.
    pub fn before_pose_filter(&self, filter: PoseFilter) -> Self {
        let steps: Vec<f64> = self.time.windows(2).map(|w| w[1] - w[0]).collect();
        let usual = usual_step(&self.time).unwrap_or(0.0);
        let rows: Vec<usize> = (0..steps.len()).filter(|i| steps[*i] <= GAP * usual).collect();
        // Weights of a row and of the row before it.
        let weights = |i: usize| {
            let new = filter.weight(steps[i]);
            [new, 1.0 - new]
        };
        let before = |z: &Vec<f64>| {
            let of = |i: &usize| {
                let [new, old] = weights(*i);
                new * z[i + 1] + old * z[*i]
            };
            rows.iter().map(of).collect()
        };
        let grown = |std: &Vec<f64>| {
            let of = |i: &usize| {
                let [new, old] = weights(*i);
                (new * std[i + 1]).hypot(old * std[*i])
            };
            rows.iter().map(of).collect()
        };
        // The times themselves, and what is measured beside the pose and has no filter.
        let there = |column: &Vec<f64>| {
            let of = |i: &usize| match filter {
                PoseFilter::Continuous(_) => (column[*i] + column[i + 1]) / 2.0,
                PoseFilter::OfRows(_) => column[i + 1],
            };
            rows.iter().map(of).collect()
        };
        let (time, truth_sha256) = (self.time.clone(), self.sha256.clone());
        let own = Apart { time, truth: self.path.clone(), truth_sha256, one_clock: true };
        Self {
            time: there(&self.time),
            x: before(&self.x),
            y: before(&self.y),
            heading: self.heading.as_ref().map(before),
            trailer_headings: self.trailer_headings.iter().map(before).collect(),
            measured: self.measured.iter().map(there).collect(),
            deviations: Deviations {
                x: self.deviations.x.as_ref().map(grown),
                y: self.deviations.y.as_ref().map(grown),
                heading: self.deviations.heading.as_ref().map(grown),
            },
            apart: Some(self.apart.clone().unwrap_or(own)),
            ..self.clone()
        }
    }

    /// The pose before the filter of a model's sensor, where it has one.
    pub(super) fn before_filter_of(self, sensor: &Sensor) -> Self {
        match sensor.pose_filter {
            Some(filter) => self.before_pose_filter(filter),
            None => self,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::ModelFile;

    fn file(more: &str) -> crate::Result<ModelFile> {
        let text = format!("vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1.0\n{more}");
        ModelFile::parse(&text, "model.toml", &crate::model::known(crate::effects::all()))
    }

    /// Of a ramp a filter is late by its time constant, and smoothing by (1 − α)/α rows; the noise of a row grows.
    #[test]
    fn what_is_late_by_a_filter_is_on_time_before_it() {
        let mut log = String::from("time,x,y,heading,wheel_rate,yaw_rate,sx\n");
        // Rows are missing for a second.
        for t in (0..20).chain(40..60).map(|i| 0.05 * f64::from(i)) {
            log += &format!("{t},{},0,{},1,0.2,0.01\n", t - 0.3, 0.2 * (t - 0.3));
        }
        let columns = "[columns]\nsigma_x = \"sx\"\n";
        for (key, std) in
            [("pose_filter = 0.3", 72.5_f64.sqrt()), ("pose_smoothing = 0.14285714285714285", 85.0_f64.sqrt())]
        {
            let run = Run::parse("a.csv", &log, &file(&format!("{columns}[sensor]\n{key}\n")).unwrap()).unwrap();
            assert_eq!((run.time.len(), run.inputs[0].len(), run.input_time().len()), (38, 40, 40));
            for (i, t) in run.time.iter().enumerate() {
                assert!(
                    (run.x[i] - t).abs() < 1e-9 && (run.heading.as_ref().unwrap()[i] - 0.2 * t).abs() < 1e-9,
                    "{t}"
                );
                assert_eq!(run.y[i], 0.0);
            }
            assert!((run.deviations.x.unwrap()[3] - 0.01 * std).abs() < 1e-9, "{key}");
        }
        assert_eq!(Run::parse("a.csv", &log, &file(columns).unwrap()).unwrap().time.len(), 40);
    }

    #[test]
    fn a_filter_has_a_value_that_filters() {
        let refused = [
            ("pose_filter = 0", "above 0 s"),
            ("pose_filter = -1.0", "above 0 s"),
            ("pose_filter = \"a\"", "number"),
            ("pose_smoothing = 1", "between 0 and 1"),
            ("pose_smoothing = 0.0", "between 0 and 1"),
            ("pose_filter = 0.3\npose_smoothing = 0.5", "twice"),
        ];
        for (given, says) in refused {
            let error = file(&format!("[sensor]\n{given}\n")).unwrap_err();
            assert!(error.to_string().contains(says), "{error}");
        }
    }
}
