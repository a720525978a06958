//! Regimes of rotation creep: skidding, forward creep, ideal rolling, backward creep, slipping.

use super::coefficient::coefficient;
use super::limits::Limits;
use std::fmt;

/// What a coefficient of rotation creep is called.
///
/// e_rc = 1 − v_l/(r·ω)
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | v_l | m/s | speed of the contact's wheel along its heading |
/// | r·ω | m/s | rolling radius times rate of the wheel |
/// | e_rc | 1 | coefficient of rotation creep |
///
/// Valid for r·ω ≠ 0: a locked wheel has no coefficient and is [`Undefined`](Self::Undefined). The words forward and
/// backward are relative to the spin: they name the way the contact slides over the ground for ω > 0, and the opposite
/// way for ω < 0 ([`RotationMotion`] tells which). Source: equations (8)–(12), section 5 of the theory, errata E7 and
/// E11.
///
/// ```
/// use creepage::mechanism::{Limits, RotationRegime};
/// let limits = Limits::new(-0.2, 0.3).unwrap();
/// assert_eq!(RotationRegime::of(0.3, Some(limits)), RotationRegime::Slipping);
/// assert_eq!(RotationRegime::of(0.3, None), RotationRegime::BackwardCreep);
/// assert_eq!(RotationRegime::of(f64::NAN, None), RotationRegime::Undefined);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RotationRegime {
    /// e ≤ e₂: braked beyond the limit.
    Skidding,
    /// e₂ < e < 0: it travels more than it turns.
    ForwardCreep,
    /// e = 0: rolling without creep.
    Ideal,
    /// 0 < e < e₁: it turns more than it travels.
    BackwardCreep,
    /// e ≥ e₁: driven beyond the limit.
    Slipping,
    /// There is no coefficient.
    Undefined,
}

impl RotationRegime {
    /// The regime of a coefficient; by its sign alone without limits. A coefficient that is not finite is undefined.
    pub fn of(e: f64, limits: Option<Limits>) -> Self {
        match limits {
            _ if !e.is_finite() => Self::Undefined,
            Some(l) if e >= l.upper() => Self::Slipping,
            Some(l) if e <= l.lower() => Self::Skidding,
            _ if e > 0.0 => Self::BackwardCreep,
            _ if e < 0.0 => Self::ForwardCreep,
            _ => Self::Ideal,
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Skidding => "skidding",
            Self::ForwardCreep => "forward-creep",
            Self::Ideal => "ideal",
            Self::BackwardCreep => "backward-creep",
            Self::Slipping => "slipping",
            Self::Undefined => "undefined",
        }
    }
}

impl fmt::Display for RotationRegime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Values of e_rc that mean something without limits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Landmark {
    /// e_rc = 1: it spins on the spot, v_l = 0.
    SpinOnTheSpot,
    /// e_rc > 1: it travels against its spin.
    AgainstItsSpin,
}

impl Landmark {
    /// The landmark of a coefficient; `None` below one and where there is no coefficient.
    ///
    /// ```
    /// use creepage::mechanism::Landmark;
    /// assert_eq!(Landmark::of(1.0), Some(Landmark::SpinOnTheSpot));
    /// assert_eq!(Landmark::of(1.5), Some(Landmark::AgainstItsSpin));
    /// assert_eq!(Landmark::of(0.5), None);
    /// ```
    pub fn of(e: f64) -> Option<Self> {
        match e {
            _ if !e.is_finite() => None,
            1.0 => Some(Self::SpinOnTheSpot),
            _ if e > 1.0 => Some(Self::AgainstItsSpin),
            _ => None,
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::SpinOnTheSpot => "spins on the spot",
            Self::AgainstItsSpin => "travels against its spin",
        }
    }
}

/// Along the heading of a wheel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Where it points.
    Forward,
    /// The opposite way.
    Backward,
}

/// A rolling motion and what it is called.
///
/// v_A = v_l − r·ω = −e_rc·r·ω
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | v_A | m/s | velocity of the contact over the ground, forward positive |
///
/// The coefficient does not change when all velocities change sign, so backward-creep means a contact that slides
/// backward for ω > 0 and forward for ω < 0; `contact` is the way itself. Valid for every motion; without spin there
/// is no coefficient and no regime. Source: equations (3)–(12), errata E6, E7 and E11.
///
/// ```
/// use creepage::mechanism::{RotationMotion, RotationRegime, Way};
/// let driven = RotationMotion::of(0.9, 1.0, None);
/// assert_eq!((driven.regime, driven.contact), (RotationRegime::BackwardCreep, Some(Way::Backward)));
/// let in_reverse = RotationMotion::of(-0.9, -1.0, None);
/// assert_eq!((in_reverse.regime, in_reverse.contact), (RotationRegime::BackwardCreep, Some(Way::Forward)));
/// let locked = RotationMotion::of(1.0, 0.0, None);
/// assert_eq!((locked.regime, locked.coefficient), (RotationRegime::Undefined, None));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotationMotion {
    /// e_rc, where it exists.
    pub coefficient: Option<f64>,
    /// What it is called.
    pub regime: RotationRegime,
    /// What else it means.
    pub landmark: Option<Landmark>,
    /// The way the contact slides over the ground; `None` where it does not, or the motion is not known.
    pub contact: Option<Way>,
}

impl RotationMotion {
    /// The regime of a wheel that travels with `v_l` and turns with `spin` = r·ω, both in m/s.
    pub fn of(v_l: f64, spin: f64, limits: Option<Limits>) -> Self {
        // (rω − v_l)/(rω) and not 1 − v_l/(rω): the difference of near speeds is exact.
        let e = coefficient(spin - v_l, spin);
        Self {
            coefficient: e,
            regime: e.map_or(RotationRegime::Undefined, |e| RotationRegime::of(e, limits)),
            landmark: e.and_then(Landmark::of),
            contact: match v_l - spin {
                v if v > 0.0 => Some(Way::Forward),
                v if v < 0.0 => Some(Way::Backward),
                _ => None,
            },
        }
    }
}
