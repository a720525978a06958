//! A sweep ready to run: its file, its model and its log held against one another.

use super::cases::Cases;
use super::names::{self, Allowed};
use crate::dynamics;
use crate::effects;
use crate::effects::Effect;
use crate::error::{Error, Result};
use crate::extensions;
use crate::files::{Initial, Inputs, ModelFile, Spot, SweepFile};
use crate::formula::{Expr, Symbol};
use crate::model::Model;
use crate::motion::{Ensemble, EnsembleInputs, Plan, Signals, Varied};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;

/// A sweep ready to run.
///
/// ```
/// use creepage::sweep::Sweep;
/// assert_eq!(Sweep::read("examples/sweeps/wheels.toml")?.cases(), 2 * 9 * 9 * 10);
/// # Ok::<(), creepage::Error>(())
/// ```
pub struct Sweep {
    pub(super) file: SweepFile,
    /// Names of what varies: the grid, then what is drawn.
    pub(super) names: Vec<String>,
    pub(super) cases: Cases,
    pub(super) ensemble: Ensemble,
    pub(super) plan: Plan,
    /// SHA-256 of everything that decides the result.
    pub(super) identity: String,
    /// Rows of a case.
    pub(super) rows: usize,
    /// Columns of a row.
    pub(super) width: usize,
    /// What a user should know of the log.
    pub(super) warnings: Vec<String>,
}

impl Sweep {
    /// Reads the file of a sweep with its model, effects and log, and tries a few of its cases.
    ///
    /// # Errors
    /// With file, line and column, where one of the files is not as it should be, or they do not fit together.
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let file = SweepFile::read(path)?;
        let vehicles = extensions::vehicles_of(&file.model, file.vehicles.as_deref())?;
        let library = match &file.effects {
            Some(own) => extensions::with_own_on(own, &vehicles)?,
            None => effects::all().to_vec(),
        };
        let model_file = ModelFile::read(&file.model, &dynamics::known_on(&vehicles, &library))?;
        Model::check_motion(&model_file)?;
        let mut log = file.log.as_ref().map(|path| Inputs::read(path, &model_file)).transpose()?;
        let warnings = log.as_mut().map(|l| std::mem::take(&mut l.warnings)).unwrap_or_default();
        let roles = roles(&file, &model_file, log.as_ref())?;
        let model = Model::from_file(&model_file, &library, &roles)?;
        let (from, times) = times(&file, log.as_ref())?;
        let (varied, allowed) = varied(&file, &model_file, &model)?;
        let inputs = inputs(&file, &model_file, &model, log.as_ref(), &varied)?;
        let mut initial = initial(&model_file, log.as_ref());
        initial.extend(model.speeds_at_start(model_file.dynamics.as_ref()));
        let ensemble = Ensemble::new(&model, &inputs, &varied, &initial, from, &times, file.error)?;
        let cases = Cases::new(&file, &allowed[file.grid.len()..]);
        let one = |i: usize| {
            let mut values = Vec::new();
            cases.push(i, &mut values);
            values
        };
        let plan = ensemble.plan(one, file.cases)?;
        let names: Vec<String> =
            file.grid.iter().map(|a| &a.name).chain(file.sampled.iter().map(|s| &s.name)).cloned().collect();
        let (rows, width) = (times.len(), 3 + names.len() + ensemble.columns().len());
        let identity = identity(&file, &model_file, &library, log.as_ref());
        Ok(Self { file, names, cases, ensemble, plan, identity, rows, width, warnings })
    }

    /// How many cases there are.
    pub fn cases(&self) -> usize {
        self.file.cases
    }

    /// The files that the cases are made from.
    pub fn inputs(&self) -> Vec<&Path> {
        let log = self.file.log.as_deref();
        [Some(self.file.path.as_path()), Some(self.file.model.as_path()), log].into_iter().flatten().collect()
    }

    /// The log, and what a user should know of it, such as rows that are left out.
    pub fn warnings(&self) -> Option<(&Path, &[String])> {
        self.file.log.as_ref().map(|log| (log.as_path(), self.warnings.as_slice()))
    }
}

