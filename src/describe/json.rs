//! A description as JSON: each formula in text and in LaTeX.

use super::{
    ConstraintEntry, Description, EffectInModel, Equation, Holonomy, Realised, Signature, Structure, SymbolEntry,
    Symbols,
};
use crate::formula::{Expr, Symbol};
use crate::mechanism::Row;
use serde_json::{Map, Value, json as object};

/// The description as JSON.
///
/// ```
/// let wheel = creepage::Model::new("unicycle", &[("wheel_radius", 0.5)])?;
/// assert_eq!(creepage::describe::json(&creepage::describe(&wheel)?)["schema"], 1);
/// # Ok::<(), creepage::Error>(())
/// ```
pub fn json(d: &Description) -> Value {
    let mut found = whole(d);
    if let (Some(at), Some(entries)) = (&d.derivatives, found.as_object_mut()) {
        entries.insert("derivatives_at".into(), at.json());
    }
    if let (false, Some(entries)) = (d.speeds.is_empty(), found.as_object_mut()) {
        entries.insert("speeds".into(), names(&d.speeds).into());
    }
    found
}

fn whole(d: &Description) -> Value {
    let s = &d.symbols;
    object!({
        "schema": 1,
        "vehicle": d.id(),
        "tractor": if d.trailers > 0 { Some(&d.vehicle) } else { None },
        "title": d.title,
        "trailers": d.trailers,
        "coordinates": names(&d.coordinates),
        "symbols": s.entries().iter().map(symbol).collect::<Vec<_>>(),
        "constraints": d.constraints.iter().map(|c| constraint(s, c)).collect::<Vec<_>>(),
        "pfaffian": {
            "columns": names(&d.coordinates.iter().map(Symbol::rate).collect::<Vec<_>>()),
            "rows": d.pfaffian.iter().map(|r| r.iter().map(|e| formula(s, e)).collect()).collect::<Vec<Vec<Value>>>(),
        },
        "constraints_by_form": counted(&d.signature, &[
            ("text", d.signature.to_string()), ("latex", d.signature.latex()), ("counts", Signature::COUNTS.into()),
        ]),
        "structure": structure(s, &d.structure),
        "undetermined": d.undetermined.as_ref().map(ToString::to_string),
        "definitions": d.definitions.iter().map(|e| equation(s, e, &e.name)).collect::<Vec<_>>(),
        "states": d.states.iter().map(|e| equation(s, e, &e.name.rate())).collect::<Vec<_>>(),
        "beside_rows": names(&d.beside_rows),
        "effects": d.effects.iter().map(|e| effect(s, e)).collect::<Vec<_>>(),
    })
}

/// The numbers of a signature by letter, r and t always, with more entries.
pub(super) fn counted(signature: &Signature, more: &[(&str, String)]) -> Value {
    let letter = |l: char| (l.to_lowercase().to_string(), signature.count(l).into());
    let others = signature.counts.iter().map(|(l, _)| *l).filter(|l| !['R', 'T'].contains(l));
    let counts = ['R', 'T'].into_iter().chain(others).map(letter);
    let more = more.iter().map(|(name, text)| ((*name).to_string(), text.clone().into()));
    Value::Object(counts.chain(more).collect())
}

fn names(symbols: &[Symbol]) -> Vec<&str> {
    symbols.iter().map(Symbol::as_str).collect()
}

fn symbol(e: &SymbolEntry) -> Value {
    object!({
        "symbol": e.symbol.as_str(), "latex": e.latex, "unit": e.unit, "meaning": e.meaning, "kind": e.kind.name(),
        "value": e.value,
    })
}

fn formula(s: &Symbols, e: &Expr) -> Value {
    object!({ "text": e.to_string(), "latex": s.latex(e) })
}

/// row = 0
fn row(s: &Symbols, r: &Row) -> Value {
    formula(s, &r.expr())
}

fn equation(s: &Symbols, e: &Equation, name: &Symbol) -> Value {
    object!({ "name": name.as_str(), "name_latex": s.latex_symbol(name), "formula": formula(s, &e.formula) })
}

