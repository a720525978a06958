//! The ledger: every stated status is earned, the same for any number of threads, and a false claim is found out.

use creepage::claims::{
    self, Claim, DerivedFormulas, Gives, Ledger, Options, Outcome, Sampling, Statement, Status, ledger, mutants, prove,
    proving, verify,
};
use creepage::progress::unheard;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::LazyLock;

const FEW: Options = Options { cases: 40, seed: 3 };

/// The whole ledger.
static LEDGER: LazyLock<Ledger> = LazyLock::new(|| verify(&claims::all(), &FEW, &unheard).unwrap());

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
}

fn creepage(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_creepage")).args(arguments).output().unwrap()
}

fn with_file(text: &str, run: impl FnOnce(&str)) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("claims.toml");
    std::fs::write(&path, text).unwrap();
    run(path.to_str().unwrap());
}

#[test]
fn every_stated_status_is_earned_and_every_sabotage_noticed() {
    let made = &*LEDGER;
    assert!(made.all_earned(), "{}", ledger::text(made));
    let (killed, all) = made.kills();
    assert!(killed == all && all > 1500, "{killed} of {all}");
    for entry in &made.entries {
        for (evidence, shown) in entry.claim.evidence.iter().zip(&entry.shown) {
            assert!(shown.sabotages > 0, "{}: {} cannot fail", entry.claim.id, evidence.shows);
            if let Outcome::Fails(c) = &shown.outcome {
                assert!(evidence.gives == Gives::Refutation && c.values.len() <= 6, "{}: {c}", entry.claim.id);
            }
        }
    }
}

#[test]
fn the_ledger_is_the_same_for_any_number_of_threads() {
    // Every fifth claim: the others are told apart in the same way.
    let some: Vec<Claim> = claims::all().into_iter().filter(|c| !c.id.starts_with("growth")).step_by(5).collect();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| ledger::text(&verify(&some, &Options { cases: 12, seed: 7 }, &unheard).unwrap()))
    };
    assert_eq!(with(1), with(5));
}

#[test]
fn a_seed_changes_the_cases_and_not_the_ledger() {
    let one: Vec<Claim> = claims::all().into_iter().filter(|c| c.id == "energy-rule").collect();
    let of = |seed| verify(&one, &Options { cases: 12, seed }, &unheard).unwrap();
    assert!(of(1).all_earned() && of(2).all_earned());
    // A check that tells the seed it was given shows that the seed arrives.
    let told = std::sync::Arc::new(std::sync::Mutex::new(Vec::new()));
    let seen = told.clone();
    let claim = Claim::new("seed", Status::Sampled, "").sample("", &[("x", "x + 1")], move |_, s| {
        seen.lock().unwrap().push((s.seed, s.cases));
        Outcome::Holds { cases: 1 }
    });
    for seed in [1, 2, 1] {
        verify(std::slice::from_ref(&claim), &Options { cases: 12, seed }, &unheard).unwrap();
    }
    let seeds = told.lock().unwrap().clone();
    let first: Vec<u64> = seeds.iter().map(|s| s.0).collect();
    let per_run = first.len() / 3;
    assert!(first[0] != first[per_run] && first[0] == first[2 * per_run], "{first:?}");
    assert!(seeds.iter().all(|s| s.1 == 12));
}

/// What is shown of a generated case that fails tells it from another one.
#[test]
fn a_case_that_fails_is_shown() {
    let mut met = 0;
    for claim in claims::all() {
        for evidence in claim.evidence.iter().filter(|e| e.gives != Gives::Refutation) {
            let statement = Statement::parse(&evidence.equations).unwrap();
            let outcome = |s: &Statement, cases, seed| (evidence.check)(s, &Sampling { cases, seed, shrink: false });
            if outcome(&statement, 8, 1) == outcome(&statement, 16, 1) {
                continue; // nothing is generated
            }
            let false_one = match &evidence.sabotage {
                None => mutants(&statement).swap_remove(0).statement,
                Some(own) => Statement::parse(&own[0]).unwrap(),
            };
            let shown = [2, 3].map(|seed| match outcome(&false_one, 16, seed) {
                Outcome::Fails(found) => found.values,
                other => panic!("{}: {other:?}", claim.id),
            });
            assert_ne!(shown[0], shown[1], "{}: {}", claim.id, evidence.shows);
            met += 1;
        }
    }
    assert!(met > 20, "{met}");
}

