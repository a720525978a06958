//! Many cases of one model, integrated in blocks of lanes with a check of every result (Richardson extrapolation).

use super::case::Case;
use super::equations::{EnsembleInputs, LaneEquations, Varied};
use super::lanes::LANES;
use super::plan::Plan;
use super::start::Start;
use super::steps::Span;
use crate::error::{Error, Result};
use crate::formula::Isa;
use crate::model::Model;

/// Many cases of one model, each with its own parameters, constants of the inputs and initial pose.
///
/// | symbol | meaning |
/// |---|---|
/// | z | states of a case |
/// | N | steps of a run, h their length |
/// | z_N, z_2N | results with N and 2N steps of order q |
/// | ε | what rounding leaves at best, see below |
/// | error | max over rows and states of 4·\|z_2N − z_N\|/(2^q − 1)/max(1, \|z_2N\|), and ε |
///
/// Every case is integrated twice, with N and with 2N steps between the times where the inputs have a kink and those
/// that are asked for. The difference estimates the error of the finer run over the whole trajectory, growth of early
/// errors included; N doubles until it is at most the error asked for, or until it does not help: the sums of the steps
/// are compensated, so that rounding takes ε, four units in the last place, and from a place on the plane as much more as
/// a heading rounded so moves it. The result is z_2N + (z_2N − z_N)/(2^q − 1), which is better by an order than what the
/// estimate speaks of. The first N and the order are found by the same check on a few cases spread over all of them, so a
/// case's result depends neither on its neighbours in a block nor on the number of threads.
///
/// Validity: the motion is smooth between knots; where it is not, N grows to its limit and the case is reported as not
/// converged.
///
/// Source: E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, II.4 (Richardson) and II.5.
///
/// ```
/// use creepage::formula::Expr;
/// use creepage::model::Model;
/// use creepage::motion::{Ensemble, EnsembleInputs, Varied};
/// let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
/// let formulas = ["2 - t/20", "1"].map(|f| Expr::parse(f).unwrap()).to_vec();
/// let inputs = EnsembleInputs { formulas, ..EnsembleInputs::default() };
/// let varied = [Varied::Model("wheel_radius".into())];
/// let wheels = Ensemble::new(&model, &inputs, &varied, &[0.0; 3], 0.0, &[6.0], 1e-10).unwrap();
/// let plan = wheels.plan(|_| vec![0.5], 2).unwrap();
/// let cases = wheels.run(&plan, &[&[0.5], &[1.0]]).unwrap();
/// let x = |i: usize| cases[i].row(0)[0];
/// assert!((x(1) - 2.0 * x(0)).abs() < 1e-10 && cases[1].error.unwrap() < 1e-10);
/// ```
pub struct Ensemble {
    pub(super) model: Model,
    pub(super) inputs: EnsembleInputs,
    pub(super) varied: Vec<Varied>,
    pub(super) initial: Vec<f64>,
    pub(super) from: f64,
    pub(super) times: Vec<f64>,
    pub(super) tolerance: f64,
    pub(super) equations: LaneEquations,
    pub(super) start: Option<Start>,
    pub(super) isa: Isa,
}

impl Ensemble {
    /// Compiles a model for many cases.
    ///
    /// | symbol | unit | meaning |
    /// |---|---|---|
    /// | varied | | what a case gives a value for |
    /// | initial | m, rad | measured x, y, heading and trailer headings at the start, unless varied; then speeds that forces change |
    /// | from | s | when the motion begins |
    /// | times | s | times of the rows, rising, not before `from` |
    /// | tolerance | | the error asked for |
    ///
    /// # Errors
    /// When the constraints do not determine the motion, a formula uses a name that nothing defines, what varies is no
    /// symbol of the model or no component of its pose, or sizes and times do not fit.
    pub fn new(
        model: &Model,
        inputs: &EnsembleInputs,
        varied: &[Varied],
        initial: &[f64],
        from: f64,
        times: &[f64],
        tolerance: f64,
    ) -> Result<Self> {
        let wanted = 3 + model.trailer_count() + model.forced.as_ref().map_or(0, |forced| forced.nodes.len());
        if initial.len() != wanted || inputs.formulas.len() != model.inputs.len() {
            return Err(Error::input("the initial pose or the inputs do not fit the model"));
        }
        let rising = times.windows(2).all(|w| w[0] < w[1]) && times.first().is_some_and(|t| *t >= from);
        let finite = times.iter().chain([&from, &tolerance]).all(|t| t.is_finite());
        if !rising || !finite || tolerance <= 0.0 {
            return Err(Error::input("times have to rise from the start on, and the error has to be positive"));
        }
        known(model, inputs, varied, wanted)?;
        if model.effects.iter().any(|e| e.effect.scope.is_some() || e.effect.course.is_some() || e.effect.on.is_some())
        {
            return Err(Error::input("a sweep takes no effect with a scope, a course or an input of its own")
                .help("leave it out of the model, or simulate its cases one by one"));
        }
        let equations = LaneEquations::new(model, inputs, varied, None)?;
        Ok(Self {
            model: model.clone(),
            inputs: inputs.clone(),
            varied: varied.to_vec(),
            initial: initial.to_vec(),
            from,
            times: times.to_vec(),
            tolerance,
            start: if equations.starts_as_measured() { None } else { Some(Start::new(model, varied)?) },
            equations,
            isa: Isa::best(),
        })
    }

