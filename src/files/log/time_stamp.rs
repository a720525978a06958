//! Times as whole numbers of a fraction of a second, or as dates: read exactly, then counted from a whole second.
//!
//! A stamp of 19 digits does not fit a binary fraction of 53 bits: as one it is rounded to 256 ns.

/// Stamps that begin beyond this are counted from the second of the first one, s; 1973.
const EPOCH: i128 = 100_000_000;
/// Nanoseconds in a second.
const NANO: i128 = 1_000_000_000;

/// The whole second that times are counted from; the first stamp sets it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Origin(pub Option<i128>);

impl Origin {
    /// Seconds from the origin of a time in nanoseconds.
    pub fn seconds(&mut self, nanoseconds: i128) -> f64 {
        let second = nanoseconds.div_euclid(NANO);
        let from = *self.0.get_or_insert(if second >= EPOCH { second } else { 0 });
        (nanoseconds - from * NANO) as f64 / 1e9
    }
}

/// A decimal number of units of 10^-`digits` seconds, in nanoseconds; what is smaller is cut off.
pub(crate) fn nanoseconds(text: &str, digits: u32) -> Option<i128> {
    let (negative, rest) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    };
    let (whole, fraction) = rest.split_once('.').unwrap_or((rest, ""));
    let plain = !(whole.is_empty() && fraction.is_empty())
        && (whole.bytes().chain(fraction.bytes())).all(|b| b.is_ascii_digit());
    if !plain || whole.len() > 25 {
        return in_floating_point(text, digits);
    }
    let scale = 10i128.pow(9 - digits.min(9));
    let whole: i128 = if whole.is_empty() { 0 } else { whole.parse().ok()? };
    let places = fraction.len().min(9);
    let part: i128 = if places == 0 { 0 } else { fraction[..places].parse().ok()? };
    let found = whole * scale + part * scale / 10i128.pow(places as u32);
    Some(if negative { -found } else { found })
}

/// A number with an exponent.
fn in_floating_point(text: &str, digits: u32) -> Option<i128> {
    let number: f64 = text.parse().ok()?;
    of_number(number, digits)
}

/// A number of units of 10^-`digits` seconds, in nanoseconds.
pub(crate) fn of_number(number: f64, digits: u32) -> Option<i128> {
    let found = number * 10f64.powi(9 - digits as i32);
    (found.is_finite() && found.abs() < 1e30).then(|| found.round() as i128)
}

/// A date and a time of day of ISO 8601, in nanoseconds since 1970; without a zone it is taken as UTC.
pub(crate) fn iso_8601(text: &str) -> Option<i128> {
    let (date, rest) = text.split_at_checked(10)?;
    let rest = rest.strip_prefix(['T', 't', ' ', '_'])?;
    let number = |s: &str| s.bytes().all(|b| b.is_ascii_digit()).then(|| s.parse::<i128>().ok()).flatten();
    let mut parts = date.splitn(3, ['-', '/']);
    let (year, month, day) = (parts.next()?, parts.next()?, parts.next()?);
    if [year.len(), month.len(), day.len()] != [4, 2, 2] {
        return None;
    }
    let (year, month, day) = (number(year)?, number(month)?, number(day)?);
    let (clock, zone) = zone(rest)?;
    let mut parts = clock.splitn(3, ':');
    let (hour, minute) = (number(parts.next()?)?, number(parts.next()?)?);
    let second =
        nanoseconds(&parts.next().unwrap_or("0").replace(',', "."), 0).filter(|s| (0..61 * NANO).contains(s))?;
    if !(1..=12).contains(&month) || !(1..=31).contains(&day) || hour > 24 || minute > 59 {
        return None;
    }
    Some(((days(year, month, day) * 24 + hour) * 60 + minute - zone) * 60 * NANO + second)
}

/// Whether a text is a date with a time of day of ISO 8601.
pub(crate) fn is_iso_8601(text: &str) -> bool {
    iso_8601(text).is_some()
}

/// A time of day without its zone, and the zone's lead in minutes.
fn zone(text: &str) -> Option<(&str, i128)> {
    if let Some(clock) = text.strip_suffix(['Z', 'z']) {
        return Some((clock, 0));
    }
    let Some(at) = text.rfind(['+', '-']) else { return Some((text, 0)) };
    let (clock, lead) = text.split_at(at);
    let digits: String = lead[1..].chars().filter(|c| *c != ':').collect();
    if !matches!(digits.len(), 2 | 4) || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    let hours: i128 = digits[..2].parse().ok()?;
    let minutes: i128 = digits.get(2..4).map_or(Ok(0), str::parse).ok()?;
    let sign = if lead.starts_with('-') { -1 } else { 1 };
    Some((clock, sign * (hours * 60 + minutes)))
}

/// Days from 1970 to a date of the Gregorian calendar.
fn days(year: i128, month: i128, day: i128) -> i128 {
    // A year that begins with March ends with the leap day.
    let year = if month <= 2 { year - 1 } else { year };
    let era = year.div_euclid(400);
    let of_era = year - era * 400;
    let of_year = (153 * ((month + 9) % 12) + 2) / 5 + day - 1;
    era * 146_097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719_468
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stamps_are_read_to_the_nanosecond() {
        for (text, digits, expect) in [
            ("1700000000123456789", 9, 1_700_000_000_123_456_789),
            ("1700000000.123456789", 0, 1_700_000_000_123_456_789),
            ("1700000000123.456", 3, 1_700_000_000_123_456_000),
            ("-1.5", 0, -1_500_000_000),
            (".25", 6, 250),
            ("1.7e18", 9, 1_700_000_000_000_000_000),
            ("12", 9, 12),
        ] {
            assert_eq!(nanoseconds(text, digits), Some(expect), "{text}");
        }
        for text in ["", ".", "1-2", "1e99", "nan", "0x1"] {
            assert_eq!(nanoseconds(text, 9), None, "{text}");
        }
    }

    #[test]
    fn late_stamps_are_counted_from_the_first_second() {
        let mut origin = Origin::default();
        assert_eq!(origin.seconds(1_700_000_000_123_456_789), 0.123_456_789);
        assert_eq!(origin.seconds(1_700_000_001_123_456_789), 1.123_456_789);
        let mut early = Origin::default();
        assert_eq!([early.seconds(5_250_000_000), early.seconds(6_000_000_000)], [5.25, 6.0]);
    }

    #[test]
    fn dates_are_nanoseconds_since_1970() {
        for (text, expect) in [
            ("1970-01-01T00:00:00Z", 0),
            ("2023-11-14T22:13:20.5Z", 1_700_000_000_500_000_000),
            ("2023-11-14 23:13:20.5+01:00", 1_700_000_000_500_000_000),
            ("2023/11/14T17:43:20,5-0430", 1_700_000_000_500_000_000),
            ("2024-02-29T00:00", 1_709_164_800_000_000_000),
            ("1969-12-31T23:59:59", -1_000_000_000),
        ] {
            assert_eq!(iso_8601(text), Some(expect), "{text}");
        }
        for text in [
            "2023-11-14",
            "12:30:01.5",
            "2023-13-14T00:00:00",
            "2023-1-14T00:00:00",
            "2023-11-14T25:00:00",
            "2023-11-14Tab:00",
        ] {
            assert_eq!(iso_8601(text), None, "{text}");
        }
    }
}
