//! Text with a little mathematics: letters in italics, subscripts and superscripts.

use super::letters::{self, WIDEST};
use super::svg::{Element, label};

/// How much larger and wider the letters of a heading are.
const HEADING: f64 = 1.1;

/// Size of raised and lowered text, relative to the text around it.
const SMALL: f64 = 0.76;
/// How far text is lowered or raised, in pixels.
const LOWERED: f64 = 3.4;
const RAISED: f64 = -4.6;
/// Room after a lowered letter, which the halo of the next one would cover.
const ROOM: f64 = 1.6;

/// A stretch of text in one style.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Run {
    text: String,
    italic: bool,
    level: Level,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Level {
    Line,
    Sub,
    Super,
}

impl Level {
    fn shift(self) -> f64 {
        match self {
            Level::Line => 0.0,
            Level::Sub => LOWERED,
            Level::Super => RAISED,
        }
    }
}

/// Text at a point in pixels; what stands between two dollar signs is mathematics.
///
/// | markup | meaning |
/// |---|---|
/// | `$v$` | letters in italics, everything else upright |
/// | `$e_{rc}$` | a subscript, upright |
/// | `$T^{N}$` | a superscript, upright |
///
/// Text that is centred or ends at the point is laid out from its left end, by the widths of the usual letters: there
/// are programs that anchor each stretch of a text by itself, and stretches would lie over one another.
///
/// ```
/// use creepage::picture::maths::maths;
/// let e = maths("", [0.0, 0.0], "start", "creep $e_{rc}$ = 0.2").to_string();
/// assert!(e.contains("<tspan font-style=\"italic\">e</tspan><tspan dy=\"3.4\" class=\"small\">rc</tspan>"), "{e}");
/// assert!(e.contains("<tspan dy=\"-3.4\"> = 0.2</tspan>"), "{e}");
/// ```
pub fn maths(class: &str, at: [f64; 2], anchor: &str, text: &str) -> Element {
    let runs = runs(text);
    let (left, anchor) = match (runs.len(), anchor) {
        // Centred between the widths of both faces; what ends at the point does not pass it in either.
        (2.., "middle") => (at[0] - (1.0 + WIDEST) / 2.0 * laid_out(&runs, class) / 2.0, "start"),
        (2.., "end") => (at[0] - WIDEST * laid_out(&runs, class), "start"),
        _ => (at[0], anchor),
    };
    // Some programs drop the spaces at the ends of a span, unless they are told not to.
    let mut out = label(class, [left, at[1]], anchor, "").with("xml:space", "preserve");
    let mut level = Level::Line;
    for run in runs {
        out = out.child(span(&run, level));
        level = run.level;
    }
    out
}

fn span(run: &Run, before: Level) -> Element {
    let shift = run.level.shift() - before.shift();
    let mut span = Element::new("tspan");
    if run.italic {
        span = span.with("font-style", "italic");
    }
    if shift != 0.0 {
        span = span.number("dy", shift);
    }
    if has_room(run, before) {
        span = span.number("dx", ROOM);
    }
    if run.level != Level::Line {
        span = span.with("class", "small");
    }
    span.text(run.text.clone())
}

/// Whether there is room between a lowered letter and this stretch.
fn has_room(run: &Run, before: Level) -> bool {
    before == Level::Sub && run.level == Level::Line && !run.text.starts_with(' ')
}

/// The width of the stretches in a figure.
fn laid_out(runs: &[Run], class: &str) -> f64 {
    let size = if class == "heading" { HEADING * letters::SIZE } else { letters::SIZE };
    let before = std::iter::once(Level::Line).chain(runs.iter().map(|r| r.level));
    let width = |(run, before): (&Run, Level)| {
        let size = if run.level == Level::Line { size } else { SMALL * size };
        letters::width(&run.text, size) + if has_room(run, before) { ROOM } else { 0.0 }
    };
    runs.iter().zip(before).map(width).sum()
}

/// A guess at the width of such a text in pixels, wide enough for any usual sans-serif font.
pub fn width_of(text: &str, font_size: f64) -> f64 {
    let width = |run: &Run| {
        let size = if run.level == Level::Line { font_size } else { SMALL * font_size };
        super::svg::width_of(&run.text, size)
    };
    runs(text).iter().map(width).sum()
}

/// The stretches of a text.
fn runs(text: &str) -> Vec<Run> {
    let mut found: Vec<Run> = Vec::new();
    let (mut maths, mut level) = (false, Level::Line);
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        match (c, characters.peek()) {
            ('$', _) => maths = !maths,
            ('_', Some('{')) if maths => level = opened(&mut characters, Level::Sub),
            ('^', Some('{')) if maths => level = opened(&mut characters, Level::Super),
            ('}', _) if level != Level::Line => level = Level::Line,
            _ => put(&mut found, c, maths && level == Level::Line && (c.is_alphabetic() || c == '\u{307}'), level),
        }
    }
    found
}

/// Steps over the bracket.
fn opened(characters: &mut std::iter::Peekable<std::str::Chars>, level: Level) -> Level {
    characters.next();
    level
}

fn put(runs: &mut Vec<Run>, c: char, italic: bool, level: Level) {
    match runs.last_mut().filter(|r| r.italic == italic && r.level == level) {
        Some(run) => run.text.push(c),
        None => runs.push(Run { text: c.into(), italic, level }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markup_becomes_stretches() {
        let found = runs("a $v_{l}$, $R^{2}T$");
        let texts: Vec<&str> = found.iter().map(|r| r.text.as_str()).collect();
        assert_eq!(texts, ["a ", "v", "l", ", ", "R", "2", "T"]);
        assert!(found[1].italic && !found[0].italic && found[2].level == Level::Sub && found[5].level == Level::Super);
    }

    #[test]
    fn small_letters_take_less_room() {
        let plain = |text: &str, size: f64| crate::picture::svg::width_of(text, size);
        let expected = plain("v", 10.0) + plain("max", SMALL * 10.0);
        assert!((width_of("$v_{max}$", 10.0) - expected).abs() < 1e-9);
    }

    #[test]
    fn stretches_are_laid_out_from_the_left_end() {
        let x = |anchor, text| maths("", [100.0, 0.0], anchor, text).to_string();
        // l and 0, smaller: 222·12/1000 + 556·0.76·12/1000 = 7.73, and 1.14 of it where it is wide.
        assert!(x("middle", "$l_{0}$").starts_with("<text class=\"\" x=\"95.9\" y=\"0\" text-anchor=\"start\""));
        assert!(x("end", "$l_{0}$").starts_with("<text class=\"\" x=\"91.2\" y=\"0\" text-anchor=\"start\""));
        assert!(x("end", "plain").contains("x=\"100\" y=\"0\" text-anchor=\"end\""));
    }

    #[test]
    fn signs_outside_of_mathematics_are_text() {
        assert_eq!(runs("a_{b}")[0].text, "a_{b}");
    }
}
