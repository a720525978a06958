//! Readings of the word "conservative" in the paper's Fig. 7, as laws for the rates of the wheel.
//!
//! The paper asks that m·v² + I·φ̇² + J·θ̇² stay what it is for the ideal wheel and does not say how. Each
//! [`Reading`] is one way to do so; A is adopted, the others are kept because the paper's plot was not at
//! hand to decide (theory/08-simulation).

use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use crate::model::Equations;
use crate::motion::{Drive, Formulas, Integrator, Method, assembled};

/// Data of Fig. 7: SI units, the ideal rates are φ̇ = w and θ̇ = u_0 + g·t.
pub(crate) const DATA: [(&str, f64); 7] =
    [("r", 0.5), ("m", 1.0), ("I", 0.5), ("J", 1.0), ("w", 1.0), ("u_0", 2.0), ("g", -0.05)];

/// How long Fig. 7 runs, s.
pub const FIG7_DURATION: f64 = std::f64::consts::TAU;

/// Formulas that the laws share, each using only those after it; the table of [`Reading`] says what they mean.
/// `side` is 0 where the reading leaves v_t out of |v|, else 1.
const SHARED: [(&str, &str); 7] = [
    ("lambda", "sqrt((a + b*u^2)/(a + c*u^2))"),
    ("lambda_0", "sqrt((a + b*u_0^2)/(a + c*u_0^2))"),
    ("a", "I*w^2"),
    ("b", "m*r^2 + J"),
    ("c", "m*r^2*(1 - e_rc)^2*(1 + side*e_tc^2) + J"),
    ("E_0", "I*w^2 + (m*r^2 + J)*u_0^2"),
    ("u", "u_0 + g*t"),
];

/// A reading of "conservative": which rates are scaled so that the energy rule holds, and when.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | w, u | rad/s | ideal yaw rate and wheel rate |
/// | a | J | I·w²; a + b·u² is twice the ideal energy, a + c·u² the crept one at the same rates |
/// | b, c | kg·m² | m·r² + J and m·r²·\|κ\|² + J with κ = (1 − e_rc)(1 + i·e_tc) |
/// | λ | 1 | √((a + b·u²)/(a + c·u²)) |
/// | E₀ | J | twice the ideal energy at t = 0 |
///
/// Source: paper, *Simulation*; theory/08-simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// φ̇ = w, θ̇ = u: no rule.
    NonConservative,
    /// φ̇ = λw, θ̇ = λu: at every instant the energy of the ideal wheel. Adopted.
    A,
    /// As A with v_l for |v|.
    AL,
    /// φ̇ = w, θ̇ = √(b/c)·u: only the rolling is scaled.
    B,
    /// θ̇ = u, φ̇ from the rule with the energy frozen at E₀.
    C1,
    /// Both scaled so that the energy is frozen at E₀.
    C2,
    /// θ̇ = u, φ̇ from the rule with the energy of the ideal wheel.
    D,
    /// Both scaled once at t = 0, then θ̈ as prescribed and φ̈ = 0.
    F,
}

impl Reading {
    /// Every reading.
    pub const ALL: [Reading; 8] = [
        Reading::NonConservative,
        Reading::A,
        Reading::AL,
        Reading::B,
        Reading::C1,
        Reading::C2,
        Reading::D,
        Reading::F,
    ];

    /// Its name in theory/08-simulation.
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// The laws of φ̇ and θ̇ in the symbols of the table above.
    pub fn laws(self) -> [&'static str; 2] {
        self.row().1
    }

