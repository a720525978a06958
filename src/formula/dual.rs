//! Dual numbers as a carrier: exact first and second derivatives by automatic differentiation.

use super::rational::{BigRational, nearest_f64};
use super::{Fun, Scalar, float};
use nalgebra::{Dyn, U1};
use num_dual::{Derivative, Dual2, Dual2Vec, Dual64, DualNum, DualVec, HyperDual};

/// A number of `num-dual` as a carrier, for derivatives of any formula with respect to anything.
///
/// ```
/// use creepage::formula::{Dual, Expr};
/// use num_dual::Dual64;
/// let e = Expr::parse("cot(phi)").unwrap();
/// let d = e.eval(&|_| Dual(Dual64::new(0.5, 1.0))).unwrap().0;
/// assert!((d.eps + 1.0 / 0.5f64.sin().powi(2)).abs() < 1e-14);
/// ```
#[derive(Clone, Debug)]
pub struct Dual<D>(pub D);

/// The numbers a dual number is made of, so that "undefined" can be asked of all of them.
pub trait Parts {
    /// Whether value and derivatives are all finite.
    fn all_finite(&self) -> bool;
    /// Whether value and derivatives are all equal.
    fn all_equal(&self, other: &Self) -> bool;
    /// Whether all derivatives are zero.
    fn is_constant(&self) -> bool;
}

type Column = Derivative<f64, f64, Dyn, U1>;
type Row = Derivative<f64, f64, U1, Dyn>;
type Square = Derivative<f64, f64, Dyn, Dyn>;

/// The entries of a derivative; an absent one is zero and has none.
fn column(d: &Column) -> Vec<f64> {
    d.clone().unwrap_generic(Dyn(0), U1).data.into()
}

fn row(d: &Row) -> Vec<f64> {
    d.clone().unwrap_generic(U1, Dyn(0)).data.into()
}

fn square(d: &Square) -> Vec<f64> {
    d.clone().unwrap_generic(Dyn(0), Dyn(0)).data.into()
}

fn finite(entries: &[f64]) -> bool {
    entries.iter().all(|x| x.is_finite())
}

/// Whether entries are equal; an absent derivative equals one of zeros.
fn equal(a: &[f64], b: &[f64]) -> bool {
    if a.len() == b.len() { a == b } else { zero(a) && zero(b) }
}

fn zero(entries: &[f64]) -> bool {
    entries.iter().all(|x| *x == 0.0)
}

impl Parts for Dual64 {
    fn is_constant(&self) -> bool {
        self.eps == 0.0
    }
    fn all_finite(&self) -> bool {
        self.re.is_finite() && self.eps.is_finite()
    }
    fn all_equal(&self, o: &Self) -> bool {
        self.re == o.re && self.eps == o.eps
    }
}

impl Parts for Dual2<f64, f64> {
    fn is_constant(&self) -> bool {
        self.v1 == 0.0 && self.v2 == 0.0
    }
    fn all_finite(&self) -> bool {
        self.re.is_finite() && self.v1.is_finite() && self.v2.is_finite()
    }
    fn all_equal(&self, o: &Self) -> bool {
        self.re == o.re && self.v1 == o.v1 && self.v2 == o.v2
    }
}

impl Parts for HyperDual<f64, f64> {
    fn is_constant(&self) -> bool {
        zero(&[self.eps1, self.eps2, self.eps1eps2])
    }
    fn all_finite(&self) -> bool {
        [self.re, self.eps1, self.eps2, self.eps1eps2].iter().all(|x| x.is_finite())
    }
    fn all_equal(&self, o: &Self) -> bool {
        (self.re, self.eps1, self.eps2, self.eps1eps2) == (o.re, o.eps1, o.eps2, o.eps1eps2)
    }
}

impl Parts for DualVec<f64, f64, Dyn> {
    fn is_constant(&self) -> bool {
        zero(&column(&self.eps))
    }
    fn all_finite(&self) -> bool {
        self.re.is_finite() && finite(&column(&self.eps))
    }
    fn all_equal(&self, o: &Self) -> bool {
        self.re == o.re && equal(&column(&self.eps), &column(&o.eps))
    }
}

