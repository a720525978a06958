//! Random formulas in which identities are decided, points where all of them are rational, and what may be done to them.

use super::rounding::Rounded;
use creepage::formula::{Exact, Expr, Fun, Node};
use proptest::prelude::*;

/// Symbols of numbers, then those of angles.
const NAMES: [&str; 5] = ["x", "y", "e", "phi", "psi"];

/// Values of the symbols: p/q of a number, or of the tangent of half of an angle.
pub type Point = [(i64, i64); 5];

pub fn points() -> impl Strategy<Value = Point> {
    prop::array::uniform5((-5i64..6, 1i64..6))
}

/// Points that no small formula singles out.
pub const FAR: [Point; 3] = [
    [(101, 13), (-17, 59), (37, 53), (29, 71), (-43, 31)],
    [(-7, 97), (83, 41), (-61, 19), (-11, 23), (67, 79)],
    [(47, 29), (19, 73), (5, 89), (-131, 17), (3, 103)],
];

/// The value of a name at a point.
pub fn exact(at: &Point, name: &str) -> Exact {
    let k = NAMES.iter().position(|n| *n == name).unwrap();
    let (p, q) = at[k];
    if k < 3 { Exact::ratio(p, q) } else { Exact::half_tangent(p, q) }
}

/// The same in floating point.
pub fn rounded(at: &Point, name: &str) -> Rounded {
    let value = exact(at, name).to_f64();
    Rounded { value, error: 4.0 * f64::EPSILON * value.abs() }
}

pub fn exactly(e: &Expr, at: &Point) -> Exact {
    e.eval_undefined_as_value(&|s| exact(at, s.as_str()))
}

/// An angle: a whole combination of phi, psi and their difference.
fn angle_texts() -> impl Strategy<Value = String> {
    let single = prop::sample::select(vec!["phi", "psi", "phi - psi", "phi + psi"]);
    (single, -3i32..4).prop_map(|(s, n)| format!("({n}*({s}))"))
}

/// Formulas of the fragment; every sine and cosine is rational at every point.
pub fn fragments() -> impl Strategy<Value = Expr> {
    let number = (0i32..4, 1i32..4).prop_map(|(p, q)| format!("({p}/{q})"));
    let symbol = prop::sample::select(NAMES[..3].to_vec()).prop_map(String::from);
    let of_angle = (prop::sample::select(vec!["sin", "cos", "tan", "cot"]), angle_texts());
    let leaf = prop_oneof![1 => number, 2 => symbol, 3 => of_angle.prop_map(|(f, a)| format!("{f}{a}"))];
    let texts = leaf.prop_recursive(4, 14, 2, |inner| {
        let shifted = (prop::sample::select(vec!["tan", "cot"]), angle_texts(), -2i32..3, inner.clone());
        let doubled = (prop::sample::select(vec!["sin", "cos"]), angle_texts(), -1i32..2, inner.clone());
        prop_oneof![
            6 => (prop::sample::select(vec!['+', '-', '*', '/']), inner.clone(), inner.clone())
                .prop_map(|(op, a, b)| format!("({a} {op} {b})")),
            1 => inner.clone().prop_map(|a| format!("(-{a})")),
            1 => (inner.clone(), -2i32..4).prop_map(|(a, n)| format!("({a})^{n}")),
            1 => shifted.prop_map(|(f, a, n, u)| format!("{f}({a} + {n}*atan({u}))")),
            1 => doubled.prop_map(|(f, a, n, u)| format!("{f}({a} + {n}*2*atan({u}))")),
        ]
    });
    texts.prop_map(|t| Expr::parse(&t).unwrap())
}

/// The same node with other parts.
fn with_parts(e: &Expr, parts: &[Expr]) -> Expr {
    match (e.node(), parts) {
        (Node::Neg(_), [x]) => -x,
        (Node::Pow(_, n), [x]) => x.pow(*n),
        (Node::Call(f, _), [x]) => Expr::call(*f, x),
        (Node::Add(..), [a, b]) => a + b,
        (Node::Sub(..), [a, b]) => a - b,
        (Node::Mul(..), [a, b]) => a * b,
        (Node::Div(..), [a, b]) => a / b,
        _ => e.clone(),
    }
}

/// Random small numbers, one after another.
pub struct Dice<'a>(pub std::slice::Iter<'a, u8>);

impl Dice<'_> {
    fn throw(&mut self) -> u8 {
        self.0.next().copied().unwrap_or(0)
    }
}

