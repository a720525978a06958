//! The two checks most evidence uses: proof by normal form, and exact values at generated points.

use super::exact_point;
use super::exact_point::{Domain, Point, simplest, written};
use super::proved::record_identity;
use super::sampling::Fault;
use super::{Counterexample, DerivedFormulas, Equation, Outcome, Sampling, Statement};
use crate::formula::{Exact, Expr, Normal, Scalar, Symbol};
use std::collections::BTreeMap;

/// Proves every equation for all values of its free symbols, wherever both sides are defined; refutes it with the
/// simplest numbers at which the sides differ.
///
/// ```
/// use creepage::claims::{prove, DerivedFormulas, Statement};
/// let group = [("cot(phi + atan(e))", "(cot(phi) - e)/(1 + e*cot(phi))")];
/// assert!(prove(&DerivedFormulas::default(), &Statement::parse(&group).unwrap()).holds());
/// let slip = [("cot(phi + atan(e))", "(cot(phi) + e)/(1 + e*cot(phi))")];
/// assert!(prove(&DerivedFormulas::default(), &Statement::parse(&slip).unwrap()).fails());
/// ```
pub fn prove(derived: &DerivedFormulas, statement: &Statement) -> Outcome {
    let values = derived.normal();
    let value = |s: &Symbol| values.get(s).cloned().unwrap_or_else(|| Normal::symbol(s.clone()));
    Outcome::all(statement.in_question().iter().map(|equation| {
        let (left, right) = (equation.left.eval(&value), equation.right.eval(&value));
        match (left, right) {
            (Some(l), Some(r)) if l.equals(&r) => {
                record_identity(derived, equation);
                Outcome::PROVED
            }
            _ if statement.is_brief() => Outcome::failure("no identity"),
            (Some(_), Some(_)) => refute(derived, equation),
            _ => refuted_or_undefined(derived, equation),
        }
    }))
}

/// The check that [`prove`]s statements about derived formulas.
///
/// ```
/// use creepage::claims::{Claim, DerivedFormulas, Status, proving};
/// let square = Claim::new("square", Status::Proved, "a square is a product").proof(
///     "by the normal form",
///     &[("x^2", "x*x")],
///     proving(DerivedFormulas::of("unicycle")),
/// );
/// assert_eq!(square.evidence.len(), 1);
/// ```
pub fn proving(derived: DerivedFormulas) -> impl Fn(&Statement, &Sampling) -> Outcome + Send + Sync + 'static {
    move |statement, _| prove(&derived, statement)
}

/// The simplest counterexample to an equation that is known to be no identity.
fn refute(derived: &DerivedFormulas, equation: &Equation) -> Outcome {
    match counterexample(derived, equation) {
        Some(found) => Outcome::Fails(found),
        None => Outcome::failure(format!("{equation} is no identity")),
    }
}

fn refuted_or_undefined(derived: &DerivedFormulas, equation: &Equation) -> Outcome {
    match counterexample(derived, equation) {
        Some(found) => Outcome::Fails(found),
        None => Outcome::Undefined(format!("{equation} lies outside what the normal form decides")),
    }
}

/// The simplest values of the free symbols at which the sides of an equation differ.
pub fn counterexample(derived: &DerivedFormulas, equation: &Equation) -> Option<Counterexample> {
    let (mut formulas, mut free) = derived.rests_on(&equation.left);
    let (others, more) = derived.rests_on(&equation.right);
    formulas.extend(others);
    free.extend(more);
    let uses = exact_point::domains(&formulas);
    let names: BTreeMap<Symbol, Domain> =
        free.iter().map(|s| (s.clone(), uses.get(s).copied().unwrap_or(Domain::Any))).collect();
    simplest(&names, |point| differs(derived, equation, point))
}

/// What is found and said at a point where they differ; `None` where they agree or either is undefined.
fn differs(derived: &DerivedFormulas, equation: &Equation, point: &Point) -> Option<String> {
    let (left, right) = sides(derived, equation, point);
    let (left, right) = (left?, right?);
    (!left.equals(&right)).then(|| said(equation, &left, &right))
}

fn said(equation: &Equation, left: &Exact, right: &Exact) -> String {
    format!("{} is {}, the statement says {}", equation.left, written(left), written(right))
}

fn sides(derived: &DerivedFormulas, equation: &Equation, point: &Point) -> (Option<Exact>, Option<Exact>) {
    let free = |s: &Symbol| point.get(s).unwrap_or_else(|| Exact::ratio(1, 0));
    let values = derived.values(&free);
    let value = |s: &Symbol| values.get(s).cloned().unwrap_or_else(|| free(s));
    (equation.left.eval(&value), equation.right.eval(&value))
}

/// Compares both sides of every equation, exactly, at generated points.
///
/// A point at which the left side is undefined lies outside the hypotheses and is not counted; a right side that is
/// undefined where the left one is not is false.
pub fn at_points(
    derived: &DerivedFormulas,
    statement: &Statement,
    names: &[(&str, Domain)],
    sampling: &Sampling,
) -> Outcome {
    sampling.cases(exact_point::points(names), Point::shown, |point| {
        statement.equations().iter().try_for_each(|equation| match sides(derived, equation, point) {
            (Some(l), Some(r)) if l.equals(&r) => Ok(()),
            (Some(l), Some(r)) => Err(Fault::False(said(equation, &l, &r))),
            (Some(l), None) => {
                Err(Fault::False(format!("{} is {}, {} is undefined", equation.left, written(&l), equation.right)))
            }
            (None, _) => Err(Fault::Outside),
        })
    })
}

/// Whether two floating-point numbers agree to a relative tolerance; the text says what was found.
pub fn near(what: &str, found: f64, said: f64, tolerance: f64) -> Result<(), Fault> {
    let size = 1.0 + found.abs().max(said.abs());
    match (found - said).abs() <= tolerance * size {
        true => Ok(()),
        // NaN is never near anything.
        false => Err(Fault::False(format!("{what} is {found:.9}, the statement says {said:.9}"))),
    }
}

/// The value of what a statement says of a name, in floating point, with named values put in.
pub fn value_said(statement: &Statement, name: &str, at: &dyn Fn(&str) -> Option<f64>) -> Result<f64, Fault> {
    let missing = || Fault::Undefined(format!("the statement does not say what {name} is"));
    let formula: &Expr = statement.said_of(name).ok_or_else(missing)?;
    let undefined = || Fault::False(format!("{name} = {formula} is undefined here"));
    formula.eval(&|s: &Symbol| at(s.as_str()).unwrap_or(f64::NAN)).ok_or_else(undefined)
}
