//! Equations of motion with forces, derived from the description of a vehicle.
//!
//! From the velocities of the bodies the kinetic energy T(q, q̇), from T the mass matrix M and the terms h of Coriolis
//! by symbolic derivatives, from the rows of the mechanism what each contact does:
//!
//! ```text
//! M·q̈ + h = Q + Σ f·∂slip/∂q̇        slip of an ideal contact = 0
//! ```
//!
//! | contact | force f along its slip | source |
//! |---|---|---|
//! | ideal | whatever keeps the slip zero: a multiplier of Lagrange and d'Alembert | (3), (14), (22)–(23) |
//! | `viscous` | −b·slip | (11), (18) |
//! | `rocard` | −k·slip/\|v\|, k times the creep angle | (2) |
//! | `elastic` | k_r·k_g·x_c with its own state x_c, which relaxes over a length | (1)–(2) |
//!
//! The slip of a rolling contact is v_A = v_l − r·ω (type R), of a direction v_t (type T), to the left.

mod carried;
mod compilation;
mod derive;
mod file;
mod linear_solution;
mod observed;
mod run;
mod start;
mod system;
mod two_formulations;

#[doc(hidden)]
pub use crate::model::forces::{Contact, LawParameter, Masses, TrailerMass};
pub use crate::model::forces::{Dynamics, Law, laws};
#[doc(hidden)]
pub use derive::Formulas;
#[doc(hidden)]
pub use file::{known, known_on, simulate_file, simulate_file_by};
#[doc(hidden)]
pub use run::simulate_dynamics;
#[doc(hidden)]
pub use start::Start;
#[doc(hidden)]
pub use system::System;
