//! Text that is no formula is an error that points at the place.

use crate::support::tree::{NAMES, trees};
use crate::support::{Outcome, check};
use creepage::Error;
use creepage::formula::Expr;
use proptest::prelude::*;

/// Line and column of the error, and the character its caret stands under.
fn pointed_at(error: &Error) -> ((usize, usize), Option<char>) {
    let shown = error.to_string();
    let lines: Vec<&str> = shown.lines().collect();
    let [.., excerpt, caret] = lines.as_slice() else { panic!("no excerpt: {shown}") };
    let under = caret.chars().position(|c| c == '^').unwrap();
    assert_eq!(caret.trim(), "^", "{shown}");
    (error.place().unwrap(), excerpt.chars().nth(under))
}

/// A result is a formula, or an error whose place lies in the text and whose caret stands there.
fn formula_or_pointing_error(text: &str) -> Outcome {
    let Err(error) = Expr::parse(text) else { return Ok(()) };
    let ((line, column), under) = pointed_at(&error);
    let written: Vec<&str> = text.split('\n').collect();
    prop_assert!((1..=written.len()).contains(&line), "{}", error);
    let length = written[line - 1].chars().count();
    prop_assert!((1..=length + 1).contains(&column), "{}", error);
    let expected = written[line - 1].chars().nth(column - 1).map(|c| if c.is_control() { ' ' } else { c });
    prop_assert_eq!(under, expected, "{}", error);
    prop_assert_eq!(error.exit_code(), 2);
    Ok(())
}

#[test]
fn malformed_formulas_are_errors_at_their_columns() {
    // Text, column from one, character under the caret (none at the end).
    let table = [
        ("", 1, None),
        ("   ", 4, None),
        ("sin(phi + ) * x", 11, Some(')')),
        ("a + * b", 5, Some('*')),
        ("a b", 3, Some('b')),
        ("2x", 2, Some('x')),
        ("(a + b", 7, None),
        ("a + b)", 6, Some(')')),
        ("a +", 4, None),
        ("x^y", 3, Some('y')),
        ("x^2.5", 3, Some('2')),
        ("x^65", 3, Some('6')),
        ("x^2^3", 4, Some('^')),
        ("x^(2", 5, None),
        ("x^--2", 4, Some('-')),
        ("x ** 2", 4, Some('*')),
        ("foo(x)", 1, Some('f')),
        ("2 + foo (x)", 5, Some('f')),
        ("sin x", 5, Some('x')),
        ("cos", 4, None),
        ("sin()", 5, Some(')')),
        ("1.2.3", 4, Some('.')),
        ("x + .", 5, Some('.')),
        ("1e999999999", 2, Some('e')),
        ("3*1e-99999999999999999999", 4, Some('e')),
        ("a = b", 3, Some('=')),
        ("φ² + ψ @", 8, Some('@')),
        ("+x", 1, Some('+')),
        ("x\t%", 3, Some('%')),
        ("x'y", 3, Some('y')),
        ("'x", 1, Some('\'')),
        ("()", 2, Some(')')),
        ("a\u{0}b", 2, Some(' ')),
        ("x, y", 2, Some(',')),
        ("1/0x", 4, Some('x')),
    ];
    for (text, column, under) in table {
        let error = Expr::parse(text).expect_err(text);
        assert_eq!(pointed_at(&error), ((1, column), under), "{error}");
        formula_or_pointing_error(text).unwrap();
    }
}

#[test]
fn an_error_in_a_formula_of_many_lines_names_the_line_and_shows_it() {
    let table =
        [("a +\n* b", (2, 1), Some('*')), ("a\n\n  + b @ c\nd", (3, 7), Some('@')), ("(a\n+ b\n", (3, 1), None)];
    for (text, place, under) in table {
        let error = Expr::parse(text).unwrap_err();
        assert_eq!(pointed_at(&error), (place, under), "{error}");
        formula_or_pointing_error(text).unwrap();
    }
}

#[test]
fn random_text_never_panics_and_every_error_points_into_it() {
    check(3000, prop_oneof!["\\PC{0,40}", any::<String>()], |text| formula_or_pointing_error(&text));
}

#[test]
fn random_pieces_of_formulas_never_panic_and_every_error_points_into_them() {
    let marks =
        ["+", "-", "*", "/", "^", "(", ")", " ", "1", "2.5", "1e", ".", "sin", "sin(", "'", "\n", "\r\n", "\u{202e}"];
    let piece = prop::sample::select(marks.iter().chain(&NAMES).copied().collect::<Vec<_>>());
    check(6000, prop::collection::vec(piece, 0..25), |pieces| formula_or_pointing_error(&pieces.concat()));
}

#[test]
fn a_formula_cut_off_inside_parentheses_is_an_error_at_its_end() {
    check(1000, (trees(), any::<prop::sample::Index>()), |(tree, cut)| {
        let text = tree.text();
        let cut = cut.index(text.chars().count());
        let kept: String = text.chars().take(cut).collect();
        let open = kept.matches('(').count() > kept.matches(')').count();
        prop_assert!(!open || Expr::parse(&kept).is_err());
        formula_or_pointing_error(&kept)
    });
}

#[test]
fn depth_and_length_are_bounded_with_an_error() {
    let n = 100_000;
    let texts = [
        "(".repeat(n),
        format!("{}x{}", "(".repeat(n), ")".repeat(n)),
        format!("{}x{}", "sin(".repeat(n), ")".repeat(n)),
        format!("{}x", "-".repeat(n)),
        format!("x{}", " + x".repeat(n)),
        format!("x{}", "/x".repeat(n)),
        format!("x{}", "^2".repeat(n)),
        format!("x^{}2", "-".repeat(n)),
        "7".repeat(n),
        format!("0.{}", "7".repeat(n)),
        format!("1e{}", "7".repeat(n)),
    ];
    for text in texts {
        let start: String = text.chars().take(20).collect();
        assert!(Expr::parse(&text).is_err(), "{start}…");
        formula_or_pointing_error(&text).unwrap();
    }
}

#[test]
fn the_deepest_formula_allowed_can_be_read_printed_and_evaluated() {
    let table = [
        ("(", ")", 399),
        ("sin(", ")", 399),
        ("-(", ")", 399),
        ("(1 + ", ")", 399),
        ("2*(", ")", 399),
        // Printed with a bracket at every sign but the outer one.
        ("-", "", 399),
        ("2*-(", ")", 199),
        ("2 - -(", ")", 199),
        ("2*-(1 + ", ")", 133),
    ];
    for (open, close, depth) in table {
        let nested = |depth| Expr::parse(&format!("{}x{}", open.repeat(depth), close.repeat(depth)));
        let e = nested(depth).unwrap();
        assert!(e.eval(&|_| 0.5).is_some());
        assert_eq!(Expr::parse(&e.to_string()).unwrap(), e);
        assert!(!e.derivative(&"x".into()).latex().is_empty());
        assert!(nested(depth + 1).is_err_and(|e| e.message().contains("400 deep")), "{open}");
    }
}

#[test]
fn a_long_name_is_a_name() {
    let name = "x".repeat(100_000);
    assert_eq!(Expr::parse(&name).unwrap(), Expr::sym(name.as_str()));
}
