//! A description as a LaTeX document.

use super::structure::Line;
use super::{ConstraintEntry, Description, EffectInModel, Signature, Symbols, terms};
use crate::formula::{Expr, Symbol, latex_symbol};
use std::fmt::Write;

const HEAD: &str = r"\documentclass[a4paper,10pt]{article}
\usepackage[T1]{fontenc}
\usepackage{amsmath}
\usepackage{longtable}
\allowdisplaybreaks
\setlength{\parindent}{0pt}
\addtolength{\textwidth}{8em}
\addtolength{\oddsidemargin}{-4em}
\begin{document}
";

/// The description as a LaTeX document that needs only `amsmath` and `longtable`.
///
/// ```
/// let wheel = creepage::Model::new("unicycle", &[("wheel_radius", 0.5)])?;
/// assert!(creepage::describe::latex(&creepage::describe(&wheel)?).contains("\\dot"));
/// # Ok::<(), creepage::Error>(())
/// ```
pub fn latex(d: &Description) -> String {
    let mut out = String::from(HEAD);
    overview(&mut out, d);
    symbols(&mut out, d);
    let _ = writeln!(out, "\\section{{Constraints}}\nEvery row times the rates of the coordinates is zero.");
    d.constraints.iter().for_each(|c| constraint(&mut out, &d.symbols, c));
    if let Some(derivatives) = &d.derivatives {
        derivatives.latex(&mut out, &|s| d.symbols.latex_symbol(s));
    }
    pfaffian(&mut out, d);
    structure(&mut out, d);
    motion(&mut out, d);
    if !d.effects.is_empty() {
        let _ = writeln!(out, "\\section{{Effects in the model}}\nIn a change, ``it'' is the definition as it was.");
        d.effects.iter().for_each(|e| effect(&mut out, &d.symbols, e));
    }
    out + "\\end{document}\n"
}

fn overview(out: &mut String, d: &Description) {
    let names: Vec<String> = d.coordinates.iter().map(|q| d.symbols.latex_symbol(q)).collect();
    let _ = writeln!(out, "\\title{{{}}}\n\\date{{}}\n\\maketitle", plain(&super::text::title(d)));
    let _ = writeln!(out, "{}.\n", plain(&d.title));
    let _ = writeln!(out, "Coordinates: ${}$.\n", names.join(",\\, "));
    let _ = writeln!(out, "Constraints by form: ${}$ ({}).", d.signature.latex(), plain(Signature::COUNTS));
}

fn symbols(out: &mut String, d: &Description) {
    let _ = writeln!(out, "\\section{{Symbols}}\n\\begin{{longtable}}{{lllrp{{7cm}}}}");
    let _ = writeln!(out, "symbol & unit & kind & value & meaning \\\\\n\\hline\n\\endhead");
    for e in d.symbols.entries() {
        let value = e.value.map_or(String::new(), |v| format!("${v}$"));
        let cells = [format!("${}$", e.latex), unit(&e.unit), e.kind.name().into(), value, plain(&e.meaning)];
        let _ = writeln!(out, "{} \\\\", cells.join(" & "));
    }
    let _ = writeln!(out, "\\end{{longtable}}");
}

fn constraint(out: &mut String, s: &Symbols, c: &ConstraintEntry) {
    let generic = c.kind.in_latex();
    let _ = writeln!(out, "\\subsection{{{}}}", plain(&c.name));
    let creep = s.latex_symbol(&c.creep);
    let _ = writeln!(out, "Type {}, ${generic}$; coefficient ${creep}${}.", c.kind.letter, plain(&c.source()));
    let mut parts = Display::new(s);
    c.parts.iter().for_each(|p| parts.equation(&p.latex, &p.formula));
    parts.write(out);
    let _ = match (&c.kind.singular, c.has_sigma()) {
        (Some(s), _) => {
            writeln!(out, "$\\sigma$ is undefined where ${} = 0$; the row is regular there.", latex_symbol(s))
        }
        (None, true) => writeln!(out, "$\\sigma$ is defined everywhere."),
        (None, false) => Ok(()),
    };
    for (label, row) in c.told_rows() {
        let _ = writeln!(out, "{label}:");
        let mut display = Display::new(s);
        display.vanishing(&row);
        display.write(out);
    }
    if let Some(force) = &c.held_by {
        let _ = writeln!(
            out,
            "In the model as it stands a force holds it in place of the row: ${}$.",
            s.latex_symbol(force)
        );
    }
    if c.coefficient.is_told() {
        let value = c.coefficient.value.map_or(String::new(), |v| format!(" = {v}"));
        let _ = writeln!(out, "Coefficient in the model as it stands: ${creep}{value}$, {}.", c.coefficient.words());
    }
    let _ = writeln!(out, "Derivatives of $g$, the row times the rates, that are not zero everywhere:");
    let mut display = Display::new(s);
    let by = |name: String| format!("\\frac{{\\partial g}}{{\\partial {name}}}");
    c.jacobian.q.iter().for_each(|(q, d)| display.equation(&by(s.latex_symbol(q)), &d.expr()));
    c.jacobian.rates.iter().for_each(|(rate, d)| display.equation(&by(s.latex_symbol(rate)), d));
    display.equation(&by(creep), &c.jacobian.e.expr());
    display.write(out);
}

fn pfaffian(out: &mut String, d: &Description) {
    let _ = writeln!(out, "\\section{{Pfaffian matrix}}\n$A(q)\\,\\dot{{q}} = 0$; entries that are not zero:");
    let mut display = Display::new(&d.symbols);
    for (i, row) in d.pfaffian.iter().enumerate() {
        for (q, entry) in d.coordinates.iter().zip(row).filter(|(_, e)| !e.is_zero()) {
            display.equation(&format!("A_{{{},{}}}", i + 1, d.symbols.latex_symbol(q)), entry);
        }
    }
    display.write(out);
}

