//! Effects that are the same under another name are proved to be, and near misses are not.

use creepage::describe::every_effect_page;
use creepage::effects::{self, Applied, Effect};
use creepage::equivalence::{Measured, Relation, TURN, relation};
use creepage::formula::{Expr, Symbol, identical};
use creepage::model::{Model, Trailer};
use creepage::vehicles;

/// A vehicle with every length one and the sensor at its reference point.
fn model(vehicle: &str, trailers: usize) -> Model {
    let parameters = &vehicles::named(vehicle).unwrap().parameters;
    let ones: Vec<(&str, f64)> = parameters.keys().map(|name| (name.as_str(), 1.0)).collect();
    Model::new(vehicle, &ones).unwrap().with_trailers(&vec![Trailer { length: 1.0, hitch: 0.5 }; trailers])
}

fn free(effect: &Effect, trailer: Option<usize>) -> Applied {
    Applied::new(effect, trailer, effect.starts().swap_remove(0)).freed()
}

fn effect(id: &str) -> Applied {
    free(effects::named(id).unwrap(), None)
}

/// An effect of the library with one of its changes written otherwise.
fn altered(id: &str, target: &str, formula: &str) -> Applied {
    let mut e = effects::named(id).unwrap().clone();
    *e.changes.get_mut(target).unwrap() = Expr::parse(formula).unwrap();
    e.id = format!("{id}-altered");
    free(&e, None)
}

const BLIND: Measured = Measured { heading: false, trailers: false };

fn between(vehicle: &str, a: &str, b: &str, measured: Measured) -> Relation {
    relation(&model(vehicle, 0), &[effect(a)], &[effect(b)], measured)
}

/// What a relation says, in a word.
fn word(r: &Relation) -> &'static str {
    match r {
        Relation::Identical(_) => "identical",
        Relation::Contained(_) => "contained",
        Relation::Contains(_) => "contains",
        Relation::FirstOrder => "first order",
        Relation::Different => "different",
    }
}

/// Every pair of the library on a vehicle that is related.
fn related(vehicle: &str, trailers: usize, measured: Measured) -> Vec<String> {
    let model = model(vehicle, trailers);
    let all: Vec<Applied> = model.applicable(effects::all()).into_iter().map(|(e, t)| free(e, t)).collect();
    let mut found = Vec::new();
    for (i, a) in all.iter().enumerate() {
        for b in &all[i + 1..] {
            let r = relation(&model, std::slice::from_ref(a), std::slice::from_ref(b), measured);
            if r != Relation::Different {
                found.push(format!("{} {} {}", a.label(), word(&r), b.label()));
            }
        }
    }
    found
}

const RADIUS: &str = "rotation-creep identical wheel-radius";
const STEERING: &str = "steering-offset identical front-traverse-creep";
const HEADING: &str = "traverse-creep first order heading-misalignment";
const YAWING: &str = "lever-arm contains odometry-speed-per-yaw";
const TWO_WHEELS: [&str; 3] = [
    "rotation-creep contained unequal-rotation-creep",
    "wheel-radius contained unequal-rotation-creep",
    "wheel-radius-mismatch contained unequal-rotation-creep",
];

#[test]
fn every_related_pair_of_every_vehicle_is_found_and_no_other() {
    let drive = [&[RADIUS][..], &TWO_WHEELS, &[HEADING]].concat();
    assert_eq!(related("unicycle", 0, Measured::ALL), [RADIUS, HEADING, YAWING]);
    assert_eq!(related("differential-drive", 0, Measured::ALL), drive);
    assert_eq!(related("differential-drive-castor", 0, Measured::ALL), drive);
    assert_eq!(related("car", 0, Measured::ALL), [RADIUS, STEERING]);
    assert_eq!(related("four-wheel-car", 0, Measured::ALL), [RADIUS, STEERING]);
    assert_eq!(related("disk", 0, Measured::ALL), [RADIUS]);
    // The driven wheel is the steered one: its speed along itself is measured, so that the two differ in length.
    let tricycle = "steering-offset first order front-traverse-creep";
    assert_eq!(related("tricycle", 0, Measured::ALL), [RADIUS, tricycle]);
    let synchro = [
        RADIUS,
        "traverse-creep first order steering-offset",
        HEADING,
        "steering-offset identical heading-misalignment",
    ];
    assert_eq!(related("synchro-drive", 0, Measured::ALL), synchro);
}