/// One claim of each kind that must not be believed.
#[test]
fn what_is_not_earned_is_open() {
    let prove_group = || proving(DerivedFormulas::default());
    let (law, slip) = ("(cot(phi) - e)/(1 + e*cot(phi))", "(cot(phi) + e)/(1 + e*cot(phi))");
    let left = "cot(phi + atan(e))";
    let cases = [
        ("a false statement", Claim::new("a", Status::Proved, "").proof("", &[(left, slip)], prove_group())),
        ("no evidence", Claim::new("b", Status::Proved, "")),
        (
            "a check that cannot fail",
            Claim::new("c", Status::Sampled, "").sample("", &[(left, law)], |_, _| Outcome::Holds { cases: 9 }),
        ),
        (
            "a check that cannot tell",
            Claim::new("d", Status::Sampled, "").sample("", &[(left, law)], |_, _| Outcome::Undefined("".into())),
        ),
        (
            "a refutation of what is true",
            Claim::new("e", Status::Refuted, "").refutation("", &[(left, law)], &[(left, law)], prove_group()),
        ),
        (
            "a refutation that refutes everything",
            Claim::new("f", Status::Refuted, "")
                .refutation("", &[(left, slip)], &[(left, law)], |_, _| Outcome::failure("always")),
        ),
        (
            "a refutation without a true form",
            Claim::new("g", Status::Refuted, "").refutation("", &[(left, slip)], &[("x", "x +")], prove_group()),
        ),
        ("a malformed statement", Claim::new("h", Status::Proved, "").proof("", &[(left, "cot(")], prove_group())),
        (
            "nothing to tamper with",
            Claim::new("i", Status::Proved, "").proof("", &[(left, law)], prove_group()).sabotaged_by(&[]),
        ),
        (
            "a sabotage that holds",
            Claim::new("j", Status::Proved, "")
                .proof("", &[(left, law)], prove_group())
                .sabotaged_by(&[&[(left, law)]]),
        ),
        (
            "a proof and a false confirmation",
            Claim::new("k", Status::Proved, "").proof("", &[(left, law)], prove_group()).confirmation(
                "",
                &[(left, slip)],
                prove_group(),
            ),
        ),
    ];
    for (what, claim) in cases {
        let made = verify(std::slice::from_ref(&claim), &FEW, &unheard).unwrap();
        assert_eq!(made.entries[0].earned, Status::Open, "{what}: {}", ledger::text(&made));
        assert!(!made.all_earned() && ledger::text(&made).contains("NOT EARNED"), "{what}");
    }
}

#[test]
fn statuses_follow_from_the_evidence() {
    let (law, slip) = ("(cot(phi) - e)/(1 + e*cot(phi))", "(cot(phi) + e)/(1 + e*cot(phi))");
    let left = "cot(phi + atan(e))";
    let base = || Claim::new("x", Status::Open, "");
    let proof = |c: Claim| c.proof("", &[(left, law)], proving(DerivedFormulas::default()));
    let sample = |c: Claim| c.sample("", &[(left, law)], proving(DerivedFormulas::default()));
    let refutation = |c: Claim| c.refutation("", &[(left, slip)], &[(left, law)], proving(DerivedFormulas::default()));
    let earned = |c: Claim| verify(&[c], &FEW, &unheard).unwrap().entries[0].earned;
    assert_eq!(earned(proof(base())), Status::Proved);
    assert_eq!(earned(sample(base())), Status::Sampled);
    assert_eq!(earned(sample(proof(base()))), Status::Sampled);
    assert_eq!(earned(refutation(base())), Status::Refuted);
    assert_eq!(earned(refutation(proof(base()))), Status::Corrected);
    assert_eq!(earned(sample(refutation(base()))), Status::Corrected);
    let echo = |c: Claim| c.confirmation("", &[(left, law)], proving(DerivedFormulas::default()));
    assert_eq!(earned(echo(proof(base()))), Status::Proved);
    assert_eq!(earned(echo(base())), Status::Open);
}

