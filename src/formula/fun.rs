//! The elementary functions of the language.

/// A function of one argument; angles are in radians.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Fun {
    /// sin x
    Sin,
    /// cos x
    Cos,
    /// tan x, undefined at odd multiples of π/2
    Tan,
    /// cot x, undefined at multiples of π
    Cot,
    /// arcsin x, defined for |x| ≤ 1
    Asin,
    /// arccos x, defined for |x| ≤ 1
    Acos,
    /// arctan x in (−π/2, π/2)
    Atan,
    /// tanh x
    Tanh,
    /// eˣ
    Exp,
    /// natural logarithm, defined for x > 0
    Ln,
    /// √x, defined for x ≥ 0
    Sqrt,
    /// |x|
    Abs,
    /// −1, 0 or 1
    Sign,
    /// Heaviside's step: 1 where x > 0, 0 elsewhere
    Step,
}

/// Every function with its name in the language and in LaTeX.
const TABLE: &[(Fun, &str, &str)] = &[
    (Fun::Sin, "sin", r"\sin"),
    (Fun::Cos, "cos", r"\cos"),
    (Fun::Tan, "tan", r"\tan"),
    (Fun::Cot, "cot", r"\cot"),
    (Fun::Asin, "asin", r"\arcsin"),
    (Fun::Acos, "acos", r"\arccos"),
    (Fun::Atan, "atan", r"\arctan"),
    (Fun::Tanh, "tanh", r"\tanh"),
    (Fun::Exp, "exp", r"\exp"),
    (Fun::Ln, "ln", r"\ln"),
    (Fun::Sqrt, "sqrt", r"\sqrt"),
    (Fun::Abs, "abs", r"\operatorname{abs}"),
    (Fun::Sign, "sign", r"\operatorname{sgn}"),
    (Fun::Step, "heaviside", r"\operatorname{H}"),
];

impl Fun {
    /// All functions, in the order of the table of the language.
    pub fn all() -> impl Iterator<Item = Fun> {
        TABLE.iter().map(|row| row.0)
    }

    /// The function of that name.
    pub fn named(name: &str) -> Option<Fun> {
        TABLE.iter().find(|row| row.1 == name).map(|row| row.0)
    }

    /// Its name in the language.
    pub fn name(self) -> &'static str {
        self.row().1
    }

    /// Its name in LaTeX.
    pub fn latex(self) -> &'static str {
        self.row().2
    }

    fn row(self) -> &'static (Fun, &'static str, &'static str) {
        // The table lists every variant; a test walks all of them.
        TABLE.iter().find(|row| row.0 == self).unwrap_or(&TABLE[0])
    }

    /// Whether the function is defined for every real argument.
    pub fn is_total(self) -> bool {
        use Fun::*;
        matches!(self, Sin | Cos | Atan | Tanh | Abs | Sign | Step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_function_is_found_under_its_own_name() {
        use Fun::*;
        for f in [Sin, Cos, Tan, Cot, Asin, Acos, Atan, Tanh, Exp, Ln, Sqrt, Abs, Sign, Step] {
            assert_eq!(f.row().0, f);
            assert_eq!(Fun::named(f.name()), Some(f));
        }
        assert_eq!(Fun::all().count(), 14);
    }
}
