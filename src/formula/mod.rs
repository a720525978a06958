//! The language of formulas: expressions as data, read by one evaluator in many carriers.
//!
//! | carrier | reading | type |
//! |---|---|---|
//! | floating point | value | `f64` |
//! | dual numbers | first and second derivatives, vectors of any length | [`Dual`] |
//! | exact numbers | a proof at a point: rationals, angles as rational points of the circle | [`Exact`] |
//! | normal form | a proof for all values: quotients of trigonometric polynomials | [`Normal`] |
//! | power series | all derivatives at a point, exactly | [`Jet`] |
//! | unit exponents | units of a formula, or why it has none | [`Unit`] |
//! | expressions | substitution | [`Expr`] |
//!
//! A carrier is any [`Scalar`]; [`Expr::eval`] is the one evaluator. "Undefined" is a value of every
//! carrier that equals nothing, itself included ([`Scalar::equals`]). For speed an expression compiles
//! once to a flat [`Program`] with shared sub-expressions; derivatives are taken on its [`Graph`]. [`Lanes`] run a
//! program over blocks of cases by vector instructions.

mod angles;
mod derive;
mod dual;
mod exact;
mod expr;
mod float;
mod fun;
mod graph;
mod jet;
mod lanes;
mod latex;
mod lex;
mod markup;
mod normal;
mod parse;
mod polynomial;
mod print;
mod program;
mod rational;
mod scalar;
mod serial;
mod size;
mod substitute;
mod symbol;
mod typst;
mod unit;

pub use dual::Dual;
#[doc(hidden)]
pub use dual::Parts;
pub use exact::Exact;
pub use expr::Expr;
#[doc(hidden)]
pub use expr::Node;
#[doc(hidden)]
pub use fun::Fun;
pub use graph::Graph;
#[doc(hidden)]
pub use graph::{NodeId, Op};
pub use jet::Jet;
#[doc(hidden)]
pub use jet::Layout;
pub use lanes::Lanes;
#[doc(hidden)]
pub use lanes::{Changes, Isa, Kernel, Memory, Rows};
#[doc(hidden)]
pub use latex::latex_symbol;
pub(crate) use lex::{caret, column_of};
pub(crate) use normal::with_work_bounded;
pub use normal::{Normal, identical};
#[doc(hidden)]
pub use polynomial::Polynomial;
pub use program::Program;
#[doc(hidden)]
pub use rational::{BigInt, BigRational, exact_f64, nearest_f64};
pub use scalar::Scalar;
#[doc(hidden)]
pub use size::Size;
pub use symbol::Symbol;
pub use unit::Unit;
