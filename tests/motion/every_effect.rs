//! Every effect of the library along a minute's drive, always and in part; play against the operator it is named after.

use creepage::effects::{self, Applied, DrivingRegime, Effect, Scope};
use creepage::model::{Model, Trailer};
use creepage::motion::{Integrator, Signals, Timing, simulate_model};

/// The pose at the end of a drive over inputs, each by its role.
fn end(model: &Model, time: &[f64], input: impl Fn(&str) -> Vec<f64>) -> [f64; 3] {
    let columns: Vec<Vec<f64>> = model.inputs.iter().map(|role| input(role)).collect();
    let signals = Signals::new(time, &columns, Timing::Sample);
    let integrator = Integrator { max_steps: 100_000, ..Integrator::default() };
    let start = vec![0.0; 3 + model.trailer_count()];
    let table = simulate_model(model, &signals, time, &start, &integrator);
    let table =
        table.unwrap_or_else(|e| panic!("{:?}: {e}", model.effects.iter().map(Applied::label).collect::<Vec<_>>()));
    ["x", "y", "heading"].map(|name| *table.column(name).unwrap().last().unwrap())
}

fn model(vehicle: &str, parameters: &[(&str, f64)]) -> Model {
    Model::new(vehicle, &[&[("wheel_radius", 0.1)], parameters].concat()).unwrap()
}

/// A file that `discover` writes is one that `simulate` follows: with each effect at its plausible size, always, for a time, in reverse.
#[test]
fn a_minute_is_driven_with_every_effect() {
    // Forward and backward, to both sides, and to one of them for seconds.
    let time: Vec<f64> = (0..600).map(|i| 0.1 * f64::from(i)).collect();
    let of = |f: &dyn Fn(f64) -> f64| time.iter().map(|t| f(*t)).collect::<Vec<f64>>();
    let (speed, turn) =
        (|t: f64| 4.0 * (0.5 + (0.21 * t).sin()), |t: f64| 0.25 * ((0.37 * t).sin() + 0.4 * (0.83 * t + 1.0).sin()));
    let input = |role: &str| match role {
        "yaw_rate" | "steering_angle" | "steering_angle_rear" => of(&turn),
        "wheel_rate_right" => of(&|t| speed(t) + turn(t)),
        _ => of(&speed),
    };
    let models = [
        model("unicycle", &[]),
        model("car", &[("wheelbase", 0.5)]).with_trailers(&[Trailer { length: 0.6, hitch: 0.1 }]),
        model("four-wheel-steering", &[("wheelbase", 0.5)]),
        model("differential-drive", &[("track_width", 0.4)]),
    ];
    let scopes = [None, Some(Scope::Times(vec![[20.0, 40.0]])), Some(Scope::Regime(DrivingRegime::Reverse))];
    let mut driven = 0;
    for model in &models {
        // Rocard's law divides by the speed: at standstill it is undefined.
        let all = effects::all().iter().filter(|e| e.id != "rocard-creep");
        let library: Vec<Effect> = all.flat_map(|e| model.on_each_input(e)).collect();
        for scope in &scopes {
            let within = |e: &Effect| scope.as_ref().map_or_else(|| e.clone(), |s| e.within(s.clone()));
            let all: Vec<Effect> = library.iter().map(within).collect();
            for (effect, trailer) in model.applicable(&all) {
                let sizes = effect.parameters.values().map(|p| p.size).collect();
                let applied = Applied::new(effect, trailer, sizes);
                let label = applied.label();
                let end = end(&model.clone().with_effect(applied), &time, input);
                assert!(end.iter().all(|v| v.is_finite()), "{label}: {end:?}");
                driven += 1;
            }
        }
    }
    assert!(driven > 200, "{driven}");
}

/// Inputs are read at one delay along a run: a file that asks for another is not followed as if it did not.
#[test]
fn a_delay_that_changes_is_refused() {
    let file =
        "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n[[effects]]\nid = \"input-delay\"\ndelay = 0.2\n";
    let still = creepage::Model::parse(file).unwrap();
    assert!(creepage::describe(&still).is_ok());
    for moving in ["scope = { from = 3.0 }", "input = \"yaw_rate\"\nscope = { regime = \"reverse\" }", COURSE] {
        let told =
            creepage::Model::parse(&format!("{file}{moving}\n")).and_then(|m| creepage::describe(&m)).unwrap_err();
        assert!(told.exit_code() == 2 && told.to_string().contains("a delay is one for a run"), "{told}");
    }
}

const COURSE: &str = "course = { kind = \"linear\", per_s = 0.01 }";

/// A steering of triangles, and what follows it with play: after each turn it waits until the play is taken up.
#[test]
fn play_is_that_of_its_operator() {
    const WIDTH: f64 = 0.05;
    let car = model("car", &[("wheelbase", 0.5)]);
    let slope = |t: f64| if (t / 4.0) as i32 % 2 == 0 { 0.05 } else { -0.05 };
    // Rows at the turns, every 4 s, and where the play is taken up, 2 s later; between them inputs are rounded off.
    let time: Vec<f64> = (0..=6000).map(|i| f64::from(i) / 100.0).collect();
    let mut steering = vec![0.0];
    let mut follows = vec![0.0f64];
    for k in 1..time.len() {
        let (u, x) = (steering[k - 1] + slope(time[k - 1]) * (time[k] - time[k - 1]), follows[k - 1]);
        steering.push(u);
        follows.push(x.clamp(u - WIDTH, u + WIDTH));
    }
    let end = |model: &Model, steering: &[f64]| {
        end(model, &time, |role| if role == "wheel_rate" { vec![5.0; time.len()] } else { steering.to_vec() })
    };
    let play = effects::named("input-backlash").unwrap().on_input("steering_angle", "rad", 1.0);
    let with_play = car.clone().with_effect(Applied::new(&play, None, vec![WIDTH]));
    let apart = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let meant = end(&car, &follows);
    let (off, moved) = (apart(end(&with_play, &steering), meant), apart(end(&car, &steering), meant));
    assert!(off < 3e-6 && moved > 0.1, "{off} {moved}");
}
