//! One parameter of a fleet: which covariates it depends on, which robots and runs differ, and what each robot has, shrunk
//! towards the others (best linear unbiased prediction, Robinson, Statistical Science 6, 1991).

use super::covariates::Covariate;
use super::linear_mixed_model::{Groups, MixedModel, Observation};
use super::outlying_robots::{Outlier, Unit, outliers, standing};
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, FisherSnedecor, StudentsT};
use std::collections::{BTreeMap, BTreeSet};

/// What one run says of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Said {
    /// The robot, counted from zero.
    pub robot: usize,
    /// The run, counted through the fleet.
    pub run: usize,
    /// The value.
    pub value: f64,
    /// Its standard deviation.
    pub std: f64,
}

/// Probabilities at which something is told of a fleet in which it is not so, over all parameters together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Levels {
    /// That a robot is called odd; the same for a run.
    pub odd: f64,
    /// That a parameter is said to depend on a tag.
    pub tag: f64,
}

/// A parameter of a fleet.
#[derive(Clone, Debug)]
pub struct ParameterModel {
    /// The mixed model of all that is not odd.
    pub model: MixedModel,
    /// The 95 % interval of the spread between robots.
    pub between: [f64; 2],
    /// The covariates it depends on, and the probability that each is by chance.
    pub covariates: Vec<(Covariate, f64)>,
    /// Robots that differ.
    pub odd_robots: Vec<Outlier>,
    /// Runs that differ from the others of their robot.
    pub odd_runs: Vec<Outlier>,
    /// The value of each robot at its last run.
    pub robots: BTreeMap<usize, RobotValue>,
    /// Whether a robot has several runs.
    pub has_repeats: bool,
}

/// The value of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RobotValue {
    /// What its own runs say.
    pub own: f64,
    /// The deviation of that.
    pub own_std: f64,
    /// What they say beside all others; of an odd robot its own.
    pub value: f64,
    /// The deviation of that.
    pub std: f64,
    /// How many deviations it lies from what the others predict.
    pub z: f64,
    /// The share of robots that lie as far by chance among those that do (Benjamini and Hochberg 1995).
    pub q_value: f64,
}

impl ParameterModel {
    /// The model of what runs say, with those of the covariates that it depends on; none where there are too few robots.
    pub fn of(said: &[Said], candidates: &[Covariate], levels: Levels) -> Option<Self> {
        let mut chosen: Vec<(usize, f64)> = vec![];
        let (mut odd_robots, mut odd_runs): (Vec<Outlier>, Vec<Outlier>) = (vec![], vec![]);
        // What is odd can look like a tag, and a tag like what is odd: each is asked again beside the other.
        for _ in 0..2 {
            let left = without(said, &odd_robots, &odd_runs);
            chosen = selected(&left, candidates, levels.tag);
            let rows = observations(said, candidates, &chosen);
            let all: Vec<&Observation> = rows.iter().collect();
            odd_runs = outliers(&all, Unit::Run, levels.odd);
            let kept: Vec<&Observation> =
                all.into_iter().filter(|o| odd_runs.iter().all(|x| x.which != o.run)).collect();
            odd_robots = outliers(&kept, Unit::Robot, levels.odd);
        }
        let rows = observations(said, candidates, &chosen);
        let sound = |o: &&Observation| odd_runs.iter().all(|x| x.which != o.run);
        let is_odd = |o: &Observation| odd_robots.iter().any(|x| x.which == o.robot);
        let (odd, even): (Vec<&Observation>, Vec<&Observation>) = rows.iter().filter(sound).partition(|o| is_odd(o));
        let groups = Groups::of(&even)?;
        let model = groups.fitted()?;
        let mut z = standing(&even, &model, Unit::Robot);
        z.extend(odd_robots.iter().map(|o| (o.which, o.z)));
        let q = q_values(&z, (model.robots - model.coefficients.len()) as f64);
        let odd = odd_robots.iter().map(|o| odd.iter().filter(|x| x.robot == o.which).copied().collect::<Vec<_>>());
        let known = |robot: usize| [&z, &q].map(|of| of.get(&robot).copied().unwrap_or(f64::NAN));
        let all = groups.all.iter().map(|g| (g.clone(), false)).chain(odd.map(|g| (g, true)));
        let robots = all.map(|(g, is_odd)| (g[0].robot, value(&g, &model, is_odd, known(g[0].robot)))).collect();
        Some(Self {
            between: groups.interval_between(&model),
            has_repeats: groups.has_repeats(),
            covariates: chosen.iter().map(|(c, p)| (candidates[*c].clone(), *p)).collect(),
            model,
            odd_robots,
            odd_runs,
            robots,
        })
    }

