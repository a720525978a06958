//! Regimes of creep: at the limits, a step of the last digit to either side, and by motion.

use crate::support::{check, nonzero};
use creepage::mechanism::{
    Landmark, Limits, RotationMotion, RotationRegime, Side, TraverseMotion, TraverseRegime, Way,
};
use proptest::prelude::*;

use RotationRegime::{BackwardCreep, ForwardCreep, Skidding, Slipping};
use TraverseRegime::{LeftCreep, RightCreep, SideSlip};

/// Limits of every size, and none.
fn limits() -> impl Strategy<Value = (f64, f64)> {
    (prop_oneof![Just(0.2), 1e-300..1e300f64, 0.01..2.0f64], prop_oneof![Just(0.3), 1e-300..1e300f64, 0.01..2.0f64])
}

#[test]
fn the_limits_belong_to_sliding_and_the_next_number_to_creep() {
    check(500, limits(), |(low, high)| {
        let given = Some(Limits::new(-low, high).unwrap());
        let rotation = |e: f64| RotationRegime::of(e, given);
        prop_assert_eq!([high.next_up(), high, high.next_down()].map(rotation), [Slipping, Slipping, BackwardCreep]);
        prop_assert_eq!([(-low).next_down(), -low, (-low).next_up()].map(rotation), [Skidding, Skidding, ForwardCreep]);
        prop_assert_eq!([0.0f64.next_up(), 0.0f64.next_down()].map(rotation), [BackwardCreep, ForwardCreep]);
        prop_assert_eq!([0.0, -0.0].map(rotation), [RotationRegime::Ideal; 2]);
        let traverse = |e: f64| TraverseRegime::of(e, given);
        prop_assert_eq!([high.next_up(), high, high.next_down()].map(traverse), [SideSlip, SideSlip, LeftCreep]);
        prop_assert_eq!([(-low).next_down(), -low, (-low).next_up()].map(traverse), [SideSlip, SideSlip, RightCreep]);
        prop_assert_eq!([0.0f64.next_up(), 0.0f64.next_down()].map(traverse), [LeftCreep, RightCreep]);
        prop_assert_eq!([0.0, -0.0].map(traverse), [TraverseRegime::Ideal; 2]);
        Ok(())
    });
}

#[test]
fn without_limits_the_sign_names_the_regime() {
    check(500, -1e3..1e3f64, |e| {
        let (r, t) = (RotationRegime::of(e, None), TraverseRegime::of(e, None));
        let expected = if e > 0.0 { (BackwardCreep, LeftCreep) } else { (ForwardCreep, RightCreep) };
        prop_assert_eq!((r, t), expected);
        Ok(())
    });
    assert_eq!(
        (RotationRegime::of(0.0, None), TraverseRegime::of(0.0, None)),
        (RotationRegime::Ideal, TraverseRegime::Ideal)
    );
}

#[test]
fn what_is_no_number_has_no_regime() {
    for limits in [None, Some(Limits::new(-0.2, 0.2).unwrap())] {
        for e in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(RotationRegime::of(e, limits), RotationRegime::Undefined);
            assert_eq!(TraverseRegime::of(e, limits), TraverseRegime::Undefined);
            assert_eq!(Landmark::of(e), None);
        }
        // A locked wheel and a side slide have no coefficient, nor has a body at rest; nor has what is not known.
        for (v, other) in [(1.0, 0.0), (0.0, 0.0), (1.0, -0.0), (1.0, f64::NAN), (f64::NAN, 1.0), (1.0, f64::INFINITY)]
        {
            let r = RotationMotion::of(v, other, limits);
            assert_eq!((r.coefficient, r.regime, r.landmark), (None, RotationRegime::Undefined, None), "{v} {other}");
            let t = TraverseMotion::of(other, v, limits);
            assert_eq!((t.coefficient, t.regime), (None, TraverseRegime::Undefined), "{v} {other}");
        }
    }
}

#[test]
fn limits_are_finite_and_zero_lies_between() {
    for text in ["0,0.2", "-0.2,0", "-0.0,0.2", "0.1,0.2", "0.2,-0.2", "-inf,0.2", "-0.2,inf", "nan,0.2", "-0.2,nan"] {
        let error = text.parse::<Limits>().unwrap_err();
        assert!(error.exit_code() == 2 && error.to_string().contains("-0.2,0.2"), "{text}: {error}");
    }
    for text in ["", ",", "-0.2", "-0.2,0.1,0.2", "-0.2;0.2", "a,b", "-0.2,"] {
        let error = text.parse::<Limits>().unwrap_err();
        assert!(error.to_string().starts_with("limits are two numbers"), "{text}: {error}");
    }
    let tight: Limits = format!("{:e},{:e}", 0.0f64.next_down(), 0.0f64.next_up()).parse().unwrap();
    assert_eq!((tight.lower(), tight.upper()), (0.0f64.next_down(), 0.0f64.next_up()));
}

