//! The linear mixed model with nested random effects: robots and their runs, by restricted maximum likelihood (Patterson
//! and Thompson, Biometrika 58, 1971; Searle, Casella and McCulloch, *Variance Components*, 1992, chapter 6).
//!
//! ```text
//! yᵢⱼ = xᵢⱼ·β + uᵢ + wᵢⱼ + eᵢⱼ      u ~ N(0, τ²)    w ~ N(0, ω²)    e ~ N(0, sᵢⱼ²), sᵢⱼ known
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | yᵢⱼ, sᵢⱼ | what run j of robot i says, and how sure it is |
//! | xᵢⱼ, β | a one and the covariates of the run; the fleet's mean and their slopes |
//! | τ, ω | spread between robots, and between runs of a robot beyond what their own deviations explain |
//!
//! Every robot's covariance is diagonal but for one direction, so all sums are of the length of the data. Where no robot
//! has two runs τ and ω cannot be told apart, and ω is zero.

use nalgebra::{DMatrix, DVector};

/// What one run says.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// The robot, counted from zero.
    pub robot: usize,
    /// The run, counted through the whole fleet.
    pub run: usize,
    /// The value.
    pub value: f64,
    /// Its variance.
    pub variance: f64,
    /// A one, then the covariates.
    pub row: Vec<f64>,
}

/// A fitted model.
#[derive(Clone, Debug, PartialEq)]
pub struct MixedModel {
    /// The coefficients: the mean, then the slopes.
    pub coefficients: DVector<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
    /// τ.
    pub between: f64,
    /// ω.
    pub within: f64,
    /// −2 log restricted likelihood, up to a constant.
    pub deviance: f64,
    /// How many robots there are.
    pub robots: usize,
    /// A variance below which none is believed.
    least: f64,
}

/// Weighted sums over observations.
pub struct Sums {
    /// Σ w.
    pub weight: f64,
    /// Σ w·(y − x·β).
    pub residual: f64,
    /// Σ w·x.
    pub row: DVector<f64>,
}

impl MixedModel {
    /// The weight of an observation beside the others of its robot.
    pub fn weight(&self, o: &Observation) -> f64 {
        weight(o, self.within, self.least)
    }

    /// y − x·β.
    pub fn residual(&self, o: &Observation) -> f64 {
        o.value - self.predicted(o)
    }

    /// x·β.
    pub fn predicted(&self, o: &Observation) -> f64 {
        o.row.iter().zip(self.coefficients.iter()).map(|(x, b)| x * b).sum()
    }

    /// The variance of a·β.
    pub fn explained(&self, a: &DVector<f64>) -> f64 {
        (a.transpose() * &self.covariance * a)[0]
    }

    /// The sums over some observations.
    pub fn sums<'a>(&self, of: impl IntoIterator<Item = &'a Observation>) -> Sums {
        let none = Sums { weight: 0.0, residual: 0.0, row: DVector::zeros(self.coefficients.len()) };
        of.into_iter().fold(none, |sum, o| {
            let w = self.weight(o);
            Sums {
                weight: sum.weight + w,
                residual: sum.residual + w * self.residual(o),
                row: sum.row + w * o.design(),
            }
        })
    }
}

impl Observation {
    /// x.
    pub fn design(&self) -> DVector<f64> {
        DVector::from_column_slice(&self.row)
    }
}

fn weight(o: &Observation, within: f64, least: f64) -> f64 {
    1.0 / (o.variance + within * within).max(least)
}

/// The observations of each robot, one robot after another.
pub struct Groups<'a> {
    /// Observations of a robot each.
    pub all: Vec<Vec<&'a Observation>>,
    /// The middle of the values: subtracted before sums of squares are taken.
    centre: f64,
    /// The range in which standard deviations are sought.
    scale: f64,
    /// Coefficients.
    width: usize,
    /// A variance below which none is believed.
    least: f64,
}

/// Adds w·x·xᵀ to a matrix and w·y·x to a vector.
fn add_square(matrix: &mut DMatrix<f64>, vector: &mut DVector<f64>, w: f64, y: f64, x: &[f64]) {
    for j in 0..x.len() {
        vector[j] += w * y * x[j];
        (0..x.len()).for_each(|i| matrix[(i, j)] += w * x[i] * x[j]);
    }
}

