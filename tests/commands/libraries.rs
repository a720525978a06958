//! Integrators of the crate `ode_solvers` and derivatives by the dual numbers of `num-dual`, as commands give them.

use crate::program::{creepage, stderr};
use creepage::formula::{Expr, Symbol};
use serde_json::Value;
use std::path::Path;

fn example(path: &str) -> String {
    format!("{}/examples/{path}", env!("CARGO_MANIFEST_DIR"))
}

/// The numbers of the last row that `simulate` writes.
fn end(folder: &Path, model: &str, inputs: &str, method: &[&str]) -> Vec<f64> {
    let (model, inputs) = (example(model), example(inputs));
    let whole = [&["simulate", &model, "--inputs", &inputs, "--out", "path.csv", "--quiet"][..], method].concat();
    let output = creepage(folder, &whole);
    assert_eq!(output.status.code(), Some(0), "{method:?}: {}", stderr(&output));
    let text = std::fs::read_to_string(folder.join("path.csv")).unwrap();
    text.lines().last().unwrap().split(',').map(|v| v.parse().unwrap()).collect()
}

/// A car by its rates, and one that forces move with stiff friction: four methods that share no code end in one place.
#[test]
fn the_path_does_not_hang_on_the_integrator() {
    let dir = tempfile::tempdir().unwrap();
    let of = |model: &str, inputs: &str, method: &[&str]| end(dir.path(), model, inputs, method);
    let steering = ["runs/steering/model.toml", "runs/steering/eights.csv"];
    let reference = of(steering[0], steering[1], &[]);
    let methods: [&[&str]; 4] = [
        &["--integrator", "dop853"],
        &["--integrator", "dopri5"],
        &["--integrator", "radau5"],
        &["--integrator", "rk4"],
    ];
    for method in methods {
        let found = of(steering[0], steering[1], method);
        let far = found.iter().zip(&reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(far < 1e-9, "{method:?}: {far}");
    }
    // A step that is too long shows: the method is not the default under another name.
    let coarse = of(steering[0], steering[1], &["--integrator", "rk4", "--step", "2"]);
    let far = coarse.iter().zip(&reference).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!((1e-9..1e-1).contains(&far), "{far}");
    let sleigh = ["dynamics/sleigh.toml", "dynamics/times.csv"];
    let (order_8, order_5) = (of(sleigh[0], sleigh[1], &[]), of(sleigh[0], sleigh[1], &["--integrator", "dopri5"]));
    assert!(
        order_8.iter().zip(&order_5).all(|(a, b)| (a - b).abs() < 1e-7 * (1.0 + a.abs())),
        "{order_8:?} {order_5:?}"
    );
    assert_ne!(order_8, order_5, "the same bits: the choice was not heeded");
}

#[test]
fn steps_without_end_are_refused() {
    let dir = tempfile::tempdir().unwrap();
    let (model, inputs) = (example("runs/steering/model.toml"), example("runs/steering/eights.csv"));
    for (step, says) in [("1e-8", "give a --step of"), ("0", "a step lies within"), ("much", "a step lies within")] {
        let arguments =
            ["simulate", &model, "--inputs", &inputs, "--out", "path.csv", "--integrator", "rk4", "--step", step];
        let output = creepage(dir.path(), &arguments);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains(says), "{}", stderr(&output));
        assert!(!dir.path().join("path.csv").exists());
    }
}

fn described(model: &str, point: &str) -> Value {
    let output = creepage(Path::new("."), &["describe", &example(model), "--format", "json", "--at", point]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The numbers by dual numbers are those of the formulas that the same description prints, made by the rules.
#[test]
fn jacobians_by_dual_numbers_are_those_of_the_printed_formulas() {
    let point = "phi=0.3,delta=-0.2,x'=1.5,y'=0.4,phi'=0.7,theta'=3,e_rc=0.1,e_tc=-0.05,e_f=0.02";
    for model in ["runs/steering/model.toml", "dynamics/car.toml"] {
        let found = described(model, point);
        let at = &found["derivatives_at"];
        let values = |s: &Symbol| {
            let parameter = found["symbols"].as_array().unwrap().iter().find(|e| e["symbol"] == s.as_str());
            at["point"][s.as_str()].as_f64().or_else(|| parameter?["value"].as_f64()).unwrap_or(f64::NAN)
        };
        let mut compared = 0;
        for (by_rules, by_dual) in
            found["constraints"].as_array().unwrap().iter().zip(at["constraints"].as_array().unwrap())
        {
            let jacobian = &by_rules["jacobian"];
            let all = ["q", "q_dot"].iter().flat_map(|part| jacobian[part].as_object().unwrap());
            let by_e = by_rules["creep"].as_str().unwrap().to_string();
            for (name, entry) in all.chain([(&by_e, &jacobian["e"])]) {
                let formula = Expr::parse(entry["text"].as_str().unwrap()).unwrap();
                let (wanted, dual) = (formula.eval(&values).unwrap(), by_dual["gradient"][name].as_f64().unwrap());
                assert!((dual - wanted).abs() < 1e-13 * (1.0 + wanted.abs()), "{model}, {name}: {dual} {wanted}");
                compared += 1;
            }
        }
        assert!(compared >= 12, "{compared}");
    }
}

#[test]
fn a_point_that_no_constraint_has_is_refused() {
    let model = example("runs/steering/model.toml");
    for (point, says) in [
        ("psi=1", "no constraint of the model has a variable"),
        ("q=1,2", "q takes 4 values and has 2"),
        ("phi=east", "gives no value"),
        ("phi=nan", "gives no value"),
        ("1,2", "gives no value"),
        ("delta=1.5707963267948966,phi=1,x'=1e308,phi'=1e308", "there are no derivatives at this point"),
    ] {
        let output = creepage(Path::new("."), &["describe", &model, "--at", point]);
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{point}: {message}");
        assert!(message.contains(says), "{point}: {message}");
    }
}

/// The signature hangs on what is measured: a train whose trailer headings are measured needs no coefficient for them.
#[test]
fn the_signature_is_a_function_of_what_is_measured() {
    let dir = tempfile::tempdir().unwrap();
    let text = "vehicle = \"n-trailer\"\ntractor = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\ntrailer_lengths = [1.2, 0.8]\n";
    std::fs::write(dir.path().join("model.toml"), text).unwrap();
    let of = |measured: &[&str]| {
        let output = creepage(dir.path(), &[&["describe", "model.toml", "--format", "json"], measured].concat());
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        let signature = &found["structure"]["realisation"]["signature"];
        (signature["r"].as_u64().unwrap(), signature["t"].as_u64().unwrap())
    };
    assert_eq!(of(&[]), (1, 3));
    assert_eq!(of(&["--measured", "phi_1'"]), (1, 2));
    assert_eq!(of(&["--measured", "phi_1',phi_2'"]), (1, 1));
    let output = creepage(dir.path(), &["describe", "model.toml", "--measured", "psi'"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("psi' is no rate") && stderr(&output).contains("phi_2'"), "{}", stderr(&output));
}
