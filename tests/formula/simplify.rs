//! What building an expression or a graph leaves out, and that it leaves out nothing else: one form for each case.

use creepage::formula::{BigRational, Expr, Graph, NodeId};

fn e(text: &str) -> Expr {
    Expr::parse(text).unwrap()
}

#[test]
fn sums_of_expressions_leave_out_numbers_zeros_and_double_signs() {
    for (a, b, sum, difference) in [
        ("1", "2", "3", "-1"),
        ("1/3", "1/6", "0.5", "1/6"),
        ("0", "x", "x", "-x"),
        ("x", "0", "x", "x"),
        ("x", "-y", "x - y", "x + y"),
        ("x", "y", "x + y", "x - y"),
        ("0", "-y", "-y", "y"),
    ] {
        assert_eq!((&e(a) + &e(b)).to_string(), sum, "{a} + {b}");
        assert_eq!((&e(a) - &e(b)).to_string(), difference, "{a} - {b}");
    }
}

#[test]
fn a_product_of_expressions_has_one_sign_in_front() {
    for (a, b, product) in [
        ("2", "3", "6"),
        ("1", "x", "x"),
        ("x", "1", "x"),
        ("-1", "x", "-x"),
        ("x", "-1", "-x"),
        ("0", "x", "0"),
        ("0", "1/x", "0*(1/x)"),
        ("-2", "x", "-2*x"),
        ("x", "-2", "-2*x"),
        ("2", "-x", "-2*x"),
        ("-2", "-x", "2*x"),
        ("-x", "-y", "x*y"),
        ("-x", "y", "-x*y"),
        ("x", "-y", "-x*y"),
        ("x", "y", "x*y"),
    ] {
        let made = &e(a) * &e(b);
        assert_eq!(made.to_string(), product, "{a} * {b}");
        assert!(made == e(product), "{a} * {b} prints as another form");
    }
}

#[test]
fn quotients_powers_and_signs_of_expressions() {
    for (a, b, quotient) in
        [("6", "3", "2"), ("1", "0", "1/0"), ("x", "1", "x"), ("-x", "y", "-x/y"), ("x", "y", "x/y")]
    {
        assert_eq!((&e(a) / &e(b)).to_string(), quotient, "{a} / {b}");
    }
    assert!(&e("-x") / &e("y") == -&(&e("x") / &e("y")));
    assert_eq!(e("x").pow(0).to_string(), "1");
    assert_eq!(e("1/x").pow(0).to_string(), "(1/x)^0");
    assert_eq!(e("1/x").pow(1).to_string(), "1/x");
    assert_eq!((-&e("0")).to_string(), "0");
    assert_eq!((-&e("-x")).to_string(), "x");
    assert_eq!((-&e("x")).to_string(), "-x");
}

#[test]
fn a_number_is_written_as_a_decimal_where_it_ends() {
    for (text, form) in [("1/8", "0.125"), ("3/10", "0.3"), ("1/3", "1/3"), ("1/6", "1/6"), ("-1/4", "-0.25")] {
        let value = e(text).as_number().unwrap();
        assert_eq!(Expr::number(&value).to_string(), form);
    }
}

type Join = fn(&mut Graph, NodeId, NodeId) -> NodeId;

/// The node of `a op b`, and that of what it should be.
fn joined(a: &str, b: &str, op: Join, wanted: &str) -> (NodeId, NodeId, String) {
    let mut g = Graph::default();
    let (a, b) = (g.insert(&e(a)), g.insert(&e(b)));
    let node = op(&mut g, a, b);
    let printed = g.expr(node).to_string();
    (node, g.insert(&e(wanted)), printed)
}

