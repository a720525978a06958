//! The benchmark of trust: `paper/data/trust.json`, as `cargo run --release --example trust` wrote it.

use super::interval::Share;
use super::markup::{head, rows, string};
use creepage::figures::fixed;
use serde_json::Value;
use std::sync::LazyLock;

static TRUST: LazyLock<Value> = LazyLock::new(|| {
    let text = std::fs::read_to_string(super::paper("data/trust.json")).unwrap();
    serde_json::from_str(&text).unwrap()
});

const SILENCE: &str = "(nothing)";
const UNNAMED: &str = "(unnamed)";

pub fn share(value: &Value) -> Share {
    let count = |name: &str| value[name].as_u64().unwrap_or(0);
    Share { k: count("k"), n: count("n") }
}

/// k of n.
pub fn count(share: &Share) -> String {
    format!("{} of {}", share.k, share.n)
}

/// k of n, the share in per cent and its interval.
fn cells(share: &Share) -> Vec<String> {
    let count = count(share);
    if share.n == 0 {
        return [count, "–".into(), "–".into()].map(|c| string(&c)).to_vec();
    }
    let [low, high] = share.interval().map(|p| fixed(100.0 * p, 1));
    [count, fixed(100.0 * share.value(), 1), format!("{low} to {high}")].map(|c| string(&c)).to_vec()
}

pub fn numbers() -> Vec<(&'static str, String)> {
    let of = |name: &str| share(&TRUST[name]);
    let count = |name: &str| count(&of(name));
    let bound = |name: &str, end: usize| fixed(100.0 * of(name).interval()[end], 1);
    let gap = |horizon: &str, i: usize| TRUST["gaps"][horizon][i].as_f64().map_or("–".into(), |v| fixed(v, 2));
    vec![
        ("alarms", count("false_alarms")),
        ("alarms-low", bound("false_alarms", 0)),
        ("alarms-high", bound("false_alarms", 1)),
        ("singles", count("singles")),
        ("pairs", count("pairs")),
        ("held", count("coverage")),
        ("held-low", bound("coverage", 0)),
        ("held-high", bound("coverage", 1)),
        ("undetermined", of("undetermined").n.to_string()),
        ("rms-z", TRUST["rms_z"].as_f64().map_or("–".into(), |v| fixed(v, 2))),
        ("gap-short", gap("1 s, effects named", 1)),
        ("gap-long", gap("5 s, effects named", 1)),
        ("confidence", "95".into()),
    ]
}

fn classes() -> (Vec<String>, Vec<String>) {
    let confusion = TRUST["confusion"].as_object().unwrap();
    let mut hidden: Vec<String> = confusion.keys().filter(|k| *k != SILENCE).cloned().collect();
    let mut named = hidden.clone();
    for name in confusion.values().flat_map(|row| row.as_object().unwrap().keys()) {
        if name != SILENCE && name != UNNAMED && !named.contains(name) {
            named.push(name.clone());
        }
    }
    hidden.push(SILENCE.into());
    named.extend([SILENCE.into(), UNNAMED.into()]);
    (hidden, named)
}

pub fn file() -> String {
    let (hidden, named) = classes();
    let lines = [
        ("false alarms, nothing hidden", "false_alarms"),
        ("one effect hidden, named rightly", "singles"),
        ("two effects hidden, both named rightly", "pairs"),
        ("intervals that hold the truth", "coverage"),
        ("effects too weak to be told apart, of which named rightly", "undetermined"),
    ];
    let row = |(says, name): &(&str, &str)| [vec![string(says)], cells(&share(&TRUST[*name]))].concat();
    let shares = rows("shares", lines.iter().map(row));
    let count = |h: &String, n: &String| match TRUST["confusion"][h][n].as_u64().unwrap_or(0) {
        0 => "\"\"".to_string(),
        k => string(&k.to_string()),
    };
    let number = |h: &String| named.iter().position(|n| n == h).map_or(0, |i| i + 1).to_string();
    let line = |h: &String| {
        let cells = named.iter().map(|n| count(h, n));
        [string(&number(h)), string(h)].into_iter().chain(cells).collect()
    };
    let confusion = rows("confusion", hidden.iter().map(line));
    let names = rows("named", named.iter().map(|n| vec![string(&number(n)), string(n)]));
    let by = |group: &String| {
        let [names, coverage] = ["names_by", "coverage_by"].map(|table| share(&TRUST[table][group]));
        [vec![string(group)], cells(&names), cells(&coverage)].concat()
    };
    let noise: Vec<String> = ["noise below 1 mm", "noise 1 to 10 mm", "noise above 10 mm"].map(String::from).to_vec();
    let groups: Vec<String> = hidden.into_iter().filter(|h| h != SILENCE).chain(noise).collect();
    head() + &shares + &confusion + &names + &rows("groups", groups.iter().map(by))
}

#[test]
fn the_intervals_are_those_of_clopper_and_pearson() {
    // From their definition: at 0 of n the upper end p has (1 - p)^n = 1/40.
    let [low, high] = Share { k: 0, n: 80 }.interval();
    assert_eq!(low, 0.0);
    assert!(((1.0 - high).powi(80) - 1.0 / 40.0).abs() < 1e-9, "{high}");
}
