//! A report as `discover` would write it: a wheel with cornering creep on figure-eight paths.

use creepage::discrepancy::report::*;
use creepage::effects::TypicalMotion;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Mass over b_T, s.
const CREEP: f64 = 0.11;
/// Standard deviation of a measured coordinate, m.
const NOISE: f64 = 0.004;
/// Time between rows, s.
const STEP: f64 = 0.02;

struct Drive {
    speed: f64,
    period: f64,
    turned: f64,
}

impl Drive {
    /// Heading and yaw rate of a path that closes as a figure eight (2.405 is the first zero of J₀).
    fn heading(&self, t: f64) -> [f64; 2] {
        let (sin, cos) = (TAU * t / self.period).sin_cos();
        [self.turned + 2.405 * sin, 2.405 * TAU / self.period * cos]
    }

    /// Ground velocity with so much cornering creep.
    fn velocity(&self, t: f64, creep: f64) -> [f64; 2] {
        let [heading, yaw_rate] = self.heading(t);
        let (sin, cos) = heading.sin_cos();
        let lateral = -creep * self.speed * yaw_rate;
        [self.speed * cos - lateral * sin, self.speed * sin + lateral * cos]
    }

    /// The path from a point on, from row `from` to row `to`, by the midpoint rule.
    fn path(&self, start: [f64; 2], rows: std::ops::Range<usize>, creep: f64) -> Vec<[f64; 2]> {
        let mut p = start;
        let step = |i: usize| {
            let v = self.velocity((i as f64 + 0.5) * STEP, creep);
            let here = p;
            p = [p[0] + v[0] * STEP, p[1] + v[1] * STEP];
            here
        };
        rows.map(step).collect()
    }

    /// Pieces of 5 s, each restarted on the path driven.
    fn pieces(&self, driven: &[[f64; 2]], creep: f64) -> Vec<Vec<[f64; 2]>> {
        let starts = (0..driven.len()).step_by((5.0 / STEP) as usize);
        starts.map(|i| self.path(driven[i], i..(i + (5.0 / STEP) as usize).min(driven.len()), creep)).collect()
    }
}

/// One run seen from above, as measured and as predicted.
pub fn path_picture(run: &str, held_out: bool, seed: u64) -> PathPicture {
    let drive = Drive { speed: 1.1 + 0.2 * seed as f64, period: 20.0, turned: 0.5 * seed as f64 };
    let driven = drive.path([0.0, 0.0], 0..1000, CREEP);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let noise = Normal::new(0.0, NOISE).unwrap();
    let measured = driven.iter().map(|p| p.map(|v| v + noise.sample(&mut random))).collect();
    let (before, after) = (drive.pieces(&driven, 0.0), drive.pieces(&driven, CREEP * 0.985));
    PathPicture { run: run.into(), held_out, measured, before, after }
}

/// The violation of a constraint of one run with an amplitude before the patch, m/s.
pub fn residual(constraint: &str, run: &str, amplitude: f64, seed: u64) -> ResidualPicture {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let noise = Normal::new(0.0, 0.02).unwrap();
    let time: Vec<f64> = (0..1000).map(|i| i as f64 * STEP).collect();
    let after: Vec<f64> = time.iter().map(|_| noise.sample(&mut random)).collect();
    let before = time.iter().zip(&after).map(|(t, n)| n - amplitude * (TAU * t / 20.0).cos()).collect();
    let [constraint, run, unit] = [constraint, run, "m/s"].map(String::from);
    ResidualPicture { constraint, run, unit, time, before, after, noise: 0.02 }
}

