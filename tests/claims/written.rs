//! The ledger written down: every outcome in its words, for a terminal, for scripts and as errata.

use creepage::claims::{Claim, Counterexample, Entry, Ledger, Options, Outcome, Shown, Status, ledger};
use serde_json::json;

fn holds(cases: u64) -> Outcome {
    Outcome::Holds { cases }
}

fn fails() -> Outcome {
    let values = [("a", "1/2"), ("b", "-3")].map(|(n, v)| (n.to_string(), v.to_string())).to_vec();
    Outcome::Fails(Counterexample { values, says: "x is 1, the statement says 2".into() })
}

fn shown(outcome: Outcome, as_stated: bool, sabotages: usize, survivors: &[&str]) -> Shown {
    Shown { outcome, as_stated, sabotages, survivors: survivors.iter().map(ToString::to_string).collect() }
}

const GROUP: [(&str, &str); 2] = [("x", "a + b"), ("y", "2")];

fn check(_: &creepage::claims::Statement, _: &creepage::claims::Sampling) -> Outcome {
    holds(1)
}

/// A claim of every kind of evidence, and what became of each.
fn entries() -> Vec<Entry> {
    let true_one = Claim::new("true-one", Status::Sampled, "so it is")
        .at("section 1")
        .under("x is not zero")
        .about(&[3])
        .chapter("01-beginning")
        .code(&["src/a.rs", "src/b.rs"])
        .tests(&["tests/a.rs", "tests/c.rs"])
        .proof("one", &GROUP[..1], check)
        .proof("two", &GROUP, check)
        .sample("many", &GROUP, check)
        .sample("single", &GROUP, check)
        .confirmation("echo", &GROUP[..1], check);
    let of_true = vec![
        shown(holds(1), true, 4, &[]),
        shown(holds(2), true, 5, &[]),
        shown(holds(40), true, 6, &[]),
        shown(holds(1), true, 1, &[]),
        shown(holds(1), true, 2, &[]),
    ];
    let false_one = Claim::new("false-one", Status::Corrected, "printed so")
        .at("section 2; errata E9")
        .about(&[3, 5])
        .chapter("01-beginning")
        .code(&["src/b.rs"])
        .remark("A word on it.")
        .refutation("as printed", &GROUP[..1], &GROUP[1..], check)
        .proof("corrected", &GROUP, check);
    let of_false = vec![shown(fails(), true, 1, &[]), shown(holds(1), true, 3, &[])];
    let doubtful = Claim::new("doubtful", Status::Proved, "said in vain")
        .at("somewhere")
        .proof("fails", &GROUP[..1], check)
        .proof("unknown", &GROUP[..1], check)
        .sample("blind", &GROUP[..1], check)
        .refutation("not refuted", &GROUP[..1], &GROUP[1..], check)
        .refutation("refutes all", &GROUP[..1], &GROUP[1..], check);
    let of_doubtful = vec![
        shown(fails(), false, 2, &[]),
        shown(Outcome::Undefined("no formula".into()), false, 0, &[]),
        shown(holds(7), true, 3, &["a → b"]),
        shown(holds(1), false, 1, &[]),
        shown(fails(), true, 1, &["the true statement is refuted too"]),
    ];
    let misprint = Claim::new("misprint", Status::Editorial, "a letter").at("page 1");
    vec![
        Entry { claim: true_one, shown: of_true, earned: Status::Sampled },
        Entry { claim: false_one, shown: of_false, earned: Status::Corrected },
        Entry { claim: doubtful, shown: of_doubtful, earned: Status::Open },
        Entry { claim: misprint, shown: vec![], earned: Status::Editorial },
    ]
}

fn made(entries: Vec<Entry>) -> Ledger {
    Ledger { entries, options: Options { cases: 40, seed: 3 } }
}

#[test]
fn a_terminal_is_told_what_became_of_each_piece() {
    let wanted = "\
sampled    true-one
           so it is
           section 1; under: x is not zero
           + proof: one: proved; 4 of 4 sabotages noticed
           + proof: two: proved, 2 identities; 5 of 5 sabotages noticed
           + sample: many: holds in 40 cases; 6 of 6 sabotages noticed
           + sample: single: holds in 1 case; 1 of 1 sabotages noticed
           + confirmation: echo: holds in 1 case; 2 of 2 sabotages noticed

corrected  false-one
           printed so
           section 2; errata E9
           + refutation: as printed: false at a = 1/2, b = -3: x is 1, the statement says 2; the true form passes
           + proof: corrected: proved; 3 of 3 sabotages noticed
           A word on it.

open       doubtful
           said in vain
           somewhere
           NOT EARNED: stated proved, earned open
           ! proof: fails: FAILS at a = 1/2, b = -3: x is 1, the statement says 2; 2 of 2 sabotages noticed
           ! proof: unknown: CANNOT TELL: no formula; 0 of 0 sabotages noticed
           ! sample: blind: holds in 7 cases; ONLY 2 of 3 sabotages noticed
           not noticed: a → b
           ! refutation: not refuted: NOT refuted: it holds; the true form passes
           ! refutation: refutes all: false at a = 1/2, b = -3: x is 1, the statement says 2; THE TRUE FORM IS REFUTED
             TOO
           not noticed: the true statement is refuted too

editorial  misprint
           a letter
           page 1

4 claims: 0 proved, 1 sampled, 1 corrected, 0 refuted, 1 editorial, 1 open
sabotages noticed: 27 of 29 (93.1 %)
cases: 54 (--cases 40 --seed 3)
NOT EARNED: doubtful
";
    assert_eq!(ledger::text(&made(entries())), wanted);
}

