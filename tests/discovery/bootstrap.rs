//! The law of chance gains: χ² where it holds, and what data drawn without an effect show where it does not.

use crate::read_back::read_back;
use crate::simulator::{Noise, Scenario, Tractor};
use creepage::discrepancy::estimation::fit::Effort;
use creepage::discrepancy::estimation::problem::Problem;
use creepage::discrepancy::evidence::parametric_bootstrap::{NullDistribution, is_regular};
use creepage::discrepancy::record::run_record::Record;
use creepage::effects::{self, Applied};
use creepage::model::Model;

const DRAWS: usize = 40;

fn effect(id: &str) -> Applied {
    let effect = effects::named(id).unwrap();
    Applied::new(effect, None, effect.starts().swap_remove(0))
}

/// Chance gains of an effect on a drive of a wheel that misses nothing.
fn chance_gains(id: &str) -> NullDistribution {
    let scenario = Scenario { noise: Noise::MOCAP, duration: 20.0, rate: 10.0, ..Scenario::new(Tractor::Unicycle, 31) };
    let (file, run) = read_back(&scenario.model_toml(), &scenario.run().to_csv(9));
    let model = Model::from_file(&file, effects::all(), &run.roles).unwrap();
    let problem = Problem::new(vec![Record::of_run(&run, file.input_timing, 0)], None, None);
    let starts = problem.starts(&model).unwrap();
    let effort = Effort { passes: 10, ..Effort::FULL };
    let fit = problem.fit(&model, &starts, &problem.variances, effort).unwrap().unwrap();
    problem.chance_gains(&fit, &effect(id), DRAWS, 3).unwrap()
}

#[test]
fn chance_gains_of_a_regular_effect_are_chi_squared() {
    assert!(is_regular(&effect("yaw-rate-bias")));
    let gains = chance_gains("yaw-rate-bias");
    // 40 draws tell a mean of one to 0.22.
    assert!((gains.scale() - 1.0).abs() < 0.55, "{}", gains.scale());
    assert!(gains.share() > 0.8, "{}", gains.share());
    // One in twenty exceeds 3.84.
    let beyond = gains.gains.iter().filter(|g| **g > 3.84).count();
    assert!((0..=7).contains(&beyond), "{beyond}");
}

#[test]
fn where_a_parameter_cannot_change_its_sign_some_gains_are_none() {
    assert!(!is_regular(&effect("cornering-creep")));
    let none = |g: &NullDistribution| g.gains.iter().filter(|g| **g == 0.0).count();
    let (held, regular) = (chance_gains("cornering-creep"), chance_gains("yaw-rate-bias"));
    // Not half of them: of a lag the part that comes late may help where the part in time is of the wrong sign.
    assert!(none(&held) > 0 && none(&regular) == 0, "{held:?}");
}

#[test]
fn a_slope_and_its_direction_are_two_ways_of_moving() {
    assert!(!is_regular(&effect("side-slope")));
    let gains = chance_gains("side-slope");
    // Rate and direction are a vector in polar coordinates: chi-squared of two, whatever their edges.
    assert!((gains.scale() - 1.0).abs() < 0.4 && gains.share() > 0.9, "{} {}", gains.scale(), gains.share());
}

#[test]
fn where_a_parameter_loses_its_meaning_gains_are_larger() {
    assert!(!is_regular(&effect("relaxation-length")));
    let (plain, with_length) = (chance_gains("traverse-creep"), chance_gains("relaxation-length"));
    let mean = |g: &NullDistribution| g.gains.iter().sum::<f64>() / DRAWS as f64;
    // The length lets the creep be fitted in more ways than one: at most like a second parameter.
    assert!((mean(&plain) + 0.05..mean(&plain) + 2.0).contains(&mean(&with_length)), "{plain:?} {with_length:?}");
}

#[test]
fn a_probability_is_counted_and_goes_on_beyond_the_largest_gain() {
    let gains = chance_gains("cornering-creep");
    assert_eq!(gains.p_value(0.0), 1.0);
    let largest = gains.gains.iter().copied().fold(0.0, f64::max);
    assert!((gains.p_value(largest) - 2.0 / (DRAWS + 1) as f64).abs() < 1e-12);
    assert!(gains.p_value(largest + 0.1) <= 1.0 / (DRAWS + 1) as f64);
    assert!(gains.p_value(40.0) < 1e-6);
}
