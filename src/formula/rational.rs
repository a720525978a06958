//! Exact rational numbers: whole numbers of any length and their ratios (dashu), to and from the nearest double.

use num_traits::ToPrimitive;

/// A whole number of any length; one of up to two machine words takes no memory of its own.
pub type BigInt = dashu_int::IBig;

/// A ratio of whole numbers in lowest terms, its denominator positive.
///
/// ```
/// use creepage::formula::{BigInt, BigRational};
///
/// let half = BigRational::from_parts_signed(BigInt::from(3), BigInt::from(6));
/// assert_eq!(half.to_string(), "1/2");
/// ```
pub type BigRational = dashu_ratio::RBig;

/// The double nearest to a ratio: infinite beyond the largest.
///
/// ```
/// use creepage::formula::{BigRational, nearest_f64};
///
/// assert_eq!(nearest_f64(&BigRational::from_parts_signed(1.into(), 10.into())), 0.1);
/// ```
pub fn nearest_f64(v: &BigRational) -> f64 {
    const EXACT: i64 = 1 << f64::MANTISSA_DIGITS;
    let exact = |n: &BigInt| n.to_i64().filter(|n| (-EXACT..=EXACT).contains(n));
    if let (Some(p), Some(q)) = (exact(v.numerator()), exact(v.denominator().as_ibig())) {
        // Two doubles without an error: their quotient is rounded once.
        return p as f64 / q as f64;
    }
    v.to_f64().value()
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
    BigRational::try_from(v).ok()
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
        assert!(exact_f64(-7.5).unwrap() == BigRational::from_parts_signed((-15).into(), 2.into()));
    }

    /// What is no double is rounded to the nearest one, as a decimal that is read is.
    #[test]
    fn ratios_are_rounded_once() {
        let ten = |n: usize| BigInt::from(10).pow(n);
        for (digits, places) in
            [("1", 1), ("-12345678901234567", 3), ("9007199254740993", 0), ("17976931348623157", 320)]
        {
            let exact = BigRational::from_parts_signed(digits.parse().unwrap(), ten(places));
            let read: f64 = format!("{digits}e-{places}").parse().unwrap();
            assert_eq!(nearest_f64(&exact).to_bits(), read.to_bits(), "{digits}e-{places}");
        }
        assert_eq!(nearest_f64(&BigRational::from(ten(400))), f64::INFINITY);
    }

    /// Halfway between two doubles the even one is nearest, among subnormal ones and at both ends of the range too.
    #[test]
    fn ties_go_to_the_even_double() {
        let two = |n: usize| BigInt::from(1) << n;
        let nearest = |p: BigInt, q: BigInt| nearest_f64(&BigRational::from_parts_signed(p, q));
        let tiny = |thousandths: i64| nearest(thousandths.into(), two(1074) * BigInt::from(1000));
        assert_eq!([499, 500, 501, 1499, 1500, 2500, 2501].map(tiny), [0, 0, 1, 1, 2, 2, 3].map(f64::from_bits));
        assert_eq!([-501, -1500].map(tiny), [-f64::from_bits(1), -f64::from_bits(2)]);
        assert_eq!(nearest((two(53) + BigInt::from(1)) << 900, BigInt::from(3) << 900), 3_002_399_751_580_331.0);
        let half_beyond = two(1024) - two(970);
        assert_eq!(nearest(half_beyond.clone() - BigInt::from(1), 1.into()), f64::MAX);
        assert_eq!(nearest(half_beyond, 1.into()), f64::INFINITY);
    }

    #[test]
    fn bits_have_no_sign() {
        assert_eq!([0, 1, -1, 255, -256].map(|n| bits(&BigInt::from(n))), [0, 1, 1, 8, 9]);
    }
}
