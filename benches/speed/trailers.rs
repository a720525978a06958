//! A wheel that pulls ten trailers: by the library, and by hand.

use super::tableau::ORDER_8;
use super::{adaptive, vector};
use creepage::formula::{Expr, Symbol};
use creepage::model::{Equations, Model, Trailer};
use creepage::motion::{Ensemble, EnsembleInputs, Formulas, Integrator, Varied, simulate};

pub const TRAILERS: usize = 10;
pub const N: usize = 3 + TRAILERS;
/// s
pub const DURATION: f64 = 10.0;
const R: f64 = 0.5;
const LAWS: [&str; 2] = ["2", "sin(t)/2"];

/// The model with so many trailers of a metre.
pub fn model(trailers: usize) -> Model {
    let model = Model::new("unicycle", &[("wheel_radius", R)]).unwrap();
    model.with_trailers(&vec![Trailer { length: 1.0, hitch: 0.0 }; trailers])
}

/// A sweep over the wheel's radius and the first heading.
pub fn ensemble() -> Ensemble {
    let formulas = LAWS.map(|f| Expr::parse(f).unwrap()).to_vec();
    let inputs = EnsembleInputs { formulas, ..EnsembleInputs::default() };
    let varied = [Varied::Model("wheel_radius".into()), Varied::Initial(2)];
    Ensemble::new(&model(TRAILERS), &inputs, &varied, &[0.0; N], 0.0, &[DURATION], 1e-10).unwrap()
}

/// Radius and heading of case i of n.
pub fn case(i: usize, n: usize) -> [f64; 2] {
    [0.4 + 0.2 * i as f64 / n as f64, 0.5 * ((i * 7919) % n) as f64 / n as f64]
}

pub struct Single {
    equations: Equations,
    drive: Formulas,
}

impl Single {
    pub fn new() -> Self {
        let laws = LAWS.map(|f| Expr::parse(f).unwrap());
        let equations = model(TRAILERS).equations(&[Symbol::from("wheel_radius")]).unwrap();
        Self { equations, drive: Formulas::new(&laws, &[]).unwrap() }
    }

    pub fn run(&self, [r, phi]: [f64; 2]) -> Vec<f64> {
        let mut z = [0.0; N];
        z[2] = phi;
        let ends = [0.0, DURATION];
        simulate(&self.equations, &[r], &self.drive, &z, &ends, &Integrator::default()).unwrap().remove(1)
    }
}

#[inline(always)]
fn rates(r: f64, t: f64, z: &[f64; N]) -> [f64; N] {
    let mut v = 2.0 * r;
    let mut out = [0.0; N];
    let (s, c) = z[2].sin_cos();
    (out[0], out[1], out[2]) = (v * c, v * s, 0.5 * t.sin());
    for i in 3..N {
        let (s, c) = (z[i - 1] - z[i]).sin_cos();
        out[i] = v * s;
        v *= c;
    }
    out
}

pub fn by_hand([r, phi]: [f64; 2]) -> [f64; N] {
    let mut z = [0.0; N];
    z[2] = phi;
    adaptive::dop853(|t, z: &[f64; N]| rates(r, t, z), 0.0, z, DURATION)
}

const W: usize = vector::WIDTH;

#[inline(always)]
fn steps_by_hand(r: &[f64; W], phi: &[f64; W], steps: usize, z: &mut [[f64; W]; N], k: &mut [[[f64; W]; N]; 12]) {
    let h = DURATION / steps as f64;
    *z = [[0.0; W]; N];
    z[2] = *phi;
    for step in 0..steps {
        let t = h * step as f64;
        for s in 0..12 {
            let mut at = [[0.0; W]; N];
            // x and y are sums.
            for i in 2..N {
                at[i] = z[i];
                if s > 0 {
                    for (j, a) in ORDER_8.a[s - 1].iter().enumerate() {
                        if *a != 0.0 {
                            for l in 0..W {
                                at[i][l] = (h * a).mul_add(k[j][i][l], at[i][l]);
                            }
                        }
                    }
                }
            }
            let yaw = 0.5 * (t + ORDER_8.c[s] * h).sin();
            let (sine, cosine) = vector::sin_cos(&at[2]);
            let mut v = [0.0; W];
            for l in 0..W {
                v[l] = 2.0 * r[l];
                (k[s][0][l], k[s][1][l], k[s][2][l]) = (v[l] * cosine[l], v[l] * sine[l], yaw);
            }
            for i in 3..N {
                let mut bend = [0.0; W];
                for l in 0..W {
                    bend[l] = at[i - 1][l] - at[i][l];
                }
                let (sine, cosine) = vector::sin_cos(&bend);
                for l in 0..W {
                    k[s][i][l] = v[l] * sine[l];
                    v[l] *= cosine[l];
                }
            }
        }
        for i in 0..N {
            for (s, b) in ORDER_8.b.iter().enumerate() {
                if *b != 0.0 {
                    for l in 0..W {
                        z[i][l] = (h * b).mul_add(k[s][i][l], z[i][l]);
                    }
                }
            }
        }
    }
}

pub fn limit(cases: &[[f64; 2]], steps: usize, out: &mut [[f64; N]]) {
    let (mut z, mut k) = ([[0.0; W]; N], [[[0.0; W]; N]; 12]);
    vector::widest(
        #[inline(always)]
        || {
            for (case, out) in cases.chunks_exact(W).zip(out.chunks_exact_mut(W)) {
                let (mut r, mut phi) = ([0.0; W], [0.0; W]);
                for l in 0..W {
                    [r[l], phi[l]] = case[l];
                }
                steps_by_hand(&r, &phi, steps, &mut z, &mut k);
                for l in 0..W {
                    for i in 0..N {
                        out[l][i] = z[i][l];
                    }
                }
            }
        },
    );
}
