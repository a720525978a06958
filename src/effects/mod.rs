//! The effects that may be missing from a model: data. To add one, add it to `catalogue.toml`, or to
//! `forces.toml` where forces move the vehicle;
//! a user adds one without recompiling, see [`extensions`](crate::extensions).

mod applied;
mod course;
mod drifting;
mod effect;
mod per_contact;
mod plain;
mod random_walk;
mod scope;
mod starts;

pub use applied::Applied;
pub use course::Course;
pub use effect::{Effect, Parameter, State};
pub(crate) use effect::{acting, delaying, measuring};
pub use plain::{PlainSentence, TypicalMotion};
pub use random_walk::RandomWalk;
pub use scope::{DrivingRegime, Scope};

use std::sync::LazyLock;

#[derive(serde::Deserialize)]
struct Catalogue {
    effect: Vec<Effect>,
}

static CATALOGUE: LazyLock<Vec<Effect>> = LazyLock::new(|| {
    let texts = [include_str!("catalogue.toml"), include_str!("forces.toml")];
    // The texts are part of the program; a test reads every entry.
    let read = |text: &str| -> Catalogue {
        toml::from_str(text).unwrap_or_else(|e| unreachable!("the catalogue of effects is malformed: {e}"))
    };
    let mut effects: Vec<Effect> = texts.into_iter().flat_map(|text| read(text).effect).collect();
    effects.iter_mut().enumerate().for_each(|(i, e)| e.order = i);
    effects
});

/// Every effect of the library.
///
/// ```
/// assert!(creepage::effects::all().iter().any(|e| e.id == "rotation-creep"));
/// ```
pub fn all() -> &'static [Effect] {
    &CATALOGUE
}

/// The effects of the catalogue followed by others, which act after them.
///
/// ```
/// use creepage::effects::{self, Effect};
/// let library = effects::with(&[Effect { id: "mine".into(), ..Effect::default() }]);
/// assert!(library.len() == effects::all().len() + 1 && library.is_sorted_by_key(|e| e.order));
/// ```
pub fn with(own: &[Effect]) -> Vec<Effect> {
    let mut library = all().to_vec();
    for e in own {
        library.push(Effect { order: library.len(), ..e.clone() });
    }
    library
}

/// The effect by which the inputs act at another time than they were logged.
pub(crate) fn of_clock() -> Option<&'static Effect> {
    all().iter().find(|e| e.is_of_clock())
}

/// The effect of that id.
///
/// ```
/// assert!(creepage::effects::named("rotation-creep").is_some_and(|e| e.basic));
/// ```
pub fn named(id: &str) -> Option<&'static Effect> {
    all().iter().find(|e| e.id == id)
}