#[test]
fn slips_are_one_step_away_and_none_is_the_same_function() {
    let statement = claims::Statement::parse(&[("y", "e_1*sin(phi) - 2*e_2")]).unwrap();
    let found: Vec<String> = mutants(&statement).iter().map(|m| m.statement.to_string()).collect();
    for wanted in [
        "y = e_1*sin(phi) + 2*e_2",
        "y = e_1*cos(phi) - 2*e_2",
        "y = e_2*sin(phi) - 2*e_2",
        "y = e_1*sin(phi) - 2*e_1",
        "y = e_1*sin(phi) - 3*e_2",
        "y = e_1*sin(phi)",
        "y = 2*e_2 - e_1*sin(phi)",
    ] {
        assert!(found.iter().any(|f| f == wanted), "{wanted} is not among {found:#?}");
    }
    // What changes nothing is no sabotage: swapping the parts of a sum of squares, a sign under a square.
    let even = claims::Statement::parse(&[("y", "(-x)^2")]).unwrap();
    assert!(mutants(&even).iter().all(|m| m.statement.to_string() != "y = x^2"), "{:?}", mutants(&even));
    // Also where no normal form decides: then by values.
    let beyond = claims::Statement::parse(&[("y", "a*abs(-x)")]).unwrap();
    let found: Vec<String> = mutants(&beyond).iter().map(|m| m.statement.to_string()).collect();
    // Where both are undefined nothing is said against them.
    let partly = claims::Statement::parse(&[("y", "abs(-x)*ln(x - 1/2)")]).unwrap();
    assert!(mutants(&partly).iter().all(|m| m.statement.to_string() != "y = abs(x)*ln(x - 1/2)"));
    assert!(!found.contains(&"y = a*abs(x)".to_string()) && found.contains(&"y = -a*abs(-x)".to_string()), "{found:?}");
}

#[test]
fn the_rt_theorem_falls_to_six_numbers() {
    let all = claims::all();
    let theorem: Vec<Claim> = all.into_iter().filter(|c| c.id == "theorem-single-body").collect();
    let made = verify(&theorem, &FEW, &unheard).unwrap();
    let Outcome::Fails(found) = &made.entries[0].shown[0].outcome else { panic!("{}", ledger::text(&made)) };
    assert_eq!(found.values.len(), 6, "{found}");
    let value = |name: &str| {
        let (_, text) = found.values.iter().find(|(n, _)| n == name).unwrap_or_else(|| panic!("{name}"));
        let (p, q) = text.split_once('/').unwrap_or((text, "1"));
        p.parse::<f64>().unwrap() / q.parse::<f64>().unwrap()
    };
    // By hand: each wheel travels r·θ̇·(1 − e); the difference over the track is the yaw rate.
    let [r, a, w_1, w_2] = ["r", "a", "theta_1'", "theta_2'"].map(value);
    let yaw = (r * w_1 * (1.0 - value("e_rc_1")) - r * w_2 * (1.0 - value("e_rc_2"))) / a;
    let paper = r * (w_1 - w_2) / a;
    assert!((yaw - paper).abs() > 0.1, "{yaw} {paper}");
    assert!(found.says.contains("phi' is 1/2, the statement says 0"), "{found}");
    assert_eq!((yaw, paper), (0.5, 0.0));
}

