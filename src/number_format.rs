//! Numbers for people: few digits, a true minus sign, powers of ten as superscripts.

/// A number with so many significant digits, in powers of ten where it is very large or very small.
///
/// ```
/// use creepage::number_format::significant;
/// assert_eq!(significant(0.20149, 3), "0.201");
/// assert_eq!(significant(-12345.6, 2), "−12000");
/// assert_eq!(significant(3.21e-7, 2), "3.2·10⁻⁷");
/// assert_eq!(significant(f64::NAN, 2), "–");
/// ```
pub fn significant(x: f64, digits: usize) -> String {
    if !x.is_finite() {
        return "–".into();
    }
    if x == 0.0 {
        return "0".into();
    }
    let written = format!("{:.*e}", digits.max(1) - 1, x);
    let (mantissa, exponent) = written.split_once('e').unwrap_or((&written, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..6).contains(&exponent) {
        let places = (digits as i32 - 1 - exponent).max(0) as usize;
        let rounded: f64 = written.parse().unwrap_or(x);
        return minus(&format!("{rounded:.places$}"));
    }
    format!("{}·{}", minus(mantissa), power_of_ten(exponent))
}

/// A number a person chose, such as a horizon: three significant digits at most, no zeros at the end.
///
/// ```
/// use creepage::number_format::plain;
/// assert_eq!([plain(30.0), plain(0.25)], ["30", "0.25"]);
/// ```
pub fn plain(x: f64) -> String {
    let text = significant(x, 3);
    if text.contains('.') && !text.contains('·') {
        return text.trim_end_matches('0').trim_end_matches('.').into();
    }
    text
}

/// A value and its standard deviation, both rounded to the deviation's second digit.
///
/// ```
/// use creepage::number_format::with_error;
/// assert_eq!(with_error(0.10987, Some(0.00213)), "0.1099 ± 0.0021");
/// assert_eq!(with_error(3.0e-6, Some(1.2e-7)), "(3.00 ± 0.12)·10⁻⁶");
/// assert_eq!(with_error(0.11, None), "0.110");
/// ```
pub fn with_error(value: f64, std: Option<f64>) -> String {
    let Some(std) = std.filter(|s| s.is_finite() && *s > 0.0 && value.is_finite()) else {
        return significant(value, 3);
    };
    let exponent = decade(value.abs().max(std));
    if (-4..6).contains(&exponent) {
        let places = places_for(std);
        return format!("{} ± {std:.places$}", minus(&format!("{value:.places$}")));
    }
    let scale = ten_to(exponent);
    let (value, std) = (value / scale, std / scale);
    let places = places_for(std);
    format!("({} ± {std:.places$})·{}", minus(&format!("{value:.places$}")), power_of_ten(exponent))
}

/// Decimal places that show the second significant digit.
fn places_for(std: f64) -> usize {
    (1 - decade(std)).clamp(0, 12) as usize
}

/// A number with a fixed count of decimals and a true minus sign.
///
/// ```
/// use creepage::number_format::decimals;
/// assert_eq!([decimals(-0.126, 2), decimals(-0.001, 2), decimals(f64::NAN, 2)], ["−0.13", "0.00", "–"]);
/// ```
pub fn decimals(x: f64, places: usize) -> String {
    if !x.is_finite() {
        return "–".into();
    }
    minus(&format!("{x:.places$}"))
}

fn minus(text: &str) -> String {
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| c == '0' || c == '.') => rest.into(),
        Some(rest) => format!("−{rest}"),
        None => text.into(),
    }
}

/// The exponent of the decade a positive number lies in, after rounding to two digits.
pub fn decade(x: f64) -> i32 {
    let written = format!("{x:.1e}");
    written.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0)
}

/// Ten to a whole power, the nearest floating-point number on every machine.
pub fn ten_to(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

/// A power of ten in superscripts, such as 10⁻³.
pub fn power_of_ten(exponent: i32) -> String {
    let digit = |c| match c {
        '-' => '⁻',
        c => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c.to_digit(10).unwrap_or(0) as usize).unwrap_or('⁰'),
    };
    format!("10{}", exponent.to_string().chars().map(digit).collect::<String>())
}

