//! The model of each robot with the fleet's findings, what ROS 2 reads of it, and the lines of that which change.

use super::fits::Plan;
use super::map::model;
use super::report::RobotReport;
use super::rows::{Discovered, Mapped, Vote};
use crate::discrepancy::calibration::targets::Target;
use crate::effects::Effect;
use crate::error::Result;
use crate::export;
use crate::files::{EffectEntry, ModelFile};
use crate::front_door::Model;

/// A robot's model with its values.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotModel {
    /// The robot.
    pub robot: String,
    /// The model file.
    pub model: String,
    /// Parameters of a ROS 2 controller, where there is one for the vehicle.
    pub controller: Option<String>,
    /// Lines of these that its findings change.
    pub mend: Vec<String>,
}

impl RobotModel {
    /// The model of a robot.
    ///
    /// # Errors
    /// When the model cannot be read any more.
    pub(super) fn of(mapped: &Mapped, plan: &Plan, discovered: &Discovered, report: &RobotReport) -> Result<Self> {
        let given = model(mapped, &discovered.robot)?;
        let name = &discovered.robot.robot;
        let own = plan.own.get(name).map_or(&[][..], Vec::as_slice);
        let patched = patched(&given, report, own)?;
        let [before, controller] = [&given, &patched].map(|m| controller(&m.file));
        let lines = |text: &Option<String>| -> Vec<String> {
            text.iter().flat_map(|t| t.lines()).map(|l| l.trim().to_string()).filter(|l| !l.starts_with('#')).collect()
        };
        let known = lines(&before);
        let mend = lines(&controller).into_iter().filter(|l| !known.contains(l)).collect();
        Ok(Self { robot: name.clone(), model: patched.file.text, controller, mend })
    }

    /// Its files: `ROBOT.toml`, and `ROBOT.yaml` for a controller.
    pub fn files(&self) -> impl Iterator<Item = (String, &str)> {
        let yaml = self.controller.as_ref().map(|text| (format!("{}.yaml", self.robot), text.as_str()));
        std::iter::once((format!("{}.toml", self.robot), self.model.as_str())).chain(yaml)
    }
}

/// A model with a robot's values of the effects that the fleet needs, and of those it needs alone.
fn patched(model: &Model, report: &RobotReport, own: &[Vote]) -> Result<Model> {
    let mut entries: Vec<EffectEntry> = vec![];
    for (key, value) in &report.values {
        let Some((effect, parameter)) = key.split_once(' ') else { continue };
        let new = entry(effect)?;
        let at = entries.iter().position(|e| e.same_target(&new)).unwrap_or_else(|| {
            entries.push(new);
            entries.len() - 1
        });
        entries[at].parameters.insert(parameter.into(), value.value);
    }
    let alone = own.iter().filter(|v| !v.in_part).map(alone).collect::<Result<Vec<_>>>()?;
    entries.extend(alone);
    entries.retain(|e| is_whole(e, model));
    entries.iter_mut().for_each(|e| clamp(e, model));
    model.rewritten(&model.file.patched(&entries))
}

/// An effect that a robot alone needs.
fn alone(vote: &Vote) -> Result<EffectEntry> {
    let parameters = vote.parameters.iter().map(|(name, e)| (name.clone(), e.value)).collect();
    Ok(EffectEntry { parameters, ..entry(&vote.target)? })
}

/// An entry of a model file without values, from `ID`, `ID@INPUT` or `ID@TRAILER`.
fn entry(target: &str) -> Result<EffectEntry> {
    let Target { id, on } = target.parse()?;
    let trailer = on.as_ref().and_then(|on| on.parse().ok());
    Ok(EffectEntry { id, trailer, input: on.filter(|_| trailer.is_none()), ..EffectEntry::default() })
}

fn of_library<'m>(e: &EffectEntry, model: &'m Model) -> Option<&'m Effect> {
    model.library.iter().find(|l| l.id == e.id)
}

/// Whether every parameter of an effect has a value.
fn is_whole(e: &EffectEntry, model: &Model) -> bool {
    of_library(e, model).is_some_and(|l| l.parameters.keys().all(|p| e.parameters.contains_key(p)))
}

/// Keeps values within what a model file may say.
fn clamp(e: &mut EffectEntry, model: &Model) {
    let Some(effect) = of_library(e, model) else { return };
    for (name, value) in &mut e.parameters {
        if let Some(p) = effect.parameters.get(name) {
            *value = value.clamp(p.range[0], p.range[1]);
        }
    }
}

/// The parameters of a ROS 2 controller, where there is one for the vehicle.
fn controller(file: &ModelFile) -> Option<String> {
    export::Target::of_ros2(file).ok().map(|e| e.text)
}