#[test]
fn every_numbered_equation_and_erratum_has_a_claim() {
    let all = claims::all();
    for n in 1..=28u8 {
        assert!(all.iter().any(|c| c.equations.contains(&n)), "({n})");
    }
    for n in 1..=26 {
        let row = format!("E{n}");
        let named = |c: &Claim| c.place.split([' ', ',', ';']).any(|word| word == row) || c.id == row;
        assert!(all.iter().any(named), "{row}");
    }
    let mut ids: Vec<&str> = all.iter().map(|c| c.id.as_str()).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), all.len(), "two claims have one name");
    let open: Vec<&str> = all.iter().filter(|c| c.stated == Status::Open).map(|c| c.id.as_str()).collect();
    assert_eq!(open, [""; 0]);
}

#[test]
fn what_claims_point_to_is_there() {
    for claim in claims::all() {
        assert!(!claim.says.is_empty() && !claim.place.is_empty(), "{}", claim.id);
        for file in &claim.code {
            assert!(root().join(file).is_file(), "{}: {file} is missing", claim.id);
        }
        for test in &claim.tests {
            let (file, function) = test.split_once("::").unwrap_or((test, ""));
            assert!(read(file).contains(&format!("fn {function}")), "{}: {test} is missing", claim.id);
        }
        let chapter = read(&format!("theory/{}.md", claim.chapter));
        assert!(chapter.contains(&format!("`{}`", claim.id)), "theory/{}.md does not name {}", claim.chapter, claim.id);
    }
}

#[test]
fn what_is_generated_from_the_claims_is_not_stale() {
    let all = claims::all();
    let fresh = ledger::errata(&LEDGER);
    assert!(read("theory/ERRATA.md") == fresh, "run: creepage verify --format errata > theory/ERRATA.md");
    assert!(
        read("theory/CONTENTS.md") == ledger::contents(&all),
        "run: creepage claims --format contents > theory/CONTENTS.md"
    );
}

#[test]
fn the_command_exits_by_what_is_earned() {
    let code = |o: &Output| o.status.code();
    let fine = creepage(&["verify", "eq-21", "E17", "--cases", "5"]);
    assert_eq!(code(&fine), Some(0), "{fine:?}");
    assert!(String::from_utf8_lossy(&fine.stdout).contains("every stated status is earned"));
    let planted = "[[claim]]\nid = \"planted\"\nstatus = \"proved\"\n\
                   equations = [\"tan(atan(e_1) + atan(e_2)) = (e_1 + e_2)/(1 + e_1*e_2)\"]\n";
    with_file(planted, |path| {
        let found = creepage(&["verify", "--claims", path, "planted"]);
        let text = String::from_utf8_lossy(&found.stdout);
        assert_eq!(code(&found), Some(1), "{text}");
        assert!(text.contains("NOT EARNED: stated proved, earned open"), "{text}");
        assert!(text.contains("FAILS at e_1 = 1/2, e_2 = 1/2"), "{text}");
        assert!(String::from_utf8_lossy(&found.stderr).contains("not earned by planted"));
        // Among the others it is found too, and the others are not hurt.
        let all = creepage(&["verify", "--claims", path, "planted", "eq-21", "--format", "json"]);
        let json: serde_json::Value = serde_json::from_slice(&all.stdout).unwrap();
        assert_eq!(json["all_earned"], false);
        assert_eq!(
            (json["claims"][0]["is_earned"].as_bool(), json["claims"][1]["is_earned"].as_bool()),
            (Some(true), Some(false))
        );
        assert_eq!(code(&all), Some(1));
    });
}