/// What decides the result: every file that is read, and the program.
fn identity(file: &SweepFile, model: &ModelFile, library: &[Effect], log: Option<&Inputs>) -> String {
    let mut all = vec![env!("CARGO_PKG_VERSION").to_string(), file.sha256.clone(), model.sha256.clone()];
    all.extend(model.vehicle_origin().map(|o| o.sha256.clone()));
    all.extend(library.iter().filter_map(|e| e.origin.as_ref()).map(|o| o.sha256.clone()));
    all.extend(log.map(|l| l.sha256.clone()));
    format!("{:x}", Sha256::digest(all.join("\n")))
}

/// The inputs of the model by role: those of the log, or those that have formulas.
fn roles(file: &SweepFile, model: &ModelFile, log: Option<&Inputs>) -> Result<Vec<String>> {
    if let Some(log) = log {
        let stranger = file.inputs.iter().find(|i| !log.roles.contains(&i.role));
        return match stranger {
            Some(i) => Err(not_driven(&i.spot, &i.role, &log.roles)),
            None => Ok(log.roles.clone()),
        };
    }
    let mut found = Vec::new();
    for column in &model.columns.inputs {
        let names: Vec<&String> = std::iter::once(&column.role).chain(&column.instead).collect();
        let given = names.iter().find(|name| file.inputs.iter().any(|i| i.role == ***name));
        let given = given.ok_or_else(|| {
            let shown = names.iter().map(|n| n.as_str()).collect::<Vec<_>>().join(" or ");
            Error::input(format!("the input {shown} has no formula"))
                .at_file(&file.path)
                .at(file.inputs_at.0, file.inputs_at.1)
                .help(format!("write {} = \"1.0\" under [inputs], a formula of t, or give a log", column.role))
        })?;
        found.push((*given).clone());
    }
    match file.inputs.iter().find(|i| !found.contains(&i.role)) {
        Some(i) => Err(not_driven(&i.spot, &i.role, &found)),
        None => Ok(found),
    }
}

fn not_driven(spot: &Spot, role: &str, roles: &[String]) -> Error {
    let known: Vec<&str> = roles.iter().map(String::as_str).collect();
    spot.error(format!("the model has no input \"{role}\" here")).help(crate::files::advice(role, "its inputs", &known))
}

/// When the motion begins, and the times of the rows.
fn times(file: &SweepFile, log: Option<&Inputs>) -> Result<(f64, Vec<f64>)> {
    let ends = log.map(|l| (l.time[0], l.time[l.time.len() - 1]));
    let start = file.start.or(ends.map(|e| e.0)).unwrap_or(0.0);
    let duration = file.duration.or(ends.map(|e| e.1 - start).filter(|d| *d > 0.0));
    let duration = duration.ok_or_else(|| {
        Error::input("key \"duration\" is missing")
            .at_file(&file.path)
            .at(1, 1)
            .help("write duration = 10.0, in seconds")
    })?;
    let at = |(line, column), e: Error| e.at_file(&file.path).at(line, column);
    let end = start + duration;
    if !end.is_finite() || end <= start {
        let why = if end.is_finite() { "is lost in rounding beside" } else { "leads beyond all numbers from" };
        let error = Error::input(format!("duration = {duration:?} {why} start = {start:?}"));
        return Err(at(file.duration_at, error.help("count the time from another start")));
    }
    Ok((start, file.rows.times(start, end).map_err(|e| at(file.every_at, e))?))
}

