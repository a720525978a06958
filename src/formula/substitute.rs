//! Expressions as a carrier: substitution is evaluation.

use super::{BigRational, Expr, Fun, Node, Scalar, Symbol};

impl Scalar for Expr {
    fn number(value: &BigRational) -> Self {
        Expr::number(value)
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn neg(&self) -> Self {
        -self
    }
    fn mul(&self, other: &Self) -> Self {
        self * other
    }
    fn recip(&self) -> Self {
        &Expr::int(1) / self
    }
    fn sub(&self, other: &Self) -> Self {
        self - other
    }
    fn div(&self, other: &Self) -> Self {
        self / other
    }
    fn powi(&self, n: i32) -> Self {
        self.pow(n)
    }
    fn call(f: Fun, x: &Self) -> Self {
        Expr::call(f, x)
    }

    /// An expression that divides by the number zero has no value anywhere.
    fn is_defined(&self) -> bool {
        let here = match self.node() {
            Node::Div(_, b) => !b.is_zero(),
            Node::Pow(x, n) => *n >= 0 || !x.is_zero(),
            _ => true,
        };
        here && self.children().iter().all(|c| c.is_defined())
    }

    fn equals(&self, other: &Self) -> bool {
        self.is_defined() && self == other
    }
}

impl Expr {
    /// The expression with every symbol replaced by what `by` gives for it; `None` keeps the symbol.
    ///
    /// ```
    /// use creepage::formula::Expr;
    /// let e = Expr::parse("r*theta'").unwrap();
    /// let scaled = Expr::parse("r*(1 + scale)").unwrap();
    /// let s = e.substitute(&|name| (name.as_str() == "r").then(|| scaled.clone()));
    /// assert_eq!(s.to_string(), "r*(1 + scale)*theta'");
    /// ```
    pub fn substitute(&self, by: &impl Fn(&Symbol) -> Option<Expr>) -> Expr {
        self.eval_undefined_as_value(&|s: &Symbol| by(s).unwrap_or_else(|| Expr::sym(s.clone())))
    }
}
