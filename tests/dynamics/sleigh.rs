//! The sleigh with forces: against the closed form of its ideal motion, and its approach to it.

use creepage::dynamics::{Dynamics, Masses, Start, simulate_dynamics};
use creepage::model::Model;
use creepage::motion::{Formulas, Integrator, Method, Table};

fn sleigh(mass: f64, inertia: f64, offset: f64) -> Dynamics {
    let model = Model::new("sleigh", &[("mass", mass), ("inertia", inertia), ("mass_offset", offset)]).unwrap();
    Dynamics::new(&model, &Masses { mass, inertia, mass_offset: offset, ..Masses::default() }).unwrap()
}

fn run(sleigh: &Dynamics, speed: f64, yaw_rate: f64, times: &[f64]) -> Table {
    let start = Start { pose: vec![0.0; 3], speed, yaw_rate: Some(yaw_rate), ..Start::default() };
    let stiff = sleigh.contacts[0].law.is_some();
    let method = if stiff { Method::Radau5 } else { Method::Dop853 };
    let integrator = Integrator { method, max_steps: 20_000, ..Integrator::default().with_tolerance(1e-11, 1e-13) };
    simulate_dynamics(sleigh, &Formulas::new(&[], &[]).unwrap(), times, &start, &integrator).unwrap()
}

/// t, v, ω, heading since t = 0 of the certified closed form at m = I = a = 1, V = 1 (Bloch, 1.7).
#[allow(clippy::excessive_precision)] // as certified
const CLOSED_FORM: [[f64; 4]; 6] = [
    [1.0, 0.46211715726000974, 0.6270756465395253, 0.6793614372183433],
    [2.0, 0.76159415595576485, 0.458243571484656, 1.2243829450862713],
    [3.0, 0.90514825364486651, 0.30058828896320006, 1.6005055747753307],
    [4.0, 0.9640275800758169, 0.18795055846307621, 1.8409671221956323],
    [5.0, 0.98661429815143031, 0.11530877391413157, 1.9897893873612329],
    [6.0, 0.99505475368673046, 0.070235451039486432, 2.080738553586345],
];

#[test]
fn the_ideal_sleigh_moves_as_in_closed_form() {
    let times: Vec<f64> = std::iter::once(0.0).chain(CLOSED_FORM.map(|row| row[0])).collect();
    let table = run(&sleigh(1.0, 1.0, 1.0), 0.0, 0.5f64.sqrt(), &times);
    for (i, [t, v, w, heading]) in CLOSED_FORM.into_iter().enumerate() {
        for (name, said) in [("speed", v), ("yaw_rate", w), ("heading", heading), ("energy", 0.5)] {
            let found = table.column(name).unwrap()[i + 1];
            assert!((found - said).abs() < 1e-9, "{name} at {t}: {found} {said}");
        }
        assert!(table.column("lateral_speed").unwrap()[i + 1].abs() < 1e-9);
    }
}

/// b and the largest errors of u, ω, φ and place against the ideal sleigh, a = 0.3, m = 1, I = 0.5, u₀ = 0.5, ω₀ = 1.2,
/// over 4 s: certified.
const CONVERGENCE: [[f64; 5]; 6] = [
    [10.0, 0.07759536422560398, 0.030173027597702573, 0.10226418616904853, 0.2837780465487045],
    [100.0, 0.007731181513413787, 0.0030694737243557313, 0.010367856986158941, 0.029833975937027704],
    [1000.0, 0.0007727004066959697, 0.0003075289483838173, 0.0010382855919317535, 0.002998227191166213],
    [10000.0, 7.726572182065183e-05, 3.07587405554699e-05, 0.00010384366277804702, 0.00029997127364894997],
    [100000.0, 7.726528856499826e-06, 3.075931246154795e-06, 1.0384517389550041e-05, 2.9998613244732694e-05],
    [1000000.0, 7.726524478002261e-07, 3.0759492375409536e-07, 1.038453255386429e-06, 2.9998762653226065e-06],
];

#[test]
fn with_friction_it_tends_to_the_ideal_one_as_one_over_b() {
    let times: Vec<f64> = (0..=400).map(|i| f64::from(i) * 0.01).collect();
    let ideal = run(&sleigh(1.0, 0.5, 0.3), 0.5, 1.2, &times);
    for [b, u, w, phi, place] in CONVERGENCE {
        let free = sleigh(1.0, 0.5, 0.3).with_law("blade-direction", "viscous", &[b]).unwrap();
        let found = run(&free, 0.5, 1.2, &times);
        let gaps = |name: &str| -> Vec<f64> {
            let (a, b) = (found.column(name).unwrap(), ideal.column(name).unwrap());
            a.iter().zip(b).map(|(a, b)| (a - b).abs()).collect()
        };
        let largest = |gaps: &[f64]| gaps.iter().copied().fold(0.0, f64::max);
        let apart: Vec<f64> = gaps("x").iter().zip(gaps("y")).map(|(x, y)| x.hypot(y)).collect();
        let errors = [largest(&gaps("speed")), largest(&gaps("yaw_rate")), largest(&gaps("heading")), largest(&apart)];
        println!("{b:e}: {errors:?}");
        for (error, certified) in errors.into_iter().zip([u, w, phi, place]) {
            assert!((error / certified - 1.0).abs() < 0.01, "b = {b}: {error:e}, certified {certified:e}");
        }
    }
}
