//! Effects that runs would not tell apart.

use super::check_report::Pair;
use super::detection_power::{Candidate, POWER, Table};
use super::expected_gain::Background;
use super::fisher_information::Driven;
use crate::discrepancy::selection::select::CLOSE;
use crate::effects::Applied;
use crate::equivalence::{Measured, relation};
use crate::error::Result;
use crate::model::Model;
use rayon::prelude::*;

/// Beyond so many times what is needed, jumps do not imitate the difference.
const FAR: f64 = 20.0;

/// The misfit that tells two effects apart with 95 %: then `discover` lists no rival.
pub(crate) fn separating() -> f64 {
    (CLOSE.sqrt() + POWER).powi(2)
}

/// By how much one effect of plausible size falls short of explaining the other, the smaller of both ways.
pub(crate) fn misfit(table: &Table, all: &[Candidate], a: usize, b: usize) -> Option<f64> {
    let (group, at) = table.with(&[a, b])?;
    let information = &group.information[0];
    let ways = [(a, at[0], at[1]), (b, at[1], at[0])];
    let short = ways.iter().flat_map(|(truth, own, other)| {
        all[*truth].sizes.iter().map(move |s| information.misfit_beside(*own, s, *other))
    });
    Some(short.fold(f64::INFINITY, f64::min))
}

/// As [`misfit`], unexplained motion being the other explanation.
pub(crate) fn told_apart(
    model: &Model,
    driven: &Driven,
    all: &[Candidate],
    a: usize,
    b: usize,
    ground: &Background,
) -> Result<f64> {
    let Some(marks) = driven.marks(model, &[&all[a].applied, &all[b].applied])? else { return Ok(0.0) };
    let gain = |truth: usize, sizes: &[Vec<f64>]| {
        sizes.iter().map(|s| marks.gain(truth, s, Some(1 - truth), ground)).fold(f64::INFINITY, f64::min)
    };
    Ok(gain(0, &all[a].sizes).min(gain(1, &all[b].sizes)))
}

/// Two candidates by their places, and how they are listed.
pub(crate) struct Unseparated {
    pub candidates: [usize; 2],
    pub pair: Pair,
}

/// Pairs among some candidates that would not be told apart, the closest first.
pub(crate) fn unseparated(
    model: &Model,
    table: &Table,
    all: &[Candidate],
    seen: &[usize],
    measured: Measured,
    told: &(impl Fn(usize, usize) -> Result<f64> + Sync),
) -> Result<Vec<Unseparated>> {
    let two = seen.iter().enumerate().flat_map(|(k, a)| seen[k + 1..].iter().map(move |b| [*a, *b]));
    let two = two.filter(|[a, b]| !all[*a].applied.same_as(&all[*b].applied));
    let near = two.filter_map(|c| misfit(table, all, c[0], c[1]).filter(|m| *m < FAR * separating()).map(|m| (c, m)));
    let near: Vec<([usize; 2], f64)> = near.collect();
    // What noise alone tells apart, jumps may still imitate.
    let closer = |(c, m): &([usize; 2], f64)| -> Result<([usize; 2], f64)> {
        Ok((*c, if *m < separating() { *m } else { told(c[0], c[1])? }))
    };
    let near: Vec<([usize; 2], f64)> = near.par_iter().map(closer).collect::<Result<_>>()?;
    let close: Vec<([usize; 2], f64)> = near.into_iter().filter(|(_, m)| *m < separating()).collect();
    let bare = Model { effects: vec![], ..model.clone() };
    let listed = |([a, b], misfit): &([usize; 2], f64)| {
        let (a_, b_) = (&all[*a].applied, &all[*b].applied);
        let of = |x: &Applied| [x.clone().freed()];
        let why = relation(&bare, &of(a_), &of(b_), measured);
        let why = why.word().or_else(|| relation(&bare, &of(b_), &of(a_), measured).word()).unwrap_or("data");
        // What is proved to be the same leaves nothing but rounding.
        let misfit = if why == "identical" { 0.0 } else { *misfit };
        let pair = Pair { effects: [a_.label(), b_.label()], why: why.into(), misfit };
        Unseparated { candidates: [*a, *b], pair }
    };
    let mut found: Vec<Unseparated> = close.par_iter().map(listed).collect();
    // An effect that was looked at from several places is listed once.
    let mut names: Vec<[String; 2]> = vec![];
    found.retain(|u| {
        let new = !names.contains(&u.pair.effects);
        names.push(u.pair.effects.clone());
        new
    });
    Ok(found)
}
