//! Find, patch, plan, drive: a car whose creep comes from forces is parked by the model that its logs corrected.

use crate::forces::{Contact, Grip, Inputs, Law, Machine, Solid, State, Wave, Wheel, advance, begun};
use creepage::discrepancy::discover::discover;
use creepage::discrepancy::request::Request;
use creepage::dynamics;
use creepage::effects;
use creepage::files::{ModelFile, Run};
use creepage::model::Model;
use creepage::motion::Timing;
use creepage::planning::{Executed, Plan, Task, execute, plan};
use creepage::progress::unheard;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::StandardNormal;
use std::fmt::Write;
use std::path::Path;

const RADIUS: f64 = 0.3;
const BASE: f64 = 2.6;
/// Rows this far apart, s.
const STEP: f64 = 0.04;
/// The rear wheels point this far to the left of the body, rad.
const TOE: f64 = -0.05;
/// A wheel so heavy that the ground does not change how fast it turns, kg·m².
const FLYWHEEL: f64 = 1e9;
const GOAL: (f64, f64, Option<f64>) = (-6.5, -2.6, Some(0.0));

/// A car on tyres that push by how fast they slip sideways, its rear axle out of line.
fn car() -> Machine {
    let side = |b: f64| Some(Grip::of(Law::Viscous(b)));
    let rear =
        Contact { body: 0, at: [0.0; 2], steered: Some(2), rolls: Some((0, Grip::of(Law::Ideal))), side: side(25e3) };
    let front = Contact { body: 0, at: [BASE, 0.0], steered: Some(1), rolls: None, side: side(20e3) };
    let wheel = Wheel {
        radius: RADIUS,
        inertia: FLYWHEEL,
        input: Some(0),
        gain: FLYWHEEL,
        viscous: 0.0,
        coulomb: 0.0,
        play: 0.0,
    };
    let body = Solid { mass: 1200.0, inertia: 1700.0, centre: [1.2, 0.0] };
    Machine::of(vec![body], vec![wheel], vec![rear, front], vec![])
}

/// A wheel rate and a steering angle with their slopes, as functions of time.
type Command<'c> = &'c dyn Fn(f64) -> [[f64; 2]; 2];

/// Drives the car from the origin, and says where it is at some times.
fn driven(command: Command, times: &[f64]) -> Vec<[f64; 3]> {
    let machine = car();
    let signal = |t: f64| {
        let [[_, push], [angle, turn]] = command(t);
        (vec![push, angle, TOE], vec![0.0, turn, 0.0])
    };
    let first = command(times[0])[0][0];
    let mut state: State = begun(&machine, RADIUS * first);
    let (u, rate) = signal(times[0]);
    machine.project(&mut state, &Inputs { u: &u, rate: &rate });
    let mut found = Vec::new();
    for (i, t) in times.iter().enumerate() {
        if i > 0 {
            advance(&machine, &mut state, times[i - 1], *t, &signal);
        }
        let [x, y] = machine.place(&state, 0);
        found.push([x, y, state.place[2]]);
    }
    found
}

/// A log of a drive ahead and back at the speeds of a car park.
fn log(seed: u64) -> String {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let [roll, steer] = [4.0, 0.35].map(|size| Wave::drawn(&mut random, size));
    let command = |t: f64| {
        let [rate, push] = roll.at(t);
        [[rate, push], steer.at(t)]
    };
    let times: Vec<f64> = (0..=1000).map(|i| STEP * f64::from(i)).collect();
    let mut csv = String::from("time,wheel_rate,steering_angle,x,y,heading\n");
    for (t, [x, y, heading]) in times.iter().zip(driven(&command, &times)) {
        let mut noisy = |value: f64| value + 0.002 * random.sample::<f64, _>(StandardNormal);
        let [[rate, _], [angle, _]] = command(*t);
        writeln!(csv, "{t:.3},{rate:.9},{angle:.9},{:.6},{:.6},{:.6}", noisy(x), noisy(y), noisy(heading)).unwrap();
    }
    csv
}

/// Where a plan leads the car of forces.
fn parked(plan: &Plan, inputs: &[String]) -> [f64; 3] {
    let of = |role: &str| inputs.iter().position(|input| input == role).unwrap();
    let order = ["wheel_rate", "steering_angle"].map(of);
    let at = |input: usize, t: f64| plan.spline.at(&plan.coefficients[input], (t / plan.duration).clamp(0.0, 1.0));
    let slope = |input: usize, t: f64| (at(input, t + 1e-5) - at(input, t - 1e-5)) / 2e-5;
    let command = |t: f64| order.map(|input| [at(input, t), slope(input, t)]);
    let rows = (plan.duration / STEP).ceil();
    let times: Vec<f64> = (0..=rows as usize).map(|i| plan.duration * i as f64 / rows).collect();
    *driven(&command, &times).last().unwrap()
}

fn model_of(text: &str, folder: &Path) -> (ModelFile, Model) {
    let file = ModelFile::parse(text, folder.join("model.toml"), &dynamics::known(effects::all())).unwrap();
    let model = Model::of_file(&file, effects::all()).unwrap();
    (file, model)
}

/// The ideal plan misses by decimetres. The one made on the model that two logs corrected misses by no more than that model errs
/// on the drive of the ideal plan, in a simulator that knows forces and no creep.
#[test]
fn a_car_is_parked_by_what_its_logs_showed() {
    let folder = tempfile::tempdir().unwrap();
    let believed = format!("vehicle = \"car\"\n[parameters]\nwheel_radius = {RADIUS:?}\nwheelbase = {BASE:?}\n");
    let (file, ideal) = model_of(&believed, folder.path());
    let runs = [1].map(|seed| {
        let path = folder.path().join(format!("run_{seed}.csv"));
        std::fs::write(&path, log(seed)).unwrap();
        Run::read(path, &file).unwrap()
    });
    let request = Request { file: &file, runs: &runs, held_out: &[], library: effects::all(), horizons: &[], seed: 0 };
    let found = discover(&request, &unheard).unwrap();
    let named: Vec<&str> = found.report.effects.iter().map(|e| e.id.as_str()).collect();
    assert!(named.contains(&"traverse-creep") && named.contains(&"cornering-creep"), "{named:?}");
    let (_, patched) = model_of(&found.patched(&file), folder.path());

    let task = Task::from_origin(&ideal, vec![GOAL], 16);
    let [without, with] = [&ideal, &patched].map(|model| plan(model, &task, &unheard).unwrap().unwrap());
    let missed = |plan: &Plan| {
        let [x, y, _] = parked(plan, &ideal.inputs);
        (x - GOAL.0).hypot(y - GOAL.1)
    };
    let said = |plan: &Plan| -> Executed { execute(plan, &task, &patched, Timing::Sample).unwrap() };
    let [x, y, _] = parked(&without, &ideal.inputs);
    let there = said(&without).end;
    let error = (there[0] - x).hypot(there[1] - y);
    println!(
        "{named:?}: ideal plan misses by {:.3} m, corrected by {:.4} m (promised {:.1e} m), the model errs by {error:.4} m",
        missed(&without),
        missed(&with),
        said(&with).miss
    );
    assert!(said(&with).miss < 1e-3);
    assert!(missed(&without) > 0.3, "{}", missed(&without));
    assert!(missed(&with) < error.max(0.002) && missed(&with) < 0.1 * missed(&without), "{} {error}", missed(&with));
}