/// The formula written differently at random places: equal wherever both are defined.
pub fn rewritten(e: &Expr, dice: &mut Dice) -> Expr {
    let parts: Vec<_> = e.children().into_iter().map(|c| rewritten(c, dice)).collect();
    let e = with_parts(e, &parts);
    let choice = dice.throw();
    match choice % 8 {
        0 => inflated(&e, choice / 8),
        1..=4 => turned_over(&e, choice / 8),
        _ => e,
    }
}

fn inflated(e: &Expr, choice: u8) -> Expr {
    let p = |t: &str| Expr::parse(t).unwrap();
    match choice % 4 {
        0 => &(e * &p("sin(psi)^2")) + &(e * &p("cos(psi)^2")),
        1 => &(e * &p("x + tan(phi)")) / &p("x + tan(phi)"),
        2 => &(e - &p("cos(2*psi)")) + &p("1 - 2*sin(psi)^2"),
        _ => e.clone(),
    }
}

/// A law of the outermost operation.
fn turned_over(e: &Expr, choice: u8) -> Expr {
    match e.node() {
        Node::Add(a, b) => b + a,
        Node::Sub(a, b) => &-b + a,
        Node::Mul(a, b) => match b.node() {
            Node::Add(c, d) => &(a * c) + &(a * d),
            Node::Sub(c, d) => &(a * c) - &(a * d),
            _ => b * a,
        },
        Node::Div(a, b) => a * &(&Expr::int(1) / b),
        Node::Pow(x, n) if *n != 0 => &x.pow(n - 1) * x,
        Node::Call(f, x) => by_angles(*f, x, choice).unwrap_or_else(|| e.clone()),
        _ => e.clone(),
    }
}

/// A function of an angle by those of its parts.
fn by_angles(f: Fun, x: &Expr, choice: u8) -> Option<Expr> {
    let one = || Expr::int(1);
    let of = |x: &Expr| [Fun::Sin, Fun::Cos, Fun::Tan].map(|f| Expr::call(f, x));
    if choice.is_multiple_of(2) && f != Fun::Atan {
        let turned = Expr::call(f, &-x);
        return Some(if f == Fun::Cos { turned } else { -&turned });
    }
    let (a, b) = match x.node() {
        Node::Add(a, b) => (a.clone(), b.clone()),
        Node::Sub(a, b) => (a.clone(), -b),
        Node::Mul(n, a) if n.as_number()? == Expr::int(2).as_number()? => (a.clone(), a.clone()),
        _ => (x.clone(), Expr::int(0)),
    };
    let ([sin_a, cos_a, tan_a], [sin_b, cos_b, tan_b]) = (of(&a), of(&b));
    let (above, below) = (&tan_a + &tan_b, &one() - &(&tan_a * &tan_b));
    match f {
        Fun::Sin => Some(&(&sin_a * &cos_b) + &(&cos_a * &sin_b)),
        Fun::Cos => Some(&(&cos_a * &cos_b) - &(&sin_a * &sin_b)),
        Fun::Tan => Some(&above / &below),
        Fun::Cot => Some(&below / &above),
        _ => None,
    }
}

/// The formula with its k-th part changed.
pub fn mutant(e: &Expr, k: &mut usize) -> Expr {
    if *k == 0 {
        *k = usize::MAX;
        return changed(e);
    }
    *k -= usize::from(*k != usize::MAX);
    let parts: Vec<_> =
        e.children().into_iter().map(|c| if *k == usize::MAX { c.clone() } else { mutant(c, k) }).collect();
    with_parts(e, &parts)
}

fn changed(e: &Expr) -> Expr {
    let other = |s: &str| {
        NAMES[match NAMES.iter().position(|n| *n == s) {
            Some(k @ 0..2) => k + 1,
            Some(2) => 0,
            Some(3) => 4,
            _ => 3,
        }]
    };
    match e.node() {
        Node::Num(_) => e + &Expr::int(1),
        Node::Sym(s) => Expr::sym(other(s.as_str())),
        Node::Neg(x) => x.clone(),
        Node::Pow(x, n) => x.pow(n + 1),
        Node::Add(a, b) => a - b,
        Node::Sub(a, b) => a + b,
        Node::Mul(a, b) => a * &(b + &Expr::int(1)),
        Node::Div(a, b) => a * b,
        Node::Call(Fun::Sin, x) => Expr::call(Fun::Cos, x),
        Node::Call(Fun::Cos, x) => Expr::call(Fun::Sin, x),
        Node::Call(Fun::Tan, x) => Expr::call(Fun::Cot, x),
        Node::Call(Fun::Cot, x) => Expr::call(Fun::Tan, x),
        Node::Call(f, x) => Expr::call(*f, &(&Expr::int(2) * x)),
    }
}
