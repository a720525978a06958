//! `fleet.html`: what the fleet has in a sentence, who differs, a caterpillar plot of every value, the tables.

use super::caterpillar::caterpillar;
use super::fleet_text;
use super::over_time::over_time;
use crate::discrepancy::rendering::html::cards::{card, small};
use crate::discrepancy::rendering::html::page;
use crate::discrepancy::rendering::html::part::{Cell, Fold, eyebrow, figure, folds, holding, section, table};
use crate::discrepancy::rendering::patched_state::State;
use crate::discrepancy::rendering::plain_text::within;
use crate::effects::{self, Applied, TypicalMotion};
use crate::fleet::report::{FleetEffect, FleetParameter, FleetReport, RobotReport};
use crate::number_format::{probability, significant, with_error};
use crate::picture::svg::Element;
use crate::wording::{counted, listed_to};

/// Names in a card.
const NAMED: usize = 6;

/// The report as a self-contained page: no script, no font, no request.
pub fn fleet_html(report: &FleetReport) -> String {
    let title = format!("{} — creepage fleet", report.summary.trim_end_matches('.'));
    let needed = [effects(report), tags(report)].into_iter().flatten();
    let multiples = parameters(report).filter_map(|(effect, name, p)| over_time(report, effect, name, p));
    let parts = vec![
        Fold::open("fleet", "What the fleet needs, in numbers", needed),
        Fold::closed("time", "Run by run over time", multiples),
        Fold::open("robots", "Robot by robot", robots(report)),
        Fold::closed("rest", "What was left out", rest(report)),
    ];
    let main = Element::new("main")
        .child(header(report))
        .child(fleet_cards(report))
        .children(section("Robots, each beside all others", figures(report).into_iter().collect()))
        .children(folds(parts, false));
    page(&title, &report.version, main, false)
}

fn header(report: &FleetReport) -> Element {
    let differ = !(report.odd_robots.is_empty() && report.own_effects.is_empty() && report.odd_runs.is_empty());
    let (state, word) = if differ { (State::Doubtful, "Some differ") } else { (State::Good, "All alike") };
    let of = format!("fleet · {} · {}", counted(report.robots, "robot"), counted(report.runs, "run"));
    let eyebrow = eyebrow(state, word, of);
    let plain: Vec<String> = report.effects.iter().filter_map(in_the_mean).collect();
    let lead = (!plain.is_empty()).then(|| format!("In the mean {}", within(&plain.join(" "))));
    let lead = lead.map(|says| holding("p", says).with("class", "lead"));
    let says = report.odd_robots.iter().map(|o| &o.says).chain(report.own_effects.iter().map(|o| &o.says));
    let says: Vec<Element> = says.chain(report.odd_runs.iter().map(|o| &o.says)).map(|s| holding("li", s)).collect();
    let list = (!says.is_empty()).then(|| Element::new("ul").with("class", "found").children(says));
    Element::new("header").child(eyebrow).child(holding("h1", &report.summary)).children(lead).children(list)
}

/// What the fleet has in the mean, for anyone; nothing of an effect whose sentence needs more than its parameters.
fn in_the_mean(of: &FleetEffect) -> Option<String> {
    let (id, on) = of.effect.split_once('@').unwrap_or((&of.effect, ""));
    let effect = effects::named(id)?;
    let values =
        effect.parameters.keys().map(|name| Some(of.parameters.get(name)?.mean?.value)).collect::<Option<_>>()?;
    let unknown = TypicalMotion { speed: f64::NAN, turning: f64::NAN, until: f64::NAN };
    let trailer = on.parse().ok();
    if effect.per_input || effect.per_quantity || (!on.is_empty() && trailer.is_none()) {
        return None;
    }
    Applied::new(effect, trailer, values).in_plain_words(unknown)
}

fn fleet_cards(report: &FleetReport) -> Element {
    let own = report.own_effects.iter().map(|o| &o.robot);
    let odd: Vec<String> = report.odd_robots.iter().map(|o| &o.robot).chain(own).cloned().collect();
    let differ = if odd.is_empty() {
        "no robot".into()
    } else {
        format!("{} of {}", odd.len(), counted(report.robots, "robot"))
    };
    let named =
        if odd.is_empty() { "beyond what chance makes of so many robots".into() } else { listed_to(&odd, NAMED) };
    let needs: Vec<String> = report.effects.iter().map(|e| e.effect.clone()).collect();
    let needed = if needs.is_empty() { "no robot's runs ask for one".into() } else { listed_to(&needs, NAMED) };
    let verdicts: Vec<String> = report.verdicts.iter().map(|(verdict, n)| format!("{n} {verdict}")).collect();
    Element::new("div").with("class", "cards").children([
        card("Differ from the others", Some(differ), vec![small(named)]),
        card("The fleet needs", Some(counted(needs.len(), "effect")), vec![small(needed)]),
        card("Robots by verdict", Some(counted(report.robots, "robot")), vec![small(verdicts.join(", "))]),
    ])
}

