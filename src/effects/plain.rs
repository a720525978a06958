//! An effect in a sentence anyone understands: a template with numbers and words that follow from the fitted values.
//!
//! | in braces | becomes |
//! |---|---|
//! | `{abs(scale) \| %}` | the value of the formula in that unit, to two digits: 3.0 % |
//! | `{scale ? larger : smaller}` | the first words where the formula is zero or more, else the second |
//! | `{input}` | the input it acts on, such as "steering angle" |
//! | `{trailer}` | the number of its trailer |
//!
//! Formulas know the parameters of the effect and how the vehicle was driven: `speed`, m/s, and `turning`, rad/s.

use crate::error::{Error, Result};
use crate::formula::Expr;
use crate::number_format::in_everyday_unit;
use serde::Deserialize;

/// The speed and the yaw rate at which a sentence says what an effect amounts to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TypicalMotion {
    /// Forward speed, m/s.
    pub speed: f64,
    /// Size of the yaw rate in turns, rad/s.
    pub turning: f64,
    /// When the last of the runs ends, s.
    pub until: f64,
}

/// A sentence with gaps for numbers and words.
///
/// ```
/// use creepage::effects::PlainSentence;
/// assert!(PlainSentence::parse("The wheels are {abs(scale) | %} {scale ? larger : smaller} than stated.").is_ok());
/// assert!(PlainSentence::parse("It slides {abs(c | m/s}.").is_err());
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub struct PlainSentence(Vec<Piece>);

#[derive(Clone, Debug, PartialEq)]
enum Piece {
    Text(String),
    Number(Expr, String),
    Choice(Expr, [String; 2]),
    Input,
    Trailer,
}

/// Units that a number may be said in; `input` stands for that of the input.
const UNITS: [&str; 10] = ["%", "1", "m", "m/s", "s", "rad", "rad/s", "deg", "deg/s", "input"];
/// What formulas know beside the parameters.
const DRIVEN: [&str; 2] = ["speed", "turning"];
/// The unit that stands for that of the input.
const INPUT_UNIT: &str = "input";

impl TryFrom<String> for PlainSentence {
    type Error = Error;

    fn try_from(text: String) -> Result<Self> {
        Self::parse(&text)
    }
}

impl PlainSentence {
    /// Reads a template.
    ///
    /// # Errors
    /// Where a brace is not closed, a formula is malformed or a unit is not known.
    pub fn parse(text: &str) -> Result<Self> {
        let mut pieces = vec![];
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('{') {
            if !before.is_empty() {
                pieces.push(Piece::Text(before.into()));
            }
            let closed = after.split_once('}').ok_or_else(|| Error::input("a { of the sentence has no }"))?;
            pieces.push(piece(closed.0)?);
            rest = closed.1;
        }
        if !rest.is_empty() {
            pieces.push(Piece::Text(rest.into()));
        }
        Ok(Self(pieces))
    }

    /// Names in its formulas that are neither parameters nor known of the driving.
    ///
    /// ```
    /// use creepage::effects::PlainSentence;
    /// let plain = PlainSentence::parse("It slides {c*speed*load | m/s}.").unwrap();
    /// assert_eq!(plain.unknown(&["c"]), ["load"]);
    /// ```
    pub fn unknown(&self, parameters: &[&str]) -> Vec<String> {
        let formulas = self.0.iter().filter_map(|p| match p {
            Piece::Number(e, _) | Piece::Choice(e, _) => Some(e),
            _ => None,
        });
        let names = formulas.flat_map(Expr::symbols).map(|s| s.as_str().to_string());
        names.filter(|n| !parameters.contains(&n.as_str()) && !DRIVEN.contains(&n.as_str())).collect()
    }

    /// The sentence of something; `None` where a number of it is undefined.
    pub(super) fn of(&self, subject: &Subject) -> Option<String> {
        self.0.iter().map(|piece| said(piece, subject)).collect()
    }
}

/// What a sentence speaks of.
pub(super) struct Subject<'a> {
    /// Parameters by name, with their values.
    pub values: Vec<(&'a str, f64)>,
    /// The role of the input, and the unit in which people say it.
    pub input: Option<(&'a str, &'a str)>,
    /// The trailer.
    pub trailer: Option<usize>,
    /// How the vehicle was driven.
    pub motion: TypicalMotion,
}