/// What varies, and the values each may take.
fn varied(file: &SweepFile, model_file: &ModelFile, model: &Model) -> Result<(Vec<Varied>, Vec<Allowed>)> {
    let known = names::quantities(model_file, model);
    let values = model.values();
    let own = |s: &Symbol| s.as_str() != "t" && !s.as_str().starts_with("log.") && !values.contains_key(s);
    let used: Vec<Symbol> = file.inputs.iter().flat_map(|i| i.formula.formula.symbols()).filter(own).collect();
    let mut found: Vec<(Varied, Allowed)> = Vec::new();
    for axis in &file.grid {
        let (varied, allowed) = names::find(&axis.name, &axis.spot, &known, &used)?;
        (0..axis.values.count()).try_for_each(|i| allowed.check(&axis.name, axis.values.at(i), &axis.spot))?;
        found.push((varied, allowed));
    }
    for sampled in &file.sampled {
        let (varied, allowed) = names::find(&sampled.name, &sampled.spot, &known, &used)?;
        use crate::files::Distribution::{LogUniform, Normal, Uniform};
        let bounds = match sampled.from {
            Uniform(a, b) | LogUniform(a, b) => [a, b],
            Normal(mean, _) => [mean, mean],
        };
        bounds.iter().try_for_each(|v| allowed.check(&sampled.name, *v, &sampled.spot))?;
        found.push((varied, allowed));
    }
    own_names(file, &known, &values)?;
    Ok(found.into_iter().unzip())
}

/// That a constant has its name alone: of two things of one name a formula would mean one, and the other be set in vain.
fn own_names(file: &SweepFile, known: &[names::Quantity], values: &BTreeMap<Symbol, f64>) -> Result<()> {
    for (name, (spot, _)) in &file.constants {
        let varies = file.grid.iter().map(|a| &a.name).chain(file.sampled.iter().map(|s| &s.name)).any(|n| n == name);
        let of_model = values.contains_key(&Symbol::new(name)) || known.iter().any(|q| q.name == *name);
        let (is, help) = match (of_model, varies) {
            (true, _) => ("a quantity of the model", "rename it, or vary the model's under [grid]"),
            (_, true) => ("varied as well", "remove it from [constants], or from what varies"),
            _ => continue,
        };
        return Err(spot.error(format!("the constant {name} is {is}")).help(help));
    }
    Ok(())
}

/// Formulas of the inputs in the model's order; a logged input without a formula is what was logged.
fn inputs(
    file: &SweepFile,
    model_file: &ModelFile,
    model: &Model,
    log: Option<&Inputs>,
    varied: &[Varied],
) -> Result<EnsembleInputs> {
    let channels = log.map_or(&[][..], |l| &l.roles);
    let values = model.values();
    let known = |s: &Symbol| {
        s.as_str() == "t"
            || file.constants.contains_key(s.as_str())
            || varied.contains(&Varied::Input(s.clone()))
            || values.contains_key(s)
            || s.as_str().strip_prefix("log.").is_some_and(|name| channels.iter().any(|c| c == name))
    };
    for input in &file.inputs {
        if let Some(stranger) = input.formula.formula.symbols().iter().find(|s| !known(s)) {
            let error = input.formula.error_at(stranger, format!("{stranger} has no value"));
            return Err(error.help("give it one under [constants], [grid] or [sample.of]"));
        }
    }
    let formula = |role: &String| match file.inputs.iter().find(|i| i.role == *role) {
        Some(i) => i.formula.formula.clone(),
        None => Expr::sym(Symbol::new(&format!("log.{role}"))),
    };
    let constants: BTreeMap<Symbol, f64> = file.constants.iter().map(|(k, (_, v))| (Symbol::new(k), *v)).collect();
    let signals = |l: &Inputs| (l.roles.clone(), Signals::of_inputs(l, model_file.input_timing));
    Ok(EnsembleInputs {
        formulas: model.inputs.iter().map(formula).collect(),
        constants,
        log: log.map(signals),
        knots: file.knots.clone(),
    })
}

/// The measured pose every case begins with, unless it varies: the model's, the log's, or the origin.
fn initial(model: &ModelFile, log: Option<&Inputs>) -> Vec<f64> {
    let origin = || Initial { trailer_headings: vec![0.0; model.trailers()], ..Initial::default() };
    let pose = model.initial.clone().or(log.and_then(|l| l.pose.clone())).unwrap_or_else(origin);
    [pose.x, pose.y, pose.heading].into_iter().chain(pose.trailer_headings).collect()
}
