//! The search for the one repair of the data that brings model and measurement together.

use super::dead_reckoning::DeadReckoning;
use super::repair_trial::{FAILS, REPAIRED, RIGHT, Trial, accepts};
use super::repairs::{Change, InputRepair, PoseRepair, Repair, Repaired, Unit};
use super::servo_line;
use super::signed_ratios::{Motion, SignedRatios, Windows};
use super::unit_errors::{SPARSE, Slip, SlipKind};
use crate::discrepancy::record::run_record::Record;
use crate::error::Result;
use crate::files::{ModelFile, Run};
use crate::model::Model;
use crate::vehicles::Moves;
use rayon::prelude::*;

/// Repairs that leave up to so many times as much as the best one, or so much more, are not told apart.
const ALIKE: [f64; 2] = [1.5, 0.004];
/// More far-fetched repairs beside a simple one are not listed.
const FAR_FETCHED: u32 = 2;
/// Repairs that are listed.
const LISTED: usize = 2;
/// Turning of its own that no unequal wheels make: a share of all, and rad/s.
const OF_ITS_OWN: [f64; 2] = [0.3, 0.1];

/// A repair with what it leaves.
struct Accepted {
    repair: Repair,
    cost: u32,
    unexplained: f64,
}

/// The slip of the first run that one repair explains.
///
/// | quantity | how |
/// |---|---|
/// | way, turn | over windows of a second, longer where noise asks for it: measured, and reckoned from the inputs |
/// | ratio | Σ reckoned·measured / Σ reckoned², with its sign |
/// | unexplained | Σ (measured − reckoned)² / (Σ measured² + Σ reckoned²), of way and of turn the larger |
///
/// # Errors
/// When the model's formulas are malformed.
pub fn slip(file: &ModelFile, model: &Model, runs: &[&Run]) -> Result<Option<Slip>> {
    let each: Vec<Option<Slip>> = runs.par_iter().map(|run| of_run(file, model, run)).collect::<Result<_>>()?;
    Ok(each.into_iter().flatten().next())
}

fn of_run(file: &ModelFile, model: &Model, run: &Run) -> Result<Option<Slip>> {
    if run.inputs.is_empty() || run.time.len() < 20 || run.input_time().len() < 20 {
        return Ok(None);
    }
    let Some(reckoning) = DeadReckoning::of(model, file.input_timing, run)? else { return Ok(None) };
    let record = Record::of_run(run, file.input_timing, model.trailer_count());
    if record.step() > SPARSE {
        return Ok(None);
    }
    let Some(windows) = Windows::of(&record) else { return Ok(None) };
    let measured = windows.motions([&run.x, &run.y], run.heading.as_deref());
    let trial = Trial { file, run, reckoning, windows, measured };
    let kind = trial.kind(model);
    Ok(kind.map(|kind| Slip { run: run.name.clone(), kind }))
}

