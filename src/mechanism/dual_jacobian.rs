//! Jacobian and Hessian of a constraint at a point, by forward-mode automatic differentiation with dual numbers
//! (Griewank and Walther, *Evaluating Derivatives*, 2008, chapter 3; the numbers are those of the crate `num-dual`).

use super::Constraint;
use crate::error::{Error, Result};
use crate::formula::{Dual, Expr, Symbol};
use nalgebra::{DMatrix, DVector, Dyn};
use num_dual::{Dual2Vec, hessian};

/// A number with its gradient and its Hessian.
type Second = Dual2Vec<f64, f64, Dyn>;

/// Value, gradient and Hessian of g = row·q̇ at a point of (q, q̇, e).
///
/// g(v + δ) = g + gradient·δ + ½·δᵀ·hessian·δ + O(δ³)
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | `variables` | | v: the coordinates q, their rates q̇, and the constraint's own coefficient e, in this order |
/// | `point` | | their values |
/// | `value` | m/s, or that of the row | g; zero where the point keeps to the constraint |
/// | `gradient` | | ∂g/∂v |
/// | `hessian` | | ∂²g/∂v∂v, symmetric |
///
/// Validity: any constraint, a user's own included, wherever its formulas are differentiable; no formula of a derivative
/// is used. The laws of the library hold them against the rules of differentiation.
///
/// ```
/// use creepage::mechanism::DualJacobian;
/// use creepage::model::Model;
/// let wheel = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
/// let blade = &wheel.constraints()[1];
/// let at = |name: &str| [("phi", 0.3), ("x'", 2.0), ("y'", 1.0), ("e_tc", 0.1)].iter().find(|v| v.0 == name).map(|v| v.1);
/// let found = DualJacobian::of(blade, &["x".into(), "y".into(), "phi".into()], &|s| at(s.as_str())).unwrap();
/// // ∂g/∂e = v_l
/// assert!((found.gradient[6] - (2.0 * 0.3f64.cos() + 0.3f64.sin())).abs() < 1e-15);
/// ```
///
/// Source: theory/05, the Jacobians of types R and T.
#[derive(Clone, Debug, PartialEq)]
pub struct DualJacobian {
    /// q, q̇, e.
    pub variables: Vec<Symbol>,
    /// v.
    pub point: DVector<f64>,
    /// g.
    pub value: f64,
    /// ∂g/∂v.
    pub gradient: DVector<f64>,
    /// ∂²g/∂v∂v.
    pub hessian: DMatrix<f64>,
}

impl DualJacobian {
    /// The derivatives of a constraint at the values of its symbols; a variable without a value is zero.
    ///
    /// # Errors
    /// When a symbol that is no variable has no value, or the constraint has no derivatives there.
    pub fn of(
        constraint: &Constraint,
        coordinates: &[Symbol],
        value: &impl Fn(&Symbol) -> Option<f64>,
    ) -> Result<Self> {
        let rates = coordinates.iter().map(Symbol::rate);
        let variables: Vec<Symbol> =
            coordinates.iter().cloned().chain(rates).chain([constraint.creep.clone()]).collect();
        let form = constraint.row().expr();
        let missing = form.symbols().into_iter().find(|s| !variables.contains(s) && value(s).is_none());
        if let Some(name) = missing {
            return Err(
                Error::input(format!("{}: {name} has no value", constraint.name)).help(format!("give {name}=…"))
            );
        }
        let at = DVector::from_iterator(variables.len(), variables.iter().map(|v| value(v).unwrap_or(0.0)));
        let whole = |v: DVector<Second>| by_dual_numbers(&form, &variables, &v, value);
        let (g, gradient, hessian) = hessian(whole, &at);
        match g.is_finite() && gradient.iter().chain(hessian.iter()).all(|d| d.is_finite()) {
            true => Ok(Self { variables, point: at, value: g, gradient, hessian }),
            false => Err(Error::input(format!("{}: there are no derivatives at this point", constraint.name))
                .help("choose a point where the formulas are defined")),
        }
    }

    /// ∂g/∂v.
    pub fn by(&self, variable: &Symbol) -> Option<f64> {
        self.variables.iter().position(|v| v == variable).map(|i| self.gradient[i])
    }

    /// ∂²g/∂v∂w.
    pub fn by_both(&self, first: &Symbol, second: &Symbol) -> Option<f64> {
        let place = |s: &Symbol| self.variables.iter().position(|v| v == s);
        Some(self.hessian[(place(first)?, place(second)?)])
    }
}

/// A formula with dual numbers for its variables; not a number where it is undefined.
fn by_dual_numbers(
    form: &Expr,
    variables: &[Symbol],
    at: &DVector<Second>,
    value: &impl Fn(&Symbol) -> Option<f64>,
) -> Second {
    let dual = |s: &Symbol| match variables.iter().position(|v| v == s) {
        Some(i) => Dual(at[i].clone()),
        None => Dual(Second::from_re(value(s).unwrap_or(f64::NAN))),
    };
    form.eval(&dual).map_or_else(|| Second::from_re(f64::NAN), |found| found.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Model;

    fn wheel() -> Vec<Constraint> {
        Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().constraints()
    }

    fn of(values: &[(&str, f64)]) -> Result<DualJacobian> {
        let coordinates = ["x", "y", "phi", "theta"].map(Symbol::from);
        let value = |s: &Symbol| values.iter().find(|(n, _)| *n == s.as_str()).map(|(_, v)| *v);
        DualJacobian::of(&wheel()[1], &coordinates, &value)
    }

    /// g = (sin φ + e·cos φ)·ẋ − (cos φ − e·sin φ)·ẏ, by hand.
    #[test]
    fn type_t_has_the_derivatives_of_the_theory() {
        let (phi, x, y, e) = (0.4f64, 1.5, -0.7, 0.2);
        let found = of(&[("phi", phi), ("x'", x), ("y'", y), ("e_tc", e)]).unwrap();
        let (forward, left) = (x * phi.cos() + y * phi.sin(), y * phi.cos() - x * phi.sin());
        let near = |a: Option<f64>, b: f64| assert!((a.unwrap() - b).abs() < 1e-14, "{a:?} {b}");
        let (phi_, e_) = (Symbol::from("phi"), Symbol::from("e_tc"));
        near(Some(found.value), e * forward - left);
        near(found.by(&phi_), forward + e * left);
        near(found.by(&e_), forward);
        near(found.by_both(&phi_, &phi_), left - e * forward);
        near(found.by_both(&phi_, &e_), left);
        near(found.by_both(&e_, &phi_), left);
        near(found.by_both(&e_, &e_), 0.0);
        near(found.by_both(&phi_, &"x'".into()), phi.cos() - e * phi.sin());
        assert_eq!(found.by(&"r".into()), None);
    }

    #[test]
    fn what_has_no_value_is_told() {
        let e = DualJacobian::of(&wheel()[0], &["phi".into()], &|_| None).unwrap_err();
        assert_eq!(e.exit_code(), 2);
        let e = of(&[("phi", f64::INFINITY)]).unwrap_err();
        assert!(e.message().contains("no derivatives at this point"), "{e}");
    }
}
