//! Runge–Kutta steps of order four for states and their exact sensitivities, several trajectories side by side.

use super::collocation_stepper::CollocationStepper;
use super::exponential_stepper::{ExponentialStepper, Spans};
use super::states::{LaneStates, add, sum, take};
use super::variational_equations::VariationalEquations;
use crate::formula::{Isa, Kernel};
use crate::model::{Equations, Fineness};
use crate::motion::Signals;
use std::ops::Range;

/// Largest angle the vehicle may turn within one step, rad.
const TURN_PER_STEP: f64 = 0.1;
/// Largest step in units of the shortest time constant.
const STEP_PER_TIME_CONSTANT: f64 = 0.35;
/// Most equal steps between two rows for the sake of a time constant; of a shorter one the limit is followed.
const MAX_STEPS: f64 = 12.0;
/// The same for screening: longer steps, which are within their stability still, for constants for which following the limit
/// would take more.
const ROUGH_STEP_PER_TIME_CONSTANT: f64 = 0.7;
const MAX_ROUGH_STEPS: f64 = 20.0;
/// Of a vehicle that forces move more steps than these are left to collocation.
const FEW: f64 = 6.0;
/// The longest steps that follow a limit, as a share of the time between two rows.
const MAX_LIMIT_STEP: f64 = 1.0 / 8.0;
/// How many of the steps for the sake of turning are one of those that follow a limit, which take thrice the rates.
const TURNS_PER_STEP: f64 = 3.0;
/// Most steps between two rows for the sake of turning.
const MAX_TURNS: f64 = 4096.0;

/// Integrates [`Equations`] along [`Signals`] by the classical Runge–Kutta scheme of order four, L states beside their
/// sensitivities S = ∂z/∂(visible start, p) by the variational equations.
///
/// S′ = J_z·S + [0 | J_p − J_u·u̇·∂delay/∂p], one compiled evaluation a stage. The step adapts to the yaw rate
/// and to the shortest time constant of the states; where that is far shorter than the span, exponential steps of the same
/// order follow its limit. So the same code serves 10 Hz logs, stiff hidden states and rows an hour apart. Every
/// arc has steps of its own: the results are those of one arc alone, bit for bit.
pub(crate) struct LaneStepper<'a, const L: usize> {
    motion: VariationalEquations<'a, L>,
    rate: LaneStates<L>,
    total: LaneStates<L>,
    at: LaneStates<L>,
    exponential: ExponentialStepper<L>,
    /// Of vehicles that forces move one for each arc, of others none.
    collocation: Vec<CollocationStepper<'a>>,
    /// Of each arc the knot of the signals that it comes to next.
    ahead: [usize; L],
}

/// A knot within this share of the interval before it from the beginning or the end of a span counts as lying there:
/// times of a log are rounded to about as much.
const KNOT_TOLERANCE: f64 = 1e-6;

/// How far a step stays from the time at which an effect begins or ends, s.
const EDGE: f64 = 1e-7;

/// How spans are divided.
struct Steps<const L: usize> {
    /// How many equal steps; none where there is no way to go, or where steps follow a limit.
    equal: [f64; L],
    /// The spans whose steps follow a limit.
    forgotten: Option<Spans<L>>,
}

impl<'a, const L: usize> LaneStepper<'a, L> {
    /// Equations along signals, each arc at its own parameters.
    pub fn new(equations: &'a Equations, signals: &'a Signals, p: [&[f64]; L]) -> Self {
        Self {
            motion: VariationalEquations::new(equations, signals, p),
            rate: LaneStates::default(),
            total: LaneStates::default(),
            at: LaneStates::default(),
            exponential: ExponentialStepper::default(),
            collocation: p
                .iter()
                .filter(|_| equations.is_forced)
                .map(|p| CollocationStepper::new(equations, signals, p))
                .collect(),
            ahead: [0; L],
        }
    }

