//! The parser: tokens to expressions, by precedence climbing.

use super::expr::MAX_DEPTH;
use super::lex::{Token, TokenKind, caret, tokens};
use super::{Expr, Fun, Node, Symbol};
use crate::error::{Error, Result};
use num_traits::ToPrimitive;

/// Largest whole power a formula may hold.
const MAX_POWER: i32 = 64;

impl Expr {
    /// Reads a formula; the error shows the text with a caret under the place it stopped at.
    ///
    /// Operators from loose to tight: `+ -`, unary `-`, `* /`, `^` with a whole exponent. Functions are
    /// those of [`Fun`].
    ///
    /// # Errors
    /// An input error with line and column where the text is no formula.
    ///
    /// ```
    /// use creepage::formula::Expr;
    /// let e = Expr::parse("sin(phi + ) * x").unwrap_err();
    /// assert_eq!(e.to_string(), "1:11: expected a number, a name or \"(\", found \")\"\n  sin(phi + ) * x\n            ^");
    /// ```
    pub fn parse(text: &str) -> Result<Expr> {
        let tokens = tokens(text)?;
        let mut parser = Parser { text, tokens, at: 0, depth: 0 };
        let (e, _) = parser.sum()?;
        match parser.peek() {
            TokenKind::End => Ok(e),
            _ => Err(parser.unexpected("an operator or the end")),
        }
    }
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    at: usize,
    depth: usize,
}

/// An expression and the height of its tree.
type Tall = (Expr, usize);

impl Parser<'_> {
    fn peek(&self) -> &TokenKind {
        &self.tokens[self.at].kind
    }

    /// Passes a token that was looked at and is not the end.
    fn advance(&mut self) {
        self.at += 1;
    }

    fn take(&mut self, mark: char) -> bool {
        let found = *self.peek() == TokenKind::Mark(mark);
        if found {
            self.advance();
        }
        found
    }

    fn error(&self, message: impl Into<String>) -> Error {
        caret(self.text, self.tokens[self.at].column, message)
    }

    fn unexpected(&self, wanted: &str) -> Error {
        let found = match self.peek() {
            TokenKind::Number(_) => "a number".to_string(),
            TokenKind::Name(n) => format!("the name {n:?}"),
            TokenKind::Mark(c) => format!("\"{c}\""),
            TokenKind::End => "the end".to_string(),
        };
        self.error(format!("expected {wanted}, found {found}"))
    }

    /// Bounds the height of the tree, and with it the stack of every later walk.
    fn grown(&self, node: Node, height: usize) -> Result<Tall> {
        if height >= MAX_DEPTH {
            return Err(self.error(format!("the formula is nested more than {MAX_DEPTH} deep")).help("split it"));
        }
        Ok((Expr::raw(node), height + 1))
    }

    fn sum(&mut self) -> Result<Tall> {
        let mut left = self.product()?;
        loop {
            let build = match self.peek() {
                TokenKind::Mark('+') => Node::Add,
                TokenKind::Mark('-') => Node::Sub,
                _ => return Ok(left),
            };
            self.advance();
            let right = self.product()?;
            left = self.grown(build(left.0, right.0), left.1.max(right.1))?;
        }
    }

    /// A minus sign stands for the whole product behind it: −a·b is −(a·b).
    fn product(&mut self) -> Result<Tall> {
        self.descend(|p| {
            let signs = p.signs();
            let mut left = p.power()?;
            loop {
                let build = match p.peek() {
                    TokenKind::Mark('*') => Node::Mul,
                    TokenKind::Mark('/') => Node::Div,
                    _ => return p.negated(left, signs),
                };
                p.advance();
                let right = p.factor()?;
                left = p.grown(build(left.0, right.0), left.1.max(right.1))?;
            }
        })
    }

    /// What stands behind `*` or `/`; a minus sign there binds to this factor alone.
    fn factor(&mut self) -> Result<Tall> {
        let signs = self.signs();
        let x = self.power()?;
        self.negated(x, signs)
    }

    /// Passes minus signs in a row, and counts them.
    ///
    /// They take no level of nesting, so brackets and functions alone do: no more of these stand around each other in what is
    /// printed than the tree is tall, and what is printed can be read again.
    fn signs(&mut self) -> usize {
        std::iter::repeat_with(|| self.take('-')).take_while(|taken| *taken).count()
    }

    fn negated(&self, x: Tall, signs: usize) -> Result<Tall> {
        (0..signs).try_fold(x, |x, _| self.grown(Node::Neg(x.0), x.1))
    }

    /// Goes one level deeper, within the bound on nesting.
    fn descend(&mut self, parse: impl FnOnce(&mut Self) -> Result<Tall>) -> Result<Tall> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(self.error(format!("the formula is nested more than {MAX_DEPTH} deep")).help("split it"));
        }
        let result = parse(self);
        self.depth -= 1;
        result
    }

    fn power(&mut self) -> Result<Tall> {
        let base = self.atom()?;
        if !self.take('^') {
            return Ok(base);
        }
        let n = self.whole_exponent()?;
        self.grown(Node::Pow(base.0, n), base.1)
    }

    /// `2`, `-2` or `(-2)` after a `^`.
    fn whole_exponent(&mut self) -> Result<i32> {
        let bracket = self.take('(');
        let negative = self.take('-');
        let value = match self.peek() {
            TokenKind::Number(v) if v.is_int() => v.numerator().to_i32().filter(|n| *n <= MAX_POWER),
            _ => None,
        };
        let wanted = format!("a whole exponent up to {MAX_POWER}");
        let n = value.ok_or_else(|| self.unexpected(&wanted).help("write other powers with sqrt, exp and ln"))?;
        self.advance();
        if bracket && !self.take(')') {
            return Err(self.unexpected("\")\""));
        }
        if *self.peek() == TokenKind::Mark('^') {
            return Err(self.error("a power of a power needs parentheses"));
        }
        Ok(if negative { -n } else { n })
    }

    fn atom(&mut self) -> Result<Tall> {
        match self.peek().clone() {
            TokenKind::Number(v) => {
                self.advance();
                Ok((Expr::raw(Node::Num(v)), 1))
            }
            TokenKind::Name(name) => self.name(&name),
            TokenKind::Mark('(') => {
                self.advance();
                let inner = self.sum()?;
                self.close()?;
                Ok(inner)
            }
            _ => Err(self.unexpected("a number, a name or \"(\"")),
        }
    }

    fn close(&mut self) -> Result<()> {
        if self.take(')') { Ok(()) } else { Err(self.unexpected("\")\"")) }
    }

    fn name(&mut self, name: &str) -> Result<Tall> {
        let here = self.at;
        self.advance();
        let called = *self.peek() == TokenKind::Mark('(');
        match (Fun::named(name), called) {
            (Some(f), true) => {
                self.advance();
                let x = self.sum()?;
                self.close()?;
                self.grown(Node::Call(f, x.0), x.1)
            }
            (None, false) => Ok((Expr::sym(Symbol::new(&name.replace('′', "'"))), 1)),
            (Some(_), false) => Err(self.unexpected("\"(\" after a function")),
            (None, true) => {
                self.at = here;
                let known: Vec<_> = Fun::all().map(Fun::name).collect();
                Err(self
                    .error(format!("no function is called {name:?}"))
                    .help(format!("known are {}", known.join(", "))))
            }
        }
    }
}
