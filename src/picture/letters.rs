//! Widths of letters of the usual sans-serif faces, for text that is laid out before any font is known.
//!
//! The advances are those of Helvetica, which Arial and Liberation Sans share; Greek letters are as wide as Arial's.

/// Advances in thousandths of the font's size, and the letters that have them.
const ADVANCES: [(u16, &str); 23] = [
    (0, "\u{307}"),
    (191, "'"),
    (222, "ijlι"),
    (278, " !,./:;I[\\]ft·"),
    (333, "()-`r⁰¹²³⁴⁵⁶⁷⁸⁹⁻"),
    (395, "τ"),
    (400, "*°{}|\""),
    (446, "εζξ"),
    (500, "Jcksvxyzγκλνς^"),
    (530, "χυΓ√≤≥"),
    (556, "#$0123456789?L_abdeghnopquηθο–"),
    (566, "αβδμρ"),
    (584, "+<=>~−×±"),
    (614, "FTZσΣ"),
    (648, "φΞ"),
    (667, "&ABEKPSVXYΔΛ"),
    (713, "πψ"),
    (722, "CDHNRUwΠ"),
    (778, "GOQΘωΩ"),
    (833, "MmΦΨ"),
    (889, "%"),
    (944, "W"),
    (1000, "—…@"),
];

/// The advance of a letter that the table does not have.
const OTHERS: u16 = 600;

/// Size of the letters of a figure, and of the labels of an axis, in pixels.
pub const SIZE: f64 = 12.0;

/// How much wider the letters of the widest usual face, DejaVu Sans, are than these.
pub const WIDEST: f64 = 1.14;

/// The width of a text in pixels: Σ advance·size/1000.
///
/// ```
/// use creepage::picture::letters::width;
/// assert!((width("lim", 10.0) - 12.77).abs() < 1e-9);
/// ```
pub fn width(text: &str, font_size: f64) -> f64 {
    text.chars().map(|c| f64::from(advance(c))).sum::<f64>() * font_size / 1000.0
}

fn advance(letter: char) -> u16 {
    ADVANCES.iter().find(|(_, letters)| letters.contains(letter)).map_or(OTHERS, |(advance, _)| *advance)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_letter_stands_twice() {
        let all: Vec<char> = ADVANCES.iter().flat_map(|(_, letters)| letters.chars()).collect();
        let distinct: std::collections::BTreeSet<char> = all.iter().copied().collect();
        assert_eq!(distinct.len(), all.len());
        assert_eq!(advance('ж'), OTHERS);
    }
}
