//! The theory, chapter by chapter, for a reader who has the paper beside it.
//!
//! The chapters lie in `theory/` and are compiled: every code block in them is a test. A claim is named by its id, as
//! in `creepage verify eq-21`.

#[doc = include_str!("../theory/01-introduction.md")]
pub mod introduction {}
#[doc = include_str!("../theory/02-rotation-creep.md")]
pub mod rotation_creep {}
#[doc = include_str!("../theory/03-traverse-creep.md")]
pub mod traverse_creep {}
#[doc = include_str!("../theory/03b-singularity-free.md")]
pub mod singularity_free {}
#[doc = include_str!("../theory/04-single-wheel.md")]
pub mod single_wheel {}
#[doc = include_str!("../theory/04a-one-wheel.md")]
pub mod one_wheel {}
#[doc = include_str!("../theory/05-single-body.md")]
pub mod single_body {}
#[doc = include_str!("../theory/05a-holonomy.md")]
pub mod holonomy {}
#[doc = include_str!("../theory/05b-corrected-single-body.md")]
pub mod corrected_single_body {}
#[doc = include_str!("../theory/06-trailers.md")]
pub mod trailers {}
#[doc = include_str!("../theory/07-ideal-limit.md")]
pub mod ideal_limit {}
#[doc = include_str!("../theory/08-simulation.md")]
pub mod simulation {}
#[doc = include_str!("../theory/09-planning.md")]
pub mod planning {}
#[doc = include_str!("../theory/09b-symmetry.md")]
pub mod symmetry {}
#[doc = include_str!("../theory/10-viscous.md")]
pub mod viscous {}
#[doc = include_str!("../theory/10a-creep-dynamics.md")]
pub mod creep_dynamics {}
#[doc = include_str!("../theory/10-open.md")]
pub mod open {}
#[doc = include_str!("../CONTRIBUTING.md")]
pub mod extending {}
// Generated text quotes the paper's references, such as [8,9].
#[allow(rustdoc::broken_intra_doc_links)]
#[doc = include_str!("../theory/ERRATA.md")]
pub mod errata {}
#[allow(rustdoc::broken_intra_doc_links)]
#[doc = include_str!("../theory/CONTENTS.md")]
pub mod contents {}
