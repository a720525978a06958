//! Momentum maps: the quantity that a symmetry of the kinetic energy conserves (Noether's theorem).

use super::zero_test::vanishes;
use super::{Part, Row};
use crate::error::{Error, Result};
use crate::formula::{Expr, Node, Symbol};
use std::collections::BTreeMap;

/// The momentum that a symmetry of a kinetic energy conserves while no force acts along it (Noether).
///
/// | symbol | meaning |
/// |---|---|
/// | T(q, q̇) | kinetic energy, quadratic in the rates |
/// | X(q) | generator: the symmetry moves q along X; T does not change |
/// | J = X·∂T/∂q̇ | momentum map, linear in the rates |
/// | s = J at q̇ = X | locked inertia |
/// | q₁ | the coordinate with X = 1 that measures the symmetry |
/// | h = J − s·q̇₁ | momentum that the change of shape carries |
///
/// J = 0 is a constraint like those of wheels, though no contact enforces it: s·q̇₁ + h = 0, for one shape rate q̇₃ the
/// form (20), q̇₁ − σ(q₂)·q̇₃ = 0 with σ = −h/(s·q̇₃). That T is unchanged, X(T) + Ẋ·∂T/∂q̇ = 0, is proved by the normal
/// form for all q and q̇. Source: paper, last paragraph of section 4; Marsden & Ratiu, Introduction to Mechanics and
/// Symmetry, ch. 11.
///
/// ```
/// use creepage::formula::Expr;
/// use creepage::mechanism::Momentum;
/// // The hopper: a body of inertia I, a leg of mass m at l + d from the hip.
/// let energy = Expr::parse("I*psi'^2/2 + m*(l + d)^2*(psi' + theta')^2/2 + m*l'^2/2").unwrap();
/// let found = Momentum::of(&energy, &[("psi".into(), Expr::int(1))]).unwrap();
/// assert_eq!(found.locked.to_string(), "I + m*(l + d)^2");
/// assert_eq!(found.shape.to_string(), "m*(l + d)^2*theta'");
/// let constraint = found.constraint("angular momentum", "e_sc").unwrap();
/// assert_eq!(constraint.form.slot("sigma").unwrap().expr().to_string(), "-(1 - e_sc)*(m*(l + d)^2)/(I + m*(l + d)^2)");
/// // Gravity on a leg off the hip would break the symmetry; so does an inertia that depends on psi.
/// let broken = Expr::parse("I*cos(psi)*psi'^2/2").unwrap();
/// assert!(Momentum::of(&broken, &[("psi".into(), Expr::int(1))]).is_err());
/// ```
#[derive(Clone, Debug)]
pub struct Momentum {
    /// J.
    pub map: Row,
    /// s.
    pub locked: Expr,
    /// q₁.
    pub along: Symbol,
    /// h.
    pub shape: Row,
}

impl Momentum {
    /// The momentum map of a kinetic energy and the generator of one of its symmetries, component by component.
    ///
    /// # Errors
    /// When the energy is not quadratic in the rates, is changed by the symmetry or not known to be unchanged, or no
    /// component of the generator is one.
    pub fn of(energy: &Expr, generator: &[(Symbol, Expr)]) -> Result<Self> {
        invariance(energy, generator)?;
        let atoms = Atoms::of(energy, generator);
        let map = generator.iter().try_fold(Row::default(), |map, (q, x)| {
            let momentum = linear(&atoms.energy.derivative(&q.rate()).tidy())?;
            Ok::<Row, Error>(map.plus(&atoms.hidden(x), &momentum))
        })?;
        let along = generator.iter().find(|(_, x)| x.is_one()).map(|(q, _)| q.clone());
        let along = along.ok_or_else(|| {
            Error::input("no component of the generator is 1").help(
                "choose coordinates of which one measures how far the symmetry has gone, as the angle of a body does",
            )
        })?;
        let at = |q: &Symbol| generator.iter().find(|(k, _)| k.rate() == *q).map(|(_, x)| atoms.hidden(x));
        let locked = map.terms().iter().filter_map(|(q, c)| Some(c * &at(q)?)).reduce(|sum, t| &sum + &t);
        let locked = locked.unwrap_or_default().tidy();
        let mut shape = map.clone();
        shape.add(along.rate(), &-&locked);
        Ok(Self { map: atoms.shown(&map), locked: atoms.restored(&locked), shape: atoms.shown(&shape), along })
    }
}

