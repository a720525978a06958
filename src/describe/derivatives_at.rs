//! First and second derivatives of a model's constraints at a point, by dual numbers.

use super::page::Page;
use crate::error::{Error, Result};
use crate::formula::Symbol;
use crate::mechanism::{Constraint, DualJacobian};
use crate::model::Model;
use serde_json::{Map, Value, json as object};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::str::FromStr;

/// A point that a user gives: names with their values, `phi=0.3`, or all coordinates in their order, `q=0,0,0.3`, and all
/// their rates, `q'=1,0,0`.
///
/// ```
/// use creepage::describe::GivenPoint;
/// let point: GivenPoint = "q=0,0,0.3,0,e_tc=0.1".parse().unwrap();
/// assert_eq!(point.entries.len(), 2);
/// assert!("phi=fast".parse::<GivenPoint>().is_err());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GivenPoint {
    /// Names and what stands behind them.
    pub entries: Vec<(String, Vec<f64>)>,
}

impl FromStr for GivenPoint {
    type Err = Error;
    fn from_str(text: &str) -> Result<Self> {
        let mut entries: Vec<(String, Vec<f64>)> = Vec::new();
        for part in text.split(',') {
            let number = match part.split_once('=') {
                Some((name, number)) => {
                    entries.push((name.trim().into(), Vec::new()));
                    number
                }
                None => part,
            };
            let value = number.trim().parse::<f64>().ok().filter(|v| v.is_finite());
            match (entries.last_mut(), value) {
                (Some((_, values)), Some(value)) => values.push(value),
                _ => {
                    return Err(Error::input(format!("\"{}\" gives no value", part.trim()))
                        .help("write NAME=NUMBER, or q=NUMBER,NUMBER,… for all coordinates"));
                }
            }
        }
        Ok(Self { entries })
    }
}

/// Derivatives of every constraint of a model at one point of (q, q̇, e).
///
/// g(v + δ) = g + gradient·δ + ½·δᵀ·hessian·δ + O(δ³)
///
/// Parameters have the model's values, and so have coefficients that the model gives; other variables that are not given
/// are zero. The derivatives are those of [`DualJacobian`], whatever the formulas are.
///
/// ```
/// use creepage::describe::DerivativesAt;
/// let wheel = creepage::model::Model::new("unicycle", &[("wheel_radius", 0.5)])?;
/// let found = DerivativesAt::of(&wheel, &"phi=0.5,x'=1".parse()?)?;
/// let blade = &found.constraints[1].1;
/// assert!((blade.by(&"phi".into()).unwrap() - 0.5f64.cos()).abs() < 1e-15);
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct DerivativesAt {
    /// The point: every variable of any constraint.
    pub point: Vec<(Symbol, f64)>,
    /// Each constraint's name and its derivatives.
    pub constraints: Vec<(String, DualJacobian)>,
}

impl DerivativesAt {
    /// The derivatives of a model's constraints at a point.
    ///
    /// # Errors
    /// When the point has a name that no constraint has, or as many values as there are no coordinates; and as
    /// [`DualJacobian::of`].
    pub fn of(model: &Model, given: &GivenPoint) -> Result<Self> {
        let coordinates = model.coordinates();
        let constraints = model.constraints();
        let values = super::symbols::values(model, &model.row_definitions()?)?;
        let in_rows: BTreeSet<Symbol> = constraints.iter().flat_map(|c| c.row().expr().symbols()).collect();
        let is_rate = |s: &Symbol| coordinates.iter().any(|q| q.rate() == *s);
        let creeps = |s: &Symbol| constraints.iter().any(|c| c.creep == *s);
        // What a row reads beside the coordinates, such as the angle of a wheel that is steered.
        let others =
            in_rows.iter().filter(|s| !coordinates.contains(s) && !is_rate(s) && !creeps(s) && !values.contains_key(s));
        let variables: Vec<Symbol> = coordinates.iter().chain(others).cloned().collect();
        let known = |s: &Symbol| in_rows.contains(s) || variables.contains(s) || is_rate(s) || creeps(s);
        let mut at = values.clone();
        for (name, numbers) in &given.entries {
            at.extend(named(name, numbers, &coordinates, &known)?);
        }
        let derivatives = |c: &Constraint| {
            let found = DualJacobian::of(c, &variables, &|s| at.get(s).copied());
            Ok((c.name.clone(), found?))
        };
        let constraints: Vec<_> = constraints.iter().map(derivatives).collect::<Result<_>>()?;
        let mut point: Vec<(Symbol, f64)> = Vec::new();
        let given = given.entries.iter().map(|(name, _)| Symbol::new(name)).filter(known);
        for variable in constraints.iter().flat_map(|(_, d)| d.variables.iter().cloned()).chain(given) {
            if !point.iter().any(|(name, _)| *name == variable) {
                let value = at.get(&variable).copied().unwrap_or(0.0);
                point.push((variable, value));
            }
        }
        Ok(Self { point, constraints })
    }

