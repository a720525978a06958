//! Robots and runs that differ from the others: the generalised extreme studentised deviate (Rosner, Technometrics 25, 1983)
//! of what is predicted from all others, by deletion (Cook and Weisberg, *Residuals and Influence*, 1982, chapter 2).
//!
//! One after another the most deviating robot is left out, the mixed model fitted to the rest, and the robot compared with
//! its prediction, tᵢ with n − 1 − p degrees of freedom; odd are all up to the last that is too far by chance. So one odd
//! robot does not hide another behind the spread that both make.

use super::linear_mixed_model::{Groups, MixedModel, Observation};
use statrs::distribution::{ContinuousCDF, StudentsT};
use std::collections::BTreeMap;

/// A robot or a run that differs from all others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlier {
    /// The robot, or the run, counted from zero.
    pub which: usize,
    /// How many deviations it lies from what the others predict.
    pub z: f64,
    /// Probability that the farthest of so many lies so far.
    pub p_value: f64,
}

/// What is left out of the data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// All runs of a robot.
    Robot,
    /// A run of a robot that has three at least: of two that differ none can be told to be the odd one.
    Run,
}

impl Unit {
    fn of(self, o: &Observation) -> usize {
        match self {
            Self::Robot => o.robot,
            Self::Run => o.run,
        }
    }
}

/// The odd ones among units, at a probability that any is told where none is odd.
pub fn outliers(observations: &[&Observation], unit: Unit, level: f64) -> Vec<Outlier> {
    let units = observations.iter().map(|o| unit.of(o)).collect::<std::collections::BTreeSet<_>>().len();
    let most = (units / 5).min(20);
    let (mut rest, mut found, mut odd) = (observations.to_vec(), vec![], 0);
    let mut fit = Groups::of(&rest).and_then(|g| g.fitted());
    while found.len() < most {
        let Some(model) = &fit else { break };
        let Some(farthest) = farthest(&rest, model, unit) else { break };
        let (out, kept): (Vec<&Observation>, Vec<&Observation>) = rest.iter().partition(|o| unit.of(o) == farthest);
        fit = Groups::of(&kept).and_then(|g| g.fitted());
        let Some(without) = &fit else { break };
        let z = deleted(&out, &kept, without, unit);
        let left = units - found.len();
        let degrees = degrees(&kept, without, unit);
        let p_value = StudentsT::new(0.0, 1.0, degrees).map_or(1.0, |t| 2.0 * t.cdf(-z.abs()));
        found.push(Outlier { which: farthest, z, p_value: (p_value * left as f64).min(1.0) });
        if found[found.len() - 1].p_value < level {
            odd = found.len();
        }
        rest = kept;
    }
    found.truncate(odd);
    found
}

fn degrees(kept: &[&Observation], without: &MixedModel, unit: Unit) -> f64 {
    let width = without.coefficients.len();
    match unit {
        Unit::Robot => without.robots.saturating_sub(width).max(1) as f64,
        Unit::Run => kept.len().saturating_sub(without.robots + width - 1).max(1) as f64,
    }
}

/// The unit that lies farthest from what the others predict, with spreads that are not yet free of it.
fn farthest(all: &[&Observation], model: &MixedModel, unit: Unit) -> Option<usize> {
    let far = standing(all, model, unit);
    far.into_iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).map(|(which, _)| which)
}

/// How many deviations each unit lies from the prediction of the others, by the mean shift that it asks for, at spreads that
/// hold for all.
pub fn standing(all: &[&Observation], model: &MixedModel, unit: Unit) -> BTreeMap<usize, f64> {
    let Some(groups) = Groups::of(all) else { return BTreeMap::new() };
    let tau2 = model.between * model.between;
    let mut found = BTreeMap::new();
    for group in &groups.all {
        let sums = model.sums(group.iter().copied());
        let shrunk = 1.0 + tau2 * sums.weight;
        match unit {
            Unit::Robot => {
                let variance = sums.weight / shrunk - model.explained(&(&sums.row / shrunk));
                found.insert(group[0].robot, sums.residual / shrunk / variance.max(0.0).sqrt());
            }
            Unit::Run if group.len() < 3 => {}
            Unit::Run => {
                let share = tau2 / shrunk;
                for o in group {
                    let w = model.weight(o);
                    let a = w * (o.design() - share * &sums.row);
                    let variance = w - share * w * w - model.explained(&a);
                    found.insert(o.run, w * (model.residual(o) - share * sums.residual) / variance.max(0.0).sqrt());
                }
            }
        }
    }
    found.retain(|_, z| z.is_finite());
    found
}

