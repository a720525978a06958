//! Section 4: the simulation of Fig. 7 and the energy rule.

use crate::claims::generated::{ConstrainedMotion, Generated, any_drive, vehicles};
use crate::claims::simulated::{Creep, model, undefined};
use crate::claims::{
    Claim, Correction, DerivedFormulas, Domain, Fault, Outcome, Sampling, Statement, Status, Verdict, at_points, near,
    proving, value_said,
};
use crate::energy_rule::{Reading, fig7_case, fig7_path};
use crate::formula::Symbol;
use crate::model::{Model, Trailer};
use proptest::prelude::*;

const CHAPTER: &str = "08-simulation";
const CONSERVATIVE: &str = "src/energy_rule/readings.rs";

pub(crate) fn claims() -> Vec<Claim> {
    vec![figure(), data(), energy_rule(), constant_energy(), traverse_first()]
}

fn figure() -> Claim {
    Claim::new(
        "fig-7",
        Status::Sampled,
        "the non-conservative paths of Fig. 7 are the ideal one times κ; the ideal one ends at i·π/20",
    )
    .at("section 4, simulation, Fig. 7")
    .about(&[24, 25])
    .under("data of the paper; generated coefficients beside its four cases")
    .chapter(CHAPTER)
    .code(&[CONSERVATIVE])
    .tests(&["tests/reports/fig7.rs"])
    .sample(
        "end points after 2π seconds",
        &[("ideal_y", "pi/20"), ("x", "-(1 - e_rc)*e_tc*ideal_y"), ("y", "(1 - e_rc)*ideal_y")],
        |s, sampling| {
            sampling.one_in(8).cases((-0.3..0.3f64, -0.3..0.3f64), creeps, |(e_rc, e_tc)| {
                let end = |e_rc, e_tc| fig7_case(e_rc, e_tc, Reading::NonConservative).map_err(|e| undefined(&e));
                let (ideal, crept) = (end(0.0, 0.0)?, end(*e_rc, *e_tc)?);
                let at = |name: &str| match name {
                    "pi" => Some(std::f64::consts::PI),
                    "e_rc" => Some(*e_rc),
                    "e_tc" => Some(*e_tc),
                    "ideal_y" => Some(ideal.y),
                    _ => None,
                };
                near("ideal_y", ideal.y, value_said(s, "ideal_y", &at)?, 1e-9)?;
                near("x", crept.x, value_said(s, "x", &at)?, 1e-9)?;
                near("y", crept.y, value_said(s, "y", &at)?, 1e-9)
            })
        },
    )
}

/// No rigid wheel has a larger moment about its axis than one with all its mass on the rim.
fn data() -> Claim {
    let wheel = [("m", "1"), ("r", "1/2"), ("J", "1")];
    let margin = wheel.iter().fold(DerivedFormulas::default(), |m, (name, v)| m.with_text(name, v));
    let check = move |s: &Statement, sampling: &Sampling| at_points(&margin, s, &[], sampling);
    Claim::new(
        "fig-7-data",
        Status::Refuted,
        "the data of Fig. 7 are those of a wheel of mass 1 kg and radius 0.5 m with J = 1 kg·m²",
    )
    .at("section 4, simulation")
    .corrects(Correction::FalseAsPrinted)
    .under("all mass within the radius: J ≤ m·r²")
    .remark(
        "J would be four times that of a ring of this mass and radius. The kinematics is not affected, the energy \
             rule takes J as a number. This is none of the numbered errata.",
    )
    .chapter(CHAPTER)
    .code(&[CONSERVATIVE])
    .refutation(
        "the mass lies within the radius, so m·r² − J is not below zero",
        &[("m*r^2 - J", "abs(m*r^2 - J)")],
        &[("m*r^2 - J", "-abs(m*r^2 - J)")],
        check,
    )
}

fn creeps((e_rc, e_tc): &(f64, f64)) -> Vec<(String, String)> {
    vec![("e_rc".into(), e_rc.to_string()), ("e_tc".into(), e_tc.to_string())]
}

