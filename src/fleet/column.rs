//! A parameter of a fleet with what every run says of it, and as the report has it.

use super::covariates::Kind;
use super::outlying_robots::Outlier;
use super::parameter_model::{ParameterModel, Said};
use super::rendering::fleet_text;
use super::report::{FleetParameter, Interval, OddRobot, TagEffect};
use super::rows::{Discovered, Fitted};
use crate::discrepancy::calibration::targets::Target;
use crate::discrepancy::calibration_report::CalibratedEffect;
use std::collections::BTreeMap;

/// A parameter of the fleet with what every run says of it.
pub(super) struct Column {
    /// The effect.
    pub effect: String,
    /// Its parameter.
    pub parameter: String,
    /// The unit.
    pub unit: String,
    /// What runs say.
    pub said: Vec<Said>,
    /// Runs that do not tell it.
    pub without: usize,
}

impl Column {
    /// `EFFECT PARAMETER`.
    pub fn name(&self) -> String {
        format!("{} {}", self.effect, self.parameter)
    }

    /// A robot or a run that differs in it.
    pub fn odd(&self, robot: &str, run: Option<String>, [value, std, others]: [f64; 3], o: &Outlier) -> OddRobot {
        let mut odd = OddRobot {
            robot: robot.into(),
            run,
            effect: self.effect.clone(),
            parameter: self.parameter.clone(),
            value,
            std,
            unit: self.unit.clone(),
            others,
            z: o.z,
            p_value: o.p_value,
            says: String::new(),
        };
        odd.says = fleet_text::odd(&odd);
        odd
    }
}

/// The parameters of an effect with what every run says of each.
pub(super) fn columns_of(all: &[(Discovered, Fitted)], target: &str) -> Vec<Column> {
    let mut found: BTreeMap<String, Column> = BTreeMap::new();
    let mut run = 0;
    for (robot, (_, fitted)) in all.iter().enumerate() {
        for one in &fitted.runs {
            let effect = one.calibration.effects.iter().find(|e| is_target(e, target));
            for (name, p) in effect.iter().flat_map(|e| &e.parameters) {
                let column = found.entry(name.clone()).or_insert_with(|| Column {
                    effect: target.into(),
                    parameter: name.clone(),
                    unit: p.unit.clone(),
                    said: vec![],
                    without: 0,
                });
                match p.std.filter(|s| s.is_finite() && p.value.is_finite()) {
                    Some(std) => column.said.push(Said { robot, run, value: p.value, std }),
                    None => column.without += 1,
                }
            }
            run += 1;
        }
    }
    found.into_values().collect()
}

/// Whether a fitted effect is the one that a target names.
pub(super) fn is_target(e: &CalibratedEffect, target: &str) -> bool {
    Target::of(&e.id, e.on.as_deref(), e.trailer).to_string() == target
}

/// The parameter as the report has it.
pub(super) fn parameter(column: &Column, model: Option<&ParameterModel>) -> FleetParameter {
    let mean = |m: &ParameterModel| {
        let (value, half) = (m.mean(), m.mean_half());
        Interval { value, std: Some(m.mean_std()), interval: [value - half, value + half] }
    };
    let between = |m: &ParameterModel| Interval { value: m.model.between, std: None, interval: m.between };
    FleetParameter {
        unit: column.unit.clone(),
        robots: model.map_or(0, |m| m.model.robots),
        runs: column.said.len(),
        runs_without: column.without,
        mean: model.map(mean),
        between_robots: model.map(between),
        between_runs: model.filter(|m| m.has_repeats).map(|m| m.model.within),
        tags: model.map(tags).unwrap_or_default(),
    }
}

/// The slopes and contrasts of a model.
fn tags(model: &ParameterModel) -> Vec<TagEffect> {
    let mut at = 1;
    let mut found = vec![];
    for (covariate, p_value) in &model.covariates {
        let one = |k: usize, level: Option<String>, against: Option<String>| TagEffect {
            tag: covariate.tag.clone(),
            level,
            against,
            value: model.model.coefficients[k],
            std: model.model.covariance[(k, k)].sqrt(),
            p_value: *p_value,
        };
        match &covariate.kind {
            Kind::Levels { against, levels } => {
                found.extend(
                    levels.iter().enumerate().map(|(k, l)| one(at + k, Some(l.clone()), Some(against.clone()))),
                );
            }
            Kind::Number { .. } | Kind::Date => found.push(one(at, None, None)),
        }
        at += covariate.width();
    }
    found
}
