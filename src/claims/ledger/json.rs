//! The ledger of claims as JSON, for scripts.

use crate::claims::kernel::{Proofs, kernel, proofs_of};
use crate::claims::{Claim, Correction, Entry, Evidence, Ledger, Outcome, Status};
use serde_json::{Map, Value, json};

/// Every claim with the status it earned, its evidence and the counts.
pub fn json(ledger: &Ledger) -> Value {
    let (killed, all) = ledger.kills();
    let of = |s: &Status| ledger.entries.iter().filter(|e| e.earned == *s).count();
    let counts: Map<String, Value> = Status::ALL.iter().map(|s| (s.name().into(), of(s).into())).collect();
    let proofs = proofs_of(ledger);
    let (theorems, claims) = proofs.count_accepted();
    json!({
        "schema": 1,
        "all_earned": ledger.all_earned(),
        "claims": ledger.entries.iter().map(|e| entry(e, &proofs)).collect::<Vec<_>>(),
        "counts": counts,
        "sabotages": { "noticed": killed, "all": all },
        "kernel": { "name": kernel(), "theorems": theorems, "claims": claims },
        "corrections": corrections(ledger),
        "cases": ledger.cases(),
        "options": { "cases": ledger.options.cases, "seed": ledger.options.seed },
    })
}

/// Corrected claims by kind, and the statements that they are of.
fn corrections(ledger: &Ledger) -> Value {
    let found = ledger.corrections();
    let kinds: Map<String, Value> =
        Correction::ALL.iter().zip(found.by_kind).map(|(k, n)| (k.name().into(), n.into())).collect();
    json!({ "kinds": kinds, "statements": found.statements })
}

/// What a claim says, without what it earned.
pub(crate) fn claim(c: &Claim) -> Value {
    json!({
        "id": c.id, "says": c.says, "place": c.place, "equations": c.equations, "hypotheses": c.hypotheses,
        "remark": c.remark, "stated": c.stated.name(), "correction": c.correction.map(Correction::name),
        "part_of": (!c.part_of.is_empty()).then_some(&c.part_of), "evidence": c.evidence.iter().map(evidence).collect::<Vec<_>>(),
        "code": c.code, "tests": c.tests, "chapter": c.chapter,
    })
}

fn evidence(e: &Evidence) -> Value {
    json!({ "gives": e.gives.name(), "shows": e.shows, "statement": e.statements(str::to_string) })
}

fn entry(e: &Entry, proofs: &Proofs) -> Value {
    let mut value = claim(&e.claim);
    value["earned"] = e.earned.name().into();
    value["is_earned"] = e.is_earned().into();
    let accepted = proofs.accepted(&e.claim.id).map_or(0, |file| file.theorems);
    value["theorems"] = json!({ "accepted": accepted });
    for (i, s) in e.shown.iter().enumerate() {
        let evidence = &mut value["evidence"][i];
        evidence["as_stated"] = s.as_stated.into();
        evidence["outcome"] = outcome(&s.outcome);
        let noticed = s.sabotages - s.survivors.len();
        evidence["sabotages"] = json!({ "noticed": noticed, "all": s.sabotages, "survivors": s.survivors });
    }
    value
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
