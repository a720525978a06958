//! The script of the page: it adds to what is drawn, asks for nothing, and is allowed by its hash alone.

use crate::picture::svg::Element;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

/// The script, as it stands on the page.
const EXPLORE: &str = include_str!("explore.js");

/// What a page may load and run: its own style, and the script of this hash.
pub(super) fn policy(with_script: bool) -> String {
    let own = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'";
    match with_script {
        true => format!("{own}; script-src 'sha256-{}'", STANDARD.encode(Sha256::digest(EXPLORE))),
        false => own.into(),
    }
}

/// The script as an element.
pub(super) fn element() -> Element {
    Element::new("script").verbatim(EXPLORE)
}

/// Values between their least and their largest in steps of a 65535th: that range, and two bytes a value in base 64.
pub(super) fn packed(values: impl IntoIterator<Item = f64>) -> (f64, f64, String) {
    let values: Vec<f64> = values.into_iter().collect();
    let finite = || values.iter().copied().filter(|v| v.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    let (low, high) = if low <= high { (low, high) } else { (0.0, 0.0) };
    let step = if high > low { 65535.0 / (high - low) } else { 0.0 };
    let bytes = values.iter().flat_map(|v| (((v - low) * step).round() as u16).to_le_bytes());
    (low, high, STANDARD.encode(bytes.collect::<Vec<u8>>()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_packed_to_a_sixty_thousandth_of_their_range() {
        let values = [-3.0, 0.25, 17.0, 9.9999];
        let (low, high, text) = packed(values);
        let bytes = STANDARD.decode(text).unwrap();
        for (pair, value) in bytes.chunks(2).zip(values) {
            let read = low + f64::from(u16::from_le_bytes([pair[0], pair[1]])) / 65535.0 * (high - low);
            assert!((read - value).abs() <= 0.51 * (high - low) / 65535.0, "{read} {value}");
        }
        assert_eq!(packed([2.0, 2.0]), (2.0, 2.0, "AAAAAA==".into()));
        assert_eq!(packed([f64::NAN]), (0.0, 0.0, "AAA=".into()));
    }

    /// What ends a script, or would be markup where one is read, does not stand in it.
    #[test]
    fn the_script_is_plain() {
        for word in ["</", "<!--", "fetch", "import", "eval", "innerHTML", "XMLHttpRequest", "localStorage"] {
            assert!(!EXPLORE.contains(word), "{word}");
        }
        assert!(EXPLORE.len() < 16_000 && EXPLORE.is_ascii());
        assert!(policy(true).contains("script-src 'sha256-") && !policy(false).contains("script-src"));
    }
}
