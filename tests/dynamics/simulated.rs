//! The independent simulator of forces against the library, and against what no force can change.

use crate::forces::{Drawn, Inputs, MAKES, Make, Secret, State, Wave, advance, begun};
use creepage::dynamics::{known, simulate_file};
use creepage::effects;
use creepage::files::{Initial, ModelFile};
use creepage::model::Model;
use creepage::motion::{Integrator, Method, Signals, Timing};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

const SECONDS: f64 = 4.0;

/// Where a machine is after some seconds by the simulator: place and headings of its reference points.
fn simulated(drawn: &Drawn, waves: &[Wave]) -> (State, Vec<f64>) {
    let machine = &drawn.machine;
    let inputs = |t: f64| -> (Vec<f64>, Vec<f64>) { waves.iter().map(|w| w.at(t)).map(|[u, v]| (u, v)).unzip() };
    let mut state = begun(machine, drawn.speed);
    let (u, rate) = inputs(0.0);
    machine.project(&mut state, &Inputs { u: &u, rate: &rate });
    advance(machine, &mut state, 0.0, SECONDS, &inputs);
    let [x, y] = machine.place(&state, 0);
    let headings = (0..machine.solids.len()).map(|i| state.place[3 * i + 2]);
    let found = [x, y].into_iter().chain(headings).collect();
    (state, found)
}

/// The same by the library, from the model file.
fn by_library(drawn: &Drawn, waves: &[Wave]) -> Vec<f64> {
    let speed = format!("{}[initial]\nx = 0.0\ny = 0.0\nheading = 0.0\nspeed = {:?}\n", drawn.model, drawn.speed);
    let turning = "lateral_speed = 0.0\nyaw_rate = 0.0\n";
    let file = ModelFile::parse(&format!("{speed}{turning}"), "model.toml", &known(effects::all())).unwrap();
    let order: Vec<usize> = file.columns.inputs.iter().map(|i| place(drawn, &i.role)).collect();
    let time: Vec<f64> = (0..=8000).map(|i| SECONDS * f64::from(i) / 8000.0).collect();
    let column = |k: &usize| time.iter().map(|t| waves[*k].at(*t)[0]).collect::<Vec<f64>>();
    let columns: Vec<Vec<f64>> = order.iter().map(column).collect();
    let signals = Signals::new(&time, &columns, Timing::Sample);
    let trailers = drawn.machine.solids.len() - 1;
    let pose = Initial { trailer_headings: vec![0.0; trailers], ..Initial::default() };
    let run = simulate_file(&file, &signals, &[0.0, SECONDS], &pose, &Integrator::default()).unwrap();
    let names = (1..=trailers).map(|i| format!("trailer_heading_{i}"));
    let all = ["x", "y", "heading"].map(String::from).into_iter().chain(names);
    all.map(|name| *run.column(&name).unwrap().last().unwrap()).collect()
}

/// The same with effects, by the equations that are fitted: wheels roll, and nothing else moves, at the beginning.
fn by_equations(drawn: &Drawn, waves: &[Wave], effect: &str) -> Vec<f64> {
    let text = format!("{}{effect}", drawn.model);
    let file = ModelFile::parse(&text, "model.toml", &known(effects::all())).unwrap();
    let equations = Model::of_file(&file, effects::all()).unwrap().equations(&[]).unwrap();
    let start = equations.states.iter().map(|s| match s.as_str() {
        "body.u" => drawn.speed,
        wheel if wheel.starts_with("theta") => drawn.speed / drawn.machine.wheels[0].radius,
        _ => 0.0,
    });
    let input = |role: &str, t: f64| match role.strip_suffix('\'') {
        Some(role) => waves[place(drawn, role)].at(t)[1],
        None => waves[place(drawn, role)].at(t)[0],
    };
    let mut workspace = equations.workspace(&[]);
    let rates = |t: f64, z: &[f64], rates: &mut [f64]| {
        let u: Vec<f64> = equations.inputs.iter().map(|role| input(role.as_str(), t)).collect();
        equations.rates(&mut workspace, z, &u, rates);
    };
    let stiff = Integrator { method: Method::Radau5, ..Integrator::default() };
    let end = stiff.solve(rates, 0.0, &start.collect::<Vec<f64>>(), &[SECONDS]).unwrap().remove(0);
    end[..equations.poses].to_vec()
}

