//! Motion whose heading does not hang on the place: two quadratures in place of an integrator of differential equations.

use super::integrators::gauss_legendre::GaussLegendre;
use super::{Integrator, Method};
use crate::formula::{Isa, Kernel};
use crate::model::{Equations, RatesAlone, state};
use std::sync::LazyLock;

/// Nodes of a panel, and lanes they are evaluated in.
const NODES: usize = 16;

static RULE: LazyLock<GaussLegendre<NODES>> = LazyLock::new(GaussLegendre::new);

/// A panel is not halved below this share of its span: what is not smooth there is left to an integrator.
const SHORTEST: f64 = 1e-6;
/// A panel that is followed by a longer one grows by this factor at most.
const GROWTH: f64 = 2.0;
/// The error said of a panel may be this share of the tolerance for it to be followed by a longer one.
const AMPLE: f64 = 1e-5;

/// φ(t) = φ₀ + ∫ φ′(u), then x and y as integrals of x′(φ, u) and y′(φ, u), by Gauss and Legendre in panels.
///
/// | symbol | meaning |
/// |---|---|
/// | u | inputs, which between two knots are smooth functions of time |
/// | φ′ | a function of the inputs alone |
/// | x′, y′ | functions of heading and inputs |
///
/// Every formula is evaluated at all nodes of a panel side by side, twice: first for the headings at the nodes, then for
/// the place. A panel whose series fall too slowly for the tolerance is halved.
pub(super) struct PoseQuadrature<'a> {
    rates: RatesAlone<'a, NODES>,
    tolerance: [f64; 2],
    u: Vec<[f64; NODES]>,
    z: [[f64; NODES]; 3],
    out: [[f64; NODES]; 3],
    length: f64,
    /// How many panels may still be evaluated.
    left: u32,
    isa: Isa,
}

impl<'a> PoseQuadrature<'a> {
    /// Of equations at parameters, if their heading hangs on inputs alone, in place of Dormand and Prince's method of order
    /// 8 at its tolerances.
    pub fn of(equations: &'a Equations, p: &[f64], instead: &Integrator) -> Option<Self> {
        let Integrator { method, rtol, atol, max_steps } = *instead;
        let sound = atol.is_finite() && atol > 0.0 && rtol.is_finite() && rtol >= 0.0;
        (method == Method::Automatic && sound && equations.heading_comes_first).then(|| Self {
            rates: equations.rates_alone([p; NODES]),
            tolerance: [rtol, atol],
            left: max_steps,
            u: vec![[0.0; NODES]; equations.inputs.len()],
            z: [[0.0; NODES]; 3],
            out: [[0.0; NODES]; 3],
            length: f64::INFINITY,
            isa: Isa::best(),
        })
    }

    /// The pose at the end of a span without knots; `None` where the motion is undefined or not smooth.
    pub fn through(
        &mut self,
        values: &mut impl FnMut(&[f64; NODES], &mut [[f64; NODES]]),
        look_up: impl Fn(f64) -> f64,
        (from, to): (f64, f64),
        start: &[f64],
    ) -> Option<Vec<f64>> {
        if from == to {
            return None;
        }
        let (mut at, mut pose) = (from, [start[0], start[1], start[2]]);
        let span = (to - from).abs();
        // The first panel of all is a half at most: what swings between a few nodes is seen.
        let mut length = if self.length.is_finite() { self.length.min(span) } else { 0.5 * span };
        loop {
            let left = (to - at).abs();
            let is_last = length >= left * (1.0 - 1e-12);
            let h = if is_last { to - at } else { length.copysign(to - from) };
            values(&RULE.nodes.map(|c| look_up(at + h * c)), &mut self.u);
            self.left = self.left.checked_sub(1)?;
            let (next, share) = self.panel(&pose, h)?;
            if share > 1.0 {
                length = 0.5 * h.abs();
                if length < SHORTEST * span {
                    return None;
                }
                continue;
            }
            pose = next;
            // A panel that was cut short by the end says nothing against longer ones.
            let longer = if share < AMPLE { GROWTH * h.abs() } else { h.abs() };
            self.length = if is_last { self.length.max(longer) } else { longer };
            if is_last {
                return Some(pose.to_vec());
            }
            at += h;
            length = self.length;
        }
    }

    /// The pose behind one panel, whose inputs are known, and its error in units of the tolerance.
    fn panel(&mut self, pose: &[f64; 3], h: f64) -> Option<([f64; 3], f64)> {
        let (isa, mut found) = (self.isa, ([f64::NAN; 3], f64::NAN));
        isa.dispatch(Panel { quadrature: self, pose, h, found: &mut found });
        found.0.iter().all(|z| z.is_finite()).then_some(found)
    }
}

struct Panel<'q, 'a> {
    quadrature: &'q mut PoseQuadrature<'a>,
    pose: &'q [f64; 3],
    h: f64,
    found: &'q mut ([f64; 3], f64),
}

