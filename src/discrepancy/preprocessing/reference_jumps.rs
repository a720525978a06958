//! Jumps of the reference: steps of the measured pose that the vehicle did not make, and that stay.

use crate::discrepancy::record::local_polynomial::median;
use crate::discrepancy::record::run_record::Record;
use crate::files::Run;

/// A step off by so many times the usual error of a step, and by so many usual steps, is a jump.
const OFF: f64 = 15.0;
const STEPS: f64 = 4.0;
/// The same of one between rows that are hardly off: no vehicle slides for one row alone, nor further than it drives.
const OFF_ALONE: f64 = 40.0;
const STEPS_ALONE: f64 = 1.5;
/// What the rows beside are off by, as a share of a jump, at most.
const BESIDE: f64 = 0.3;
/// The same where the reference has jumped already: some five deviations of a step, which noise makes in no run.
const OFF_AGAIN: f64 = 4.5;
const STEPS_AGAIN: f64 = 0.5;
/// What is off by this share of a jump after the next row has come back: a gross error, no jump.
const BACK: f64 = 0.5;
/// Jumps so near to one another belong to one stretch, s.
const NEAR: f64 = 10.0;
/// Fewest jumps of a stretch in which the reference is lost; others are left out one by one.
const LOST: usize = 3;
/// More jumps than this share of the rows are no jumps.
const MOST: f64 = 0.02;
/// Stretches that last longer together, as a share of the run, are no exceptions: they are not left out.
const MOST_LOST: f64 = 0.5;
/// Rows that tell a usual step.
const FEWEST: usize = 40;

/// A stretch in which the reference jumps.
#[derive(Clone, Debug, PartialEq)]
pub struct Jumps {
    /// Name of the run.
    pub run: String,
    /// How often it jumps.
    pub times: usize,
    /// Start and end, s.
    pub span: [f64; 2],
}

/// Where the reference of a run jumps: the measured step from row to row less the reckoned one is far beyond its usual size,
/// and stays so at the next row.
pub fn jumps(run: &Run, reckoned: &[Vec<f64>; 3]) -> Vec<Jumps> {
    if run.time.len() < FEWEST || run.input_time().len() < FEWEST {
        return vec![];
    }
    let step = run.time.windows(2).map(|w| w[1] - w[0]).collect::<Vec<_>>();
    let usual_step = median(&mut step.clone()).unwrap_or(0.0);
    let off = |from: usize, to: usize| off(run, reckoned, from, to);
    let each: Vec<f64> = (1..run.time.len()).map(|i| off(i - 1, i)).collect();
    let usual = median(&mut each.clone()).unwrap_or(0.0);
    let way = |i: usize| (run.x[i] - run.x[i - 1]).hypot(run.y[i] - run.y[i - 1]);
    let usual_way = median(&mut (1..run.time.len()).map(way).collect::<Vec<_>>()).unwrap_or(0.0);
    let is_jump = |i: usize, bar: f64| {
        let size = each[i - 1];
        let stays = || off(i - 1, i + 1) > BACK * size && off(i - 2, i) > BACK * size;
        size > bar && step[i - 1] < 3.0 * usual_step && stays()
    };
    let beyond = |off: f64, steps: f64| {
        let bar = (off * usual).max(steps * usual_way);
        // At either end nothing tells a jump from a gross error.
        let found: Vec<usize> = (2..run.time.len() - 1).filter(|i| bar > 0.0 && is_jump(*i, bar)).collect();
        if found.len() as f64 > MOST * run.time.len() as f64 { vec![] } else { found }
    };
    let is_alone = |i: &usize| each[i - 2].max(each[*i]) < BESIDE * each[i - 1];
    let large = beyond(OFF, STEPS);
    let alone = || beyond(OFF_ALONE, STEPS_ALONE).into_iter().filter(is_alone).collect::<Vec<usize>>();
    let large = if large.is_empty() { alone() } else { large };
    if large.is_empty() {
        return vec![];
    }
    // A reference that jumps makes smaller jumps, too.
    let all = beyond(OFF_AGAIN, STEPS_AGAIN);
    let found = stretches(run, if all.is_empty() { &large } else { &all });
    let lost: f64 = found.iter().map(|j| j.span[1] - j.span[0]).sum();
    let lasts = run.time[run.time.len() - 1] - run.time[0];
    if lost > MOST_LOST * lasts { vec![] } else { found }
}

