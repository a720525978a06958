//! A model as code without dependencies: rates with their exact derivatives, a step with its Jacobian, an observer, and inputs for
//! a wanted motion.

use super::corrections::{Corrections, origin, written};
use super::exported::Exported;
use super::function::Function;
use super::language::Language;
use crate::effects::{Effect, Scope};
use crate::error::{Error, Result};
use crate::files::ModelFile;
use crate::formula::{Expr, Symbol};
use crate::model::{Model, observation};
use std::collections::BTreeMap;

/// What an observer lets each measured state wander beside the model in a second of a random walk, m and rad.
pub const WALK: f64 = 0.01;
/// Deviations of a measured position, m, and heading, rad, where the model file says nothing of them.
const NOISE: [f64; 2] = [0.005, 0.01];

/// A model as code.
///
/// z′ = f(z, u) is written out definition by definition, each with its derivatives by (z, u) by the chain rule; a step is the
/// classical Runge–Kutta scheme of order four with inputs that are held, W′ = f_z·W + [0 | f_u] beside it. The observer is an
/// extended Kalman filter on that step; inputs for a wanted motion are found by Newton's method, hidden states at rest.
#[derive(Clone, Debug)]
pub struct Code {
    states: Vec<Symbol>,
    inputs: Vec<Symbol>,
    /// Values that the model fixes.
    constants: Vec<(Symbol, f64)>,
    /// The rate of each state.
    rates: Function,
    /// What the sensor measures, one after another.
    measured: Function,
    /// Their deviations.
    noise: Vec<f64>,
    /// How many inputs are commanded; others follow from these.
    commanded: usize,
    unsaid: Vec<String>,
    covariance: (Vec<String>, Vec<Vec<f64>>),
    head: Vec<String>,
}

impl Code {
    /// The code of a model file with the effects of a library.
    ///
    /// # Errors
    /// As [`Code::of`], and when the file's model cannot be built.
    pub fn of_file(file: &ModelFile, library: &[Effect]) -> Result<Self> {
        Model::check_motion(file)?;
        Self::of(&Model::of_file(file, library)?, file).map_err(|e| e.at_file(&file.path))
    }

    /// The code of a model that stands in a file; effects of a time of the log, and delays, are left out and told.
    ///
    /// # Errors
    /// When the constraints do not determine the motion.
    pub fn of(model: &Model, file: &ModelFile) -> Result<Self> {
        let says_time = |scope: &Option<Scope>| matches!(scope, Some(Scope::Times(_)));
        let (left, kept): (Vec<_>, Vec<_>) = model.effects.iter().cloned().partition(|e| {
            let moves = e.effect.course.is_some() || e.effect.walk.is_some();
            moves || says_time(&e.effect.scope) || e.effect.is_of_clock() || e.effect.changes.contains_key("delay")
        });
        let model = Model { effects: kept, ..model.clone() };
        let equations = model.equations_to_simulate()?;
        let definitions = model.definitions()?;
        let hidden: BTreeMap<Symbol, Expr> = model.effects.iter().flat_map(|e| e.states()).collect();
        let rate = |state: &Symbol| {
            hidden
                .get(state)
                .or_else(|| definitions.get(&state.rate()))
                .cloned()
                .ok_or_else(|| Error::run(format!("the model does not define the rate of {state}")))
        };
        let rates = equations.states.iter().map(rate).collect::<Result<Vec<_>>>()?;
        let sorted: Vec<(Symbol, Expr)> =
            definitions.sorted()?.into_iter().map(|(n, f)| (n.clone(), f.clone())).collect();
        let outputs: Vec<_> = observation::outputs(model.trailer_count()).collect();
        let deviation = |heading: bool| match heading {
            false => file.noise.position.unwrap_or(NOISE[0]),
            true => file.noise.heading.unwrap_or(NOISE[1]),
        };
        Ok(Self {
            states: equations.states.clone(),
            inputs: equations.inputs.clone(),
            constants: model.values().into_iter().collect(),
            rates: Function::of(rates, &sorted),
            measured: Function::of(outputs.iter().map(|y| Expr::sym(y.symbol())).collect(), &sorted),
            noise: outputs.iter().map(|y| deviation(y.is_angle)).collect(),
            commanded: equations.logged(),
            unsaid: left.iter().map(|e| written(&e.entry())).collect(),
            covariance: (vec![], vec![]),
            head: head(file),
        })
    }