impl Trial<'_> {
    fn kind(&self, model: &Model) -> Option<SlipKind> {
        let given = self.given();
        let ratios = self.windows.ratios(&given, &self.measured);
        if let Some(kind) = self.stands_for_another(model, &ratios) {
            return Some(kind);
        }
        if !fails(&ratios) {
            return None;
        }
        let mut found: Vec<Accepted> = self.input_repairs(model, &ratios);
        found.extend(self.pose_repairs(&given, &ratios));
        if found.is_empty() {
            found.extend(servo_line::repair(self, model, &ratios).map(|repair| Accepted {
                repair,
                cost: 20,
                unexplained: 0.0,
            }));
        }
        let repairs = alike(found);
        let columns = &self.file.columns;
        let heading = columns.heading.clone().unwrap_or_else(|| "heading".into());
        let pose = [columns.x.clone(), columns.y.clone(), heading];
        (!repairs.is_empty()).then_some(SlipKind::Repair(Repaired { ratios, pose, repairs }))
    }

    /// The motions of the model as it is.
    fn given(&self) -> Vec<Motion> {
        self.reckoned(&self.run.inputs)
    }

    fn input_repairs(&self, model: &Model, before: &SignedRatios) -> Vec<Accepted> {
        let candidates = self.candidates(model);
        let tried = candidates.into_par_iter().filter_map(|(repairs, cost)| {
            let (repairs, after) = self.scaled(model, repairs)?;
            let is_scale = repairs.iter().all(|r| matches!(r.change, Change::Scale(_, unit) if unit != Unit::Sign));
            let accepted = accepts(before, &after, is_scale);
            accepted.then(|| Accepted { repair: Repair::Inputs(repairs), cost, unexplained: after.unexplained() })
        });
        tried.collect()
    }

    /// Differences of what has any scale, such as counts, with the scale that fits.
    fn scaled(&self, model: &Model, repairs: Vec<InputRepair>) -> Option<(Vec<InputRepair>, SignedRatios)> {
        let after = self.with(&repairs);
        let is_count = |r: &InputRepair| matches!(r.change, Change::Difference(_)) && is_wheel(model, &r.role);
        let factor = after.way.or(after.turn)?.slope;
        if !repairs.iter().all(is_count)
            || (RIGHT[0]..RIGHT[1]).contains(&factor)
            || !factor.is_finite()
            || factor == 0.0
        {
            return Some((repairs, after));
        }
        let by = |r: InputRepair| InputRepair { change: Change::Difference(factor), ..r };
        let repairs: Vec<InputRepair> = repairs.into_iter().map(by).collect();
        let after = self.with(&repairs);
        Some((repairs, after))
    }

    /// Every repair of the inputs, and how far-fetched it is.
    fn candidates(&self, model: &Model) -> Vec<(Vec<InputRepair>, u32)> {
        let mut found = self.signs_and_places();
        let radius = self.file.parameters.get("wheel_radius").copied();
        let unit = |role: &str| model.vehicle.inputs.get(role).map_or("m/s", |input| input.unit.as_str());
        let usual = |role: &str| Change::of_either_sign(is_wheel(model, role), unit(role), radius);
        for role in &self.run.roles {
            for (change, cost) in usual(role) {
                found.push((vec![self.repair(role, role, change)], cost));
            }
        }
        // Columns of one kind are mistaken together.
        for (i, first) in self.run.roles.iter().enumerate() {
            let kin: Vec<&String> = self.run.roles.iter().filter(|r| usual(r) == usual(first)).collect();
            if kin.len() > 1 && self.run.roles.iter().position(|r| r == kin[0]) == Some(i) {
                for (change, cost) in usual(first) {
                    found.push((kin.iter().map(|r| self.repair(r, r, change)).collect(), cost));
                }
            }
        }
        found
    }

    /// Every way to reverse signs and to exchange two columns.
    fn signs_and_places(&self) -> Vec<(Vec<InputRepair>, u32)> {
        let roles = &self.run.roles;
        let n = roles.len().min(4);
        let mut places: Vec<Vec<usize>> = vec![(0..n).collect()];
        for (i, j) in (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j))) {
            let mut exchanged: Vec<usize> = (0..n).collect();
            exchanged.swap(i, j);
            places.push(exchanged);
        }
        let mut found = vec![];
        for place in places {
            for signs in 0..1_u32 << n {
                let sign = |i: usize| if signs >> i & 1 == 1 { -1.0 } else { 1.0 };
                let changed = (0..n).filter(|i| place[*i] != *i || sign(*i) < 0.0);
                let one = |i: usize| self.repair(&roles[i], &roles[place[i]], Change::Scale(sign(i), Unit::Sign));
                let repairs: Vec<InputRepair> = changed.map(one).collect();
                let is_moved = place.iter().enumerate().any(|(i, p)| i != *p);
                let cost = 9 + u32::from(is_moved) + signs.count_ones() * if is_moved { 2 } else { 1 };
                if !repairs.is_empty() {
                    found.push((repairs, cost));
                }
            }
        }
        found
    }

    fn pose_repairs(&self, given: &[Motion], before: &SignedRatios) -> Vec<Accepted> {
        let run = self.run;
        // What is so by definition is not mended.
        let measured = run.heading.as_deref().filter(|_| !run.defined.heading);
        let tried = PoseRepair::all(measured.is_some()).into_par_iter().filter_map(|(repair, cost)| {
            let ([x, y], heading) = repair.applied([&run.x, &run.y], run.heading.as_deref());
            let windows = self.windows.in_unit(repair.metres());
            let after = windows.ratios(given, &windows.motions([&x, &y], heading.as_deref()));
            let is_scale = matches!(repair, PoseRepair::PositionUnit(..) | PoseRepair::HeadingInDegrees);
            let accepted = accepts(before, &after, is_scale);
            accepted.then(|| Accepted { repair: Repair::Pose(repair), cost, unexplained: after.unexplained() })
        });
        tried.collect()
    }

    /// One input in the place of another, or one that stands while the vehicle turns.
    fn stands_for_another(&self, model: &Model, ratios: &SignedRatios) -> Option<SlipKind> {
        let [share, rate] = self.windows.turning_of_its_own(&self.measured);
        if share < OF_ITS_OWN[0] || rate < OF_ITS_OWN[1] || ratios.turn?.unexplained < REPAIRED {
            return None;
        }
        let (roles, inputs) = (&self.run.roles, &self.run.inputs);
        let varies = |i: &usize| inputs[*i].iter().any(|u| *u != inputs[*i][0]);
        let unit = |i: usize| model.vehicle.inputs.get(&roles[i]).map(|input| &input.unit);
        let pairs = (0..roles.len()).flat_map(|i| (i + 1..roles.len()).map(move |j| (i, j)));
        let mut same = pairs.filter(|(i, j)| varies(i) && inputs[*i] == inputs[*j] && unit(*i) == unit(*j));
        let way = ratios.way.map(|r| r.slope);
        if let Some((i, j)) = same.next() {
            return Some(SlipKind::LoggedTwice { roles: [roles[i].clone(), roles[j].clone()], way });
        }
        let stands = (0..roles.len()).find(|i| !varies(i) && roles.len() > 1 && is_turning(model, &roles[*i]));
        stands.map(|i| SlipKind::Stands { role: roles[i].clone(), value: inputs[i][0] })
    }
}

