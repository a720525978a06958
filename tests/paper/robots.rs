//! Real robots and ablations: `paper/data/real.json` and `paper/data/ablations.json`, as `paper/real.py` and
//! `paper/ablations.py` wrote them.

use super::markup::{head, rows, string};
use super::trust::{count, share};
use creepage::figures::fixed;
use creepage::number_format::with_error;
use serde_json::Value;

fn data(name: &str) -> Vec<Value> {
    let text = std::fs::read_to_string(super::paper(&format!("data/{name}.json"))).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn text(value: &Value) -> String {
    value.as_str().unwrap().to_string()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

pub fn file() -> String {
    head() + &errors() + &names() + &ablations()
}

/// A row a robot and horizon: errors of the given, the calibrated and the named model and the floor, mm.
fn errors() -> String {
    let row = |robot: &Value, i: usize| {
        let millimetres = |v: &Value| string(&v.as_f64().map_or("–".into(), |m| fixed(1000.0 * m, 1)));
        let horizon = list(&robot["horizons_s"])[i].as_f64().unwrap();
        let mut cells = vec![string(&text(&robot["robot"])), string(&fixed(horizon, 0))];
        let errors = &robot["errors_m"];
        cells.extend(["given", "calibrated", "named"].map(|model| millimetres(&errors[model][i])));
        cells.push(millimetres(&robot["floor_m"][i]));
        cells
    };
    let all = data("real");
    rows("robots", all.iter().flat_map(|robot| (0..list(&robot["horizons_s"]).len()).map(move |i| row(robot, i))))
}

/// A row a parameter that was named or calibrated.
fn names() -> String {
    let mut all = vec![];
    for robot in data("real") {
        for effect in list(&robot["effects"]) {
            for (name, p) in effect["parameters"].as_object().unwrap() {
                let number = |key: &str| p[key].as_f64().unwrap();
                let value = with_error(number("value"), Some(number("std")));
                let cells = [text(&robot["robot"]), text(&effect["id"]), name.clone(), value, text(&p["unit"])];
                all.push(cells.map(|c| string(&c)).to_vec());
            }
        }
    }
    rows("found", all)
}

/// A row an ablation: false alarms, on coarse inputs, names right of one and of two, intervals that hold.
fn ablations() -> String {
    let row = |a: &Value| {
        let counts =
            ["false_alarms", "false_alarms_coarse", "singles", "pairs", "coverage"].map(|key| count(&share(&a[key])));
        std::iter::once(title(a["ablation"].as_str().unwrap()).to_string()).chain(counts).map(|c| string(&c)).collect()
    };
    let all: Vec<Vec<String>> = data("ablations").iter().map(row).collect();
    rows("ablations", all)
}

fn title(ablation: &str) -> &'static str {
    match ablation {
        "whole" => "the method",
        "no-jumps" => "no jumps between windows: a run is one trajectory",
        "no-restriction" => "variances by plain maximum likelihood",
        "no-cross-validation" => "nothing left out is predicted",
        "no-price" => "no price for the size of the library",
        other => panic!("no ablation is called {other}"),
    }
}

/// What remains on each robot, in floors.
pub fn numbers() -> Vec<(&'static str, String)> {
    let all = data("real");
    let of = |name: &str| all.iter().find(|r| r["robot"] == name).unwrap();
    let rest = |name: &str| fixed(of(name)["remains"].as_f64().unwrap(), 1);
    let ratio = |name: &str, model: &str| {
        let errors = &of(name)["errors_m"];
        let last = |m: &str| list(&errors[m]).last().unwrap().as_f64().unwrap();
        fixed(100.0 * (1.0 - last("named") / last(model)), 0)
    };
    vec![
        ("optiodom-rest", rest("optiodom")),
        ("dart-rest", rest("dart")),
        ("optiodom-fewer", ratio("optiodom", "calibrated")),
        ("dart-fewer", ratio("dart", "calibrated")),
        ("optiodom-held", of("optiodom")["held_out_runs"].to_string()),
        ("dart-held", of("dart")["held_out_runs"].to_string()),
    ]
}
