//! Truncated power series as a carrier: a formula and all its derivatives at a point, exactly.

mod layout;
mod taylor;

pub use layout::Layout;

use super::{BigRational, Exact, Fun, Scalar, Symbol};
use num_traits::{One, Zero};
use std::collections::BTreeMap;
use std::sync::Arc;
use taylor::taylor;

/// c + n: an exact constant and a power series without constant term, cut above an order.
///
/// | part | is |
/// |---|---|
/// | c | an [`Exact`] number or angle |
/// | n | rational Taylor coefficients (derivative over factorial) of the deviations from the point |
///
/// Sums, products, reciprocals and sin, cos, tan, cot, atan, √ follow the series; every other function is defined
/// for constants only. Undefined is what [`Exact`] leaves undefined at the point, a product with an angle that is
/// not a whole multiple, and an operation on series of different layouts.
///
/// ```
/// use creepage::formula::{Exact, Expr, Jet, Layout};
/// use std::sync::Arc;
/// let layout = Arc::new(Layout::new(vec!["phi".into()], 2));
/// let phi = Jet::variable(&layout, &"phi".into(), Exact::direction(3.into(), 4.into()));
/// let sine = Expr::parse("sin(phi)").unwrap().eval(&|_| phi.clone()).unwrap();
/// // 4/5 + 3/5·u − 2/5·u²
/// assert_eq!(sine.constant().to_string(), "4/5");
/// assert_eq!(sine.coefficient(&[1]).to_string(), "3/5");
/// assert_eq!(sine.coefficient(&[2]).to_string(), "-2/5");
/// ```
#[derive(Clone, Debug)]
pub struct Jet {
    /// None for a constant that has met no series yet.
    layout: Option<Arc<Layout>>,
    constant: Exact,
    /// Coefficients by monomial; none is zero and none is that of the monomial 1.
    terms: BTreeMap<usize, BigRational>,
}

impl Jet {
    /// A constant.
    pub fn fixed(value: Exact) -> Self {
        Self { layout: None, constant: value, terms: BTreeMap::new() }
    }

    /// A variable of the layout near a value; another name is a constant.
    pub fn variable(layout: &Arc<Layout>, name: &Symbol, at: Exact) -> Self {
        let place = layout.variables().iter().position(|v| v == name);
        let unit: Vec<u32> = (0..layout.variables().len()).map(|v| u32::from(Some(v) == place)).collect();
        let term = place.and_then(|_| layout.monomial(&unit)).map(|m| (m, BigRational::one()));
        Self { layout: Some(layout.clone()), constant: at, terms: term.into_iter().collect() }.checked()
    }

    /// The constant term.
    pub fn constant(&self) -> &Exact {
        &self.constant
    }

    /// The Taylor coefficient of a monomial of degree one or more, by its exponents; zero for what is not there.
    pub fn coefficient(&self, powers: &[u32]) -> BigRational {
        let monomial = self.layout.as_ref().and_then(|l| l.monomial(powers));
        monomial.and_then(|m| self.terms.get(&m)).cloned().unwrap_or_else(BigRational::zero)
    }

    /// The coefficients that are not zero, by the monomials of the layout, the constant term apart.
    pub fn terms(&self) -> &BTreeMap<usize, BigRational> {
        &self.terms
    }

    /// Whether the whole series is the number zero.
    pub fn is_zero(&self) -> bool {
        self.terms.is_empty() && self.constant.as_rational().is_some_and(Zero::is_zero)
    }

    fn undefined() -> Self {
        Self::fixed(Exact::ratio(0, 0))
    }

    /// An undefined value has no terms.
    fn checked(self) -> Self {
        if self.constant.is_defined() { self } else { Self::undefined() }
    }

    /// The layout of both; an error when they have two.
    fn shared_layout(&self, other: &Self) -> Result<Option<Arc<Layout>>, ()> {
        match (&self.layout, &other.layout) {
            (Some(a), Some(b)) if !Arc::ptr_eq(a, b) && a != b => Err(()),
            (Some(a), _) | (None, Some(a)) => Ok(Some(a.clone())),
            (None, None) => Ok(None),
        }
    }

    fn map(&self, constant: Exact, f: impl Fn(&BigRational) -> BigRational) -> Self {
        let terms = self.terms.iter().map(|(m, v)| (*m, f(v))).filter(|(_, v)| !v.is_zero());
        Self { layout: self.layout.clone(), constant, terms: terms.collect() }.checked()
    }

