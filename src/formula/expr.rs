//! Expressions: formulas as data.

use super::{BigInt, BigRational, Fun, Scalar, Symbol};
use num_traits::Signed;
use std::collections::BTreeSet;
use std::sync::Arc;

/// A formula: immutable, cheap to clone, compared by its form (`a + b` and `b + a` differ).
///
/// Numbers are exact. `+`, `-`, `*`, `/` build a formula and drop what changes neither value nor domain
/// (`0 + x`, `1*x`; `0*x` only where `x` is defined everywhere).
///
/// ```
/// use creepage::formula::Expr;
/// let v = Expr::parse("r*(1 - e_rc)*theta'").unwrap();
/// let at = |s: &str| match s { "r" => 0.5, "e_rc" => 0.1, _ => 2.0 };
/// assert_eq!(v.eval(&|s| at(s.as_str())), Some(0.9));
/// assert_eq!(v.to_string(), "r*(1 - e_rc)*theta'");
/// ```
#[derive(Clone, PartialEq, Eq, Hash)]
pub struct Expr(Arc<Node>);

/// The shape of an expression.
#[derive(PartialEq, Eq, Hash)]
pub enum Node {
    /// A non-negative terminating decimal, such as `0.25`.
    Num(BigRational),
    /// A name.
    Sym(Symbol),
    /// −x
    Neg(Expr),
    /// x + y
    Add(Expr, Expr),
    /// x − y
    Sub(Expr, Expr),
    /// x·y
    Mul(Expr, Expr),
    /// x/y
    Div(Expr, Expr),
    /// xⁿ
    Pow(Expr, i32),
    /// f(x)
    Call(Fun, Expr),
}

/// Deepest nesting a formula may have, so that no walk over it can exhaust the stack.
pub(super) const MAX_DEPTH: usize = 400;

impl Expr {
    /// An expression of exactly this form.
    pub(super) fn raw(node: Node) -> Self {
        Self(Arc::new(node))
    }

    /// Its form.
    pub fn node(&self) -> &Node {
        &self.0
    }

    /// A name.
    pub fn sym(name: impl Into<Symbol>) -> Self {
        Self::raw(Node::Sym(name.into()))
    }

    /// A whole number.
    pub fn int(n: i64) -> Self {
        Self::number(&BigRational::from(n))
    }

    /// An exact number; what is no decimal becomes a quotient of two.
    pub fn number(value: &BigRational) -> Self {
        if value.is_negative() {
            return Self::raw(Node::Neg(Self::number(&-value)));
        }
        if is_decimal(value) {
            return Self::raw(Node::Num(value.clone()));
        }
        let whole = |n: &BigInt| Self::raw(Node::Num(BigRational::from(n.clone())));
        Self::raw(Node::Div(whole(value.numerator()), whole(value.denominator().as_ibig())))
    }

    /// A function of an expression.
    pub fn call(f: Fun, x: &Expr) -> Self {
        Self::raw(Node::Call(f, x.clone()))
    }

    /// x raised to a whole power.
    pub fn pow(&self, n: i32) -> Self {
        match n {
            0 if self.is_total() => Self::int(1),
            1 => self.clone(),
            _ => Self::raw(Node::Pow(self.clone(), n)),
        }
    }

    /// The exact value of an expression made of numbers alone, when it has one.
    pub fn as_number(&self) -> Option<BigRational> {
        match self.node() {
            Node::Num(v) => Some(v.clone()),
            Node::Neg(x) => Some(-x.as_number()?),
            Node::Div(a, b) => {
                let b = b.as_number()?;
                if b.is_zero() { None } else { Some(a.as_number()? / b) }
            }
            _ => None,
        }
    }

    /// Whether this is the number zero.
    pub fn is_zero(&self) -> bool {
        self.as_number().is_some_and(|v| v.is_zero())
    }

    /// Whether this is the number one.
    pub fn is_one(&self) -> bool {
        self.as_number().is_some_and(|v| v.is_one())
    }

