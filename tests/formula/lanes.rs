//! Lanes: the same program over blocks, within rounding of the scalar run, and the same bits on every processor.

use crate::support::check;
use crate::support::rounding::Rounded;
use crate::support::tree::{NAMES, formulas, named, points};
use creepage::formula::{Changes, Expr, Fun, Graph, Isa, Lanes, Program, Symbol};
use proptest::prelude::*;

const L: usize = 8;

fn compiled(formulas: &[Expr]) -> Program {
    let mut graph = Graph::default();
    let ids: Vec<_> = formulas.iter().map(|e| graph.insert(e)).collect();
    Program::compile(&graph, &NAMES.map(Symbol::new), &ids).unwrap()
}

/// Results of a block whose lanes differ in what may differ.
fn run(program: &Program, changes: &[Changes], points: &[[f64; 8]; L], isa: Isa) -> Vec<[f64; L]> {
    let lanes = Lanes::new(program, changes);
    let mut memory = lanes.memory::<L>();
    for (slot, change) in changes.iter().enumerate() {
        match change {
            Changes::Clock => memory.clock(slot, points[0][slot]),
            _ => (0..L).for_each(|l| memory.input(slot)[l] = points[l][slot]),
        }
    }
    lanes.begin(&mut memory, isa);
    // Twice: registers that are used again must not hold what the first run left.
    lanes.run(&mut memory, isa);
    lanes.run(&mut memory, isa);
    (0..lanes.outputs()).map(|k| *lanes.output(&memory, k)).collect()
}

fn changes() -> impl Strategy<Value = Vec<Changes>> {
    let one = prop::sample::select(vec![Changes::Case, Changes::Clock, Changes::Lane]);
    prop::collection::vec(one, NAMES.len())
}

fn blocks() -> impl Strategy<Value = [[f64; 8]; L]> {
    prop::collection::vec(points(), L).prop_map(|v| v.try_into().unwrap())
}

#[test]
fn lanes_agree_with_the_value_within_rounding() {
    let all = (prop::collection::vec(formulas(), 1..4), blocks(), changes());
    check(3000, all, |(formulas, mut points, changes)| {
        for (slot, _) in changes.iter().enumerate().filter(|(_, c)| **c == Changes::Clock) {
            (1..L).for_each(|l| points[l][slot] = points[0][slot]);
        }
        let found = run(&compiled(&formulas), &changes, &points, Isa::best());
        for (formula, lanes) in formulas.iter().zip(&found) {
            for (point, value) in points.iter().zip(lanes) {
                let expected = formula.eval(&|s| Rounded::exact(named(point, s.as_str())));
                if let Some(expected) = expected {
                    prop_assert!(expected.allows(*value, 8.0), "{formula}: {expected:?} is not {value}");
                }
                // What is undefined in one reading is so in the other, where rounding leaves no doubt.
                if formula.eval(&|s| named(point, s.as_str())).is_some() && expected.is_some() {
                    prop_assert!(value.is_finite(), "{formula} at {point:?}");
                }
            }
        }
        Ok(())
    });
}

#[test]
fn every_set_of_instructions_gives_the_same_bits() {
    let sets = Isa::available();
    let all = (prop::collection::vec(formulas(), 1..4), blocks(), changes());
    check(1500, all, |(formulas, points, changes)| {
        let program = compiled(&formulas);
        let bits = |isa: &Isa| -> Vec<u64> {
            let found = run(&program, &changes, &points, *isa);
            found.iter().flatten().map(|v| if v.is_nan() { u64::MAX } else { v.to_bits() }).collect()
        };
        let first = bits(&sets[0]);
        for isa in &sets[1..] {
            prop_assert_eq!(&first, &bits(isa), "{}", isa.name());
        }
        Ok(())
    });
}

/// Units in the last place of the exact value, as far as the standard library knows it.
fn ulps(found: f64, expected: f64) -> f64 {
    (found - expected).abs() / (expected.abs().next_up() - expected.abs())
}

