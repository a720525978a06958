//! The wheel of Fig. 7, reading A: by the library, and by hand.

use super::tableau::ORDER_8;
use super::{adaptive, vector};
use creepage::effects::{self, Applied};
use creepage::formula::{Expr, Symbol};
use creepage::model::{Equations, Model};
use creepage::energy_rule::{FIG7_DURATION, Reading};
use creepage::motion::{Ensemble, EnsembleInputs, Formulas, Integrator, Varied, simulate};

const R: f64 = 0.5;
/// I·w², m·r² + J and J of the figure.
const A: f64 = 0.5;
const B: f64 = 1.25;
const J: f64 = 1.0;

/// The model with both creeps.
pub fn model() -> Model {
    let creep = |id: &str| Applied::new(effects::named(id).unwrap(), None, vec![0.1]);
    let model = Model::new("unicycle", &[("wheel_radius", R)]).unwrap();
    model.with_effect(creep("rotation-creep")).with_effect(creep("traverse-creep"))
}

/// The model with both creeps to be found.
pub fn free_model() -> Model {
    let creep = |id: &str| Applied::new(effects::named(id).unwrap(), None, vec![0.0]).freed();
    let model = Model::new("unicycle", &[("wheel_radius", R)]).unwrap();
    model.with_effect(creep("rotation-creep")).with_effect(creep("traverse-creep"))
}

/// The laws of the rates, in the order of the model's inputs (wheel_rate, yaw_rate), and their constants.
pub fn laws() -> (Vec<Expr>, Vec<(Symbol, f64)>) {
    let [yaw, wheel] = Reading::A.spelled().unwrap().try_into().unwrap();
    let data = [("r", R), ("m", 1.0), ("I", 0.5), ("J", J), ("w", 1.0), ("u_0", 2.0), ("g", -0.05), ("side", 1.0)];
    (vec![wheel, yaw], data.map(|(s, v)| (Symbol::from(s), v)).to_vec())
}

/// Creeps of case i of n.
pub fn creeps(i: usize, n: usize) -> [f64; 2] {
    let s = i as f64 / n as f64;
    [-0.2 + 0.4 * s, 0.2 * (1.0 - 2.0 * ((i * 7919) % n) as f64 / n as f64)]
}

/// A sweep over both creeps.
pub fn ensemble() -> Ensemble {
    let (laws, constants) = laws();
    let own = |s: &Symbol| match s.as_str() {
        "e_rc" => Some(Expr::sym("rotation_creep.e_rc")),
        "e_tc" => Some(Expr::sym("traverse_creep.e_tc")),
        _ => None,
    };
    let inputs = EnsembleInputs {
        formulas: laws.iter().map(|e| e.substitute(&own)).collect(),
        constants: constants.into_iter().collect(),
        ..EnsembleInputs::default()
    };
    let varied = ["rotation_creep.e_rc", "traverse_creep.e_tc"].map(|s| Varied::Model(s.into()));
    Ensemble::new(&model(), &inputs, &varied, &[0.0; 3], 0.0, &[FIG7_DURATION], 1e-10).unwrap()
}

/// One trajectory by a library call, compiled beforehand.
pub struct Single {
    equations: Equations,
    drive: Formulas,
}

impl Single {
    pub fn new([e_rc, e_tc]: [f64; 2]) -> Self {
        let (laws, mut constants) = laws();
        constants.extend([("e_rc", e_rc), ("e_tc", e_tc)].map(|(s, v)| (Symbol::from(s), v)));
        let free = ["rotation_creep.e_rc", "traverse_creep.e_tc"].map(Symbol::from);
        Self { equations: model().equations(&free).unwrap(), drive: Formulas::new(&laws, &constants).unwrap() }
    }

    pub fn run(&self, creeps: [f64; 2]) -> Vec<f64> {
        let end = [0.0, FIG7_DURATION];
        simulate(&self.equations, &creeps, &self.drive, &[0.0; 3], &end, &Integrator::default()).unwrap().remove(1)
    }
}

