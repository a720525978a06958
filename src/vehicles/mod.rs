//! The vehicles: descriptions as data. To add one, add it to `catalogue.toml`; a user adds one without recompiling,
//! see [`extensions`](crate::extensions).

mod moves;
mod vehicle;

#[doc(hidden)]
pub use moves::Moves;
#[doc(hidden)]
pub use vehicle::Instead;
pub use vehicle::{Coordinate, Definition, Input, Quantity, Section, Vehicle, Wheel};

use std::sync::LazyLock;

#[derive(serde::Deserialize)]
struct Catalogue {
    vehicle: Vec<Vehicle>,
}

static CATALOGUE: LazyLock<Vec<Vehicle>> = LazyLock::new(|| {
    let parsed: Result<Catalogue, _> = toml::from_str(include_str!("catalogue.toml"));
    // The text is part of the program; a test reads every entry.
    parsed.unwrap_or_else(|e| unreachable!("the catalogue of vehicles is malformed: {e}")).vehicle
});

/// Every vehicle of the catalogue.
///
/// ```
/// assert!(creepage::vehicles::all().iter().any(|v| v.id == "unicycle"));
/// ```
pub fn all() -> &'static [Vehicle] {
    &CATALOGUE
}

/// The vehicle of that id.
///
/// ```
/// assert_eq!(creepage::vehicles::named("car").map(|v| v.id.as_str()), Some("car"));
/// assert!(creepage::vehicles::named("hovercraft").is_none());
/// ```
pub fn named(id: &str) -> Option<&'static Vehicle> {
    all().iter().find(|v| v.id == id)
}
