//! The choice of quasi-velocities: rates of a vehicle that its ideal contacts leave free, and the others by them.

use super::bodies::castors;
use super::contact::Contact;
use super::rate_forms::RateForms;
use super::time_derivative::TimeDerivative;
use crate::error::{Error, Result};
use crate::formula::{Expr, Polynomial, Symbol};
use crate::mechanism::{Row, solve};
use crate::model::trailer::trailer_heading;
use crate::vehicles::Vehicle;
use nalgebra::DMatrix;

/// The rates of the body.
const BODY: [&str; 3] = ["v_l", "v_t", "phi'"];
/// Which of them follow from the contacts, where several choices would do: the forward speed last, for it stays free
/// in every turn of the steering.
const FOLLOWING: [&[&str]; 8] =
    [&[], &["v_t"], &["phi'"], &["v_l"], &["v_t", "phi'"], &["v_l", "v_t"], &["v_l", "phi'"], &["v_l", "v_t", "phi'"]];

/// A vehicle as its ideal contacts see it.
pub(super) struct Contacts<'a> {
    pub vehicle: &'a Vehicle,
    /// Contacts of the body, by body rates.
    pub of_body: &'a [Contact],
    /// Contacts of the trailers, each by the rates of the section ahead.
    pub of_trailers: &'a [Contact],
    /// v_i and vt_i of each trailer's axle.
    pub axles: &'a [[(Symbol, Row); 2]],
    /// Rates of the wheels that roll.
    pub wheels: &'a [Symbol],
    /// Symbols that inputs move.
    pub given: &'a [Symbol],
}

/// The name of a quasi-velocity.
pub(super) fn speed_of(rate: &Symbol) -> Symbol {
    Symbol::new(&match rate.as_str() {
        "v_l" => "body.u".to_string(),
        "v_t" => "body.w".to_string(),
        "phi'" => "body.omega".to_string(),
        other => match other.strip_prefix("phi_").and_then(|i| i.strip_suffix('\'')) {
            Some(i) => format!("trailer_{i}.omega"),
            None => format!("{}.omega", other.trim_end_matches('\'')),
        },
    })
}

