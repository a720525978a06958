//! A pose that a low-pass filter of first order has smoothed, as it was before the filter (Oppenheim and Willsky, *Signals and
//! Systems*, chapter 6: τ·ż + z = w), by Tustin's rule at the middle between two rows.

use super::run::{Apart, Deviations, Run};

/// Rows so many times as far apart as usual are the two sides of a gap, between which a filter is not followed.
const GAP: f64 = 3.0;

impl Run {
    /// The run with its pose as it was before a low-pass filter of first order.
    ///
    /// w = (z + z₋)/2 + τ·(z − z₋)/Δt
    ///
    /// | symbol | unit | meaning |
    /// |---|---|---|
    /// | z, z₋ | m, rad | a coordinate of the pose in a row, and in the row before |
    /// | w | m, rad | the same before the filter, at the middle of both times |
    /// | τ | s | `time_constant` |
    ///
    /// Valid for rows that are closer than τ. Noise of the rows grows by about √2·τ/Δt.
    pub fn before_pose_filter(&self, time_constant: f64) -> Self {
        let steps: Vec<f64> = self.time.windows(2).map(|w| w[1] - w[0]).collect();
        let mut sorted = steps.clone();
        sorted.sort_by(f64::total_cmp);
        let usual = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
        let rows: Vec<usize> = (0..steps.len()).filter(|i| steps[*i] <= GAP * usual).collect();
        let gain = |i: usize| time_constant / steps[i];
        let before =
            |z: &Vec<f64>| rows.iter().map(|i| (z[*i] + z[i + 1]) / 2.0 + gain(*i) * (z[i + 1] - z[*i])).collect();
        let grown = |std: &Vec<f64>| {
            let of = |i: &usize| ((0.5 + gain(*i)) * std[i + 1]).hypot((0.5 - gain(*i)) * std[*i]);
            rows.iter().map(of).collect()
        };
        let own = Apart {
            time: self.time.clone(),
            truth: self.path.clone(),
            truth_sha256: self.sha256.clone(),
            one_clock: true,
        };
        Self {
            time: rows.iter().map(|i| (self.time[*i] + self.time[i + 1]) / 2.0).collect(),
            x: before(&self.x),
            y: before(&self.y),
            heading: self.heading.as_ref().map(before),
            trailer_headings: self.trailer_headings.iter().map(before).collect(),
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
    pub(super) fn before_filter_of(self, sensor: &crate::files::Sensor) -> Self {
        match sensor.pose_filter {
            Some(time_constant) => self.before_pose_filter(time_constant),
            None => self,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::ModelFile;

    /// Of a ramp a filter is late by its time constant; of a straight drive at 1 m/s with a turn of 0.2 rad/s both show it.
    #[test]
    fn what_is_late_by_a_filter_is_on_time_before_it() {
        let file = |more: &str| {
            let text = format!("vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1.0\n{more}");
            ModelFile::parse(&text, "model.toml", &crate::model::known(crate::effects::all())).unwrap()
        };
        let mut log = String::from("time,x,y,heading,wheel_rate,yaw_rate,sx\n");
        // A row is missing for a second.
        for t in (0..20).chain(40..60).map(|i| 0.05 * f64::from(i)) {
            log += &format!("{t},{},0,{},1,0.2,0.01\n", t - 0.3, 0.2 * (t - 0.3));
        }
        let columns = "[columns]\nsigma_x = \"sx\"\n";
        let run = Run::parse("a.csv", &log, &file(&format!("{columns}[sensor]\npose_filter = 0.3\n"))).unwrap();
        assert_eq!((run.time.len(), run.inputs[0].len(), run.input_time().len()), (38, 40, 40));
        for (i, t) in run.time.iter().enumerate() {
            assert!((run.x[i] - t).abs() < 1e-9 && (run.heading.as_ref().unwrap()[i] - 0.2 * t).abs() < 1e-9, "{t}");
            assert_eq!(run.y[i], 0.0);
        }
        // √((½ + 6)² + (½ − 6)²) of the noise of a row.
        assert!((run.deviations.x.unwrap()[3] - 0.01 * 72.5_f64.sqrt()).abs() < 1e-12);
        assert_eq!(Run::parse("a.csv", &log, &file(columns)).unwrap().time.len(), 40);
    }

    #[test]
    fn a_filter_has_a_time_constant_above_zero() {
        for (given, says) in [("0", "above 0 s"), ("-1.0", "above 0 s"), ("\"a\"", "number")] {
            let text =
                format!("vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 1.0\n[sensor]\npose_filter = {given}\n");
            let error = ModelFile::parse(&text, "model.toml", &crate::model::known(crate::effects::all())).unwrap_err();
            assert!(error.to_string().contains(says), "{error}");
        }
    }
}
