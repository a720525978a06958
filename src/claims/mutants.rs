//! Mutation of statements: every statement that is one small slip away from a true one.

use super::Statement;
use crate::formula::{BigRational, Expr, Fun, Node, Symbol};
use num_traits::One;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A statement with one slip in it.
#[derive(Clone, Debug)]
pub struct Mutant {
    /// What was changed, as "old → new".
    pub slip: String,
    /// The statement with the slip.
    pub statement: Statement,
}

/// Every statement that is one slip away: one sign, one function, one index, one number, one term left out.
///
/// A slip that changes nothing (the right side is the same function of its symbols) is no sabotage and left out.
pub fn mutants(statement: &Statement) -> Vec<Mutant> {
    let mut found: Vec<Mutant> = Vec::new();
    for (i, equation) in statement.equations().iter().enumerate() {
        let names: Vec<Symbol> = equation.right.symbols().into_iter().collect();
        for changed in slips(&equation.right, &names) {
            if !same_function(&equation.right, &changed) {
                let slip = format!("{} → {changed}", equation.right);
                let statement = statement.with(i, changed);
                if found.iter().all(|m| m.statement != statement) {
                    found.push(Mutant { slip, statement });
                }
            }
        }
    }
    found
}

/// The formulas with one node changed.
fn slips(e: &Expr, names: &[Symbol]) -> Vec<Expr> {
    let mut found = here(e, names);
    let children = e.children();
    for (i, child) in children.iter().enumerate() {
        found.extend(slips(child, names).into_iter().map(|c| rebuilt(e, i, &c)));
    }
    found
}

/// The changes of the topmost node.
fn here(e: &Expr, names: &[Symbol]) -> Vec<Expr> {
    let mut changed = match e.node() {
        Node::Num(v) => vec![Expr::number(&(v + BigRational::one())), Expr::number(&-v)],
        Node::Sym(s) => others(s, names),
        Node::Neg(x) => vec![x.clone()],
        Node::Add(a, b) => vec![a - b, a.clone(), b.clone()],
        Node::Sub(a, b) => vec![a + b, a.clone(), b - a],
        Node::Mul(a, b) => vec![a / b, a.clone(), b.clone()],
        Node::Div(a, b) => vec![a * b, b / a],
        Node::Pow(x, n) => vec![x.pow(n + 1), x.pow(-n)],
        Node::Call(f, x) => twin(*f).map(|g| Expr::call(g, x)).into_iter().collect(),
    };
    if matches!(e.node(), Node::Sym(_) | Node::Call(..)) {
        changed.push(-e);
    }
    changed
}

/// Names of the same formula that differ only in their index: e_1 for e_2.
fn others(s: &Symbol, names: &[Symbol]) -> Vec<Expr> {
    let stem =
        |s: &Symbol| s.as_str().trim_end_matches('\'').trim_end_matches(|c: char| c.is_ascii_digit()).to_string();
    let primes = |s: &Symbol| s.as_str().chars().filter(|c| *c == '\'').count();
    let alike = |o: &&Symbol| *o != s && stem(o) == stem(s) && primes(o) == primes(s);
    names.iter().filter(alike).map(|o| Expr::sym(o.clone())).collect()
}

/// The function one writes by mistake.
fn twin(f: Fun) -> Option<Fun> {
    match f {
        Fun::Sin => Some(Fun::Cos),
        Fun::Cos => Some(Fun::Sin),
        Fun::Tan => Some(Fun::Cot),
        Fun::Cot => Some(Fun::Tan),
        Fun::Atan => Some(Fun::Tan),
        Fun::Exp => Some(Fun::Tanh),
        Fun::Sqrt => Some(Fun::Abs),
        _ => None,
    }
}

/// A node with one of its parts replaced.
fn rebuilt(e: &Expr, index: usize, part: &Expr) -> Expr {
    let parts = e.children();
    let at = |i: usize| if i == index { part.clone() } else { parts[i].clone() };
    match e.node() {
        Node::Num(_) | Node::Sym(_) => e.clone(),
        Node::Neg(_) => -&at(0),
        Node::Add(..) => &at(0) + &at(1),
        Node::Sub(..) => &at(0) - &at(1),
        Node::Mul(..) => &at(0) * &at(1),
        Node::Div(..) => &at(0) / &at(1),
        Node::Pow(_, n) => at(0).pow(*n),
        Node::Call(f, _) => Expr::call(*f, &at(0)),
    }
}

/// Whether two formulas are the same function: by their normal form, outside its reach by their values at places
/// that know nothing of the check to come.
fn same_function(a: &Expr, b: &Expr) -> bool {
    if let Some(answer) = crate::formula::identical(a, b) {
        return answer;
    }
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let names: Vec<Symbol> = a.symbols().union(&b.symbols()).cloned().collect();
    let mut compared = 0;
    for _ in 0..40 {
        let at: Vec<f64> = names.iter().map(|_| rng.random_range(0.1..0.9)).collect();
        let value = |e: &Expr| e.eval(&|s| names.iter().position(|n| n == s).map_or(f64::NAN, |i| at[i]));
        match (value(a), value(b)) {
            (Some(x), Some(y)) if (x - y).abs() > 1e-9 * (1.0 + x.abs()) => return false,
            (Some(_), Some(_)) => compared += 1,
            (None, None) => {}
            _ => return false,
        }
    }
    compared > 0
}
