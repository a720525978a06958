//! The connection of an orientation in space: rotations by integration of Ṙ = R·ω^.

use super::path::{Compiled, Path};
use super::space;
use super::space::{Matrix, Vector};
use crate::error::Result;
use crate::formula::{Expr, Symbol};
use crate::motion::Integrator;

/// ω = Σ Aᵢ(r)·ṙᵢ: the angular velocity of a body, in the body's own frame, that a change of shape makes.
///
/// | symbol | meaning |
/// |---|---|
/// | R | orientation, Ṙ = R·ω^ with ω^·v = ω × v |
/// | Aᵢ | local form, a vector for each shape variable |
/// | Fᵢⱼ = ∂Aⱼ/∂rᵢ − ∂Aᵢ/∂rⱼ + Aᵢ × Aⱼ | curvature; a small loop turns by F times its area |
///
/// Turns do not commute: the holonomy of a loop is no integral, and is found by integrating R along it. Source: see the
/// [module](super); Kane & Scher, A dynamical explanation of the falling cat phenomenon (1969).
///
/// ```
/// use creepage::connection::{Axis, Path, RotationConnection, turned};
/// use creepage::formula::Expr;
/// // The falling cat: two equal halves, bent by gamma towards tau, no twist between them.
/// let [gamma, tau] = ["gamma", "tau"].map(Expr::sym);
/// let bent = turned(&[(Axis::Z, tau.clone()), (Axis::Y, gamma), (Axis::Z, -&tau)]);
/// let half = ["1", "1", "1/4"].map(|j| Expr::parse(j).unwrap());
/// let cat = RotationConnection::of_two_bodies(&half, &half, &bent, &["gamma".into(), "tau".into()]);
/// let path = Path::new(&[("gamma", "1"), ("tau", "t")], [0.0, std::f64::consts::TAU]).unwrap();
/// let turned = cat.holonomy(&path, &[]).unwrap();
/// assert!((turned.angle() - 3.0196).abs() < 5e-5);
/// ```
#[derive(Clone, Debug)]
pub struct RotationConnection {
    /// r.
    pub shape: Vec<Symbol>,
    /// A, in the order of the shape.
    pub form: Vec<[Expr; 3]>,
}

impl RotationConnection {
    /// The connection of two bodies joined at their common centre, angular momentum zero:
    /// J₁·ω + Q·J₂·Qᵀ·(ω + ω_Q) = 0.
    ///
    /// | symbol | meaning |
    /// |---|---|
    /// | J₁, J₂ | principal moments of inertia of either body, in its own frame |
    /// | Q | orientation of the second body in the frame of the first |
    /// | ω_Q | angular velocity of the second body in the first, ω_Q^ = Q̇·Qᵀ |
    ///
    /// ω = −(J₁ + Q·J₂·Qᵀ)⁻¹·Q·J₂·Qᵀ·ω_Q.
    pub fn of_two_bodies(first: &[Expr; 3], second: &[Expr; 3], q: &Matrix, shape: &[Symbol]) -> Self {
        let diagonal = |j: &[Expr; 3]| space::built(|i, k| if i == k { j[i].clone() } else { Expr::int(0) });
        let back = space::transposed(q);
        let carried = tidied(&space::times(&space::times(q, &diagonal(second)), &back));
        let locked = space::plus(&diagonal(first), &carried);
        let form = shape.iter().map(|r| {
            let relative = space::axial(&tidied(&space::times(&space::derivative(q, r), &back)));
            let momentum = space::applied(&carried, &relative).map(|h| -&h.tidy());
            space::solved(&locked, &momentum)
        });
        Self { shape: shape.to_vec(), form: form.collect() }
    }

    /// Fᵢⱼ = ∂Aⱼ/∂rᵢ − ∂Aᵢ/∂rⱼ + Aᵢ × Aⱼ.
    pub fn curvature(&self, i: usize, j: usize) -> [Expr; 3] {
        let turn = space::cross(&self.form[i], &self.form[j]);
        let slope = |of: usize, by: usize, k: usize| self.form[of][k].derivative(&self.shape[by]);
        std::array::from_fn(|k| &(&slope(j, i, k) - &slope(i, j, k)) + &turn[k])
    }

    /// How far a path of shapes turns the body: R at its end, from R = 1.
    ///
    /// # Errors
    /// When a formula uses a name without a value, or is undefined on the path.
    pub fn holonomy(&self, path: &Path, values: &[(&str, f64)]) -> Result<Rotation> {
        let mut omega: Vector = std::array::from_fn(|_| Expr::int(0));
        for (r, a) in self.shape.iter().zip(&self.form) {
            let rate = path.of(r)?.derivative(&"t".into());
            omega = std::array::from_fn(|k| &omega[k] + &(&path.along(&a[k]) * &rate));
        }
        let mut omega = Compiled::new(&omega, &["t"], values)?;
        let mut w = [0.0; 3];
        let rhs = |t: f64, y: &[f64], dy: &mut [f64]| {
            omega.values(&[t], &mut w);
            // Each row of R turns: ṙ = r × ω.
            for (r, d) in y.chunks(3).zip(dy.chunks_mut(3)) {
                (0..3).for_each(|i| d[i] = r[(i + 1) % 3] * w[(i + 2) % 3] - r[(i + 2) % 3] * w[(i + 1) % 3]);
            }
        };
        let [from, to] = path.times;
        let start = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
        let end = Integrator::default().with_tolerance(1e-13, 1e-14).solve(rhs, from, &start, &[to])?;
        Ok(Rotation(std::array::from_fn(|i| std::array::from_fn(|j| end[0][3 * i + j]))))
    }
}

fn tidied(a: &Matrix) -> Matrix {
    space::built(|i, j| a[i][j].tidy())
}

/// A rotation matrix in numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation(pub [[f64; 3]; 3]);

impl Rotation {
    /// Twice the sine of the angle times the axis.
    fn skew(&self) -> [f64; 3] {
        let r = &self.0;
        [r[2][1] - r[1][2], r[0][2] - r[2][0], r[1][0] - r[0][1]]
    }

    /// The angle within 0 and π.
    pub fn angle(&self) -> f64 {
        let [x, y, z] = self.skew();
        let trace = self.0[0][0] + self.0[1][1] + self.0[2][2];
        (x.hypot(y).hypot(z)).atan2(trace - 1.0)
    }

    /// Angle times axis; undefined (not finite) for a half turn, whose axis has no sign.
    pub fn vector(&self) -> [f64; 3] {
        let [x, y, z] = self.skew();
        let size = x.hypot(y).hypot(z);
        let scale = if size == 0.0 && self.angle() == 0.0 { 0.0 } else { self.angle() / size };
        [x, y, z].map(|v| scale * v)
    }
}
