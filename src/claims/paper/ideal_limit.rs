//! The ideal limit: creep vanishes with its coefficients. Corrected theorem (d).

use super::wheel::wheel;
use crate::claims::generated::{ConstrainedMotion, Drive, Generated, any_drive, vehicles};
use crate::claims::simulated::{Creep, driven, model, undefined};
use crate::claims::{
    Claim, DerivedFormulas, Fault, Sampling, Statement, Status, Verdict, near, prove, proving, value_said,
};
use crate::error::Result;
use proptest::prelude::*;

const CHAPTER: &str = "07-ideal-limit";

/// κ as its two parts, and its derivatives at zero creep.
fn kappa() -> DerivedFormulas {
    let derived = DerivedFormulas::default().with_text("re", "1 - e_rc").with_text("im", "(1 - e_rc)*e_tc");
    ["re", "im"].into_iter().fold(derived.clone(), |m, part| {
        let whole = derived.written_out(part);
        ["e_rc", "e_tc"].into_iter().fold(m, |m, e| {
            let ideal = |s: &crate::formula::Symbol| s.as_str().starts_with("e_").then(|| crate::formula::Expr::int(0));
            m.with(&format!("{part}_by_{e}"), whole.derivative(&e.into()).substitute(&ideal))
        })
    })
}

pub(crate) fn claims() -> Vec<Claim> {
    vec![one_wheel(), differential_drive(), generated(), trailers()]
}

fn base(id: &str, status: Status, says: &str) -> Claim {
    Claim::new(id, status, says)
        .at("section 1 and conclusions: creep vanishes with its coefficients; corrected theorem (d)")
        .chapter(CHAPTER)
        .code(&["src/motion/trajectory.rs"])
        .tests(&["tests/motion/kinematics.rs", "tests/motion/sensitivity.rs"])
}

fn one_wheel() -> Claim {
    base("ideal-limit-wheel", Status::Proved, "the wheel is off by exactly |κ − 1| of its ideal distance from the start: e_rc² + (1 − e_rc)²·e_tc² squared, −e_rc + i·e_tc to first order")
        .under("constant coefficients; any inputs, any time")
        .proof(
            "size and first order of κ − 1",
            &[
                ("(re - 1)^2 + im^2", "e_rc^2 + (1 - e_rc)^2*e_tc^2"),
                ("re_by_e_rc*e_rc + re_by_e_tc*e_tc", "-e_rc"),
                ("im_by_e_rc*e_rc + im_by_e_tc*e_tc", "e_tc"),
            ],
            proving(kappa()),
        )
        .proof("without creep the motion is the ideal one", &[("v_l", "r*theta'"), ("x'", "r*theta'*cos(phi)"), ("y'", "r*theta'*sin(phi)")], |s, _| {
            prove(&wheel().with_text("e_rc", "0").with_text("e_tc", "0"), s)
        })
}

/// The order with which two runs approach each other as all creeps shrink tenfold.
fn order(run: impl Fn(f64) -> Result<Vec<f64>>, said: f64) -> Verdict {
    order_below(1e-2, 1e-6, |scale| run(scale).map_err(|e| undefined(&e)), said)
}

/// The order from a scale of the creeps to a tenth of it; a gap that is smaller than told then has none.
fn order_below(scale: f64, least: f64, at: impl Fn(f64) -> std::result::Result<Vec<f64>, Fault>, said: f64) -> Verdict {
    let ideal = at(0.0)?;
    let gap = |scale: f64| -> std::result::Result<f64, Fault> {
        Ok(at(scale)?.iter().zip(&ideal).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt())
    };
    let (wide, narrow) = (gap(scale)?, gap(scale / 10.0)?);
    // Creeps that hardly show at the end of the run leave nothing to measure an order of.
    if narrow < least {
        return Err(Fault::Outside);
    }
    near("the order", (wide / narrow).log10(), said, 0.05)
}

type Case = (Vec<f64>, Vec<f64>, f64);

