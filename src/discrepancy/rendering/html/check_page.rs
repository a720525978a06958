//! `check.html`: what some runs can tell of a model, before anyone drives again.

use super::part::{Cell, fold, holding, table};
use super::{cards, change, document, policy_head, script, words};
use crate::discrepancy::identifiability::check_report::{Check, Pair, Parameter, Prospect, RunHealth, Seen, Standing};
use crate::discrepancy::rendering::plain_text::capitalised;
use crate::discrepancy::report::Change;
use crate::number_format::{plain, prefixed, significant};
use crate::picture::axis::Axis;
use crate::picture::svg::{Element, fixed};
use crate::wording::{counted, listed_to};

/// How far below and above its plausible size an effect is drawn.
const SPAN: [f64; 2] = [1e-3, 1e2];
/// Names in a card.
const NAMED: usize = 4;

/// The check as a self-contained page.
pub fn check_html(check: &Check, vehicle: &str, version: &str) -> String {
    let mended = changes(check);
    let has_texts = !mended.is_empty();
    let title = format!("{} — creepage check", check.summary.trim_end_matches('.'));
    let main = Element::new("main")
        .child(header(check, vehicle))
        .children(three_cards(check))
        .children(change::section(&mended, check.next_experiment.as_ref()))
        .children(evidence(check));
    document(policy_head(&title, version, has_texts), main, has_texts.then(script::element))
}

fn header(check: &Check, vehicle: &str) -> Element {
    let (class, mark, name) = match check.verdict {
        Standing::Identifiable => ("good", "✓", "These runs can tell"),
        Standing::NotIdentifiable => ("above", "▲", "These runs cannot tell everything"),
        Standing::UnusableData => ("bad", "✕", "These data cannot be used"),
    };
    let pill = holding("span", format!("{mark} {name}")).with("class", format!("verdict {class}"));
    let seconds: f64 = check.data.runs.iter().map(|r| r.duration_s).sum();
    let rows: usize = check.data.runs.iter().map(|r| r.rows).sum();
    let what = format!(
        "{vehicle} · {} · {seconds:.0} s · {} · before any fit",
        counted(check.data.runs.len(), "run"),
        counted(rows, "row")
    );
    Element::new("header")
        .child(Element::new("p").with("class", "eyebrow").child(pill).text(what))
        .child(holding("h1", &check.summary))
}

/// The lines that mend the data, and those that the notes of the check give.
fn changes(check: &Check) -> Vec<Change> {
    let mends = check.data.findings.iter().filter_map(|f| f.mend.clone());
    mends.map(|text| Change { of: "model.toml, for the data".into(), text }).collect()
}

fn three_cards(check: &Check) -> Option<Element> {
    if check.effects.is_empty() {
        return None;
    }
    let seen = check.effects.iter().filter(|e| e.seen == Seen::Yes).count();
    let missed: Vec<String> = check.effects.iter().filter(|e| e.seen == Seen::No).map(label).collect();
    let apart: Vec<&Pair> = check.not_separated.iter().filter(|p| p.why == "data").collect();
    let later = check.effects.iter().filter(|e| e.seen == Seen::OnceExplained).count();
    let later = (later > 0).then(|| format!("{later} more once the rest is explained"));
    let missed = (!missed.is_empty()).then(|| format!("not {}", listed_to(&missed, NAMED)));
    let told: Vec<String> = later.into_iter().chain(missed).collect();
    let missed = if told.is_empty() { "at the size it plausibly has".to_string() } else { told.join("; ") };
    let pairs: Vec<String> = apart.iter().map(|p| p.effects.join(" and ")).collect();
    let named = if pairs.is_empty() {
        "by these runs, of those that any run tells apart".into()
    } else {
        listed_to(&pairs, NAMED)
    };
    let noise = |v: Option<f64>, unit: &str, of: &str| {
        let (factor, unit) = prefixed(v?, unit);
        Some(format!("{of} {} {unit}", significant(v? * factor, 2)))
    };
    let noises: Vec<String> =
        [noise(check.data.position_noise, "m", "position"), noise(check.data.heading_noise, "rad", "heading")]
            .into_iter()
            .flatten()
            .collect();
    let first = noises.first().cloned().unwrap_or_else(|| "not known".into());
    Some(Element::new("div").with("class", "cards").children([
        cards::card(
            "Would be seen",
            Some(format!("{seen} of {}", counted(check.effects.len(), "effect"))),
            vec![cards::small(missed)],
        ),
        cards::card("Would not be told apart", Some(counted(pairs.len(), "pair")), vec![cards::small(named)]),
        cards::card(
            "Noise of the pose",
            Some(first),
            noises.get(1).map(|h| cards::small(h.clone())).into_iter().collect(),
        ),
    ]))
}