/// Steps of a golden section: its bracket shrinks to 10⁻⁷ of what it was.
const STEPS: usize = 34;
const GOLDEN: f64 = 0.618_033_988_749_894_8;

impl<'a> Groups<'a> {
    /// Observations by robot; none where there are no more robots than coefficients.
    pub fn of(observations: &[&'a Observation]) -> Option<Self> {
        let mut by_robot: std::collections::BTreeMap<usize, Vec<&Observation>> = std::collections::BTreeMap::new();
        observations.iter().for_each(|o| by_robot.entry(o.robot).or_default().push(o));
        let width = observations.first()?.row.len();
        let mut values: Vec<f64> = observations.iter().map(|o| o.value).collect();
        values.sort_by(f64::total_cmp);
        let range = values[values.len() - 1] - values[0];
        let deviation = observations.iter().map(|o| o.variance.sqrt()).fold(0.0, f64::max);
        let scale = range.max(deviation);
        let sound = by_robot.len() > width && scale > 0.0 && scale.is_finite();
        sound.then(|| Self {
            all: by_robot.into_values().collect(),
            centre: values[values.len() / 2],
            scale,
            width,
            least: (1e-9 * scale).powi(2),
        })
    }

    /// Whether a robot has several runs, so that the spread within robots can be told.
    pub fn has_repeats(&self) -> bool {
        self.all.iter().any(|g| g.len() > 1)
    }

    /// Generalised least squares at given spreads; none where the coefficients are not determined.
    pub fn at(&self, between: f64, within: f64) -> Option<MixedModel> {
        let n = self.width;
        let (mut information, mut right) = (DMatrix::zeros(n, n), DVector::zeros(n));
        let (mut square, mut volume) = (0.0, 0.0);
        let tau2 = between * between;
        let mut rows = vec![0.0; n];
        for group in &self.all {
            let (mut total, mut values) = (0.0, 0.0);
            rows.fill(0.0);
            for o in group {
                let (w, y) = (weight(o, within, self.least), o.value - self.centre);
                add_square(&mut information, &mut right, w, y, &o.row);
                rows.iter_mut().zip(&o.row).for_each(|(sum, x)| *sum += w * x);
                square += w * y * y;
                volume -= w.ln();
                total += w;
                values += w * y;
            }
            let shrunk = tau2 / (1.0 + tau2 * total);
            add_square(&mut information, &mut right, -shrunk, values, &rows);
            square -= shrunk * values * values;
            volume += (tau2 * total).ln_1p();
        }
        let decomposed = information.cholesky()?;
        let mut coefficients = decomposed.solve(&right);
        let determinant = 2.0 * decomposed.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>();
        let deviance = volume + determinant + square - right.dot(&coefficients);
        coefficients[0] += self.centre;
        let covariance = decomposed.inverse();
        deviance.is_finite().then_some(MixedModel {
            coefficients,
            covariance,
            between,
            within,
            deviance,
            robots: self.all.len(),
            least: self.least,
        })
    }

    /// The best spread within robots beside a given one between them.
    fn profiled(&self, between: f64) -> Option<MixedModel> {
        if !self.has_repeats() {
            return self.at(between, 0.0);
        }
        smallest(self.scale, |within| self.at(between, within))
    }

    /// The fit of largest restricted likelihood.
    pub fn fitted(&self) -> Option<MixedModel> {
        smallest(self.scale, |between| self.profiled(between))
    }

    /// The 95 % interval of τ by the profile of the restricted likelihood.
    pub fn interval_between(&self, fitted: &MixedModel) -> [f64; 2] {
        let rises = |between: f64| self.profiled(between).is_none_or(|m| m.deviance - fitted.deviance > CHI_SQUARED_95);
        let edge = |mut inside: f64, mut outside: f64| {
            for _ in 0..STEPS {
                let middle = 0.5 * (inside + outside);
                if rises(middle) { outside = middle } else { inside = middle }
            }
            0.5 * (inside + outside)
        };
        let lower = if rises(0.0) { edge(fitted.between, 0.0) } else { 0.0 };
        let mut beyond = 2.0 * fitted.between.max(1e-3 * self.scale);
        while !rises(beyond) && beyond < 1e3 * self.scale {
            beyond *= 2.0;
        }
        [lower, edge(fitted.between, beyond)]
    }
}

/// The 95 % point of χ² with one degree of freedom.
const CHI_SQUARED_95: f64 = 3.841_458_820_694_124;

/// The model of least deviance over a standard deviation from zero to a largest one, by golden section.
fn smallest(largest: f64, model: impl Fn(f64) -> Option<MixedModel>) -> Option<MixedModel> {
    let deviance = |m: &Option<MixedModel>| m.as_ref().map_or(f64::INFINITY, |m| m.deviance);
    let [mut low, mut high] = [0.0, largest];
    let at = |low: f64, high: f64, share: f64| low + share * (high - low);
    let (mut left, mut right) = (model(at(low, high, 1.0 - GOLDEN)), model(at(low, high, GOLDEN)));
    for _ in 0..STEPS {
        if deviance(&left) <= deviance(&right) {
            high = at(low, high, GOLDEN);
            (right, left) = (left, model(at(low, high, 1.0 - GOLDEN)));
        } else {
            low = at(low, high, 1.0 - GOLDEN);
            (left, right) = (right, model(at(low, high, GOLDEN)));
        }
    }
    // A spread of zero is an end of the range that no section reaches.
    [model(0.0), left, right].into_iter().min_by(|a, b| deviance(a).total_cmp(&deviance(b))).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, Normal};

