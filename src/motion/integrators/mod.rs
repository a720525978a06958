//! Integrators of ordinary differential equations: explicit Runge–Kutta of order 8, and Radau for stiff ones.

pub(crate) mod dop853;
pub(crate) mod integrator;
pub(crate) mod radau;
pub(crate) mod tableau;
