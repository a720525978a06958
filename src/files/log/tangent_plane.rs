//! Latitude and longitude as metres east and north.

/// Half the longer axis of the ellipsoid WGS 84, m.
const A: f64 = 6_378_137.0;
/// Its flattening.
const F: f64 = 1.0 / 298.257_223_563;

/// Points of the ellipsoid in the plane that touches it at the first of them, m.
///
/// With p(φ, λ) = N·(cos φ cos λ, cos φ sin λ, (1 − e²) sin φ), N = A/√(1 − e² sin² φ) and e² = F·(2 − F), a point lies
/// at (p − p₀)·(east, north).
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | φ, λ | rad | latitude, longitude |
/// | p₀ | m | the first point with numbers |
/// | east, north | 1 | unit vectors of its plane: (−sin λ₀, cos λ₀, 0), (−sin φ₀ cos λ₀, −sin φ₀ sin λ₀, cos φ₀) |
pub(crate) fn tangent_plane(latitude: &[f64], longitude: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let finite = |i: &usize| latitude[*i].is_finite() && longitude[*i].is_finite();
    let Some(first) = (0..latitude.len()).find(finite) else { return (latitude.to_vec(), longitude.to_vec()) };
    let start = point(latitude[first], longitude[first]);
    let ((sin, cos), (sin_l, cos_l)) = (latitude[first].sin_cos(), longitude[first].sin_cos());
    let (east, north) = ([-sin_l, cos_l, 0.0], [-sin * cos_l, -sin * sin_l, cos]);
    let places = latitude.iter().zip(longitude).map(|(&phi, &lambda)| {
        let p = point(phi, lambda);
        let along = |axis: &[f64; 3]| (0..3).map(|i| (p[i] - start[i]) * axis[i]).sum::<f64>();
        (along(&east), along(&north))
    });
    places.unzip()
}

fn point(phi: f64, lambda: f64) -> [f64; 3] {
    let e2 = F * (2.0 - F);
    let n = A / (1.0 - e2 * phi.sin().powi(2)).sqrt();
    [n * phi.cos() * lambda.cos(), n * phi.cos() * lambda.sin(), n * (1.0 - e2) * phi.sin()]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A second of arc by the radii of curvature, along the meridian and the parallel.
    #[test]
    fn small_steps_have_the_length_of_their_arcs() {
        let (phi, lambda, step) = (52.5f64.to_radians(), 13.4f64.to_radians(), (1.0f64 / 3600.0).to_radians());
        let (x, y) = tangent_plane(&[phi, phi + step, phi], &[lambda, lambda, lambda + step]);
        let e2 = F * (2.0 - F);
        let w = (1.0 - e2 * phi.sin().powi(2)).sqrt();
        let (meridian, parallel) = (A * (1.0 - e2) / w.powi(3) * step, A / w * phi.cos() * step);
        assert_eq!((x[0], y[0]), (0.0, 0.0));
        assert!((y[1] - meridian).abs() < 1e-4 && x[1].abs() < 1e-6, "{} {meridian}", y[1]);
        assert!((x[2] - parallel).abs() < 1e-4 && y[2].abs() < 1e-4, "{} {parallel}", x[2]);
    }

    /// Lengths of a degree at the equator, from tables of WGS 84: 110.574 km and 111.320 km.
    #[test]
    fn a_degree_has_the_length_of_the_tables() {
        let step = 1e-3f64.to_radians();
        let (x, y) = tangent_plane(&[0.0, step, 0.0], &[0.0, 0.0, step]);
        assert!((y[1] - 110.574).abs() < 1e-3 && (x[2] - 111.320).abs() < 1e-3, "{} {}", y[1], x[2]);
    }

    #[test]
    fn the_plane_touches_at_the_first_fix_with_numbers() {
        let (x, y) = tangent_plane(&[f64::NAN, 0.1, 0.1], &[0.0, 0.2, 0.2]);
        assert!(x[0].is_nan() && y[0].is_nan());
        assert_eq!((x[1], y[1], x[2], y[2]), (0.0, 0.0, 0.0, 0.0));
    }
}
