//! A description as text for a terminal.

use super::page::Page;
use super::structure::Line;
use super::{ConstraintEntry, Description, Equation, Signature};
use crate::formula::Symbol;

/// The description as text that is Markdown too; every formula in it reads back with `Expr::parse`.
///
/// ```
/// let wheel = creepage::Model::new("unicycle", &[("wheel_radius", 0.5)])?;
/// assert!(creepage::describe::text(&creepage::describe(&wheel)?).contains("cos(phi)*x' + sin(phi)*y'"));
/// # Ok::<(), creepage::Error>(())
/// ```
pub fn text(d: &Description) -> String {
    let mut page = Page::default();
    overview(&mut page, d);
    symbols(&mut page, d);
    page.heading(2, "Constraints");
    page.paragraph(
        "Every row times the rates of the coordinates is zero. A derivative of g, the row times the rates, that is \
         not listed is zero everywhere.",
    );
    d.constraints.iter().enumerate().for_each(|(i, c)| constraint(&mut page, i + 1, c));
    if let Some(derivatives) = &d.derivatives {
        derivatives.text(&mut page);
    }
    pfaffian(&mut page, d);
    structure(&mut page, d);
    motion(&mut page, d);
    effects(&mut page, d);
    page.finished()
}

fn overview(page: &mut Page, d: &Description) {
    page.heading(1, &title(d));
    page.paragraph(&d.title);
    let names: Vec<String> = d.coordinates.iter().map(ToString::to_string).collect();
    // Angles that a driver sets are inputs of the motion and coordinates of the space that steering moves through.
    let steered = d.structure.coordinates.iter().filter(|q| !d.coordinates.contains(q));
    let steered: Vec<String> = steered.map(ToString::to_string).collect();
    let also = if steered.is_empty() {
        String::new()
    } else {
        format!("; for the growth vector {} as well", steered.join(", "))
    };
    page.entry(&format!("coordinates: {}{also}", names.join(", ")));
    page.entry(&format!("constraints by form: {} ({})", d.signature, Signature::COUNTS));
    if !d.speeds.is_empty() {
        let listed = |of: &[Symbol]| of.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let by = if d.inputs.is_empty() { "nothing".into() } else { listed(&d.inputs) };
        page.entry(&format!("moved by forces; inputs: {by}; speeds that forces change: {}", listed(&d.speeds)));
    }
    let effects: Vec<String> = d.effects.iter().map(|e| e.applied.label()).collect();
    page.entry(&format!("effects: {}", if effects.is_empty() { "none".into() } else { effects.join(", ") }));
}

/// The vehicle with its trailers.
pub(super) fn title(d: &Description) -> String {
    match d.trailers {
        0 => d.vehicle.clone(),
        1 => format!("{} with 1 trailer", d.vehicle),
        n => format!("{} with {n} trailers", d.vehicle),
    }
}

fn symbols(page: &mut Page, d: &Description) {
    page.heading(2, "Symbols");
    let row = |e: &super::SymbolEntry| {
        let value = e.value.map_or(String::new(), |v| v.to_string());
        vec![e.symbol.to_string(), e.unit.clone(), e.kind.name().into(), value, e.meaning.clone()]
    };
    let rows: Vec<_> = d.symbols.entries().iter().map(row).collect();
    page.table(&["symbol", "unit", "kind", "value", "meaning"], &rows);
}

fn constraint(page: &mut Page, number: usize, c: &ConstraintEntry) {
    page.heading(3, &format!("{number}. {}", c.name));
    page.line(&format!("Type {}, {}; coefficient {}{}. Put in:", c.kind.letter, c.kind.text(), c.creep, c.source()));
    c.parts.iter().for_each(|p| page.formula(&format!("{} = {}", p.label, p.formula)));
    page.formula(&format!("{} = 0", c.generic));
    match (&c.kind.singular, c.has_sigma()) {
        (Some(s), _) => page.line(&format!("sigma is undefined where {s} = 0; the row is regular there.")),
        (None, true) => page.line("sigma is defined everywhere."),
        (None, false) => {}
    }
    for (label, row) in c.told_rows() {
        page.line(&format!("{label}:"));
        page.formula(&format!("{row} = 0"));
    }
    if let Some(force) = &c.held_by {
        page.line(&format!("In the model as it stands a force holds it in place of the row: {force}."));
    }
    if c.coefficient.is_told() {
        page.line("Coefficient in the model as it stands:");
        page.line(&told(c));
    }
    page.line("Derivatives of g:");
    c.jacobian.q.iter().for_each(|(q, d)| page.formula(&format!("dg/d({q}) = {d}")));
    c.jacobian.rates.iter().for_each(|(rate, d)| page.formula(&format!("dg/d({rate}) = {d}")));
    page.formula(&format!("dg/d({}) = {}", c.creep, c.jacobian.e));
}

