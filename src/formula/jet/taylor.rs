//! The Taylor coefficients of the functions of the language at an exact place.

use crate::formula::{BigRational, Exact, Fun, Scalar};
use dashu_base::Inverse;
use num_traits::{One, Zero};

/// f(c) and the coefficients of u, u², … up to the order in f(c + u); `None` where they are not exact or not known.
///
/// | f | coefficients from | defined for |
/// |---|---|---|
/// | sin, cos | sin c and cos c in turn, over k! | an angle with rational sine and cosine |
/// | tan, cot | t′ = ±(1 + t²) | any angle off its poles |
/// | atan | t′ = 1/(1 + c²) as a series | any number |
/// | √ | (k + 1)·aₖ₊₁ = (½ − k)·aₖ/c | squares of rationals other than 0 |
pub(super) fn taylor(f: Fun, c: &Exact, order: usize) -> Option<(Exact, Vec<BigRational>)> {
    let value = Exact::call(f, c);
    let here = || value.as_rational().cloned();
    let slopes = match f {
        Fun::Sin | Fun::Cos => {
            let other = Exact::call(if f == Fun::Sin { Fun::Cos } else { Fun::Sin }, c);
            let slope = if f == Fun::Sin { other } else { other.neg() };
            circular(&here()?, slope.as_rational()?, order)
        }
        Fun::Tan => riccati(here()?, &BigRational::one(), order),
        Fun::Cot => riccati(here()?, &-BigRational::one(), order),
        Fun::Atan => arc(c.as_rational()?, order),
        Fun::Sqrt => root(here()?, c.as_rational().filter(|c| !c.is_zero())?, order),
        _ => return None,
    };
    Some((value, slopes))
}

fn whole(n: usize) -> BigRational {
    BigRational::from(n)
}

/// A function with f″ = −f, from its value and slope.
fn circular(value: &BigRational, slope: &BigRational, order: usize) -> Vec<BigRational> {
    let turn = [value.clone(), slope.clone(), -value, -slope];
    let mut factorial = BigRational::one();
    let coefficient = |k: usize| {
        factorial *= whole(k);
        &turn[k % 4] / &factorial
    };
    (1..=order).map(coefficient).collect()
}

/// A function with f′ = sign·(1 + f²), from its value.
fn riccati(value: BigRational, sign: &BigRational, order: usize) -> Vec<BigRational> {
    let mut a = vec![value];
    for k in 0..order {
        let square = (0..=k).fold(BigRational::zero(), |sum, i| sum + &a[i] * &a[k - i]);
        let one = if k == 0 { BigRational::one() } else { BigRational::zero() };
        a.push(sign * (one + square) / whole(k + 1));
    }
    a.split_off(1)
}

/// The arc tangent: its slope is 1/(1 + (c + u)²).
fn arc(c: &BigRational, order: usize) -> Vec<BigRational> {
    let size = BigRational::one() + c * c;
    let mut slope: Vec<BigRational> = Vec::with_capacity(order);
    for k in 0..order {
        slope.push(match k {
            0 => (&size).inv(),
            1 => -(whole(2) * c * &slope[0]) / &size,
            _ => -(whole(2) * c * &slope[k - 1] + &slope[k - 2]) / &size,
        });
    }
    slope.iter().enumerate().map(|(k, s)| s / whole(k + 1)).collect()
}

/// The square root: the binomial series.
fn root(value: BigRational, c: &BigRational, order: usize) -> Vec<BigRational> {
    let half = BigRational::from_parts_signed(1.into(), 2.into());
    let mut last = value;
    let coefficient = |k: usize| {
        last = &last * (&half - whole(k)) / (c * whole(k + 1));
        last.clone()
    };
    (0..order).map(coefficient).collect()
}
