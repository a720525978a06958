//! The remarks on limits: the names of the regimes of creep.

use crate::claims::{Claim, Fault, Outcome, Sampling, Statement, Status, Verdict};
use crate::mechanism::{Limits, RotationMotion, RotationRegime, TraverseMotion, TraverseRegime};
use proptest::prelude::Strategy;

const CODE: &[&str] = &["src/mechanism/regime/rotation.rs", "src/mechanism/regime/traverse.rs"];

pub(crate) fn claims() -> Vec<Claim> {
    let remark = "The limits are inputs: nothing in the paper determines them. For T the paper names no regime outside \
                  its open interval; side-slip is our word.";
    vec![
        Claim::new("regimes-R", Status::Sampled, "rotation creep is slipping for e ≥ e_rc1, backward-creep below, forward-creep below 0, skidding for e ≤ e_rc2")
            .at("section 2, remark on limit values; theory, limits and classification")
            .about(&[8])
            .under("e_rc2 < 0 < e_rc1 given; r·ω ≠ 0, else undefined")
            .remark(remark)
            .chapter("02-rotation-creep")
            .code(CODE)
            .tests(&["tests/mechanism/regime.rs"])
            .sample(
                "at, just inside and beyond generated limits: slipping 2, backward 1, ideal 0, forward −1, skidding −2",
                &[("at_upper", "2"), ("inside_upper", "1"), ("zero", "0"), ("inside_lower", "-1"), ("at_lower", "-2"), ("no_spin", "9")],
                |s, sampling| over(s, sampling, rotation),
            ),
        Claim::new("regimes-T", Status::Sampled, "traverse creep is left-creep for 0 < e < e_tc1, right-creep for e_tc2 < e < 0, side-slip outside the open interval")
            .at("section 3, remark on the working region; theory, limits and classification")
            .about(&[17])
            .under("e_tc2 < 0 < e_tc1 given; v_l ≠ 0, else undefined")
            .remark(remark)
            .chapter("03-traverse-creep")
            .code(CODE)
            .tests(&["tests/mechanism/regime.rs"])
            .sample(
                "at, just inside and beyond generated limits: left 1, ideal 0, right −1, side-slip 2",
                &[("at_upper", "2"), ("inside_upper", "1"), ("zero", "0"), ("inside_lower", "-1"), ("at_lower", "2"), ("no_spin", "9")],
                |s, sampling| over(s, sampling, traverse),
            ),
    ]
}

/// Regimes of a coefficient, and of a motion without a divisor.
type Names = fn(f64, Limits) -> [i64; 2];

fn rotation(e: f64, limits: Limits) -> [i64; 2] {
    let number = |r: RotationRegime| match r {
        RotationRegime::Slipping => 2,
        RotationRegime::BackwardCreep => 1,
        RotationRegime::Ideal => 0,
        RotationRegime::ForwardCreep => -1,
        RotationRegime::Skidding => -2,
        RotationRegime::Undefined => 9,
    };
    [RotationRegime::of(e, Some(limits)), RotationMotion::of(e, 0.0, Some(limits)).regime].map(number)
}

fn traverse(e: f64, limits: Limits) -> [i64; 2] {
    let number = |r: TraverseRegime| match r {
        TraverseRegime::SideSlip => 2,
        TraverseRegime::LeftCreep => 1,
        TraverseRegime::Ideal => 0,
        TraverseRegime::RightCreep => -1,
        TraverseRegime::Undefined => 9,
    };
    [TraverseRegime::of(e, Some(limits)), TraverseMotion::of(0.0, e, Some(limits)).regime].map(number)
}

fn over(s: &Statement, sampling: &Sampling, names: Names) -> Outcome {
    let show = |(lower, upper): &(f64, f64)| vec![("e_2".into(), lower.to_string()), ("e_1".into(), upper.to_string())];
    let size = || 1e-3..1.0f64;
    sampling.cases((size().prop_map(|e| -e), size()), show, |(lower, upper)| at_limits(s, *lower, *upper, names))
}

fn at_limits(s: &Statement, lower: f64, upper: f64, names: Names) -> Verdict {
    let limits = Limits::new(lower, upper).map_err(|e| Fault::Undefined(e.to_string()))?;
    let found = [
        ("at_upper", names(upper, limits)[0]),
        ("inside_upper", names(upper.next_down(), limits)[0]),
        ("zero", names(0.0, limits)[0]),
        ("inside_lower", names(lower.next_up(), limits)[0]),
        ("at_lower", names(lower, limits)[0]),
        ("no_spin", names(upper, limits)[1]),
    ];
    for (name, regime) in found {
        let said = s.number(name).ok_or_else(|| Fault::Undefined(format!("nothing is said of {name}")))?;
        if said != regime as f64 {
            return Err(Fault::False(format!("{name} is regime {regime}, the statement says {said}")));
        }
    }
    Ok(())
}
