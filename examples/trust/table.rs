//! The tally as text.

use crate::interval::Share;
use crate::rows::{hidden_text, target_text};
use crate::suite::judgement::Answer;
use crate::tally::{Groups, SILENCE, Tally, UNNAMED, times};
use crate::workers::Outcome;
use std::fmt::Write as _;

/// Everything a reader wants to see at once.
pub fn text(tally: &Tally, outcomes: &[Outcome]) -> String {
    let mut out = String::from("Shares with the 95 % interval of Clopper and Pearson.\n\n");
    let mut line = |what: &str, share: &Share| writeln!(out, "{what:34} {}", share.text()).unwrap_or_default();
    line("false alarms", &tally.false_alarms);
    line("the same, coarse or noisy inputs", &tally.false_alarms_coarse);
    line("one effect, named rightly", &tally.singles);
    line("two effects, both named rightly", &tally.pairs);
    line("one in part, named with its time", &tally.in_part);
    line("95 % intervals that hold the truth", &tally.coverage);
    line("named though the data hardly tell", &tally.undetermined);
    if tally.coverage.n > 0 {
        out += &format!("{:34} {:.2} (1 is honest)\n", "RMS error / standard deviation", tally.rms_z);
    }
    for (what, (n, median, high)) in tally.gaps.iter().filter(|(_, row)| row.0 > 0) {
        out += &format!("{:34} median {median:.2}, 90 % {high:.2} ({n} runs)\n", format!("gap / floor, {what}"));
    }
    let (n, [median, high, most]) = times(outcomes);
    if n > 0 {
        out += &format!(
            "{:34} median {median:.2} s, 90 % {high:.2} s, longest {most:.2} s ({n} runs)\n",
            "60 s at 50 Hz, one core"
        );
    }
    out += &answers(tally);
    out += &section("False alarms by", &tally.false_alarms_by);
    out += &section("Names right by", &tally.names_by);
    out += &section("Coverage by", &tally.coverage_by);
    out += &confusion(tally);
    out + &failures(outcomes)
}

/// Right, class, honest rest, wrong: the columns that matter.
fn answers(tally: &Tally) -> String {
    let heads = Answer::ALL.map(|(_, name)| format!("{name:>12}")).concat();
    let row = |(kind, of): (&String, &std::collections::BTreeMap<Answer, u64>)| {
        let cells = Answer::ALL.map(|(answer, _)| format!("{:>12}", of.get(&answer).copied().unwrap_or(0)));
        format!("  {kind:10}{}\n", cells.concat())
    };
    format!("\nAnswers {:4}{heads}\n{}", "", tally.answers.iter().map(row).collect::<String>())
}

fn section(title: &str, groups: &Groups) -> String {
    if groups.is_empty() {
        return String::new();
    }
    let rows = groups.iter().map(|(name, share)| format!("  {name:32} {}\n", share.text()));
    format!("\n{title}\n{}", rows.collect::<String>())
}

/// The rows and columns of the confusion matrix, effects first.
pub fn sides(tally: &Tally) -> [Vec<String>; 2] {
    let rows: Vec<String> = tally.confusion.keys().filter(|k| *k != SILENCE).cloned().collect();
    let mut columns = rows.clone();
    let named = tally.confusion.values().flat_map(|row| row.keys());
    for name in named.filter(|n| *n != SILENCE && *n != UNNAMED) {
        if !columns.contains(name) {
            columns.push(name.clone());
        }
    }
    let rows = rows.into_iter().chain(tally.confusion.contains_key(SILENCE).then(|| SILENCE.into())).collect();
    columns.extend([SILENCE.into(), UNNAMED.into()]);
    [rows, columns]
}

/// How often a class was named where another was hidden.
pub fn cell(tally: &Tally, hidden: &str, named: &str) -> u64 {
    tally.confusion.get(hidden).and_then(|row| row.get(named)).copied().unwrap_or(0)
}

fn confusion(tally: &Tally) -> String {
    let [rows, columns] = sides(tally);
    let mut out = String::from("\nHidden (row) and named (column, by number)\n");
    for row in &rows {
        let number = columns.iter().position(|c| c == row).map_or(String::new(), |i| (i + 1).to_string());
        let cells = columns.iter().map(|column| match cell(tally, row, column) {
            0 => "  .".into(),
            n => format!("{n:3}"),
        });
        out += &format!("{number:>3} {row:30}{}\n", cells.collect::<String>());
    }
    let keys = columns.iter().enumerate().skip(rows.len().saturating_sub(1));
    out + &keys.map(|(i, c)| format!("{:>3} {c}\n", i + 1)).collect::<String>()
}

/// The cases that are wrong though the data determine the answer.
fn failures(outcomes: &[Outcome]) -> String {
    let wrong: Vec<&Outcome> = outcomes.iter().filter(|o| !o.judgement.right && o.case.determined()).collect();
    let mut out = format!("\nWrong: {}; run one alone with --case SEED\n", wrong.len());
    for o in wrong {
        let list = |parts: Vec<String>| if parts.is_empty() { "nothing".into() } else { parts.join(" + ") };
        let hidden = list(o.case.scenario.hidden.iter().map(hidden_text).collect());
        let named = list(o.judgement.named.iter().map(|t| target_text(*t)).collect());
        let (vehicle, verdict) = (o.case.make.name, &o.judgement.verdict);
        out += &format!("  {} {vehicle}: hidden {hidden}; {verdict}, named {named}\n", o.case.seed);
    }
    out
}
