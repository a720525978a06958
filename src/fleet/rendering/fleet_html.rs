//! `fleet.html`: what the fleet has in a sentence, who differs, a caterpillar plot of every value, the tables.

use super::caterpillar::caterpillar;
use super::fleet_text;
use crate::discrepancy::rendering::html::part::{Cell, figure, holding, numbered, section, table};
use crate::discrepancy::rendering::html::{page, policy_head};
use crate::fleet::report::{FleetParameter, FleetReport, RobotReport};
use crate::number_format::{probability, significant, with_error};
use crate::picture::svg::Element;

/// The report as a self-contained page: no script, no font, no request.
pub fn fleet_html(report: &FleetReport) -> String {
    let main = Element::new("main")
        .child(header(report))
        .children(section("Robots", figures(report)))
        .children(section("The fleet", [effects(report), tags(report)].into_iter().flatten().collect()))
        .children(section("Robot by robot", robots(report).into_iter().collect()))
        .children(section("What was left out", rest(report)));
    page(policy_head(&format!("creepage fleet: {}", report.summary), &report.version, false), main)
}

fn header(report: &FleetReport) -> Element {
    let differ = !(report.odd_robots.is_empty() && report.own_effects.is_empty() && report.odd_runs.is_empty());
    let (class, word) = if differ { ("verdict", "some differ") } else { ("verdict good", "all alike") };
    let eyebrow = Element::new("p")
        .with("class", "eyebrow")
        .child(holding("span", word).with("class", class))
        .text(format!("creepage fleet, {} robots and {} runs", report.robots, report.runs));
    let says = report.odd_robots.iter().map(|o| &o.says).chain(report.own_effects.iter().map(|o| &o.says));
    let says: Vec<Element> = says.chain(report.odd_runs.iter().map(|o| &o.says)).map(|s| holding("li", s)).collect();
    let list = (!says.is_empty()).then(|| Element::new("ul").with("class", "found").children(says));
    Element::new("header").child(eyebrow).child(holding("h1", &report.summary)).children(list)
}

fn parameters(report: &FleetReport) -> impl Iterator<Item = (&str, &str, &FleetParameter)> {
    report.effects.iter().flat_map(|e| e.parameters.iter().map(|(name, p)| (e.effect.as_str(), name.as_str(), p)))
}

fn figures(report: &FleetReport) -> Vec<Element> {
    let drawn = parameters(report).filter_map(|(effect, name, p)| {
        let drawing = caterpillar(report, effect, name, p)?;
        let says = report.effects.iter().find(|e| e.effect == effect).map_or("", |e| e.says.as_str());
        let how = "Each robot with its 95 % interval beside all others, sorted; the band holds 95 % of robots, a square is a \
                   robot that differs.";
        Some(figure(vec![drawing], None, &format!("{effect}, {name}: {says}."), how))
    });
    drawn.enumerate().map(|(i, f)| numbered(i + 1, f)).collect()
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
        let first = [Cell::text(&r.robot), Cell::text(&r.verdict), Cell::Number(r.runs.to_string())];
        let mend = mends.then(|| Cell::Lines(r.mend.clone()));
        first.into_iter().chain(keys.iter().map(value)).chain(mend).collect()
    };
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    let caption = "Values beside those of all others, and the lines of the ROS 2 controller that they change";
    let caption = if mends { caption } else { "Values beside those of all others" };
    table(caption, &headings, report.per_robot.iter().map(row).collect())
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
