//! The equations of motion of a model with their exact derivatives, evaluated over lanes.

use crate::formula::{Isa, Lanes, Memory, Rows, Symbol};

/// dz/dt = f(z, u, p) and y = h(z, p) with their exact derivatives, compiled once.
///
/// | symbol | meaning |
/// |---|---|
/// | z | pose x, y, phi, trailer headings, then states that no sensor sees |
/// | u | logged inputs, looked up `delay` seconds in the past |
/// | p | free parameters |
/// | y | measured x, y, heading, trailer headings |
#[derive(Clone, Debug)]
pub struct Equations {
    /// States: pose, trailer headings, hidden states.
    pub states: Vec<Symbol>,
    /// How many of the states are free at the start of a stretch of a log: pose, trailer headings, and speeds that forces
    /// change and a second does not forget.
    pub visible: usize,
    /// How many of those are a pose or the heading of a trailer.
    pub poses: usize,
    /// Whether forces move the vehicle, so that its states may be stiff.
    pub(crate) is_forced: bool,
    /// Logged inputs, then those derived from the log.
    pub inputs: Vec<Symbol>,
    /// What the last of the inputs are.
    pub(crate) derived: Vec<Derived>,
    /// The times at which an effect begins or ends, s.
    pub(crate) edges: Vec<f64>,
    /// Free parameters.
    pub free: Vec<Symbol>,
    pub(super) constants: Vec<f64>,
    pub(super) rates: Lanes,
    pub(super) jacobian: Lanes,
    /// Which of the derivatives are not zero by their formula.
    pub(super) live: Vec<usize>,
    /// ∂z′ᵢ/∂zᵢ alone, of the states of which it is not zero by its formula.
    pub(super) own_slopes: Lanes,
    pub(super) has_own_slope: Vec<usize>,
    pub(super) outputs: Lanes,
    /// What is measured beside the pose, with its derivatives by (z, u, p).
    pub(super) quantities: Lanes,
    /// How many quantities those are.
    pub quantity_count: usize,
    pub(super) delay: Lanes,
    /// How many inputs have a delay of their own beside that of all: none, or all that are logged.
    pub(crate) own_delays: usize,
    /// How finely states that forget are followed along a log.
    pub(crate) fineness: Fineness,
    /// Whether there is a pose alone, its heading by the inputs and its place by heading and inputs.
    pub(crate) heading_comes_first: bool,
    /// Whether the rates of the hidden states are linear in these, by their formulas.
    pub(crate) is_linear_in_hidden: bool,
    /// The motion of the hidden states alone, where it does not ask for the pose.
    pub(super) carried: Option<Box<Equations>>,
}

/// How finely states that forget are followed along a log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fineness {
    /// To what is reported.
    #[default]
    Full,
    /// In steps twice as long, by which candidates are compared: values move by less than a hundredth of their deviations.
    Screening,
}

/// An input that no column of a log gives, but the log as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Derived {
    /// The time at which inputs are looked up.
    Time,
    /// The rate of a logged input.
    Rate(usize),
}

/// How far beside a kink derivatives are taken, as a share of one.
const KINK_DISTANCE: f64 = 1e-9;

/// Working memory for one thread that evaluates [`Equations`] at L states side by side.
#[derive(Clone, Debug)]
pub struct Workspace<const L: usize = 1> {
    rates: Memory<L>,
    jacobian: Memory<L>,
    own_slopes: Memory<L>,
    outputs: Memory<L>,
    quantities: Memory<L>,
    delay: Memory<L>,
    /// Rates and derivatives of the last evaluation; those that are always zero stay so.
    slopes: Rows<L>,
    /// ∂z′ᵢ/∂zᵢ of the last evaluation of these alone; those that are always zero stay so.
    own: Rows<L>,
    results: Rows<L>,
    /// What is measured beside the pose, and its derivatives.
    quantity_values: Rows<L>,
    isa: Isa,
}

/// The rates of L states at fixed parameters, without their derivatives.
pub(crate) struct RatesAlone<'a, const L: usize> {
    rates: &'a Lanes,
    memory: Memory<L>,
    isa: Isa,
}

