//! The tables under the pictures.

use super::head::{parameter, shrinkage};
use super::part::{Cell, holding, table};
use crate::discrepancy::rendering::kinematic_text;
use crate::discrepancy::rendering::summary::{seconds, why};
use crate::discrepancy::rendering::title_text;
use crate::discrepancy::report;
use crate::discrepancy::report::{BeforeAfter, Gap, Pictures, Report};
use crate::number_format::{decimals, plain, prefixed, probability, significant, with_error};
use crate::picture::svg::Element;
use crate::wording::counted;

/// The tables of what was found, and of what was not named.
pub fn effects(report: &Report, pictures: &Pictures) -> Vec<Element> {
    let tables = [named(report), unnamed(report), refuted(report), steps(report), equations(pictures)];
    tables.into_iter().flatten().collect()
}

/// The violated constraints: the figure of them over time, then where and how far they are.
pub fn residuals(report: &Report, figure: Option<Element>) -> Vec<Element> {
    [figure, disagreement(report), remaining(report), sensors(report)].into_iter().flatten().collect()
}

fn named(report: &Report) -> Option<Element> {
    let row = |e: &report::Named| {
        let shown = |(name, p): (&String, &report::Estimate)| parameter(name, p).replace(' ', "\u{a0}");
        let rivals = e.indistinguishable_from.iter().map(|r| format!("{}: {}", r.id, why(r))).collect();
        vec![
            Cell::Lines(vec![title_text::title(e), e.place.clone()]),
            Cell::Lines(e.parameters.iter().map(shown).collect()),
            Cell::Number(significant(e.evidence.delta_bic, 3)),
            Cell::Number(probability(e.evidence.p_value)),
            Cell::Code(e.equation.clone()),
            Cell::Lines(rivals),
        ]
    };
    let headings = ["effect and place", "parameter ± std", "#ΔBIC", "#p", "equation", "not told from, and why"];
    table("Effects named, in the order they were added", &headings, report.effects.iter().map(row).collect())
}

fn unnamed(report: &Report) -> Option<Element> {
    let row = |u: &report::Unnamed| {
        let share = significant(100.0 * u.held_out_reduction, 2);
        vec![Cell::text(&u.place), Cell::Code(u.equation.clone()), Cell::Number(format!("{share} %"))]
    };
    let headings = ["place", "equation", "#of the held-out disagreement it removes"];
    table("Repeatable disagreement without a name", &headings, report.unnamed.iter().map(row).collect())
}

fn refuted(report: &Report) -> Option<Element> {
    let row = |r: &report::Refuted| {
        let shown = |(name, p): (&String, &report::Estimate)| parameter(name, p).replace(' ', "\u{a0}");
        vec![Cell::text(&r.id), Cell::Lines(r.parameters.iter().map(shown).collect()), Cell::text(&r.says)]
    };
    let headings = ["effect", "parameter ± std", "why it is not named"];
    table("Asked for by the fit and not named", &headings, report.refuted.iter().map(row).collect())
}

fn steps(report: &Report) -> Option<Element> {
    let (factor, unit) = prefixed(report.steps.iter().map(|s| s.gap_after).fold(0.0, f64::max), "m");
    let row = |s: &report::Step| {
        vec![Cell::text(&s.added), Cell::Number(format!("{} {unit}", significant(s.gap_after * factor, 3)))]
    };
    let headings = ["added", "#position gap of the fitted data after it, middle horizon"];
    table("Steps of the selection", &headings, report.steps.iter().map(row).collect())
}

fn equations(pictures: &Pictures) -> Option<Element> {
    let row = |(name, equation): &(String, String)| vec![Cell::text(name), Cell::Code(equation.clone())];
    table("Constraints of the patched model", &["constraint", "equation"], pictures.equations.iter().map(row).collect())
}

/// The gap at every horizon of the request.
pub fn gaps(report: &Report) -> Vec<Element> {
    let position = |v: &BeforeAfter| [Some(v.position_rms_before), Some(v.position_rms_after)];
    let heading = |v: &BeforeAfter| [v.heading_rms_before, v.heading_rms_after];
    let position = gap_table(report, "Position, RMS", "m", position, |g| Some(g.noise_floor.position_rms));
    let heading = gap_table(report, "Heading, RMS", "rad", heading, |g| g.noise_floor.heading_rms);
    position.into_iter().chain(heading).collect()
}

fn gap_table(
    report: &Report,
    name: &str,
    base: &str,
    values: impl Fn(&BeforeAfter) -> [Option<f64>; 2],
    floor: impl Fn(&Gap) -> Option<f64>,
) -> Option<Element> {
    let of = |data: &Option<BeforeAfter>| data.as_ref().map_or([None; 2], &values);
    let every = || report.gap.iter().flat_map(|g| of(&g.held_out).into_iter().chain(of(&g.fit)).flatten());
    every().next()?;
    let (factor, unit) = prefixed(every().fold(0.0, f64::max), base);
    let cell = |v: Option<f64>| Cell::Number(v.map_or("–".into(), |v| significant(v * factor, 3)));
    let row = |g: &Gap| {
        let ([before, after], [fit_before, fit_after]) = (of(&g.held_out), of(&g.fit));
        let times = before.zip(after).and_then(|(b, a)| shrinkage(b, a)).unwrap_or_else(|| "–".into());
        let horizon = Cell::Number(format!("{} s", plain(g.horizon_s)));
        vec![horizon, cell(before), cell(after), Cell::Number(times), cell(fit_before), cell(fit_after), cell(floor(g))]
    };
    let headings = [
        "#horizon",
        "#held out, before",
        "#held out, after",
        "#held out, change",
        "#fitted, before",
        "#fitted, after",
        "#noise floor",
    ];
    table(&format!("{name}, {unit}"), &headings, report.gap.iter().map(row).collect())
}

