//! Effects that are the same under another name, proved from the formulas.
//!
//! | relation | what is proved |
//! |---|---|
//! | identical | F_a(y, u; p) = F_b(y, u; q(p)) for every state y, input u and value of p, and the reverse |
//! | contained | the same, but not the reverse: b has more parameters |
//! | first order | ∂F_a/∂p at zero is a combination of ∂F_b/∂q with constant coefficients |
//!
//! F gives the rates of what the sensor shows in terms of what it shows (the sensor's formulas inverted), and the
//! delay of the clock. States that no sensor sees keep their own rates.

mod carrier;
mod constant_coefficients;
mod decide;
mod equation;
mod family;
mod first_order;
mod heading_gauge;
mod linear_system;
mod motion;
mod numeric_rejection;
mod pair;
mod points;
mod proof;
mod relation;
mod reparametrisation;
mod solution;
mod tangent;
mod values;

pub use decide::relation;
pub use relation::{Change, Measured, Relation, TURN};
