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
/// Repairs that are listed; without a heading one more comes to the same.
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
    let record = Record::of_run(run, file.input_timing, model.freedom());
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
        let repairs = alike(found, LISTED + usize::from(self.run.heading.is_none()));
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

    /// Counts, cumulative or since the row before, which have any scale, with the scale that fits.
    fn scaled(&self, model: &Model, repairs: Vec<InputRepair>) -> Option<(Vec<InputRepair>, SignedRatios)> {
        let after = self.with(&repairs);
        let is_count = |r: &InputRepair| {
            let counts = match r.change {
                Change::Difference(_) => true,
                // In even rows these are any scale of a rate, unless they count.
                Change::PerRow(..) => self.counts(&r.source),
                _ => false,
            };
            counts && is_wheel(model, &r.role)
        };
        let is_wrong = |slope: &f64| !(RIGHT[0]..RIGHT[1]).contains(slope) && slope.is_finite() && *slope != 0.0;
        // A turn is in proportion to its rates; ways wind up where it is far too large.
        let factor = [after.turn, after.way].into_iter().flatten().map(|r| r.slope).find(is_wrong);
        let Some(factor) = factor.filter(|_| repairs.iter().all(is_count)) else { return Some((repairs, after)) };
        let by = |r: InputRepair| {
            let change = match r.change {
                Change::PerRow(sign, rate) => Change::PerRow(sign * factor, rate),
                Change::Difference(sign) => Change::Difference(sign * factor),
                other => other,
            };
            InputRepair { change, ..r }
        };
        let repairs: Vec<InputRepair> = repairs.into_iter().map(by).collect();
        let after = self.with(&repairs);
        Some((repairs, after))
    }

    /// Whether a column holds whole numbers, and several of them.
    fn counts(&self, role: &str) -> bool {
        let column = self.run.roles.iter().position(|r| r == role).map_or(&[][..], |i| &self.run.inputs[i]);
        let sizes = column.iter().map(|u| u.abs());
        column.iter().all(|u| u.fract() == 0.0) && sizes.fold(0.0, f64::max) > 3.0
    }

    /// Every repair of the inputs, and how far-fetched it is.
    fn candidates(&self, model: &Model) -> Vec<(Vec<InputRepair>, u32)> {
        let mut found = self.signs_and_places();
        let radius = self.file.parameters.get("wheel_radius").copied();
        let time = self.run.input_time();
        let rate = (time.len() - 1) as f64 / (time[time.len() - 1] - time[0]);
        let usual =
            |role: &str| Change::of_either_sign(is_wheel(model, role), model.vehicle.unit_of(role), radius, rate);
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
fn alike(mut found: Vec<Accepted>, most: usize) -> Vec<Repair> {
    let best = found.iter().map(|a| a.unexplained).fold(f64::INFINITY, f64::min);
    found.retain(|a| a.unexplained < (ALIKE[0] * best).max(best + ALIKE[1]));
    found.sort_by_key(|a| a.cost);
    let simplest = found.first().map_or(0, |a| a.cost);
    found.retain(|a| a.cost <= simplest + FAR_FETCHED);
    let mut kept: Vec<Repair> = vec![];
    for Accepted { repair, .. } in found {
        if kept.len() < most && !kept.iter().any(|simpler| goes_beyond(&repair, simpler)) {
            kept.push(repair);
        }
    }
    kept
}

/// Whether a repair does all that another does, and something that the data do not show.
fn goes_beyond(repair: &Repair, simpler: &Repair) -> bool {
    match (repair, simpler) {
        (Repair::Inputs(all), Repair::Inputs(some)) => some.iter().all(|one| all.contains(one)),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::preprocessing::generated_run::{generated, turning};
    use crate::effects::Applied;
    use crate::vehicles;

    /// No ordinary effect, and no noise, is taken for a slip, whatever the vehicle.
    #[test]
    fn a_run_as_it_should_be_is_never_repaired() {
        let all: Vec<&str> = vehicles::all().iter().map(|v| v.id.as_str()).collect();
        let each = (0..500_u64).flat_map(|seed| [(seed, true), (seed, false)]).collect::<Vec<_>>();
        let tried = each.into_par_iter().filter_map(|(seed, has_heading)| {
            let much = [1.0, 0.4][(seed / 7 % 2) as usize];
            let (file, model, run) = turning(all[seed as usize % all.len()], seed, has_heading, much)?;
            Some((seed, file.vehicle.clone(), slip(&file, &model, &[&run]).unwrap()))
        });
        let tried: Vec<_> = tried.collect();
        let wrong: Vec<_> = tried.iter().filter(|t| t.2.is_some()).collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
        assert!(tried.len() > 500, "{}", tried.len());
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

    fn reverse(run: &mut Run, role: &str) {
        let at = run.roles.iter().position(|r| r == role).unwrap();
        run.inputs[at].iter_mut().for_each(|u| *u *= -1.0);
    }

    /// What adds up an input, and what is added in a row.
    #[test]
    fn integrals_and_differences_are_told() {
        fn summed(column: &mut [f64], factor: f64) {
            let mut total = 0.0;
            column.iter_mut().for_each(|u| {
                total += 0.08 * *u;
                *u = factor * total;
            });
        }
        let counts = |factor: f64| move |u: &mut f64| *u = (factor * *u).round();
        let all = |run: &mut Run, of: &dyn Fn(&mut f64)| run.inputs.iter_mut().flatten().for_each(of);
        type Case<'c> = (&'c str, &'c dyn Fn(&mut Run), [&'c str; 2]);
        let cases: [Case; 6] = [
            (
                "unicycle",
                &|run| summed(&mut run.inputs[1], 1.0),
                ["yaw_rate is an angle", "yaw_rate = { angle = \"yaw_rate\" }"],
            ),
            ("unicycle", &|run| summed(&mut run.inputs[1], -1.0), ["yaw_rate is an angle", "scale = -1.0 }"]),
            (
                "differential-drive",
                &|run| run.inputs.iter_mut().for_each(|c| summed(c, 1.0)),
                ["are an angle", "wheel_rate_left = { angle = \"wheel_rate_left\" }"],
            ),
            (
                "differential-drive",
                &|run| run.inputs.iter_mut().for_each(|c| summed(c, 4096.0 / std::f64::consts::TAU)),
                ["are cumulative counts", "wheel_rate_left = { ticks = \"wheel_rate_left\""],
            ),
            (
                "differential-drive",
                &|run| all(run, &|u| *u *= 0.08),
                ["since the row before, not a rate", "column = \"wheel_rate_left\", scale = 12.5 }"],
            ),
            (
                "differential-drive",
                &|run| all(run, &counts(0.08 * 500.0)),
                ["are counts since the row before", "column = \"wheel_rate_left\", scale = 0.02"],
            ),
        ];
        for (vehicle, slipped, words) in cases {
            for seed in 0..4 {
                let (file, model, mut run) = generated(vehicle, 1000 + 7 * seed, true).unwrap();
                slipped(&mut run);
                let found = slip(&file, &model, &[&run]).unwrap();
                let said = found.as_ref().map(crate::discrepancy::rendering::slip_text::sentence).unwrap_or_default();
                assert!(words.iter().all(|w| said.contains(w)), "{vehicle} {seed} {words:?}: {said:?}");
            }
        }
    }

    /// A model whose effects have states of their own is looked at without them.
    #[test]
    fn a_slip_is_told_beside_an_effect_with_states() {
        let (file, model, mut run) = generated("unicycle", 1000, true).unwrap();
        reverse(&mut run, "yaw_rate");
        let creep = Applied::new(crate::effects::named("traction-creep").unwrap(), None, vec![0.1]);
        let found = slip(&file, &model.with_effect(creep), &[&run]).unwrap();
        let said = found.as_ref().map(crate::discrepancy::rendering::slip_text::sentence).unwrap_or_default();
        assert!(said.contains("yaw_rate has the wrong sign"), "{said}");
    }

    /// Without a heading a speed has no sign: a yaw rate of the wrong sign is told alone.
    #[test]
    fn what_the_data_do_not_show_is_not_told() {
        let (file, model, mut run) = turning("unicycle", 1000, false, 0.4).unwrap();
        reverse(&mut run, "yaw_rate");
        let Some(Slip { kind: SlipKind::Repair(found), .. }) = slip(&file, &model, &[&run]).unwrap() else { panic!() };
        let inputs = |r: &Repair| if let Repair::Inputs(all) = r { all.len() } else { 0 };
        assert_eq!(found.repairs.iter().map(inputs).collect::<Vec<_>>(), [1, 0], "{:?}", found.repairs);
    }

    /// Without a heading the path turns to the other side.
    #[test]
    fn a_slip_of_sides_is_told_without_a_heading() {
        let cases: [(&str, Slipped, &str); 4] = [
            ("unicycle", |run| run.inputs[1].iter_mut().for_each(|u| *u *= -1.0), "yaw_rate has the wrong sign"),
            ("unicycle", |run| run.y.iter_mut().for_each(|u| *u *= -1.0), "y has the wrong sign"),
            ("differential-drive", |run| run.inputs.swap(0, 1), "left and right are swapped"),
            ("car", |run| reverse(run, "steering_angle"), "steering_angle has the wrong sign"),
        ];
        for (vehicle, slipped, word) in cases {
            for seed in 0..8 {
                // Gentle turns, as those of most robots.
                let (file, model, mut run) = turning(vehicle, 1000 + 7 * seed, false, 0.4).unwrap();
                slipped(&mut run);
                let found = slip(&file, &model, &[&run]).unwrap();
                let said = found.as_ref().map(crate::discrepancy::rendering::slip_text::sentence).unwrap_or_default();
                assert!(said.contains(word) && said.contains("Paste into"), "{vehicle} {word} {seed}: {said:?}");
            }
        }
    }
}