    /// Whether the expression is defined for all real values of its symbols (overflow apart).
    pub fn is_total(&self) -> bool {
        match self.node() {
            Node::Num(_) | Node::Sym(_) => true,
            Node::Neg(x) => x.is_total(),
            Node::Add(a, b) | Node::Sub(a, b) | Node::Mul(a, b) => a.is_total() && b.is_total(),
            Node::Div(a, b) => a.is_total() && b.as_number().is_some_and(|v| !v.is_zero()),
            Node::Pow(x, n) => *n >= 0 && x.is_total(),
            Node::Call(f, x) => f.is_total() && x.is_total(),
        }
    }

    /// The names in the expression, sorted.
    pub fn symbols(&self) -> BTreeSet<Symbol> {
        let mut found = BTreeSet::new();
        self.visit(&mut |e| {
            if let Node::Sym(s) = e.node() {
                found.insert(s.clone());
            }
        });
        found
    }

    /// Whether a name occurs in the expression.
    pub fn mentions(&self, name: &Symbol) -> bool {
        let mut found = false;
        self.visit(&mut |e| found |= matches!(e.node(), Node::Sym(s) if s == name));
        found
    }

    /// Whether one of some functions is called in the expression.
    pub(crate) fn calls(&self, is: impl Fn(Fun) -> bool) -> bool {
        let mut found = false;
        self.visit(&mut |e| found |= matches!(e.node(), Node::Call(f, _) if is(*f)));
        found
    }

    fn visit(&self, f: &mut impl FnMut(&Expr)) {
        f(self);
        self.children().iter().for_each(|c| c.visit(f));
    }

    /// The direct parts of the expression, left to right.
    pub fn children(&self) -> Vec<&Expr> {
        match self.node() {
            Node::Num(_) | Node::Sym(_) => vec![],
            Node::Neg(x) | Node::Pow(x, _) | Node::Call(_, x) => vec![x],
            Node::Add(a, b) | Node::Sub(a, b) | Node::Mul(a, b) | Node::Div(a, b) => vec![a, b],
        }
    }

    /// The expression of the same form with other parts.
    pub(crate) fn with_parts(&self, mut of: impl FnMut(&Expr) -> Expr) -> Expr {
        match self.node() {
            Node::Num(_) | Node::Sym(_) => self.clone(),
            Node::Neg(x) => -&of(x),
            Node::Add(a, b) => &of(a) + &of(b),
            Node::Sub(a, b) => &of(a) - &of(b),
            Node::Mul(a, b) => &of(a) * &of(b),
            Node::Div(a, b) => &of(a) / &of(b),
            Node::Pow(x, n) => of(x).pow(*n),
            Node::Call(f, x) => Expr::call(*f, &of(x)),
        }
    }

    /// The value of the expression in a carrier, or `None` where it is undefined.
    ///
    /// ```
    /// use creepage::formula::Expr;
    /// let cot = Expr::parse("cot(phi)").unwrap();
    /// assert_eq!(cot.eval(&|_| 0.0), None);
    /// ```
    pub fn eval<S: Scalar>(&self, value: &impl Fn(&Symbol) -> S) -> Option<S> {
        let result = self.eval_undefined_as_value(value);
        result.is_defined().then_some(result)
    }

    /// As [`Expr::eval`], with "undefined" as the carrier's own undefined value.
    pub fn eval_undefined_as_value<S: Scalar>(&self, value: &impl Fn(&Symbol) -> S) -> S {
        let go = |e: &Expr| e.eval_undefined_as_value(value);
        match self.node() {
            Node::Num(v) => S::number(v),
            Node::Sym(s) => value(s),
            Node::Neg(x) => go(x).neg(),
            Node::Add(a, b) => go(a).add(&go(b)),
            Node::Sub(a, b) => go(a).sub(&go(b)),
            Node::Mul(a, b) => go(a).mul(&go(b)),
            Node::Div(a, b) => go(a).div(&go(b)),
            Node::Pow(x, n) => go(x).powi(*n),
            Node::Call(f, x) => S::call(*f, &go(x)),
        }
    }
}