    /// With the covariance of fitted parameters, by their names.
    pub fn with_covariance(self, names: Vec<String>, matrix: Vec<Vec<f64>>) -> Self {
        Self { covariance: (names, matrix), ..self }
    }

    /// The code in a language.
    pub fn export(&self, language: Language) -> Exported {
        let number = |v: &f64| format!("{v:?}");
        let comment = language.comment();
        let left_out = self.unsaid.iter().map(|e| format!("left out: {e}"));
        let head: Vec<String> =
            self.head.iter().cloned().chain(left_out).map(|line| format!("{comment} {line}")).collect();
        let list = |names: &[Symbol]| names.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let (rates, measured) = (&self.rates, &self.measured);
        let variables: Vec<&Symbol> = self.states.iter().chain(&self.inputs).collect();
        let read = |function: &Function| {
            let inputs = function.read(language, "u", &self.inputs);
            let constants = function.constants(language, &self.constants);
            format!("{}{inputs}{constants}", function.read(language, "z", &self.states))
        };
        let numbers = |values: Vec<f64>| language.list(&values.iter().map(number).collect::<Vec<_>>());
        let walk = (0..self.states.len()).map(|i| if i < self.noise.len() { WALK * WALK } else { 0.0 });
        let twist = self.commanded.clamp(1, 3);
        // C has no lists of no length.
        let (mut names, mut matrix) = (self.covariance.0.clone(), self.covariance.1.clone());
        let p = names.len();
        if matches!(language, Language::C | Language::Cpp) {
            names.push(String::new());
            matrix.iter_mut().for_each(|row| row.push(0.0));
            matrix.push(vec![0.0; p + 1]);
        }
        let names: Vec<String> = names.iter().map(|n| format!("{n:?}")).collect();
        let rows: Vec<String> =
            matrix.iter().map(|row| language.list(&row.iter().map(number).collect::<Vec<_>>())).collect();
        let parts = [
            ("@HEAD@", head.join("\n")),
            ("@STATES@", list(&self.states)),
            ("@INPUTS@", list(&self.inputs)),
            ("@N@", self.states.len().to_string()),
            ("@M@", self.inputs.len().to_string()),
            ("@P@", p.to_string()),
            ("@NAMES@", language.list(&names)),
            ("@COVARIANCE@", language.list(&rows)),
            ("@READ@", read(rates)),
            ("@VALUES@", rates.values(language)),
            ("@RATES@", rates.results(language, "rate")),
            ("@SLOPES@", rates.slopes(language, &variables)),
            ("@K@", self.noise.len().to_string()),
            ("@COMMANDED@", self.commanded.to_string()),
            ("@T@", twist.to_string()),
            ("@TWIST@", ["ahead", "ahead, turning", "ahead, to the left, turning"][twist - 1].to_string()),
            ("@WALK@", numbers(walk.collect())),
            ("@NOISE@", numbers(self.noise.iter().map(|d| d * d).collect())),
            ("@READ_MEASURED@", read(measured)),
            ("@VALUES_MEASURED@", measured.values(language)),
            ("@MEASURED@", measured.results(language, "y")),
            ("@SLOPES_MEASURED@", measured.slopes(language, &self.states.iter().collect::<Vec<_>>())),
        ];
        let text = parts.into_iter().fold(language.template(), |t, (mark, part)| t.replace(mark, &part));
        Exported { text, unsaid: self.unsaid.clone() }
    }
}

/// Where code comes from, and what its state is of.
fn head(file: &ModelFile) -> Vec<String> {
    let from = origin(file);
    let found = Corrections::of(file);
    let [x, y, yaw] = found.place;
    let tracked = format!(
        "The state is that of the reference point; the tracked frame is at x {x} m, y {y} m, yaw {yaw} rad on it."
    );
    if found.is_at_reference() { vec![from] } else { vec![from, tracked] }
}