#[test]
fn claims_of_a_file_are_proved_refuted_and_corrected() {
    let text = r#"
[[claim]]
id = "mine"
says = "a car turns by its steering"
status = "corrected"
vehicle = "car"
equations = ["phi' = v_l/L*((tan(delta) + e_f)/(1 - e_f*tan(delta)) - e_tc)"]
printed = ["phi' = v_l/L*tan(delta)"]
[[claim]]
id = "train"
status = "proved"
vehicle = "unicycle"
trailers = 1
equations = ["vt_1 = e_tc_1*v_1"]
[[claim]]
id = "not-so"
status = "refuted"
vehicle = "car"
printed = ["phi' = v_l/L*sin(delta)"]
"#;
    with_file(text, |path| {
        let found = creepage(&["verify", "--claims", path, "mine", "train", "not-so", "--format", "json"]);
        let json: serde_json::Value = serde_json::from_slice(&found.stdout).unwrap();
        assert_eq!(found.status.code(), Some(0), "{json:#}");
        assert_eq!(
            [0, 1, 2].map(|i| json["claims"][i]["earned"].as_str()),
            [Some("corrected"), Some("proved"), Some("refuted")]
        );
        let listed = creepage(&["claims", "--claims", path]);
        assert!(String::from_utf8_lossy(&listed.stdout).contains("a car turns by its steering"));
    });
}

#[test]
fn bad_input_is_one_clear_message() {
    let told = |text: &str, wanted: &str| {
        with_file(text, |path| {
            let found = creepage(&["verify", "--claims", path]);
            let message = String::from_utf8_lossy(&found.stderr).to_string();
            assert_eq!(found.status.code(), Some(2), "{text}: {message}");
            assert!(message.contains(wanted) && !message.contains("panicked"), "{text}: {message}");
            assert!(found.stdout.is_empty());
        });
    };
    let entry = |rest: &str| format!("[[claim]]\nid = \"a\"\n{rest}\n");
    told("", "empty");
    told("claim = 3", "claims.toml:1:9: claim must be a list");
    told("[[claims]]", "claims.toml:1:3: unknown key \"claims\"");
    told(&entry(""), "key \"status\" in [[claim]] is missing");
    told(&entry("status = \"true\""), "claims.toml:3:10: a claim of a file cannot be stated \"true\"");
    told(&entry("status = \"proved\"\nequations = [\"x\"]"), "claims.toml:4:14: an equation has one =");
    told(&entry("status = \"proved\"\nequations = [\"x = sin(\"]"), "claims.toml:4:14: a formula cannot be read");
    told(&entry("status = \"proved\"\nvehicle = \"boat\""), "claims.toml:4:11: no vehicle is called \"boat\"");
    told(&entry("status = \"proved\"\n[[claim]]\nid = \"a\"\nstatus = \"open\""), "two claims are called \"a\"");
    told(
        &entry("status = \"proved\"\nvehicle = \"car\"\ntrailers = 100000000000"),
        "claims.toml:5:12: 100000000000 trailers",
    );
    let powers = "status = \"proved\"\nequations = [\"((((2^64)^64)^64)^64)^64 = x\"]";
    told(&entry(powers), "claims.toml:4:14: the formula has a product of more than 64 factors");
    let long = format!("status = \"proved\"\nequations = [\"{}x = 1\"]", "x + ".repeat(1000));
    told(&entry(&long), "claims.toml:4:14: an equation has at most 4000 characters");
    told("[[claim]]\nid = \"eq-21\"\nstatus = \"open\"", "the claim eq-21");
    for arguments in [&["verify", "nothing"][..], &["verify", "--cases", "0"], &["verify", "--seed", "-1"]] {
        let found = creepage(arguments);
        assert_eq!(found.status.code(), Some(2), "{found:?}");
    }
}

#[test]
fn a_proof_is_not_believed_outside_its_reach() {
    let machine = DerivedFormulas::default();
    let statement = |l: &str, r: &str| claims::Statement::parse(&[(l, r)]).unwrap();
    assert!(matches!(prove(&machine, &statement("exp(x)", "exp(x)")), Outcome::Undefined(_)));
    // Equal here and there is no proof; different somewhere is a refutation, also outside the reach.
    assert!(prove(&machine, &statement("abs(x)", "x")).fails());
    assert!(prove(&machine, &statement("sin(x)^2", "1 - cos(x)^2")).holds());
    let unknown = DerivedFormulas::of("no such vehicle");
    assert!(!prove(&unknown, &statement("v_l", "r*theta'")).holds());
}