#[test]
fn a_graph_leaves_out_what_an_expression_does() {
    let cases: [(&str, Join, &str, &str); 25] = [
        ("1", Graph::add, "2", "3"),
        ("0", Graph::add, "x", "x"),
        ("x", Graph::add, "0", "x"),
        ("x", Graph::add, "-y", "x - y"),
        ("y", Graph::add, "x", "y + x"),
        ("5", Graph::sub, "2", "3"),
        ("0", Graph::sub, "x", "-x"),
        ("x", Graph::sub, "0", "x"),
        ("x", Graph::sub, "x", "0"),
        ("x", Graph::sub, "-y", "x + y"),
        ("x", Graph::sub, "y", "x - y"),
        ("2", Graph::mul, "3", "6"),
        ("1", Graph::mul, "x", "x"),
        ("x", Graph::mul, "1", "x"),
        ("0", Graph::mul, "x", "0"),
        ("x", Graph::mul, "0", "0"),
        ("-1", Graph::mul, "x", "-x"),
        ("x", Graph::mul, "-1", "-x"),
        ("x", Graph::mul, "2", "2*x"),
        ("x", Graph::mul, "y", "x*y"),
        ("6", Graph::div, "3", "2"),
        ("x", Graph::div, "1", "x"),
        ("x", Graph::div, "y", "x/y"),
        ("1/x", Graph::sub, "1/y", "1/x - 1/y"),
        ("1/x", Graph::mul, "y", "1/x*y"),
    ];
    for (a, op, b, wanted) in cases {
        let (node, same, printed) = joined(a, b, op, wanted);
        assert_eq!(node, same, "{a} with {b}: {printed}, not {wanted}");
    }
}

/// What is left out adds no node either.
#[test]
fn a_graph_has_no_node_for_what_is_left_out() {
    let count = |build: &dyn Fn(&mut Graph, NodeId)| {
        let mut g = Graph::default();
        let x = g.symbol("x".into());
        // The numbers that take part are nodes 1 and 2.
        g.number(whole(0));
        g.number(whole(1));
        build(&mut g, x);
        g.len() - 3
    };
    assert_eq!(count(&|g, x| _ = g.pow(x, 1)), 0);
    assert_eq!(count(&|g, x| _ = g.pow(x, 0)), 0);
    assert_eq!(count(&|g, x| _ = g.pow(x, 2)), 1);
    assert_eq!(count(&|g, x| _ = g.mul(x, 1)), 0);
    assert_eq!(count(&|g, x| _ = g.mul(1, x)), 0);
    assert_eq!(count(&|g, x| _ = g.div(x, 2)), 0);
}

fn whole(n: i64) -> BigRational {
    BigRational::from(n)
}

#[test]
fn what_is_not_defined_everywhere_is_not_left_out_of_a_graph() {
    for (a, op, b) in [("1/x", Graph::sub as Join, "1/x"), ("0", Graph::mul, "1/x"), ("1", Graph::div, "0")] {
        let mut g = Graph::default();
        let (a, b) = (g.insert(&e(a)), g.insert(&e(b)));
        let node = op(&mut g, a, b);
        assert!(g.expr(node).as_number().is_none(), "{}", g.expr(node));
    }
    let mut g = Graph::default();
    let inverse = g.insert(&e("1/x"));
    let power = g.pow(inverse, 0);
    assert_eq!(g.expr(power).to_string(), "(1/x)^0");
}

#[test]
fn a_sign_taken_twice_is_gone_and_functions_of_zero_are_numbers() {
    let mut g = Graph::default();
    let x = g.symbol("x".into());
    let negative = g.neg(x);
    assert_eq!(g.neg(negative), x);
    assert!(!g.is_empty() && Graph::default().is_empty());
    let two = g.number(whole(2));
    let minus_two = g.number(whole(-2));
    assert_eq!(g.neg(two), minus_two);
    let (zero, one) = (g.number(whole(0)), g.number(whole(1)));
    for (text, wanted) in [("sin(0)", zero), ("tan(0)", zero), ("atan(0)", zero), ("tanh(0)", zero), ("cos(0)", one)] {
        assert_eq!(g.insert(&e(text)), wanted, "{text}");
    }
}

#[test]
fn a_derivative_that_is_zero_is_the_number_zero() {
    for text in ["ln(y)", "(1/y)^3", "(1/x)^0", "1/y", "sqrt(y)", "3"] {
        assert_eq!(e(text).derivative(&"x".into()).to_string(), "0", "{text}");
    }
}

#[test]
fn only_what_stands_in_a_circular_function_is_an_angle() {
    for (text, angles) in [
        ("r*cos(phi + 2*delta)", &["delta", "phi"][..]),
        ("cos(delta*2 - beta)", &["beta", "delta"]),
        ("2*x + cos(phi)", &["phi"]),
        ("x*2", &[]),
        ("cos(r*phi)", &[]),
        ("sin(atan(e))", &[]),
        ("cot(-a) + tan(b/2)", &["a"]),
    ] {
        let found: Vec<String> = e(text).angles().iter().map(|s| s.to_string()).collect();
        assert_eq!(found, angles, "{text}");
    }
}
