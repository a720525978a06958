//! The kinematic single-track model of CommonRoad: the numbers its authors publish, met by the car of the catalogue.
//!
//! Source: M. Althoff and G. Würsching, *CommonRoad: Vehicle Models*; `test_derivatives` and `test_zeroInitialVelocity` of
//! the package `commonroad-vehicle-models` 3.0.2, vehicle 2 (a BMW 320i). Its reference point is the rear axle, as here.

use creepage::model::Model;
use creepage::motion::{Integrator, Signals, Timing, simulate_model};

/// a + b of the vehicle, m.
const WHEELBASE: f64 = 0.3048 * (3.793293 + 4.667707);
const RADIUS: f64 = 0.344;

/// x, y and heading at the end of a second, begun at rest with constant acceleration (m/s²) and steering rate (rad/s).
fn after_a_second(acceleration: f64, steering_rate: f64, start: [f64; 3]) -> [f64; 3] {
    let model = Model::new("car", &[("wheel_radius", RADIUS), ("wheelbase", WHEELBASE)]).unwrap();
    let times: Vec<f64> = (0..=10).map(|i| f64::from(i) / 10.0).collect();
    let ramp = |slope: f64| times.iter().map(|t| slope * t).collect::<Vec<f64>>();
    let columns: Vec<Vec<f64>> = model
        .inputs
        .iter()
        .map(|role| if role == "wheel_rate" { ramp(acceleration / RADIUS) } else { ramp(steering_rate) })
        .collect();
    let inputs = Signals::new(&times, &columns, Timing::Sample);
    let table = simulate_model(&model, &inputs, &times, &start, &Integrator::default()).unwrap();
    ["x", "y", "heading"].map(|name| *table.column(name).unwrap().last().unwrap())
}

#[test]
fn the_published_rates_are_met() {
    let model = Model::new("car", &[("wheel_radius", RADIUS), ("wheelbase", WHEELBASE)]).unwrap();
    let equations = model.equations(&[]).unwrap();
    let state = [3.9579422297936526, 0.0391650102771405, 0.0294717351052816];
    let (steering, speed) = (0.0378491427211811, 16.354695786088357);
    let inputs: Vec<f64> =
        model.inputs.iter().map(|role| if role == "wheel_rate" { speed / RADIUS } else { steering }).collect();
    let mut rates = vec![0.0; equations.states.len()];
    equations.rates(&mut equations.workspace(&[]), &state, &inputs, &mut rates);
    for (found, published) in rates.iter().zip([16.34759359342502, 0.4819314886013121, 0.2401426578627629]) {
        assert!((found - published).abs() < 1e-13, "{found} {published}");
    }
}

#[test]
fn the_published_drives_end_where_they_end() {
    let g = 9.81;
    let drives = [
        ([-0.7 * g, 0.0], [-3.4335000000000013, 0.0, 0.0]),
        ([0.63 * g, 0.15], [3.0845676868494927, 0.1484249221523042, 0.1203664469224163]),
    ];
    for ([acceleration, steering_rate], published) in drives {
        let end = after_a_second(acceleration, steering_rate, [0.0; 3]);
        let off = end.iter().zip(published).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!("{acceleration} m/s²: {off:.1e}");
        assert!(off < 1e-8, "{end:?} {published:?}");
    }
}
