//! Extensions as an outsider writes them, with the public interface alone: a vehicle, an effect, a claim and a type of
//! constraint, each in one file of fewer than 40 lines, each at once known to everything.

#[path = "extend/claim.rs"]
mod claim;
#[path = "extend/constraint.rs"]
mod constraint;
#[path = "extend/effect.rs"]
mod effect;
#[path = "extend/vehicle.rs"]
mod vehicle;

use creepage::claims::{self, Domain, Options, Status, ledger, verify};
use creepage::describe::{self, Description, vehicle_effects_text};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::report::{Report, Verdict};
use creepage::discrepancy::request::Request;
use creepage::effects::{self, Applied, Effect};
use creepage::files::{ModelFile, Run};
use creepage::model::{Model, known_on};
use creepage::motion::{Integrator, Signals, Table, Timing, simulate_model};
use creepage::progress::unheard;
use creepage::vehicles::{self, Vehicle};
use rand::SeedableRng;
use rand_distr::Distribution;

const FILES: [(&str, &str); 4] = [
    ("vehicle", include_str!("extend/vehicle.rs")),
    ("effect", include_str!("extend/effect.rs")),
    ("claim", include_str!("extend/claim.rs")),
    ("constraint", include_str!("extend/constraint.rs")),
];

#[test]
fn each_extension_is_short_and_what_the_guide_shows() {
    let guide = include_str!("../CONTRIBUTING.md");
    for (name, text) in FILES {
        let lines = text.lines().count();
        assert!((5..40).contains(&lines), "{name} has {lines} lines");
        assert!(guide.contains(text), "CONTRIBUTING.md does not show tests/extend/{name}.rs as it is");
        assert!(!text.contains("crate::"), "{name} is none of an outsider");
    }
}

const BUS: [(&str, f64); 4] =
    [("wheel_radius", 0.478), ("wheelbase", 5.9), ("joint_offset", 1.65), ("rear_length", 5.1)];

/// Every vehicle there is, and one more.
fn with(own: &Vehicle) -> Vec<Vehicle> {
    [vehicles::all(), std::slice::from_ref(own)].concat()
}

/// Half a minute of a drive that turns to both sides at changing speed.
fn driven(model: &Model, inputs: [fn(f64) -> f64; 2]) -> (Table, [Vec<f64>; 2]) {
    let times: Vec<f64> = (0..750).map(|i| 0.04 * f64::from(i)).collect();
    let columns = inputs.map(|f| times.iter().map(|t| f(*t)).collect::<Vec<f64>>());
    let signals = Signals::new(&times, &columns, Timing::Sample);
    let start = vec![0.0; model.states().len().min(3 + model.trailer_count())];
    (simulate_model(model, &signals, &times, &start, &Integrator::default()).unwrap(), columns)
}

/// What `discover` says of a log of that drive, the model being told nothing of what it lacks.
fn found(model: &Model, inputs: [fn(f64) -> f64; 2], text: &str, vehicles: &[Vehicle], library: &[Effect]) -> Report {
    let (table, columns) = driven(model, inputs);
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(3);
    let noise = rand_distr::Normal::new(0.0, 0.001).unwrap();
    let visible = 4 + model.trailer_count();
    let mut csv = format!("{},{}\n", table.names[..visible].join(","), model.inputs.join(","));
    for i in 0..table.rows() {
        let measured = (1..visible).map(|k| table.columns[k][i] + noise.sample(&mut random));
        let row: Vec<f64> =
            [table.columns[0][i]].into_iter().chain(measured).chain(columns.iter().map(|c| c[i])).collect();
        csv += &(row.iter().map(f64::to_string).collect::<Vec<_>>().join(",") + "\n");
    }
    let file = ModelFile::parse(text, "model.toml", &known_on(vehicles, library)).unwrap();
    let run = Run::parse("run.csv", &csv, &file).unwrap();
    let request = Request { file: &file, runs: &[run], held_out: &[], library, horizons: &[], seed: 0 };
    discover(&request, &unheard).unwrap().report
}

/// Demands that one effect is named, with one of its values near the truth.
fn names(report: &Report, id: &str, parameter: &str, truth: f64) {
    let ids: Vec<&str> = report.effects.iter().map(|e| e.id.as_str()).collect();
    assert_eq!((report.verdict, ids), (Verdict::MissingEffect, vec![id]), "{}", report.summary);
    let value = report.effects[0].parameters[parameter].value;
    assert!((value - truth).abs() < 0.05 * truth.abs(), "{parameter} = {value}, in truth {truth}");
}

#[test]
fn a_new_vehicle_is_described_simulated_verified_discovered_and_listed() {
    let bus = vehicle::bus();
    let model = Model::of(&bus, &BUS).unwrap();
    let said = describe::text(&Description::of(&model).unwrap());
    assert!(said.starts_with("# pushed-bus\n") && said.contains("rear section, trailer 1, direction"), "{said}");
    let (steady, _) = driven(&model, [|_| 0.2, |_| 4.0]);
    // On a circle the sections keep their angle: the tractrix of the joint around one centre.
    let [turn, joint, rear] = [5.9 / 0.2_f64.tan(), 1.65, 5.1];
    let behind = f64::sqrt(turn * turn + joint * joint - rear * rear);
    let angle = (joint / turn).atan() + (rear / behind).atan();
    let last = |name: &str| *steady.column(name).unwrap().last().unwrap();
    assert!((last("heading") - last("trailer_heading_1") - angle).abs() < 1e-3);
    assert!((last("speed") - 0.478 * 4.0 * turn / behind).abs() < 1e-3);
    let all = with(&bus);
    let text = "vehicle = \"pushed-bus\"\n[parameters]\nwheel_radius = 0.478\nwheelbase = 5.9\njoint_offset = 1.65\nrear_length = 5.1\n[columns]\ntrailer_headings = [\"trailer_heading_1\"]\n";
    let hidden =
        model.clone().with_effect(Applied::new(effects::named("trailer-length").unwrap(), Some(1), vec![0.04]));
    let inputs: [fn(f64) -> f64; 2] = [|t| 0.3 * (0.5 * t).sin() + 0.1, |t| 6.0 + 2.0 * (0.7 * t).sin()];
    names(&found(&hidden, inputs, text, &all, effects::all()), "trailer-length", "scale", 0.04);
    assert!(describe::vehicles_text(&all).unwrap().contains("\n## pushed-bus\n"));
    assert!(describe::vehicles_json(&all).unwrap().to_string().contains("\"id\":\"pushed-bus\""));
    assert!(vehicle_effects_text("pushed-bus", &all, effects::all()).unwrap().contains("# Effects on pushed-bus"));
    let told = claims::DerivedFormulas::of_vehicle(&bus, 1);
    assert!(told.formula("phi_2'").is_some());
}

