//! Connections of one angle: curvature against differences, Stokes in more than two shape variables, and what is refused.

use crate::support::check;
use creepage::connection::{Connection, Path};
use creepage::formula::{Expr, Symbol};
use creepage::mechanism::Row;
use proptest::prelude::*;
use std::f64::consts::TAU;

/// A connection of three shape variables with a parameter, nowhere flat.
fn twisted() -> Connection {
    Connection::new("g", &[("u", "k*cos(v) + w^2"), ("v", "u*w/(2 + cos(u))"), ("w", "sin(u)*v - u/(1 + v^2)")])
        .unwrap()
}

fn value(e: &Expr, at: [f64; 3]) -> f64 {
    e.eval(&|s: &Symbol| match s.as_str() {
        "u" => at[0],
        "v" => at[1],
        "w" => at[2],
        _ => 1.5,
    })
    .unwrap()
}

#[test]
fn the_curvature_is_that_of_small_squares() {
    let a = twisted();
    check(40, prop::array::uniform3(-1.0..1.0f64), |at| {
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            // Round a small square: forwards along i at the near side of j, backwards at the far one, and so on.
            let h = 1e-3;
            let moved = |s: f64, t: f64| {
                let mut p = at;
                p[i] += s;
                p[j] += t;
                p
            };
            let side = |k: usize, f: &dyn Fn(f64) -> [f64; 3]| {
                // Simpson's rule along a side of length 2h.
                let form = &a.form[k];
                h / 3.0 * (value(form, f(-h)) + 4.0 * value(form, f(0.0)) + value(form, f(h)))
            };
            let round = side(i, &|s| moved(s, -h)) + side(j, &|t| moved(h, t))
                - side(i, &|s| moved(s, h))
                - side(j, &|t| moved(-h, t));
            let found = value(&a.curvature(i, j), at);
            prop_assert!((round / (4.0 * h * h) - found).abs() < 1e-5 * (1.0 + found.abs()), "{} {}", round, found);
            prop_assert_eq!(value(&a.curvature(j, i), at), -found);
        }
        Ok(())
    });
}

#[test]
fn line_and_surface_integrals_agree_in_three_shape_variables() {
    let a = twisted();
    check(6, prop::array::uniform4(-0.8..0.8f64), |c| {
        let path = [("u", "c_0 + cos(t)/2"), ("v", "c_1*sin(t) + c_2"), ("w", "c_3*cos(2*t) + sin(t)/3")];
        let path = Path::new(&path, [0.3, 0.3 + TAU]).unwrap();
        let values = [("k", 1.5), ("c_0", c[0]), ("c_1", c[1]), ("c_2", c[2]), ("c_3", c[3])];
        let (line, area) = (a.phase(&path, &values).unwrap(), a.phase_by_area(&path, &values).unwrap());
        prop_assert!((line - area).abs() < 1e-12, "{} {}", line, area);
        // There and back again is nothing.
        let back = path.clone().between([0.3 + TAU, 0.3]);
        prop_assert!((line + a.phase(&back, &values).unwrap()).abs() < 1e-13);
        Ok(())
    });
}

#[test]
fn what_is_flat_is_a_gradient() {
    let flat = Connection::new("g", &[("u", "2*u*v + k"), ("v", "u^2 - sin(v)*w"), ("w", "cos(v)")]).unwrap();
    assert_eq!(flat.is_flat(), Some(true));
    let bent = Connection::new("g", &[("u", "2*u*v + k"), ("v", "u^2 - sin(v)*w"), ("w", "-cos(v)")]).unwrap();
    assert_eq!(bent.is_flat(), Some(false));
    // One shape variable is always flat; beyond the normal form nothing is said.
    assert_eq!(Connection::new("g", &[("u", "exp(u)")]).unwrap().is_flat(), Some(true));
    assert_eq!(Connection::new("g", &[("u", "exp(v)"), ("v", "u*exp(v)")]).unwrap().is_flat(), None);
    assert_eq!(twisted().is_flat(), Some(false));
}

#[test]
fn a_row_gives_the_connection_it_is_solved_for() {
    let mut row = Row::default();
    for (rate, c) in [("g'", "2 + u"), ("u'", "v"), ("v'", "-3")] {
        row.add(rate, &Expr::parse(c).unwrap());
    }
    let shape = ["u", "v"].map(Symbol::from);
    let found = Connection::of_row(&row, &"g".into(), &shape).unwrap();
    assert_eq!(found.form.iter().map(ToString::to_string).collect::<Vec<_>>(), ["-v/(2 + u)", "3/(2 + u)"]);
    let said = |row: &Row, group: &str, shape: &[Symbol]| {
        Connection::of_row(row, &group.into(), shape).unwrap_err().to_string()
    };
    assert!(said(&row, "g", &shape[..1]).contains("v' is the rate of no shape variable"));
    assert!(said(&row, "q", &["u".into(), "v".into(), "g".into()]).contains("does not hold q'"));
    let mut leaning = row.clone();
    leaning.add("w'", &Expr::parse("g").unwrap());
    let with_w = ["u", "v", "w"].map(Symbol::from);
    assert!(said(&leaning, "g", &with_w).contains("speaks of the position g"));
    assert!(Connection::new("g", &[("u", "cos(g)")]).unwrap_err().to_string().contains("speaks of the position g"));
}

#[test]
fn what_cannot_be_integrated_is_said() {
    let a = twisted();
    let open = [("u", "t"), ("v", "0"), ("w", "0")];
    let path = |shape: &[(&str, &str)]| Path::new(shape, [0.0, 1.0]).unwrap();
    let values = [("k", 1.5)];
    assert!(a.phase(&path(&open), &values).is_ok());
    assert!(a.phase_by_area(&path(&open), &values).unwrap_err().to_string().contains("open path"));
    let said = |shape: &[(&str, &str)], values: &[(&str, f64)]| a.phase(&path(shape), values).unwrap_err().to_string();
    assert!(said(&open[..2], &values).contains("does not say how w moves"));
    assert!(said(&open, &[]).contains("uses k, which has no value"));
    assert!(said(&[("u", "ln(t - 2)"), open[1], open[2]], &values).contains("undefined on the path"));
    assert!(said(&[("u", "sqrt(t)"), open[1], ("w", "sqrt(abs(t - 1/3))")], &values).contains("does not settle"));
    assert!(Path::new(&[("u", "t +")], [0.0, 1.0]).is_err() && Path::new(&[("u", "t")], [0.0, f64::NAN]).is_err());
    assert!(!path(&open).is_closed(&[]).unwrap() && path(&[("u", "t*(1 - t)")]).is_closed(&[]).unwrap());
    assert_eq!(path(&open).at(0.25, &[]).unwrap(), [0.25, 0.0, 0.0]);
}

/// A path is closed up to rounding of what it is made of, near zero and far from it.
#[test]
fn rounding_closes_a_path_and_a_gap_opens_it() {
    let is_closed = |formula: &str| Path::new(&[("u", formula)], [0.0, TAU]).unwrap().is_closed(&[]).unwrap();
    for closed in ["sin(t)", "5 + cos(t)", "1000 + 1e-8*t", "-1000 + 1e-8*t", "1e-10*t"] {
        assert!(is_closed(closed), "{closed}");
    }
    for open in ["t", "1 + 1e-8*t", "1e-8*t", "-1 - 1e-8*t", "-t"] {
        assert!(!is_closed(open), "{open}");
    }
}
