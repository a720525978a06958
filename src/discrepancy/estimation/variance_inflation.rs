//! Variance inflation: how many values of a fit say what one independent value would (effective sample size; Geyer, 1992).

use super::fit::Fit;
use crate::effects::Applied;

impl Fit {
    /// How many values say what one independent value would: rows that are alike, times windows that are alike.
    pub fn variance_inflation(&self) -> f64 {
        self.noise_correlation_time * self.residual_correlation_time
    }

    /// The same of one value: windows are alike for it as far as the jumps that it is told beside are.
    pub fn inflation_of(&self, value: usize) -> f64 {
        let of_windows = self.value_correlation_times.get(value).copied().unwrap_or(self.residual_correlation_time);
        self.noise_correlation_time * of_windows
    }

    /// The same of what a smaller fit lacks, the most of its values.
    pub fn inflation_beside(&self, smaller: &Fit) -> f64 {
        let is_new = |e: &Applied| !smaller.model.free_effects().any(|other| other.same_as(e));
        let owners = self.model.free_effects().flat_map(|e| std::iter::repeat_n(is_new(e), e.values.len()));
        let new = owners.enumerate().filter(|(_, is_new)| *is_new).map(|(i, _)| self.inflation_of(i));
        new.reduce(f64::max).unwrap_or_else(|| self.variance_inflation())
    }

    /// The same of the covariance of two values.
    pub fn joint_inflation(&self, i: usize, j: usize) -> f64 {
        (self.inflation_of(i) * self.inflation_of(j)).sqrt()
    }

    /// The covariance of two values by the noise alone, alike values counted once; `None` where the data leave a direction
    /// open.
    pub fn covariance_of(&self, i: usize, j: usize) -> Option<f64> {
        self.covariance.as_ref().map(|c| c[(i, j)] * self.joint_inflation(i, j))
    }

    /// The variance of a value by the noise alone, alike values counted once; `None` where the data leave a direction open.
    pub fn variance(&self, value: usize) -> Option<f64> {
        self.covariance_of(value, value)
    }
}

#[cfg(test)]
mod tests {
    use crate::discrepancy::estimation::fit::Effort;
    use crate::discrepancy::estimation::problem::Problem;
    use crate::discrepancy::fixtures::{equations, logged, unicycle};

    /// A slow sideways motion that no effect explains makes a creep sideways less certain, and says nothing of the yaw rate.
    #[test]
    fn windows_that_are_alike_sideways_are_not_for_the_yaw_rate() {
        let time = (0..1800).map(|i| 0.05 * f64::from(i)).collect::<Vec<f64>>();
        let (exact, p) = equations(&[("yaw-rate-scale", &[0.05])]);
        let mut record =
            logged((&exact, &p), time, [&|t| 2.0 + (0.7 * t).sin(), &|t| 0.3 * (0.5 * t).cos()], &[0.0; 3], 1e-3);
        let mut off = [0.0; 2];
        for i in 1..record.time.len() {
            let (heading, across) = (record.columns[2][i], 0.002 * (0.2 * record.time[i]).sin());
            off = [off[0] - across * heading.sin(), off[1] + across * heading.cos()];
            record.columns[0][i] += off[0];
            record.columns[1][i] += off[1];
        }
        let problem = Problem::new(vec![record], None, None);
        let fitted = |effects: &[(&str, &[f64])]| {
            let model = unicycle(effects);
            let starts = problem.starts(&model).unwrap();
            problem.fit(&model, &starts, &problem.variances, Effort::FULL).unwrap().unwrap()
        };
        let [yaw, creep]: [(&str, &[f64]); 2] = [("yaw-rate-scale", &[0.01]), ("traverse-creep", &[0.01])];
        let both = fitted(&[yaw, creep]);
        let [of_yaw, of_creep] = [0, 1].map(|i| both.inflation_of(i) / both.noise_correlation_time);
        assert!(both.residual_correlation_time > 3.0 && of_creep > 3.0, "{of_creep}");
        assert!(of_yaw < 1.5, "{of_yaw} of {}", both.residual_correlation_time);
        // What a smaller fit lacks has its own.
        let [no_yaw, no_creep] = [fitted(&[creep]), fitted(&[yaw])].map(|smaller| both.inflation_beside(&smaller));
        assert_eq!([no_yaw, no_creep], [both.inflation_of(0), both.inflation_of(1)]);
        assert_eq!(both.inflation_beside(&both), both.variance_inflation());
        let covariance = both.covariance_of(0, 1).unwrap() / both.covariance.as_ref().unwrap()[(0, 1)];
        assert!((covariance * covariance - no_yaw * no_creep).abs() < 1e-9 * no_yaw * no_creep);
    }
}
