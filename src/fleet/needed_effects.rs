//! The effects that a fleet needs: named by more robots than false names explain, each class of identical effects once.
//!
//! A robot without an effect names it with a probability of at most [`FALSE_NAME`], so the number of robots that name it by
//! mistake is binomial; its tail is the p-value of the effect, and the effects that are needed have a false discovery rate
//! (Benjamini and Hochberg 1995) of one in a hundred.

use super::false_discovery_rate::q_values;
use super::rows::{Discovered, Vote};
use crate::discrepancy::report::Verdict;
use statrs::distribution::{Binomial, DiscreteCDF};
use std::collections::BTreeMap;

/// Probability that a robot names an effect that it does not have.
const FALSE_NAME: f64 = 0.004;
/// False discovery rate of the effects that are needed.
const RATE: f64 = 0.01;

/// An effect that robots ask for.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// The effect: of identical ones that which most robots name.
    pub target: String,
    /// What it means.
    pub says: String,
    /// The names of the class that robots gave it, this one among them.
    pub names: Vec<String>,
    /// Robots that name it.
    pub robots: Vec<String>,
    /// BIC without minus BIC with it, summed over them.
    pub delta_bic: f64,
    /// Share of false discoveries among effects named by as many robots.
    pub q_value: f64,
    /// Whether the fleet needs it.
    pub is_needed: bool,
}

/// The effects that robots name, those of most robots first.
pub fn wanted(rows: &[Discovered]) -> Vec<Wanted> {
    let asked = rows.iter().filter(|r| r.verdict() != Verdict::UnusableData).count();
    let mut classes: Vec<Wanted> = vec![];
    for (robot, vote) in votes(rows) {
        let same = |w: &Wanted| w.names.iter().any(|n| vote.means(n));
        match classes.iter_mut().find(|w| same(w)) {
            Some(class) => class.add(robot, vote),
            None => {
                let mut class = Wanted {
                    target: vote.target.clone(),
                    says: vote.says.clone(),
                    names: vec![],
                    robots: vec![],
                    delta_bic: 0.0,
                    q_value: 1.0,
                    is_needed: false,
                };
                class.add(robot, vote);
                classes.push(class);
            }
        }
    }
    name(&mut classes, rows);
    let p: Vec<f64> = classes.iter().map(|w| by_mistake(w.robots.len(), asked)).collect();
    // A fleet of one or two is what its robots say.
    let least = if asked < 3 { 1 } else { asked.div_ceil(10).max(2) };
    for (class, q) in classes.iter_mut().zip(q_values(&p)) {
        class.q_value = q;
        class.is_needed = q < RATE && class.robots.len() >= least;
    }
    classes.sort_by(|a, b| {
        let order = b.robots.len().cmp(&a.robots.len()).then(b.delta_bic.total_cmp(&a.delta_bic));
        order.then(a.target.cmp(&b.target))
    });
    classes
}

/// What robots name, always and everywhere.
fn votes(rows: &[Discovered]) -> impl Iterator<Item = (&str, &Vote)> {
    rows.iter().flat_map(|r| r.named.iter().filter(|v| !v.in_part).map(|v| (r.robot.robot.as_str(), v)))
}

impl Wanted {
    fn add(&mut self, robot: &str, vote: &Vote) {
        if !self.names.contains(&vote.target) {
            self.names.push(vote.target.clone());
        }
        if self.robots.iter().all(|r| r != robot) {
            self.robots.push(robot.into());
            self.delta_bic += vote.evidence.delta_bic;
        }
    }
}

/// Gives each class the name that most robots give it.
fn name(classes: &mut [Wanted], rows: &[Discovered]) {
    let mut counts: BTreeMap<&str, (usize, &str)> = BTreeMap::new();
    for (_, vote) in votes(rows) {
        counts.entry(&vote.target).or_insert((0, &vote.says)).0 += 1;
    }
    for class in classes {
        let count = |n: &String| counts.get(n.as_str()).map_or(0, |c| c.0);
        let most = class.names.iter().max_by(|a, b| count(a).cmp(&count(b)).then(b.cmp(a)));
        if let Some((name, (_, says))) = most.and_then(|n| counts.get_key_value(n.as_str())) {
            (class.target, class.says) = (name.to_string(), says.to_string());
        }
        class.names.sort();
    }
}

/// The probability that so many robots name an effect that none of them has.
fn by_mistake(robots: usize, asked: usize) -> f64 {
    let Ok(mistakes) = Binomial::new(FALSE_NAME, asked as u64) else { return 1.0 };
    if robots == 0 { 1.0 } else { mistakes.sf(robots as u64 - 1) }
}

#[cfg(test)]
mod tests {
    use super::by_mistake;

    #[test]
    fn one_name_in_fifty_robots_may_be_a_mistake_and_five_are_none() {
        assert!((by_mistake(1, 50) - (1.0 - 0.996_f64.powi(50))).abs() < 1e-12);
        assert!(by_mistake(5, 50) < 1e-5 && by_mistake(0, 50) == 1.0);
    }
}
