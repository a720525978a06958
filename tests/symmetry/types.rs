//! Constraint types as data: those of the catalogue, and one of one's own through every door of the library.

use creepage::claims::{DerivedFormulas, Statement, prove};
use creepage::describe::{self, Description, Signature};
use creepage::formula::{Expr, Symbol, identical};
use creepage::mechanism::{Constraint, ConstraintType, Form, Part, Row, constraint_types};
use creepage::model::Model;
use creepage::motion::driven;
use creepage::vehicles::{self, Vehicle};
use std::sync::Arc;

#[test]
fn the_catalogue_is_r_t_and_s() {
    let letters: String = constraint_types().iter().map(|t| t.letter).collect();
    assert_eq!(letters, "RTS");
    for t in constraint_types() {
        let used = t.form.symbols();
        assert!(used.iter().all(|s| s.as_str() == "e" || t.slots.iter().any(|slot| slot.name == *s)), "{}", t.id);
        assert!(t.slots.iter().all(|s| !s.meaning.is_empty()), "{}", t.id);
        for named in [&t.gives, &t.singular].into_iter().flatten() {
            assert!(t.slots.iter().any(|s| s.name == *named), "{}", t.id);
        }
    }
    assert!(ConstraintType::named("T").unwrap().id == "direction");
    let error = ConstraintType::named("sliding").unwrap_err().to_string();
    assert!(error.contains("no constraint type is called \"sliding\"") && error.contains("rolling"), "{error}");
}

/// Rows that are written shorter than their form multiplied out are the same forms.
#[test]
fn every_row_of_the_catalogue_is_its_form() {
    for vehicle in vehicles::all() {
        for c in Model::sample(vehicle).unwrap().constraints() {
            let given: Vec<(Symbol, Part)> = c.form.slots().to_vec();
            let given: Vec<_> = given.into_iter().filter(|(n, _)| is_given(&c, n)).collect();
            let assembled = Form::new(&Arc::new(c.kind().clone()), &given, &c.creep).unwrap();
            let difference = assembled.row().plus(&Expr::int(-1), &c.row());
            for (rate, coefficient) in difference.terms() {
                assert_eq!(identical(coefficient, &Expr::int(0)), Some(true), "{} {}: {rate}", vehicle.id, c.name);
            }
            assert_eq!(identical(&c.generic(), &c.row().expr()), Some(true), "{} {}", vehicle.id, c.name);
        }
    }
}

fn is_given(c: &Constraint, name: &Symbol) -> bool {
    c.kind().slots.iter().any(|s| s.name == *name && s.formula.is_none())
}

/// A belt that drives a cart: of no type of the catalogue.
const CART: &str = r#"
id = "belt-cart"
title = "a cart on a belt"
[parameters.pulley]
unit = "m"
meaning = "radius of the pulley"
[inputs.motor_rate]
unit = "rad/s"
meaning = "rate of the pulley"
[inputs.yaw_rate]
unit = "rad/s"
meaning = "yaw rate"
[define]
r = { formula = "pulley", unit = "m", meaning = "radius of the pulley" }
"q'" = { formula = "motor_rate", unit = "rad/s", meaning = "rate of the pulley" }
"phi'" = { formula = "yaw_rate", unit = "rad/s", meaning = "yaw rate" }
[[coordinates]]
name = "x"
unit = "m"
meaning = "place along x"
[[coordinates]]
name = "y"
unit = "m"
meaning = "place along y"
[[coordinates]]
name = "phi"
unit = "rad"
meaning = "heading"
[[coordinates]]
name = "q"
unit = "rad"
meaning = "angle of the pulley"
[[wheels]]
name = "skid"
traverse_creep = "e_tc"
[[constraints]]
name = "belt"
creep = "e_b"
[constraints.type]
id = "belt"
letter = "B"
meaning = "a belt"
form = "along' - (1 - e)*R*turns'"
source = "(0)"
creep = "belt slip"
slots = [{ name = "along'", meaning = "speed" }, { name = "R", meaning = "radius" }, { name = "turns'", meaning = "rate" }]
[constraints.slots]
"along'" = "cos(phi)*x' + sin(phi)*y'"
R = "r"
"turns'" = "q'"
"#;