fn disagreement(report: &Report) -> Option<Element> {
    let row = |d: &report::Disagreement| {
        let time = format!("{}–{}", decimals(d.from, 1), decimals(d.to, 1));
        let share = format!("{} %", significant(100.0 * d.share_of_gap, 2));
        vec![Cell::text(&d.run), Cell::text(&d.place), Cell::Number(time), Cell::text(&d.regime), Cell::Number(share)]
    };
    let headings = ["run", "constraint", "#time, s", "what the vehicle did", "#share of the disagreement"];
    table("Before anything is added", &headings, report.disagreement.iter().map(row).collect())
}

/// What the last model leaves of what is measured beside the pose.
fn sensors(report: &Report) -> Option<Element> {
    let row = |s: &report::RemainingSensor| {
        let number = |x: f64| Cell::Number(format!("{} {}", significant(x, 3), s.unit).trim_end().into());
        vec![Cell::text(&s.name), number(s.rms), number(s.noise)]
    };
    let headings = ["measured beside the pose", "#residual, RMS", "#its rows scatter by"];
    let all = &report.remaining.as_ref()?.sensors;
    table("After all that is added", &headings, all.iter().map(row).collect())
}

fn remaining(report: &Report) -> Option<Element> {
    let left = report.remaining.as_ref()?;
    let row = |c: &report::RemainingConstraint| {
        let (factor, unit) = prefixed(c.rms.max(c.noise), &c.unit);
        let number = |x: f64| Cell::Number(format!("{} {unit}", significant(x * factor, 3)));
        vec![Cell::text(&c.place), number(c.rms), number(c.noise), Cell::Number(probability(c.p_value))]
    };
    let white = |n: f64| if n > 1.0 { format!("alike over {}", significant(n, 2)) } else { "white".into() };
    let caption = format!(
        "After all that is added; noise {} from row to row, the rest {} from window to window",
        white(left.rows_alike),
        white(left.windows_alike)
    );
    let headings = ["constraint", "#violated rate, RMS", "#noise alone gives", "#p of the rest by chance"];
    table(&caption, &headings, left.constraints.iter().map(row).collect())
}

/// The kinematic model beside the one with forces: how far each predicts, and its coefficients beside those of the forces.
pub fn kinematic(report: &Report) -> Vec<Element> {
    let Some(beside) = &report.kinematic else { return vec![] };
    let sentence = |said: String| holding("p", said).with("class", "plain");
    let effects = &beside.report.effects;
    let said = match effects.is_empty() {
        true => kinematic_text::sentences(beside, report),
        false => kinematic_text::gaps(&beside.report, report).into_iter().collect(),
    };
    let row = |i: usize, e: &report::Named, (name, of): (&String, &report::Estimate)| {
        let by_forces = beside.predicted(i, name).map_or("–".into(), |v| significant(v, 3));
        vec![Cell::text(&e.id), Cell::text(parameter(name, of)), Cell::Number(by_forces)]
    };
    let rows = effects.iter().enumerate().flat_map(|(i, e)| e.parameters.iter().map(move |of| row(i, e, of)));
    let caption = "What the model asks for where what is measured of its wheels drives it";
    let coefficients = table(caption, &["effect", "as fitted to the log", "#as the forces predict"], rows.collect());
    said.into_iter().map(sentence).chain(coefficients).collect()
}

/// What was read and what was left out of it.
pub fn data(report: &Report) -> Vec<Element> {
    let data = &report.data;
    let sum = format!("{}, {} rows used, {} dropped.", counted(data.runs, "run"), data.rows, data.rows_dropped);
    let row = |(why, count): (&String, &usize)| vec![Cell::text(why), Cell::Number(count.to_string())];
    let dropped = table("Rows dropped", &["why", "#rows"], data.why_dropped.iter().map(row).collect());
    let clocks = clocks(report);
    let warnings = Element::new("ul").with("class", "plain").children(data.warnings.iter().map(|w| holding("li", w)));
    let heading = holding("p", "Warnings").with("class", "plain");
    let warned = if data.warnings.is_empty() { Vec::new() } else { vec![heading, warnings] };
    std::iter::once(holding("p", sum).with("class", "plain")).chain(clocks).chain(dropped).chain(warned).collect()
}

fn clocks(report: &Report) -> Option<Element> {
    let row = |c: &report::RunClock| {
        let drift = with_error(1e6 * c.drift.value, c.drift.std.map(|s| 1e6 * s));
        vec![
            Cell::Lines(vec![c.run.clone(), c.truth.clone()]),
            Cell::Number(seconds(&c.offset_s)),
            Cell::Number(drift),
            Cell::Number(significant(c.at_s, 6)),
        ]
    };
    let headings = ["inputs and poses", "#offset, s", "#drift, µs/s", "#at the inputs' time, s"];
    let caption = "Clocks: time of the poses = time of the inputs + offset + drift since the time stated";
    table(caption, &headings, report.data.clocks.iter().map(row).collect())
}

/// Version, seed and files.
pub fn provenance(report: &Report) -> Vec<Element> {
    let p = &report.provenance;
    let line = format!("creepage {}, seed {}, report layout {}.", p.version, p.seed, report.schema);
    let row = |(file, hash): (&String, &String)| vec![Cell::text(file), Cell::Hash(hash.clone())];
    let inputs = table("Inputs", &["file", "SHA-256"], p.inputs_sha256.iter().map(row).collect());
    std::iter::once(holding("p", line).with("class", "plain")).chain(inputs).collect()
}
