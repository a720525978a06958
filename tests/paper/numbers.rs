//! Numbers by name.

use super::ledger::{LEDGER, count, entry, said};
use super::markup::{head, string};
use super::robots;
use super::tables::found;
use super::trust;
use creepage::claims::kernel::proofs_of;
use creepage::claims::{Outcome, Status};
use creepage::energy_rule::{FIG7_DURATION, Reading, fig7_case};
use creepage::figures::{fixed, readings};
use creepage::formula::Expr;
use creepage::number_format::with_error;
use creepage::{effects, vehicles};
use std::fmt::Write;

pub fn file() -> String {
    let mut out = head() + "#let n = (\n";
    for (name, value) in all() {
        let _ = writeln!(out, "  {name}: {},", string(&value));
    }
    out + ")\n"
}

fn all() -> Vec<(&'static str, String)> {
    let mut all = of_the_ledger();
    all.extend(of_the_simulation());
    all.extend(of_the_example());
    all.extend(trust::numbers());
    all.extend(robots::numbers());
    all
}

fn of_the_ledger() -> Vec<(&'static str, String)> {
    let (noticed, sabotages) = LEDGER.kills();
    let equations = LEDGER.entries.iter().flat_map(|e| &e.claim.equations).max().unwrap();
    let Outcome::Fails(six) = &entry("theorem-single-body").shown[0].outcome else { panic!("the theorem stands") };
    vec![
        ("claims", LEDGER.entries.len().to_string()),
        ("proved", count(Status::Proved).to_string()),
        ("sampled", count(Status::Sampled).to_string()),
        ("corrected", count(Status::Corrected).to_string()),
        ("refuted", count(Status::Refuted).to_string()),
        ("editorial", count(Status::Editorial).to_string()),
        ("open", count(Status::Open).to_string()),
        ("false-as-printed", LEDGER.corrections().by_kind[0].to_string()),
        ("lacking", LEDGER.corrections().by_kind[1].to_string()),
        ("contested", LEDGER.corrections().by_kind[2].to_string()),
        ("statements", LEDGER.corrections().statements.to_string()),
        ("theorems", accepted().0.to_string()),
        ("in-kernel", accepted().1.to_string()),
        ("cases", LEDGER.options.cases.to_string()),
        ("sabotages", sabotages.to_string()),
        ("noticed", noticed.to_string()),
        ("equations", equations.to_string()),
        ("six", six.values.len().to_string()),
        ("right-wheel", said("E18", "right").unwrap()),
        ("left-wheel", said("E18", "left_wheel").unwrap()),
        ("skid-coordinates", said("E20", "skid_steer.coordinates").unwrap()),
        ("skid-holonomic", said("E20", "skid_steer.holonomic").unwrap()),
        ("perpendicular", said("jean-degree", "perpendicular_3.degree").unwrap()),
        ("effects", effects::all().len().to_string()),
        ("vehicles", vehicles::all().len().to_string()),
    ]
}

/// Theorems that another kernel has accepted, and of how many claims.
fn accepted() -> (usize, usize) {
    proofs_of(&LEDGER).count_accepted()
}

fn of_the_simulation() -> Vec<(&'static str, String)> {
    let energy = Expr::parse(&said("E23", "energy").unwrap()).unwrap();
    let at = |t: f64| fixed(energy.eval(&|_| t).unwrap(), 3);
    let judged = readings::table().unwrap();
    let ratio = |r: Reading| fixed(judged.ratios[Reading::ALL.iter().position(|s| *s == r).unwrap()], 3);
    let ideal = fig7_case(0.0, 0.0, Reading::NonConservative).unwrap();
    // The text says of reading A that only one sentence fails under it.
    let a = Reading::ALL.iter().position(|r| *r == Reading::A).unwrap();
    let failing: Vec<&str> = judged.sentences.iter().filter(|s| !s.2[a]).map(|s| s.0).collect();
    assert_eq!(failing, ["S4b"]);
    let other = |r: &&Reading| **r != Reading::NonConservative;
    vec![
        ("duration", fixed(FIG7_DURATION, 3)),
        ("ideal-y", fixed(ideal.y, 4)),
        ("energy-start", at(0.0)),
        ("energy-end", at(FIG7_DURATION)),
        ("readings", Reading::ALL.iter().filter(other).count().to_string()),
        ("sentences", judged.sentences.len().to_string()),
        ("ratio-none", ratio(Reading::NonConservative)),
        ("ratio-A", ratio(Reading::A)),
        ("ratio-C1", ratio(Reading::C1)),
        ("reversing", Reading::C1.name().into()),
    ]
}

/// The bundled run with a hidden effect.
fn of_the_example() -> Vec<(&'static str, String)> {
    let report = &found().report;
    let answer = include_str!("../../examples/runs/cornering/answer.json");
    let answer: serde_json::Value = serde_json::from_str(answer).unwrap();
    let [effect] = &report.effects[..] else { panic!("{:?}", report.effects) };
    assert_eq!(answer["effects"][0]["id"], effect.id.as_str());
    let (name, estimate) = effect.parameters.iter().next().unwrap();
    let gap = report.gap.iter().find(|g| g.horizon_s == 5.0).unwrap();
    let held_out = gap.held_out.unwrap();
    let mm = |metres: f64| fixed(1e3 * metres, 1);
    vec![
        ("example-effect", effect.id.clone()),
        ("example-truth", answer["effects"][0]["parameters"][name.as_str()].to_string()),
        ("example-value", with_error(estimate.value, estimate.std)),
        ("example-unit", estimate.unit.clone()),
        ("example-horizon", fixed(gap.horizon_s, 0)),
        ("example-before", mm(held_out.position_rms_before)),
        ("example-after", mm(held_out.position_rms_after)),
        ("example-floor", mm(gap.noise_floor.position_rms)),
        ("example-rows", report.data.rows.to_string()),
    ]
}