    fn row(self) -> (&'static str, [&'static str; 2]) {
        match self {
            Reading::NonConservative => ("nonconservative", ["w", "u"]),
            Reading::A => ("A", ["lambda*w", "lambda*u"]),
            Reading::AL => ("A_l", ["lambda*w", "lambda*u"]),
            Reading::B => ("B", ["w", "sqrt(b/c)*u"]),
            Reading::C1 => ("C1", ["sqrt((E_0 - c*u^2)/I)", "u"]),
            Reading::C2 => ("C2", ["sqrt(E_0/(a + c*u^2))*w", "sqrt(E_0/(a + c*u^2))*u"]),
            Reading::D => ("D", ["sqrt((a + b*u^2 - c*u^2)/I)", "u"]),
            Reading::F => ("F", ["lambda_0*w", "lambda_0*u_0 + g*t"]),
        }
    }

    /// φ̇ and θ̇ of Fig. 7 as formulas of the time `t`, inputs for [`simulate`](crate::motion::simulate) once in the
    /// order of the model's inputs.
    ///
    /// # Errors
    /// Never for the laws of this table.
    pub fn rates(self, e_rc: f64, e_tc: f64) -> Result<Formulas> {
        let mut constants: Vec<(Symbol, f64)> = DATA.iter().map(|(s, v)| ((*s).into(), *v)).collect();
        let side = if self == Reading::AL { 0.0 } else { 1.0 };
        constants.extend([("e_rc", e_rc), ("e_tc", e_tc), ("side", side)].map(|(s, v)| (Symbol::from(s), v)));
        Formulas::new(&self.spelled()?, &constants)
    }

    /// φ̇ and θ̇ of Fig. 7 in the time `t`, the data r, m, I, J, w, u_0, g and the creeps e_rc, e_tc alone.
    ///
    /// # Errors
    /// Never for the laws of this table.
    pub fn spelled(self) -> Result<Vec<Expr>> {
        self.laws().iter().map(|law| spelled_out(law)).collect()
    }
}

/// A law with the shared formulas put in.
fn spelled_out(law: &str) -> Result<Expr> {
    SHARED.iter().try_fold(Expr::parse(law)?, |law, (name, formula)| {
        let formula = Expr::parse(formula)?;
        Ok(law.substitute(&|s| (s.as_str() == *name).then(|| formula.clone())))
    })
}

/// Where the wheel of Fig. 7 is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndPoint {
    /// m
    pub x: f64,
    /// m
    pub y: f64,
    /// Heading, rad.
    pub phi: f64,
    /// Rolling angle, rad.
    pub theta: f64,
    /// Length of the path, m.
    pub distance: f64,
}

/// The end point of a case of Fig. 7 under a reading, after 2π s.
///
/// | symbol | meaning |
/// |---|---|
/// | e_rc | coefficient of rotation creep, (24) |
/// | e_tc | coefficient of traverse creep, (25) |
///
/// The wheel is the catalogue's `unicycle` with the effects `rotation-creep` and `traverse-creep`; a reading
/// only says how fast it is driven. Error below 1e-11. Ideal: no creep and [`Reading::NonConservative`].
///
/// # Errors
/// When the energy rule has no solution on the way: creep so strong that C1 or D leave nothing for φ̇.
///
/// ```
/// use creepage::energy_rule::{fig7_case, Reading};
/// let ideal = fig7_case(0.0, 0.0, Reading::NonConservative).unwrap();
/// assert!(ideal.x.abs() < 1e-11 && (ideal.y - std::f64::consts::PI / 20.0).abs() < 1e-11);
/// ```
pub fn fig7_case(e_rc: f64, e_tc: f64, reading: Reading) -> Result<EndPoint> {
    let path = fig7_path(e_rc, e_tc, reading, &[FIG7_DURATION])?;
    Ok(path[0])
}

/// The places of a case of Fig. 7 at given times, from the start at t = 0.
///
/// # Errors
/// As [`fig7_case`].
///
/// ```
/// use creepage::energy_rule::{fig7_path, Reading};
/// let path = fig7_path(-0.1, -0.2, Reading::A, &[0.0, 0.5, 1.0]).unwrap();
/// assert_eq!(path[0].distance, 0.0);
/// ```
pub fn fig7_path(e_rc: f64, e_tc: f64, reading: Reading, times: &[f64]) -> Result<Vec<EndPoint>> {
    let (wheel, rates) = (wheel(e_rc, e_tc)?, reading.rates(e_rc, e_tc)?);
    let mut values = rates.values();
    let rates = |t| {
        let mut both = [0.0; 2];
        values(t, &mut both);
        both
    };
    let rows = travel(&wheel, rates, 0.0, &[0.0; 5], times)?;
    Ok(rows.iter().map(|y| end_point(y)).collect())
}

