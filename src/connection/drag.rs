//! A momentum that drag takes away: the creep of symmetry constraints.

use super::path::{Compiled, Path};
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol, identical};
use crate::mechanism::{Momentum, Part, Row};
use crate::motion::Integrator;
use std::collections::BTreeSet;

/// A momentum map with a resistance proportional to velocities.
///
/// | symbol | meaning |
/// |---|---|
/// | J = s·q̇₁ + h | momentum along the symmetry |
/// | D(q, q̇) | Rayleigh's dissipation function, half the power that is lost |
/// | J̇ = −X·∂D/∂q̇ | what resists |
///
/// Where the resistance is the rate of a function K of position and shape, J + K is constant: the momentum is what the
/// body *has moved* since it began, a memory, and no function of its present position and velocity. Source: E25 of the
/// errata; Chang & Jeon, Damping-induced self recovery phenomenon in mechanical systems with an unactuated cyclic
/// variable, J. Dyn. Syst. Meas. Control 135 (2013).
///
/// ```
/// use creepage::connection::Drag;
/// use creepage::formula::Expr;
/// use creepage::mechanism::Momentum;
/// let energy = Expr::parse("I*psi'^2/2 + m*(l + d)^2*(psi' + theta')^2/2").unwrap();
/// let turn = [("psi".into(), Expr::int(1))];
/// let momentum = Momentum::of(&energy, &turn).unwrap();
/// let air = Expr::parse("c_b*psi'^2/2 + c_l*(psi' + theta')^2/2").unwrap();
/// let drag = Drag::of(&momentum, &air, &turn).unwrap();
/// assert_eq!(drag.force.to_string(), "(c_b + c_l)*psi' + c_l*theta'");
/// assert_eq!(drag.memory(&["l".into()]).unwrap().to_string(), "(c_b + c_l)*psi + c_l*theta");
/// // What grows with the length of the leg has no such integral.
/// let air = Expr::parse("c_b*psi'^2/2 + c_l*(l + d)^2*(psi' + theta')^2/2").unwrap();
/// assert!(Drag::of(&momentum, &air, &turn).unwrap().memory(&["l".into()]).is_none());
/// ```
#[derive(Clone, Debug)]
pub struct Drag {
    /// J.
    pub momentum: Momentum,
    /// −J̇, a linear form in the rates.
    pub force: Row,
}

impl Drag {
    /// The drag of a dissipation function along a symmetry.
    ///
    /// # Errors
    /// When the dissipation function is not quadratic in the rates.
    pub fn of(momentum: &Momentum, dissipation: &Expr, generator: &[(Symbol, Expr)]) -> Result<Self> {
        let mut force = Row::default();
        for (q, x) in generator {
            match Part::of(&dissipation.derivative(&q.rate()).tidy())? {
                Part::Rates(row) => force = force.plus(x, &row),
                Part::Factor(f) if f.is_zero() => {}
                Part::Factor(f) => {
                    return Err(Error::input(format!("the drag {f} does not vanish at rest"))
                        .help("a dissipation function is quadratic in the rates"));
                }
            }
        }
        Ok(Self { momentum: momentum.clone(), force })
    }

    /// The coordinates whose rates stand in the drag or in the momentum.
    fn coordinates(&self) -> BTreeSet<Symbol> {
        let place = |rate: &Symbol| Symbol::new(rate.as_str().trim_end_matches('\''));
        self.force.rates().chain(self.momentum.map.rates()).map(place).collect()
    }

    /// Whether the drag is the rate of a function of position and shape: whether its curl is zero, by the normal form.
    /// `others` are coordinates whose rates do not occur. `None` where that does not decide.
    pub fn is_exact(&self, others: &[Symbol]) -> Option<bool> {
        let all: Vec<Symbol> = self.coordinates().into_iter().chain(others.iter().cloned()).collect();
        let slope = |i: usize, j: usize| self.force.coefficient(&all[i].rate()).derivative(&all[j]);
        let pairs = (0..all.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        pairs.map(|(i, j)| identical(&slope(i, j), &slope(j, i))).try_fold(true, |exact, next| Some(next? && exact))
    }

    /// K with K̇ = −J̇ where the coefficients of the drag are constant: J + K is conserved.
    pub fn memory(&self, others: &[Symbol]) -> Option<Expr> {
        let all: Vec<Symbol> = self.coordinates().into_iter().chain(others.iter().cloned()).collect();
        let constant = |c: &Expr| all.iter().all(|q| !c.mentions(q));
        let place = |rate: &Symbol| all.iter().find(|q| q.rate() == *rate).cloned();
        let terms = self.force.terms().iter();
        let term = |(rate, c): &(Symbol, Expr)| constant(c).then(|| Some(c * &Expr::sym(place(rate)?))).flatten();
        terms.map(term).try_fold(Expr::int(0), |sum, t| Some(&sum + &t?))
    }

    /// Position and momentum at the end of a path of shapes, from those at its beginning.
    ///
    /// q̇₁ = (J − h)/s and J̇ = −force are integrated to a relative 1e-13.
    ///
    /// # Errors
    /// When a formula uses a name without a value, or is undefined on the path.
    pub fn after(&self, path: &Path, start: [f64; 2], values: &[(&str, f64)]) -> Result<[f64; 2]> {
        let along = &self.momentum.along;
        let (q, j) = (along.as_str(), "J");
        let rate = &(&Expr::sym(j) - &path.along(&self.momentum.shape.expr())) / &path.along(&self.momentum.locked);
        let known = |s: &Symbol| (*s == along.rate()).then(|| rate.clone());
        let force = path.along(&self.force.expr()).substitute(&known);
        let mut compiled = Compiled::new(&[rate.clone(), -&force], &["t", q, j], values)?;
        let rhs = |t: f64, y: &[f64], dy: &mut [f64]| compiled.values(&[t, y[0], y[1]], dy);
        let [from, to] = path.times;
        let end = Integrator::default().with_tolerance(1e-13, 1e-15).solve(rhs, from, &start, &[to])?;
        Ok([end[0][0], end[0][1]])
    }
}
