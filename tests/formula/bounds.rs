//! Where the normal form gives up: exactly beyond its bounds, and nowhere before.

use creepage::formula::{Expr, Normal, Polynomial, Scalar, Size, identical};

fn normal(text: &str) -> Normal {
    Normal::of(&Expr::parse(text).unwrap())
}

#[test]
fn a_degree_of_a_thousand_is_the_last() {
    // Products are multiplied out where something is added.
    assert!(normal("(x^30 + 1)*(x^40 + 2) + 1").is_defined());
    assert!(normal("((x^50)^10 + 1)*((x^50)^10 + 2) + 1").is_defined());
    assert!(!normal("((x^50)^10 + 1)*((x^50)^10*x + 2) + 1").is_defined());
    assert!(!normal("((x^60)^10 + 1)*((x^60)^10 + 2) + 1").is_defined());
}

#[test]
fn a_number_of_a_hundred_thousand_binary_digits_is_the_last() {
    // 3 has two binary digits: its power of 50000 is allowed as many as there may be.
    let three = normal("3");
    assert!(three.powi(50_000).is_defined() && !three.powi(50_001).is_defined());
    assert!(three.powi(-50_000).is_defined() && !three.powi(-50_001).is_defined());
    let seventh = normal("1/7");
    assert!(seventh.powi(33_333).is_defined() && !seventh.powi(33_334).is_defined());
    // A coefficient of one grows with no power.
    assert!(normal("x").powi(200_000).is_defined());
}

#[test]
fn a_coefficient_beyond_the_bound_is_refused_in_a_sum_of_few_terms() {
    let big = normal("3").powi(30_000);
    let x = |n: i64| big.mul(&normal("x")).add(&normal(&n.to_string()));
    assert!(x(1).add(&x(2)).is_defined());
    assert!(x(1).mul(&x(2)).mul(&normal("3").powi(-30_000)).is_defined());
    let cubes = x(1).mul(&x(2)).mul(&x(5));
    assert!(!cubes.mul(&x(3)).add(&normal("1")).is_defined());
}

#[test]
fn what_all_terms_share_stands_in_front() {
    for (text, wanted) in [
        ("x*y + x*z", "x*(y + z)"),
        ("6*x^2*y + 4*x^3*z", "2*x^2*(2*x*z + 3*y)"),
        ("x*y + z", "x*y + z"),
        // Here the terms share x only once they are added.
        ("(x + y)^2 - y^2", "x*(x + 2*y)"),
        ("-x*y - x", "-x*(y + 1)"),
    ] {
        assert_eq!(normal(text).to_string(), wanted, "{text}");
    }
}

#[test]
fn odd_and_even_powers_of_sums_are_multiplied_out() {
    for (power, sum) in [
        ("(a + b)^2", "a^2 + 2*a*b + b^2"),
        ("(a + b)^3", "a^3 + 3*a^2*b + 3*a*b^2 + b^3"),
        ("(a - b)^5", "a^5 - 5*a^4*b + 10*a^3*b^2 - 10*a^2*b^3 + 5*a*b^4 - b^5"),
    ] {
        let ask = |a: &str, b: &str| identical(&Expr::parse(a).unwrap(), &Expr::parse(b).unwrap());
        assert_eq!(ask(power, sum), Some(true), "{power}");
        assert_eq!(ask(power, &format!("{sum} + 1")), Some(false), "{power}");
    }
}

/// So that no walk over a long sum goes deep, and a sum that is not long is read as it is written.
#[test]
fn a_sum_of_more_than_two_hundred_terms_is_printed_in_halves() {
    let sum = |n: usize| (0..n).map(|i| format!("x{i}")).collect::<Vec<_>>().join(" + ");
    let printed = |n: usize| normal(&sum(n)).to_string();
    assert!(!printed(200).contains('('), "{}", printed(200));
    let (ahead, behind) = printed(201).split_once(" + (").map(|(a, b)| (a.to_string(), b.to_string())).unwrap();
    assert_eq!((ahead.matches('x').count(), behind.matches('x').count()), (100, 101));
    for n in [200, 201, 390] {
        let alternating = sum(n).replace(" + x1", " - x1");
        let (written, back) = (Expr::parse(&alternating).unwrap(), normal(&alternating).to_string());
        assert_eq!(identical(&written, &Expr::parse(&back).unwrap()), Some(true), "{n}");
    }
}

#[test]
fn a_tree_of_four_hundred_levels_is_the_last_that_is_read() {
    let sum = |n: usize| vec!["x"; n].join(" + ");
    assert!(Expr::parse(&sum(400)).is_ok());
    assert!(Expr::parse(&sum(401)).is_err());
    let product = |n: usize| vec!["x"; n].join("*");
    assert!(Expr::parse(&product(400)).is_ok() && Expr::parse(&product(401)).is_err());
}

#[test]
fn a_product_of_twenty_thousand_pairs_is_the_last_that_is_multiplied_out() {
    let sum = |c: char, n: usize| (0..n).map(|i| format!("{c}{i}")).collect::<Vec<_>>().join(" + ");
    let terms = |n: usize, m: usize| {
        let text = format!("({})*({})", sum('x', n), sum('y', m));
        Polynomial::of(&Expr::parse(&text).unwrap()).expr().to_string().matches('*').count()
    };
    assert_eq!(terms(100, 200), 20_000);
    // One product of two sums that stand as they were written.
    assert_eq!(terms(101, 200), 1);
}

#[test]
fn a_product_of_two_million_products_of_terms_is_too_large() {
    let sum = |name: &str| (0..38).map(|i| format!("{name}^{i}")).collect::<Vec<_>>().join(" + ");
    // 38·38 + 1 terms; its square would take 1445² products, for less than six thousand terms.
    let large = normal(&format!("({})*({}) + z", sum("x"), sum("y")));
    assert!(large.is_defined() && !large.mul(&large).add(&normal("1")).is_defined());
}

#[test]
fn the_size_of_a_formula_is_counted() {
    let counts = |text: &str| {
        let size = Size::of(&Expr::parse(text).unwrap(), &|_| Size::SYMBOL);
        (size.nodes, size.depth, size.degree)
    };
    for (text, wanted) in [
        ("2", (1, 1, 0)),
        ("2*x", (3, 2, 1)),
        ("-sin(x)", (3, 3, 1)),
        ("(x*y)^3", (4, 3, 6)),
        ("2^4", (2, 2, 4)),
        ("x^-2", (2, 2, 2)),
        ("x*y/(u + v*w)", (9, 4, 4)),
        ("x - y*y*y", (7, 4, 3)),
    ] {
        assert_eq!(counts(text), wanted, "{text}");
    }
}