impl<const L: usize> RatesAlone<'_, L> {
    /// dz/dt, inlined into a kernel of the caller.
    #[inline(always)]
    pub fn at(&mut self, z: &[[f64; L]], u: &[[f64; L]], rates: &mut [[f64; L]]) {
        load(&mut self.memory, z, u);
        evaluate(self.rates, &mut self.memory, rates, self.isa);
    }
}

impl Equations {
    /// The same, followed so finely along a log.
    pub(crate) fn followed(mut self, fineness: Fineness) -> Self {
        self.fineness = fineness;
        self.carried = self.carried.map(|carried| Box::new(carried.followed(fineness)));
        self
    }

    /// Number of states.
    pub fn n(&self) -> usize {
        self.states.len()
    }

    /// Whether speeds are among the states that are free at the start of a stretch: forces change them.
    pub fn has_speeds(&self) -> bool {
        self.visible > self.poses
    }

    /// The first column of sensitivities in which the hidden states hang on where a stretch begins: on its nodes, where they
    /// follow speeds, and else on the parameters alone.
    pub(crate) fn first_of_hidden(&self) -> usize {
        if self.has_speeds() { 0 } else { self.visible }
    }

    /// How many of the inputs a log gives.
    pub fn logged(&self) -> usize {
        self.inputs.len() - self.derived.len()
    }

    /// How many of the states, the first ones, no rate depends on: sensitivities to where they start do not change.
    pub(crate) fn unread(&self) -> usize {
        let n = self.n();
        let width = self.jacobian.outputs() / n - 1;
        let read = |j: usize| self.live.iter().any(|k| (k - n) % width == j);
        // Those are poses: what a state that nobody reads begins with is nobody's parameter, and not left out.
        (0..self.visible).take_while(|j| !read(*j)).count()
    }

    /// How many of the states, the first ones, hang on nothing: their sensitivities stay as they are.
    pub(crate) fn still(&self) -> usize {
        self.live_by_rate().iter().take_while(|live| live.is_empty()).count()
    }

    /// The columns that the rate of each state depends on: of (z, u, p), or of what the derivatives were asked by.
    pub(crate) fn live_by_rate(&self) -> Vec<Vec<usize>> {
        let n = self.n();
        let width = self.jacobian.outputs() / n - 1;
        let read = |i: usize, j: &usize| self.live.binary_search(&(n + i * width + j)).is_ok();
        (0..n).map(|i| (0..width).filter(|j| read(i, j)).collect()).collect()
    }

    /// The states that the rate of each state depends on.
    pub(crate) fn read_by(&self) -> Vec<Vec<usize>> {
        let own = |row: Vec<usize>| row.into_iter().filter(|j| *j < self.n()).collect();
        self.live_by_rate().into_iter().map(own).collect()
    }

    /// The states that hang on a visible one, by their rates or through those of others.
    pub(crate) fn moved_by_visible(&self) -> Vec<bool> {
        let read_by = self.read_by();
        let mut moved: Vec<bool> = (0..self.n()).map(|i| i < self.visible).collect();
        // In so many rounds it has gone from each to all others.
        for _ in self.visible..self.n() {
            for (i, reads) in read_by.iter().enumerate() {
                moved[i] |= reads.iter().any(|j| moved[*j]);
            }
        }
        moved
    }

    /// The same equations with the pose at rest, where the motion of the hidden states does not ask for it.
    pub(crate) fn carried(&self) -> Option<&Equations> {
        self.carried.as_deref()
    }

    /// Memory for evaluating these equations at given parameters.
    pub fn workspace(&self, p: &[f64]) -> Workspace {
        self.side_by_side([p])
    }

    /// Memory for evaluating these equations at L states, each with its own parameters.
    pub(crate) fn side_by_side<const L: usize>(&self, p: [&[f64]; L]) -> Workspace<L> {
        Workspace {
            rates: self.memory(&self.rates, p),
            jacobian: self.memory(&self.jacobian, p),
            own_slopes: self.memory(&self.own_slopes, p),
            outputs: self.memory(&self.outputs, p),
            quantities: self.memory(&self.quantities, p),
            delay: self.memory(&self.delay, p),
            slopes: Rows::new(self.jacobian.outputs()),
            own: Rows::new(self.n()),
            results: Rows::new(self.outputs.outputs().max(self.delay.outputs())),
            quantity_values: Rows::new(self.quantities.outputs()),
            isa: Isa::for_lanes(L),
        }
    }

