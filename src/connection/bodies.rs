//! The kinetic energy of planar bodies that float freely.

use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};

/// A rigid body of a system, seen from the system's own frame: place and angle are formulas of the shape.
///
/// ```
/// use creepage::connection::PlanarBody;
/// let arm = PlanarBody::new("2", "0.1", ["cos(alpha)", "sin(alpha)"], "alpha")?;
/// assert_eq!(arm.angle.to_string(), "alpha");
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct PlanarBody {
    /// Mass, kg.
    pub mass: Expr,
    /// Moment of inertia about its own centre of mass, kg·m².
    pub inertia: Expr,
    /// Centre of mass in the frame, m.
    pub place: [Expr; 2],
    /// Angle from the frame, rad.
    pub angle: Expr,
}

impl PlanarBody {
    /// A body by formulas: mass, inertia, x and y of its centre of mass, angle.
    ///
    /// # Errors
    /// When a formula is malformed.
    pub fn new(mass: &str, inertia: &str, place: [&str; 2], angle: &str) -> Result<Self> {
        let [x, y] = place;
        let place = [Expr::parse(x)?, Expr::parse(y)?];
        Ok(Self { mass: Expr::parse(mass)?, inertia: Expr::parse(inertia)?, place, angle: Expr::parse(angle)? })
    }
}

/// The kinetic energy of bodies about their common centre of mass, which moves uniformly.
///
/// T = ½·Σ m·|v|² − ½·|Σ m·v|²/Σ m + ½·Σ I·(φ̇ + α̇)²
///
/// | symbol | meaning |
/// |---|---|
/// | φ | angle of the frame, `frame` |
/// | v = φ̇ × p + Σ ∂p/∂rᵢ·ṙᵢ | velocity of a centre of mass, in the frame |
/// | α | angle of a body from the frame |
///
/// No place in the world and no φ occurs in it: it is unchanged by translations and turns. Source: König's theorem.
///
/// ```
/// use creepage::connection::{PlanarBody, floating_energy};
/// use creepage::mechanism::Momentum;
/// // Two bodies of equal mass at a distance: together they turn like a dumbbell.
/// let body = |x: &str| PlanarBody::new("m", "I", [x, "0"], "0").unwrap();
/// let energy = floating_energy("phi", &["l".into()], &[body("l"), body("-l")]).unwrap();
/// let turn = Momentum::of(&energy, &[("phi".into(), creepage::formula::Expr::int(1))]).unwrap();
/// let expected = creepage::formula::Expr::parse("2*I + 2*m*l^2").unwrap();
/// assert_eq!(creepage::formula::identical(&turn.locked, &expected), Some(true));
/// ```
///
/// # Errors
/// When there is no body.
pub fn floating_energy(frame: &str, shape: &[Symbol], bodies: &[PlanarBody]) -> Result<Expr> {
    let sum = |terms: Vec<Expr>| terms.into_iter().reduce(|a, b| &a + &b);
    let turn = Expr::sym(Symbol::new(frame).rate());
    let changes = |e: &Expr| {
        shape.iter().fold(Expr::int(0), |s, r| {
            let slope = e.derivative(r).tidy();
            if slope.is_zero() { s } else { &s + &(&slope * &Expr::sym(r.rate())) }
        })
    };
    let velocity = |b: &PlanarBody| {
        let [x, y] = &b.place;
        [&changes(x) - &(y * &turn), &changes(y) + &(x * &turn)]
    };
    let velocities: Vec<[Expr; 2]> = bodies.iter().map(velocity).collect();
    let each = bodies.iter().zip(&velocities);
    let moving = each.clone().map(|(b, [vx, vy])| &b.mass * &(&vx.pow(2) + &vy.pow(2))).collect();
    let turning = bodies.iter().map(|b| &b.inertia * &(&turn + &changes(&b.angle)).pow(2)).collect();
    let total = sum(bodies.iter().map(|b| b.mass.clone()).collect());
    let total = total.ok_or_else(|| Error::input("a system needs at least one body"))?;
    let carried = [0, 1].map(|k| sum(each.clone().map(|(b, v)| &b.mass * &v[k]).collect()).unwrap_or_default());
    let common = &(&carried[0].pow(2) + &carried[1].pow(2)) / &total;
    let all = &(&sum(moving).unwrap_or_default() - &common) + &sum(turning).unwrap_or_default();
    Ok(&all / &Expr::int(2))
}
