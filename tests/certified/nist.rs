//! The nonlinear regression problems of NIST's Statistical Reference Datasets, where they are at hand.

use super::curve::Problem;
use std::path::{Path, PathBuf};

/// The models as NIST writes them, in the language of formulas; Nelson's is of ln y.
pub const MODELS: [(&str, &str); 27] = [
    ("Misra1a", "b1*(1 - exp(-b2*x))"),
    ("Chwirut2", "exp(-b1*x)/(b2 + b3*x)"),
    ("Chwirut1", "exp(-b1*x)/(b2 + b3*x)"),
    ("Lanczos3", "b1*exp(-b2*x) + b3*exp(-b4*x) + b5*exp(-b6*x)"),
    ("Gauss1", "b1*exp(-b2*x) + b3*exp(-(x - b4)^2/b5^2) + b6*exp(-(x - b7)^2/b8^2)"),
    ("Gauss2", "b1*exp(-b2*x) + b3*exp(-(x - b4)^2/b5^2) + b6*exp(-(x - b7)^2/b8^2)"),
    ("DanWood", "b1*exp(b2*ln(x))"),
    ("Misra1b", "b1*(1 - (1 + b2*x/2)^-2)"),
    ("Kirby2", "(b1 + b2*x + b3*x^2)/(1 + b4*x + b5*x^2)"),
    ("Hahn1", "(b1 + b2*x + b3*x^2 + b4*x^3)/(1 + b5*x + b6*x^2 + b7*x^3)"),
    ("Nelson", "b1 - b2*x*exp(-b3*x2)"),
    ("MGH17", "b1 + b2*exp(-x*b4) + b3*exp(-x*b5)"),
    ("Lanczos1", "b1*exp(-b2*x) + b3*exp(-b4*x) + b5*exp(-b6*x)"),
    ("Lanczos2", "b1*exp(-b2*x) + b3*exp(-b4*x) + b5*exp(-b6*x)"),
    ("Gauss3", "b1*exp(-b2*x) + b3*exp(-(x - b4)^2/b5^2) + b6*exp(-(x - b7)^2/b8^2)"),
    ("Misra1c", "b1*(1 - 1/sqrt(1 + 2*b2*x))"),
    ("Misra1d", "b1*b2*x/(1 + b2*x)"),
    ("Roszman1", "b1 - b2*x - atan(b3/(x - b4))/pi"),
    (
        "ENSO",
        "b1 + b2*cos(2*pi*x/12) + b3*sin(2*pi*x/12) + b5*cos(2*pi*x/b4) + b6*sin(2*pi*x/b4) + b8*cos(2*pi*x/b7) + \
         b9*sin(2*pi*x/b7)",
    ),
    ("MGH09", "b1*(x^2 + x*b2)/(x^2 + x*b3 + b4)"),
    ("Thurber", "(b1 + b2*x + b3*x^2 + b4*x^3)/(1 + b5*x + b6*x^2 + b7*x^3)"),
    ("BoxBOD", "b1*(1 - exp(-b2*x))"),
    ("Rat42", "b1/(1 + exp(b2 - b3*x))"),
    ("MGH10", "b1*exp(b2/(x + b3))"),
    ("Eckerle4", "b1/b2*exp(-((x - b3)/b2)^2/2)"),
    ("Rat43", "b1*exp(-ln(1 + exp(b2 - b3*x))/b4)"),
    ("Bennett5", "b1*exp(-ln(b2 + x)/b3)"),
];

/// The folder of the files, if it is there: beside the repository, or where the environment says.
pub fn folder() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/reference/nist_strd");
    let named = std::env::var_os("NIST_STRD").map(PathBuf::from);
    [named, Some(beside)].into_iter().flatten().find(|d| d.is_dir())
}

/// Reads a problem from NIST's file.
pub fn read(folder: &Path, name: &str, model: &str) -> Problem {
    let text = std::fs::read_to_string(folder.join(format!("{name}.dat"))).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    let numbers = |line: &str| -> Vec<f64> { line.split_whitespace().filter_map(|w| w.parse().ok()).collect() };
    let parameters: Vec<Vec<f64>> =
        lines.iter().filter(|l| l.trim_start().starts_with('b') && l.contains(" =")).map(|l| numbers(l)).collect();
    let parameters: Vec<Vec<f64>> = parameters.into_iter().filter(|p| p.len() == 4).collect();
    let column = |i: usize| parameters.iter().map(|p| p[i]).collect::<Vec<f64>>();
    let after = |what: &str| {
        let line = lines.iter().find(|l| l.starts_with(what)).unwrap();
        numbers(line)[0]
    };
    let begin = lines.iter().rposition(|l| l.starts_with("Data:")).unwrap() + 1;
    let mut rows: Vec<Vec<f64>> = lines[begin..].iter().map(|l| numbers(l)).filter(|r| !r.is_empty()).collect();
    if name == "Nelson" {
        rows.iter_mut().for_each(|row| row[0] = row[0].ln());
    }
    assert_eq!(rows.len() as f64, after("Number of Observations:"), "{name}");
    Problem {
        name: name.into(),
        model: model.into(),
        data: rows,
        starts: [column(0), column(1)],
        certified: column(2),
        deviations: column(3),
        squares: after("Residual Sum of Squares:"),
    }
}
