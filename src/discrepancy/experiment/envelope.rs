//! How a vehicle was driven: what a new manoeuvre may ask of it.

use crate::discrepancy::record::run_record::Record;
use crate::formula::Symbol;
use crate::model::{Model, mechanism};
use crate::vehicles::Moves;

/// What a driver can change beside the speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turning {
    /// The yaw rate, rad/s.
    Rate,
    /// A steering angle, rad.
    Angle,
    /// Nothing: the vehicle follows a line.
    Nothing,
}

/// The largest speeds and turns of some runs.
#[derive(Clone, Debug)]
pub struct Envelope {
    /// Largest speed, m/s.
    pub speed: f64,
    /// Largest turn: yaw rate, rad/s, or steering angle, rad.
    pub turn: f64,
    /// Largest speed times yaw rate, m/s², of a steered vehicle v²·tan δ, m²/s².
    pub load: f64,
    /// Whether it was driven backwards.
    pub reverses: bool,
    /// What turns it.
    pub turning: Turning,
    inputs: Vec<Input>,
}

/// A logged input as speed·v + turn·w of a speed v, m/s, and a turn w.
#[derive(Clone, Copy, Debug)]
struct Input {
    speed: f64,
    turn: f64,
}

/// Share of the rows that lie within the envelope.
const SHARE: f64 = 0.98;
/// Nothing drives slower than this, m/s.
const SLOWEST: f64 = 0.05;
/// A vehicle that was never turned can be turned so much: m/s² at its largest speed, rad/s and rad.
const GENTLE: [f64; 3] = [1.0, 0.5, 0.1];

impl Envelope {
    /// The envelope of runs; `None` for inputs it does not know.
    pub fn of(model: &Model, records: &[Record]) -> Option<Self> {
        let inputs = model.inputs.iter().map(|role| input(model, role)).collect::<Option<Vec<_>>>()?;
        let steered = model.inputs.iter().any(|r| model.vehicle.moved_by(r) == Some(Moves::Steering));
        let turning = match (inputs.iter().any(|i| i.turn != 0.0), steered) {
            (false, _) => Turning::Nothing,
            (true, true) => Turning::Angle,
            (true, false) => Turning::Rate,
        };
        let driven: Vec<[f64; 2]> = records.iter().flat_map(|r| driven(r, &inputs)).collect();
        let quantile = |f: &dyn Fn(&[f64; 2]) -> f64| {
            let mut values: Vec<f64> = driven.iter().map(f).filter(|v| v.is_finite()).collect();
            values.sort_by(f64::total_cmp);
            values.get((SHARE * values.len() as f64) as usize).copied()
        };
        let speed = quantile(&|d| d[0].abs())?.max(SLOWEST);
        let (gentle, load) = match turning {
            Turning::Angle => (GENTLE[2], quantile(&|d| d[0] * d[0] * d[1].abs().tan())?),
            _ => ((GENTLE[0] / speed).min(GENTLE[1]), quantile(&|d| (d[0] * d[1]).abs())?),
        };
        let turn = quantile(&|d| d[1].abs())?;
        // A turn too small to be meant is no envelope of turns.
        let turn = if turn > 0.2 * gentle { turn } else { gentle };
        let least = if turning == Turning::Angle { speed * speed * gentle.tan() } else { speed * gentle };
        let reverses = quantile(&|d| -d[0])? > 0.1 * speed;
        Some(Self { speed, turn, load: load.max(0.5 * least), reverses, turning, inputs })
    }

    /// The turn a vehicle may make at a speed where it asks for some share of its largest one.
    pub fn bounded(&self, speed: f64, turn: f64) -> f64 {
        let most = match self.turning {
            Turning::Nothing => 0.0,
            Turning::Rate => self.load / speed.abs().max(1e-9),
            Turning::Angle => (self.load / (speed * speed).max(1e-9)).atan(),
        };
        turn.clamp(-most, most)
    }

    /// The values to log at a speed, m/s, and a turn.
    pub fn inputs(&self, speed: f64, turn: f64) -> Vec<f64> {
        self.inputs.iter().map(|i| i.speed * speed + i.turn * turn).collect()
    }
}

