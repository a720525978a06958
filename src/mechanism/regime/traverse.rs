//! Regimes of traverse creep: side-slip, creep to the right, ideal, creep to the left.

use super::coefficient::coefficient;
use super::limits::Limits;
use std::fmt;

/// What a coefficient of traverse creep is called.
///
/// e_tc = v_t/v_l
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | v_l | m/s | speed of the contact along its heading |
/// | v_t | m/s | its speed to the left |
/// | e_tc | 1 | coefficient of traverse creep |
///
/// Valid for v_l ≠ 0: a pure side slide has no coefficient and is [`Undefined`](Self::Undefined). The words left and
/// right are relative to the direction of travel, so that they hold for v_l < 0 too: a contact that travels backward
/// and moves to the body's left moves to the right of where it goes, and e_tc < 0. [`TraverseMotion`] tells the body's
/// side. Outside the open interval (e₂, e₁) the contact is in side-slip; the paper names no regime there. Source:
/// equations (16)–(19), section 5 of the theory, errata E8 and E11.
///
/// ```
/// use creepage::mechanism::{Limits, TraverseRegime};
/// let limits = Limits::new(-0.1, 0.1).unwrap();
/// assert_eq!(TraverseRegime::of(0.05, Some(limits)), TraverseRegime::LeftCreep);
/// assert_eq!(TraverseRegime::of(0.1, Some(limits)), TraverseRegime::SideSlip);
/// assert_eq!(TraverseRegime::of(f64::INFINITY, None), TraverseRegime::Undefined);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TraverseRegime {
    /// e₂ < e < 0: to the right of travel.
    RightCreep,
    /// e = 0: along the heading.
    Ideal,
    /// 0 < e < e₁: to the left of travel.
    LeftCreep,
    /// e ≤ e₂ or e ≥ e₁.
    SideSlip,
    /// There is no coefficient.
    Undefined,
}

impl TraverseRegime {
    /// The regime of a coefficient; by its sign alone without limits. A coefficient that is not finite is undefined.
    pub fn of(e: f64, limits: Option<Limits>) -> Self {
        match limits {
            _ if !e.is_finite() => Self::Undefined,
            Some(l) if e >= l.upper() || e <= l.lower() => Self::SideSlip,
            _ if e > 0.0 => Self::LeftCreep,
            _ if e < 0.0 => Self::RightCreep,
            _ => Self::Ideal,
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::RightCreep => "right-creep",
            Self::Ideal => "ideal",
            Self::LeftCreep => "left-creep",
            Self::SideSlip => "side-slip",
            Self::Undefined => "undefined",
        }
    }
}

impl fmt::Display for TraverseRegime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A side of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left of its heading.
    Left,
    /// Right of its heading.
    Right,
}

impl Side {
    fn of(v: f64) -> Option<Self> {
        match v {
            _ if v > 0.0 => Some(Self::Left),
            _ if v < 0.0 => Some(Self::Right),
            _ => None,
        }
    }

    fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// A motion of a contact and what it is called.
///
/// sgn e_tc = sgn(v_l·v_t)
///
/// | member | from | meaning |
/// |---|---|---|
/// | coefficient | v_t/v_l | the same for travel forward and backward |
/// | regime | the coefficient | relative to travel |
/// | of_body | sgn v_t | the side of the body the contact moves to |
/// | of_travel | sgn(v_l·v_t) | the side of its direction of travel; none where v_l = 0 |
///
/// Valid for every motion; where v_l = 0 there is no coefficient and no regime, and only the body's side is known.
/// Source: equations (16)–(17), errata E8 and E11.
///
/// ```
/// use creepage::mechanism::{Side, TraverseMotion, TraverseRegime};
/// let backward = TraverseMotion::of(-1.0, 0.1, None);
/// assert_eq!(backward.regime, TraverseRegime::RightCreep);
/// assert_eq!((backward.of_body, backward.of_travel), (Some(Side::Left), Some(Side::Right)));
/// let slide = TraverseMotion::of(0.0, 0.1, None);
/// assert_eq!((slide.regime, slide.of_body, slide.of_travel), (TraverseRegime::Undefined, Some(Side::Left), None));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraverseMotion {
    /// e_tc, where it exists.
    pub coefficient: Option<f64>,
    /// What it is called.
    pub regime: TraverseRegime,
    /// The side of the body that the contact moves to.
    pub of_body: Option<Side>,
    /// The side of its direction of travel that the contact moves to.
    pub of_travel: Option<Side>,
}

impl TraverseMotion {
    /// The regime of a contact that moves with `v_l` along its heading and `v_t` to the left of it, both in m/s.
    pub fn of(v_l: f64, v_t: f64, limits: Option<Limits>) -> Self {
        let e = coefficient(v_t, v_l);
        let of_body = Side::of(v_t);
        Self {
            coefficient: e,
            regime: e.map_or(TraverseRegime::Undefined, |e| TraverseRegime::of(e, limits)),
            of_body,
            of_travel: match v_l {
                _ if v_l > 0.0 => of_body,
                _ if v_l < 0.0 => of_body.map(Side::opposite),
                _ => None,
            },
        }
    }
}