    /// With columns behind those of the parameters by which states hang on where so many hidden ones start.
    pub fn with_hidden_starts(mut self, hidden: usize) -> Self {
        self.motion.hidden_starts = hidden;
        self
    }

    /// With these columns alone: all others stay as they are.
    pub fn by_hidden_starts(mut self, hidden: usize) -> Self {
        self.motion.first = self.columns();
        self.with_hidden_starts(hidden)
    }

    /// Columns of the sensitivities.
    pub fn columns(&self) -> usize {
        self.motion.columns()
    }

    /// The instructions that kernels of a caller are to use.
    pub fn isa(&self) -> Isa {
        self.motion.isa
    }

    /// The inputs that act at some times.
    pub fn inputs(&mut self, t: &[f64; L]) -> &[[f64; L]] {
        self.motion.inputs(t)
    }

    /// Advances arcs from some times to others; where both are the same an arc stays as it is.
    pub fn advance(&mut self, z: &mut [[f64; L]], s: &mut [[f64; L]], from: &[f64; L], to: &[f64; L]) {
        self.motion.isa_with(s).dispatch(Advance { stepper: self, z, s, from, to });
    }

    /// Advances arcs through rows of a log, each from its first row to the one behind its last.
    pub fn through(&mut self, arcs: &mut LaneStates<L>, time: &[f64], rows: &[Range<usize>; L]) {
        for r in 0..rows.iter().map(Range::len).max().unwrap_or(0) {
            let at = |r: usize| rows.each_ref().map(|rows| time[(rows.start + r).min(rows.end)]);
            self.advance(&mut arcs.z, &mut arcs.s, &at(r), &at(r + 1));
        }
    }

    /// Between two rows of poses there may be many of the inputs: each of their intervals has steps of its own, for what
    /// a step does not look at would not have happened.
    #[inline(always)]
    fn advance_here(&mut self, z: &mut [[f64; L]], s: &mut [[f64; L]], from: &[f64; L], to: &[f64; L]) {
        let mut at = *from;
        loop {
            let until = self.next_knots(&at, to);
            self.advance_between(z, s, &at, &until);
            if until == *to {
                return;
            }
            at = until;
        }
    }

    /// The knots of the signals that lie between, the next one of each arc, or the end where there are none. Spans that go
    /// back in time are not divided.
    #[inline(always)]
    fn next_knots(&mut self, at: &[f64; L], to: &[f64; L]) -> [f64; L] {
        let mut until = *to;
        for l in 0..L {
            if at[l] < to[l] {
                until[l] = self.next_knot(l, at[l], to[l]);
            }
        }
        until
    }

    #[inline(never)]
    fn next_knot(&mut self, l: usize, at: f64, to: f64) -> f64 {
        let knot = self.next_of_signals(l, at, to);
        let edges = self.motion.edges();
        // Just before an edge and just behind it: within a step nothing begins or ends.
        let beside = edges.iter().flat_map(|e| [e - EDGE, e + EDGE]);
        beside.filter(|e| at < *e && *e < knot).fold(knot, f64::min)
    }

    fn next_of_signals(&mut self, l: usize, at: f64, to: f64) -> f64 {
        let knots = self.motion.signals.knots();
        let i = self.ahead[l];
        let stands = i > 0 && knots[i - 1] <= at && knots.get(i).is_none_or(|k| at < *k);
        let mut i = if stands { i } else { knots.partition_point(|k| *k <= at) };
        let interval = |i: usize| if i > 0 { knots[i] - knots[i - 1] } else { f64::INFINITY };
        if knots.get(i).is_some_and(|k| k - at < KNOT_TOLERANCE * interval(i)) {
            i += 1;
        }
        self.ahead[l] = i;
        knots.get(i).copied().filter(|k| to - k > KNOT_TOLERANCE * interval(i)).unwrap_or(to)
    }

