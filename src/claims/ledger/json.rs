//! The ledger for scripts.

use super::super::{Entry, Evidence, Ledger, Outcome, Shown, Status};
use serde_json::{Map, Value, json};

/// Every claim with the status it earned, its evidence and the counts.
pub fn json(ledger: &Ledger) -> Value {
    let (killed, all) = ledger.kills();
    let of = |s: &Status| ledger.entries.iter().filter(|e| e.earned == *s).count();
    let counts: Map<String, Value> = Status::ALL.iter().map(|s| (s.name().into(), of(s).into())).collect();
    json!({
        "schema": 1,
        "all_earned": ledger.all_earned(),
        "claims": ledger.entries.iter().map(entry).collect::<Vec<_>>(),
        "counts": counts,
        "sabotages": { "noticed": killed, "all": all },
        "cases": ledger.cases(),
        "options": { "cases": ledger.options.cases, "seed": ledger.options.seed },
    })
}

fn entry(e: &Entry) -> Value {
    let c = &e.claim;
    json!({
        "id": c.id, "says": c.says, "place": c.place, "equations": c.equations, "hypotheses": c.hypotheses,
        "remark": c.remark, "stated": c.stated.name(), "earned": e.earned.name(), "is_earned": e.is_earned(),
        "evidence": c.evidence.iter().zip(&e.shown).map(|(e, s)| evidence(e, s)).collect::<Vec<_>>(),
        "code": c.code, "tests": c.tests, "chapter": c.chapter,
    })
}

fn evidence(e: &Evidence, s: &Shown) -> Value {
    let statement: Vec<String> = e.equations.iter().map(|(l, r)| format!("{l} = {r}")).collect();
    json!({
        "gives": e.gives.name(), "shows": e.shows, "statement": statement, "as_stated": s.as_stated,
        "outcome": outcome(&s.outcome),
        "sabotages": { "noticed": s.sabotages - s.survivors.len(), "all": s.sabotages, "survivors": s.survivors },
    })
}

fn outcome(o: &Outcome) -> Value {
    match o {
        Outcome::Holds { cases } => json!({ "holds": true, "cases": cases }),
        Outcome::Fails(c) => {
            let values: Map<String, Value> = c.values.iter().map(|(k, v)| (k.clone(), v.clone().into())).collect();
            json!({ "holds": false, "counterexample": { "values": values, "says": c.says } })
        }
        Outcome::Undefined(why) => json!({ "holds": null, "why": why }),
    }
}