/// The number zero.
impl Default for Expr {
    fn default() -> Self {
        Self::int(0)
    }
}

/// Whether the denominator has no prime factor but 2 and 5.
fn is_decimal(value: &BigRational) -> bool {
    let mut rest = value.denominator().as_ibig().clone();
    for p in [2, 5] {
        while (&rest % BigInt::from(p)).is_zero() {
            rest /= p;
        }
    }
    rest.is_one()
}

impl std::ops::Neg for &Expr {
    type Output = Expr;
    fn neg(self) -> Expr {
        match self.node() {
            Node::Neg(x) => x.clone(),
            _ if self.is_zero() => self.clone(),
            _ => Expr::raw(Node::Neg(self.clone())),
        }
    }
}

impl std::ops::Add for &Expr {
    type Output = Expr;
    fn add(self, other: &Expr) -> Expr {
        match (self.as_number(), other.as_number()) {
            (Some(a), Some(b)) => Expr::number(&(a + b)),
            (Some(a), _) if a.is_zero() => other.clone(),
            (_, Some(b)) if b.is_zero() => self.clone(),
            _ => match other.node() {
                Node::Neg(x) => Expr::raw(Node::Sub(self.clone(), x.clone())),
                _ => Expr::raw(Node::Add(self.clone(), other.clone())),
            },
        }
    }
}

impl std::ops::Sub for &Expr {
    type Output = Expr;
    fn sub(self, other: &Expr) -> Expr {
        match (self.as_number(), other.as_number()) {
            (Some(a), Some(b)) => Expr::number(&(a - b)),
            (Some(a), _) if a.is_zero() => -other,
            (_, Some(b)) if b.is_zero() => self.clone(),
            _ => match other.node() {
                Node::Neg(x) => Expr::raw(Node::Add(self.clone(), x.clone())),
                _ => Expr::raw(Node::Sub(self.clone(), other.clone())),
            },
        }
    }
}

impl std::ops::Mul for &Expr {
    type Output = Expr;
    fn mul(self, other: &Expr) -> Expr {
        match (self.as_number(), other.as_number()) {
            (Some(a), Some(b)) => Expr::number(&(a * b)),
            (Some(a), _) => scaled(&a, self, other),
            (_, Some(b)) => scaled(&b, other, self),
            // A sign stands in front of the product it belongs to.
            _ => match (self.node(), other.node()) {
                (Node::Neg(a), _) => -&(a * other),
                (_, Node::Neg(b)) => -&(self * b),
                _ => Expr::raw(Node::Mul(self.clone(), other.clone())),
            },
        }
    }
}

/// A number times an expression; zero swallows only what is defined everywhere.
fn scaled(factor: &BigRational, written: &Expr, x: &Expr) -> Expr {
    if factor.is_one() {
        x.clone()
    } else if factor.is_zero() && x.is_total() {
        Expr::int(0)
    } else if factor.is_negative() {
        -&scaled(&-factor, &-written, x)
    } else if let Node::Neg(inner) = x.node() {
        -&scaled(factor, written, inner)
    } else {
        Expr::raw(Node::Mul(written.clone(), x.clone()))
    }
}

impl std::ops::Div for &Expr {
    type Output = Expr;
    fn div(self, other: &Expr) -> Expr {
        match (self.as_number(), other.as_number()) {
            (Some(a), Some(b)) if !b.is_zero() => Expr::number(&(a / b)),
            (_, Some(b)) if b.is_one() => self.clone(),
            _ if matches!(self.node(), Node::Neg(_)) => -&(&-self / other),
            _ => Expr::raw(Node::Div(self.clone(), other.clone())),
        }
    }
}
