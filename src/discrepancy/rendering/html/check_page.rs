//! `check.html`: what some runs can tell of a model, before anyone drives again.

use super::part::{Cell, Fold, bar, eyebrow, folds, holding, table};
use super::{cards, change, columns, page, words};
use crate::discrepancy::identifiability::check_report::{Check, Pair, Parameter, Prospect, RunHealth, Seen, Standing};
use crate::discrepancy::rendering::patched_state::State;
use crate::discrepancy::rendering::plain_text::capitalised;
use crate::discrepancy::rendering::{changes, check_text};
use crate::discrepancy::report::{Change, ColumnPicture};
use crate::number_format::{plain, significant};
use crate::picture::axis::Axis;
use crate::picture::svg::Element;
use crate::wording::{counted, listed_to};

/// How far below and above its plausible size an effect is drawn.
const SPAN: [f64; 2] = [1e-3, 1e2];
/// Names in a card.
const NAMED: usize = 4;

/// The check as a self-contained page, with columns of runs that cannot be used.
pub fn check_html(check: &Check, vehicle: &str, version: &str, columns: &[ColumnPicture]) -> String {
    let mends: Vec<Change> = changes::mends(&check.data.findings).into_iter().collect();
    let title = format!("{} — creepage check", check.summary.trim_end_matches('.'));
    let main = Element::new("main")
        .child(header(check, vehicle))
        .children(three_cards(check))
        .children(change::section(&mends, check.next_experiment.as_ref()))
        .children(evidence(check, columns));
    page(&title, version, main, !mends.is_empty())
}

fn header(check: &Check, vehicle: &str) -> Element {
    let (state, name) = match check.verdict {
        Standing::Identifiable => (State::Good, "These runs can tell"),
        Standing::NotIdentifiable => (State::Doubtful, "These runs cannot tell everything"),
        Standing::UnusableData => (State::NotUsable, "These data cannot be used"),
    };
    let seconds: f64 = check.data.runs.iter().map(|r| r.duration_s).sum();
    let rows: usize = check.data.runs.iter().map(|r| r.rows).sum();
    let what = format!(
        "{vehicle} · {} · {seconds:.0} s · {} · before any fit",
        counted(check.data.runs.len(), "run"),
        counted(rows, "row")
    );
    Element::new("header").child(eyebrow(state, name, what)).child(holding("h1", &check.summary))
}

fn three_cards(check: &Check) -> Option<Element> {
    if check.effects.is_empty() {
        return None;
    }
    let seen = check.effects.iter().filter(|e| e.seen == Seen::Yes).count();
    let missed: Vec<String> = check.effects.iter().filter(|e| e.seen == Seen::No).map(check_text::label).collect();
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
    let noises = check_text::noises(&check.data);
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

fn evidence(check: &Check, columns: &[ColumnPicture]) -> Vec<Element> {
    let notes: Vec<Element> =
        check.data.findings.iter().filter(|f| f.mend.is_none()).map(|f| holding("li", capitalised(&f.says))).collect();
    let notes = (!notes.is_empty()).then(|| Element::new("ul").with("class", "plain").children(notes));
    let parts = vec![
        Fold::open("notes", "What to know of these data", notes),
        Fold::open("columns", "The columns over time", columns::figure(columns)),
        Fold::open("effects", "From which size each effect would be seen", sizes(check)),
        Fold::closed("numbers", "The same in numbers", numbers(check)),
        Fold::open("runs", "Run by run", runs(check)),
        Fold::closed("pairs", "Effects that are not told apart", pairs(check)),
        Fold::closed("words", "Words", [words::of_method()]),
    ];
    folds(parts, false)
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
    let (look, remark) = match of.seen {
        Seen::Yes => ("solid", ""),
        Seen::OnceExplained => ("hatched", ", once the rest is explained"),
        Seen::No => ("hollow", ", would be missed"),
    };
    // A direction has no size of its own.
    let worst = of.parameters.values().filter_map(share).reduce(f64::max).unwrap_or(f64::INFINITY);
    let to = if worst.is_finite() { axis.at(worst.clamp(SPAN[0], SPAN[1])) } else { 100.0 };
    let said =
        if worst.is_finite() { format!("{} of its plausible size", percent(worst)) } else { "not to be seen".into() };
    bar(look, &check_text::label(of), format!("{said}{remark}"), 0.0, to, axis.at(1.0))
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
                Cell::text(check_text::label(e)),
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
        vec![
            Cell::text(&r.run),
            Cell::Number(r.rows.to_string()),
            Cell::Number(format!("{} s", significant(r.duration_s, 3))),
            Cell::Number(format!("{} Hz", plain(r.rate_hz))),
            Cell::text(check_text::speeds(r)),
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