    /// The same cases with other vector instructions; the results are the same bits.
    pub fn with_instructions(self, isa: Isa) -> Self {
        Self { isa, ..self }
    }

    /// Names of the columns of a row: time, measured pose, speeds, hidden states.
    pub fn columns(&self) -> Vec<String> {
        let trailers = (1..=self.equations.visible - 3).map(|i| format!("trailer_heading_{i}"));
        let pose = ["time", "x", "y", "heading"].map(String::from).into_iter().chain(trailers);
        let speeds = ["speed", "lateral_speed", "yaw_rate"].map(String::from);
        pose.chain(speeds).chain(self.equations.hidden_names.iter().cloned()).collect()
    }

    /// The times of the rows.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Whether the first row is the start.
    pub(super) fn shows_start(&self) -> bool {
        self.times[0] == self.from
    }

    /// The times between which everything is smooth, once in order.
    pub(super) fn spans(&self, equations: &LaneEquations) -> Vec<Span> {
        let logged = equations.log.as_ref().map_or(&[][..], |l| l.knots());
        let (first, last) = (self.from, self.times[self.times.len() - 1]);
        let inner = |t: &f64| *t > first && *t < last;
        let kinks = logged.iter().chain(&self.inputs.knots).map(|t| t + equations.delay).filter(inner);
        let mut marks: Vec<(f64, bool)> = kinks.chain([first]).map(|t| (t, false)).collect();
        marks.extend(self.times.iter().map(|t| (*t, true)));
        marks.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        marks.dedup_by(|later, kept| later.0 == kept.0);
        marks.windows(2).map(|w| Span { from: w[0].0, to: w[1].0, steps: 1, row: w[1].1 }).collect()
    }

    /// Finds order and first number of steps on a few of `total` cases spread evenly.
    ///
    /// # Errors
    /// As [`Ensemble::run`].
    pub fn plan(&self, case: impl Fn(usize) -> Vec<f64>, total: usize) -> Result<Plan> {
        let pilots = total.min(LANES);
        let values: Vec<Vec<f64>> = (0..pilots).map(|i| case(i * total / pilots)).collect();
        let mut cases: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
        let alone = if self.equations.own_clocks {
            cases.truncate(1);
            cases.first().map(|case| self.alone(case)).transpose()?
        } else {
            None
        };
        let equations = alone.as_ref().unwrap_or(&self.equations);
        let mut best: Option<(f64, Plan)> = None;
        for order in [8, 4] {
            let least = best.as_ref().map_or(f64::INFINITY, |(least, _)| *least);
            let (steps, cost) = self.effort_of(order, equations, &cases, least)?;
            // Where neither order gets there, the higher one comes nearer.
            if best.is_none() || cost < least {
                best = Some((cost, Plan { order, steps }));
            }
        }
        best.map(|(_, plan)| plan).ok_or_else(|| Error::run("no order of the integration is known"))
    }

    /// Integrates cases; each gives its values in the order of what varies.
    ///
    /// # Errors
    /// When no pose of the vehicle gives a case's initial pose as measured.
    pub fn run(&self, plan: &Plan, cases: &[&[f64]]) -> Result<Vec<Case>> {
        if !self.equations.own_clocks {
            return self.refined(&self.equations, plan, cases);
        }
        // Cases that look their logged inputs up at different times share no instant: each is compiled on its own.
        let alone = |case: &&[f64]| self.refined(&self.alone(case)?, plan, &[case]);
        Ok(cases.iter().map(alone).collect::<Result<Vec<_>>>()?.concat())
    }

    fn alone(&self, case: &[f64]) -> Result<LaneEquations> {
        LaneEquations::new(&self.model, &self.inputs, &self.varied, Some(case))
    }
}