/// The instant of a step at which its rates are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instant {
    /// The start: the paper's "initial velocities in every integration step"; converges at order 1.
    Start,
    /// The middle; converges at order 2.
    Middle,
}

/// Fig. 7 as the paper words it: rates rescaled once in every integration step and held during it.
///
/// Tends to [`fig7_case`] with the number of steps, at order 1 for [`Instant::Start`], 2 for [`Instant::Middle`].
///
/// # Errors
/// As [`fig7_case`]; and for no step at all.
///
/// ```
/// use creepage::energy_rule::{fig7_case, fig7_stepwise, Instant, Reading};
/// let limit = fig7_case(-0.1, -0.2, Reading::A).unwrap();
/// let steps = fig7_stepwise(-0.1, -0.2, Reading::A, 100, Instant::Middle).unwrap();
/// assert!((steps.x - limit.x).abs() < 1e-4);
/// ```
pub fn fig7_stepwise(e_rc: f64, e_tc: f64, reading: Reading, steps: usize, instant: Instant) -> Result<EndPoint> {
    if steps == 0 {
        return Err(Error::input("a run in steps needs at least one"));
    }
    let (wheel, rates) = (wheel(e_rc, e_tc)?, reading.rates(e_rc, e_tc)?);
    let time = |i: usize| FIG7_DURATION * i as f64 / steps as f64;
    let mut y = vec![0.0; 5];
    for i in 0..steps {
        let (from, to) = (time(i), time(i + 1));
        let held = match instant {
            Instant::Start => at(&rates, from),
            Instant::Middle => at(&rates, (from + to) / 2.0),
        };
        y = travel(&wheel, |_| held, from, &y, &[to])?.remove(0);
    }
    Ok(end_point(&y))
}

/// φ̇ and θ̇ at a time.
pub(crate) fn at(rates: &Formulas, t: f64) -> [f64; 2] {
    let (mut value, mut slope) = ([0.0; 2], [0.0; 2]);
    rates.at(t, &mut value, &mut slope);
    value
}

fn end_point(y: &[f64]) -> EndPoint {
    EndPoint { x: y[0], y: y[1], phi: y[2], theta: y[3], distance: y[4] }
}

/// The equations of the catalogue's wheel with its two creeps.
pub(crate) fn wheel(e_rc: f64, e_tc: f64) -> Result<Equations> {
    let creeps = [("rotation-creep", None, vec![e_rc]), ("traverse-creep", None, vec![e_tc])];
    assembled("unicycle", &[("wheel_radius", DATA[0].1)], &[], &creeps)?.equations(&[])
}

/// Integrates the wheel's pose, rolling angle and path length.
fn travel(
    wheel: &Equations,
    mut rates: impl FnMut(f64) -> [f64; 2],
    from: f64,
    start: &[f64],
    times: &[f64],
) -> Result<Vec<Vec<f64>>> {
    let mut w = wheel.workspace(&[]);
    let place: Vec<usize> = wheel.inputs.iter().map(|name| usize::from(name.as_str() != "yaw_rate")).collect();
    let mut u = vec![0.0; place.len()];
    let rhs = |t: f64, y: &[f64], dy: &mut [f64]| {
        let both = rates(t);
        let wheel_rate = both[1];
        u.iter_mut().zip(&place).for_each(|(u, k)| *u = both[*k]);
        wheel.rates(&mut w, &y[..3], &u, &mut dy[..3]);
        dy[3] = wheel_rate;
        dy[4] = dy[0].hypot(dy[1]);
    };
    // Not the integrator of fits: what the paper's figure shows rests on none of their code.
    let independent = Integrator { method: Method::Dopri5, ..Integrator::default() };
    independent.with_tolerance(1e-13, 1e-14).solve(rhs, from, start, times)
}