fn constraint(s: &Symbols, c: &ConstraintEntry) -> Value {
    let parts: Map<String, Value> = c.parts.iter().map(|p| (p.label.clone(), formula(s, &p.formula))).collect();
    let by_q: Map<String, Value> = c.jacobian.q.iter().map(|(q, d)| (q.to_string(), row(s, d))).collect();
    let by_rate: Map<String, Value> = c.jacobian.rates.iter().map(|(q, d)| (q.to_string(), formula(s, d))).collect();
    let mut found = object!({
        "name": c.name,
        "form": c.kind.letter.to_string(),
        "creep": c.creep.as_str(),
        "source": c.kind.source,
        "generic": {
            "text": c.kind.text(), "latex": c.kind.in_latex(), "parts": parts, "together": formula(s, &c.generic),
            "sigma_undefined_where_zero": c.singular.as_ref().map(|e| formula(s, e)),
        },
        "row": row(s, &c.row),
        "ideal_row": row(s, &c.ideal),
        "model_row": if c.held_by.is_none() { Some(formula(s, &c.model)) } else { None },
        "coefficient": coefficient(c),
        "jacobian": { "q": by_q, "q_dot": by_rate, "e": row(s, &c.jacobian.e) },
    });
    if let (Some(force), Some(entries)) = (&c.held_by, found.as_object_mut()) {
        entries.insert("held_by".into(), force.as_str().into());
    }
    found
}

/// Null where nothing gives the coefficient and there are no limits to judge it by.
fn coefficient(c: &ConstraintEntry) -> Option<Value> {
    let e = &c.coefficient;
    let limits = e.limits.map(|l| [l.lower(), l.upper()]);
    e.is_told().then(|| {
        object!({
            "value": e.value, "regime": e.regime(), "landmark": e.landmark(), "limits": limits,
            "row_holds": e.row_holds, "words": e.words(),
        })
    })
}

fn structure(s: &Symbols, found: &Structure) -> Value {
    object!({
        "coordinates": names(&found.coordinates),
        "open_parameters": names(&found.open),
        "holonomy": found.holonomy.as_ref().map_or_else(|why| not_computed(why), |h| holonomy(s, h)),
        "realisation": found.realisation.as_ref().map_or_else(|why| not_computed(why), |r| realised(s, r)),
    })
}

fn not_computed(why: &str) -> Value {
    object!({ "not_computed": why })
}

fn holonomy(s: &Symbols, h: &Holonomy) -> Value {
    object!({
        "rank": h.rank, "holonomic": h.holonomic, "nonholonomic": h.nonholonomic,
        "growth_vector": h.growth, "degree_of_nonholonomy": h.degree,
        "integrals": h.integrals.iter().map(|i| formula(s, i)).collect::<Vec<_>>(),
    })
}

fn realised(s: &Symbols, r: &Realised) -> Value {
    let passive = |(e, f): &(Symbol, Option<Expr>)| object!({ "creep": e.as_str(), "formula": f.as_ref().map(|f| formula(s, f)) });
    object!({
        "measured": names(&r.measured), "unknown": names(&r.unknown),
        "signature": counted(&r.signature, &[("text", r.signature.to_string()), ("latex", r.signature.latex())]),
        "canonical": names(&r.canonical),
        "other_sets": r.others.iter().map(|set| names(set)).collect::<Vec<_>>(),
        "other_sets_found": r.other_count, "all_sets_found": r.is_complete,
        "passive": r.passive.iter().map(passive).collect::<Vec<_>>(),
    })
}

fn effect(s: &Symbols, e: &EffectInModel) -> Value {
    let effect = &e.applied.effect;
    let declared = effect.parameters.iter().zip(&e.applied.values).zip(e.applied.parameters());
    let parameters: Map<String, Value> = declared
        .map(|(((name, p), v), symbol)| {
            (name.clone(), object!({"value": v, "unit": p.unit, "symbol": symbol.as_str()}))
        })
        .collect();
    object!({
        "id": effect.id, "trailer": e.applied.trailer, "where": effect.place, "says": effect.says,
        "source": effect.source, "parameters": parameters,
        "changes": e.changes.iter().map(|c| equation(s, c, &c.name)).collect::<Vec<_>>(),
    })
}