    #[inline(never)]
    fn collocate(&mut self, z: &mut [[f64; L]], s: &mut [[f64; L]], from: &[f64; L], to: &[f64; L]) {
        let lane = |values: &[[f64; L]], l: usize| values.iter().map(|v| v[l]).collect::<Vec<f64>>();
        for (l, arc) in self.collocation.iter_mut().enumerate() {
            let (mut own, mut slopes) = (lane(z, l), lane(s, l));
            arc.advance(&mut own, &mut slopes, (from[l], to[l]), self.rate.z[2][l]);
            z.iter_mut().zip(own).for_each(|(z, own)| z[l] = own);
            s.iter_mut().zip(slopes).for_each(|(s, own)| s[l] = own);
        }
    }

    #[inline(always)]
    fn advance_between(&mut self, z: &mut [[f64; L]], s: &mut [[f64; L]], from: &[f64; L], to: &[f64; L]) {
        let Self { motion, rate, total, at, .. } = self;
        for arcs in [&mut *rate, &mut *total, &mut *at] {
            arcs.make_room(z.len(), s.len());
        }
        let still = motion.still_entries(s);
        at.s[..still].copy_from_slice(&s[..still]);
        // Under forces the rates alone say who steps: collocation has rates of its own.
        let asked = if motion.is_forced() { &[][..] } else { &*s };
        motion.rate(z, asked, from, rate);
        let Steps { equal, forgotten } = steps(motion, z, asked, &rate.z, from, to);
        if motion.is_forced() {
            if forgotten.is_some() || equal.iter().any(|n| *n > FEW) {
                return self.collocate(z, s, from, to);
            }
            motion.rate(z, s, from, rate);
        }
        let (mut h, mut most) = ([0.0; L], 0.0);
        for l in 0..L {
            h[l] = (to[l] - from[l]) / if equal[l] == 0.0 { 1.0 } else { equal[l] };
            most = if equal[l] > most { equal[l] } else { most };
        }
        for i in 0..most as usize {
            let mut t = [0.0; L];
            for l in 0..L {
                t[l] = from[l] + h[l] * i as f64;
            }
            if i > 0 {
                motion.rate(z, s, &t, rate);
            }
            step(motion, z, s, (&t, &h), rate, total, at);
            let mut wanted = [false; L];
            for l in 0..L {
                wanted[l] = (i as f64) < equal[l];
            }
            take(z, &total.z, &wanted);
            take(&mut s[still..], &total.s[still..], &wanted);
        }
        if let Some(spans) = forgotten {
            self.motion.isa.dispatch(Forget { stepper: self, z, s, spans });
        }
    }

    /// Evaluates what is measured beside the pose at some states and times.
    #[inline(always)]
    pub fn evaluate_quantities(&mut self, z: &[[f64; L]], t: &[f64; L]) {
        self.motion.evaluate_quantities(z, t);
    }

    /// One of the quantities that were evaluated last at n states, and its derivatives by the columns of their sensitivities.
    #[inline(always)]
    pub fn quantity(&self, i: usize, n: usize, s: &[[f64; L]], slopes: &mut [[f64; L]]) -> [f64; L] {
        self.motion.quantity(i, n, s, slopes)
    }

    /// What the sensor measures at some states, and the rows of its derivatives with respect to (visible z, p).
    #[inline(always)]
    pub fn outputs_here(&mut self, z: &[[f64; L]]) -> &[[f64; L]] {
        self.motion.outputs(z)
    }
}

struct Advance<'s, 'a, const L: usize> {
    stepper: &'s mut LaneStepper<'a, L>,
    z: &'s mut [[f64; L]],
    s: &'s mut [[f64; L]],
    from: &'s [f64; L],
    to: &'s [f64; L],
}

impl<const L: usize> Kernel for Advance<'_, '_, L> {
    #[inline(always)]
    fn run(self) {
        self.stepper.advance_here(self.z, self.s, self.from, self.to);
    }
}