#[test]
fn a_terminal_without_anything_wrong_says_so() {
    let fine = made(entries().into_iter().filter(Entry::is_earned).collect());
    assert!(fine.all_earned() && fine.entries.len() == 3 && !made(entries()).all_earned());
    let text = ledger::text(&fine);
    assert!(text.ends_with("(--cases 40 --seed 3)\nevery stated status is earned\n"), "{text}");
    let none = ledger::text(&made(vec![]));
    assert!(none.contains("sabotages noticed: 0 of 0 (100.0 %)"), "{none}");
}

#[test]
fn a_line_is_full_at_118_columns() {
    let word = |n: usize| "w".repeat(n);
    let long = word(53);
    let lines = |says: &str| {
        let claim = Claim::new("c", Status::Open, says).at("p");
        let text = ledger::text(&made(vec![Entry { claim, shown: vec![], earned: Status::Open }]));
        text.lines().skip(1).take_while(|l| *l != "           p").map(String::from).collect::<Vec<_>>()
    };
    // 11 + 53 + 1 + 53 columns.
    let full = format!("           {long} {long}");
    assert_eq!(full.chars().count(), 118);
    assert_eq!(lines(&format!("{long} {long} é")), [full.clone(), "             é".into()]);
    // What goes on is set in by two.
    let on = |rest: &str| format!("             {long}{rest}");
    let (fits, does_not) = (format!(" {}", word(51)), format!(" {}", word(52)));
    assert_eq!(lines(&format!("{long} {long} {long}{fits}")), [full.clone(), on(&fits)]);
    assert_eq!(lines(&format!("{long} {long} {long}{does_not}")), [full, on(""), format!("             {}", word(52))]);
    assert_eq!(lines(&"x".repeat(200)), [format!("           {}", "x".repeat(200))]);
}

#[test]
fn scripts_are_told_the_same() {
    let found = ledger::json(&made(entries()));
    assert_eq!((&found["schema"], &found["all_earned"]), (&json!(1), &json!(false)));
    assert_eq!(found["sabotages"], json!({ "noticed": 27, "all": 29 }));
    assert_eq!((&found["cases"], &found["options"]), (&json!(54), &json!({ "cases": 40, "seed": 3 })));
    let counts = json!({ "proved": 0, "sampled": 1, "corrected": 1, "refuted": 0, "editorial": 1, "open": 1 });
    assert_eq!(found["counts"], counts);
    let of = |i: usize| &found["claims"][i];
    assert_eq!((&of(0)["earned"], &of(0)["is_earned"]), (&json!("sampled"), &json!(true)));
    assert_eq!(
        (&of(2)["stated"], &of(2)["earned"], &of(2)["is_earned"]),
        (&json!("proved"), &json!("open"), &json!(false))
    );
    let wanted = json!({
        "gives": "proof", "shows": "two", "statement": ["x = a + b", "y = 2"], "as_stated": true,
        "outcome": { "holds": true, "cases": 2 }, "sabotages": { "noticed": 5, "all": 5, "survivors": [] },
    });
    assert_eq!(of(0)["evidence"][1], wanted);
    assert_eq!(of(2)["evidence"][1]["outcome"], json!({ "holds": null, "why": "no formula" }));
    let counterexample = json!({ "values": { "a": "1/2", "b": "-3" }, "says": "x is 1, the statement says 2" });
    assert_eq!(of(2)["evidence"][0]["outcome"], json!({ "holds": false, "counterexample": counterexample }));
    let sabotages = json!({ "noticed": 2, "all": 3, "survivors": ["a → b"] });
    assert_eq!(of(2)["evidence"][2]["sabotages"], sabotages);
}

#[test]
fn errata_are_what_is_not_so() {
    let text = ledger::errata(&made(entries()));
    let wanted = "
## Corrected and refuted

### `false-one`

printed so *section 2; errata E9.*

A word on it.

- As printed: as printed: `x = a + b`. False at a = 1/2, b = -3: x is 1, the statement says 2.
- True (proof): corrected: `x = a + b`, `y = 2`.

Derived in [01-beginning](01-beginning.md).

## Editorial

### `misprint`

a letter *page 1.*


## Open

### `doubtful`

said in vain *somewhere.*

- True (sample): blind: `x = a + b`.
- True (refutation): not refuted: `x = a + b`.
- As printed: refutes all: `x = a + b`. False at a = 1/2, b = -3: x is 1, the statement says 2.
";
    let (_, body) = text.split_once("check it by hand.\n").unwrap();
    assert_eq!(body, wanted);
}

#[test]
fn lists_need_no_run() {
    let claims: Vec<Claim> = entries().into_iter().map(|e| e.claim).collect();
    let wanted = "\
sampled    true-one   so it is [section 1]
corrected  false-one  printed so [section 2; errata E9]
proved     doubtful   said in vain [somewhere]
editorial  misprint   a letter [page 1]
";
    assert_eq!(ledger::claims_text(&claims), wanted);
    let found = ledger::claims_json(&claims);
    assert_eq!((&found["schema"], found["claims"].as_array().map(Vec::len)), (&json!(1), Some(4)));
    assert_eq!(found["claims"][1]["equations"], json!([3, 5]));
    let contents = ledger::contents(&claims);
    let row = |place: &str| contents.lines().find(|l| l.starts_with(&format!("| {place} |"))).unwrap();
    // What two claims share is named once.
    let shared = "| (3) | `true-one` (sampled), `false-one` (corrected) | [01-beginning](01-beginning.md) \
                  | `tests/a.rs`, `tests/c.rs` | `src/a.rs`, `src/b.rs` |";
    assert_eq!(row("(3)"), shared);
    assert_eq!(row("(28)"), "| (28) |  |  |  |  |");
    assert_eq!(row("somewhere"), "| somewhere | `doubtful` (proved) |  |  |  |");
    assert!(!contents.contains("| section 1 |"));
}