/// Pictures of three runs.
pub fn pictures() -> Pictures {
    let horizon: Vec<f64> = vec![1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0];
    let floor: Vec<f64> = horizon.iter().map(|h| 0.0042 + 0.0009 * h).collect();
    Pictures {
        columns: vec![],
        paths: vec![
            path_picture("eight-slow.csv", false, 0),
            path_picture("eight-fast.csv", false, 1),
            path_picture("eight-held-out.csv", true, 2),
        ],
        gap: GapCurve {
            before: horizon.iter().map(|h| 0.0045 + 0.047 * h).collect(),
            after: floor.iter().map(|f| f * 1.12).collect(),
            floor,
            horizon,
        },
        residuals: vec![
            residual("rotation constraint", "eight-held-out.csv", 0.0, 5),
            residual("traverse constraint", "eight-held-out.csv", 0.14, 6),
        ],
        candidates: candidates(),
        equations: vec![
            ("rotation constraint".into(), "cos(phi)*x' + sin(phi)*y' - r*theta' = 0".into()),
            ("traverse constraint".into(), "cos(phi)*y' - sin(phi)*x' + mass_over_bT*r*theta'*phi' = 0".into()),
        ],
        vehicle: "unicycle".into(),
        driving: Some(Driving {
            runs: 2,
            seconds: 40.0,
            metres: 38.0,
            left_turns: 4,
            right_turns: 3,
            motion: TypicalMotion { speed: 0.95, turning: 0.7, until: 20.0 },
        }),
        forecasts: vec![forecast("eight-held-out.csv", f64::NEG_INFINITY), forecast("eight-fast.csv", f64::INFINITY)],
        changes: vec![
            Change {
                of: "model.toml".into(),
                text: "[[effects]]\nid = \"cornering-creep\"\nmass_over_bT = 0.109\n".into(),
            },
            Change { of: "code".into(), text: "creepage export model.patched.toml --as c\n".into() },
        ],
    }
}

/// Forecasts along an eight, the last of its places too near to the end.
pub fn forecast(run: &str, held_out_from: f64) -> Forecast {
    let at = |t: f64| [4.0 * (0.3 * t).sin(), 2.0 * (0.6 * t).sin()];
    let places: Vec<f64> = (0..40).map(|k| 0.5 * f64::from(k)).collect();
    let shifted =
        |t: f64, by: f64| (0..=4).map(|k| at(t + 0.5 * f64::from(k)).map(|v| v + by * f64::from(k) / 4.0)).collect();
    let wrong = |t: f64| 0.24 * (0.3 * t).sin().abs();
    let known = |t: f64| t < 18.0;
    Forecast {
        run: run.into(),
        held_out_from,
        ahead: 2.0,
        floor: 0.009,
        scoped: vec![],
        pose: places.iter().map(|t| [at(*t)[0], at(*t)[1], 0.3 * t]).collect(),
        paths: places
            .iter()
            .map(|t| if known(*t) { [shifted(*t, wrong(*t)), shifted(*t, 0.01)] } else { [vec![], vec![]] })
            .collect(),
        error: places.iter().map(|t| if known(*t) { [wrong(*t), 0.01] } else { [f64::NAN; 2] }).collect(),
        time: places,
    }
}

fn candidates() -> Vec<CandidatePicture> {
    let values = [
        ("cornering-creep", 8120.0),
        ("load-dependent-creep", 8090.0),
        ("lever-arm", 5120.0),
        ("relaxation-length", 312.0),
        ("traverse-creep", 96.0),
        ("heading-misalignment", 95.8),
        ("input-delay", 33.0),
        ("yaw-rate-scale", 8.1),
        ("side-slope", 1.2),
        ("drift", -6.0),
        ("wheel-radius", -7.4),
        ("rotation-creep", -7.4),
        ("yaw-rate-bias", -7.6),
        ("wheel-radius-mismatch", -15.0),
    ];
    let one = |(i, (id, delta_bic)): (usize, &(&str, f64))| CandidatePicture {
        id: (*id).into(),
        delta_bic: *delta_bic,
        chosen: i == 0,
        rival: i == 1,
    };
    values.iter().enumerate().map(one).collect()
}

/// A gap at one horizon with values before, after and floor, m; heading errors are a tenth of them.
pub fn gap(horizon_s: f64, [before, after, floor]: [f64; 3]) -> Gap {
    let both = |share: f64| BeforeAfter {
        position_rms_before: before * share,
        position_rms_after: after * share,
        heading_rms_before: Some(0.0031),
        heading_rms_after: Some(0.0030),
    };
    let noise_floor = Floor { position_rms: floor, heading_rms: Some(0.0029) };
    Gap { horizon_s, fit: Some(both(0.97)), held_out: Some(both(1.0)), noise_floor }
}

