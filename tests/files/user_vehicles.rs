//! A user's own vehicles: refused with a place and advice, or as good as the catalogue's.

use crate::bad_vehicles::{BAD_CONSTRAINTS, BAD_MODELS, BAD_VEHICLES, GOOD, ROPE};
use crate::models::{effect, instant, situation};
use crate::program::{creepage, stderr};
use crate::simulator::{Hidden, Noise, Scenario, Tractor, Vehicle as Simulated};
use crate::slips;
use crate::support::check;
use creepage::describe::{self, Description};
use creepage::effects;
use creepage::extensions::vehicles_with_own;
use creepage::formula::{Expr, Symbol};
use creepage::model::{Model, Trailer};
use creepage::vehicles::{self, Definition, Quantity, Section, Vehicle, Wheel};
use proptest::prelude::*;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Output;

const BUS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/bus/bus.toml");

fn stdout(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// The vehicles with a file of this text, or the message without the name of the file.
fn read(text: &[u8]) -> Result<Vec<Vehicle>, String> {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("mine.toml");
    std::fs::write(&path, text).unwrap();
    vehicles_with_own(&path).map_err(|e| {
        assert_eq!(e.exit_code(), 2, "{e}");
        let message = e.to_string();
        message.strip_prefix(&format!("{}:", path.display())).unwrap_or_else(|| panic!("{message}")).to_string()
    })
}

fn edited(text: &str, edits: &[(&str, &str)], name: &str) -> String {
    edits.iter().fold(text.to_string(), |text, (from, to)| {
        assert!(text.contains(from), "{name}: {from}");
        text.replacen(from, to, 1)
    })
}

#[test]
fn every_bad_file_is_explained_at_its_place() {
    assert_eq!(read(GOOD.as_bytes()).unwrap().last().unwrap().id, "my-cart");
    assert_eq!(read(ROPE.as_bytes()).unwrap().last().unwrap().id, "rope-cart");
    let mut failures = Vec::new();
    let all = BAD_VEHICLES.iter().map(|c| (GOOD, c)).chain(BAD_CONSTRAINTS.iter().map(|c| (ROPE, c)));
    for (good, case) in all {
        match read(edited(good, case.edits, case.name).as_bytes()) {
            Ok(_) => failures.push(format!("{}: accepted", case.name)),
            Err(message) if message == case.expect => {}
            Err(message) => failures.push(format!("{}: {message}", case.name)),
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// What the advice says is enough.
#[test]
fn a_steered_wheel_with_a_trail_moves_by_the_rate_of_its_angle() {
    let edits = [
        ("steering = \"delta\"\n", "steering = \"delta\"\ntrail = \"L/9\"\n"),
        (
            "[vehicle.define]\n",
            "[vehicle.inputs.steering_rate]\nunit = \"rad/s\"\nmeaning = \"its rate\"\n[vehicle.define]\n",
        ),
        (
            "[[vehicle.wheels]]",
            "\"delta'\" = { formula = \"steering_rate\", unit = \"rad/s\", meaning = \"rate\" }\n[[vehicle.wheels]]",
        ),
    ];
    let cart = read(edited(GOOD, &edits, "trail").as_bytes()).unwrap().into_iter().find(|v| v.id == "my-cart").unwrap();
    let model = Model::sample(&cart).unwrap();
    let (delta, rate) = (0.3f64, 0.7);
    let mut at = situation(&model, &[0.0]);
    at.extend([("steering_angle", delta), ("steering_rate", rate), ("wheel_rate", 2.0)].map(|(s, v)| (s.into(), v)));
    // Every length is a metre: the contact is a ninth of one behind its axis, which is one ahead of the rear axle.
    let trail = 1.0 / 9.0;
    let yaw_rate = (2.0 * delta.sin() + trail * rate) / (delta.cos() - trail);
    let found = instant(&model, &at)[&Symbol::new("phi'")];
    assert!((found - yaw_rate).abs() < 1e-12, "{found} {yaw_rate}");
}

#[test]
fn files_that_are_no_text_or_too_large_are_refused() {
    assert_eq!(read(b"").unwrap_err(), " is empty; check that this is the file you meant");
    assert!(read(b"\x7fELF\0\0").unwrap_err().contains("is a binary file"));
    let long = format!("{GOOD}{}", "# \n".repeat(100_000));
    let why = " is larger than 256 KiB; check that this is the file of vehicles you meant";
    assert_eq!(read(long.as_bytes()).unwrap_err(), why);
    let many: String = (0..21).map(|i| GOOD.replace("my-cart", &format!("cart-{i}"))).collect();
    assert_eq!(read(many.as_bytes()).unwrap_err(), "1:1: vehicle has 21 entries; give at most 20");
    let wheel = "[[vehicle.wheels]]\nname = \"axle N\"\ntraverse_creep = \"e_f\"\n";
    let wheels: String = (0..40).map(|i| wheel.replace('N', &i.to_string())).collect();
    assert_eq!(
        read((GOOD.to_string() + &wheels).as_bytes()).unwrap_err(),
        "26:1: wheels has 43 entries; give at most 40"
    );
}

#[test]
fn every_command_refuses_a_bad_file_and_writes_nothing() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("model.toml"), "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n")
        .unwrap();
    std::fs::write(dir.path().join("run.csv"), "time,x,y,heading,wheel_rate,yaw_rate\n0,0,0,0,1,0\n1,1,0,0,1,0\n")
        .unwrap();
    std::fs::write(
        dir.path().join("claims.toml"),
        "[[claim]]\nid = \"a\"\nstatus = \"proved\"\nequations = [\"a = a\"]\n",
    )
    .unwrap();
    std::fs::write(dir.path().join("bad.toml"), GOOD.replace("left = \"L/4\"", "left = \"L/\"")).unwrap();
    for arguments in [
        &["discover", "run.csv", "--model", "model.toml", "--out", "report"][..],
        &["simulate", "model.toml", "--inputs", "run.csv", "--out", "out.csv"],
        &["describe", "model.toml"],
        &["effects"],
        &["vehicles"],
        &["verify", "--claims", "claims.toml", "a"],
        &["claims"],
    ] {
        let output = creepage(dir.path(), &[arguments, &["--vehicles", "bad.toml"]].concat());
        let expect = "creepage: bad.toml:40:11: expected a number, a name or \"(\", found the end\n  L/\n    ^\n";
        assert_eq!((output.status.code(), stderr(&output).as_str()), (Some(2), expect), "{arguments:?}");
        assert!(output.stdout.is_empty());
    }
    assert!(!dir.path().join("report").exists() && !dir.path().join("out.csv").exists());
}

#[test]
fn every_bad_model_of_an_own_vehicle_is_explained_at_its_place() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::create_dir(dir.path().join("folder")).unwrap();
    std::fs::copy(BUS, dir.path().join("bus.toml")).unwrap();
    std::fs::write(dir.path().join("broken.toml"), "[[vehicle]]\n").unwrap();
    let good = include_str!("../../examples/bus/model.toml");
    let describe = |text: &str| {
        std::fs::write(dir.path().join("model.toml"), text).unwrap();
        creepage(dir.path(), &["describe", "model.toml"])
    };
    stdout(&describe(good));
    for case in BAD_MODELS {
        let output = describe(&edited(good, case.edits, case.name));
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{}: {message}", case.name);
        assert_eq!(message.trim_end(), format!("creepage: {}", case.expect), "{}", case.name);
    }
}

#[test]
fn the_vehicles_of_the_catalogue_pass_the_checks_of_a_users_own() {
    let blocks: Vec<&str> = include_str!("../../src/vehicles/catalogue.toml").split("\n[[vehicle]]").skip(1).collect();
    assert_eq!(blocks.len(), vehicles::all().len());
    for (block, original) in blocks.iter().zip(vehicles::all()) {
        let own = read(format!("[[vehicle]]{}", block.replacen("id = \"", "id = \"my-", 1)).as_bytes()).unwrap();
        let own = own.last().unwrap();
        let same = Vehicle { id: original.id.clone(), origin: None, ..own.clone() };
        assert_eq!((own.id.strip_prefix("my-"), &same), (Some(original.id.as_str()), original));
    }
}

#[test]
fn the_vehicle_of_the_guide_is_a_car() {
    let guide = include_str!("../../book/src/guide/vehicles.md");
    let start = guide.find("[[vehicle]] ").unwrap();
    let text = &guide[start..start + guide[start..].find("```").unwrap()];
    let scooter = read(text.as_bytes()).unwrap().pop().unwrap();
    let rows = |v: &Vehicle| Model::sample(v).unwrap().constraints().iter().map(|c| c.row()).collect::<Vec<_>>();
    assert_eq!((scooter.id.as_str(), rows(&scooter)), ("scooter", rows(vehicles::named("car").unwrap())));
}

fn bus() -> Vehicle {
    vehicles_with_own(BUS).unwrap().into_iter().find(|v| v.id == "articulated-bus").unwrap()
}

#[test]
fn a_bus_is_a_car_with_a_trailer() {
    let lengths = [("wheel_radius", 0.478), ("wheelbase", 5.9), ("joint_offset", 1.65), ("rear_length", 5.1)];
    let behind = [Trailer { length: 4.0, hitch: 0.3 }];
    let whole = Model::of(&bus(), &lengths).unwrap().with_trailers(&behind);
    let pieces = [Trailer { length: 5.1, hitch: 1.65 }, behind[0]];
    let pieces = Model::new("car", &lengths[..2]).unwrap().with_trailers(&pieces);
    assert_eq!(whole.states(), pieces.states());
    let rows = |m: &Model| m.constraints().iter().map(|c| c.row().to_string()).collect::<Vec<_>>();
    assert_eq!(rows(&whole), rows(&pieces));
    assert_eq!(whole.constraints()[3].name, "rear section, trailer 1, direction");
    let ids = |m: &Model| m.applicable(effects::all()).iter().map(|(e, t)| (e.id.clone(), *t)).collect::<Vec<_>>();
    assert_eq!(ids(&whole), ids(&pieces));
    let creeps = |m: Model| {
        m.with_effect(effect("trailer-length", Some(1), &[0.02]))
            .with_effect(effect("hitch-offset", Some(2), &[0.1]))
            .with_effect(effect("trailer-traverse-creep", Some(2), &[0.05]))
            .with_effect(effect("cornering-creep", None, &[0.2]))
    };
    let (whole, pieces) = (creeps(whole), creeps(pieces));
    for k in 0..20 {
        let numbers: Vec<f64> = (0..12).map(|i| f64::sin(f64::from(7 * k + i))).collect();
        let mut given = situation(&whole, &numbers);
        given.insert("cornering_creep.w".into(), 0.1);
        let (a, b) = (instant(&whole, &given), instant(&pieces, &given));
        for name in ["x'", "y'", "phi'", "phi_1'", "phi_2'", "v_2", "d_1", "c_1", "c_2"] {
            assert_eq!(a[&name.into()], b[&name.into()], "{name}");
        }
    }
}

fn quantity(unit: &str) -> Quantity {
    Quantity { unit: unit.into(), meaning: "…".into(), optional: false }
}

/// A car with so many trailers of its own, driven on one of them, the body being 0.
fn driven_on(section: usize, trailers: usize) -> Vehicle {
    let mut chain = vehicles::named("car").unwrap().clone();
    chain.id = "chain".into();
    for i in 1..=trailers {
        let [length, hitch] = ["length", "hitch"].map(|stem| format!("{stem}_{i}"));
        let part = Section { name: format!("section {i}"), length: Expr::sym(&*length), hitch: Expr::sym(&*hitch) };
        chain.trailers.push(part);
        chain.parameters.extend([(length, quantity("m")), (hitch, quantity("m"))]);
    }
    if section > 0 {
        let body = &mut chain.wheels[0];
        let roll = Wheel {
            name: "driven wheel".into(),
            on: Some(format!("section {section}")),
            radius: body.radius.take(),
            rate: body.rate.take(),
            rotation_creep: body.rotation_creep.take(),
            ..Wheel::default()
        };
        chain.wheels.push(roll);
    }
    chain
}

#[test]
fn a_driven_trailer_moves_the_train_as_a_driven_body_does() {
    let numbers = prop::collection::vec(-1.0..1.0f64, 30);
    let lengths = prop::collection::vec((0.5..4.0f64, -1.0..1.0f64), 1..=4);
    check(150, (numbers, lengths, 0..4usize, -0.3..0.3f64), |(numbers, lengths, on, e)| {
        let (n, on) = (lengths.len(), on % lengths.len() + 1);
        let mut given: Vec<(String, f64)> = vec![("wheel_radius".into(), 0.4), ("wheelbase".into(), 3.0)];
        for (i, (length, hitch)) in (1..).zip(&lengths) {
            given.extend([(format!("length_{i}"), *length), (format!("hitch_{i}"), *hitch)]);
        }
        let given: Vec<(&str, f64)> = given.iter().map(|(k, v)| (k.as_str(), *v)).collect();
        let model = |section: usize| {
            let mut m = Model::of(&driven_on(section, n), &given).unwrap();
            for (id, x) in [("rotation-creep", e), ("traverse-creep", 0.2 * numbers[0]), ("front-traverse-creep", 0.1)]
            {
                m = m.with_effect(effect(id, None, &[x]));
            }
            (1..=n).fold(m, |m, i| m.with_effect(effect("trailer-traverse-creep", Some(i), &[0.3 * numbers[i]])))
        };
        let (pulled, pushed) = (model(0), model(on));
        let mut at = situation(&pulled, &numbers);
        // Joints bend by less than a right angle, so that a push is felt.
        for i in 1..=n {
            let heading = |i: usize| Symbol::new(&if i == 0 { "phi".to_string() } else { format!("phi_{i}") });
            at.insert(heading(i), at[&heading(i - 1)] + numbers[10 + i]);
        }
        let a = instant(&pulled, &at);
        let speed = a[&Symbol::new(&format!("v_{on}"))];
        if speed.abs() < 0.05 * a[&"v_l".into()].abs() {
            return Ok(());
        }
        at.insert("wheel_rate".into(), speed / (0.4 * (1.0 - e)));
        let b = instant(&pushed, &at);
        for name in
            ["x'", "y'", "phi'", "v_l"].map(String::from).into_iter().chain((1..=n).map(|i| format!("phi_{i}'")))
        {
            let (x, y) = (a[&Symbol::new(&name)], b[&Symbol::new(&name)]);
            prop_assert!((x - y).abs() <= 1e-9 * (1.0 + x.abs()), "{} {} {}", name, x, y);
        }
        Ok(())
    });
}

#[test]
fn a_passive_wheel_on_a_trailer_follows_its_motion() {
    let mut chain = driven_on(0, 1);
    let define = |unit: &str, formula: &str| Definition {
        formula: Expr::parse(formula).unwrap(),
        unit: unit.into(),
        meaning: "…".into(),
    };
    chain.define.insert("b".into(), define("m", "length_1/4"));
    chain.wheels.push(Wheel {
        name: "left rear wheel".into(),
        on: Some("section 1".into()),
        left: Expr::sym("b"),
        radius: Some("r".into()),
        rate: Some("theta_c'".into()),
        rotation_creep: Some("e_rc_c".into()),
        ..Wheel::default()
    });
    let given = [("wheel_radius", 0.4), ("wheelbase", 3.0), ("length_1", 2.0), ("hitch_1", 0.5)];
    let model = Model::of(&chain, &given).unwrap();
    let m = instant(&model, &situation(&model, &[0.3, -0.8, 0.5, 0.9]));
    let get = |name: &str| m[&Symbol::new(name)];
    // The contact half a metre to the left of the axle, by hand.
    let rate = (get("v_1") - 0.5 * get("phi_1'")) / 0.4;
    assert!((get("theta_c'") - rate).abs() < 1e-12 && rate.abs() > 0.1, "{rate}");
}

/// A run of the independent simulator, and a model that calls the train a bus.
fn files(dir: &Path) {
    let vehicle = Simulated::NTrailer { tractor: Tractor::Car, lengths: vec![3.0], hitch_offsets: vec![0.6] };
    let hidden = vec![Hidden::TrailerTraverseCreep { trailer: 1, e_tc: 0.05 }];
    let scenario = Scenario { hidden, duration: 40.0, noise: Noise::MOCAP, ..Scenario::new(vehicle, 5) };
    let train = scenario.model_toml();
    let lines = |line: &str| match line.split(' ').next() {
        Some("vehicle") => "vehicles = \"../mine/bus.toml\"\nvehicle = \"articulated-bus\" # mine".to_string(),
        Some("tractor") => String::new(),
        Some("trailer_lengths") => "rear_length = 3.0".into(),
        Some("hitch_offsets") => "joint_offset = 0.6".into(),
        _ => line.to_string(),
    };
    let model: Vec<String> = train.lines().map(lines).collect();
    for folder in ["mine", "models", "elsewhere"] {
        std::fs::create_dir(dir.join(folder)).unwrap();
    }
    std::fs::copy(BUS, dir.join("mine/bus.toml")).unwrap();
    std::fs::write(dir.join("models/model.toml"), model.join("\n")).unwrap();
    scenario.run().write_csv(dir.join("run.csv")).unwrap();
}

fn report(dir: &Path, model: &str, out: &str) -> Value {
    stdout(&creepage(dir, &["discover", "run.csv", "--model", model, "--out", out]));
    serde_json::from_slice(&std::fs::read(dir.join(out).join("report.json")).unwrap()).unwrap()
}

#[test]
fn a_vehicle_of_the_users_own_is_known_to_every_command() {
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    files(dir);
    let first = report(dir, "models/model.toml", "report");
    let found: Vec<&str> = first["effects"].as_array().unwrap().iter().map(|e| e["id"].as_str().unwrap()).collect();
    assert_eq!((&first["verdict"], found), (&"missing-effect".into(), vec!["trailer-traverse-creep"]), "{first:#}");
    let e_tc = first["effects"][0]["parameters"]["e_tc"]["value"].as_f64().unwrap();
    assert!((e_tc - 0.05).abs() < 0.003, "{e_tc}");
    let hash = first["provenance"]["inputs_sha256"]["models/../mine/bus.toml"].as_str().unwrap();
    assert!(hash.len() == 64 && hash.chars().all(|c| c.is_ascii_hexdigit()));
    // The report folder stands for itself, wherever it goes.
    std::fs::rename(dir.join("report"), dir.join("elsewhere/report")).unwrap();
    std::fs::remove_file(dir.join("mine/bus.toml")).unwrap();
    let patched = "elsewhere/report/model.patched.toml";
    let text = std::fs::read_to_string(dir.join(patched)).unwrap();
    assert!(text.starts_with("vehicles = \"model.vehicles.toml\"\nvehicle = \"articulated-bus\" # mine\n"), "{text}");
    assert_eq!(report(dir, patched, "again")["verdict"], "no-missing-effect");
    let again = std::fs::read_to_string(dir.join("again/model.vehicles.toml")).unwrap();
    assert_eq!(again, std::fs::read_to_string(BUS).unwrap());
    let said = stdout(&creepage(dir, &["describe", patched]));
    assert!(said.starts_with("# articulated-bus\n") && said.contains("trailer-traverse-creep (trailer 1)"), "{said}");
    stdout(&creepage(dir, &["simulate", patched, "--inputs", "run.csv", "--out", "out.csv"]));
    let header = std::fs::read_to_string(dir.join("out.csv")).unwrap();
    assert!(header.starts_with("time,x,y,heading,trailer_heading_1,speed,"), "{header}");
    // Without the file the model says what it lacks.
    std::fs::remove_file(dir.join("elsewhere/report/model.vehicles.toml")).unwrap();
    for arguments in [&["describe", patched][..], &["discover", "run.csv", "--model", patched]] {
        let output = creepage(dir, arguments);
        let expect = format!("creepage: {patched}:1:12: no file of vehicles is at ");
        assert!(output.status.code() == Some(2) && stderr(&output).starts_with(&expect), "{}", stderr(&output));
    }
}

#[test]
fn the_lists_and_claims_know_a_users_vehicles() {
    let dir = Path::new(env!("CARGO_MANIFEST_DIR"));
    let own = ["--vehicles", BUS];
    let list = stdout(&creepage(dir, &[&["vehicles"][..], &own].concat()));
    assert!(
        list.contains("\n## pusher-bus\n")
            && list.contains("- trailer 1: rear section, rear_length from hitch to axle")
    );
    let json = stdout(&creepage(dir, &[&["vehicles", "--format", "json"][..], &own].concat()));
    let json: Value = serde_json::from_str(&json).unwrap();
    let bus = json["vehicles"].as_array().unwrap().iter().find(|v| v["id"] == "articulated-bus").unwrap();
    assert_eq!(bus["trailers"][0]["hitch"], "joint_offset");
    assert!(json["vehicles"].as_array().unwrap().last().unwrap().to_string().contains("pusher-bus"), "as a tractor");
    let effects = stdout(&creepage(dir, &[&["effects"][..], &own].concat()));
    let wheelbase = effects.split("\n## ").find(|e| e.starts_with("wheelbase\n")).unwrap();
    assert!(wheelbase.contains("articulated-bus") && wheelbase.contains("pusher-bus"), "{wheelbase}");
    let on = stdout(&creepage(dir, &[&["effects", "--vehicle", "pusher-bus"][..], &own].concat()));
    assert!(on.contains("## trailer-traverse-creep (trailer 1)"), "{on}");
    let claims = ["--claims", "examples/bus/claims.toml"];
    let ledger = stdout(&creepage(dir, &[&["verify", "bus-front", "bus-joint"][..], &claims, &own].concat()));
    assert!(ledger.contains("2 claims: 1 proved, 0 sampled, 1 corrected"), "{ledger}");
    let output = creepage(dir, &[&["verify", "bus-front"][..], &claims].concat());
    assert!(output.status.code() == Some(2) && stderr(&output).contains("no vehicle is called \"articulated-bus\""));
}

#[test]
fn the_command_line_is_asked_before_the_model() {
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    std::fs::copy(BUS, dir.join("bus.toml")).unwrap();
    std::fs::write(dir.join("model.toml"), include_str!("../../examples/bus/model.toml")).unwrap();
    let other = std::fs::read_to_string(BUS).unwrap().replace("two sections: front", "my other bus: front");
    std::fs::write(dir.join("other.toml"), other).unwrap();
    let titled = |arguments: &[&str]| stdout(&creepage(dir, arguments)).lines().nth(2).unwrap().to_string();
    assert!(titled(&["describe", "model.toml"]).starts_with("two sections"));
    assert!(titled(&["describe", "model.toml", "--vehicles", "other.toml"]).starts_with("my other bus"));
    // What only the model's file has is still known.
    let cart = GOOD.to_string();
    std::fs::write(dir.join("cart.toml"), cart).unwrap();
    assert!(titled(&["describe", "model.toml", "--vehicles", "cart.toml"]).starts_with("two sections"));
    // A bus may pull, too.
    let train = "vehicle = \"n-trailer\"\nvehicles = \"bus.toml\"\ntractor = \"pusher-bus\"\n[parameters]\nwheel_radius = 0.5\nwheelbase = 6\njoint_offset = 1\nrear_length = 5\ntrailer_lengths = [3.0]\n[columns]\ntrailer_headings = [\"a\", \"b\"]\n";
    std::fs::write(dir.join("train.toml"), train).unwrap();
    let said = stdout(&creepage(dir, &["describe", "train.toml"]));
    assert!(said.contains("coordinates: x, y, phi, theta, phi_1, phi_2") && said.contains("pusher-bus with 1 trailer"));
}

#[test]
fn an_effect_of_the_users_own_may_speak_of_the_users_own_vehicle() {
    let dir = tempfile::tempdir().unwrap();
    let dir = dir.path();
    std::fs::write(dir.join("cart.toml"), GOOD).unwrap();
    let effect = "[[effect]]\nid = \"soft\"\nwhere = \"castor\"\nsays = \"the body leans\"\n[effect.parameters.k]\nunit = \"1\"\nrange = [-1, 1]\nsize = 0.1\n[effect.changes]\nm_c = \"it*(1 + k)\"\n";
    let cart = GOOD.replace(
        "[vehicle.define]",
        "[vehicle.define]\nm_c = { formula = \"wheelbase\", unit = \"m\", meaning = \"base\" }",
    );
    let cart = cart.replace(
        "formula = \"wheelbase\", unit = \"m\", meaning = \"wheelbase\"",
        "formula = \"m_c\", unit = \"m\", meaning = \"wheelbase\"",
    );
    std::fs::write(dir.join("own.toml"), cart).unwrap();
    std::fs::write(dir.join("effect.toml"), effect).unwrap();
    let all = ["effects", "--effects", "effect.toml", "--vehicles", "own.toml"];
    assert!(stdout(&creepage(dir, &all)).contains("- vehicles: my-cart, n-trailer\n"));
    let output = creepage(dir, &["effects", "--effects", "effect.toml", "--vehicles", "cart.toml"]);
    assert!(
        stderr(&output).starts_with("creepage: effect.toml:10:1: no vehicle defines \"m_c\""),
        "{}",
        stderr(&output)
    );
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 120, ..Default::default() })]

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        prop_assert!(read(&bytes).is_err());
    }

    #[test]
    fn damaged_files_are_refused_or_can_be_used(
        good in prop::sample::select(vec![GOOD, ROPE]),
        slips in prop::collection::vec(slips::slip(), 1..5),
    ) {
        if let Ok(vehicles) = read(&slips::damage(good.as_bytes(), &slips)) {
            let own = vehicles.last().unwrap();
            let model = Model::sample(own).unwrap();
            prop_assert!(!describe::latex(&Description::of(&model).unwrap()).is_empty());
            prop_assert!(own.instead.is_some() || model.equations(&[]).is_ok());
            for (e, t) in model.applicable(effects::all()) {
                let values: BTreeMap<_, _> = e.parameters.iter().map(|(k, p)| (k, p.size)).collect();
                let applied = effects::Applied::new(e, t, values.into_values().collect());
                prop_assert!(Description::of(&model.clone().with_effect(applied)).is_ok());
            }
        }
    }
}