#[test]
fn landmarks_are_one_and_what_lies_above() {
    assert_eq!(
        [1.0f64.next_down(), 1.0, 1.0f64.next_up()].map(Landmark::of),
        [None, Some(Landmark::SpinOnTheSpot), Some(Landmark::AgainstItsSpin)]
    );
    assert_eq!([-1.0, 0.0, -5.0].map(Landmark::of), [None; 3]);
    check(500, (nonzero(), nonzero()), |(v_l, spin)| {
        let found = RotationMotion::of(v_l, spin, None).landmark;
        prop_assert_eq!(found, (v_l * spin < 0.0).then_some(Landmark::AgainstItsSpin));
        prop_assert_eq!(RotationMotion::of(0.0, spin, None).landmark, Some(Landmark::SpinOnTheSpot));
        prop_assert_eq!(RotationMotion::of(spin, spin, None).regime, RotationRegime::Ideal);
        Ok(())
    });
}

#[test]
fn the_sign_of_a_coefficient_is_that_of_the_invariant_product() {
    // E11: sgn e_tc = sgn(v_l·v_t), sgn e_rc = −sgn(v_A·ω).
    check(1000, (nonzero(), nonzero()), |(v_l, other)| {
        let t = TraverseMotion::of(v_l, other, None);
        prop_assert_eq!(t.regime, if v_l * other > 0.0 { LeftCreep } else { RightCreep });
        prop_assert_eq!(t.of_travel, Some(if v_l * other > 0.0 { Side::Left } else { Side::Right }));
        prop_assert_eq!(t.of_body, Some(if other > 0.0 { Side::Left } else { Side::Right }));
        let v_a = v_l - other;
        let r = RotationMotion::of(v_l, other, None);
        prop_assert_eq!(r.regime, if v_a * other < 0.0 { BackwardCreep } else { ForwardCreep });
        prop_assert_eq!(r.contact, Some(if v_a > 0.0 { Way::Forward } else { Way::Backward }));
        // The same motion backward: the regime stays, the sides turn round.
        let (back, spun) = (TraverseMotion::of(-v_l, -other, None), RotationMotion::of(-v_l, -other, None));
        prop_assert_eq!((back.regime, back.coefficient, back.of_travel), (t.regime, t.coefficient, t.of_travel));
        prop_assert!(back.of_body != t.of_body && spun.contact != r.contact);
        prop_assert_eq!((spun.regime, spun.coefficient), (r.regime, r.coefficient));
        Ok(())
    });
}

#[test]
fn the_motion_of_a_coefficient_has_that_coefficient() {
    check(1000, (nonzero(), -3.0..3.0f64), |(speed, e)| {
        let r = RotationMotion::of(speed * (1.0 - e), speed, None).coefficient.unwrap();
        prop_assert!((r - e).abs() < 1e-14 * (1.0 + e.abs()), "{} is not {}", r, e);
        let t = TraverseMotion::of(speed, e * speed, None).coefficient.unwrap();
        prop_assert!((t - e).abs() < 1e-14, "{} is not {}", t, e);
        Ok(())
    });
}

#[test]
fn motions_at_the_limits_slide() {
    let limits = Some(Limits::new(-0.25, 0.5).unwrap());
    let rotation = |v: f64| RotationMotion::of(v, 1.0, limits).regime;
    assert_eq!([0.5, 0.5f64.next_up(), 0.5f64.next_down()].map(rotation), [Slipping, BackwardCreep, Slipping]);
    assert_eq!([1.25, 1.25f64.next_down(), 1.25f64.next_up()].map(rotation), [Skidding, ForwardCreep, Skidding]);
    let traverse = |v: f64| TraverseMotion::of(1.0, v, limits).regime;
    assert_eq!(
        [0.5, 0.5f64.next_down(), -0.25, (-0.25f64).next_up()].map(traverse),
        [SideSlip, LeftCreep, SideSlip, RightCreep]
    );
}

#[test]
fn a_coefficient_too_small_to_write_is_not_ideal() {
    assert_eq!(TraverseMotion::of(1e200, 1e-200, None).regime, LeftCreep);
    assert_eq!(TraverseMotion::of(-1e200, 1e-200, None).regime, RightCreep);
    let slide = TraverseMotion::of(0.0, -2.0, None);
    assert_eq!((slide.of_body, slide.of_travel), (Some(Side::Right), None));
    assert_eq!(RotationMotion::of(2.0, 0.0, None).contact, Some(Way::Forward));
    assert_eq!(RotationMotion::of(1.0, 1.0, None).contact, None);
}

#[test]
fn a_contact_that_does_not_move_sideways_is_on_no_side() {
    for v_t in [0.0, -0.0, f64::NAN] {
        for v_l in [1.0, 0.0, -1.0] {
            let motion = TraverseMotion::of(v_l, v_t, None);
            assert_eq!((motion.of_body, motion.of_travel), (None, None), "{v_l} {v_t}");
        }
    }
}

#[test]
fn regimes_are_written_by_name() {
    assert_eq!(format!("{Slipping} {BackwardCreep}"), "slipping backward-creep");
    assert_eq!(format!("{SideSlip} {LeftCreep}"), "side-slip left-creep");
}