fn input(model: &Model, role: &str) -> Option<Input> {
    let radius = || model.parameters.get("wheel_radius").copied().filter(|r| *r > 0.0);
    let half_track = || Some(0.5 * model.parameters.get("track_width")?);
    Some(match model.vehicle.moved_by(role)? {
        Moves::Forward => Input { speed: 1.0, turn: 0.0 },
        Moves::Wheel => Input { speed: 1.0 / radius()?, turn: 0.0 },
        Moves::Yaw | Moves::Steering => Input { speed: 0.0, turn: 1.0 },
        Moves::RearSteering => Input { speed: 0.0, turn: -1.0 },
        Moves::LeftWheel => Input { speed: 1.0 / radius()?, turn: -half_track()? / radius()? },
        Moves::RightWheel => Input { speed: 1.0 / radius()?, turn: half_track()? / radius()? },
        Moves::OmniWheel => by_its_row(model, role)?,
        Moves::Shape | Moves::Push => return None,
    })
}

/// The rate of a wheel at a speed ahead and a yaw rate, from the row of the wheel that an input is logged for.
fn by_its_row(model: &Model, role: &str) -> Option<Input> {
    let by = |rate: &Symbol| {
        let formula = &model.vehicle.define.get(rate)?.formula;
        formula.derivative(&Symbol::new(role)).eval(&|_| f64::NAN).map(f64::abs)
    };
    let rates = model.vehicle.wheels.iter().filter_map(|w| w.rate.as_ref());
    let (rate, _) = rates.filter_map(|rate| Some((rate, by(rate)?))).max_by(|a, b| a.1.total_cmp(&b.1))?;
    let given = model.values();
    let ahead = |s: &Symbol| given.get(s).copied().or((s.as_str() == "phi").then_some(0.0));
    let known = model.row_definitions().ok()?.evaluate(&ahead).ok()?;
    let rows = mechanism(&model.vehicle, 0).ideal_rows();
    let row = rows.iter().find(|row| row.rates().any(|r| r == rate))?;
    let value = |s: &Symbol| ahead(s).or(known.get(s).copied()).unwrap_or(f64::NAN);
    let of = |name: &str| row.coefficient(&name.into()).eval(&value);
    let radius = -of(rate.as_str()).filter(|r| *r != 0.0)?;
    Some(Input { speed: of("x'")? / radius, turn: of("phi'")? / radius })
}

/// Speed and turn at every row: the least squares solution of the inputs.
fn driven(record: &Record, inputs: &[Input]) -> Vec<[f64; 2]> {
    let channels = record.signals.channels();
    let sum = |f: &dyn Fn(&Input) -> f64| inputs.iter().map(f).sum::<f64>();
    // The columns of every known vehicle are orthogonal: one input for each, or a sum and a difference.
    let (speeds, turns) = (sum(&|i| i.speed * i.speed), sum(&|i| i.turn * i.turn));
    let (mut u, mut slope) = (vec![0.0; channels], vec![0.0; channels]);
    let row = |i: usize| {
        record.signals.at(record.time[i], &mut u, &mut slope);
        let along = |f: &dyn Fn(&Input) -> f64| inputs.iter().zip(&u).map(|(i, u)| f(i) * u).sum::<f64>();
        let share = |x: f64, of: f64| if of > 0.0 { x / of } else { 0.0 };
        [share(along(&|i| i.speed), speeds), share(along(&|i| i.turn), turns)]
    };
    record.rows.clone().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// What is to be logged at a speed and a turn moves the body so, on every vehicle whose turn is a yaw rate.
    #[test]
    fn the_inputs_of_a_speed_and_a_yaw_rate_give_both_back() {
        let (speed, turn) = (0.7, -0.4);
        let lengths = [("wheel_radius", 0.05), ("track_width", 0.4)];
        let omni = [&lengths[..], &[("wheelbase", 0.3)]].concat();
        for (id, parameters) in [("differential-drive", &lengths[..]), ("mecanum", &omni)] {
            let model = Model::new(id, parameters).unwrap();
            let mut given: BTreeMap<Symbol, f64> = model.values();
            for role in &model.inputs {
                let column = input(&model, role).unwrap();
                given.insert(Symbol::new(role), column.speed * speed + column.turn * turn);
            }
            let found = model.definitions().unwrap().evaluate(&|s| given.get(s).copied()).unwrap();
            let near = |name: &str, wanted: f64| (found[&Symbol::new(name)] - wanted).abs() < 1e-12;
            assert!(near("v_l", speed) && near("phi'", turn) && near("v_t", 0.0), "{id}: {found:?}");
        }
    }
}
