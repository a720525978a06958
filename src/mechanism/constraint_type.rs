//! Types of constraints: generic forms in named slots. To add one, add it to `constraint_types.toml`.

use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use serde::Deserialize;
use std::sync::{Arc, LazyLock};

/// A type of constraint as data: its generic form, what stands in it, and how it is written down.
///
/// | part | meaning |
/// |---|---|
/// | `form` | the generic form in the slots, which is zero; linear in rates |
/// | e | in `form` and in formulas of slots: the coefficient of creep of the constraint, zero is ideal |
/// | `slots` | what a constraint fills in; a name that ends in `'` stands for a rate or a linear form in rates |
///
/// Source: paper, (13) and (20) for its two forms. A type of one's own is made by [`ConstraintType::new`] or read from
/// TOML, where all fields have the names they have here.
///
/// ```
/// use creepage::mechanism::{Constraint, ConstraintType};
/// // A cable that pays out: the length paid out is what the drum turns, less what slips.
/// let cable = ConstraintType::new("cable", 'C', "pays' - (1 - e)*drum*turns'").unwrap();
/// let slots = [("pays'", "w'"), ("drum", "r"), ("turns'", "theta'")];
/// let constraint = Constraint::new("winch", &cable, &slots, "e_w").unwrap();
/// assert_eq!(constraint.generic().to_string(), "w' - (1 - e_w)*r*theta'");
/// assert_eq!(constraint.letter(), 'C');
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConstraintType {
    /// Its name in descriptions.
    pub id: String,
    /// Its letter in signatures, such as the R and T of R^k T^m.
    pub letter: char,
    /// What it says, in a word or two.
    pub meaning: String,
    /// The generic form, which is zero.
    pub form: Expr,
    /// The form in LaTeX; made from `form` when left out.
    pub latex: Option<String>,
    /// Where it comes from.
    #[serde(default)]
    pub source: String,
    /// What its coefficient is called.
    pub creep: String,
    /// What stands in the form, in the order of print.
    pub slots: Vec<Slot>,
    /// The slot whose rate the constraint gives where that is not measured; its coefficient is then none to choose.
    pub gives: Option<Symbol>,
    /// The slot whose zeros make σ undefined, while the row is regular.
    pub singular: Option<Symbol>,
    /// How the row of a model is best read.
    #[serde(default)]
    pub printed: Printed,
    /// Whose regimes of creep its coefficient has.
    #[serde(default)]
    pub regimes: Regimes,
}

/// Something that stands in a generic form.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Slot {
    /// Its name in the form.
    pub name: Symbol,
    /// Its name in LaTeX; made from the name when left out.
    pub latex: Option<String>,
    /// What it is.
    #[serde(default)]
    pub meaning: String,
    /// SI unit; left out where it depends on what is put in.
    pub unit: Option<String>,
    /// What it is made of, where it is made of other slots.
    pub formula: Option<Expr>,
    /// Whether a constraint may leave it out.
    #[serde(default)]
    pub optional: bool,
}

/// How the row of a model is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Printed {
    /// As the form with its slots put in.
    #[default]
    Form,
    /// Multiplied out, rate by rate.
    Row,
}

/// Which names the sizes of a coefficient have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Regimes {
    /// Those of rotation creep: slipping to skidding.
    Rotation,
    /// Those of traverse creep: right-creep to left-creep.
    Traverse,
    /// None: it is ideal or it creeps.
    #[default]
    None,
}

#[derive(Deserialize)]
struct Catalogue {
    #[serde(rename = "type")]
    types: Vec<ConstraintType>,
}

static CATALOGUE: LazyLock<Vec<Arc<ConstraintType>>> = LazyLock::new(|| {
    let parsed: std::result::Result<Catalogue, _> = toml::from_str(include_str!("constraint_types.toml"));
    // The text is part of the program; a test reads every entry.
    let found = parsed.unwrap_or_else(|e| unreachable!("the catalogue of constraint types is malformed: {e}"));
    found.types.into_iter().map(Arc::new).collect()
});

/// The constraint types of the catalogue, in the order in which signatures name them.
///
/// ```
/// let letters: String = creepage::mechanism::constraint_types().iter().map(|t| t.letter).collect();
/// assert!(letters.starts_with("RT"));
/// ```
pub fn constraint_types() -> &'static [Arc<ConstraintType>] {
    &CATALOGUE
}

/// The place of a letter among those of the catalogue; letters of one's own types come behind, by the alphabet.
pub(crate) fn rank(letter: char) -> (usize, char) {
    let place = CATALOGUE.iter().position(|t| t.letter == letter);
    (place.unwrap_or(CATALOGUE.len()), letter)
}

impl ConstraintType {
    /// A type by its generic form; every name in it but `e` is a slot, in alphabetical order.
    ///
    /// # Errors
    /// When the form is malformed.
    pub fn new(id: &str, letter: char, form: &str) -> Result<Self> {
        let form = Expr::parse(form)?;
        let slot = |name: Symbol| Slot {
            name,
            latex: None,
            meaning: String::new(),
            unit: None,
            formula: None,
            optional: false,
        };
        let slots = form.symbols().into_iter().filter(|s| s.as_str() != COEFFICIENT).map(slot).collect();
        Ok(Self {
            id: id.into(),
            letter,
            meaning: id.into(),
            form,
            latex: None,
            source: String::new(),
            creep: format!("{id} creep"),
            slots,
            gives: None,
            singular: None,
            printed: Printed::default(),
            regimes: Regimes::default(),
        })
    }

    /// The type of that id, or of that letter.
    ///
    /// # Errors
    /// When the catalogue has none.
    pub fn named(name: &str) -> Result<Arc<Self>> {
        let found = CATALOGUE.iter().find(|t| t.id == name || t.letter.to_string() == name);
        found.cloned().ok_or_else(|| {
            let known: Vec<&str> = CATALOGUE.iter().map(|t| t.id.as_str()).collect();
            Error::input(format!("no constraint type is called {name:?}"))
                .help(format!("the catalogue has {}; a type of your own is a table", known.join(", ")))
        })
    }

    /// The generic form as printed.
    pub fn text(&self) -> String {
        format!("{} = 0", self.form)
    }

    /// The generic form in LaTeX.
    pub fn in_latex(&self) -> String {
        format!("{} = 0", self.latex.clone().unwrap_or_else(|| self.form.latex()))
    }
}

impl Slot {
    /// Its name in LaTeX.
    pub fn in_latex(&self) -> String {
        self.latex.clone().unwrap_or_else(|| Expr::sym(self.name.clone()).latex())
    }
}

/// The coefficient of creep in the formulas of a type.
pub(crate) const COEFFICIENT: &str = "e";
