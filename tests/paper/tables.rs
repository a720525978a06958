//! Tables that are no claims.

use super::cornering;
use super::ledger::said;
use super::markup::{formula, head, rows, string};
use creepage::discrepancy::discovery::Discovery;
use creepage::effects::{self, Applied};
use creepage::energy_rule::{Reading, fig7_case};
use creepage::equivalence::{Measured, Relation, relation};
use creepage::figures::readings;
use creepage::formula::Expr;
use creepage::model::Model;
use creepage::number_format;
use creepage::number_format::decimals;
use std::sync::LazyLock;

pub fn file() -> String {
    head() + &holonomy() + &ends() + &sentences() + &relatives()
}

/// Vehicles of the claim on holonomic constraints; beside each what the original counts.
const COUNTED: [(&str, &str, &str); 5] = [
    ("differential_drive", "differential drive", "1"),
    ("differential_drive_castor", "the same with a castor", "3"),
    ("tricycle_with_rear_wheels", "tricycle", "3"),
    ("ackermann", "Ackermann car", "4"),
    ("skid_steer", "skid steering", "4"),
];

fn holonomy() -> String {
    let count = |vehicle: &str, what: &str| {
        let name = format!("{vehicle}.{what}");
        let claims = ["E19", "E20", "growth-table"];
        claims.iter().find_map(|id| said(id, &name)).unwrap_or_else(|| panic!("no claim counts {name}"))
    };
    let growth = |vehicle: &str| {
        let digits: Vec<String> = count(vehicle, "growth").chars().map(String::from).collect();
        format!("({})", digits.join(", "))
    };
    let row = |(id, name, printed): &(&str, &str, &str)| {
        let [holonomic, nonholonomic] = ["holonomic", "nonholonomic"].map(|what| count(id, what));
        [(*name).into(), (*printed).into(), holonomic, nonholonomic, growth(id)].map(|c: String| string(&c)).to_vec()
    };
    rows("holonomy", COUNTED.iter().map(row))
}

/// A number for a table, with a true minus.
fn number(x: f64, places: usize) -> String {
    string(&decimals(x, places))
}

fn ends() -> String {
    let row = |(name, e_rc, e_tc): &(&str, f64, f64)| {
        let [plain, kept] = [Reading::NonConservative, Reading::A].map(|r| fig7_case(*e_rc, *e_tc, r).unwrap());
        let coefficient = |e: f64| string(&number_format::plain(e));
        let mut cells = vec![string(&format!("({name})")), coefficient(*e_rc), coefficient(*e_tc)];
        cells.extend([plain.x, plain.y, kept.x, kept.y, kept.phi].map(|v| number(v, 4)));
        cells
    };
    rows("ends", readings::CASES.iter().map(row))
}

fn sentences() -> String {
    let judged = readings::table().unwrap();
    let name = |r: Reading| if r == Reading::NonConservative { "none" } else { r.name() };
    let names = Reading::ALL.iter().map(|r| string(&name(*r).replace("A_l", "Aₗ"))).collect();
    let marks = |holds: &[bool]| holds.iter().map(|h| if *h { "true".to_string() } else { "false".into() }).collect();
    let row = |(_, says, holds): &(&str, &str, Vec<bool>)| [vec![string(says)], marks(holds)].concat();
    let ratios = judged.ratios.iter().map(|r| number(*r, 2)).collect();
    rows("readings", [names]) + &rows("sentences", judged.sentences.iter().map(row)) + &rows("ratios", [ratios])
}

/// Pairs of effects that are the same, or to first order, on two vehicles.
fn relatives() -> String {
    let cars = [
        ("differential drive", Model::new("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.4)])),
        ("car", Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)])),
    ];
    let mut table = Vec::new();
    for (name, model) in cars {
        let model = model.unwrap();
        let applied = |(e, t): (&effects::Effect, Option<usize>)| Applied::new(e, t, e.starts().swap_remove(0)).freed();
        let all: Vec<Applied> = model.applicable(effects::all()).into_iter().map(applied).collect();
        for (i, a) in all.iter().enumerate() {
            for b in &all[i + 1..] {
                let one = std::slice::from_ref;
                let (word, change) = match relation(&model, one(a), one(b), Measured::ALL) {
                    Relation::Identical(change) => ("identical", change),
                    Relation::FirstOrder => ("first order", Default::default()),
                    _ => continue,
                };
                let change: Vec<String> = change
                    .iter()
                    .map(|(s, f)| format!("{} = {}", formula(&Expr::sym(s.clone())), formula(f)))
                    .collect();
                let change = if change.is_empty() { "[]".into() } else { format!("${}$", change.join(", ")) };
                table.push(vec![string(name), string(&a.label()), string(&b.label()), string(word), change]);
            }
        }
    }
    rows("relatives", table)
}

/// The bundled run through the whole workflow.
pub fn found() -> &'static Discovery {
    static FOUND: LazyLock<Discovery> = LazyLock::new(|| cornering::discovered().1);
    &FOUND
}