fn evidence(check: &Check) -> Vec<Element> {
    let notes: Vec<Element> =
        check.data.findings.iter().filter(|f| f.mend.is_none()).map(|f| holding("li", capitalised(&f.says))).collect();
    let notes = (!notes.is_empty()).then(|| Element::new("ul").with("class", "plain").children(notes));
    let parts = [
        ("notes", "What to know of these data", true, notes.into_iter().collect::<Vec<_>>()),
        ("effects", "From which size each effect would be seen", true, sizes(check)),
        ("numbers", "The same in numbers", false, numbers(check).into_iter().collect()),
        ("runs", "Run by run", true, runs(check).into_iter().collect()),
        ("pairs", "Effects that are not told apart", false, pairs(check).into_iter().collect()),
        ("words", "Words", false, vec![words::of_method()]),
    ];
    let full = parts.into_iter().filter(|(_, _, _, content)| !content.is_empty());
    full.map(|(id, heading, open, content)| fold(id, heading, open, content)).collect()
}

fn label(of: &Prospect) -> String {
    of.trailer.map_or_else(|| of.id.clone(), |i| format!("{} (trailer {i})", of.id))
}

/// Every effect by the smallest size that would be seen, over the plausible one.
fn sizes(check: &Check) -> Vec<Element> {
    if check.effects.is_empty() {
        return vec![];
    }
    let axis = Axis::log("", "", SPAN).along([0.0, 100.0]);
    let rows = check.effects.iter().flat_map(|e| row(e, &axis));
    let chart = Element::new("div").with("class", "weighed").children(rows);
    let how = "A bar ends at the smallest size that would be seen with 95 %, on a logarithmic scale; the line is the plausible \
               size. A bar that ends left of it: an effect of ordinary size would be seen.";
    vec![chart, holding("p", how).with("class", "small")]
}

fn row(of: &Prospect, axis: &Axis) -> [Element; 3] {
    let seen = match of.seen {
        Seen::Yes => ("solid", ""),
        Seen::OnceExplained => ("hatched", ", once the rest is explained"),
        Seen::No => ("hollow", ", would be missed"),
    };
    // A direction has no size of its own.
    let worst = of.parameters.values().filter_map(share).reduce(f64::max).unwrap_or(f64::INFINITY);
    let to = if worst.is_finite() { axis.at(worst.clamp(SPAN[0], SPAN[1])) } else { 100.0 };
    let said =
        if worst.is_finite() { format!("{} of its plausible size", percent(worst)) } else { "not to be seen".into() };
    let line = Element::new("b").with("class", "zero").with("style", format!("left:{}%", fixed(axis.at(1.0))));
    let fill = Element::new("i").with("class", seen.0).with("style", format!("left:0%;width:{}%", fixed(to)));
    [
        holding("span", label(of)).with("class", format!("name {}", seen.0)),
        holding("span", format!("{said}{}", seen.1)).with("class", "value"),
        Element::new("span").with("class", "length").with("aria-hidden", "true").child(fill).child(line),
    ]
}

/// The smallest size that would be seen over the plausible one.
fn share(of: &Parameter) -> Option<f64> {
    of.smallest_seen.map(|least| least / of.plausible)
}

fn percent(share: f64) -> String {
    format!("{} %", significant(100.0 * share, 2))
}

fn numbers(check: &Check) -> Option<Element> {
    let number = |x: Option<f64>| Cell::Number(x.map_or_else(|| "–".into(), |x| significant(x, 2)));
    let rows = check.effects.iter().flat_map(|e| {
        e.parameters.iter().map(move |(name, p)| {
            let unit = if p.unit == "1" { String::new() } else { format!(", {}", p.unit) };
            let name = format!("{name}{unit}");
            vec![
                Cell::text(label(e)),
                Cell::text(name),
                number(p.std),
                number(p.smallest_seen),
                number(Some(p.plausible)),
            ]
        })
    });
    let headings = ["effect", "parameter", "#std", "#seen from", "#plausible"];
    table("Standard deviation, smallest size that would be seen, plausible size", &headings, rows.collect())
}

fn runs(check: &Check) -> Option<Element> {
    let percent = |x: f64| Cell::Number(format!("{:.0} %", 100.0 * x));
    let row = |r: &RunHealth| {
        let speed =
            r.speed.map_or_else(|| "–".into(), |s| format!("{} to {} m/s", significant(s[0], 2), significant(s[2], 2)));
        vec![
            Cell::text(&r.run),
            Cell::Number(r.rows.to_string()),
            Cell::Number(format!("{} s", significant(r.duration_s, 3))),
            Cell::Number(format!("{} Hz", plain(r.rate_hz))),
            Cell::text(speed),
            percent(r.left),
            percent(r.right),
            percent(r.standing),
        ]
    };
    let headings = ["run", "#rows", "#time", "#rate", "speed, 90 % of the time", "#left", "#right", "#stands"];
    table("Rows, times, speeds and turns", &headings, check.data.runs.iter().map(row).collect())
}

fn pairs(check: &Check) -> Option<Element> {
    let why = |p: &Pair| match p.why.as_str() {
        "data" => "these runs do not separate them, others can",
        "first order" => "the same to first order",
        _ => "the same under a change of parameter",
    };
    let row = |p: &Pair| vec![Cell::text(&p.effects[0]), Cell::text(&p.effects[1]), Cell::text(why(p))];
    table("Pairs", &["effect", "not told from", "why"], check.not_separated.iter().map(row).collect())
}