/// The report to those pictures.
pub fn report() -> Report {
    Report {
        schema: 1,
        verdict: Verdict::MissingEffect,
        summary:
            "The wheel slides outwards in curves: with cornering creep added, the model predicts the held-out run \
                  to 10 mm after 5 s instead of 240 mm."
                .into(),
        effects: vec![cornering_creep()],
        refuted: vec![],
        remains: None,
        covariance: None,
        odd_runs: vec![],
        unnamed: vec![],
        disagreement: vec![disagreement("eight-fast.csv", 0.61), disagreement("eight-slow.csv", 0.24)],
        remaining: Some(remaining()),
        gap: vec![
            gap(1.0, [0.0515, 0.0057, 0.0051]),
            gap(5.0, [0.2395, 0.0097, 0.0087]),
            gap(30.0, [1.4145, 0.0349, 0.0312]),
        ],
        kinematic: None,
        next_experiment: Some(NextExperiment {
            why: "it separates cornering creep, which grows with speed times yaw rate, from load-dependent creep"
                .into(),
            manoeuvre: "drive the same circle of 2 m at 0.5 and at 2 m/s for 20 s each".into(),
        }),
        steps: vec![Step { added: "cornering-creep".into(), gap_after: 0.0094 }],
        data: data(),
        provenance: provenance(),
    }
}

fn cornering_creep() -> Named {
    let estimate = Estimate { value: 0.10938, std: Some(0.00213), unit: "s".into(), course: None };
    Named {
        id: "cornering-creep".into(),
        says: "a viscous contact holds the vehicle sideways, so it slides outwards in turns".into(),
        plain: "In turns the robot slides outwards: 7.3 cm/s at 0.95 m/s and 0.70 rad/s".into(),
        place: "traverse constraint".into(),
        on: None,
        scope: None,
        parameters: BTreeMap::from([("mass_over_bT".to_string(), estimate)]),
        evidence: Evidence { delta_bic: 8120.0, p_value: 1e-12 },
        indistinguishable_from: vec![Rival { id: "load-dependent-creep".into(), why: "data".into() }],
        equation: "mass_over_bT*(v_t' + phi'*v_l) + v_t = 0".into(),
        per_run: BTreeMap::new(),
    }
}

fn disagreement(run: &str, share_of_gap: f64) -> Disagreement {
    let [run, place, regime] = [run, "traverse constraint", "sharp left curve, 0.75 rad/s"].map(String::from);
    Disagreement { run, place, from: 7.5, to: 12.5, regime, share_of_gap }
}

fn remaining() -> Remaining {
    let of = |(place, unit): (&str, &str), rms, noise, p_value| RemainingConstraint {
        place: place.into(),
        unit: unit.into(),
        rms,
        noise,
        p_value,
    };
    let rotation = of(("rotation constraint", "m/s"), 0.00212, 0.00208, 0.31);
    let traverse = of(("traverse constraint", "m/s"), 0.00243, 0.00239, 0.5);
    Remaining {
        position_noise: 0.002,
        heading_noise: Some(0.0021),
        rows_alike: 1.0,
        windows_alike: 1.0,
        sensors: vec![],
        constraints: vec![rotation, traverse],
    }
}

fn data() -> DataSummary {
    DataSummary {
        runs: 3,
        rows: 2988,
        rows_dropped: 12,
        why_dropped: BTreeMap::from([("blank cell".to_string(), 9), ("infinite".to_string(), 3)]),
        warnings: vec!["eight-fast.csv: rows were out of order and were sorted".into()],
        clocks: vec![],
        findings: vec![],
    }
}

fn provenance() -> Provenance {
    let hash = "9f86d081884c7d659a2feaa0c55ad015a3bf4f1b2b0b822cd15d6c15b0f00a08";
    let files = ["eight-fast.csv", "eight-held-out.csv", "eight-slow.csv", "wheel.toml"];
    let inputs_sha256 = files.iter().map(|f| (f.to_string(), hash.to_string())).collect();
    Provenance { version: "0.1.0".into(), seed: 0, inputs_sha256 }
}

/// A report with nothing in it but a verdict, as for data that cannot be used.
pub fn bare(verdict: Verdict) -> Report {
    Report {
        verdict,
        summary: String::new(),
        effects: vec![],
        disagreement: vec![],
        remaining: None,
        gap: vec![],
        next_experiment: None,
        steps: vec![],
        ..report()
    }
}
