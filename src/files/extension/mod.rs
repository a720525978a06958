//! Files of a user's own effects, vehicles and claims (TOML), read and checked entry by entry.

pub(crate) mod claims;
pub(crate) mod constraint_types;
pub(crate) mod effect_parameter;
pub(crate) mod effects;
pub(crate) mod user_vehicle;
pub(crate) mod vehicle_constraints;
pub(crate) mod vehicle_parts;
pub(crate) mod vehicle_quantities;
pub(crate) mod vehicles;