/// e = value: regime
fn told(c: &ConstraintEntry) -> String {
    let value = c.coefficient.value.map_or(String::new(), |v| format!(" = {v}"));
    format!("{}{value}: {}.", c.creep, c.coefficient.words())
}

fn pfaffian(page: &mut Page, d: &Description) {
    page.heading(2, "Pfaffian matrix");
    let names: Vec<String> = d.coordinates.iter().map(|q| q.rate().to_string()).collect();
    page.line(&format!("A(q), one row for each constraint; columns {}:", names.join(", ")));
    for row in &d.pfaffian {
        let entries: Vec<String> = row.iter().map(ToString::to_string).collect();
        page.formula(&format!("[{}]", entries.join(", ")));
    }
    page.gap();
}

fn structure(page: &mut Page, d: &Description) {
    page.heading(2, "Holonomic and nonholonomic part");
    page.paragraph(&d.structure.reading());
    d.structure.holonomy_lines().iter().for_each(|l| line(page, l));
    page.heading(3, "RT signature by ranks");
    d.structure.realisation_lines().iter().for_each(|l| line(page, l));
    page.gap();
}

fn line(page: &mut Page, line: &Line) {
    let list = |names: &[Symbol]| match names {
        [] => "none".to_string(),
        _ => names.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
    };
    match line {
        Line::Words(words) => page.entry(words),
        Line::Names(label, names) => page.entry(&format!("{label}: {}", list(names))),
        Line::Sets(label, sets) => {
            let sets: Vec<String> = sets.iter().map(|s| format!("{{{}}}", list(s))).collect();
            page.entry(&format!("{label}: {}", sets.join(", ")));
        }
        Line::Signature(label, signature) => page.entry(&format!("{label}: {signature}")),
        Line::Formula(name, formula) => page.formula(&format!("{name} = {formula}")),
    }
}

fn motion(page: &mut Page, d: &Description) {
    page.heading(2, "Equations of motion");
    match &d.undetermined {
        None => {
            if !d.speeds.is_empty() {
                page.line("Under forces, in the speeds that ideal contacts leave free (Kane's method):");
            }
            page.line("Each uses only earlier ones, states, inputs and parameters.");
        }
        Some(why) => {
            page.paragraph(&format!("None: {why}."));
            page.line("What stands in the rows:");
        }
    }
    let equation = |page: &mut Page, e: &Equation| page.formula(&format!("{} = {}", e.name, e.formula));
    d.definitions.iter().for_each(|e| equation(page, e));
    if !d.states.is_empty() {
        page.line("Rates of states that no sensor sees:");
        d.states.iter().for_each(|e| page.formula(&format!("{} = {}", e.name.rate(), e.formula)));
    }
    if !d.beside_rows.is_empty() {
        let names: Vec<String> = d.beside_rows.iter().map(ToString::to_string).collect();
        page.gap();
        page.paragraph(&format!("Effects act on these beside the rows: {}.", names.join(", ")));
    }
    page.gap();
}

fn effects(page: &mut Page, d: &Description) {
    if d.effects.is_empty() {
        return;
    }
    page.heading(2, "Effects in the model");
    page.paragraph("In a change, `it` is the definition as it was.");
    for e in &d.effects {
        let effect = &e.applied.effect;
        page.heading(3, &e.applied.label());
        page.line(&format!("{}; acts on the {}; source: {}.", effect.says, effect.place, effect.source));
        for (symbol, (p, value)) in e.applied.parameters().iter().zip(effect.parameters.values().zip(&e.applied.values))
        {
            page.entry(&format!("{symbol}: {value} {}", if p.unit == "1" { "" } else { &p.unit }));
        }
        e.changes.iter().for_each(|c| page.formula(&format!("{} = {}", c.name, c.formula)));
    }
}
