//! The equations of the paper: those of the evidence of claims, which the program has found true.

use super::ledger::{equations, said};
use super::markup::{display, formula, head};
use creepage::describe::Description;
use creepage::formula::Expr;
use creepage::model::Model;
use std::fmt::Write;

/// A name in the paper: claim, its piece of evidence, places of the equations in it.
const FROM_CLAIMS: [(&str, &str, usize, &[usize]); 19] = [
    ("form-rolling", "eq-13", 0, &[0]),
    ("form-direction", "singularity-free", 0, &[0, 1]),
    ("sigma", "eq-21", 0, &[1]),
    ("body-row", "eq-17", 0, &[0]),
    ("wheel", "eq-24", 0, &[0]),
    ("wheel-side", "eq-25", 0, &[0]),
    ("ground", "eq-25", 0, &[1, 2]),
    ("determinant", "proposition", 1, &[0]),
    ("yaw", "E17", 1, &[0]),
    ("slips", "E16", 3, &[0]),
    ("equal", "E16", 1, &[0]),
    ("remark", "E17", 2, &[0, 1]),
    ("point", "E18", 1, &[0]),
    ("car-yaw", "car-RT2", 0, &[1]),
    ("trailer", "trailer-recursion", 1, &[0, 1, 2]),
    ("similarity", "similarity", 0, &[0, 1]),
    ("planning", "planning", 0, &[0, 1]),
    ("energy", "E23", 1, &[0]),
    ("apart", "E24", 1, &[0, 1]),
];

pub fn file() -> String {
    let mut out = head() + "#let eq = (\n";
    for (name, id, evidence, places) in FROM_CLAIMS {
        let _ = writeln!(out, "  {name}: {},", display(&equations(id, evidence, places)));
    }
    out += ")\n\n";
    out += "// Signatures.\n#let sig = (\n";
    for vehicle in ["unicycle", "differential", "car", "tricycle"] {
        let _ = writeln!(out, "  {vehicle}: {},", signature("theorem-single-body", vehicle));
        let _ = writeln!(out, "  {vehicle}-train: {},", signature("theorem-trailers", vehicle));
    }
    out += ")\n\n";
    out + &rows_of_the_car()
}

/// RᵏTᵐ of a vehicle from the counts of a claim.
fn signature(id: &str, vehicle: &str) -> String {
    let power = |letter: &str, count: &str| {
        let n = said(id, &format!("{vehicle}.{count}")).unwrap_or_else(|| panic!("{id} does not count {vehicle}"));
        match n.as_str() {
            "1" => format!("upright({letter})"),
            n => format!("upright({letter})^({})", formula(&Expr::parse(n).unwrap())),
        }
    };
    format!("${} {}$", power("R", "k"), power("T", "m"))
}

/// The constraints of the front-steered car as `creepage describe` derives them.
fn rows_of_the_car() -> String {
    let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
    let described = Description::of(&car).unwrap();
    let mut out = String::from("// The car: name, type and row of every constraint.\n#let car-rows = (\n");
    for c in &described.constraints {
        let _ = writeln!(out, "  ([{}], [{}], ${} = 0$),", c.name, c.kind.letter, formula(&c.row.expr()));
    }
    out + ")\n"
}