    /// What [`Equations::delay`] gives, where nothing else is asked for.
    pub(crate) fn delay_alone(&self, p: &[f64]) -> Vec<f64> {
        let mut memory = self.memory(&self.delay, [p]);
        let mut all = vec![[0.0]; self.delay.outputs()];
        evaluate(&self.delay, &mut memory, &mut all, Isa::default());
        all.into_flattened()
    }

    /// The rates alone, of L states, each with its own parameters.
    pub(crate) fn rates_alone<const L: usize>(&self, p: [&[f64]; L]) -> RatesAlone<'_, L> {
        RatesAlone { rates: &self.rates, memory: self.memory(&self.rates, p), isa: Isa::for_lanes(L) }
    }

    fn memory<const L: usize>(&self, lanes: &Lanes, p: [&[f64]; L]) -> Memory<L> {
        let mut memory = lanes.memory();
        let moving = self.n() + self.inputs.len();
        for i in 0..self.free.len() {
            *memory.input(moving + i) = p.map(|p| p[i]);
        }
        for (i, value) in self.constants.iter().enumerate() {
            *memory.input(moving + self.free.len() + i) = [*value; L];
        }
        lanes.begin(&mut memory, Isa::default());
        memory
    }

    /// dz/dt.
    pub fn rates(&self, w: &mut Workspace, z: &[f64], u: &[f64], rates: &mut [f64]) {
        self.rates_here(w, z.as_chunks().0, u.as_chunks().0, rates.as_chunks_mut().0);
    }

    /// dz/dt of L states, inlined into a [`Kernel`](crate::formula::Kernel) of the caller.
    #[inline(always)]
    pub(crate) fn rates_here<const L: usize>(
        &self,
        w: &mut Workspace<L>,
        z: &[[f64; L]],
        u: &[[f64; L]],
        rates: &mut [[f64; L]],
    ) {
        load(&mut w.rates, z, u);
        evaluate(&self.rates, &mut w.rates, rates, w.isa);
    }

    /// dz/dt followed by the rows of its derivatives with respect to (z, u, p).
    ///
    /// At a kink, where |u| has no derivative though the motion is defined, they are those on the side of larger
    /// inputs: a vehicle that stands still is no reason to give a log up.
    pub fn rates_and_jacobian<'w>(&self, w: &'w mut Workspace, z: &[f64], u: &[f64]) -> &'w [f64] {
        self.jacobian_here(w, z.as_chunks().0, u.as_chunks().0);
        w.slopes.as_flattened()
    }

    /// As [`Equations::rates_and_jacobian`] for L states, inlined into a kernel of the caller.
    #[inline(always)]
    pub(crate) fn jacobian_here<'w, const L: usize>(
        &self,
        w: &'w mut Workspace<L>,
        z: &[[f64; L]],
        u: &[[f64; L]],
    ) -> &'w [[f64; L]] {
        if self.differentiated(w, z, u) {
            self.beside(w, z, u);
        }
        &w.slopes
    }

    /// Rates and derivatives; whether somewhere the rates are defined and the derivatives are not.
    #[inline(always)]
    fn differentiated<const L: usize>(&self, w: &mut Workspace<L>, z: &[[f64; L]], u: &[[f64; L]]) -> bool {
        load(&mut w.jacobian, z, u);
        self.jacobian.run(&mut w.jacobian, w.isa);
        // Zero times what is defined is zero.
        let (mut rates, mut slopes) = ([0.0; L], [0.0; L]);
        for k in 0..self.n() {
            w.slopes[k] = defined(self.jacobian.output(&w.jacobian, k));
            for (sum, rate) in rates.iter_mut().zip(&w.slopes[k]) {
                *sum += 0.0 * rate;
            }
        }
        for k in &self.live {
            w.slopes[*k] = defined(self.jacobian.output(&w.jacobian, *k));
            for (sum, slope) in slopes.iter_mut().zip(&w.slopes[*k]) {
                *sum += 0.0 * slope;
            }
        }
        let mut beside = false;
        for l in 0..L {
            beside |= rates[l] == 0.0 && slopes[l] != 0.0;
        }
        beside
    }

    /// The derivatives a little beside the inputs where there are none; the rates stay those of the inputs.
    #[cold]
    #[inline(never)]
    fn beside<const L: usize>(&self, w: &mut Workspace<L>, z: &[[f64; L]], u: &[[f64; L]]) {
        let here = w.slopes.clone();
        let beside: Vec<[f64; L]> = u.iter().map(|u| u.map(|u| u + KINK_DISTANCE * (1.0 + u.abs()))).collect();
        self.differentiated(w, z, &beside);
        let (rates, slopes) = here.split_at(self.n());
        let all = |values: &[[f64; L]], l: usize| values.iter().all(|v| v[l].is_finite());
        let kept: [bool; L] = std::array::from_fn(|l| !all(rates, l) || all(slopes, l));
        for (k, (new, old)) in w.slopes.iter_mut().zip(here.iter()).enumerate() {
            for l in (0..L).filter(|l| k < rates.len() || kept[*l]) {
                new[l] = old[l];
            }
        }
    }

    /// ∂z′ᵢ/∂zᵢ of every state at L states and inputs, where nothing else is asked for; at a kink, where they are undefined, those
    /// of the whole matrix beside it.
    pub(crate) fn own_slopes<'w, const L: usize>(
        &self,
        w: &'w mut Workspace<L>,
        z: &[[f64; L]],
        u: &[[f64; L]],
    ) -> &'w [[f64; L]] {
        if self.has_own_slope.is_empty() {
            return &w.own;
        }
        load(&mut w.own_slopes, z, u);
        self.own_slopes.run(&mut w.own_slopes, w.isa);
        for (k, i) in self.has_own_slope.iter().enumerate() {
            w.own[*i] = defined(self.own_slopes.output(&w.own_slopes, k));
        }
        if !self.has_own_slope.iter().all(|i| w.own[*i].iter().all(|slope| slope.is_finite())) {
            self.jacobian_here(w, z, u);
            let (n, width) = (self.n(), self.jacobian.outputs() / self.n() - 1);
            self.has_own_slope.iter().for_each(|i| w.own[*i] = w.slopes[n + i * width + i]);
        }
        &w.own
    }

    /// What [`Equations::jacobian_here`] gave last.
    #[inline(always)]
    pub(crate) fn last_jacobian<'w, const L: usize>(&self, w: &'w Workspace<L>) -> &'w [[f64; L]] {
        &w.slopes
    }

    /// What the sensor measures, followed by the rows of its derivatives with respect to (visible z, p).
    pub fn outputs<'w>(&self, w: &'w mut Workspace, z: &[f64]) -> &'w [f64] {
        self.outputs_here(w, z.as_chunks().0).as_flattened()
    }

    /// As [`Equations::outputs`] for L states, inlined into a kernel of the caller.
    #[inline(always)]
    pub(crate) fn outputs_here<'w, const L: usize>(&self, w: &'w mut Workspace<L>, z: &[[f64; L]]) -> &'w [[f64; L]] {
        load(&mut w.outputs, &z[..self.visible], &[]);
        evaluate(&self.outputs, &mut w.outputs, &mut w.results, w.isa);
        &w.results[..self.outputs.outputs()]
    }

    /// Evaluates what is measured beside the pose at L states and inputs, inlined into a kernel of the caller.
    #[inline(always)]
    pub(crate) fn evaluate_quantities<const L: usize>(&self, w: &mut Workspace<L>, z: &[[f64; L]], u: &[[f64; L]]) {
        load(&mut w.quantities, z, u);
        evaluate(&self.quantities, &mut w.quantities, &mut w.quantity_values, w.isa);
    }

    /// What [`Equations::evaluate_quantities`] gave last: the quantities, then the rows of their derivatives by (z, u, p).
    #[inline(always)]
    pub(crate) fn last_quantities<'w, const L: usize>(&self, w: &'w Workspace<L>) -> &'w [[f64; L]] {
        &w.quantity_values
    }

    /// What is measured beside the pose at a state and inputs.
    pub(crate) fn quantities(&self, w: &mut Workspace, z: &[f64], u: &[f64]) -> Vec<f64> {
        self.evaluate_quantities(w, z.as_chunks().0, u.as_chunks().0);
        self.last_quantities(w).as_flattened()[..self.quantity_count].to_vec()
    }

    /// The delay of all inputs, s, those that each has beside it, and their derivatives with respect to p, row by row.
    pub fn delay<'w>(&self, w: &'w mut Workspace) -> &'w [f64] {
        self.delays(w).as_flattened()
    }

    /// As [`Equations::delay`] for L sets of parameters.
    pub(crate) fn delays<'w, const L: usize>(&self, w: &'w mut Workspace<L>) -> &'w [[f64; L]] {
        evaluate(&self.delay, &mut w.delay, &mut w.results, w.isa);
        &w.results[..self.delay.outputs()]
    }
}