fn structure(out: &mut String, d: &Description) {
    let _ = writeln!(out, "\\section{{Holonomic and nonholonomic part}}\n{}\n", plain(&d.structure.reading()));
    lines(out, &d.symbols, &d.structure.holonomy_lines());
    let _ = writeln!(out, "\\subsection{{RT signature by ranks}}");
    lines(out, &d.symbols, &d.structure.realisation_lines());
}

/// Paragraphs, with neighbouring formulas in one display.
fn lines(out: &mut String, s: &Symbols, lines: &[Line]) {
    let list = |names: &[Symbol]| names.iter().map(|n| s.latex_symbol(n)).collect::<Vec<_>>().join(",\\, ");
    let mut display = Display::new(s);
    for line in lines {
        if !matches!(line, Line::Formula(..)) {
            display.write(out);
            display.lines.clear();
        }
        let _ = match line {
            Line::Words(words) => writeln!(out, "{}\n", plain(words)),
            Line::Names(label, names) if names.is_empty() => writeln!(out, "{}: none\n", plain(label)),
            Line::Names(label, names) => writeln!(out, "{}: ${}$\n", plain(label), list(names)),
            Line::Sets(label, sets) => {
                let sets: Vec<String> = sets.iter().map(|set| format!(r"$\{{{}\}}$", list(set))).collect();
                writeln!(out, "{}: {}\n", plain(label), sets.join(", "))
            }
            Line::Signature(label, signature) => writeln!(out, "{}: ${}$\n", plain(label), signature.latex()),
            Line::Formula(name, formula) => {
                display.equation(&s.latex_symbol(name), formula);
                Ok(())
            }
        };
    }
    display.write(out);
}

fn motion(out: &mut String, d: &Description) {
    let _ = writeln!(out, "\\section{{Equations of motion}}");
    if let Some(why) = &d.undetermined {
        let _ = writeln!(out, "None: {}.\n\nWhat stands in the rows:", plain(&why.to_string()));
    }
    if !d.speeds.is_empty() {
        let _ = writeln!(out, "Under forces, in the speeds that ideal contacts leave free (Kane's method).");
    }
    let mut display = Display::new(&d.symbols);
    d.definitions.iter().for_each(|e| display.equation(&d.symbols.latex_symbol(&e.name), &e.formula));
    display.write(out);
    if !d.states.is_empty() {
        let _ = writeln!(out, "Rates of states that no sensor sees:");
        let mut display = Display::new(&d.symbols);
        d.states
            .iter()
            .for_each(|e| display.equation(&format!("\\dot{{{}}}", d.symbols.latex_symbol(&e.name)), &e.formula));
        display.write(out);
    }
    if !d.beside_rows.is_empty() {
        let names: Vec<String> = d.beside_rows.iter().map(|s| d.symbols.latex_symbol(s)).collect();
        let _ = writeln!(out, "Effects act on these beside the rows: ${}$.", names.join(",\\, "));
    }
}

fn effect(out: &mut String, s: &Symbols, e: &EffectInModel) {
    let effect = &e.applied.effect;
    let _ = writeln!(out, "\\subsection{{{}}}", plain(&e.applied.label()));
    let _ = writeln!(out, "{}; acts on the {}.", plain(&effect.says), plain(&effect.place));
    for (symbol, (p, value)) in e.applied.parameters().iter().zip(effect.parameters.values().zip(&e.applied.values)) {
        let _ = writeln!(out, "$ {} = {value} $ {}", s.latex_symbol(symbol), unit(&p.unit));
    }
    let mut display = Display::new(s);
    e.changes.iter().for_each(|c| display.equation(&s.latex_symbol(&c.name), &c.formula));
    display.write(out);
}

/// Equations under one another.
struct Display<'s> {
    symbols: &'s Symbols,
    lines: Vec<String>,
}

impl<'s> Display<'s> {
    fn new(symbols: &'s Symbols) -> Self {
        Self { symbols, lines: vec![] }
    }

    /// name = formula
    fn equation(&mut self, name: &str, formula: &Expr) {
        let lines = terms::lines(&self.symbols.distinct(formula));
        let first = lines.first().map(|l| format!("{name} &= {l}"));
        self.lines.extend(first.into_iter().chain(lines.iter().skip(1).map(|l| format!("&\\quad {l}"))));
    }

    /// formula = 0
    fn vanishing(&mut self, formula: &Expr) {
        let lines = terms::lines(&self.symbols.distinct(formula));
        self.lines.extend(lines.iter().map(|l| format!("& {l}")));
        if let Some(last) = self.lines.last_mut() {
            last.push_str(" = 0");
        }
    }

    fn write(&self, out: &mut String) {
        if !self.lines.is_empty() {
            let _ = writeln!(out, "\\begin{{align*}}\n{}\n\\end{{align*}}", self.lines.join(" \\\\\n"));
        }
    }
}

/// A unit; 1 is left out.
fn unit(text: &str) -> String {
    if text == "1" { String::new() } else { format!("$\\mathrm{{{}}}$", text.replace('*', r"\,")) }
}

/// Words in LaTeX's text mode.
fn plain(text: &str) -> String {
    let escaped = text.chars().map(|c| match c {
        '_' | '%' | '&' | '#' | '$' | '{' | '}' => format!("\\{c}"),
        '^' | '~' => format!("\\{c}{{}}"),
        '\\' => r"\textbackslash{}".into(),
        c => c.to_string(),
    });
    escaped.collect()
}
