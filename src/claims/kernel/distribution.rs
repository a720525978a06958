//! A distribution with polynomial coefficients: constraints cleared of divisors, and motions by elimination over the
//! quotients of trigonometric polynomials.

use crate::claims::counted::Counted;
use crate::formula::{BigRational, Expr, Fun, Node, Normal, Scalar, Symbol};
use crate::mechanism::distribution_basis::{eliminate, motion};
use crate::mechanism::{Point, Row};
use num_traits::Zero;

/// A growth vector with everything that another kernel needs to count it again.
pub(super) struct Distribution {
    /// q.
    pub coordinates: Vec<Symbol>,
    /// How many constraints are independent.
    pub rank: usize,
    /// Constraints, a polynomial a rate, in coordinates and their sines and cosines.
    pub rows: Vec<Vec<Expr>>,
    /// A basis of the motions, likewise.
    pub motions: Vec<Vec<Expr>>,
    /// Functions that no motion changes.
    pub integrals: Vec<Expr>,
    /// Where the growth vector is counted, a place a coordinate.
    pub at: Vec<Place>,
    /// dim Δ, dim Δ², ….
    pub growth: Vec<usize>,
}

/// The value of a coordinate.
pub(super) enum Place {
    /// Cosine and sine of an angle.
    Angle(BigRational, BigRational),
    /// A number; zero where the value does not matter.
    Length(BigRational),
}

impl Distribution {
    /// The distribution with its lengths put in; nothing where a coefficient is no quotient of polynomials.
    pub fn of(counted: &Counted) -> Option<Self> {
        let (mechanism, at) = (&counted.mechanism, &counted.at);
        let numbers = Numbers { coordinates: &mechanism.coordinates, at };
        let rates = mechanism.rates();
        let row = |row: &Row| {
            let coefficients: Option<Vec<Normal>> =
                rates.iter().map(|r| numbers.put_into(&row.coefficient(r))).collect();
            cleared(&coefficients?)
        };
        let matrix: Vec<Vec<Normal>> = mechanism.ideal_rows().iter().map(row).collect::<Option<_>>()?;
        let motions = motions(&matrix, at)?;
        let integrals = counted.found.integrals.iter().map(|i| numbers.put_into(&i.formula).map(|h| polynomial(&h)));
        Some(Self {
            coordinates: mechanism.coordinates.clone(),
            rank: counted.found.growth.rank,
            rows: matrix.iter().map(|row| row.iter().map(polynomial).collect()).collect(),
            motions: motions.iter().map(|field| field.iter().map(polynomial).collect()).collect(),
            integrals: integrals.collect::<Option<_>>()?,
            at: mechanism.coordinates.iter().map(|q| place(at, q)).collect(),
            growth: counted.found.growth.dimensions.clone(),
        })
    }
}

/// The value of a coordinate at a configuration.
fn place(at: &Point, q: &Symbol) -> Place {
    let part = |f| at.number(&Expr::call(f, &Expr::sym(q.clone())));
    match (at.value(q).as_rational(), part(Fun::Cos), part(Fun::Sin)) {
        (Some(value), ..) if !value.is_zero() => Place::Length(value.clone()),
        (_, Some(c), Some(s)) => Place::Angle(c, s),
        _ => Place::Length(BigRational::zero()),
    }
}

/// What stands for a number: every symbol but the coordinates.
struct Numbers<'a> {
    coordinates: &'a [Symbol],
    at: &'a Point,
}

impl Numbers<'_> {
    /// A formula in the coordinates alone; nothing outside of the reach of the normal form.
    fn put_into(&self, e: &Expr) -> Option<Normal> {
        let number = |s: &Symbol| {
            let value = self.at.value(s).as_rational().map(Expr::number);
            value.filter(|_| !self.coordinates.contains(s))
        };
        let spread = Some(Normal::of(&e.substitute(&number))).filter(Scalar::is_defined)?;
        let quotient = &self.mounted(&spread.numerator())? / &self.mounted(&spread.denominator())?;
        Some(Normal::of(&quotient)).filter(|n| n.is_defined() && self.is_of_coordinates(&polynomial(n)))
    }

    /// Sines and cosines of angles that are no coordinates, as numbers.
    fn mounted(&self, e: &Expr) -> Option<Expr> {
        if let (Node::Call(..), true) = (e.node(), e.symbols().iter().all(|s| !self.coordinates.contains(s))) {
            return self.at.number(e).as_ref().map(Expr::number);
        }
        let go = |x: &Expr| self.mounted(x);
        Some(match e.node() {
            Node::Num(_) | Node::Sym(_) | Node::Call(..) => e.clone(),
            Node::Neg(x) => -&go(x)?,
            Node::Add(a, b) => &go(a)? + &go(b)?,
            Node::Sub(a, b) => &go(a)? - &go(b)?,
            Node::Mul(a, b) => &go(a)? * &go(b)?,
            Node::Div(a, b) => &go(a)? / &go(b)?,
            Node::Pow(x, n) => go(x)?.pow(*n),
        })
    }

    fn is_of_coordinates(&self, e: &Expr) -> bool {
        e.symbols().iter().all(|s| self.coordinates.contains(s))
    }
}

/// The polynomial of a normal form whose divisor is a number.
fn polynomial(n: &Normal) -> Expr {
    &n.numerator() / &n.denominator()
}

/// The entries times what they are divided by, until that is a number; nothing where it does not end.
fn cleared(entries: &[Normal]) -> Option<Vec<Normal>> {
    let mut entries = entries.to_vec();
    for _ in 0..=entries.len() {
        let divisor = entries.iter().map(Normal::denominator).find(|d| d.as_number().is_none());
        let Some(divisor) = divisor else { return Some(entries) };
        let divisor = Normal::of(&divisor);
        entries = entries.iter().map(|e| e.mul(&divisor)).collect();
    }
    None
}

/// A basis of the kernel of a matrix near a configuration, cleared of divisors.
fn motions(matrix: &[Vec<Normal>], at: &Point) -> Option<Vec<Vec<Normal>>> {
    let width = matrix.first()?.len();
    let mut rows = matrix.to_vec();
    let pivots = eliminate(&mut rows, &Normal::is_zero, &|rows, pivots| pivot(rows, pivots, at));
    let rest = (0..rows.len()).filter(|r| pivots.iter().all(|(p, _)| p != r));
    if rest.flat_map(|r| &rows[r]).any(|v| !v.is_zero()) {
        return None;
    }
    let free = (0..width).filter(|c| pivots.iter().all(|(_, p)| p != c));
    free.map(|c| cleared(&motion(&rows, &pivots, c, width))).collect()
}

/// The entry with the shortest formula that is not zero at the configuration.
fn pivot(rows: &[Vec<Normal>], pivots: &[(usize, usize)], at: &Point) -> Option<(usize, usize)> {
    let open = (0..rows.len()).filter(|r| pivots.iter().all(|(p, _)| p != r));
    let entries = open.flat_map(|r| (0..rows[r].len()).map(move |c| (r, c)));
    let there = |(r, c): &(usize, usize)| {
        !rows[*r][*c].is_zero() && at.number(&polynomial(&rows[*r][*c])).is_some_and(|v| !v.is_zero())
    };
    entries.filter(there).min_by_key(|(r, c)| polynomial(&rows[*r][*c]).to_string().len())
}