impl Contacts<'_> {
    /// All rates by the free ones.
    ///
    /// # Errors
    /// When the ideal contacts leave nothing to be solved for where they should.
    pub fn rate_forms(&self) -> Result<RateForms> {
        let mut forms = RateForms::along(self.motion());
        let ideal = self.of_body.iter().filter(|c| c.law.is_none());
        let mut rows: Vec<Row> = ideal.map(|c| self.on_line(&c.slip)).collect();
        let angles: Vec<Symbol> =
            castors(self.vehicle).iter().map(Symbol::rate).chain(self.wheels.iter().cloned()).collect();
        let turning = solve_angles(&mut rows, &angles);
        self.body(&rows, &mut forms)?;
        for rate in &angles {
            match turning.iter().find(|(solved, _)| solved == rate) {
                Some((_, row)) => forms.follow(rate.clone(), row),
                None => forms.set_free(rate.clone(), speed_of(rate)),
            }
        }
        for (i, (contact, axle)) in self.of_trailers.iter().zip(self.axles).enumerate() {
            let rate = trailer_heading(i + 1).rate();
            match contact.law.is_none() {
                true => forms.follow(rate.clone(), &isolated(&contact.slip, &rate)),
                false => forms.set_free(rate.clone(), speed_of(&rate)),
            }
            axle.iter().for_each(|(name, row)| forms.follow(name.clone(), row));
        }
        Ok(forms)
    }

    fn motion(&self) -> TimeDerivative {
        let headings = (1..=self.of_trailers.len()).map(trailer_heading);
        let angles = std::iter::once("phi".into()).chain(headings).chain(castors(self.vehicle));
        TimeDerivative::of_angles(angles, self.given.iter().cloned())
    }

    /// A row without what a body on a line does not do.
    fn on_line(&self, row: &Row) -> Row {
        row.without(&|rate| self.vehicle.line && ["v_t", "phi'"].contains(&rate.as_str()))
    }

    /// v_l, v_t and φ' from the rows that are left.
    fn body(&self, rows: &[Row], forms: &mut RateForms) -> Result<()> {
        let moving: Vec<Symbol> =
            BODY.iter().take(if self.vehicle.line { 1 } else { 3 }).map(|s| (*s).into()).collect();
        let still = BODY.iter().skip(moving.len()).map(|s| Symbol::from(*s));
        let following = self.following(rows, &moving);
        let solved = solve::together(rows, &following).ok_or_else(|| {
            Error::input(format!("the ideal contacts of {} do not determine {following:?}", self.vehicle.id))
        })?;
        let free: Vec<&Symbol> = moving.iter().filter(|s| !following.contains(s)).collect();
        free.iter().for_each(|rate| forms.set_free((*rate).clone(), speed_of(rate)));
        for (rate, formula) in &solved {
            let mut row = Row::default();
            free.iter().for_each(|by| row.add((*by).clone(), &formula.derivative(by)));
            forms.follow(rate.clone(), &row);
        }
        still.for_each(|rate| forms.follow(rate, &Row::default()));
        Ok(())
    }

    /// The rates of the body that the rows determine: a choice that holds with the wheels straight, where one does.
    fn following(&self, rows: &[Row], moving: &[Symbol]) -> Vec<Symbol> {
        let values = |straight: bool, of: &[Symbol]| -> Vec<Vec<f64>> {
            rows.iter().map(|row| of.iter().map(|s| self.value(&row.coefficient(s), straight)).collect()).collect()
        };
        let full = rank(&values(false, moving));
        let choices = FOLLOWING.iter().map(|c| c.iter().map(|s| Symbol::from(*s)).collect::<Vec<_>>());
        let fitting: Vec<Vec<Symbol>> =
            choices.filter(|c| c.len() == full && c.iter().all(|s| moving.contains(s))).collect();
        let holds = |straight: bool| fitting.iter().find(|c| rank(&values(straight, c)) == full).cloned();
        holds(true).or_else(|| holds(false)).unwrap_or_default()
    }

    /// A coefficient somewhere: lengths and radii of about one, the wheels turned or straight.
    fn value(&self, formula: &Expr, straight: bool) -> f64 {
        formula.eval_undefined_as_value(&|s| self.symbol(s, straight))
    }

    fn symbol(&self, name: &Symbol, straight: bool) -> f64 {
        if let Some(d) = self.vehicle.define.get(name) {
            return self.value(&d.formula, straight);
        }
        // Any numbers do that no two symbols share.
        let spread = name.as_str().bytes().fold(7_u32, |h, b| h.wrapping_mul(31).wrapping_add(u32::from(b)));
        let share = f64::from(spread % 1000) / 1000.0;
        let is_angle = self.vehicle.inputs.contains_key(name.as_str()) || castors(self.vehicle).contains(name);
        match (name.as_str(), is_angle, straight) {
            ("pi", _, _) => std::f64::consts::PI,
            (_, true, true) => 0.0,
            (_, true, false) => 0.2 + 0.3 * share,
            _ => 0.6 + share,
        }
    }
}

/// How many of the rows are independent.
fn rank(rows: &[Vec<f64>]) -> usize {
    let width = rows.first().map_or(0, Vec::len);
    // The decomposition knows no empty matrix.
    if width == 0 { 0 } else { DMatrix::from_fn(rows.len(), width, |i, k| rows[i][k]).rank(1e-9) }
}

/// Rates of wheels and castors, each from the first row that has it, which is used up.
fn solve_angles(rows: &mut Vec<Row>, angles: &[Symbol]) -> Vec<(Symbol, Row)> {
    let mut solved: Vec<(Symbol, Row)> = Vec::new();
    for rate in angles {
        let Some(at) = rows.iter().position(|row| !row.coefficient(rate).is_zero()) else { continue };
        let own = isolated(&rows.remove(at), rate);
        let by_own = |s: &Symbol| (s == rate).then(|| own.clone());
        rows.iter_mut().for_each(|row| *row = row.with_rates(&by_own));
        solved.iter_mut().for_each(|(_, row)| *row = row.with_rates(&by_own));
        solved.push((rate.clone(), own));
    }
    rows.retain(|row| row.terms().iter().any(|(_, c)| !Polynomial::of(c).is_zero()));
    solved
}

/// A rate from a row that vanishes.
fn isolated(row: &Row, rate: &Symbol) -> Row {
    let divisor = row.coefficient(rate);
    let mut found = Row::default();
    for (other, c) in row.terms().iter().filter(|(s, _)| s != rate) {
        found.add(other.clone(), &(&-c / &divisor));
    }
    found
}
