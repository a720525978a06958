//! Trailers: each hangs with a rigid bar on a point of the body ahead, and its axle does not slip
//! across (or creeps).

use super::contact::{Facing, Plane};

/// A trailer with its true dimensions.
#[derive(Debug, Clone, Copy)]
pub struct Trailer {
    /// Hitch to axle, m.
    pub length: f64,
    /// Hitch behind the axle ahead of it, m.
    pub hitch_offset: f64,
    /// Lateral over forward speed of its axle.
    pub e_tc: f64,
}

/// Yaw rates (rad/s) of the trailers behind an axle that faces somewhere, with its velocity and yaw rate.
///
/// The hitch is carried by the body ahead: `h = v − c·yaw·η`. The bar turns at `w` about it, so the
/// axle moves with `h − d·w·η₁`, and that has to be perpendicular to `η₁ − e·ξ₁`.
pub fn turning(trailers: &[Trailer], axle: (Facing, Plane, f64), headings: &[f64]) -> Vec<f64> {
    let mut ahead = axle;
    let mut rates = Vec::with_capacity(trailers.len());
    for (trailer, &heading) in trailers.iter().zip(headings) {
        let (front, velocity, yaw) = ahead;
        let hitch = velocity - front.side * (trailer.hitch_offset * yaw);
        let own = Facing::new(heading);
        let turning = (own.side - own.forward * trailer.e_tc).dot(&hitch) / trailer.length;
        ahead = (own, hitch - own.side * (trailer.length * turning), turning);
        rates.push(turning);
    }
    rates
}
