//! The connection of one angle or one position: phases of closed paths by line integrals and by Stokes' theorem.

use super::path::{Compiled, Path};
use super::quadrature::{double_integral, integral};
use crate::error::{Error, Result};
use crate::formula::{Expr, Normal, Scalar, Symbol};
use crate::mechanism::{Momentum, Row};

/// ġ = Σ aᵢ(r)·ṙᵢ: the local form of a connection whose group has one dimension.
///
/// | symbol | meaning |
/// |---|---|
/// | g | position that the symmetry moves, such as the angle of a body |
/// | r | shape |
/// | aᵢ | local form; for a momentum that is zero −hᵢ/s |
/// | Fᵢⱼ = ∂aⱼ/∂rᵢ − ∂aᵢ/∂rⱼ | curvature; zero means that g is a function of r |
/// | ∮ a·dr = ∬ F | phase of a closed path, by Stokes |
///
/// The aᵢ may hold parameters; g must not occur in them. Source: see the [module](super).
///
/// ```
/// use creepage::connection::{Connection, Path};
/// use creepage::formula::Expr;
/// use creepage::mechanism::Momentum;
/// let energy = Expr::parse("I*psi'^2/2 + m*(l + d)^2*(psi' + theta')^2/2 + m*l'^2/2").unwrap();
/// let momentum = Momentum::of(&energy, &[("psi".into(), Expr::int(1))]).unwrap();
/// let hopper = Connection::of(&momentum, &["l".into(), "theta".into()]).unwrap();
/// assert_eq!(hopper.form[1].to_string(), "-m*(l + d)^2/(I + m*(l + d)^2)");
/// assert_eq!(hopper.is_flat(), Some(false));
/// let loop_ = Path::new(&[("l", "1/2 + 3/10*cos(t)"), ("theta", "4/5*sin(t)")], [0.0, std::f64::consts::TAU]).unwrap();
/// let phase = hopper.phase(&loop_, &[("I", 1.0), ("m", 0.4), ("d", 0.6)]).unwrap();
/// assert!((phase + 0.29741719748508).abs() < 1e-14);
/// ```
#[derive(Clone, Debug)]
pub struct Connection {
    /// g.
    pub group: Symbol,
    /// r.
    pub shape: Vec<Symbol>,
    /// a, in the order of the shape.
    pub form: Vec<Expr>,
}

impl Connection {
    /// A connection by formulas: each shape variable with its coefficient.
    ///
    /// # Errors
    /// When a formula is malformed or speaks of the position.
    pub fn new(group: &str, form: &[(&str, &str)]) -> Result<Self> {
        let formulas = form.iter().map(|(_, a)| Expr::parse(a)).collect::<Result<_>>()?;
        Self { group: group.into(), shape: form.iter().map(|(r, _)| (*r).into()).collect(), form: formulas }.checked()
    }

    /// The connection of a momentum that is zero.
    ///
    /// # Errors
    /// When the momentum holds a rate that is none of the shape's, or a coefficient speaks of the position.
    pub fn of(momentum: &Momentum, shape: &[Symbol]) -> Result<Self> {
        Self::solved(&momentum.along, &momentum.locked, &momentum.shape, shape)
    }

    /// The connection of a constraint row·q̇ = 0, solved for the rate of the position.
    ///
    /// # Errors
    /// As [`Connection::of`]; and when the row does not hold the rate of the position.
    pub fn of_row(row: &Row, group: &Symbol, shape: &[Symbol]) -> Result<Self> {
        let rest = row.without(&|rate| *rate == group.rate());
        Self::solved(group, &row.coefficient(&group.rate()), &rest, shape)
    }

    fn solved(group: &Symbol, locked: &Expr, carried: &Row, shape: &[Symbol]) -> Result<Self> {
        if let Some(other) = carried.rates().find(|rate| shape.iter().all(|r| r.rate() != **rate)) {
            return Err(Error::input(format!("{other} is the rate of no shape variable"))
                .help(format!("the shape is {}", shape.iter().map(Symbol::as_str).collect::<Vec<_>>().join(", "))));
        }
        if locked.is_zero() {
            return Err(Error::input(format!("the row does not hold {}", group.rate())));
        }
        let form = shape.iter().map(|r| &-&carried.coefficient(&r.rate()) / locked).collect();
        Self { group: group.clone(), shape: shape.to_vec(), form }.checked()
    }

    fn checked(self) -> Result<Self> {
        match self.form.iter().find(|a| a.mentions(&self.group)) {
            Some(a) => Err(Error::input(format!("the local form {a} speaks of the position {}", self.group))
                .help("a connection depends on the shape alone; choose coordinates in which it does")),
            None => Ok(self),
        }
    }

