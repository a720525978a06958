//! Long formulas in LaTeX, broken into lines between their terms.

use crate::formula::{Expr, Node};

/// Widest line, counted in characters of the plain text.
const WIDTH: usize = 88;

/// The formula in lines for an `align*`: every line but the first begins with the sign of its first term.
pub(super) fn lines(formula: &Expr) -> Vec<String> {
    if formula.to_string().len() <= WIDTH {
        return vec![formula.latex()];
    }
    match formula.node() {
        Node::Div(top, bottom) if matches!(top.node(), Node::Add(..) | Node::Sub(..)) => {
            let mut lines = lines(top);
            if let Some(first) = lines.first_mut() {
                *first = format!(r"\frac{{1}}{{{}}}\bigl({first}", bottom.latex());
            }
            if let Some(last) = lines.last_mut() {
                last.push_str(r"\bigr)");
            }
            lines
        }
        _ => chunks(formula),
    }
}

fn chunks(formula: &Expr) -> Vec<String> {
    let mut lines: Vec<Vec<(bool, Expr)>> = vec![vec![]];
    let mut width = 0;
    for term in terms(formula) {
        let size = term.1.to_string().len() + 3;
        if width > 0 && width + size > WIDTH {
            lines.push(vec![]);
            width = 0;
        }
        width += size;
        if let Some(line) = lines.last_mut() {
            line.push(term);
        }
    }
    lines.iter().enumerate().map(|(k, line)| written(line, k > 0)).collect()
}

/// Terms in one line; a continued line shows the sign of its first term.
fn written(terms: &[(bool, Expr)], continued: bool) -> String {
    let mut rest = terms.iter();
    let Some((negative, first)) = rest.next() else { return String::new() };
    let start = if *negative && !continued { -first } else { first.clone() };
    let sum = rest.fold(start, |sum, (negative, term)| if *negative { &sum - term } else { &sum + term });
    match (continued, negative) {
        (false, _) => sum.latex(),
        (true, true) => format!("{{}} - {}", sum.latex()),
        (true, false) => format!("{{}} + {}", sum.latex()),
    }
}

/// The terms of a sum, each with whether it is subtracted.
fn terms(e: &Expr) -> Vec<(bool, Expr)> {
    match e.node() {
        Node::Add(a, b) => [terms(a), vec![(false, b.clone())]].concat(),
        Node::Sub(a, b) => [terms(a), vec![(true, b.clone())]].concat(),
        Node::Neg(x) if !matches!(x.node(), Node::Add(..) | Node::Sub(..)) => vec![(true, x.clone())],
        _ => vec![(false, e.clone())],
    }
}
