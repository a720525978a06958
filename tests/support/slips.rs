//! Slips of the fingers, done to the bytes of a good file.

use proptest::prelude::*;

/// What is done to the bytes of a good file.
#[derive(Clone, Debug)]
pub enum Slip {
    Insert(Vec<u8>),
    Remove(usize),
    Repeat(usize),
}

/// A slip and where it happens.
pub fn slip() -> impl Strategy<Value = (prop::sample::Index, Slip)> {
    let pieces = prop::sample::select(vec![
        "\"",
        "'",
        ",",
        "\n",
        "\r\n",
        "[",
        "]",
        "[[",
        "{",
        "}",
        "=",
        ".",
        "nan",
        "inf",
        "-",
        "1e999",
        "\0",
        "\u{feff}",
        "#",
        "\"\"\"",
        "é",
        "[[effects]]\n",
        "[[effect]]\n",
        "it",
        "^64",
        "*(",
        "phi'",
        "/0",
        "id = \"lever-arm\"\n",
        "\\u",
        "0x",
        ",,",
        "99999999999999999999",
        "x",
    ]);
    let slip = prop_oneof![
        pieces.prop_map(|piece| Slip::Insert(piece.as_bytes().to_vec())),
        prop::collection::vec(any::<u8>(), 1..4).prop_map(Slip::Insert),
        (1..12usize).prop_map(Slip::Remove),
        (1..40usize).prop_map(Slip::Repeat),
    ];
    (any::<prop::sample::Index>(), slip)
}

/// A text with slips in it.
pub fn damage(text: &[u8], slips: &[(prop::sample::Index, Slip)]) -> Vec<u8> {
    let mut bytes = text.to_vec();
    for (place, slip) in slips {
        let at = place.index(bytes.len() + 1);
        let to = |n: &usize| (at + n).min(bytes.len());
        match slip {
            Slip::Insert(piece) => drop(bytes.splice(at..at, piece.iter().copied())),
            Slip::Remove(n) => drop(bytes.drain(at..to(n))),
            Slip::Repeat(n) => {
                let piece = bytes[at..to(n)].to_vec();
                drop(bytes.splice(at..at, piece));
            }
        }
    }
    bytes
}
