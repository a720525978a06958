//! The lexer: text to tokens.

use super::symbol::{is_inner, is_start};
use super::{BigInt, BigRational, Symbol};
use crate::error::{Error, Result};
use num_traits::Zero;

/// A piece of a formula and the column (from zero, in characters of the whole text) where it begins.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Token {
    pub kind: TokenKind,
    pub column: usize,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum TokenKind {
    Number(BigRational),
    Name(String),
    Mark(char),
    End,
}

/// Largest power of ten a number may be written with; floating point ends near 308.
const MAX_EXPONENT: i32 = 400;
/// Most digits a number may have, written out without a power of ten, as it is printed.
const MAX_DIGITS: usize = 400;

/// The error of a formula: message, and the line of the text with a caret under the column.
pub(crate) fn caret(text: &str, at: usize, message: impl Into<String>) -> Error {
    let (mut before, mut column) = (0, at);
    for line in text.split('\n') {
        let length = line.chars().count();
        if column <= length {
            let line: String = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
            let excerpt = format!("  {line}\n  {}^", " ".repeat(column));
            return Error::input(message).at(before + 1, column + 1).excerpt(excerpt);
        }
        (before, column) = (before + 1, column - length - 1);
    }
    Error::input(message)
}

/// The column, from zero, at which a formula first speaks of a name.
pub(crate) fn column_of(text: &str, name: &Symbol) -> Option<usize> {
    let is = |t: &Token| matches!(&t.kind, TokenKind::Name(n) if n.replace('′', "'") == name.as_str());
    tokens(text).ok()?.iter().find(|t| is(t)).map(|t| t.column)
}

/// Splits a formula into tokens; the last one is [`TokenKind::End`].
pub(super) fn tokens(text: &str) -> Result<Vec<Token>> {
    let chars: Vec<char> = text.chars().collect();
    let mut found = Vec::new();
    let mut at = 0;
    while at < chars.len() {
        let (c, column) = (chars[at], at);
        let kind = if c.is_whitespace() {
            at += 1;
            continue;
        } else if c.is_ascii_digit() || c == '.' {
            let (value, end) = number(text, &chars, at)?;
            at = end;
            TokenKind::Number(value)
        } else if is_start(c) {
            at = name_end(&chars, at);
            TokenKind::Name(chars[column..at].iter().collect())
        } else if let Some(mark) = mark(c) {
            at += 1;
            TokenKind::Mark(mark)
        } else {
            return Err(caret(text, at, format!("unexpected character {c:?}"))
                .help("a formula holds numbers, names, + - * / ^ and parentheses"));
        };
        found.push(Token { kind, column });
    }
    found.push(Token { kind: TokenKind::End, column: chars.len() });
    Ok(found)
}

/// Operators, with the typographic ones read as their plain twins.
fn mark(c: char) -> Option<char> {
    match c {
        '+' | '-' | '*' | '/' | '^' | '(' | ')' => Some(c),
        '−' => Some('-'),
        '·' | '×' => Some('*'),
        _ => None,
    }
}

fn name_end(chars: &[char], start: usize) -> usize {
    let mut at = start;
    while at < chars.len() && is_inner(chars[at]) {
        at += 1;
    }
    while at < chars.len() && matches!(chars[at], '\'' | '′') {
        at += 1;
    }
    at
}

/// Reads `12`, `0.5`, `.5`, `1e-3` exactly.
fn number(text: &str, chars: &[char], start: usize) -> Result<(BigRational, usize)> {
    let mut at = start;
    let (mut digits, mut scale) = (String::new(), 0i32);
    let mut after_point = false;
    while at < chars.len() && (chars[at].is_ascii_digit() || (chars[at] == '.' && !after_point)) {
        if chars[at] == '.' {
            after_point = true;
        } else {
            digits.push(chars[at]);
            scale -= i32::from(after_point);
        }
        at += 1;
    }
    if digits.is_empty() {
        return Err(caret(text, start, "a number needs digits"));
    }
    if digits.len() > MAX_DIGITS {
        return Err(caret(text, start, format!("a number of more than {MAX_DIGITS} digits")));
    }
    if let Some((power, end)) = exponent(chars, at) {
        let power = power.filter(|p| p.abs() <= MAX_EXPONENT);
        scale += power.ok_or_else(|| caret(text, at, format!("a power of ten beyond ±{MAX_EXPONENT}")))?;
        at = end;
    }
    let written_out = if scale > 0 { digits.len() + scale as usize } else { (1 - scale) as usize };
    if written_out.max(digits.len()) > MAX_DIGITS {
        return Err(caret(text, start, format!("a number of more than {MAX_DIGITS} digits")));
    }
    let mantissa: BigInt = digits.parse().unwrap_or_else(|_| BigInt::zero());
    let ten = BigRational::from(10);
    Ok((BigRational::from(mantissa) * ten.pow(scale as isize), at))
}

/// The exponent after a mantissa: its value (`None` when it does not fit) and where it ends.
fn exponent(chars: &[char], at: usize) -> Option<(Option<i32>, usize)> {
    if !matches!(chars.get(at), Some('e' | 'E')) {
        return None;
    }
    let signed = matches!(chars.get(at + 1), Some('+' | '-' | '−'));
    let first = at + 1 + usize::from(signed);
    let mut end = first;
    while end < chars.len() && chars[end].is_ascii_digit() {
        end += 1;
    }
    if end == first {
        return None;
    }
    let digits: String = chars[first..end].iter().collect();
    let negative = signed && chars[at + 1] != '+';
    Some((digits.parse::<i32>().ok().map(|p| if negative { -p } else { p }), end))
}