/// A linear form in rates.
fn linear(momentum: &Expr) -> Result<Row> {
    match Part::of(momentum)? {
        Part::Rates(row) => Ok(row),
        Part::Factor(f) if f.is_zero() => Ok(Row::default()),
        Part::Factor(f) => Err(Error::input(format!("the momentum {f} does not vanish at rest"))
            .help("the kinetic energy has to be quadratic in the rates")),
    }
}

/// That the energy is quadratic in the rates, and that the symmetry does not change it.
fn invariance(energy: &Expr, generator: &[(Symbol, Expr)]) -> Result<()> {
    let rates: Vec<Symbol> = energy.symbols().into_iter().filter(is_rate).collect();
    let twice = rates.iter().map(|r| &energy.derivative(r) * &Expr::sym(r.clone()));
    let twice = twice.reduce(|sum, t| &sum + &t).unwrap_or_default();
    if rates.is_empty() || !vanishes(&(&twice - &(&Expr::int(2) * energy))) {
        return Err(Error::input(format!("the energy {energy} is not known to be quadratic in the rates"))
            .help("write a kinetic energy, every term a product of two rates such as psi' and a factor"));
    }
    let slope = |(q, x): &(Symbol, Expr)| {
        // How the symmetry moves a rate: the rate of X along the motion.
        let moved = x.symbols().into_iter().map(|s| &x.derivative(&s) * &Expr::sym(s.rate()));
        let moved = moved.reduce(|sum, t| &sum + &t).unwrap_or_default();
        &(x * &energy.derivative(q)) + &(&moved * &energy.derivative(&q.rate()))
    };
    let change = generator.iter().map(slope).reduce(|sum, t| &sum + &t).unwrap_or_default();
    match vanishes(&change) {
        true => Ok(()),
        false => Err(Error::input("the symmetry changes the kinetic energy, so that it conserves no momentum")
            .help(format!("along it the energy changes by {}", change.tidy()))),
    }
}

fn is_rate(s: &Symbol) -> bool {
    s.as_str().ends_with('\'')
}

/// Factors without rates, each put away under a name, so that m·(l + d)² is not multiplied out.
struct Atoms {
    energy: Expr,
    names: BTreeMap<String, (Symbol, Expr)>,
}

impl Atoms {
    fn of(energy: &Expr, generator: &[(Symbol, Expr)]) -> Self {
        let mut atoms = Self { energy: Expr::default(), names: BTreeMap::new() };
        atoms.energy = atoms.put_away(energy);
        for (_, x) in generator {
            atoms.put_away(x);
        }
        atoms
    }

    /// The formula with its largest parts without rates named.
    fn put_away(&mut self, e: &Expr) -> Expr {
        if e.as_number().is_some() {
            return e.clone();
        }
        if !e.symbols().iter().any(is_rate) {
            let name = Symbol::new(&format!("_{}", self.names.len()));
            return Expr::sym(self.names.entry(e.to_string()).or_insert((name, e.clone())).0.clone());
        }
        match e.node() {
            Node::Call(..) => e.clone(),
            _ => e.with_parts(|part| self.put_away(part)),
        }
    }

    /// A component of the generator under its name.
    fn hidden(&self, x: &Expr) -> Expr {
        self.names.get(&x.to_string()).map_or_else(|| x.clone(), |(name, _)| Expr::sym(name.clone()))
    }

    fn restored(&self, e: &Expr) -> Expr {
        e.substitute(&|s| self.names.values().find(|(name, _)| name == s).map(|(_, e)| e.clone()))
    }

    fn shown(&self, row: &Row) -> Row {
        Row::as_written(row.terms().iter().map(|(rate, c)| (rate.clone(), self.restored(c))).collect())
    }
}