#[test]
fn a_new_effect_is_described_simulated_verified_discovered_and_listed() {
    let library = effects::with(&[effect::yaw_slip()]);
    let own = library.last().unwrap();
    let bare = Model::new("unicycle", &[("wheel_radius", 0.1)]).unwrap();
    let model = bare.clone().with_effect(Applied::new(own, None, vec![0.12]));
    assert!(describe::text(&Description::of(&model).unwrap()).contains("v_t = v_n - yaw_slip.q*phi'*abs(phi')"));
    let (steady, _) = driven(&model, [|_| 10.0, |_| 0.5]);
    assert!((steady.column("lateral_speed").unwrap()[9] + 0.12 * 0.25).abs() < 1e-12);
    let machine = claims::DerivedFormulas::of_model(&model);
    let free = ["r", "theta'", "e_rc", "e_tc", "phi'", "yaw_slip.q"].map(|name| (name, Domain::Any));
    let slides = claims::Claim::new("slides", Status::Sampled, "what the effect does to v_t").sample(
        "at exact points",
        &[("v_t", "e_tc*v_l - yaw_slip.q*phi'*abs(phi')")],
        move |s, cases| claims::at_points(&machine, s, &free, cases),
    );
    let made = verify(&[slides], &Options::default(), &unheard).unwrap();
    assert!(made.all_earned(), "{}", ledger::text(&made));
    let inputs: [fn(f64) -> f64; 2] =
        [|t| 10.0 + 4.0 * (0.9 * t).sin(), |t| 0.9 * (0.5 * t).cos() + 0.4 * (0.23 * t).sin()];
    let text = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n";
    names(&found(&model, inputs, text, vehicles::all(), &library), "yaw-slip", "q", 0.12);
    // It applies to a vehicle that came after it, too.
    let listed = describe::effects_text(&with(&vehicle::bus()), &library).unwrap();
    let entry = listed.split("\n## ").find(|e| e.starts_with("yaw-slip\n")).unwrap();
    assert!(entry.contains("unicycle") && entry.contains("pushed-bus"), "{entry}");
}

#[test]
fn a_new_claim_is_verified_and_listed() {
    let all = [claims::all(), vec![claim::push(&vehicle::bus())]].concat();
    let own = all.last().unwrap();
    let made = verify(std::slice::from_ref(own), &Options::default(), &unheard).unwrap();
    let (noticed, sabotages) = made.kills();
    assert!(made.all_earned() && noticed == sabotages && sabotages > 10, "{}", ledger::text(&made));
    assert!(ledger::text(&made).starts_with("proved     bus-push\n"));
    assert!(ledger::claims_text(&all).contains("bus-push"));
    assert!(ledger::contents(&all).contains("| CONTRIBUTING, a new claim | `bus-push` (proved) |"));
    // What is false of it is not earned.
    let mut slip = own.clone();
    slip.evidence[0].equations[0].1 = "r*theta'/2".into();
    assert!(!verify(&[slip], &Options::default(), &unheard).unwrap().all_earned());
}

#[test]
fn a_new_type_of_constraint_is_described_simulated_verified_discovered_and_listed() {
    let cart = constraint::rope_cart();
    let model = Model::of(&cart, &[("drum_radius", 0.1)]).unwrap();
    let description = Description::of(&model).unwrap();
    assert_eq!(description.signature.to_string(), "T C");
    let said = describe::text(&description);
    assert!(said.contains("pays' - (1 - e)*drum*turns' = 0"), "{said}");
    let (steady, _) = driven(&model, [|_| 8.0, |_| 0.0]);
    assert!((steady.column("x").unwrap().last().unwrap() - 0.8 * 29.96).abs() < 1e-9);
    let machine = claims::DerivedFormulas::of_vehicle(&cart, 0);
    let statement = claims::Statement::parse(&[("v_l", "drum_radius*theta'*(1 - e_rc)")]).unwrap();
    assert!(claims::prove(&machine.clone().with_text("e_tc", "0"), &statement).holds());
    let all = with(&cart);
    let slips = model.with_effect(Applied::new(effects::named("rotation-creep").unwrap(), None, vec![0.05]));
    let text = "vehicle = \"rope-cart\"\n[parameters]\ndrum_radius = 0.1\n";
    let inputs: [fn(f64) -> f64; 2] = [|t| 8.0 + 3.0 * (0.8 * t).sin(), |t| 0.7 * (0.5 * t).cos()];
    names(&found(&slips, inputs, text, &all, effects::all()), "rotation-creep", "e_rc", 0.05);
    let listed = describe::vehicles_text(&all).unwrap();
    assert!(listed.contains("\n## rope-cart\n") && listed.contains("rope (type C, e_rc)"), "{listed}");
}
