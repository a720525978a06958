//! Connections: how far a change of shape turns a body on which no moment acts.
//!
//! Where a momentum is zero, a change of the shape r moves the position g: ġ = Σ aᵢ(r)·ṙᵢ for one angle g, and
//! ω = Σ Aᵢ(r)·ṙᵢ for an orientation in space. The coefficients are the local form of a connection.
//!
//! | question | answer |
//! |---|---|
//! | does the shape alone decide where the body stands? | exactly if the curvature is zero: [`Connection::is_flat`] |
//! | how far does a loop of shapes turn it? | by the phase, ∮ a·dr or the curvature over a surface: [`Connection::phase`] |
//! | what if air resists? | the momentum is no longer zero and remembers the motion: [`Drag`] |
//! | and in three dimensions? | turns do not commute: [`RotationConnection`] |
//!
//! A connection is made of a [`Momentum`](crate::mechanism::Momentum), of the row of a constraint, or given by formulas;
//! all derivatives are exact. Source: paper, last paragraph of section 4; Marsden, Montgomery & Ratiu, Reduction,
//! symmetry, and phases in mechanics, Mem. AMS 436 (1990); Montgomery, Gauge theory of the falling cat (1993).
//!
//! ```
//! use creepage::connection::{Connection, Path};
//! // A point dragged round a cone's axis: the angle by which it comes back turned is the area it goes round.
//! let disk = Connection::new("g", &[("u", "-v/2"), ("v", "u/2")]).unwrap();
//! assert_eq!(disk.curvature(0, 1).tidy().to_string(), "1");
//! let circle = Path::new(&[("u", "cos(t)"), ("v", "sin(t)")], [0.0, std::f64::consts::TAU]).unwrap();
//! let area = disk.phase(&circle, &[]).unwrap();
//! assert!((area - std::f64::consts::PI).abs() < 1e-14);
//! assert!((area - disk.phase_by_area(&circle, &[]).unwrap()).abs() < 1e-14);
//! ```

mod abelian;
mod bodies;
mod drag;
mod path;
mod quadrature;
mod rotation;
mod space;

pub use abelian::Connection;
pub use bodies::PlanarBody;
#[doc(hidden)]
pub use bodies::floating_energy;
pub use drag::Drag;
pub use path::Path;
#[doc(hidden)]
pub use rotation::Rotation;
pub use rotation::RotationConnection;
#[doc(hidden)]
pub use space::{Axis, Matrix, turned};
