//! The domain of a formula: the places at which it is undefined, by the zeros of its divisors.

use crate::claims::divisors;
use crate::claims::proved::record_identity;
use crate::claims::{Counterexample, DerivedFormulas, Equation, Outcome, Point, Statement, domains, simplest, written};
use crate::formula::{Exact, Expr, Normal, Scalar, Symbol};

/// Shows, for each equation, that what the formulas derive for its left side is undefined exactly where its right side is
/// zero.
///
/// Proved by comparing the product of the left side's divisors with the right side in normal form; refuted by the
/// simplest numbers at which one is the case and not the other.
pub(crate) fn undefined_exactly_where(formulas: &DerivedFormulas, statement: &Statement) -> Outcome {
    Outcome::all(statement.equations().iter().map(|equation| {
        let derived = formulas.put_into(equation.left.clone());
        match mismatch(equation, &derived) {
            Some(found) => Outcome::Fails(found),
            None => match multiple(&divisors(&derived), &equation.right) {
                Some(identity) => {
                    record_identity(&DerivedFormulas::default(), &identity);
                    Outcome::PROVED
                }
                None => Outcome::Undefined(format!("the divisors of {} are not {}", equation.left, equation.right)),
            },
        }
    }))
}

/// A formula that is of the first degree in a coefficient, solved for it: where it is `value`.
pub(crate) fn solved_for(coefficient: &str, formula: &Expr, value: &Expr) -> Expr {
    let name = Symbol::from(coefficient);
    let without = formula.substitute(&|s| (*s == name).then(|| Expr::int(0)));
    &(value - &without) / &formula.derivative(&name)
}

/// The derived speed of the disk solved for the coefficient, at any speed and rate.
pub(crate) fn disk_coefficient() -> DerivedFormulas {
    let speed = DerivedFormulas::of("disk").with_text("theta'", "omega").written_out("v_l");
    DerivedFormulas::default().with("e_rc", solved_for("e_rc", &speed, &Expr::sym("v_l")))
}

/// Shows that every right side has a value everywhere, whatever the values of its symbols.
pub(crate) fn defined_everywhere(statement: &Statement) -> Outcome {
    Outcome::all(statement.equations().iter().map(|equation| {
        if divisors(&equation.right).as_number().is_some() {
            return Outcome::PROVED;
        }
        let names = domains([&equation.right]);
        match simplest(&names, |p| value(&equation.right, p).is_none().then(|| undefined(&equation.right))) {
            Some(found) => Outcome::Fails(found),
            None => Outcome::Undefined(format!("{} divides by what may vanish", equation.right)),
        }
    }))
}

fn undefined(e: &Expr) -> String {
    format!("{e} is undefined")
}

fn value(e: &Expr, point: &Point) -> Option<Exact> {
    e.eval(&|s: &Symbol| point.get(s).unwrap_or_else(|| Exact::ratio(1, 0)))
}

fn mismatch(equation: &Equation, derived: &Expr) -> Option<Counterexample> {
    let names = domains([derived, &equation.right]);
    simplest(&names, |point| {
        let (left, right) = (value(derived, point), value(&equation.right, point)?);
        match (left, right.equals(&Exact::ratio(0, 1))) {
            (None, false) => {
                Some(format!("{}, and {} is {}", undefined(&equation.left), equation.right, written(&right)))
            }
            (Some(v), true) => Some(format!("{} is {}, and {} is zero", equation.left, written(&v), equation.right)),
            _ => None,
        }
    })
}

/// The product of everything a formula divides by.
fn divisors(e: &Expr) -> Expr {
    divisors::divisors(e).iter().fold(Expr::int(1), |product, divisor| &product * divisor)
}

/// That a formula is another one times a number that is not zero: then they vanish together; `None` where it is not.
fn multiple(a: &Expr, b: &Expr) -> Option<Equation> {
    let quotient = Normal::of(&(a / b));
    let number = |e: &Expr| e.tidy().as_number().is_some_and(|v| !num_traits::Zero::is_zero(&v));
    let (above, below) = (quotient.numerator(), quotient.denominator());
    let is_number = quotient.is_defined() && number(&above) && number(&below);
    is_number.then(|| Equation { left: a.clone(), right: &(&above / &below) * b })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn statement(left: &str, right: &str) -> Statement {
        Statement::parse(&[(left, right)]).unwrap()
    }

    #[test]
    fn a_formula_divides_by_denominators_and_where_functions_have_poles() {
        for (formula, wanted) in [
            ("u/v + w", "v"),
            ("sin(u/v)", "v"),
            ("cot(u/v)", "v*sin(u/v)"),
            ("tan(u/v)", "v*cos(u/v)"),
            ("(u/v)^-2", "v*(u/v)"),
            ("(u/v)^2", "v"),
            ("u^0", "1"),
        ] {
            assert_eq!(divisors(&Expr::parse(formula).unwrap()).to_string(), wanted, "{formula}");
        }
    }

    #[test]
    fn what_is_undefined_elsewhere_is_told_in_numbers() {
        let asked =
            |left: &str, right: &str| undefined_exactly_where(&DerivedFormulas::default(), &statement(left, right));
        let told = |left: &str, right: &str| match asked(left, right) {
            Outcome::Fails(found) => found.says,
            other => format!("{other:?}"),
        };
        assert!(asked("u/v", "v").holds());
        assert!(asked("tan(x)", "cos(x)").holds());
        assert_eq!(told("u/v", "2"), "u/v is undefined, and 2 is 2");
        assert_eq!(told("u/v", "v*w"), "u/v is 1, and v*w is zero");
        let nowhere = match defined_everywhere(&statement("y", "u/v")) {
            Outcome::Fails(found) => found.says,
            other => format!("{other:?}"),
        };
        assert_eq!(nowhere, "u/v is undefined");
    }

    #[test]
    fn what_is_derived_is_asked_and_named_as_it_is_stated() {
        let formulas = DerivedFormulas::default().with_text("q", "u/v").with_text("v", "1 - w");
        assert!(undefined_exactly_where(&formulas, &statement("q", "1 - w")).holds());
        let Outcome::Fails(found) = undefined_exactly_where(&formulas, &statement("q", "w")) else {
            panic!("q is undefined at w = 1 alone")
        };
        assert!(found.says.starts_with("q is "), "{}", found.says);
    }

    #[test]
    fn a_formula_of_the_first_degree_is_solved_for_its_coefficient() {
        let parsed = |text: &str| Expr::parse(text).unwrap();
        let solved = solved_for("e", &parsed("a*(1 - e) + c"), &parsed("v"));
        let at = |s: &Symbol| [("a", 2.0), ("c", 5.0), ("v", 6.0)].iter().find(|(n, _)| *n == s.as_str()).unwrap().1;
        // 2·(1 − e) + 5 = 6.
        assert_eq!(solved.eval(&at), Some(0.5));
    }
}
