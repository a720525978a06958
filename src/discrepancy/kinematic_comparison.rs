//! The kinematic model of a log beside the one with forces: driven by what the log measures of its wheels, and the creep
//! coefficients that the forces predict of it (model comparison by out-of-sample error; Burnham and Anderson, *Model Selection
//! and Multimodel Inference*, 2002).

use super::discovery::{Clocks, Discovery};
use super::estimation::fit::Effort;
use super::estimation::problem::Problem;
use super::initial_state::speed_fit::{BEFORE, speeds_at};
use super::pose_filter::discover_before_filter;
use super::record::run_record::Record;
use super::report::KinematicComparison;
use super::request::Request;
use crate::effects::Applied;
use crate::error::Result;
use crate::files::{EffectEntry, InputColumn, ModelFile, Run};
use crate::model::Model;
use crate::model::effect_equation::is_term;
use crate::motion::{Integrator, Signals, simulate_model};
use crate::progress::OnProgress;
use std::collections::BTreeMap;

/// What the kinematic model of a log with forces says, where the log measures all that drives it; `None` where it does not,
/// where the model has no forces, and where its constraints alone determine no motion.
///
/// # Errors
/// When an effect of the file does not apply to the vehicle without forces.
pub(crate) fn kinematic(
    request: &Request,
    forced: &Discovery,
    progress: &OnProgress,
) -> Result<Option<KinematicComparison>> {
    let Some(rates) = Rates::of(request)? else { return Ok(None) };
    let (runs, held_out) = (rates.driving_all(request.runs), rates.driving_all(request.held_out));
    let of_wheels = Request { file: &rates.file, runs: &runs, held_out: &held_out, ..*request };
    let found = discover_before_filter(&of_wheels, Clocks::default(), progress)?;
    let by_forces = rates.predicted(request, forced, &found)?;
    Ok(Some(KinematicComparison { report: Box::new(found.report), by_forces }))
}

/// The measured rates that drive a vehicle without forces.
struct Rates {
    /// Its model file.
    file: ModelFile,
    /// Its inputs, and the measured quantities that are none of them.
    roles: Vec<String>,
    others: Vec<usize>,
    names: Vec<String>,
}

impl Rates {
    fn of(request: &Request) -> Result<Option<Self>> {
        let (file, Some(first)) = (request.file, request.runs.first()) else { return Ok(None) };
        if file.dynamics.is_none() || file.measured.is_empty() {
            return Ok(None);
        }
        let model = Model::from_file(file, request.library, &first.roles)?.kinematic();
        // A skid steer has none: its wheels contradict one another in every turn.
        if model.determined().is_err() {
            return Ok(None);
        }
        let names: Vec<String> = file.measured.iter().map(|m| m.name.clone()).collect();
        let logged = |run: &Run| {
            let is_there = |role: &String| names.contains(role) || run.roles.contains(role);
            run.apart.is_none() && run.measured.len() == names.len() && model.inputs.iter().all(is_there)
        };
        // Some rate of the motion must be measured: a steering angle alone drives nothing.
        if !request.runs.iter().chain(request.held_out).all(logged) || !model.inputs.iter().any(|r| names.contains(r)) {
            return Ok(None);
        }
        let others: Vec<usize> = (0..names.len()).filter(|k| !model.inputs.contains(&names[*k])).collect();
        let input = |role: &String| InputColumn { role: role.clone(), column: role.clone(), instead: None };
        let mut columns = file.columns.clone();
        columns.inputs = model.inputs.iter().map(input).collect();
        let without = ModelFile {
            dynamics: None,
            columns,
            measured: others.iter().map(|k| file.measured[*k].clone()).collect(),
            effects: model.effects.iter().map(Applied::entry).collect(),
            ..file.clone()
        };
        Ok(Some(Self { file: without, roles: model.inputs, others, names }))
    }

    fn driving_all(&self, runs: &[Run]) -> Vec<Run> {
        runs.iter().map(|run| self.driving(run)).collect()
    }

    /// The run with the measured rates for its inputs.
    fn driving(&self, run: &Run) -> Run {
        let column = |role: &String| match self.names.iter().position(|name| name == role) {
            Some(k) => run.measured[k].clone(),
            None => run.roles.iter().position(|r| r == role).map(|k| run.inputs[k].clone()).unwrap_or_default(),
        };
        Run {
            inputs: self.roles.iter().map(column).collect(),
            differences: vec![None; self.roles.len()],
            roles: self.roles.clone(),
            measured: self.others.iter().map(|k| run.measured[*k].clone()).collect(),
            ..run.clone()
        }
    }

    /// The values of the effects that the kinematic model asks for on the motion that the forces make, without noise: effect
    /// by effect of its report.
    fn predicted(
        &self,
        request: &Request,
        forced: &Discovery,
        found: &Discovery,
    ) -> Result<Vec<BTreeMap<String, f64>>> {
        if found.added.is_empty() {
            return Ok(vec![]);
        }
        let patched = request.file.with_effects(&forced.added);
        let model = Model::from_file(&patched, request.library, &request.runs[0].roles)?;
        let motions = request.runs.iter().filter_map(|run| motion(&model, &patched, run)).map(|run| self.driving(&run));
        let with = Model::from_file(&self.file.with_effects(&found.added), request.library, &self.roles)?;
        let asked = |e: &Applied| found.added.iter().any(|a| a.same_target(&e.entry()));
        let free = |e: &Applied| if asked(e) { e.clone().freed() } else { e.clone() };
        let with = Model { effects: with.effects.iter().map(free).collect(), ..with };
        let records: Vec<Record> =
            motions.map(|run| Record::of_run(&run, request.file.input_timing, with.freedom())).collect();
        if records.is_empty() {
            return Ok(vec![]);
        }
        let problem = Problem::new(records, None, None);
        let fit = problem.fit(&with, &problem.starts(&with)?, &problem.variances, Effort::FULL)?;
        let Some(fit) = fit else { return Ok(vec![]) };
        // In the order of the report, which lists laws without a name apart.
        let of = |entry: &EffectEntry| fit.model.effects.iter().find(|e| entry.same_target(&e.entry()));
        Ok(found.added.iter().filter_map(of).filter(|e| !is_term(e)).map(Applied::named_values).collect())
    }
}

/// A run as the model moves over its inputs, from where its rows begin: poses and measured quantities without noise.
fn motion(model: &Model, file: &ModelFile, run: &Run) -> Option<Run> {
    let record = Record::of_run(run, file.input_timing, model.freedom());
    let equations = model.equations(&[]).ok()?;
    let begin = speeds_at(&equations, &record, 0, BEFORE)?.state;
    let start = [&record.smoothed(0)[..equations.poses], &begin[equations.poses..equations.visible]].concat();
    let signals = Signals::of_run(run, file.input_timing);
    let integrator = Integrator::default().for_friction(file.has_friction());
    let table = simulate_model(model, &signals, &run.time, &start, &integrator).ok()?;
    let column = |name: &str| table.column(name).map(<[f64]>::to_vec);
    let trailers = (1..=run.trailer_headings.len()).map(|i| column(&format!("trailer_heading_{i}")));
    Some(Run {
        x: column("x")?,
        y: column("y")?,
        heading: Some(column("heading")?),
        trailer_headings: trailers.collect::<Option<_>>()?,
        measured: model.measured.iter().map(|m| column(&m.name)).collect::<Option<_>>()?,
        ..run.clone()
    })
}
