//! Rates and energy of the wheel of Fig. 7 at an instant, under a reading of the energy rule.

use super::readings::{DATA, at, wheel};
use crate::energy_rule::Reading;
use crate::error::{Error, Result};

/// What the wheel of Fig. 7 does at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instantaneous {
    /// φ̇, rad/s
    pub yaw_rate: f64,
    /// θ̇, rad/s
    pub wheel_rate: f64,
    /// m·|v|² + I·φ̇² + J·θ̇², twice the kinetic energy, J
    pub energy: f64,
}

/// Rates and energy of a case of Fig. 7 under a reading at given times.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | e_rc, e_tc | 1 | coefficients of (24) and (25) |
/// | m, I, J | kg, kg·m² | 1, 0.5 and 1: data of the paper |
/// | v | m/s | velocity of the wheel, v_l and v_t both, from the model's equations of motion |
///
/// The rule of the paper is that m·v² + I·ω_z² + J·ω² is that of the ideal wheel. Source: paper, *Simulation*;
/// theory/08-simulation, errata E22 and E23.
///
/// # Errors
/// When the rule leaves nothing for a rate.
///
/// ```
/// use creepage::energy_rule::{Reading, fig7_instants};
/// let ideal = fig7_instants(0.0, 0.0, Reading::NonConservative, &[0.0]).unwrap()[0];
/// assert!((ideal.energy - 5.5).abs() < 1e-12);
/// let crept = fig7_instants(-0.1, -0.2, Reading::A, &[0.0]).unwrap()[0];
/// assert!((crept.energy - 5.5).abs() < 1e-12 && crept.yaw_rate < 1.0);
/// ```
pub fn fig7_instants(e_rc: f64, e_tc: f64, reading: Reading, times: &[f64]) -> Result<Vec<Instantaneous>> {
    let (wheel, rates) = (wheel(e_rc, e_tc)?, reading.rates(e_rc, e_tc)?);
    let mut w = wheel.workspace(&[]);
    let instant = |t: &f64| {
        let [yaw_rate, wheel_rate] = at(&rates, *t);
        let input = |name: &crate::formula::Symbol| if name.as_str() == "yaw_rate" { yaw_rate } else { wheel_rate };
        let u: Vec<f64> = wheel.inputs.iter().map(input).collect();
        let mut moved = [0.0; 3];
        wheel.rates(&mut w, &[0.0; 3], &u, &mut moved);
        let squares = [moved[0].powi(2) + moved[1].powi(2), yaw_rate.powi(2), wheel_rate.powi(2)];
        let energy = ["m", "I", "J"].iter().zip(squares).map(|(name, square)| datum(name) * square).sum::<f64>();
        match energy.is_finite() {
            true => Ok(Instantaneous { yaw_rate, wheel_rate, energy }),
            false => Err(Error::run(format!("the rates of reading {} are undefined at t = {t}", reading.name()))),
        }
    };
    times.iter().map(instant).collect()
}

/// A number of the paper's data by its symbol.
fn datum(name: &str) -> f64 {
    DATA.iter().find(|(s, _)| *s == name).map_or(f64::NAN, |(_, v)| *v)
}
