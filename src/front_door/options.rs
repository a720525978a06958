//! Options of a discovery, each with the value that is usual.

use super::model::Model;
use crate::effects::Effect;
use crate::error::{Error, Result};
use crate::files::{Run, advice};
use crate::progress::{OnProgress, unheard};
use std::fmt;

/// How [`discover_with`](crate::discover_with) works; `Options::default()` is what [`discover`](crate::discover) takes.
///
/// | field | unit | meaning |
/// |---|---|---|
/// | `held_out` | | runs that are only judged; where there are none, the last quarter of every run |
/// | `horizons` | s | horizons of the gap; 1, 5 and 30 where there are none |
/// | `seed` | | seed of the noise floor's random numbers |
/// | `clock_offset` | s | about where the clock of the poses reads against that of the inputs, for runs logged in two files |
/// | `effects` | | ids of the effects that may be named; where there is no list, all that the model knows |
/// | `progress` | | is told how far the work is, and may stop it |
///
/// ```
/// use creepage::{Model, Options, Run};
/// let model = Model::read("examples/runs/cornering/model.toml")?;
/// let runs = [Run::read("examples/runs/cornering/eights.csv", &model)?];
/// let effects = Some(vec!["rotation-creep".to_string(), "traverse-creep".to_string()]);
/// let found = creepage::discover_with(&model, &runs, &Options { effects, ..Options::default() })?;
/// assert!(found.report.effects.iter().all(|e| e.id != "cornering-creep"));
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone)]
pub struct Options<'a> {
    /// Runs that are only judged, opened after the last choice is made.
    pub held_out: Vec<Run>,
    /// Horizons of the gap, s.
    pub horizons: Vec<f64>,
    /// Seed of the noise floor's random numbers.
    pub seed: u64,
    /// About where the clock of the poses reads against that of the inputs, s.
    pub clock_offset: Option<f64>,
    /// Ids of the effects that may be named, beside those of the model; all where there is no list.
    pub effects: Option<Vec<String>>,
    /// Is told how far the work is; a break stops it.
    pub progress: &'a OnProgress<'a>,
}

impl Options<'_> {
    /// The effects of a model's library that may be named; those that the model has stay known.
    ///
    /// # Errors
    /// When the library has no effect of an id.
    pub(super) fn effects_of(&self, model: &Model) -> Result<Vec<Effect>> {
        let Some(wanted) = &self.effects else { return Ok(model.library.clone()) };
        let known: Vec<&str> = model.library.iter().map(|e| e.id.as_str()).collect();
        if let Some(stranger) = wanted.iter().find(|id| !known.contains(&id.as_str())) {
            let message = format!("no effect is called {stranger:?}");
            return Err(Error::input(message).help(advice(stranger, "effects", &known)));
        }
        let kept = |e: &&Effect| wanted.contains(&e.id) || model.file.effects.iter().any(|own| own.id == e.id);
        Ok(model.library.iter().filter(kept).cloned().collect())
    }
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self { held_out: vec![], horizons: vec![], seed: 0, clock_offset: None, effects: None, progress: &unheard }
    }
}

impl fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { held_out, horizons, seed, clock_offset, effects, progress: _ } = self;
        f.debug_struct("Options")
            .field("held_out", held_out)
            .field("horizons", horizons)
            .field("seed", seed)
            .field("clock_offset", clock_offset)
            .field("effects", effects)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_effects_of_the_library_may_be_wanted() {
        let model = Model::new("unicycle", &[("wheel_radius", 0.1)]).unwrap();
        let wanted = |ids: &[&str]| {
            let effects = Some(ids.iter().map(|id| id.to_string()).collect());
            let found = Options { effects, ..Options::default() }.effects_of(&model);
            found.map(|all| all.iter().map(|e| e.id.clone()).collect::<Vec<_>>()).map_err(|e| e.to_string())
        };
        assert_eq!(wanted(&["traverse-creep"]).unwrap(), ["traverse-creep"]);
        let message = wanted(&["traverse-crep"]).unwrap_err();
        assert!(message.contains("\"traverse-crep\"") && message.contains("traverse-creep"), "{message}");
        assert_eq!(Options::default().effects_of(&model).unwrap().len(), model.library.len());
    }
}