fn parameters(report: &FleetReport) -> impl Iterator<Item = (&str, &str, &FleetParameter)> {
    report.effects.iter().flat_map(|e| e.parameters.iter().map(|(name, p)| (e.effect.as_str(), name.as_str(), p)))
}

/// A plot of every parameter, side by side.
fn figures(report: &FleetReport) -> Option<Element> {
    let drawings: Vec<Element> =
        parameters(report).filter_map(|(effect, name, p)| caterpillar(report, effect, name, p)).collect();
    let how =
        "Each robot with its 95 % interval, sorted; the band holds 95 % of robots, a square is a robot that differs.";
    (!drawings.is_empty()).then(|| figure(drawings, None, "Every value that the fleet needs.", how))
}

fn effects(report: &FleetReport) -> Option<Element> {
    let row = |(effect, name, p): (&str, &str, &FleetParameter)| {
        let named = report.effects.iter().find(|e| e.effect == effect).map_or(0, |e| e.named_by);
        let number = |v: Option<String>| Cell::Number(v.unwrap_or_else(|| "–".into()));
        vec![
            Cell::text(effect),
            Cell::text(unit(name, &p.unit)),
            number(p.mean.map(|m| with_error(m.value, m.std))),
            number(p.between_robots.map(|b| fleet_text::spread(&b))),
            number(p.between_runs.map(|w| significant(w, 2))),
            Cell::Number(named.to_string()),
            Cell::Number(format!("{} + {}", p.runs, p.runs_without)),
        ]
    };
    let headings = [
        "effect",
        "parameter",
        "#mean ± std",
        "#between robots (95 %)",
        "#between runs",
        "#robots naming it",
        "#runs that tell it + do not",
    ];
    table("Effects that the fleet needs", &headings, parameters(report).map(row).collect())
}

fn unit(name: &str, unit: &str) -> String {
    if unit == "1" { name.to_string() } else { format!("{name}, {unit}") }
}

fn tags(report: &FleetReport) -> Option<Element> {
    let rows = parameters(report).flat_map(|(effect, name, p)| {
        p.tags.iter().map(move |t| vec![Cell::text(effect), Cell::text(name), Cell::text(fleet_text::tag(t, p))])
    });
    table("What depends on tags and dates", &["effect", "parameter", "how"], rows.collect())
}

fn robots(report: &FleetReport) -> Option<Element> {
    let keys: Vec<String> = parameters(report).map(|(effect, name, _)| format!("{effect} {name}")).collect();
    let mends = report.per_robot.iter().any(|r| !r.mend.is_empty());
    let last = mends.then(|| "what to mend".to_string());
    let numbers = keys.iter().map(|k| format!("#{k}"));
    let headings: Vec<String> =
        ["robot", "verdict", "#runs"].map(String::from).into_iter().chain(numbers).chain(last).collect();
    let row = |r: &RobotReport| {
        let value = |key: &String| {
            let v = r.values.get(key);
            let odd = if v.is_some_and(|v| v.is_odd) { " differs" } else { "" };
            Cell::Number(v.map_or("–".into(), |v| with_error(v.value, Some(v.std)) + odd))
        };
        let first = [files(r), Cell::text(&r.verdict), Cell::Number(r.runs.to_string())];
        let mend = mends.then(|| Cell::Lines(r.mend.clone()));
        first.into_iter().chain(keys.iter().map(value)).chain(mend).collect()
    };
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let caption = "Values beside those of all others, and the lines of the ROS 2 controller that they change";
    let caption = if mends { caption } else { "Values beside those of all others" };
    table(caption, &headings, report.per_robot.iter().map(row).collect())
}

/// A robot with its model, and what ROS 2 reads of it.
fn files(robot: &RobotReport) -> Cell {
    let at = |ending: &str| format!("robots/{}.{ending}", in_address(&robot.robot));
    let yaml = (!robot.mend.is_empty()).then(|| ("ROS 2", at("yaml")));
    Cell::Files(robot.robot.clone(), [("model", at("toml"))].into_iter().chain(yaml).collect())
}

/// A file's name in an address: all but letters, digits and a few signs in per cent.
fn in_address(name: &str) -> String {
    let one = |b: u8| match b {
        b if b.is_ascii_alphanumeric() || b"-_.~".contains(&b) => char::from(b).to_string(),
        b => format!("%{b:02X}"),
    };
    name.bytes().map(one).collect()
}

fn rest(report: &FleetReport) -> Vec<Element> {
    let row = |n: &crate::fleet::report::NotNeeded| {
        let why = if n.not_told_apart { "not told from what is needed" } else { "as often by mistake" };
        vec![
            Cell::text(&n.effect),
            Cell::text(n.robots.join(", ")),
            Cell::text(why),
            Cell::Number(probability(n.q_value)),
        ]
    };
    let headings = ["effect", "robots", "why", "#q"];
    let left =
        table("Named by robots and not needed by the fleet", &headings, report.not_needed.iter().map(row).collect());
    let warnings = report.warnings.iter().map(|w| holding("li", w)).collect::<Vec<_>>();
    let warned = (!warnings.is_empty()).then(|| Element::new("ul").with("class", "plain").children(warnings));
    left.into_iter().chain(warned).collect()
}