/// A probability, with a bound where it is too small to tell from zero.
pub fn probability(p: f64) -> String {
    if (0.0..1e-300).contains(&p) { "< 10⁻³⁰⁰".into() } else { significant(p, 2) }
}

/// A unit with a prefix that keeps the values readable: the factor from the base unit and the name.
///
/// ```
/// use creepage::number_format::prefixed;
/// assert_eq!(prefixed(0.2, "m"), (1000.0, "mm".to_string()));
/// assert_eq!(prefixed(20.0, "m"), (1.0, "m".to_string()));
/// ```
pub fn prefixed(largest: f64, unit: &str) -> (f64, String) {
    if largest >= 10.0 || !largest.is_finite() { (1.0, unit.into()) } else { (1000.0, format!("m{unit}")) }
}

/// A value to two digits in the unit in which people say such a value.
///
/// ```
/// use creepage::number_format::in_everyday_unit;
/// assert_eq!([in_everyday_unit(0.066, "m/s"), in_everyday_unit(0.03, "%")], ["6.6 cm/s", "3.0 %"]);
/// assert_eq!([in_everyday_unit(0.2, "rad/s"), in_everyday_unit(0.3, "deg")], ["0.20 rad/s", "17°"]);
/// ```
pub fn in_everyday_unit(value: f64, unit: &str) -> String {
    let size = value.abs();
    let metric = |per: &str| match size {
        s if s >= 1.0 => (1.0, format!(" m{per}")),
        s if s >= 0.01 => (100.0, format!(" cm{per}")),
        _ => (1000.0, format!(" mm{per}")),
    };
    let (factor, unit) = match unit {
        "%" => (100.0, " %".into()),
        "m" => metric(""),
        "m/s" if size >= 0.1 => (1.0, " m/s".into()),
        "m/s" => metric("/s"),
        "s" if size < 1.0 => (1000.0, " ms".into()),
        "deg" => (1f64.to_degrees(), "°".into()),
        "deg/s" => (1f64.to_degrees(), "°/s".into()),
        "1" => (1.0, String::new()),
        unit => (1.0, format!(" {unit}")),
    };
    format!("{}{unit}", significant(value * factor, 2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_up_into_the_next_decade_keeps_the_digits() {
        assert_eq!(significant(0.09996, 3), "0.100");
        assert_eq!(significant(999_999.0, 2), "1.0·10⁶");
        assert_eq!(with_error(1.0, Some(0.0996)), "1.00 ± 0.10");
    }

    #[test]
    fn a_rounded_zero_has_no_sign() {
        assert_eq!(decimals(-0.001, 1), "0.0");
        assert_eq!(with_error(-0.0001, Some(0.2)), "0.00 ± 0.20");
    }

    #[test]
    fn a_deviation_that_is_none_is_not_written() {
        for std in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(with_error(0.5, Some(std)), "0.500");
        }
        assert_eq!(with_error(f64::NAN, Some(1.0)), "–");
    }

    #[test]
    fn powers_of_ten_begin_where_digits_are_many() {
        assert_eq!(with_error(123_456.0, Some(1000.0)), "123456 ± 1000");
        assert_eq!(with_error(1_234_567.0, Some(10_000.0)), "(1.235 ± 0.010)·10⁶");
        assert_eq!(with_error(0.00012, Some(0.00001)), "0.000120 ± 0.000010");
        assert_eq!(with_error(0.00002, Some(0.000_001)), "(2.00 ± 0.10)·10⁻⁵");
        assert_eq!([plain(300.0), plain(1.5e7), plain(2.5e-4)], ["300", "1.50·10⁷", "0.00025"]);
        assert_eq!([significant(1e-4, 1), significant(1e-5, 1)], ["0.0001", "1·10⁻⁵"]);
    }

    #[test]
    fn bounds_are_told_from_numbers() {
        assert_eq!([0.0, 9e-301, 1e-300, 0.05].map(probability), ["< 10⁻³⁰⁰", "< 10⁻³⁰⁰", "1.0·10⁻³⁰⁰", "0.050"]);
        assert_eq!([10.0, f64::INFINITY, 9.9].map(|x| prefixed(x, "m").1), ["m", "m", "mm"]);
    }
}