/// Not inlined into the kernels of callers: it is rarely asked for.
struct Forget<'s, 'a, const L: usize> {
    stepper: &'s mut LaneStepper<'a, L>,
    z: &'s mut [[f64; L]],
    s: &'s mut [[f64; L]],
    spans: Spans<L>,
}

impl<const L: usize> Kernel for Forget<'_, '_, L> {
    #[inline(always)]
    fn run(self) {
        let LaneStepper { motion, exponential, .. } = self.stepper;
        exponential.advance(motion, self.z, self.s, &self.spans);
    }
}

/// How the motion asks for spans to be divided, by the rate at their beginning.
#[inline(always)]
fn steps<const L: usize>(
    motion: &mut VariationalEquations<L>,
    z: &[[f64; L]],
    s: &[[f64; L]],
    rate: &[[f64; L]],
    from: &[f64; L],
    to: &[f64; L],
) -> Steps<L> {
    let mut fastest = [0.0; L];
    for own in motion.own_slopes(z, !s.is_empty()) {
        for l in 0..L {
            fastest[l] = if own[l].abs() > fastest[l] { own[l].abs() } else { fastest[l] };
        }
    }
    let [longest, most] = match motion.fineness() {
        Fineness::Full => [STEP_PER_TIME_CONSTANT, MAX_STEPS],
        Fineness::Screening => [ROUGH_STEP_PER_TIME_CONSTANT, MAX_ROUGH_STEPS],
    };
    let mut steps = Steps { equal: [0.0; L], forgotten: None };
    for l in 0..L {
        let span = to[l] - from[l];
        let turning = (span.abs() * (rate[2][l].abs() / TURN_PER_STEP)).ceil();
        let forgetting = (span.abs() * (fastest[l] / longest)).ceil();
        if span == 0.0 {
            continue;
        }
        if forgetting > most {
            let spans = steps.forgotten.get_or_insert_with(|| Spans::none(from));
            spans.length[l] = span;
            spans.first[l] = STEP_PER_TIME_CONSTANT / fastest[l];
            spans.longest[l] = span.abs() * MAX_LIMIT_STEP.min(TURNS_PER_STEP / turning.clamp(1.0, MAX_TURNS));
        } else {
            steps.equal[l] = if turning > forgetting { turning } else { forgetting }.clamp(1.0, MAX_TURNS);
        }
    }
    steps
}