    /// The mean of the fleet, at the mean of its covariates.
    pub fn mean(&self) -> f64 {
        self.model.coefficients[0]
    }

    /// The deviation of the mean.
    pub fn mean_std(&self) -> f64 {
        self.model.covariance[(0, 0)].sqrt()
    }

    /// Half the 95 % interval of the mean: Student's t with a degree of freedom for each robot but one a coefficient.
    pub fn mean_half(&self) -> f64 {
        let degrees = (self.model.robots - self.model.coefficients.len()) as f64;
        StudentsT::new(0.0, 1.0, degrees).map_or(f64::NAN, |t| t.inverse_cdf(0.975)) * self.mean_std()
    }
}

/// What is said without odd robots and odd runs.
fn without(said: &[Said], robots: &[Outlier], runs: &[Outlier]) -> Vec<Said> {
    let kept = |s: &&Said| robots.iter().all(|o| o.which != s.robot) && runs.iter().all(|o| o.which != s.run);
    said.iter().filter(kept).copied().collect()
}

/// Rows of a design with a one and the chosen covariates.
fn observations(said: &[Said], candidates: &[Covariate], chosen: &[(usize, f64)]) -> Vec<Observation> {
    let row = |run: usize| chosen.iter().flat_map(move |(c, _)| candidates[*c].rows[run].iter().copied());
    let one = |s: &Said| Observation {
        robot: s.robot,
        run: s.run,
        value: s.value,
        variance: s.std * s.std,
        row: std::iter::once(1.0).chain(row(s.run)).collect(),
    };
    said.iter().map(one).collect()
}

/// The covariates that the values depend on, one after another by the F test beside those before.
fn selected(said: &[Said], candidates: &[Covariate], level: f64) -> Vec<(usize, f64)> {
    let mut chosen: Vec<(usize, f64)> = vec![];
    loop {
        let open = (0..candidates.len()).filter(|c| chosen.iter().all(|(k, _)| k != c));
        let tested = open.filter_map(|c| Some((c, chance(said, candidates, &chosen, c)?)));
        let best = tested.min_by(|a, b| a.1.total_cmp(&b.1));
        match best {
            Some((c, p)) if p * (candidates.len() as f64) < level => chosen.push((c, p)),
            _ => return chosen,
        }
    }
}

/// The probability that a covariate explains so much by chance.
fn chance(said: &[Said], candidates: &[Covariate], chosen: &[(usize, f64)], next: usize) -> Option<f64> {
    let with: Vec<(usize, f64)> = chosen.iter().copied().chain([(next, 0.0)]).collect();
    let rows = observations(said, candidates, &with);
    let all: Vec<&Observation> = rows.iter().collect();
    let model = Groups::of(&all)?.fitted()?;
    let (width, all_width) = (candidates[next].width(), model.coefficients.len());
    let first = all_width - width;
    let slopes = DVector::from_iterator(width, model.coefficients.iter().skip(first).copied());
    let covariance: DMatrix<f64> = model.covariance.view((first, first), (width, width)).into_owned();
    let f = slopes.dot(&covariance.cholesky()?.solve(&slopes)) / width as f64;
    let of_robots: BTreeSet<(usize, Vec<u64>)> =
        said.iter().map(|s| (s.robot, candidates[next].rows[s.run].iter().map(|v| v.to_bits()).collect())).collect();
    // A tag that no robot changes is asked of robots, any other of runs.
    let degrees = match of_robots.len() == model.robots {
        true => model.robots - all_width,
        false => said.len().saturating_sub(model.robots + width),
    };
    let distribution = FisherSnedecor::new(width as f64, degrees.max(1) as f64).ok()?;
    Some(if f.is_finite() { distribution.sf(f.max(0.0)) } else { 1.0 })
}

/// A robot's value under the covariates of its last run.
fn value(group: &[&Observation], model: &MixedModel, is_odd: bool, [z, q_value]: [f64; 2]) -> RobotValue {
    let sums = model.sums(group.iter().copied());
    let (total, residual, mean_row) = (sums.weight, sums.residual / sums.weight, sums.row / sums.weight);
    let last = group.iter().max_by_key(|o| o.run).map(|o| (model.predicted(o), o.design()));
    let (at, last) = last.unwrap_or((f64::NAN, mean_row.clone()));
    let (own, own_std) = (at + residual, (1.0 / total).sqrt());
    let tau2 = model.between * model.between;
    let share = tau2 / (tau2 + 1.0 / total);
    let variance = share / total + model.explained(&(last - share * &mean_row));
    match is_odd {
        true => RobotValue { own, own_std, value: own, std: own_std, z, q_value },
        false => RobotValue { own, own_std, value: at + share * residual, std: variance.sqrt(), z, q_value },
    }
}