fn cart() -> Model {
    let vehicle: Vehicle = toml::from_str(CART).unwrap();
    let mut model = Model::new("unicycle", &[("wheel_radius", 1.0)]).unwrap();
    model.inputs = vehicle.inputs.keys().cloned().collect();
    model.parameters = [("pulley".to_string(), 0.2)].into();
    model.vehicle = vehicle;
    model
}

#[test]
fn a_type_of_ones_own_is_described() {
    let d = Description::of(&cart()).unwrap();
    assert_eq!(d.signature.to_string(), "T B");
    assert_eq!((d.signature.count('B'), d.signature.count('R')), (1, 0));
    assert_eq!(d.structure.realisation.as_ref().unwrap().signature.to_string(), "T B");
    let text = describe::text(&d);
    for said in [
        "Type B, along' - (1 - e)*R*turns' = 0; coefficient e_b; equations (0). Put in:",
        "along' = cos(phi)*x' + sin(phi)*y'",
        "cos(phi)*x' + sin(phi)*y' - (1 - e_b)*r*q' = 0",
        "belt slip of the belt",
        "constraints by form: T B",
    ] {
        assert!(text.contains(said), "{said}\n{text}");
    }
    let belt = text.find("### 2. belt").unwrap();
    assert!(!text[belt..].split("## Pfaffian").next().unwrap().contains("sigma"));
    let json = describe::json(&d);
    assert_eq!(json["constraints_by_form"]["b"], 1);
    assert_eq!(json["constraints"][1]["generic"]["text"], "along' - (1 - e)*R*turns' = 0");
    assert_eq!(json["constraints"][1]["form"], "B");
    assert!(
        describe::latex(&d)
            .contains(r"Type B, $\dot{\mathrm{along}} - \left(1 - e\right)\,R\,\dot{\mathrm{turns}} = 0$")
    );
}

#[test]
fn a_type_of_ones_own_moves_and_is_proved() {
    let mut model = cart();
    let inputs = [("motor_rate", "3 + cos(t)"), ("yaw_rate", "1/2")];
    let path = driven(&model, &inputs, &[], &[0.0, 0.0, 0.3], &[0.0, 2.0]).unwrap();
    // The same cart as a wheel.
    let wheel = Model::new("unicycle", &[("wheel_radius", 0.2)]).unwrap();
    let inputs = [("wheel_rate", "3 + cos(t)"), ("yaw_rate", "1/2")];
    let other = driven(&wheel, &inputs, &[], &[0.0, 0.0, 0.3], &[0.0, 2.0]).unwrap();
    path[1].iter().zip(&other[1]).for_each(|(a, b)| assert!((a - b).abs() < 1e-11, "{a} {b}"));
    let machine = DerivedFormulas::of_model(&model);
    let holds = |says: &str| prove(&machine, &Statement::parse(&[("v_l", says)]).unwrap()).holds();
    assert!(holds("r*q'*(1 - e_b)") && !holds("r*q'*(1 + e_b)"));
    model.parameters.insert("pulley".into(), 0.4);
    let inputs = [("motor_rate", "3 + cos(t)"), ("yaw_rate", "1/2")];
    let faster = driven(&model, &inputs, &[], &[0.0, 0.0, 0.3], &[0.0, 2.0]).unwrap();
    assert!((faster[1][0] - 2.0 * path[1][0]).abs() < 1e-11);
}

/// The same constraint beside the pose of the plane, without coordinates of its own.
#[test]
fn a_constraint_of_ones_own_stands_beside_wheels() {
    let mut vehicle = vehicles::named("unicycle").unwrap().clone();
    let belt = ConstraintType::new("belt", 'B', "along' - (1 - e)*R*turns'").unwrap();
    let slots = [("along'", "cos(phi)*x' + sin(phi)*y'"), ("R", "r"), ("turns'", "theta'")];
    vehicle.constraints = vec![Constraint::new("belt", &belt, &slots, "e_b").unwrap()];
    vehicle.wheels[0].rate = None;
    let mut model = Model::new("unicycle", &[("wheel_radius", 0.2)]).unwrap();
    model.vehicle = vehicle;
    assert_eq!(Signature::of(&model.constraints()).to_string(), "T B");
    let machine = DerivedFormulas::of_model(&model);
    let says = [("v_l", "r*theta'*(1 - e_b)"), ("v_t", "e_tc*v_l")];
    assert!(prove(&machine, &Statement::parse(&says).unwrap()).holds());
}

