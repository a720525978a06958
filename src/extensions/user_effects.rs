//! A user's own effects, held against every vehicle they apply to.

use super::test_vehicle::TestVehicle;
use super::{applicability, formula_growth, names, neutral_value, sensor, units};
use crate::effects;
use crate::effects::Effect;
use crate::error::Result;
use crate::files::{EffectsFile, UserEffect, advice, shown};
use crate::vehicles;
use crate::vehicles::Vehicle;
use std::path::Path;

/// The effects of the catalogue, followed by those of a file.
///
/// ```toml
/// [[effect]]
/// id = "yaw-slip"
/// where = "traverse constraint"
/// says = "the vehicle slides outwards by the square of its yaw rate"
/// [effect.parameters.q]
/// unit = "m*s"
/// range = [-10.0, 10.0]
/// size = 0.03
/// [effect.changes]
/// v_t = "it - q*phi'*abs(phi')"
/// ```
///
/// # Errors
/// With file, line and column when the file is not of this form, or an effect cannot do what the library's can: apply
/// to a vehicle, have units, vanish where its parameters are neutral.
///
/// ```
/// use creepage::extensions;
/// let own = extensions::with_own("examples/effects/my_effects.toml").unwrap();
/// assert!(own.iter().any(|e| e.id == "yaw-slip") && own.iter().any(|e| e.id == "rotation-creep"));
/// ```
pub fn with_own(path: impl AsRef<Path>) -> Result<Vec<Effect>> {
    with_own_on(path, vehicles::all())
}

/// As [`with_own`], where the effects may also speak of other vehicles than the catalogue's.
///
/// # Errors
/// As [`with_own`].
pub fn with_own_on(path: impl AsRef<Path>, vehicles: &[Vehicle]) -> Result<Vec<Effect>> {
    let file = EffectsFile::read(path.as_ref())?;
    let mut library = effects::all().to_vec();
    let moved_by_inputs = TestVehicle::all(vehicles)?;
    let mut moved_by_forces: Option<Vec<TestVehicle>> = None;
    for own in file.effects {
        distinct(&own, &library)?;
        check_limit(&own, &library)?;
        // What no vehicle defines that its inputs move may be one of the forces.
        let may_be_of_forces = !names::are_defined(&own, &moved_by_inputs);
        if may_be_of_forces && moved_by_forces.is_none() {
            moved_by_forces = Some(TestVehicle::forced(vehicles)?);
        }
        let is_of_forces = |all: &&Vec<TestVehicle>| may_be_of_forces && names::are_defined(&own, all);
        let test_vehicles = moved_by_forces.as_ref().filter(is_of_forces).unwrap_or(&moved_by_inputs);
        check(&own, test_vehicles)?;
        library.push(Effect { order: library.len(), ..own.effect.clone() });
        formula_growth::check(&own, &library, test_vehicles)?;
    }
    Ok(library)
}

/// That what an effect becomes where its states follow at once is an effect with as many parameters.
fn check_limit(own: &UserEffect, library: &[Effect]) -> Result<()> {
    let (Some(id), Some(spot)) = (&own.effect.limit, &own.limit) else { return Ok(()) };
    let Some(limit) = library.iter().find(|e| e.id == *id) else {
        let ids: Vec<&str> = library.iter().map(|e| e.id.as_str()).collect();
        return Err(spot.error(format!("unknown effect \"{}\"", shown(id))).help(advice(id, "known effects", &ids)));
    };
    if limit.limit.is_some() {
        let error = spot.error(format!("\"{id}\" has a limit of its own"));
        return Err(error.help("name an effect without states that is asked for first"));
    }
    if limit.parameters.len() != own.effect.parameters.len() || limit.per_trailer != own.effect.per_trailer {
        let error = spot.error(format!("\"{id}\" has other parameters, or another place on trailers"));
        return Err(
            error.help("an effect begins where its limit ends: give both the same parameters in the same order")
        );
    }
    Ok(())
}

/// That the name of an effect, and the symbols made from it, are no other's.
fn distinct(own: &UserEffect, library: &[Effect]) -> Result<()> {
    let id = &own.effect.id;
    let is_taken = library.iter().any(|e| e.id == *id && e.origin.is_none()) || crate::model::is_term(id);
    if is_taken {
        return Err(own.id.error(format!("the library has an effect \"{id}\"")).help("give yours another id"));
    }
    // `slip` on trailer 1 makes slip_1.c of its parameter c; so would `slip-1`.
    let numbered = |long: &str, short: &Effect| {
        let rest = long.strip_prefix(short.id.as_str()).and_then(|rest| rest.strip_prefix('-'));
        short.per_trailer && rest.is_some_and(|n| !n.is_empty() && n.chars().all(|c| c.is_ascii_digit()))
    };
    match library.iter().find(|e| numbered(id, e) || numbered(&e.id, &own.effect)) {
        None => Ok(()),
        Some(e) => Err(own
            .id
            .error(format!("\"{id}\" and \"{}\" on a trailer would share the names of their parameters", e.id))
            .help("give yours another id")),
    }
}

fn check(own: &UserEffect, test_vehicles: &[TestVehicle]) -> Result<()> {
    names::check(own, test_vehicles)?;
    let places = applicability::places(own, test_vehicles)?;
    for place in &places {
        names::check_clash(own, place)?;
        units::check(own, place)?;
        sensor::check(own, place)?;
    }
    neutral_value::check(own)
}