fn piece(inside: &str) -> Result<Piece> {
    match inside.trim() {
        "input" => return Ok(Piece::Input),
        "trailer" => return Ok(Piece::Trailer),
        _ => {}
    }
    if let Some((formula, words)) = inside.split_once('?') {
        let words = words.split_once(':').ok_or_else(|| Error::input("{formula ? words : words} lacks its :"))?;
        return Ok(Piece::Choice(Expr::parse(formula.trim())?, [words.0.trim().into(), words.1.trim().into()]));
    }
    let (formula, unit) = inside
        .rsplit_once('|')
        .ok_or_else(|| Error::input(format!("{{{inside}}} has no unit")).help("write {formula | unit}"))?;
    let unit = unit.trim();
    match UNITS.contains(&unit) {
        true => Ok(Piece::Number(Expr::parse(formula.trim())?, unit.into())),
        false => Err(Error::input(format!("\"{unit}\" is no unit of a sentence"))
            .help(format!("units of sentences: {}", UNITS.join(", ")))),
    }
}

fn said(piece: &Piece, of: &Subject) -> Option<String> {
    let value = |e: &Expr| {
        let of = |name: &str| match of.values.iter().find(|(parameter, _)| *parameter == name) {
            Some((_, value)) => *value,
            None if name == DRIVEN[0] => of.motion.speed,
            None => of.motion.turning,
        };
        e.eval(&|s| of(s.as_str())).filter(|v: &f64| v.is_finite())
    };
    match piece {
        Piece::Text(text) => Some(text.clone()),
        Piece::Number(formula, unit) => {
            let unit = of.input.filter(|_| unit == INPUT_UNIT).map_or(unit.as_str(), |(_, unit)| unit);
            Some(in_everyday_unit(value(formula)?, unit))
        }
        Piece::Choice(formula, words) => Some(words[usize::from(value(formula)? < 0.0)].clone()),
        Piece::Input => Some(of.input.map_or_else(|| "inputs".into(), |(role, _)| in_words(role))),
        Piece::Trailer => Some(of.trailer.unwrap_or(1).to_string()),
    }
}

/// The role of an input in words: "left wheel rate".
fn in_words(role: &str) -> String {
    let sides = ["left", "right", "front", "rear"];
    match role.rsplit_once('_').filter(|(_, side)| sides.contains(side)) {
        Some((stem, side)) => format!("{side} {}", stem.replace('_', " ")),
        None => role.replace('_', " "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{self, Applied};

    const MOTION: TypicalMotion = TypicalMotion { speed: 0.6, turning: 1.0, until: 60.0 };

    fn sentence(id: &str, values: &[f64]) -> String {
        let effect = effects::named(id).unwrap();
        let effect = effect.on_input("steering_angle", "rad", 0.4);
        let trailer = effect.per_trailer.then_some(2);
        let applied = Applied::new(&effect, trailer, values.to_vec());
        applied.in_plain_words(MOTION).unwrap()
    }

    #[test]
    fn sentences_say_sizes_and_sides() {
        assert_eq!(sentence("track-width", &[0.0300042]), "The wheels stand 3.0 % further apart than the model says.");
        assert_eq!(sentence("track-width", &[-0.03]), "The wheels stand 3.0 % closer together than the model says.");
        let slides = sentence("cornering-creep", &[0.11]);
        assert_eq!(slides, "In turns the robot slides outwards: 6.6 cm/s at 0.60 m/s and 1.0 rad/s.");
        let limit = sentence("input-saturation", &[0.3]);
        assert_eq!(limit, "The robot does not follow the steering angle beyond 17°.");
        assert!(sentence("trailer-length", &[0.05]).contains("railer 2 "));
    }

    /// Every effect has one, whose names are known and whose numbers are defined on both sides of zero.
    #[test]
    fn every_effect_of_the_catalogue_has_a_sentence() {
        for effect in effects::all() {
            let plain = effect.plain.as_ref().unwrap_or_else(|| panic!("{} has no sentence", effect.id));
            let names: Vec<&str> = effect.parameters.keys().map(String::as_str).collect();
            assert_eq!(plain.unknown(&names), Vec::<String>::new(), "{}", effect.id);
            let of = |sign: f64| {
                let size = |p: &effects::Parameter| if p.positive { p.size } else { sign * p.size };
                sentence(&effect.id, &effect.parameters.values().map(size).collect::<Vec<_>>())
            };
            let (one, other) = (of(1.0), of(-1.0));
            for told in [&one, &other] {
                assert!(told.ends_with('.') && !told.contains(['{', '}', '-']), "{}: {told}", effect.id);
                assert!(told.starts_with(|c: char| c.is_uppercase()), "{}: {told}", effect.id);
            }
            let signed = effect.parameters.values().any(|p| !p.positive && !p.periodic);
            assert!(!signed || one != other, "{}: {one} says neither side", effect.id);
        }
    }

    #[test]
    fn what_is_no_template_is_refused() {
        for bad in ["{", "{x}", "{x | parsec}", "{x ? yes}", "{x + | m}", "{x ? a : b"] {
            assert!(PlainSentence::parse(bad).is_err(), "{bad}");
        }
        assert_eq!(in_words("wheel_rate_left"), "left wheel rate");
        assert_eq!(in_words("yaw_rate"), "yaw rate");
    }
}
