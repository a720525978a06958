//! Integrators of ordinary differential equations: explicit Runge–Kutta of order 8, Radau for stiff ones, and quadrature.

pub(crate) mod dop853;
pub(crate) mod gauss_legendre;
pub(crate) mod integrator;
pub(crate) mod radau;
pub(crate) mod tableau;