/// How far what was left out lies from what the model of the rest predicts, in deviations of the prediction.
fn deleted(out: &[&Observation], kept: &[&Observation], model: &MixedModel, unit: Unit) -> f64 {
    let tau2 = model.between * model.between;
    let own = model.sums(out.iter().copied());
    let (mut value, mut variance, mut row) = (own.residual / own.weight, 1.0 / own.weight + tau2, own.row / own.weight);
    if unit == Unit::Run {
        // The robot's other runs tell of it.
        let others = model.sums(kept.iter().copied().filter(|o| out.iter().any(|x| x.robot == o.robot)));
        let share = tau2 / (1.0 + tau2 * others.weight);
        value -= share * others.residual;
        variance -= share * tau2 * others.weight;
        row -= share * others.row;
    }
    value / (variance + model.explained(&row)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, Normal};

    fn fleet(
        seed: u64,
        robots: usize,
        runs: usize,
        odd: &[(usize, f64)],
        odd_run: Option<(usize, f64)>,
    ) -> Vec<Observation> {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut normal = |std: f64| Normal::new(0.0, std).unwrap().sample(&mut rng);
        let mut all: Vec<Observation> = vec![];
        for robot in 0..robots {
            let own = normal(0.004) + odd.iter().find(|(i, _)| *i == robot).map_or(0.0, |(_, v)| *v);
            for _ in 0..runs {
                let run = all.len();
                let shift = odd_run.filter(|(i, _)| *i == run).map_or(0.0, |(_, v)| v);
                let value = own + shift + normal(0.0005) + normal(0.0001);
                all.push(Observation { robot, run, value, variance: 1e-8, row: vec![1.0] });
            }
        }
        all
    }

    fn told(all: &[Observation], unit: Unit) -> Vec<usize> {
        outliers(&all.iter().collect::<Vec<_>>(), unit, 0.002).iter().map(|o| o.which).collect()
    }

    #[test]
    fn a_worn_tyre_is_told_and_two_do_not_hide_each_other() {
        assert_eq!(told(&fleet(1, 50, 2, &[(17, 0.045)], None), Unit::Robot), [17]);
        let mut both = told(&fleet(2, 50, 1, &[(3, 0.04), (41, 0.042)], None), Unit::Robot);
        both.sort_unstable();
        assert_eq!(both, [3, 41]);
        assert_eq!(told(&fleet(3, 20, 4, &[], Some((22, 0.01))), Unit::Run), [22]);
        // Of two runs that differ none is the odd one.
        assert!(told(&fleet(3, 20, 2, &[], Some((22, 0.01))), Unit::Run).is_empty());
    }

    #[test]
    fn fleets_without_an_odd_robot_have_none() {
        let alarms = |robots: usize, runs: usize| {
            let fleets = (0..100).map(|seed| fleet(1000 + seed, robots, runs, &[], None));
            fleets.map(|f| told(&f, Unit::Robot).len() + told(&f, Unit::Run).len()).sum::<usize>()
        };
        assert!(alarms(50, 1) <= 1);
        assert!(alarms(12, 3) <= 1);
    }

    /// The mean shift is what a fit with a dummy for the robot would give.
    #[test]
    fn the_deviation_of_a_robot_is_that_of_a_coefficient_of_its_own() {
        let all = fleet(5, 10, 3, &[], None);
        let of: Vec<&Observation> = all.iter().collect();
        let model = Groups::of(&of).unwrap().fitted().unwrap();
        let z = standing(&of, &model, Unit::Robot)[&4];
        let with: Vec<Observation> = all
            .iter()
            .map(|o| Observation { row: vec![1.0, f64::from(u8::from(o.robot == 4))], ..o.clone() })
            .collect();
        let of: Vec<&Observation> = with.iter().collect();
        let own = Groups::of(&of).unwrap().at(model.between, model.within).unwrap();
        let t = own.coefficients[1] / own.covariance[(1, 1)].sqrt();
        assert!((t - z).abs() < 1e-6 * z.abs(), "{t} {z}");
    }
}