fn cases() -> impl Strategy<Value = Case> {
    (prop::collection::vec(-1.0..1.0f64, 7), prop::collection::vec(-1.0..1.0f64, 4), 0.5..2.0f64)
}

fn shown((c, e, t): &Case) -> Vec<(String, String)> {
    let list = |name: &str, v: &[f64]| {
        v.iter().enumerate().map(|(i, v)| (format!("{name}_{i}"), v.to_string())).collect::<Vec<_>>()
    };
    [list("c", c), list("e", e), vec![("t".into(), t.to_string())]].concat()
}

fn differential_drive() -> Claim {
    base("ideal-limit-differential-drive", Status::Sampled, "a differential drive approaches its ideal motion with the first power of the creeps; its heading is off by the integrated slip over the track")
        .under("constant coefficients, finite time")
        .sample("order of the gap as the creeps shrink tenfold", &[("order", "1")], |s, sampling| {
            let said = s.number("order").unwrap_or(f64::NAN);
            sampling.one_in(8).cases(cases(), shown, |(c, e, t)| {
                order(|scale| Ok(two_wheels(c, e, scale, *t)?.0), said)
            })
        })
        .sample("heading against the slip of the wheels", &[("heading", "(r/a)*(slip_2 - slip_1)")], |s, sampling| {
            sampling.one_in(8).cases(cases(), shown, |(c, e, t)| {
                let (crept, slips) = two_wheels(c, e, 0.1, *t).map_err(|e| undefined(&e))?;
                let (ideal, _) = two_wheels(c, e, 0.0, *t).map_err(|e| undefined(&e))?;
                let at = |name: &str| match name {
                    "r" => Some(0.1),
                    "a" => Some(0.4),
                    "slip_1" => Some(slips[0]),
                    "slip_2" => Some(slips[1]),
                    _ => None,
                };
                near("heading", crept[2] - ideal[2], value_said(s, "heading", &at)?, 1e-8)
            })
        })
}

/// Right and left wheel rate; the integrals of e_i·θ̇_i are in closed form.
const RIGHT: &str = "3 + c_0 + c_1*cos(2*t)";
const LEFT: &str = "3 + c_2 + c_3*cos(2*t)";

fn two_wheels(c: &[f64], e: &[f64], scale: f64, t: f64) -> Result<(Vec<f64>, [f64; 2])> {
    let (left, right) = (scale * e[0], scale * e[1]);
    // Values in alphabetical order: e_left, e_right.
    let creeps: [Creep; 2] =
        [("unequal-rotation-creep", None, vec![left, right]), ("traverse-creep", None, vec![scale * e[2]])];
    let parameters = [("wheel_radius", 0.1), ("track_width", 0.4)];
    let drive = model("differential-drive", &parameters, &[], &creeps)?;
    let inputs = [("wheel_rate_right", RIGHT), ("wheel_rate_left", LEFT)];
    let path = driven(&drive, &inputs, c, &[0.0; 3], &[0.0, t])?;
    let rolled = |i: usize| (3.0 + c[i]) * t + c[i + 1] * (2.0 * t).sin() / 2.0;
    Ok((path[1].clone(), [right * rolled(0), left * rolled(2)]))
}

fn generated() -> Claim {
    base(
        "ideal-limit-vehicles",
        Status::Sampled,
        "every vehicle approaches its ideal motion with the first power of its creeps",
    )
    .under(
        "constant coefficients, finite time; the measured rates and the constraints tell the motion, and no axle locks on the way",
    )
    .remark(
        "At every instant the constraints are solved for the rates that are not measured; wheels beyond those that tell the \
         motion are passive. The gap is taken over the whole configuration, angles of wheels and castors included.",
    )
    .code(&[MOTION])
    .sample(
        "generated vehicles of five drives with up to two further wheels, of any radius, place and heading",
        &[("order", "1")],
        |s, sampling| approached(vehicles(any_drive(), 2, 0), s, &sampling.one_in(4)),
    )
    .sample(
        "the same with trailers, hitched on the axle and off it",
        &[("order", "1")],
        |s, sampling| approached(vehicles(any_drive(), 1, 4), s, &sampling.one_in(8)),
    )
}