/// The q-value of each deviation (Benjamini and Hochberg 1995).
fn q_values(z: &BTreeMap<usize, f64>, degrees: f64) -> BTreeMap<usize, f64> {
    let Ok(t) = StudentsT::new(0.0, 1.0, degrees.max(1.0)) else { return BTreeMap::new() };
    let p: Vec<f64> = z.values().map(|z| 2.0 * t.cdf(-z.abs())).collect();
    z.keys().copied().zip(super::false_discovery_rate::q_values(&p)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, Normal};

    const LEVELS: Levels = Levels { odd: 0.002, tag: 0.01 };

    /// Twenty robots of three runs; every other run on another floor, days since the first.
    fn fleet(seed: u64, floor: f64, per_day: f64) -> (Vec<Said>, Vec<Covariate>) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = |std: f64| Normal::new(0.0, std).unwrap().sample(&mut rng);
        let (mut said, mut floors, mut dates) = (vec![], vec![], vec![]);
        for robot in 0..20 {
            let own = normal(0.004);
            for k in 0..3 {
                let run = said.len();
                let (wood, day) = (run % 2 == 1, (7 * k + robot) as f64);
                let value = 0.03 + own + floor * f64::from(u8::from(wood)) + per_day * day + normal(0.0004);
                said.push(Said { robot, run, value, std: 1e-4 });
                floors.push(if wood { "wood" } else { "tile" });
                dates.push(format!("2026-01-{:02}", 1 + 7 * k + robot % 7));
            }
        }
        let days: Vec<f64> = (0..60).map(|i| (7 * (i % 3) + i / 3) as f64).collect();
        let floors: Vec<Option<&str>> = floors.into_iter().map(Some).collect();
        let numbers: Vec<String> = days.iter().map(f64::to_string).collect();
        let numbers: Vec<Option<&str>> = numbers.iter().map(|n| Some(n.as_str())).collect();
        let tags = [Covariate::of("floor", &floors), Covariate::of("day", &numbers)];
        (said, tags.into_iter().flatten().collect())
    }

    #[test]
    fn a_floor_and_wear_are_told_and_measured() {
        let (said, tags) = fleet(1, 0.003, 2e-4);
        let found = ParameterModel::of(&said, &tags, LEVELS).unwrap();
        let mut names: Vec<&str> = found.covariates.iter().map(|(c, _)| c.tag.as_str()).collect();
        let slope = |tag: &str| {
            let at = 1 + found.covariates.iter().position(|(c, _)| c.tag == tag).unwrap();
            (found.model.coefficients[at], found.model.covariance[(at, at)].sqrt())
        };
        for (tag, truth) in [("floor", 0.003), ("day", 2e-4)] {
            let (value, std) = slope(tag);
            assert!((value - truth).abs() < 4.0 * std && std < 0.1 * truth, "{tag} {value} {std}");
        }
        names.sort_unstable();
        assert_eq!((names, found.odd_robots.len(), found.odd_runs.len()), (vec!["day", "floor"], 0, 0));
    }

    #[test]
    fn tags_that_say_nothing_are_not_told() {
        let told = (10..30).map(|seed| {
            let (said, tags) = fleet(seed, 0.0, 0.0);
            ParameterModel::of(&said, &tags, LEVELS).unwrap().covariates.len()
        });
        assert!(told.sum::<usize>() <= 2);
    }

    /// Robots that say little are drawn to the mean, those that say much keep what they say.
    #[test]
    fn values_are_shrunk_by_what_they_do_not_know() {
        let said: Vec<Said> = (0..12)
            .map(|i| Said { robot: i, run: i, value: (i as f64 - 5.5) * 0.01, std: if i == 0 { 0.2 } else { 1e-5 } })
            .collect();
        let found = ParameterModel::of(&said, &[], LEVELS).unwrap();
        let (vague, sure) = (found.robots[&0], found.robots[&11]);
        assert!((vague.value - found.mean()).abs() < 0.05 * (vague.own - found.mean()).abs());
        assert!((sure.value - sure.own).abs() < 1e-6 && sure.std < 2e-5);
        assert!((vague.std / found.model.between - 1.0).abs() < 0.1);
    }
}
