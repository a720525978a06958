//! A model described in formulas a person can read: the work behind `describe`, `vehicles` and `effects`.
//!
//! A [`Description`] holds everything that follows from a model; [`text`], [`latex`] and [`json`] write it
//! down. [`vehicles_text`] and [`effects_text`] list the catalogues, each with a `_json` sister.
//!
//! ```
//! use creepage::{describe, describe::Description, model::Model};
//! let wheel = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
//! let description = Description::of(&wheel).unwrap();
//! assert_eq!(description.signature.to_string(), "R T");
//! assert_eq!(description.constraints[1].ideal.to_string(), "sin(phi)*x' - cos(phi)*y'");
//! assert!(describe::text(&description).contains("cos(phi)*x' + sin(phi)*y' - r*theta' = 0"));
//! ```

mod constraint;
mod derivatives_at;
mod description;
mod effects;
mod forces;
mod found;
mod general;
mod holonomy;
mod jacobian;
mod json;
mod kinship;
mod latex;
mod meaning;
mod page;
mod realised;
mod regime;
mod signature;
mod structure;
mod symbol_entry;
mod symbols;
mod terms;
mod text;
mod vehicles;

pub use constraint::ConstraintEntry;
#[doc(hidden)]
pub use constraint::Part;
#[doc(hidden)]
pub use derivatives_at::{DerivativesAt, GivenPoint};
pub use description::{Description, Equation};
#[doc(hidden)]
pub use description::{EffectInModel, MAX_TRAILERS};
#[doc(hidden)]
pub use effects::{effects_json, effects_text};
#[doc(hidden)]
pub use found::Found;
pub use holonomy::Holonomy;
#[doc(hidden)]
pub use jacobian::Jacobian;
pub use json::json;
#[doc(hidden)]
pub use kinship::{every_effect_page, vehicle_effects_json, vehicle_effects_text};
pub use latex::latex;
#[doc(hidden)]
pub use meaning::universal;
#[doc(hidden)]
pub use realised::Realised;
#[doc(hidden)]
pub use regime::{Coefficient, CreepLimits};
pub use signature::Signature;
pub use structure::Structure;
#[doc(hidden)]
pub use symbol_entry::{Kind, SymbolEntry};
#[doc(hidden)]
pub use symbols::Symbols;
pub use text::text;
#[doc(hidden)]
pub use vehicles::{vehicles_json, vehicles_text};