/// States and inputs take the first places, one after another.
#[inline(always)]
fn load<const L: usize>(memory: &mut Memory<L>, z: &[[f64; L]], u: &[[f64; L]]) {
    for (i, z) in z.iter().enumerate() {
        *memory.input(i) = *z;
    }
    for (i, u) in u.iter().enumerate() {
        *memory.input(z.len() + i) = *u;
    }
}

/// Runs a program and hands over what it gives.
#[inline(always)]
fn evaluate<const L: usize>(program: &Lanes, memory: &mut Memory<L>, results: &mut [[f64; L]], isa: Isa) {
    program.run(memory, isa);
    for (k, result) in results.iter_mut().enumerate().take(program.outputs()) {
        *result = defined(program.output(memory, k));
    }
}

/// What is undefined is NaN: zero times infinity is.
#[inline(always)]
fn defined<const L: usize>(values: &[f64; L]) -> [f64; L] {
    let mut out = [0.0; L];
    for l in 0..L {
        out[l] = values[l] + 0.0 * values[l];
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Applied, named};
    use crate::model::Model;

    /// u' = (e_tc·v_l − u)·|v_l|/length: no slope by the wheel's rate at rest.
    fn relaxing() -> Model {
        let unicycle = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        unicycle.with_effect(Applied::new(named("relaxation-length").unwrap(), None, vec![0.1, 0.5]))
    }

    const STATE: [f64; 4] = [0.3, -0.2, 0.7, 0.05];

    fn slopes(e: &Equations, inputs: [f64; 2]) -> Vec<f64> {
        e.rates_and_jacobian(&mut e.workspace(&[]), &STATE, &inputs).to_vec()
    }

    #[test]
    fn slopes_at_a_kink_are_those_of_larger_inputs_and_rates_are_its_own() {
        let e = relaxing().equations(&[]).unwrap();
        for turning in [0.0, 0.4] {
            let [rest, ahead, behind] = [0.0, 1e-7, -1e-7].map(|rate| slopes(&e, [rate, turning]));
            let mut rates = vec![0.0; 4];
            e.rates(&mut e.workspace(&[]), &STATE, &[0.0, turning], &mut rates);
            assert_eq!(rest[..4], rates);
            let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(rest.iter().all(|v| v.is_finite()) && apart(&rest, &ahead) < 1e-5, "{rest:?} {ahead:?}");
            assert!(apart(&rest, &behind) > 0.01);
        }
    }

    /// Where one state stands still and another moves, each has the slopes it has alone, to the last bit.
    #[test]
    fn a_kink_of_one_lane_is_none_of_another() {
        let e = relaxing().equations(&[]).unwrap();
        for inputs in [[[0.0, 0.4], [2.0, 0.3]], [[2.0, 0.3], [0.0, 0.4]], [[0.0, 0.4], [f64::NAN, 0.3]]] {
            let mut w = e.side_by_side::<2>([&[], &[]]);
            let both = |i: usize| [inputs[0][i], inputs[1][i]];
            let found = e.jacobian_here(&mut w, &STATE.map(|z| [z; 2]), &[both(0), both(1)]).to_vec();
            for (lane, inputs) in inputs.into_iter().enumerate() {
                let bits =
                    |values: Vec<f64>| values.iter().map(|v| (!v.is_nan()).then(|| v.to_bits())).collect::<Vec<_>>();
                assert_eq!(bits(found.iter().map(|v| v[lane]).collect()), bits(slopes(&e, inputs)), "{inputs:?}");
            }
        }
    }

    /// The slopes of states by themselves are those on the diagonal of the matrix, to the last bit, and at a kink as near as that is
    /// looked at beside it; a pose that nothing reads has none.
    #[test]
    fn slopes_of_states_by_themselves_are_the_diagonal() {
        let e = relaxing().equations(&["relaxation_length.e_tc".into()]).unwrap();
        assert_eq!(e.has_own_slope, [3]);
        for (inputs, far) in [([2.0, 0.3], 0.0), ([-1.0, 0.0], 0.0), ([0.0, 0.4], 1e-8)] {
            let mut w = e.side_by_side::<1>([&[0.1]]);
            let all = e.jacobian_here(&mut w, &STATE.map(|z| [z]), &inputs.map(|u| [u])).to_vec();
            let own = e.own_slopes(&mut w, &STATE.map(|z| [z]), &inputs.map(|u| [u])).to_vec();
            let width = all.len() / 4 - 1;
            for (i, [own]) in own.iter().enumerate() {
                assert!((own - all[4 + i * width + i][0]).abs() <= far, "{i}: {own} {:?}", all[4 + i * width + i]);
            }
            assert!(own[3][0] < 0.0 || inputs[0] == 0.0);
        }
        let plain = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        assert!(plain.equations(&[]).unwrap().has_own_slope.is_empty());
        assert!(relaxing().equations_by(&["wheel_radius".into()]).unwrap().has_own_slope.is_empty());
    }

    #[test]
    fn what_no_rate_reads_is_counted_from_the_front() {
        let plain = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        assert_eq!(plain.equations(&[]).unwrap().unread(), 2);
        assert_eq!(relaxing().equations(&[]).unwrap().unread(), 2);
        // On a slope the heading is read as before; where nothing is driven sideways by it, nothing is.
        let disk = Model::new("disk", &[("wheel_radius", 0.5)]).unwrap().equations(&[]).unwrap();
        assert_eq!((disk.unread(), disk.read_by()[0].clone()), (2, vec![2]));
    }

    /// The hidden state of a creep that builds up does not ask where the vehicle is: the pose is left out.
    #[test]
    fn hidden_states_are_followed_without_the_pose() {
        let whole = relaxing().equations(&[]).unwrap();
        let carried = whole.carried().unwrap();
        let (all, kept) = (whole.live_by_rate(), carried.live_by_rate());
        assert!(kept[..3].iter().all(Vec::is_empty) && kept[3] == all[3] && all[0].len() > 2, "{all:?} {kept:?}");
        let (a, b) = (slopes(&whole, [2.0, 0.3]), slopes(carried, [2.0, 0.3]));
        assert_eq!((b[..2].to_vec(), b[2..4].to_vec()), (vec![0.0; 2], a[2..4].to_vec()));
        assert_eq!(b[4 + 3 * 6..], a[4 + 3 * 6..]);
        assert_eq!((carried.still(), whole.still()), (3, 0));
        assert!(b[4..4 + 3 * 6].iter().all(|v| *v == 0.0));
        // Nothing hidden, nothing to follow; and derivatives by parameters alone say nothing of the states.
        let plain = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        assert!(plain.equations(&[]).unwrap().carried().is_none());
        assert!(relaxing().equations_by(&["wheel_radius".into()]).unwrap().carried().is_none());
    }

    /// A car turns by tan(α), which is not defined everywhere; that is no dependence on the pose.
    #[test]
    fn what_is_undefined_somewhere_does_not_pass_for_a_dependence() {
        let car = Model::new("car", &[("wheel_radius", 0.5), ("wheelbase", 2.0)]).unwrap();
        let creeping = Applied::new(named("cornering-creep").unwrap(), None, vec![0.1]);
        let e = car.with_effect(creeping).equations(&[]).unwrap();
        assert_eq!((e.unread(), e.read_by()[3].clone()), (2, vec![3]));
        assert!(e.carried().is_some());
    }
}