/// The rates by hand.
#[inline(always)]
fn rates([e_rc, e_tc]: [f64; 2], t: f64, phi: f64) -> [f64; 3] {
    let c = R * R * (1.0 - e_rc) * (1.0 - e_rc) * (1.0 + e_tc * e_tc) + J;
    let u = 2.0 - 0.05 * t;
    let lambda = ((A + B * u * u) / (A + c * u * u)).sqrt();
    let forward = R * (1.0 - e_rc) * lambda * u;
    let left = e_tc * forward;
    let (s, k) = phi.sin_cos();
    [forward * k - left * s, forward * s + left * k, lambda]
}

/// The same method by hand, one trajectory at a time.
pub fn by_hand(creeps: [f64; 2]) -> [f64; 3] {
    adaptive::dop853(|t, y: &[f64; 3]| rates(creeps, t, y[2]), 0.0, [0.0; 3], FIG7_DURATION)
}

const W: usize = vector::WIDTH;
type Lane = [f64; W];

/// `steps` steps of order 8 for W wheels, written for vectors: only φ is needed between steps, x and y are sums.
#[inline(always)]
fn steps_by_hand(e_rc: &Lane, e_tc: &Lane, steps: usize) -> [Lane; 3] {
    let h = FIG7_DURATION / steps as f64;
    let (mut c, mut forward, mut left) = ([0.0; W], [0.0; W], [0.0; W]);
    for l in 0..W {
        let q = R * (1.0 - e_rc[l]);
        c[l] = q * q * (1.0 + e_tc[l] * e_tc[l]) + J;
        (forward[l], left[l]) = (q, q * e_tc[l]);
    }
    let mut z = [[0.0; W]; 3];
    for i in 0..steps {
        let t = h * i as f64;
        let mut k = [[0.0; W]; 12];
        let mut sums = [[0.0; W]; 3];
        for s in 0..12 {
            let mut phi = z[2];
            if s > 0 {
                for (j, a) in ORDER_8.a[s - 1].iter().enumerate() {
                    if *a != 0.0 {
                        for l in 0..W {
                            phi[l] = (h * a).mul_add(k[j][l], phi[l]);
                        }
                    }
                }
            }
            let u = 2.0 - 0.05 * (t + ORDER_8.c[s] * h);
            let (top, square) = (A + B * u * u, u * u);
            let (sine, cosine) = vector::sin_cos(&phi);
            let b = h * ORDER_8.b[s];
            for l in 0..W {
                let lambda = (top / c[l].mul_add(square, A)).sqrt();
                let (v, w) = (forward[l] * lambda * u, left[l] * lambda * u);
                k[s][l] = lambda;
                sums[0][l] = b.mul_add(v * cosine[l] - w * sine[l], sums[0][l]);
                sums[1][l] = b.mul_add(v * sine[l] + w * cosine[l], sums[1][l]);
                sums[2][l] = b.mul_add(lambda, sums[2][l]);
            }
        }
        for i in 0..3 {
            for l in 0..W {
                z[i][l] += sums[i][l];
            }
        }
    }
    z
}

/// Many wheels by hand, as fast as the vectors of this processor allow.
pub fn limit(e: &[[f64; 2]], steps: usize, out: &mut [[f64; 3]]) {
    vector::widest(
        #[inline(always)]
        || {
            for (e, out) in e.chunks_exact(W).zip(out.chunks_exact_mut(W)) {
                let (mut e_rc, mut e_tc) = ([0.0; W], [0.0; W]);
                for l in 0..W {
                    [e_rc[l], e_tc[l]] = e[l];
                }
                let z = steps_by_hand(&e_rc, &e_tc, steps);
                for l in 0..W {
                    out[l] = [z[0][l], z[1][l], z[2][l]];
                }
            }
        },
    );
}