    pub(super) fn text(&self, page: &mut Page) {
        page.heading(2, "Derivatives at a point");
        let point: Vec<String> = self.point.iter().map(|(name, v)| format!("{name} = {v}")).collect();
        page.paragraph(&format!(
            "By dual numbers at {}. What is not given is zero; parameters are the model's. A derivative that is not listed is \
             zero at the point.",
            point.join(", ")
        ));
        for (i, (name, d)) in self.constraints.iter().enumerate() {
            page.heading(3, &format!("{}. {name}", i + 1));
            page.formula(&format!("g = {}", d.value));
            first(d).for_each(|(v, x)| page.formula(&format!("dg/d({v}) = {x}")));
            second(d).for_each(|(v, w, x)| page.formula(&format!("d2g/(d({v})*d({w})) = {x}")));
        }
        page.gap();
    }

    pub(super) fn json(&self) -> Value {
        let numbers = |entries: &[(Symbol, f64)]| {
            Value::Object(entries.iter().map(|(s, v)| (s.to_string(), (*v).into())).collect::<Map<_, _>>())
        };
        let constraint = |(name, d): &(String, DualJacobian)| {
            let gradient: Vec<(Symbol, f64)> = d.variables.iter().cloned().zip(d.gradient.iter().copied()).collect();
            let hessian = second(d).map(|(v, w, x)| object!({"by": [v.as_str(), w.as_str()], "value": x}));
            object!({
                "name": name, "value": d.value, "gradient": numbers(&gradient), "hessian": hessian.collect::<Vec<_>>(),
            })
        };
        object!({
            "point": numbers(&self.point),
            "constraints": self.constraints.iter().map(constraint).collect::<Vec<_>>(),
        })
    }

    pub(super) fn latex(&self, out: &mut String, symbol: &impl Fn(&Symbol) -> String) {
        let point: Vec<String> = self.point.iter().map(|(name, v)| format!("${} = {v}$", symbol(name))).collect();
        let _ = writeln!(out, "\\section{{Derivatives at a point}}\nBy dual numbers at {}.", point.join(", "));
        for (i, (_, d)) in self.constraints.iter().enumerate() {
            let _ = writeln!(out, "\nConstraint {}:\n\\begin{{align*}}\ng &= {}", i + 1, d.value);
            for (v, x) in first(d) {
                let _ = writeln!(out, "\\\\\n\\partial g/\\partial {} &= {x}", symbol(v));
            }
            for (v, w, x) in second(d) {
                let _ = writeln!(out, "\\\\\n\\partial^2 g/\\partial {}\\,\\partial {} &= {x}", symbol(v), symbol(w));
            }
            let _ = writeln!(out, "\\end{{align*}}");
        }
    }
}

/// The gradient but for its zeros.
fn first(d: &DualJacobian) -> impl Iterator<Item = (&Symbol, f64)> {
    d.variables.iter().zip(d.gradient.iter().copied()).filter(|(_, x)| *x != 0.0)
}

/// The upper half of the Hessian but for its zeros.
fn second(d: &DualJacobian) -> impl Iterator<Item = (&Symbol, &Symbol, f64)> {
    let pairs = (0..d.variables.len()).flat_map(|i| (i..d.variables.len()).map(move |j| (i, j)));
    pairs.map(|(i, j)| (&d.variables[i], &d.variables[j], d.hessian[(i, j)])).filter(|(.., x)| *x != 0.0)
}

/// The values that an entry of a point gives.
fn named(
    name: &str,
    numbers: &[f64],
    coordinates: &[Symbol],
    known: &impl Fn(&Symbol) -> bool,
) -> Result<BTreeMap<Symbol, f64>> {
    let symbol = Symbol::new(name);
    let all: Vec<Symbol> =
        match name {
            _ if known(&symbol) => vec![symbol],
            "q" => coordinates.to_vec(),
            "q'" => coordinates.iter().map(Symbol::rate).collect(),
            _ => {
                let names: Vec<&str> = coordinates.iter().map(Symbol::as_str).collect();
                return Err(Error::input(format!("no constraint of the model has a variable \"{name}\""))
                    .help(format!("the coordinates are {}; a rate is written {}'", names.join(", "), names[0])));
            }
        };
    match all.len() == numbers.len() {
        true => Ok(all.into_iter().zip(numbers.iter().copied()).collect()),
        false => Err(Error::input(format!("{name} takes {} values and has {}", all.len(), numbers.len()))
            .help(format!("give one for each of {}", all.iter().map(Symbol::as_str).collect::<Vec<_>>().join(", ")))),
    }
}