impl Kernel for Panel<'_, '_> {
    #[inline(always)]
    fn run(self) {
        let Self { quadrature, pose, h, found } = self;
        let PoseQuadrature { rates, tolerance: [rtol, atol], u, z, out, .. } = quadrature;
        let rule = &*RULE;
        *z = pose.map(|z| [z; NODES]);
        rates.at(z, u, out);
        let turned = rule.running(&out[state::DIRECTION]);
        for j in 0..NODES {
            z[state::DIRECTION][j] += h * turned[j];
        }
        rates.at(z, u, out);
        let next: [f64; 3] = std::array::from_fn(|i| pose[i] + h * rule.integral(&out[i]));
        let decay = out.each_ref().map(|values| rule.decay(values));
        // A heading that is off at the nodes moves the place by the speed.
        let astray = h.abs() * decay[state::DIRECTION].running_error(NODES);
        let error = |i: usize| {
            let aside = if i == state::DIRECTION { 0.0 } else { astray * decay[0].size.max(decay[1].size) };
            h.abs() * (decay[i].error() + aside) / (*atol + *rtol * next[i].abs().max(pose[i].abs()))
        };
        let square: f64 = (0..3).map(|i| error(i).powi(2)).sum();
        *found = (next, (square / 3.0).sqrt());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{self, Scope};
    use crate::formula::Expr;
    use crate::model::Model;
    use crate::motion::{Formulas, assembled, simulate};

    fn model(vehicle: &str, parameters: &[(&str, f64)]) -> Model {
        let creeps = [("rotation-creep", None, vec![0.07]), ("traverse-creep", None, vec![-0.05])];
        assembled(vehicle, parameters, &[], &creeps).unwrap()
    }

    fn drive(formulas: [&str; 2]) -> Formulas {
        Formulas::new(&formulas.map(|f| Expr::parse(f).unwrap()), &[]).unwrap()
    }

    /// Of a wheel and a car, there and back, with laws that bend, swing fast and have a kink that no knot tells of: within
    /// the tolerance of what a method of another order gives at a finer one.
    #[test]
    fn an_integral_is_what_an_integrator_gives() {
        let wheel = model("unicycle", &[("wheel_radius", 0.5)]);
        let car = model("car", &[("wheel_radius", 0.3), ("wheelbase", 2.5)]);
        let laws =
            [["3 + sin(t)", "0.4*cos(2*t)"], ["2 + sin(40*t)", "0.3*sin(31*t)"], ["5 - t/3", "0.2 + abs(t - 4.3)/20"]];
        let cases =
            laws.into_iter().flat_map(|[speed, turn]| [(&wheel, drive([speed, turn])), (&car, drive([turn, speed]))]);
        for (model, drive) in cases {
            let equations = model.equations(&[]).unwrap();
            assert!(PoseQuadrature::of(&equations, &[], &Integrator::default()).is_some());
            let by = |integrator: &Integrator| {
                simulate(&equations, &[], &drive, &[1.0, -2.0, 0.3], &[0.0, 0.5, 9.0, 2.0], integrator).unwrap()
            };
            let finer = Integrator { method: Method::Rk4 { step: 2e-4 }, ..Integrator::default() };
            for (quick, slow) in by(&Integrator::default()).iter().zip(by(&finer)) {
                for (a, b) in quick.iter().zip(slow) {
                    assert!((a - b).abs() < 2e-9 * (1.0 + b.abs()), "{a} {b}");
                }
            }
        }
    }

    /// Where the place moves the place, or something is hidden, there is nothing to integrate by itself; and who asks for a
    /// method gets it.
    #[test]
    fn a_rate_that_asks_for_the_place_is_none_of_it() {
        let within = effects::named("rotation-creep").unwrap().within(Scope::Disk([1.0, 0.0, 2.0]));
        let patch = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        let patch = patch.with_effect(effects::Applied::new(&within, None, vec![0.1]));
        let slides =
            assembled("unicycle", &[("wheel_radius", 0.5)], &[], &[("cornering-creep", None, vec![0.2])]).unwrap();
        for model in [patch, slides] {
            let equations = model.equations(&[]).unwrap();
            assert!(PoseQuadrature::of(&equations, &[], &Integrator::default()).is_none());
        }
        let plain = model("unicycle", &[("wheel_radius", 0.5)]).equations(&[]).unwrap();
        let asked = Integrator { method: Method::Dop853, ..Integrator::default() };
        assert!(PoseQuadrature::of(&plain, &[], &asked).is_none());
    }

    /// A law that ends is told as an integrator tells it.
    #[test]
    fn what_is_undefined_is_told() {
        let equations = model("unicycle", &[("wheel_radius", 0.5)]).equations(&[]).unwrap();
        let drive = drive(["sqrt(2 - t)", "0.1"]);
        let ended = simulate(&equations, &[], &drive, &[0.0; 3], &[0.0, 3.0], &Integrator::default()).unwrap_err();
        assert!(ended.to_string().contains("undefined near t = "), "{ended}");
        let few = Integrator { max_steps: 3, ..Integrator::default() };
        let swings = super::tests::drive(["2 + sin(40*t)", "0.3*sin(31*t)"]);
        let told = simulate(&equations, &[], &swings, &[0.0; 3], &[0.0, 30.0], &few).unwrap_err();
        assert!(told.to_string().contains("3 steps were not enough"), "{told}");
    }
}