#[test]
fn what_does_not_fit_a_type_is_said() {
    let belt = ConstraintType::new("belt", 'B', "along' - (1 - e)*R*turns'").unwrap();
    let full = [("along'", "s'"), ("R", "r"), ("turns'", "q'")];
    let said = |slots: &[(&str, &str)]| Constraint::new("x", &belt, slots, "e_b").unwrap_err().to_string();
    assert!(said(&full[..2]).contains("a constraint of type belt needs the slot turns'"));
    assert!(
        said(&[full[0], full[1], full[2], ("radius", "1")]).contains("has no slot radius; it has R, along', turns'")
    );
    assert!(said(&[full[0], full[1], ("turns'", "q'^2")]).contains("q'^2 is not linear in rates"));
    assert!(said(&[full[0], ("R", "r'"), full[2]]).contains("is not linear in rates"));
    assert!(said(&[("along'", "v"), full[1], ("turns'", "w")]).contains("has no rate in it"));
    assert!(said(&[full[0], full[1], ("turns'", "q' +")]).contains("q' +"));
    let read = |text: &str| toml::from_str::<Constraint>(text).unwrap_err().to_string();
    assert!(
        read("name = \"x\"\ntype = \"sliding\"\ncreep = \"e\"").contains("no constraint type is called \"sliding\"")
    );
    let wrong = "name = \"x\"\ntype = \"rolling\"\ncreep = \"e\"\nenergy = \"q'^2\"\ngenerator = { q = \"1\" }";
    assert!(read(wrong).contains("an energy gives a constraint of type momentum"));
    assert!(ConstraintType::new("bad", 'X', "1 +").is_err());
    let bent = ConstraintType::new("bent", 'X', "a' - e^2*b'").unwrap();
    let error = Constraint::new("x", &bent, &[("a'", "s'"), ("b'", "q'")], "e_x").unwrap_err().to_string();
    assert!(error.contains("not linear in its coefficient"), "{error}");
}

#[test]
fn letters_of_ones_own_come_behind_those_of_the_catalogue() {
    let of = |letter: char| {
        let t = ConstraintType::new("own", letter, "a'").unwrap();
        Constraint::new("own", &t, &[("a'", "q'")], "e").unwrap()
    };
    let wheel = Model::new("unicycle", &[("wheel_radius", 1.0)]).unwrap().constraints();
    let all = [vec![of('Z'), of('A'), of('A')], wheel].concat();
    assert_eq!(Signature::of(&all).to_string(), "R T A^2 Z");
    let mut row = Row::default();
    row.add("q'", &Expr::int(1));
    assert_eq!(of('A').row(), row);
}

/// Read as arithmetic says, and refused where it is neither a factor nor linear in rates.
#[test]
fn a_part_is_a_factor_or_linear_in_rates() {
    let factors = ["-a", "a + b", "a - b", "a*b", "a/b", "-(a - b)^2", "sin(a)/2"];
    let rates = [
        "-psi'",
        "psi' + theta'",
        "psi' - theta'",
        "a*psi' - theta'/b",
        "-(a*psi')",
        "0 + psi'",
        "psi' - 0",
        "0 - psi'",
    ];
    for (texts, is_factor) in [(&factors[..], true), (&rates[..], false)] {
        for text in texts {
            let formula = Expr::parse(text).unwrap();
            let part = Part::of(&formula).unwrap();
            assert_eq!(matches!(part, Part::Factor(_)), is_factor, "{text}");
            assert_eq!(identical(&part.expr(), &formula), Some(true), "{text} is read as {}", part.expr());
        }
    }
    for text in ["a + psi'", "psi' - a", "psi'*theta'", "a/psi'", "cos(psi')", "psi'^2"] {
        assert!(Part::of(&Expr::parse(text).unwrap()).is_err(), "{text}");
    }
}

#[test]
fn a_name_replaced_is_replaced_in_the_row() {
    for c in Model::sample(vehicles::named("unicycle").unwrap()).unwrap().constraints() {
        let without = c.substitute(&|s| (*s == c.creep).then(|| Expr::int(0)));
        assert!(c.row().expr().mentions(&c.creep) && !without.row().expr().mentions(&c.creep), "{}", c.name);
        assert_eq!(without.row().expr(), c.ideal_row().expr(), "{}", c.name);
    }
}
