//! Typst markup.

use creepage::claims::Equation;
use creepage::formula::{Expr, Node, Symbol};

/// Head of a generated file.
pub fn head() -> String {
    format!("// Generated from the program; a test fails when it is stale. Made anew by: {}\n\n", super::AGAIN)
}

/// A string of Typst.
pub fn string(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// Names that the program must write in ASCII, and how the paper writes them.
const RENAMED: [(&str, &str); 11] = [
    ("vt_1", "v_t_1"),
    ("vt_2", "v_t_2"),
    ("v_1", "v_l_1"),
    ("v_2", "v_l_2"),
    ("i_s", "i"),
    ("x_by_phi", "x_phi"),
    ("miss_x", "Delta_x"),
    ("miss_y", "Delta_y"),
    ("e_there", "e_h_b"),
    ("apart_T", "D_T"),
    ("apart_R", "D_R"),
];

/// A formula as mathematics.
pub fn formula(e: &Expr) -> String {
    let other = |s: &Symbol| {
        let (stem, primes) = s.as_str().split_at(s.as_str().trim_end_matches('\'').len());
        RENAMED.iter().find(|(from, _)| *from == stem).map(|(_, to)| Expr::sym(format!("{to}{primes}").as_str()))
    };
    // Substitution simplifies, 3/50 to 0.06; a formula without such a name stays as it is.
    if e.symbols().iter().any(|s| other(s).is_some()) { e.substitute(&other).typst() } else { e.typst() }
}

/// Characters of markup that fill a line of a column.
const LINE: usize = 85;

/// A formula over several lines where it is long: its last terms on lines of their own.
fn broken(e: &Expr) -> String {
    let whole = formula(e);
    match e.node() {
        Node::Add(a, b) if whole.len() > LINE => format!("{} \\\n     &quad + {}", broken(a), formula(b)),
        Node::Sub(a, b) if whole.len() > LINE => format!("{} \\\n     &quad - {}", broken(a), formula(b)),
        _ => whole,
    }
}

/// Equations as one display, aligned at their signs.
pub fn display(equations: &[Equation]) -> String {
    let line = |e: &Equation| format!("{} &= {}", formula(&e.left), broken(&e.right));
    format!("$ {} $", equations.iter().map(line).collect::<Vec<_>>().join(" \\\n     "))
}

/// A row of a table from cells that are Typst expressions.
pub fn row(cells: &[String]) -> String {
    format!("  ({},),\n", cells.join(", "))
}

/// A list of rows under a name.
pub fn rows(name: &str, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let rows: String = rows.into_iter().map(|cells| row(&cells)).collect();
    format!("#let {name} = (\n{rows})\n\n")
}