/// One step into `total`; the rate at its beginning is known.
#[inline(always)]
fn step<const L: usize>(
    motion: &mut VariationalEquations<L>,
    z: &[[f64; L]],
    s: &[[f64; L]],
    (t, h): (&[f64; L], &[f64; L]),
    rate: &mut LaneStates<L>,
    total: &mut LaneStates<L>,
    at: &mut LaneStates<L>,
) {
    let (still, from, width) = (motion.still_entries(s), motion.first, motion.columns());
    total.z.copy_from_slice(z);
    total.s[still..].copy_from_slice(&s[still..]);
    for (advance, weight, next) in [(0.5, 1.0, 0.5), (0.5, 2.0, 0.5), (1.0, 2.0, 1.0), (0.0, 1.0, 0.0)] {
        let (mut share, mut ahead, mut then) = ([0.0; L], [0.0; L], [0.0; L]);
        for l in 0..L {
            share[l] = weight * h[l] / 6.0;
            ahead[l] = advance * h[l];
            then[l] = t[l] + next * h[l];
        }
        add(&mut total.z, &share, &rate.z);
        for (total, rate) in total.s[still..].chunks_exact_mut(width).zip(rate.s[still..].chunks_exact(width)) {
            add(&mut total[from..], &share, &rate[from..]);
        }
        if advance > 0.0 {
            sum(&mut at.z, z, &ahead, &rate.z);
            let rows = s[still..].chunks_exact(width).zip(rate.s[still..].chunks_exact(width));
            for (at, (s, rate)) in at.s[still..].chunks_exact_mut(width).zip(rows) {
                sum(&mut at[from..], &s[from..], &ahead, &rate[from..]);
            }
            motion.rate(&at.z, &at.s, &then, rate);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects;
    use crate::effects::Applied;
    use crate::model::Model;
    use crate::motion::Timing;

    /// How two spans are divided: at each arc's own yaw rate, with a slide that forgets in so many seconds, if any.
    fn divided(yaw_rate: [f64; 2], forgets_in: Option<f64>, span: [f64; 2]) -> Steps<2> {
        let mut model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        if let Some(tau) = forgets_in {
            model = model.with_effect(Applied::new(effects::named("cornering-creep").unwrap(), None, vec![tau]));
        }
        let equations = model.equations(&[]).unwrap();
        // A rate for each of the arcs, which begin at 0 and at 1 s.
        let columns: Vec<Vec<f64>> = equations
            .inputs
            .iter()
            .map(|name| if name.as_str() == "yaw_rate" { yaw_rate.to_vec() } else { vec![2.0; 2] })
            .collect();
        let signals = Signals::new(&[0.0, 1.0], &columns, Timing::Sample);
        let (z, from) = (vec![[0.0; 2]; equations.n()], [0.0, 1.0]);
        let mut motion = VariationalEquations::new(&equations, &signals, [&[], &[]]);
        let mut rate = LaneStates::default();
        rate.make_room(z.len(), 0);
        motion.rate(&z, &[], &from, &mut rate);
        steps(&mut motion, &z, &[], &rate.z, &from, &[from[0] + span[0], from[1] + span[1]])
    }

    /// Steps of a tenth of a radian, either way, one at least and 4096 at most; none where there is no way to go.
    #[test]
    fn steps_follow_the_yaw_rate() {
        let equal = |yaw_rate, span| divided(yaw_rate, None, span).equal;
        assert_eq!(equal([2.04, -0.51], [1.0, 1.0]), [21.0, 6.0]);
        assert_eq!(equal([2.04, -0.51], [-0.1, 3.0]), [3.0, 16.0]);
        assert_eq!(equal([0.0, 1e9], [1.0, 1.0]), [1.0, 4096.0]);
        assert_eq!(equal([3.0, 3.0], [0.0, 0.01]), [0.0, 1.0]);
    }

    /// 0.35 of a time constant at most, or a tenth of a radian where that is shorter.
    #[test]
    fn steps_follow_a_time_constant() {
        let divided = divided([1.0, 9.3], Some(0.3), [1.0, 1.0]);
        assert_eq!(divided.equal, [10.0, 93.0]);
        assert!(divided.forgotten.is_none());
    }

    /// Twelve steps are the most that are made for a time constant; beyond, its limit is followed in steps of an eighth of
    /// the span or of three tenths of a radian.
    #[test]
    fn a_limit_is_followed_where_a_time_constant_is_short() {
        // 11.9 steps, and 12.06.
        let divided_at = |yaw_rate, tau: f64| divided([1.0, yaw_rate], Some(tau), [0.2, -0.2]);
        let divided = divided_at(800.0, 0.048);
        assert_eq!(divided.equal, [12.0, 1600.0]);
        assert!(divided.forgotten.is_none());
        for (yaw_rate, turns) in [(800.0, 1600.0), (1e9, 4096.0)] {
            let divided = divided_at(yaw_rate, 0.0474);
            assert_eq!(divided.equal, [0.0; 2]);
            let spans = divided.forgotten.unwrap();
            assert_eq!((spans.from, spans.length), ([0.0, 1.0], [0.2, 0.8 - 1.0]));
            let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-12 * b, "{a} {b}");
            spans.first.into_iter().for_each(|first| near(first, 0.35 * 0.0474));
            near(spans.longest[0], 0.2 / 8.0);
            near(spans.longest[1], 0.2 * 3.0 / turns);
        }
    }

    /// For screening steps are twice as long, and the limit is followed where it takes more than twenty of them; from off the limit
    /// they end within some thousandths of what was off.
    #[test]
    fn screening_takes_longer_steps() {
        let slides = Applied::new(effects::named("cornering-creep").unwrap(), None, vec![0.02]);
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_effect(slides.freed());
        let signals = Signals::new(&[0.0, 0.1], &[vec![2.0, 2.6], vec![0.8, -0.4]], Timing::Sample);
        let end = |equations: &Equations| {
            let mut stepper = crate::motion::Stepper::new(equations, &signals, &[0.02]);
            let mut arc = stepper.start(&[0.0, 0.0, 0.2, 0.02], None);
            stepper.advance(&mut arc, 0.0, 0.1);
            arc.z
        };
        let full = model.free_equations().unwrap();
        let (fine, rough) = (end(&full), end(&full.followed(Fineness::Screening)));
        let apart = fine.iter().zip(&rough).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // It begins 4 mm/s off its limit of 16 mm/s.
        assert!(apart > 1e-9 && apart < 3e-3 * 0.004, "{apart}");
    }

    /// Where a limit is followed a few steps do what thousands do, from states off the limit, and their sensitivities too.
    #[test]
    fn a_few_steps_along_a_limit_do_what_many_do() {
        let model = |tau: f64| {
            let slides = Applied::new(effects::named("cornering-creep").unwrap(), None, vec![tau]);
            Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_effect(slides.freed())
        };
        let columns = [vec![2.0, 2.6], vec![0.8, -0.4]];
        let signals = Signals::new(&[0.0, 0.1], &columns, Timing::Sample);
        for tau in [0.02, 0.01, 3e-3, 5e-4, 1e-5] {
            let equations = model(tau).free_equations().unwrap();
            let end = |pieces: u32| {
                let p = [tau];
                let mut stepper = crate::motion::Stepper::new(&equations, &signals, &p);
                // Off its limit by as much as a kink of the inputs leaves it.
                let mut arc = stepper.start(&[0.0, 0.0, 0.2, tau * (0.8 + 10.0 * tau)], None);
                let at = |i: u32| 0.1 * f64::from(i) / f64::from(pieces);
                (0..pieces).for_each(|i| stepper.advance(&mut arc, at(i), at(i + 1)));
                arc
            };
            let (few, many) = (end(1), end(20_000));
            let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let (states, slopes) = (apart(&few.z, &many.z), apart(&few.s, &many.s));
            assert!(states < 3e-7 && slopes < 5e-4, "{tau}: {states} {slopes}");
        }
    }

    /// A delay that is free moves what acts, and S says so as differences of the motion do.
    #[test]
    fn a_delay_moves_what_the_inputs_do() {
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        let model = model.with_effect(Applied::new(effects::named("input-delay").unwrap(), None, vec![0.1]));
        let equations = model.equations(&["input_delay.delay".into()]).unwrap();
        let time: Vec<f64> = (0..=40).map(|i| 0.05 * f64::from(i)).collect();
        let of = |f: fn(f64) -> f64| time.iter().map(|t| f(*t)).collect::<Vec<f64>>();
        let signals =
            Signals::new(&time, &[of(|t| 3.0 + 2.0 * (2.0 * t).sin()), of(|t| (3.0 * t).cos())], Timing::Sample);
        let end = |delay: f64| {
            let p = [delay];
            let mut stepper = crate::motion::Stepper::new(&equations, &signals, &p);
            let mut arc = stepper.start(&[0.0, 0.0, 0.2], None);
            stepper.advance(&mut arc, 0.2, 1.7);
            arc
        };
        let (here, more, less) = (end(0.1), end(0.1001), end(0.0999));
        for i in 0..3 {
            let slope = (more.z[i] - less.z[i]) / 2e-4;
            assert!(
                slope.abs() > 0.1 && (here.s[4 * i + 3] - slope).abs() < 5e-3,
                "{i}: {} {slope}",
                here.s[4 * i + 3]
            );
        }
    }
}
