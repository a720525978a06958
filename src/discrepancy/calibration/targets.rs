//! The effects that are to be fitted, as a user names them: by id, and by input or trailer where an effect has several.

use crate::effects::{Applied, Effect};
use crate::error::{Error, Result};
use crate::files::{EffectEntry, ModelFile, advice};
use crate::model::Model;
use std::fmt;
use std::str::FromStr;

/// An effect named by its id, `track-width`, with the input or the trailer it acts on where there are several:
/// `input-lag@steering_angle`, `trailer-length@2`.
///
/// ```
/// use creepage::discrepancy::calibration::targets::Target;
/// let lag: Target = "input-lag@yaw_rate".parse().unwrap();
/// assert_eq!((lag.id.as_str(), lag.on.as_deref()), ("input-lag", Some("yaw_rate")));
/// assert_eq!(lag.to_string(), "input-lag@yaw_rate");
/// assert!("@yaw_rate".parse::<Target>().is_err());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The effect's id.
    pub id: String,
    /// The role of an input, the name of a measured quantity, or the number of a trailer.
    pub on: Option<String>,
}

impl FromStr for Target {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self> {
        let (id, on) = text.split_once('@').map_or((text, None), |(id, on)| (id, Some(on)));
        match id.trim().is_empty() || on.is_some_and(|on| on.trim().is_empty()) {
            true => Err(Error::input(format!("\"{text}\" names no effect")).help("write ID, ID@INPUT or ID@TRAILER")),
            false => Ok(Self { id: id.trim().into(), on: on.map(|on| on.trim().into()) }),
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match &self.on {
            Some(on) => write!(f, "{}@{on}", self.id),
            None => f.write_str(&self.id),
        }
    }
}

impl Target {
    /// The target that means an effect on an input or on a trailer.
    pub fn of(id: &str, input: Option<&str>, trailer: Option<usize>) -> Self {
        Self { id: id.into(), on: input.map(String::from).or_else(|| trailer.map(|i| i.to_string())) }
    }

    fn is(&self, effect: &Effect, trailer: Option<usize>) -> bool {
        let whole = Self::of(&effect.id, effect.on.as_deref(), trailer);
        self.id == whole.id && (self.on.is_none() || self.on == whole.on)
    }
}

/// The effects that targets mean: of a model, and a library in which effects on inputs stand once for each input.
///
/// # Errors
/// When a target is unknown, does not apply to the vehicle, means several effects, or is named twice.
pub(crate) fn resolved<'l>(
    targets: &[Target],
    model: &Model,
    library: &'l [Effect],
    known: &[Effect],
) -> Result<Vec<(&'l Effect, Option<usize>)>> {
    let open = model.applicable(library);
    let mut found: Vec<(&Effect, Option<usize>)> = vec![];
    for target in targets {
        let all: Vec<_> = open.iter().filter(|(e, t)| target.is(e, *t)).collect();
        // All inputs at once, where that is an effect and none is named.
        let whole: Vec<_> = all.iter().filter(|(e, t)| e.on.is_none() && t.is_none()).collect();
        let one = match (&all[..], &whole[..]) {
            ([], _) => return Err(unknown(target, &open, known)),
            ([one], _) => **one,
            (_, [one]) => ***one,
            (several, _) => return Err(ambiguous(target, several)),
        };
        if found.iter().any(|(e, t)| e.id == one.0.id && e.on == one.0.on && *t == one.1) {
            return Err(Error::input(format!("{} is named twice", target.id)).help("name each effect once"));
        }
        found.push(one);
    }
    Ok(found)
}

fn ambiguous(target: &Target, several: &[&(&Effect, Option<usize>)]) -> Error {
    let name = |(e, t): &(&Effect, Option<usize>)| Target::of(&e.id, e.on.as_deref(), *t).to_string();
    let names: Vec<String> = several.iter().map(|one| name(one)).collect();
    Error::input(format!("{} is an effect on one of several", target.id)).help(format!("write {}", names.join(" or ")))
}

fn unknown(target: &Target, open: &[(&Effect, Option<usize>)], known: &[Effect]) -> Error {
    if known.iter().any(|e| e.id == target.id) {
        return Error::input(format!("{target} does not apply to this vehicle and these runs")).help(
            "`creepage effects --vehicle VEHICLE` lists those that do, one on an input asks that the runs move it",
        );
    }
    let ids: Vec<&str> = open.iter().map(|(e, _)| e.id.as_str()).collect();
    Error::input(format!("unknown effect \"{target}\"")).help(advice(&target.id, "effects of this vehicle", &ids))
}

/// Free effects where a fit would begin, with the bounds that the model file has for them.
pub(crate) fn bounded(mut effect: Applied, file: &ModelFile) -> Applied {
    let Some(entry) = entry(file, &effect.effect, effect.trailer) else { return effect };
    for ((name, parameter), value) in effect.effect.parameters.iter_mut().zip(&mut effect.values) {
        if let Some([least, most]) = entry.known.get(name).and_then(|k| k.bounds) {
            parameter.range = [parameter.range[0].max(least), parameter.range[1].min(most)];
            *value = value.clamp(parameter.range[0], parameter.range[1]);
        }
    }
    effect
}

/// The entry of a model file for an effect on its target.
pub(crate) fn entry<'f>(file: &'f ModelFile, effect: &Effect, trailer: Option<usize>) -> Option<&'f EffectEntry> {
    file.effects.iter().find(|e| e.id == effect.id && e.trailer == trailer && e.input == effect.on)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects;

    fn applied(id: &str, values: &[f64]) -> Applied {
        Applied::new(effects::named(id).unwrap(), None, values.to_vec())
    }

    fn file(entry: &str) -> ModelFile {
        let text =
            format!("vehicle = \"differential-drive\"\n[parameters]\nwheel_radius = 0.1\ntrack_width = 0.4\n{entry}");
        ModelFile::parse(&text, "model.toml", &crate::model::known(effects::all())).unwrap()
    }

    #[test]
    fn a_start_lies_within_the_bounds_of_the_model_file() {
        let bounds = file("[[effects]]\nid = \"track-width\"\nscale = 0.0\nbounds = [0.01, 0.05]\n");
        let begun = bounded(applied("track-width", &[0.2]), &bounds);
        assert_eq!((begun.values[0], begun.effect.parameters["scale"].range), (0.05, [0.01, 0.05]));
        let free = bounded(applied("track-width", &[0.2]), &file(""));
        assert_eq!(free, applied("track-width", &[0.2]));
    }

    #[test]
    fn targets_mean_one_effect_each() {
        let model = Model::from_file(&file(""), effects::all(), &[]).unwrap();
        let means = |text: &[&str]| -> Result<Vec<String>> {
            let targets: Vec<Target> = text.iter().map(|t| t.parse().unwrap()).collect();
            let found = resolved(&targets, &model, effects::all(), effects::all())?;
            Ok(found.iter().map(|(e, _)| e.id.clone()).collect())
        };
        assert_eq!(means(&["track-width", "rotation-creep"]).unwrap(), ["track-width", "rotation-creep"]);
        let fails = |text: &[&str], says: &str| {
            let e = means(text).unwrap_err();
            assert!(e.exit_code() == 2 && e.to_string().contains(says), "{e}");
        };
        fails(&["track-width", "track-width"], "is named twice");
        fails(&["track-with"], "track-width");
        fails(&["steering-offset"], "does not apply to this vehicle");
        fails(&["track-width@3"], "does not apply");
    }
}