/// Whether an input is the rate of a wheel.
fn is_wheel(model: &Model, role: &str) -> bool {
    model.vehicle.moved_by(role).is_some_and(Moves::is_wheel)
}

/// Whether an input says how the vehicle turns.
fn is_turning(model: &Model, role: &str) -> bool {
    model.vehicle.moved_by(role).is_some_and(Moves::is_turning)
}

fn fails(ratios: &SignedRatios) -> bool {
    ratios.each().any(|r| r.unexplained > FAILS)
}

/// The simplest of the repairs that leave least, and others like it.
fn alike(mut found: Vec<Accepted>) -> Vec<Repair> {
    let best = found.iter().map(|a| a.unexplained).fold(f64::INFINITY, f64::min);
    found.retain(|a| a.unexplained < (ALIKE[0] * best).max(best + ALIKE[1]));
    found.sort_by_key(|a| a.cost);
    let simplest = found.first().map_or(0, |a| a.cost);
    found.into_iter().filter(|a| a.cost <= simplest + FAR_FETCHED).take(LISTED).map(|a| a.repair).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::{self, Applied};
    use crate::motion::{StateSensitivity, Stepper, Timing};
    use crate::vehicles;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// A run of a vehicle that drives in all directions, with an ordinary effect or none, and noise.
    fn generated(vehicle: &str, seed: u64, has_heading: bool) -> Option<(ModelFile, Model, Run)> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let known = vehicles::named(vehicle)?;
        let value = |name: &str| if name.contains("radius") { 0.1 } else { 0.4 };
        let parameters: Vec<(&str, f64)> = known.parameters.keys().map(|name| (name.as_str(), value(name))).collect();
        let list: Vec<String> = parameters.iter().map(|(name, value)| format!("{name} = {value}")).collect();
        let text = format!("vehicle = \"{vehicle}\"\n[parameters]\n{}\n", list.join("\n"));
        let file = ModelFile::parse(&text, "model.toml", &crate::model::known(effects::all())).ok()?;
        let roles: Vec<String> = known.inputs.keys().filter(|r| *r != "speed").cloned().collect();
        let model = Model::from_file(&file, effects::all(), &roles).ok()?;
        let time: Vec<f64> = (0..500).map(|i| 0.08 * f64::from(i)).collect();
        let phase = random.random_range(0.0..6.0);
        let turns = random.random_range(0.4..1.0);
        let speed = |t: f64| 8.0 + 3.0 * (0.3 * t + phase).sin();
        let column = |(k, role): (usize, &String)| -> Vec<f64> {
            let unit = known.inputs[role].unit.as_str();
            let of = |t: f64| match (role.as_str(), unit) {
                ("yaw_rate", _) => turns * (0.5 * t + phase).sin(),
                (_, "rad") => 0.4 * (0.5 * t + phase).sin(),
                (name, _) if name.contains("left") => speed(t) - 2.0 * turns * (0.5 * t + phase).sin(),
                (name, _) if name.contains("right") => speed(t) + 2.0 * turns * (0.5 * t + phase).sin(),
                _ => speed(t) + 0.1 * k as f64,
            };
            time.iter().map(|t| of(*t)).collect()
        };
        let inputs: Vec<Vec<f64>> = roles.iter().enumerate().map(column).collect();
        let applicable = model.applicable(effects::all());
        let chosen = random.random_range(0..2 * applicable.len().max(1));
        let truth = match applicable.get(chosen) {
            Some((effect, trailer)) => {
                let sign = if random.random_range(0..2) == 0 { 1.0 } else { -1.0 };
                let signed = |p: &crate::effects::Parameter| if p.positive { p.size } else { sign * p.size };
                let values = effect.parameters.values().map(signed).collect();
                model.clone().with_effect(Applied::new(effect, *trailer, values))
            }
            None => model.clone(),
        };
        let equations = truth.equations(&[]).ok()?;
        let record = Record::new("run", time.clone(), vec![vec![]; 2], false, &inputs, Timing::Sample);
        let mut stepper = Stepper::new(&equations, &record.signals, &[]);
        let mut arc = StateSensitivity { z: vec![0.3; equations.n()], s: vec![] };
        let noise = 10.0_f64.powf(random.random_range(-4.0..-2.0));
        let mut pose = [const { Vec::new() }; 3];
        for i in 0..time.len() {
            let y = stepper.outputs(&arc.z).to_vec();
            (0..3).for_each(|c| pose[c].push(y[c] + noise * random.random_range(-1.0..1.0)));
            if i + 1 < time.len() {
                stepper.advance(&mut arc, time[i], time[i + 1]);
            }
        }
        if pose.iter().flatten().any(|v| !v.is_finite()) {
            return None;
        }
        let [x, y, heading] = pose;
        let run = Run {
            deviations: Default::default(),
            differences: vec![None; inputs.len()],
            name: "run.csv".into(),
            path: "run.csv".into(),
            sha256: String::new(),
            time,
            x,
            y,
            heading: has_heading.then_some(heading),
            defined: crate::files::Defined::default(),
            trailer_headings: vec![],
            roles,
            inputs,
            rows_dropped: 0,
            why_dropped: std::collections::BTreeMap::new(),
            warnings: vec![],
            apart: None,
        };
        Some((file, model, run))
    }

    /// No ordinary effect, and no noise, is taken for a slip, whatever the vehicle.
    #[test]
    fn a_run_as_it_should_be_is_never_repaired() {
        let all: Vec<&str> = vehicles::all().iter().map(|v| v.id.as_str()).collect();
        let each = 0..500_u64;
        let tried = each.into_par_iter().filter_map(|seed| {
            let (file, model, run) = generated(all[seed as usize % all.len()], seed, seed % 3 > 0)?;
            Some((seed, file.vehicle.clone(), slip(&file, &model, &[&run]).unwrap()))
        });
        let tried: Vec<_> = tried.collect();
        let wrong: Vec<_> = tried.iter().filter(|t| t.2.is_some()).collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
        assert!(tried.len() > 250, "{}", tried.len());
    }

    /// What a slip of one kind makes of a run.
    type Slipped = fn(&mut Run);

    /// The repairs of what was slipped name it, on every vehicle that has such a column.
    #[test]
    fn each_slip_is_told() {
        let role = |run: &Run, name: &str| run.roles.iter().position(|r| r.starts_with(name));
        let cases: [(&str, Slipped, &str); 9] = [
            ("unicycle", |run| run.inputs[0].iter_mut().for_each(|u| *u *= -1.0), "wheel_rate has the wrong sign"),
            ("unicycle", |run| run.inputs[1].iter_mut().for_each(|u| *u *= -1.0), "yaw_rate has the wrong sign"),
            ("unicycle", |run| run.y.iter_mut().for_each(|u| *u *= -1.0), "y has the wrong sign"),
            ("unicycle", |run| std::mem::swap(&mut run.x, &mut run.y), "x and y are swapped"),
            ("differential-drive", |run| run.inputs.swap(0, 1), "left and right are swapped"),
            (
                "differential-drive",
                |run| run.inputs.iter_mut().flatten().for_each(|u| *u *= -1.0),
                "both wheel_rate_left",
            ),
            (
                "differential-drive",
                |run| run.inputs[0].iter_mut().for_each(|u| *u *= -1.0),
                "wheel_rate_left has the wrong",
            ),
            ("differential-drive", |run| run.inputs.iter_mut().flatten().for_each(|u| *u *= 0.25), "counts per turn"),
            ("car", |run| run.inputs.iter_mut().flatten().for_each(|u| *u *= -1.0), "180°"),
        ];
        for (vehicle, slipped, word) in cases {
            for seed in 0..4 {
                let (file, model, mut run) = generated(vehicle, 1000 + 7 * seed, true).unwrap();
                assert!(role(&run, "").is_some());
                slipped(&mut run);
                let found = slip(&file, &model, &[&run]).unwrap();
                let said = found.as_ref().map(crate::discrepancy::rendering::slip_text::sentence).unwrap_or_default();
                assert!(said.contains(word) && said.contains("Paste into"), "{vehicle} {word}: {said:?}");
            }
        }
    }
}