#[test]
fn trailers_change_nothing_for_their_tractor() {
    assert_eq!(related("car", 1, Measured::ALL), [RADIUS, STEERING]);
    assert_eq!(related("unicycle", 1, Measured::ALL), [RADIUS]);
    // Nothing sees the trailers: their effects act on nothing that is measured.
    let trailers = Measured { heading: true, trailers: false };
    assert_eq!(related("unicycle", 1, trailers), [RADIUS, HEADING, YAWING]);
}

#[test]
fn an_unmeasured_heading_may_be_turned() {
    let Relation::Contained(change) = between("unicycle", "traverse-creep", "rotation-creep", BLIND) else { panic!() };
    let proved = |name: &str, formula: &str| {
        assert_eq!(identical(&change[&Symbol::new(name)], &Expr::parse(formula).unwrap()), Some(true), "{change:?}");
    };
    proved("traverse_creep.e_tc", &format!("tan({TURN})"));
    proved("rotation_creep.e_rc", &format!("1 - 1/cos({TURN})"));
    // Not every rotation creep: these are faster than ideal only.
    assert_eq!(word(&between("unicycle", "rotation-creep", "traverse-creep", BLIND)), "contains");
    assert_eq!(word(&between("unicycle", "rotation-creep", "traverse-creep", Measured::ALL)), "different");
    // The turned axle of a car yaws otherwise.
    assert_eq!(word(&between("car", "traverse-creep", "rotation-creep", BLIND)), "different");
    assert_eq!(word(&between("unicycle", "heading-misalignment", "traverse-creep", BLIND)), "different");
}

#[test]
fn changes_of_parameter_are_formulas() {
    let change = |vehicle: &str, a: &str, b: &str| match between(vehicle, a, b, Measured::ALL) {
        Relation::Identical(change) | Relation::Contained(change) => {
            change.iter().map(|(s, f)| format!("{s} = {f}")).collect::<Vec<_>>()
        }
        other => panic!("{other:?}"),
    };
    assert_eq!(change("car", "wheel-radius", "rotation-creep"), ["rotation_creep.e_rc = -wheel_radius.scale"]);
    let offset = "front_traverse_creep.e_tc = sin(steering_offset.offset)/cos(steering_offset.offset)";
    assert_eq!(change("car", "steering-offset", "front-traverse-creep"), [offset]);
    let one_sided =
        ["unequal_rotation_creep.e_left = -wheel_radius_mismatch.scale", "unequal_rotation_creep.e_right = 0"];
    assert_eq!(change("differential-drive", "wheel-radius-mismatch", "unequal-rotation-creep"), one_sided);
}

/// One-sided creep is the mismatch; equal creep of both wheels is a coincidence of the two.
#[test]
fn a_special_case_with_the_rest_at_zero_replaces() {
    let replaces = |a: &str, b: &str| between("differential-drive", a, b, Measured::ALL).replaces();
    assert!(replaces("wheel-radius-mismatch", "unequal-rotation-creep"));
    assert!(!replaces("unequal-rotation-creep", "wheel-radius-mismatch"));
    assert!(!replaces("rotation-creep", "unequal-rotation-creep"));
    assert!(replaces("rotation-creep", "wheel-radius") && !replaces("traverse-creep", "heading-misalignment"));
}

#[test]
fn sets_of_effects_are_compared() {
    let model = model("unicycle", 0);
    let [turned, sideways, biased] = ["heading-misalignment", "traverse-creep", "yaw-rate-bias"].map(effect);
    let (one, two) = ([sideways.clone()], [biased.clone(), sideways.clone()]);
    let word = |a: &[Applied], b: &[Applied]| word(&relation(&model, a, b, Measured::ALL));
    assert_eq!(word(&two, &[sideways.clone(), biased.clone()]), "identical");
    assert_eq!(word(&one, &two), "contained");
    assert_eq!(word(&two, &one), "contains");
    assert_eq!(word(&[turned], &two), "first order");
    assert_eq!(word(&[biased], &one), "different");
}