/// That what varies is there: a symbol no formula reads would vary for nothing. So would a constant of the inputs under a
/// name that means the time or a quantity of the model.
fn known(model: &Model, inputs: &EnsembleInputs, varied: &[Varied], pose: usize) -> Result<()> {
    let values = model.values();
    let own = varied.iter().filter_map(|v| if let Varied::Input(s) = v { Some(s) } else { None });
    if let Some(name) = inputs.constants.keys().chain(own).find(|s| s.as_str() == "t" || values.contains_key(s)) {
        return Err(Error::input(format!("a constant of the inputs cannot be called {name}, which has a meaning")));
    }
    let stranger = varied.iter().find_map(|v| match v {
        Varied::Model(s) if !values.contains_key(s) => Some(s.to_string()),
        Varied::Initial(i) if *i >= pose => Some(format!("component {i} of the initial pose")),
        _ => None,
    });
    match stranger {
        Some(name) => Err(Error::input(format!("the model has no {name} that could vary"))),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{Applied, named};
    use crate::formula::Expr;
    use crate::motion::ensemble::steps::Scheme;

    fn wheels(delay: f64, knots: &[f64], times: &[f64], tolerance: f64) -> Ensemble {
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        let late = Applied::new(named("input-delay").unwrap(), None, vec![delay]);
        let model = if delay == 0.0 { model } else { model.with_effect(late) };
        let formulas = ["2 + sin(3*t)", "cos(2*t)"].map(|f| Expr::parse(f).unwrap()).to_vec();
        let inputs = EnsembleInputs { formulas, knots: knots.to_vec(), ..EnsembleInputs::default() };
        let varied = [Varied::Model("wheel_radius".into())];
        Ensemble::new(&model, &inputs, &varied, &[0.0; 3], 0.0, times, tolerance).unwrap()
    }

    /// Where inputs have a kink a step ends, as late as they act; what lies outside is none.
    #[test]
    fn spans_end_at_kinks_and_rows() {
        let ends = |e: &Ensemble| e.spans(&e.equations).iter().map(|s| (s.from, s.to, s.row)).collect::<Vec<_>>();
        let prompt = wheels(0.0, &[-1.0, 0.0, 0.5, 1.0, 2.0, 9.0], &[1.0, 2.0], 1e-10);
        assert_eq!(ends(&prompt), [(0.0, 0.5, false), (0.5, 1.0, true), (1.0, 2.0, true)]);
        let late = wheels(0.25, &[-1.0, -0.125, 0.5, 1.75, 9.0], &[1.0, 2.0], 1e-10);
        let wanted = [(0.0, 0.125, false), (0.125, 0.75, false), (0.75, 1.0, true), (1.0, 2.0, true)];
        assert_eq!(ends(&late), wanted);
    }

    /// An order that does not get there at all is not the cheaper one: long runs are as exact as asked for.
    #[test]
    fn long_runs_get_there() {
        for (end, tolerance) in [(100.0, 1e-10), (3600.0, 1e-9)] {
            let wheels = wheels(0.0, &[], &[end], tolerance);
            let plan = wheels.plan(|_| vec![0.5], 1).unwrap();
            let cases = wheels.run(&plan, &[&[0.5]]).unwrap();
            assert!(cases[0].converged && plan.order == 8, "{end} s: {plan:?} {:?}", cases[0].error);
        }
        // Neither order does through kinks that nobody told of, and the higher one is taken.
        let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
        let formulas = ["abs(sin(50*t))", "1"].map(|f| Expr::parse(f).unwrap()).to_vec();
        let inputs = EnsembleInputs { formulas, ..EnsembleInputs::default() };
        let kinks = Ensemble::new(&model, &inputs, &[], &[0.0; 3], 0.0, &[20.0], 1e-14).unwrap();
        let plan = kinks.plan(|_| vec![], 1).unwrap();
        assert_eq!((plan.order, plan.steps), (8, 1.0));
    }

    /// The order is the one that costs less: 8 for many digits, 4 for few over a short time.
    #[test]
    fn the_plan_costs_less_than_the_other_order() {
        for (tolerance, end) in [(1e-12, 20.0), (1e-3, 0.05)] {
            let wheels = wheels(0.0, &[], &[end], tolerance);
            let plan = wheels.plan(|_| vec![0.5], 3).unwrap();
            let cost = |order| wheels.effort_of(order, &wheels.equations, &[&[0.5]], f64::INFINITY).unwrap().1;
            let cheaper = if cost(8) < cost(4) { 8 } else { 4 };
            assert!(cost(8) != cost(4) && plan.order == cheaper, "{tolerance}: {plan:?}");
            assert_eq!(cheaper, if tolerance < 1e-6 { 8 } else { 4 });
        }
        assert_eq!([Scheme::of_order(8).order, Scheme::of_order(4).order], [8, 4]);
    }
}