const MOTION: &str = "src/claims/generated/constrained_motion.rs";

/// How a generated vehicle is driven: level, swing, pace and phase of each rate, coefficients, and for how long.
type Driven = (Generated, Vec<[f64; 4]>, Vec<f64>, f64);

fn driven_vehicles(vehicles: impl Strategy<Value = Generated> + Sync) -> impl Strategy<Value = Driven> + Sync {
    let wave = prop::array::uniform4(-1.0..1.0f64);
    // At most two driven wheels, steering, two castors and the yaw; at most five wheels with two rows each, and ten trailers.
    (vehicles, prop::collection::vec(wave, 6), prop::collection::vec(-1.0..1.0f64, 22), 0.2..0.6f64)
}

fn approached(
    vehicles: impl Strategy<Value = Generated> + Sync,
    s: &Statement,
    sampling: &Sampling,
) -> crate::claims::Outcome {
    let said = s.number("order").unwrap_or(f64::NAN);
    let shown = |(vehicle, waves, creeps, t): &Driven| {
        let list = |name: &str, text: String| vec![(name.to_string(), text)];
        [
            vehicle.shown(),
            list("rates", format!("{waves:?}")),
            list("e", format!("{creeps:?}")),
            list("t", t.to_string()),
        ]
        .concat()
    };
    sampling.cases(driven_vehicles(vehicles), shown, |(vehicle, waves, creeps, t)| {
        // Where an ideal motion rests a wheel, or the constraints do not tell the motion, nothing is approached.
        let motion = ConstrainedMotion::of(vehicle).filter(|_| vehicle.is_regular()).ok_or(Fault::Outside)?;
        let inputs = |t: f64| rates_at(&motion, waves, t);
        let end = |scale: f64| {
            let creeps: Vec<f64> = creeps.iter().take(motion.coefficients()).map(|e| scale * e).collect();
            motion.travelled(inputs, &creeps, *t).map_err(|_| Fault::Outside)
        };
        order_below(1e-4, 1e-7, end, said)
    })
}

/// Measured rates at a time: wheels turn forward, angles of wheels and the yaw swing.
fn rates_at(motion: &ConstrainedMotion, waves: &[[f64; 4]], t: f64) -> Vec<f64> {
    let rate = |(name, [level, swing, pace, phase]): (&str, &[f64; 4])| {
        let wave = swing * ((2.0 + pace) * t + phase).sin();
        match name {
            "phi" => level + wave,
            _ if name.starts_with("theta") => 2.0 + level + wave,
            _ => 0.3 * wave,
        }
    };
    motion.measured().zip(waves).map(rate).collect()
}

fn trailers() -> Claim {
    let tractors = || prop::sample::select(vec![Drive::Unicycle, Drive::Differential, Drive::Car, Drive::Tricycle]);
    base(
        "ideal-limit-trailers",
        Status::Sampled,
        "a vehicle with trailers approaches its ideal motion with the first power of the creeps",
    )
    .under("constant coefficients, finite time")
    .code(&[MOTION])
    .sample(
        "generated trains of up to ten trailers with any bars, hitched on the axle and off it, behind generated tractors",
        &[("order", "1")],
        move |s, sampling| approached(vehicles(tractors(), 0, 10), s, &sampling.one_in(8)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_is_read_off_where_a_gap_is_left() {
        let gap = |size: f64| order(|scale| Ok(vec![1.0, size * scale]), 1.0);
        assert!(gap(1.0).is_ok() && gap(1e-3).is_ok());
        assert!(matches!(gap(1e-4), Err(Fault::Outside)));
        assert!(matches!(order(|scale| Ok(vec![scale.sqrt()]), 1.0), Err(Fault::False(_))));
    }
}
