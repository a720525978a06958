//! The heading that a quaternion means.

/// The turn about z, rad; NaN for a quaternion that was never set.
pub(crate) fn yaw([x, y, z, w]: [f64; 4]) -> f64 {
    let square = x * x + y * y + z * z + w * w;
    if square < 0.5 { f64::NAN } else { (2.0 * (w * z + x * y)).atan2(w * w + x * x - y * y - z * z) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn yaw_is_the_turn_about_z() {
        for turn in [-3.0f64, -0.4, 0.0, 1.2, 3.1] {
            let (s, c) = (0.5 * turn).sin_cos();
            assert!((yaw([0.0, 0.0, s, c]) - turn).abs() < 1e-12);
            // Half a turn about x first, by hand: q = qz·qx.
            let rolled = [0.1f64.sin() * c, 0.1f64.sin() * s, s * 0.1f64.cos(), c * 0.1f64.cos()];
            assert!((yaw(rolled) - turn).abs() < 1e-12, "roll leaves it");
        }
        // On its back, about one axis and the other.
        assert_eq!([yaw([1.0, 0.0, 0.0, 0.0]), yaw([0.0, 1.0, 0.0, 0.0]).abs()], [0.0, std::f64::consts::PI]);
        assert!(yaw([0.0; 4]).is_nan());
    }
}