    fn drawn(seed: u64, robots: usize, runs: usize, [mean, between, within, error]: [f64; 4]) -> Vec<Observation> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = |std: f64| Normal::new(0.0, std).unwrap().sample(&mut rng);
        let mut all = vec![];
        for robot in 0..robots {
            let own = mean + normal(between);
            for _ in 0..runs {
                let value = own + normal(within) + normal(error);
                all.push(Observation { robot, run: all.len(), value, variance: error * error, row: vec![1.0] });
            }
        }
        all
    }

    fn fitted(all: &[Observation]) -> (MixedModel, [f64; 2]) {
        let of: Vec<&Observation> = all.iter().collect();
        let groups = Groups::of(&of).unwrap();
        let model = groups.fitted().unwrap();
        let interval = groups.interval_between(&model);
        (model, interval)
    }

    /// In a balanced design without known errors the restricted estimates are those of the analysis of variance.
    #[test]
    fn a_balanced_fleet_is_the_analysis_of_variance() {
        let all = drawn(1, 12, 4, [0.03, 0.006, 0.002, 1e-7]);
        let (model, _) = fitted(&all);
        let means: Vec<f64> = all.chunks(4).map(|g| g.iter().map(|o| o.value).sum::<f64>() / 4.0).collect();
        let mean = means.iter().sum::<f64>() / 12.0;
        let between = 4.0 * means.iter().map(|m| (m - mean).powi(2)).sum::<f64>() / 11.0;
        let within = all.chunks(4).zip(&means).flat_map(|(g, m)| g.iter().map(move |o| (o.value - m).powi(2)));
        let within = within.sum::<f64>() / 36.0;
        let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-5, "{a} {b}");
        near(model.coefficients[0], mean);
        near(model.within, within.sqrt());
        near(model.between, ((between - within) / 4.0).sqrt());
        near(model.covariance[(0, 0)], between / 48.0);
    }

    #[test]
    fn intervals_of_mean_and_spread_hold_the_truth_as_often_as_they_say() {
        let (mut mean, mut spread) = (0, 0);
        let of = 240;
        for seed in 0..of {
            let all = drawn(seed, 25, 1 + seed as usize % 3, [0.03, 0.006, 0.001, 0.0005]);
            let (model, [low, high]) = fitted(&all);
            // Student's t with 24 degrees of freedom.
            let half = 2.0639 * model.covariance[(0, 0)].sqrt();
            mean += usize::from((model.coefficients[0] - 0.03).abs() < half);
            spread += usize::from((low..high).contains(&0.006));
        }
        for held in [mean, spread] {
            let share = held as f64 / of as f64;
            assert!((0.92..0.98).contains(&share), "{share}");
        }
    }

    #[test]
    fn one_run_of_each_robot_tells_no_spread_within_and_equal_robots_none_between() {
        let (model, [low, _]) = fitted(&drawn(3, 20, 1, [0.0, 0.0, 0.0, 0.01]));
        assert_eq!((model.within, low), (0.0, 0.0));
        assert!(model.between < 0.006);
        assert!(Groups::of(&drawn(3, 1, 4, [0.0, 1.0, 1.0, 0.1]).iter().collect::<Vec<_>>()).is_none());
    }
}
