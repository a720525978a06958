//! A cell of a number column.

/// What a cell of a number column holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Cell {
    /// A finite number.
    Number(f64),
    /// Nothing, or a word for nothing.
    Blank,
    /// An infinite or too large number.
    Infinite,
    /// Something else.
    Word,
}

/// How programs spell a value they do not have.
const NOTHING: [&str; 6] = ["", "nan", "-nan", "+nan", "na", "null"];

impl Cell {
    /// Reads a cell that has no blanks around it.
    pub fn read(bytes: &[u8]) -> Self {
        let Ok(text) = std::str::from_utf8(bytes) else { return Cell::Word };
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Cell::Number(number),
            Ok(number) if number.is_infinite() => Cell::Infinite,
            _ if NOTHING.iter().any(|word| word.eq_ignore_ascii_case(text)) => Cell::Blank,
            _ => Cell::Word,
        }
    }
}

/// What to do about a word in a number column.
pub(crate) fn advice(word: &str) -> &'static str {
    if word.replacen(',', ".", 1).parse::<f64>().is_ok() {
        return "write decimals with a point, not a comma";
    }
    let marks = word.chars().filter(|c| matches!(c, '-' | ':' | '/')).count();
    if marks >= 2 && word.starts_with(|c: char| c.is_ascii_digit()) {
        return "write time in seconds, as one number";
    }
    "correct it, or leave the cell blank and the row is dropped; a row of units or a second header must be removed"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_spelling_has_its_kind() {
        for text in ["", "nan", "NaN", "NA", "Null", "-nan", "NAN"] {
            assert_eq!(Cell::read(text.as_bytes()), Cell::Blank, "{text}");
        }
        for text in ["inf", "-Infinity", "1e999", "+INF"] {
            assert_eq!(Cell::read(text.as_bytes()), Cell::Infinite, "{text}");
        }
        for text in ["word", "1,5", "0x10", "1_000", "--1", "1 2", "none", "e5", "."] {
            assert_eq!(Cell::read(text.as_bytes()), Cell::Word, "{text}");
        }
        assert_eq!(Cell::read(b"\xff"), Cell::Word);
        for (text, value) in [("1", 1.0), ("-.5", -0.5), ("+1.e3", 1000.0), ("1E-400", 0.0)] {
            assert_eq!(Cell::read(text.as_bytes()), Cell::Number(value), "{text}");
        }
    }

    #[test]
    fn advice_fits_the_word() {
        assert!(advice("1,5").contains("comma"));
        assert!(advice("2026-01-31T10:00:00").contains("seconds"));
        assert!(advice("12:30:01.5").contains("seconds"));
        assert!(advice("fast").contains("correct it"));
    }

    #[test]
    fn the_usual_slips_are_named() {
        for (word, said) in [
            ("1,5", "write decimals with a point, not a comma"),
            ("1:23:45", "write time in seconds, as one number"),
            ("2024-05-01T10:00:00Z", "write time in seconds, as one number"),
            ("1/2/24", "write time in seconds, as one number"),
        ] {
            assert_eq!(advice(word), said, "{word}");
        }
        for word in ["m/s", "rad/s^2-ish", "--:--:--", "1-2", "t/T/s", "word"] {
            assert!(advice(word).starts_with("correct it"), "{word}");
        }
    }
}
