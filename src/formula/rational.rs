//! Exact numbers: whole ones of any length and their ratios.

use num_traits::ToPrimitive;

/// A whole number of any length; one of up to two machine words takes no memory of its own.
pub type BigInt = dashu_int::IBig;

/// A ratio of whole numbers in lowest terms, its denominator positive.
///
/// ```
/// use creepage::formula::{BigInt, BigRational};
///
/// let half = BigRational::new(BigInt::from(3), BigInt::from(6));
/// assert_eq!(half.to_string(), "1/2");
/// ```
pub type BigRational = num_rational::Ratio<BigInt>;

/// The double nearest to a ratio: infinite beyond the largest.
///
/// ```
/// use creepage::formula::{BigRational, nearest_f64};
///
/// assert_eq!(nearest_f64(&BigRational::new(1.into(), 10.into())), 0.1);
/// ```
pub fn nearest_f64(v: &BigRational) -> f64 {
    const EXACT: i64 = 1 << f64::MANTISSA_DIGITS;
    let exact = |n: &BigInt| n.to_i64().filter(|n| (-EXACT..=EXACT).contains(n));
    if let (Some(p), Some(q)) = (exact(v.numer()), exact(v.denom())) {
        // Two doubles without an error: their quotient is rounded once.
        return p as f64 / q as f64;
    }
    let long = |n: &BigInt| num_bigint::BigInt::from_signed_bytes_le(&n.to_le_bytes());
    num_rational::BigRational::new_raw(long(v.numer()), long(v.denom())).to_f64().unwrap_or(f64::NAN)
}

/// The ratio that a double is; none for one that is not finite.
///
/// ```
/// use creepage::formula::exact_f64;
///
/// assert_eq!(exact_f64(-0.75).unwrap().to_string(), "-3/4");
/// assert!(exact_f64(f64::NAN).is_none());
/// ```
pub fn exact_f64(v: f64) -> Option<BigRational> {
    let long = num_rational::BigRational::from_float(v)?;
    let whole = |n: &num_bigint::BigInt| BigInt::from_le_bytes(&n.to_signed_bytes_le());
    Some(BigRational::new_raw(whole(long.numer()), whole(long.denom())))
}

/// How many bits a whole number has, its sign left out.
pub(crate) fn bits(n: &BigInt) -> u64 {
    dashu_base::BitTest::bit_len(n) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Doubles of every size come back to their last bit, by either way.
    #[test]
    fn doubles_are_ratios() {
        let wild = [
            0.0,
            0.1,
            -0.1,
            1.0 / 3.0,
            -7.5,
            2f64.powi(53) + 2.0,
            -1e300,
            1e-300,
            5e-324,
            f64::MAX,
            -f64::MIN_POSITIVE,
        ];
        for v in wild {
            let exact = exact_f64(v).unwrap();
            assert_eq!(nearest_f64(&exact).to_bits(), v.to_bits(), "{v}");
        }
        assert!([f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().all(|v| exact_f64(v).is_none()));
        assert!(exact_f64(-7.5).unwrap() == BigRational::new((-15).into(), 2.into()));
    }

    /// What is no double is rounded to the nearest one, as a decimal that is read is.
    #[test]
    fn ratios_are_rounded_once() {
        let ten = |n: usize| BigInt::from(10).pow(n);
        for (digits, places) in
            [("1", 1), ("-12345678901234567", 3), ("9007199254740993", 0), ("17976931348623157", 320)]
        {
            let exact = BigRational::new(digits.parse().unwrap(), ten(places));
            let read: f64 = format!("{digits}e-{places}").parse().unwrap();
            assert_eq!(nearest_f64(&exact).to_bits(), read.to_bits(), "{digits}e-{places}");
        }
        assert_eq!(nearest_f64(&BigRational::from_integer(ten(400))), f64::INFINITY);
    }

    #[test]
    fn bits_have_no_sign() {
        assert_eq!([0, 1, -1, 255, -256].map(|n| bits(&BigInt::from(n))), [0, 1, 1, 8, 9]);
    }
}