#[test]
fn near_misses_are_not_identical() {
    let car = model("car", 0);
    let near = |a: Applied, b: Applied| word(&relation(&car, &[a], &[b], Measured::ALL));
    // The wrong sign under the line: the first order stays.
    let wrong = altered("steering-offset", "delta", "it + atan(offset) + offset^3");
    assert_ne!(near(wrong, effect("front-traverse-creep")), "identical");
    let understeer = altered("understeer", "phi'", "it/(1 + gradient*v_l^2*phi'^0) + gradient*v_l");
    assert_eq!(near(understeer, effect("understeer")), "different");
    // A radius that grows by the square is a creep of one sign.
    let square = altered("wheel-radius", "r*", "it*(1 + scale^2)");
    assert_eq!(near(square, effect("rotation-creep")), "contained");
    let slower = altered("wheel-radius", "r*", "it*(1 + scale*v_l)");
    assert_eq!(near(slower, effect("rotation-creep")), "different");
    // The same under a sign, and under a factor of the vehicle's own.
    assert_eq!(near(altered("wheelbase", "L", "it*(1 - scale)"), effect("wheelbase")), "identical");
    assert_eq!(near(altered("wheelbase", "L", "it + scale"), effect("wheelbase")), "identical");
    assert_eq!(near(altered("wheelbase", "L", "it/(1 + scale)"), effect("wheelbase")), "identical");
    assert_eq!(near(altered("input-delay", "delay", "it - 2*delay"), effect("input-delay")), "identical");
}

#[test]
fn a_lever_arm_that_is_known_turns_with_the_heading() {
    let mut model = model("unicycle", 0);
    let ask =
        |m: &Model| word(&relation(m, &[effect("traverse-creep")], &[effect("heading-misalignment")], Measured::ALL));
    assert_eq!(ask(&model), "first order");
    model.sensor.lever_arm = [0.3, 0.0];
    assert_eq!(ask(&model), "different");
}

#[test]
fn what_differs_is_called_different() {
    for (vehicle, a, b) in [
        ("unicycle", "traverse-creep", "lever-arm"),
        ("unicycle", "lever-arm", "load-dependent-creep"),
        ("unicycle", "cornering-creep", "load-dependent-creep"),
        ("unicycle", "yaw-rate-bias", "yaw-rate-scale"),
        ("unicycle", "side-slope", "drift"),
        ("car", "understeer", "wheelbase"),
        ("car", "steering-gain", "wheelbase"),
        ("car", "traverse-creep", "heading-misalignment"),
        ("differential-drive", "track-width", "wheel-radius-mismatch"),
    ] {
        assert_eq!(word(&between(vehicle, a, b, Measured::ALL)), "different", "{vehicle}: {a}, {b}");
    }
}

#[test]
fn the_page_of_every_effect_on_every_vehicle_is_not_stale() {
    let fresh = every_effect_page(None, vehicles::all(), effects::all()).unwrap();
    let kept = concat!(env!("CARGO_MANIFEST_DIR"), "/book/src/guide/every-effect.md");
    let kept = std::fs::read_to_string(kept).unwrap();
    assert!(kept == fresh, "run: creepage effects --format page > book/src/guide/every-effect.md");
    assert!(fresh.contains("| `input-delay` | `u(t) becomes u(t - delay)` |"), "what a delay does to the inputs");
    let open =
        "\nNo effect is fitted on `sleigh`, `skid-steer`: their constraints alone do not determine their motion.\n";
    assert!(fresh.ends_with(open), "vehicles without a table are named");
    let sleigh = every_effect_page(Some("sleigh"), vehicles::all(), effects::all());
    assert!(sleigh.unwrap_err().to_string().contains("do not determine its motion"));
}