/// How far the measured step lies from the reckoned one, m; without a heading by its length alone.
fn off(run: &Run, [x, y, heading]: &[Vec<f64>; 3], from: usize, to: usize) -> f64 {
    let measured = [run.x[to] - run.x[from], run.y[to] - run.y[from]];
    let reckoned = [x[to] - x[from], y[to] - y[from]];
    match &run.heading {
        Some(h) => {
            let (sin, cos) = (h[from] - heading[from]).sin_cos();
            let turned = [cos * reckoned[0] - sin * reckoned[1], sin * reckoned[0] + cos * reckoned[1]];
            (measured[0] - turned[0]).hypot(measured[1] - turned[1])
        }
        None => (measured[0].hypot(measured[1]) - reckoned[0].hypot(reckoned[1])).abs(),
    }
}

/// Jumps near one another as one stretch where they are many.
fn stretches(run: &Run, found: &[usize]) -> Vec<Jumps> {
    let near = |a: &usize, b: &usize| run.time[*b] - run.time[*a] < NEAR;
    let one = |rows: &[usize]| {
        let span = [run.time[rows[0] - 1], run.time[rows[rows.len() - 1]]];
        Jumps { run: run.name.clone(), times: rows.len(), span }
    };
    let of_group = |group: &[usize]| match group.len() >= LOST {
        true => vec![one(group)],
        false => group.iter().map(|i| one(&[*i])).collect(),
    };
    found.chunk_by(near).flat_map(of_group).collect()
}

/// A record without some stretches, such as those in which the reference jumps: it goes on in pieces, behind an interruption
/// each.
pub fn without(record: Record, spans: &[[f64; 2]]) -> Record {
    if spans.is_empty() {
        return record;
    }
    let half = 0.6 * record.gap();
    let is_out = |t: f64| spans.iter().any(|[from, to]| t > from - half && t < to + half);
    record.keeping(|i| !is_out(record.time[i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::unicycle_file;

    /// A straight drive at 1 m/s for 20 s, whose reference is off by a metre from some rows on, and in one row alone.
    fn run(jumps: &[usize], alone: Option<usize>) -> (Run, [Vec<f64>; 3]) {
        let mut log = String::from("time,x,y,heading,wheel_rate,yaw_rate\n");
        for i in 0..200 {
            let off = jumps.iter().filter(|j| i >= **j).count() as f64 + if alone == Some(i) { 1.0 } else { 0.0 };
            let t = 0.1 * i as f64;
            // A millimetre of noise.
            let noise = 1e-3 * f64::from((7 * i as u32 * i as u32) % 11) / 11.0;
            log += &format!("{t},{},{off},0,1,0\n", t + noise);
        }
        let run = Run::parse("run.csv", &log, &unicycle_file("")).unwrap();
        let reckoned = [run.time.clone(), vec![0.0; 200], vec![0.0; 200]];
        (run, reckoned)
    }

    #[test]
    fn a_step_that_stays_is_a_jump_and_a_gross_error_is_none() {
        let of = |at: &[usize], alone| {
            let (run, reckoned) = run(at, alone);
            jumps(&run, &reckoned)
        };
        let [one] = &of(&[80], None)[..] else { panic!("{:?}", of(&[80], None)) };
        assert!(one.times == 1 && (one.span[0] - 7.9).abs() < 1e-9 && (one.span[1] - 8.0).abs() < 1e-9, "{one:?}");
        assert_eq!([Some(80), Some(0), Some(199)].map(|row| of(&[], row)), [vec![], vec![], vec![]]);
        // A small step is a jump where there are larger ones.
        let small = |at: &[usize]| {
            let (mut run, reckoned) = run(at, None);
            (150..200).for_each(|i| run.y[i] += 0.1);
            jumps(&run, &reckoned).len()
        };
        assert_eq!([small(&[]), small(&[80])], [0, 2]);
        // Further than the vehicle drives in a row, and in one row alone: a slide lasts.
        let far = |rows: usize| {
            let (mut run, reckoned) = run(&[], None);
            (150..200).for_each(|i| run.y[i] += 0.17 * (i - 149).min(rows) as f64);
            jumps(&run, &reckoned).len()
        };
        assert_eq!([far(1), far(2), far(3)], [1, 0, 0]);
        // A reference that is lost through most of a run is no exception in it.
        assert_eq!(of(&[20, 100, 180], None), []);
    }
}