    fn scaled(&self, factor: &BigRational) -> Self {
        self.map(self.constant.mul(&Exact::rational(factor.clone())), |v| v * factor)
    }

    /// n of c + n.
    fn nilpotent(&self) -> Self {
        Self { constant: Exact::ratio(0, 1), ..self.clone() }
    }

    /// The series Σ aₖ·nᵏ of a function at c, without its value at c.
    fn composed(&self, slopes: &[BigRational]) -> Self {
        let n = self.nilpotent();
        let outer = |sum: Self, a: &BigRational| sum.add(&Self::number(a)).mul(&n);
        slopes.iter().rev().fold(Self::number(&BigRational::zero()), outer)
    }
}

/// Adds to a coefficient; what becomes zero is dropped.
fn add_term(terms: &mut BTreeMap<usize, BigRational>, monomial: usize, value: BigRational) {
    let entry = terms.entry(monomial).or_insert_with(BigRational::zero);
    *entry += value;
    if entry.is_zero() {
        terms.remove(&monomial);
    }
}

/// The product of two series without constant terms.
fn product(layout: &Layout, a: &Jet, b: &Jet) -> BTreeMap<usize, BigRational> {
    let mut terms = BTreeMap::new();
    for (i, v) in &a.terms {
        let places = layout.products(*i);
        // Monomials come by rising degree, so all later ones are cut off too.
        for (j, w) in b.terms.iter().take_while(|(j, _)| **j < places.len()) {
            add_term(&mut terms, places[*j], v * w);
        }
    }
    terms
}

impl Scalar for Jet {
    fn number(value: &BigRational) -> Self {
        Self::fixed(Exact::rational(value.clone()))
    }

    fn add(&self, other: &Self) -> Self {
        let Ok(layout) = self.shared_layout(other) else { return Self::undefined() };
        let mut sum = Self { layout, constant: self.constant.add(&other.constant), terms: self.terms.clone() };
        other.terms.iter().for_each(|(m, v)| add_term(&mut sum.terms, *m, v.clone()));
        sum.checked()
    }

    fn neg(&self) -> Self {
        self.map(self.constant.neg(), |v| -v)
    }

    fn mul(&self, other: &Self) -> Self {
        let Ok(layout) = self.shared_layout(other) else { return Self::undefined() };
        match (self.constant.as_rational(), other.constant.as_rational()) {
            (Some(a), _) if self.terms.is_empty() => Self { layout, ..other.scaled(a) },
            (_, Some(b)) if other.terms.is_empty() => Self { layout, ..self.scaled(b) },
            (Some(a), Some(b)) => {
                let terms = layout.as_ref().map(|l| product(l, self, other)).unwrap_or_default();
                let both = Self { layout, constant: Exact::rational(a * b), terms };
                both.add(&other.nilpotent().scaled(a)).add(&self.nilpotent().scaled(b))
            }
            // An angle is known up to whole turns only: it has no product with what varies.
            _ => Self::undefined(),
        }
    }

    fn recip(&self) -> Self {
        let constant = self.constant.recip();
        let Some(inverse) = constant.as_rational().cloned() else { return Self::undefined() };
        // 1/(c + n) = 1/c − n/c² + n²/c³ − …
        let order = self.layout.as_ref().map_or(0, |l| l.order());
        let slopes = (0..order).scan(inverse.clone(), |power, _| {
            *power = -(&*power * &inverse);
            Some(power.clone())
        });
        let rest = self.composed(&slopes.collect::<Vec<_>>());
        Self { layout: self.layout.clone(), ..rest.add(&Self::fixed(constant)) }
    }

    fn call(f: Fun, x: &Self) -> Self {
        if x.terms.is_empty() {
            return Self { layout: x.layout.clone(), ..Self::fixed(Exact::call(f, &x.constant)) };
        }
        let order = x.layout.as_ref().map_or(0, |l| l.order());
        match taylor(f, &x.constant, order) {
            Some((value, slopes)) => x.composed(&slopes).add(&Self::fixed(value)),
            None => Self::undefined(),
        }
    }

    fn is_defined(&self) -> bool {
        self.constant.is_defined()
    }

    fn equals(&self, other: &Self) -> bool {
        let comparable = self.shared_layout(other).is_ok();
        comparable && self.constant.equals(&other.constant) && self.terms == other.terms
    }
}