fn energy_rule() -> Claim {
    Claim::new("energy-rule", Status::Sampled, "a vehicle whose rates are all scaled by λ = √(E_ideal/E_crept) has the ideal energy at that instant")
        .at("section 4, simulation, the energy rule; reading A")
        .under("inputs that are rates are scaled, steering angles are not; any masses, inertias, inputs, creeps and configuration")
        .remark(
            "The constraints are homogeneous in the rates and the energy is quadratic in them, so λ exists for every \
             vehicle. Which rates are scaled and when is the paper's to say and it does not; reading A is adopted.",
        )
        .chapter(CHAPTER)
        .code(&["src/model/equations.rs", "src/claims/generated/constrained_motion.rs", CONSERVATIVE])
        .tests(&["tests/reports/fig7.rs"])
        .sample(
            "energies of generated vehicles with up to three trailers through the compiled equations",
            &[("lambda", "sqrt(E_ideal/E_crept)")],
            |s, sampling| sampling.cases(bodies(), Bodies::shown, |b| scaled_energy(s, b)),
        )
        .sample(
            "vehicles of the generator with any mass matrix, their rates from the constraints alone",
            &[("lambda", "sqrt(E_ideal/E_crept)")],
            |s, sampling| sampling.one_in(4).cases(weighed(), Weighed::shown, |b| scaled_by_constraints(s, b)),
        )
        .sample(
            "a wheel of any mass, radius and inertias driven by the laws of reading A as the figures use them",
            &[("energy", "I*w^2 + (m*r^2 + J)*u^2")],
            |s, sampling| sampling.cases(wheels(), shown_wheel, |w| driven_by_reading_a(s, w)),
        )
}

/// A vehicle of the generator with measured rates, creeps and a mass matrix L·Lᵀ.
#[derive(Clone, Debug)]
struct Weighed {
    vehicle: Generated,
    rates: Vec<f64>,
    creeps: Vec<f64>,
    /// Rows of L, as long as any vehicle needs.
    masses: Vec<Vec<f64>>,
}

/// Coordinates of a vehicle with five wheels, two castors and three trailers at most.
const MOST_COORDINATES: usize = 16;

fn weighed() -> impl Strategy<Value = Weighed> + Sync {
    let numbers = |n: usize| prop::collection::vec(-1.0..1.0f64, n);
    let masses = prop::collection::vec(numbers(MOST_COORDINATES), MOST_COORDINATES);
    (vehicles(any_drive(), 2, 3), numbers(6), numbers(MOST_COORDINATES), masses)
        .prop_map(|(vehicle, rates, creeps, masses)| Weighed { vehicle, rates, creeps, masses })
}

impl Weighed {
    fn shown(&self) -> Vec<(String, String)> {
        let lists = [("rates", &self.rates), ("creeps", &self.creeps)];
        let lists = lists.map(|(name, values)| (name.to_string(), format!("{values:?}")));
        [self.vehicle.shown(), lists.to_vec()].concat()
    }

    /// Twice the kinetic energy q̇ᵀ·L·Lᵀ·q̇.
    fn energy(&self, rates: &[f64]) -> f64 {
        let sum = |row: &Vec<f64>| row.iter().zip(rates).map(|(l, v)| l * v).sum::<f64>().powi(2);
        self.masses.iter().take(rates.len()).map(sum).sum()
    }
}

/// Steered wheels and castors stand: their angles are no rates that the rule scales.
fn scaled_by_constraints(s: &Statement, b: &Weighed) -> Verdict {
    let motion = ConstrainedMotion::of(&b.vehicle).filter(|_| b.vehicle.is_regular()).ok_or(Fault::Outside)?;
    let turns = |name: &str| name == "phi" || name.starts_with("theta");
    let measured: Vec<f64> =
        motion.measured().zip(&b.rates).map(|(name, rate)| if turns(name) { *rate } else { 0.0 }).collect();
    let energy = |creeps: &[f64], lambda: f64| {
        let measured: Vec<f64> = measured.iter().map(|rate| lambda * rate).collect();
        motion.rates(motion.start(), &measured, creeps).map(|rates| b.energy(&rates)).ok_or(Fault::Outside)
    };
    let creeps: Vec<f64> = b.creeps.iter().take(motion.coefficients()).map(|e| 0.4 * e).collect();
    let (e_ideal, e_crept) = (energy(&vec![0.0; creeps.len()], 1.0)?, energy(&creeps, 1.0)?);
    let lambda = lambda_said(s, e_ideal, e_crept)?;
    near("the energy over the ideal one", energy(&creeps, lambda)? / e_ideal, 1.0, 1e-8)
}