fn place(drawn: &Drawn, role: &str) -> usize {
    drawn.roles.iter().position(|r| *r == role).unwrap()
}

fn waves(drawn: &Drawn, random: &mut ChaCha8Rng) -> Vec<Wave> {
    drawn.sizes.iter().map(|size| Wave::drawn(random, *size)).collect()
}

/// Bodies with places of their own, multipliers and Runge and Kutta's steps; quasi-coordinates, Lagrange and Radau's method.
#[test]
fn the_simulator_and_the_library_drive_alike() {
    for (make, seed) in MAKES.into_iter().flat_map(|make| [(make, 3), (make, 4)]) {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let drawn = make.drawn(&mut random);
        let waves = waves(&drawn, &mut random);
        let (_, found) = simulated(&drawn, &waves);
        let said = by_library(&drawn, &waves);
        assert_eq!(found.len(), said.len());
        for (a, b) in found.iter().zip(&said) {
            assert!((a - b).abs() < 2e-5 * (1.0 + b.abs()), "{}: {found:?} {said:?}", make.name());
        }
        // It went somewhere, and turned.
        assert!(found[0].hypot(found[1]) > 0.5 && found[2].abs() > 1e-3, "{}: {found:?}", make.name());
    }
}

/// Load that moves, side forces that build up and gears with play, by the simulator and by the effects of the library. The library
/// moves the load by side forces at a steady load, and its teeth meet softly.
#[test]
fn tyres_and_gears_answer_alike_in_the_simulator_and_in_the_library() {
    let cases = [
        (Make::Car, "load-transfer", "height", 0.3, 5e-6),
        (Make::SkidSteer, "load-transfer", "height", 0.3, 5e-6),
        (Make::Car, "relaxation", "length", 0.4, 5e-6),
        (Make::DifferentialDrive, "relaxation", "length", 0.3, 5e-6),
        (Make::Train, "relaxation", "length", 0.3, 5e-6),
        (Make::Wheel, "gear-backlash", "lost", 0.05, 3e-4),
        (Make::DifferentialDrive, "gear-backlash", "lost", 0.05, 3e-4),
        (Make::Train, "gear-backlash", "lost", 0.05, 3e-4),
    ];
    for (make, id, parameter, value, near) in cases {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut drawn = make.drawn(&mut random);
        let waves = waves(&drawn, &mut random);
        let (_, without) = simulated(&drawn, &waves);
        Secret { id, trailer: None, values: vec![(parameter, value)] }.hide(&mut drawn.machine);
        let (_, found) = simulated(&drawn, &waves);
        let effect = format!("[[effects]]\nid = \"{id}\"\n{parameter} = {value}\n");
        let said = by_equations(&drawn, &waves, &effect);
        let off = |other: &[f64]| found.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(
            off(&said) < near && off(&without) > 100.0 * near,
            "{} {id}: {} {}",
            make.name(),
            off(&said),
            off(&without)
        );
    }
}

/// Hitches hold: the places of two bodies at their pin are one, however long it lasts.
#[test]
fn hitches_of_the_simulator_hold() {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let drawn = Make::Train.drawn(&mut random);
    let waves = waves(&drawn, &mut random);
    let (state, _) = simulated(&drawn, &waves);
    for (i, hitch) in drawn.machine.hitches.iter().enumerate() {
        let at = |body: usize, ahead: f64| {
            let ([x, y], heading) = (drawn.machine.place(&state, body), state.place[3 * body + 2]);
            [x + ahead * heading.cos(), y + ahead * heading.sin()]
        };
        let (front, back) = (at(hitch.front, -hitch.behind), at(i + 1, hitch.length));
        assert!((front[0] - back[0]).hypot(front[1] - back[1]) < 1e-9, "{front:?} {back:?}");
    }
}