impl Parts for Dual2Vec<f64, f64, Dyn> {
    fn is_constant(&self) -> bool {
        zero(&row(&self.v1)) && zero(&square(&self.v2))
    }
    fn all_finite(&self) -> bool {
        self.re.is_finite() && finite(&row(&self.v1)) && finite(&square(&self.v2))
    }
    fn all_equal(&self, o: &Self) -> bool {
        let same = |a: &Self, b: &Self| equal(&row(&a.v1), &row(&b.v1)) && equal(&square(&a.v2), &square(&b.v2));
        self.re == o.re && same(self, o)
    }
}

impl<D: DualNum<f64> + Parts> Scalar for Dual<D> {
    fn number(value: &BigRational) -> Self {
        Dual(D::from(nearest_f64(value)))
    }
    fn add(&self, other: &Self) -> Self {
        Dual(self.0.clone() + other.0.clone())
    }
    fn neg(&self) -> Self {
        Dual(-self.0.clone())
    }
    fn mul(&self, other: &Self) -> Self {
        Dual(self.0.clone() * other.0.clone())
    }
    fn recip(&self) -> Self {
        Dual(self.0.recip()).checked(self)
    }
    fn powi(&self, n: i32) -> Self {
        // Products rather than the crate's powi, whose derivative of x⁰ and x¹ at zero is 0·∞.
        match n {
            0 => Dual(D::from(1.0)).checked(self),
            n if n < 0 => self.powi_positive(n.unsigned_abs()).recip(),
            n => self.powi_positive(n.unsigned_abs()),
        }
    }
    fn call(f: Fun, x: &Self) -> Self {
        let v = &x.0;
        if v.is_constant() {
            // Its derivative is zero also where the function has none: √x, |x| at zero.
            return Dual(D::from(float::call(f, v.re())));
        }
        Dual(match f {
            Fun::Sin => v.sin(),
            Fun::Cos => v.cos(),
            Fun::Tan => v.tan(),
            Fun::Cot => v.tan().recip(),
            Fun::Asin => v.asin(),
            Fun::Acos => v.acos(),
            Fun::Atan => v.atan(),
            Fun::Tanh => tanh(v),
            Fun::Exp => v.exp(),
            Fun::Ln => v.ln(),
            Fun::Sqrt => v.sqrt(),
            Fun::Abs | Fun::Sign | Fun::Step => return piecewise(f, x),
        })
        .checked(x)
    }
    fn is_defined(&self) -> bool {
        self.0.all_finite()
    }
    fn equals(&self, other: &Self) -> bool {
        self.is_defined() && self.0.all_equal(&other.0)
    }
}

/// tanh x; far from zero by e^(−2|x|), because a quotient of sinh and cosh overflows.
fn tanh<D: DualNum<f64>>(x: &D) -> D {
    if x.re().abs() < 1.0 {
        return x.tanh();
    }
    let sign = D::from(x.re().signum());
    let small = (x.clone() * &sign * D::from(-2.0)).exp();
    let one = D::from(1.0);
    (one.clone() - &small) / (one + small) * sign
}

/// |x|, sgn x and the step, whose derivatives do not exist at zero.
fn piecewise<D: DualNum<f64> + Parts>(f: Fun, x: &Dual<D>) -> Dual<D> {
    let re = x.0.re();
    let sign = if !x.is_defined() {
        return x.undefined();
    } else if re > 0.0 {
        1.0
    } else if re < 0.0 {
        -1.0
    } else {
        return x.undefined();
    };
    match f {
        Fun::Abs => Dual(x.0.clone() * D::from(sign)),
        Fun::Step => Dual(D::from(f64::max(sign, 0.0))),
        _ => Dual(D::from(sign)),
    }
}

impl<D: DualNum<f64> + Parts> Dual<D> {
    /// The result unless it, or what it came from, is undefined.
    fn checked(self, source: &Self) -> Self {
        if self.0.all_finite() && source.0.all_finite() { self } else { source.undefined() }
    }

    fn undefined(&self) -> Self {
        Dual(self.0.clone() * D::from(f64::NAN))
    }
}