fn of(f: Fun, x: [f64; L]) -> [f64; L] {
    let program = compiled(&[Expr::call(f, &Expr::sym("x"))]);
    let points = x.map(|x| [x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    run(&program, &[Changes::Lane; 8], &points, Isa::best())[0]
}

#[test]
fn functions_are_within_their_stated_units() {
    let mut rng = 1u64;
    let mut next = move || {
        rng = rng.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (rng >> 11) as f64 / (1u64 << 53) as f64
    };
    for scale in [1e-300, 1e-9, 1.0, 10.0, 1e3, 9.9e5, 1e7, 1e18] {
        for _ in 0..2000 {
            let mut x = [0.0; L];
            x.iter_mut().for_each(|x| *x = scale * (2.0 * next() - 1.0));
            // Beside whole quarter turns, where most digits cancel.
            x[0] = (x[0] / std::f64::consts::FRAC_PI_2).round() * std::f64::consts::FRAC_PI_2;
            for (f, exact, most) in
                [(Fun::Sin, f64::sin as fn(f64) -> f64, 2.0), (Fun::Cos, f64::cos, 2.0), (Fun::Tan, f64::tan, 6.0)]
            {
                for (x, y) in x.iter().zip(of(f, x)) {
                    assert!(ulps(y, exact(*x)) <= most, "{f:?} {x:e}: {y:e} is not {:e}", exact(*x));
                }
            }
        }
    }
}

#[test]
fn what_is_undefined_is_no_number() {
    let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 0.5, 0.0, 1.0, -0.0];
    for f in Fun::all() {
        for (x, y) in bad.iter().zip(of(f, bad)) {
            assert!(x.is_finite() || !y.is_finite(), "{f:?} of {x} is {y}");
            let exact = Expr::call(f, &Expr::sym("x")).eval(&|_| *x);
            assert_eq!(y.is_finite(), exact.is_some(), "{f:?} of {x} is {y}");
        }
    }
    // A far angle beside near ones changes nothing for them.
    let near = of(Fun::Sin, [0.3; L]);
    let mixed = of(Fun::Sin, [0.3, 1e9, 0.3, f64::NAN, 0.3, 0.3, 0.3, 0.3]);
    assert_eq!(near[0].to_bits(), mixed[0].to_bits());
    assert!((mixed[1] - 1e9f64.sin()).abs() < 1e-15);
}

#[test]
fn what_does_not_change_is_not_repeated() {
    let parse = |text: &str| Expr::parse(text).unwrap();
    let program = compiled(&[parse("sin(x)*cos(y)*e_rc"), parse("sin(e_rc)*cos(e_rc) + y")]);
    let steps = |changes: [Changes; 3]| {
        let all: Vec<Changes> = changes.into_iter().chain([Changes::Lane; 5]).collect();
        Lanes::new(&program, &all).len()
    };
    let (all, some) = (steps([Changes::Lane; 3]), steps([Changes::Case, Changes::Clock, Changes::Lane]));
    assert!(some < all, "{some} of {all}");
    assert_eq!(steps([Changes::Case; 3]), 0);
}

#[test]
fn what_belongs_together_is_one_step_and_costs_no_result() {
    let table: [(&[&str], usize); 8] = [
        (&["x*y + e_rc"], 1),
        (&["e_rc - x*y"], 1),
        (&["x*y - e_rc"], 1),
        (&["x*y + x*y"], 2),
        // A product that is read elsewhere, or asked for, is a step of its own.
        (&["x*y", "x*y + e_rc"], 2),
        (&["x*y", "x*y + e_rc", "x*y - e_rc", "x*y + phi"], 4),
        (&["sin(x)", "cos(x)"], 1),
        (&["sin(x)*sin(y)*cos(phi)"], 5),
    ];
    let point = [0.3, 0.7, -0.2, 1.1, 0.5, -1.5, 0.9, 2.0];
    for (texts, wanted) in table {
        let formulas: Vec<Expr> = texts.iter().map(|text| Expr::parse(text).unwrap()).collect();
        let program = compiled(&formulas);
        let lanes = Lanes::new(&program, &[Changes::Lane; 8]);
        assert_eq!((lanes.len(), lanes.outputs(), lanes.is_empty()), (wanted, texts.len(), false), "{texts:?}");
        let found = run(&program, &[Changes::Lane; 8], &[point; L], Isa::best());
        for (formula, lanes) in formulas.iter().zip(found) {
            let expected = formula.eval(&|s| named(&point, s.as_str())).unwrap();
            assert!((lanes[L - 1] - expected).abs() < 1e-15, "{formula}");
        }
    }
    assert!(Lanes::new(&compiled(&[Expr::sym("x")]), &[Changes::Lane; 8]).is_empty());
    // A sign has no value but these.
    assert_eq!(of(Fun::Sign, [0.0, -0.0, 2.0, -3.0, 1e-300, -1e-300, 0.0, 1.0]), [0., 0., 1., -1., 1., -1., 0., 1.]);
}

#[test]
#[cfg(target_arch = "x86_64")]
fn the_sets_are_those_that_the_processor_has() {
    use std::is_x86_feature_detected as has;
    let wide = has!("avx512f") && has!("avx512dq") && has!("avx512vl") && has!("avx512bw");
    let expected = [("baseline", true), ("AVX2", has!("avx2")), ("AVX-512", wide)];
    let expected: Vec<&str> = expected.iter().filter(|(_, there)| *there).map(|(name, _)| *name).collect();
    let found = Isa::available();
    assert_eq!(found.iter().map(|isa| isa.name()).collect::<Vec<_>>(), expected);
    assert_eq!(found.last(), Some(&Isa::best()));
}