    /// Fᵢⱼ = ∂aⱼ/∂rᵢ − ∂aᵢ/∂rⱼ.
    pub fn curvature(&self, i: usize, j: usize) -> Expr {
        &self.form[j].derivative(&self.shape[i]) - &self.form[i].derivative(&self.shape[j])
    }

    /// Whether the position is a function of the shape, for all values of shape and parameters: whether every curvature
    /// is zero by the normal form. `None` where that does not decide.
    ///
    /// ```
    /// use creepage::connection::Connection;
    /// let flat = Connection::new("g", &[("u", "cos(u)*sin(v)"), ("v", "sin(u)*cos(v)")]).unwrap();
    /// assert_eq!(flat.is_flat(), Some(true)); // g = sin u · sin v
    /// ```
    pub fn is_flat(&self) -> Option<bool> {
        let n = self.shape.len();
        let curved = (0..n).flat_map(|i| (0..i).map(move |j| (i, j))).map(|(i, j)| Normal::of(&self.curvature(i, j)));
        let zero = |normal: Normal| normal.is_defined().then(|| normal.is_zero());
        curved.map(zero).try_fold(true, |flat, next| Some(next? && flat))
    }

    /// How far a path of shapes moves the position: ∫ a·dr.
    ///
    /// # Errors
    /// When a formula uses a name without a value, is undefined on the path, or is not smooth there.
    pub fn phase(&self, path: &Path, values: &[(&str, f64)]) -> Result<f64> {
        let mut sum = Expr::int(0);
        for (r, a) in self.shape.iter().zip(&self.form) {
            sum = &sum + &(&path.along(a) * &path.of(r)?.derivative(&"t".into()));
        }
        let mut rate = Compiled::new(&[sum], &["t"], values)?;
        let mut out = [0.0];
        integral(path.times, |t| {
            rate.values(&[t], &mut out);
            out[0]
        })
    }

    /// The phase of a closed path as the curvature over a surface that it bounds, a cone.
    ///
    /// # Errors
    /// As [`Connection::phase`]; and when the path is not closed.
    pub fn phase_by_area(&self, path: &Path, values: &[(&str, f64)]) -> Result<f64> {
        if !path.is_closed(values)? {
            return Err(Error::input("an open path bounds no surface").help("let it end where it begins"));
        }
        let mut surface = Vec::new();
        let mut tip = Vec::new();
        for (k, r) in self.shape.iter().enumerate() {
            let (edge, name) = (path.of(r)?, format!("tip_{k}"));
            let centre = Expr::sym(name.as_str());
            surface.push((&centre + &(&Expr::sym("cone") * &(&edge - &centre)), &edge - &centre, edge));
            tip.push(name);
        }
        // Away from the edge the shape is the cone's: a − tip outwards, cone·a′ along it.
        let on = |e: &Expr| {
            let place = |s: &Symbol| self.shape.iter().position(|r| r == s).map(|k| surface[k].0.clone());
            e.substitute(&place)
        };
        let (mut sum, along) = (Expr::int(0), |k: usize| surface[k].2.derivative(&"t".into()));
        for (i, j) in (0..self.shape.len()).flat_map(|i| (i + 1..self.shape.len()).map(move |j| (i, j))) {
            let area = &(&surface[i].1 * &along(j)) - &(&surface[j].1 * &along(i));
            sum = &sum + &(&on(&self.curvature(i, j)) * &area);
        }
        let middle = self.middle(path, values)?;
        let named = tip.iter().map(String::as_str).zip(middle).chain(values.iter().copied()).collect::<Vec<_>>();
        let mut rate = Compiled::new(&[&sum * &Expr::sym("cone")], &["cone", "t"], &named)?;
        let mut out = [0.0];
        double_integral([0.0, 1.0], path.times, |s, t| {
            rate.values(&[s, t], &mut out);
            out[0]
        })
    }

    /// A point within the path: the mean of some of its points.
    fn middle(&self, path: &Path, values: &[(&str, f64)]) -> Result<Vec<f64>> {
        const POINTS: usize = 16;
        let edges = self.shape.iter().map(|r| path.of(r)).collect::<Result<Vec<_>>>()?;
        let mut edge = Compiled::new(&edges, &["t"], values)?;
        let [from, to] = path.times;
        let mut middle = vec![0.0; edges.len()];
        for i in 0..POINTS {
            let at = edge.at(&[from + (to - from) * i as f64 / POINTS as f64])?;
            middle.iter_mut().zip(at).for_each(|(m, v)| *m += v / POINTS as f64);
        }
        Ok(middle)
    }
}