/// r, m, I, J, w, u_0, g, t, and the two creeps.
const NAMES: [&str; 10] = ["r", "m", "I", "J", "w", "u_0", "g", "t", "e_rc", "e_tc"];

fn wheels() -> impl Strategy<Value = Vec<f64>> + Sync {
    let (length, mass, rate, creep) = (|| 0.1..2.0f64, || 0.2..5.0f64, || 0.5..4.0f64, || -0.4..0.4f64);
    ((length(), mass(), mass(), mass()), (rate(), rate(), -0.2..0.2f64, 0.0..2.0f64), (creep(), creep()))
        .prop_map(|((r, m, i, j), (w, u, g, t), (e_rc, e_tc))| vec![r, m, i, j, w, u, g, t, e_rc, e_tc])
}

fn shown_wheel(values: &Vec<f64>) -> Vec<(String, String)> {
    NAMES.iter().zip(values).map(|(name, v)| ((*name).to_string(), v.to_string())).collect()
}

/// m·|v|² + I·φ̇² + J·θ̇² with the rates that the code of reading A gives, v from the coefficients of creep.
fn driven_by_reading_a(s: &Statement, values: &[f64]) -> Verdict {
    let of = |name: &str| NAMES.iter().position(|n| *n == name).map(|i| values[i]);
    let value = |name: &str| match name {
        "side" => Some(1.0),
        "u" => Some(of("u_0")? + of("g")? * of("t")?),
        _ => of(name),
    };
    let laws = Reading::A.spelled().map_err(|e| undefined(&e))?;
    let rate = |law: &crate::formula::Expr| law.eval(&|s: &Symbol| value(s.as_str()).unwrap_or(f64::NAN));
    let rates: Option<Vec<f64>> = laws.iter().map(rate).collect();
    let [yaw, wheel] = rates.ok_or(Fault::Outside)?[..] else { return Err(Fault::Undefined("two rates".into())) };
    let [r, m, i, j, .., e_rc, e_tc] = values[..] else { return Err(Fault::Undefined("ten values".into())) };
    let (forward, inertia) = (r * (1.0 - e_rc) * wheel, i * yaw.powi(2) + j * wheel.powi(2));
    let energy = m * (forward.powi(2) + (e_tc * forward).powi(2)) + inertia;
    near("the energy", energy, value_said(s, "energy", &value)?, 1e-11)
}

/// A vehicle with creeps, a configuration, inputs and an energy.
#[derive(Clone, Debug)]
struct Bodies {
    vehicle: usize,
    /// Of the wheels, of the axle, and of the left wheel where it has its own.
    creep: [f64; 3],
    /// Bar, hitch and creep of each trailer.
    trailers: Vec<(f64, f64, f64)>,
    /// Of the body and of the trailers.
    angles: Vec<f64>,
    /// Values of inputs that are rates, and of those that are angles.
    inputs: [(f64, f64); 2],
    /// Linear forms of all rates.
    energy: Vec<Vec<f64>>,
}

