//! Text with a little mathematics: letters in italics, subscripts and superscripts.

use super::svg::{Element, label};

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
/// ```
/// use creepage::picture::maths::maths;
/// let e = maths("", [0.0, 0.0], "start", "creep $e_{rc}$ = 0.2").to_string();
/// assert!(e.contains("<tspan font-style=\"italic\">e</tspan><tspan dy=\"3.4\" class=\"small\">rc</tspan>"), "{e}");
/// assert!(e.contains("<tspan dy=\"-3.4\"> = 0.2</tspan>"), "{e}");
/// ```
pub fn maths(class: &str, at: [f64; 2], anchor: &str, text: &str) -> Element {
    // Some programs drop the spaces at the ends of a span, unless they are told not to.
    let mut out = label(class, at, anchor, "").with("xml:space", "preserve");
    let mut level = Level::Line;
    for run in runs(text) {
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
    if before == Level::Sub && run.level == Level::Line && !run.text.starts_with(' ') {
        span = span.number("dx", ROOM);
    }
    if run.level != Level::Line {
        span = span.with("class", "small");
    }
    span.text(run.text.clone())
}

/// A guess at the width of such a text in pixels.
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
    fn signs_outside_of_mathematics_are_text() {
        assert_eq!(runs("a_{b}")[0].text, "a_{b}");
    }
}
