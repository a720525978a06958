//! Simulation of a model under given inputs, as the table a logger would write.

use super::trajectory::{all_inputs, delays, simulate_by};
use super::{Drive, Integrator, initial_hidden, visible_state};
use crate::error::{Error, Result};
use crate::formula::{Graph, Program, Symbol};
use crate::model::{Equations, Model, Workspace};

/// Named columns of equal length.
///
/// ```
/// use creepage::motion::Table;
/// let table = Table { names: vec!["t".into(), "x".into()], columns: vec![vec![0.0, 1.0], vec![0.0, 0.5]] };
/// assert_eq!((table.rows(), table.column("x")), (2, Some(&[0.0, 0.5][..])));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Names of the columns.
    pub names: Vec<String>,
    /// Values, column by column.
    pub columns: Vec<Vec<f64>>,
}

impl Table {
    /// The column of that name.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        self.names.iter().position(|n| n == name).map(|i| self.columns[i].as_slice())
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }
}

/// Simulates a model under given inputs from a measured pose and tabulates what a logger would see.
///
/// | column | unit | meaning |
/// |---|---|---|
/// | `time` | s | the given times; the first is that of `start` |
/// | `x`, `y`, `heading` | m, rad | measured pose: lever arm and heading offset included; the heading is not wrapped |
/// | `trailer_heading_1` … | rad | headings of the trailers, not wrapped |
/// | `speed` | m/s | v_l, forward speed of the reference point |
/// | `lateral_speed` | m/s | v_t, its speed to the left |
/// | `yaw_rate` | rad/s | rate of the body's heading |
/// | the states of the effects by their symbols | | such as `cornering_creep.w` |
/// | what is measured beside the pose, by name | | the quantities of `[measured]` in the model file, as their sensors give them |
///
/// `start` holds what the sensor measures at the first time: x, y, heading, trailer headings. States that no
/// sensor sees begin at their quasi-static values, see [`initial_hidden`].
///
/// # Errors
/// As [`super::simulate`], [`visible_state`], and when a speed is undefined.
///
/// ```
/// use creepage::model::Model;
/// use creepage::motion::{simulate_model, Integrator, Signals, Timing};
/// let model = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap();
/// let t = [0.0, 0.5, 1.0];
/// let inputs = Signals::new(&t, &[vec![2.0; 3], vec![0.1; 3]], Timing::Sample);
/// let table = simulate_model(&model, &inputs, &t, &[0.0; 3], &Integrator::default()).unwrap();
/// assert!((table.column("heading").unwrap()[2] - 0.1).abs() < 1e-12);
/// assert_eq!(table.column("speed").unwrap(), [1.0; 3]);
/// ```
pub fn simulate_model(
    model: &Model,
    inputs: &impl Drive,
    times: &[f64],
    start: &[f64],
    integrator: &Integrator,
) -> Result<Table> {
    let equations = model.equations_to_simulate()?;
    let first = *times.first().ok_or_else(|| Error::input("a simulation needs at least one time"))?;
    if inputs.channels() != equations.logged() {
        let (given, wanted) = (inputs.channels(), equations.logged());
        return Err(Error::input(format!("{given} inputs are given, the model has {wanted}")));
    }
    let mut w = equations.workspace(&[]);
    let (delay, own) = delays(&equations, equations.delay(&mut w));
    let at = |t: f64| {
        let (mut u, mut slope) = (vec![0.0; equations.inputs.len()], vec![0.0; equations.inputs.len()]);
        all_inputs(&equations, inputs, t - delay, &own, &mut u, &mut slope);
        u
    };
    let mut z0 = visible_state(&equations, &[], start)?;
    z0.extend(initial_hidden(&equations, &[], &at(first), &z0));
    let speeds = Speeds::new(model, &equations)?;
    let mut names = names(&equations);
    let quantities: Vec<usize> = model.measured.iter().map(|m| place(&mut names, &m.name)).collect();
    let mut columns: Vec<Vec<f64>> = names.iter().map(|_| Vec::with_capacity(times.len())).collect();
    simulate_by(&equations, &[], inputs, &z0, times, integrator, &mut |t, z| {
        let row = row((t, z, &at(t)), &equations, &mut w, &speeds, &quantities)?;
        columns.iter_mut().zip(row).for_each(|(column, value)| column.push(value));
        Ok(())
    })?;
    Ok(Table { names, columns })
}

fn names(equations: &Equations) -> Vec<String> {
    let trailers = (1..=equations.poses - 3).map(|i| format!("trailer_heading_{i}"));
    let pose = ["time", "x", "y", "heading"].map(String::from).into_iter().chain(trailers);
    let speeds = ["speed", "lateral_speed", "yaw_rate"].map(String::from);
    let hidden = equations.states[equations.poses..].iter().map(ToString::to_string);
    pose.chain(speeds).chain(hidden).collect()
}

/// The place of a column, which is added where there is none of that name.
fn place(names: &mut Vec<String>, name: &str) -> usize {
    names.iter().position(|n| n == name).unwrap_or_else(|| {
        names.push(name.to_string());
        names.len() - 1
    })
}

fn row(
    (t, z, u): (f64, &[f64], &[f64]),
    equations: &Equations,
    w: &mut Workspace,
    speeds: &Speeds,
    quantities: &[usize],
) -> Result<Vec<f64>> {
    let measured = &equations.outputs(w, z)[..equations.poses];
    let mut row = [&[t], measured, &speeds.at(z, u), &z[equations.poses..]].concat();
    if !quantities.is_empty() {
        for (place, value) in quantities.iter().zip(equations.quantities(w, z, u)) {
            match row.get_mut(*place) {
                Some(cell) => *cell = value,
                None => row.push(value),
            }
        }
    }
    match row.iter().all(|v| v.is_finite()) {
        true => Ok(row),
        false => Err(Error::run(format!("the motion is undefined at t = {t}"))),
    }
}

/// v_l, v_t and the yaw rate as the model defines them.
struct Speeds {
    program: Program,
    values: Vec<f64>,
}

impl Speeds {
    fn new(model: &Model, equations: &Equations) -> Result<Self> {
        let mut graph = Graph::default();
        model.definitions()?.insert_into(&mut graph)?;
        let wanted = ["v_l", "v_t", "phi'"].map(Symbol::from);
        let nodes: Option<Vec<_>> = wanted.iter().map(|s| graph.definition(s)).collect();
        let nodes = nodes.ok_or_else(|| Error::run("the model does not define its speeds"))?;
        let (names, values): (Vec<Symbol>, Vec<f64>) = model.values().into_iter().unzip();
        let slots = [&equations.states[..], &equations.inputs, &names].concat();
        let program = Program::compile(&graph, &slots, &nodes)
            .map_err(|name| Error::input(format!("a formula uses {name}, which nothing defines")))?;
        Ok(Self { program, values })
    }

    fn at(&self, z: &[f64], u: &[f64]) -> [f64; 3] {
        let mut found = [0.0; 3];
        self.program.run(&[z, u, &self.values].concat(), &mut self.program.registers(), &mut found);
        found
    }
}