const VEHICLES: [(&str, &[(&str, f64)]); 4] = [
    ("unicycle", &[("wheel_radius", 0.5)]),
    ("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.4)]),
    ("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]),
    ("tricycle", &[("wheel_radius", 0.2), ("wheelbase", 1.1)]),
];

fn bodies() -> impl Strategy<Value = Bodies> {
    let small = || -0.4..0.4f64;
    let trailers = prop::collection::vec((0.5..2.0f64, -0.3..0.3f64, small()), 0..=3);
    let inputs = (1.6..2.4f64, small());
    // Three coordinates, three trailers, two inputs.
    let form = prop::collection::vec(-1.0..1.0f64, 8);
    let made = (prop::array::uniform3(small()), trailers, prop::collection::vec(small(), 4));
    (0..VEHICLES.len(), made, [inputs.clone(), inputs], prop::collection::vec(form, 3)).prop_map(
        |(vehicle, (creep, trailers, angles), inputs, energy)| Bodies {
            vehicle,
            creep,
            trailers,
            angles,
            inputs,
            energy,
        },
    )
}

impl Bodies {
    fn shown(&self) -> Vec<(String, String)> {
        vec![
            ("vehicle".into(), VEHICLES[self.vehicle].0.into()),
            ("creeps".into(), format!("{:?}", self.creep)),
            ("trailers".into(), format!("{:?}", self.trailers)),
            ("angles".into(), format!("{:?}", self.angles)),
            ("inputs".into(), format!("{:?}", self.inputs)),
            ("energy".into(), format!("{:?}", self.energy)),
        ]
    }

    fn creeps(&self) -> Vec<Creep> {
        let [all, across, left] = self.creep;
        let along: Creep = match VEHICLES[self.vehicle].0 {
            "differential-drive" => ("unequal-rotation-creep", None, vec![all, left]),
            _ => ("rotation-creep", None, vec![all]),
        };
        let of_trailers = (1..).zip(&self.trailers).map(|(i, t)| ("trailer-traverse-creep", Some(i), vec![t.2]));
        [along, ("traverse-creep", None, vec![across])].into_iter().chain(of_trailers).collect()
    }

    fn model(&self, creeps: &[Creep]) -> Result<Model, Fault> {
        let (vehicle, parameters) = VEHICLES[self.vehicle];
        let trailers: Vec<Trailer> =
            self.trailers.iter().map(|&(length, hitch, _)| Trailer { length, hitch }).collect();
        model(vehicle, parameters, &trailers, creeps).map_err(|e| undefined(&e))
    }

    /// The energy with the inputs that are rates times λ.
    ///
    /// Whatever turns and moves with the vehicle has velocities that are linear in its rates, so any kinetic energy is
    /// a sum of squares of linear forms; here the forms themselves are generated.
    fn energy(&self, model: &Model, lambda: f64) -> Result<f64, Fault> {
        let equations = model.equations(&[]).map_err(|e| undefined(&e))?;
        let mut w = equations.workspace(&[]);
        let mut z = vec![0.0; equations.n()];
        z[2..].iter_mut().zip(&self.angles).for_each(|(q, a)| *q = *a);
        let is_rate =
            |name: &Symbol| model.vehicle.inputs.get(name.as_str()).is_some_and(|input| input.unit == "rad/s");
        let value = |(name, (rate, angle)): (&Symbol, &(f64, f64))| if is_rate(name) { lambda * rate } else { *angle };
        let u: Vec<f64> = equations.inputs.iter().zip(&self.inputs).map(value).collect();
        let mut rates = vec![0.0; equations.n()];
        equations.rates(&mut w, &z, &u, &mut rates);
        rates.extend(equations.inputs.iter().zip(&u).filter(|(name, _)| is_rate(name)).map(|(_, u)| u));
        let square = |form: &Vec<f64>| form.iter().zip(&rates).map(|(c, v)| c * v).sum::<f64>().powi(2);
        Ok(self.energy.iter().map(square).sum())
    }
}

/// What a statement says of λ for the energies of an ideal and a creeping vehicle at the same rates; forwards.
fn lambda_said(s: &Statement, e_ideal: f64, e_crept: f64) -> Result<f64, Fault> {
    let at = |name: &str| match name {
        "E_ideal" => Some(e_ideal),
        "E_crept" => Some(e_crept),
        _ => None,
    };
    match value_said(s, "lambda", &at)? {
        lambda if lambda.is_sign_negative() => Err(Fault::False("the vehicle would drive backwards".into())),
        lambda => Ok(lambda),
    }
}

fn scaled_energy(s: &Statement, b: &Bodies) -> Verdict {
    let (ideal, crept) = (b.model(&[])?, b.model(&b.creeps())?);
    let (e_ideal, e_crept) = (b.energy(&ideal, 1.0)?, b.energy(&crept, 1.0)?);
    let lambda = lambda_said(s, e_ideal, e_crept)?;
    near("the energy", b.energy(&crept, lambda)?, e_ideal, 1e-10)
}

fn constant_energy() -> Claim {
    let energy =
        || DerivedFormulas::default().with_text("energy", "m*v^2 + I*omega_z^2 + J*omega^2").with_text("v", "r*omega");
    let data = [("m", "1"), ("I", "1/2"), ("J", "1"), ("r", "1/2"), ("omega_z", "1"), ("omega", "2 - t/20")];
    let figure = data.iter().fold(energy(), |m, (name, value)| m.with_text(name, value));
    Claim::new("E23", Status::Corrected, "with the data of Fig. 7 the ideal motion keeps m·v² + I·ω_z² + J·ω² constant")
        .at("section 4, simulation; errata E23")
        .corrects(Correction::FalseAsPrinted)
        .remark(
            "The ideal wheel itself slows down: the sum goes from 11/2 to 4.052574 in 2π seconds. Creeping and ideal \
             motion can only be compared at the same instant.",
        )
        .chapter(CHAPTER)
        .code(&[CONSERVATIVE])
        .tests(&["tests/reports/fig7.rs"])
        .refutation(
            "the value at the start, kept",
            &[("energy", "11/2")],
            &[("energy", "1/2 + 5/4*(2 - t/20)^2")],
            proving(figure.clone()),
        )
        .proof("what it is", &[("energy", "1/2 + 5/4*(2 - t/20)^2")], proving(figure))
}

fn traverse_first() -> Claim {
    // The derived velocities of the wheel, against those of the ideal one.
    let of = |rotation: &str, traverse: &str| {
        let wheel = DerivedFormulas::of("unicycle").with_text("e_rc", rotation).with_text("e_tc", traverse);
        wheel.with_text("apart", "((v_l - r*theta')^2 + v_t^2)/(r*theta')^2").written_out("apart")
    };
    let apart = move || DerivedFormulas::default().with("apart_R", of("e", "0")).with("apart_T", of("0", "e"));
    let sign = move |s: &Statement, sampling: &Sampling| {
        let names = [("e", Domain::Nonzero), ("r", Domain::Positive), ("theta'", Domain::Positive)];
        at_points(&apart(), s, &names, sampling)
    };
    Claim::new("E24", Status::Corrected, "type T makes more positional difference than type R at the beginning")
        .at("section 4, simulation; errata E24")
        .corrects(Correction::ContestedReading)
        .about(&[24, 25])
        .under("equal |e|; true only for the readings A, A_l, B, C2 and F of the energy rule")
        .remark(
            "Without the rule equal coefficients of either kind put the wheel exactly equally far off, |κ − 1| = |e|. \
             The paper's own cases (iii) and (iv) compare 0.1 with 0.2.",
        )
        .chapter(CHAPTER)
        .code(&["src/model/build.rs", CONSERVATIVE])
        .tests(&["tests/reports/fig7.rs"])
        .refutation(
            "without the energy rule",
            &[("sign(apart_T - apart_R)", "1")],
            &[("sign(apart_T - apart_R)", "0")],
            sign,
        )
        .proof(
            "squared distance from the ideal wheel, relative to the way",
            &[("apart_T", "apart_R"), ("apart_T", "e^2")],
            proving(apart()),
        )
        .sample(
            "ratio T : R after half a second at e = −0.05, by reading",
            &[
                ("nonconservative", "1"),
                ("A", "1.23182"),
                ("A_l", "1.23069"),
                ("B", "1.26873"),
                ("C1", "0.759843"),
                ("C2", "1.06043"),
                ("D", "0.857745"),
                ("F", "1.23398"),
            ],
            |s, _| ratios(s),
        )
}

fn ratios(s: &Statement) -> Outcome {
    Outcome::all(Reading::ALL.into_iter().map(|reading| {
        let Some(said) = s.number(reading.name()) else {
            return Outcome::Undefined(format!("nothing is said of reading {}", reading.name()));
        };
        match ratio(reading) {
            Ok(found) if (found - said).abs() < 6e-6 => Outcome::Holds { cases: 1 },
            Ok(found) => Outcome::failure(format!("reading {}: the ratio is {found:.6}, not {said}", reading.name())),
            Err(e) => Outcome::Undefined(e.to_string()),
        }
    }))
}

/// How far type T puts the wheel from the ideal one after half a second, relative to type R of the same size.
fn ratio(reading: Reading) -> crate::Result<f64> {
    let at = |e_rc, e_tc, reading| fig7_path(e_rc, e_tc, reading, &[0.5]).map(|path| path[0]);
    let ideal = at(0.0, 0.0, Reading::NonConservative)?;
    let gap = |e_rc, e_tc| -> crate::Result<f64> {
        let p = at(e_rc, e_tc, reading)?;
        Ok((p.x - ideal.x).hypot(p.y - ideal.y))
    };
    Ok(gap(0.0, -0.05)? / gap(-0.05, 0.0)?)
}
