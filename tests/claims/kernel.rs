//! Theorems for an independent kernel: what is written, that the kernel accepts it, and that it refuses what is false.

use creepage::claims::kernel::{ClaimFile, Proofs, accepted_line, is_accepted, proofs};
use creepage::claims::{self, Claim, Status};
use std::path::{Path, PathBuf};
use std::process::Command;

fn all() -> Proofs {
    proofs(&claims::all())
}

fn folder(name: &str) -> PathBuf {
    let dir = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&dir);
    std::fs::create_dir_all(&dir).unwrap();
    dir
}

/// The kernel's name and version.
fn version() -> Option<String> {
    let output = Command::new("coqc").arg("--version").output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    Some(format!("Coq {}", text.split("version ").nth(1)?.split_whitespace().next()?))
}

/// The kernel's answer to files, a line each.
fn answers(dir: &Path, files: &[(String, String)]) -> Vec<String> {
    for (name, text) in files {
        std::fs::write(dir.join(name), text).unwrap();
    }
    // As people call it, from beside the folder.
    let here = dir.parent().unwrap();
    let script = Path::new(dir.file_name().unwrap()).join("check.sh");
    let output = Command::new("sh").arg(script).current_dir(here).output().unwrap();
    let answers: Vec<String> = String::from_utf8(output.stdout).unwrap().lines().map(String::from).collect();
    let refused = answers.iter().any(|line| !line.starts_with("accepted "));
    assert_eq!(output.status.code(), Some(i32::from(refused)), "{}", String::from_utf8_lossy(&output.stderr));
    answers
}

/// Files of some claims with what they share.
fn files_of(made: &Proofs, ids: &[&str]) -> Vec<(String, String)> {
    let some: Vec<ClaimFile> = made.claims.iter().filter(|c| ids.contains(&c.claim.as_str())).cloned().collect();
    assert_eq!(some.len(), ids.len());
    Proofs { claims: some }.files()
}

/// The conclusion of every theorem with one more on its right side.
fn false_by_one(text: &str) -> String {
    let lines = text.lines().map(|line| match line.strip_suffix('.') {
        Some(conclusion) if line.starts_with("  ") => {
            let (left, right) = conclusion.split_once(" = ").unwrap();
            format!("  {left} = {right} + 1.\n")
        }
        _ => format!("{line}\n"),
    });
    lines.collect()
}

#[test]
fn what_was_accepted_is_what_is_written_now() {
    let made = all();
    let with = || made.claims.iter().filter(|c| c.theorems > 0);
    if let Ok(wish @ ("write" | "check")) = std::env::var("KERNEL").as_deref() {
        let version = version().expect("coqc is not installed");
        let dir = folder("kernel");
        let found = answers(&dir, &made.files());
        let (accepted, refused): (Vec<&String>, Vec<&String>) = found.iter().partition(|a| a.starts_with("accepted "));
        assert_eq!((accepted.len(), refused), (with().count(), vec![]));
        if wish == "write" {
            let lines: String = with().map(|c| accepted_line(c) + "\n").collect();
            std::fs::write("src/claims/kernel/accepted.txt", format!("{version}\n{lines}")).unwrap();
            return;
        }
    }
    let unseen: Vec<&str> = with().filter(|c| !is_accepted(c)).map(|c| c.claim.as_str()).collect();
    assert!(
        unseen.is_empty(),
        "no kernel has seen {unseen:?} as they are now: KERNEL=write cargo test --test claims kernel"
    );
}

#[test]
fn a_theorem_says_what_is_defined_where_it_holds_and_what_follows() {
    let claim = Claim::new("slip", Status::Proved, "a (* comment *) inside")
        .proof("by rows", &[("v", "r*(1 - e)*theta'"), ("v/r", "(1 - e)*theta'")], |s, _| {
            let derived =
                claims::DerivedFormulas::default().with_text("v", "z + r*theta' - e*r*theta'").with_text("z", "0");
            claims::prove(&derived, s)
        })
        .proof("by counting", &[("n", "2")], |_, _| claims::Outcome::Holds { cases: 1 });
    let made = proofs(&[claim]);
    let file = &made.claims[0];
    assert_eq!((file.theorems, file.left_out.as_slice()), (2, ["by counting".to_string()].as_slice()));
    assert!(file.text.starts_with("(* slip: a ( * comment * ) inside *)"));
    let second = "\
Theorem slip_2 :
  forall e r theta' v : R,
  v = ((r * theta') - ((e * r) * theta')) ->
  r <> 0 ->
  (v / r) = ((1 - e) * theta').
Proof. creepage. Qed.
";
    assert!(file.text.contains(second), "{}", file.text);
    assert!(!is_accepted(file));
}

#[test]
fn the_kernel_accepts_identities_and_refuses_them_false_by_one() {
    if version().is_none() {
        eprintln!("coqc is not installed: nothing was put to the kernel");
        return;
    }
    let made = all();
    // Sums of angles, arctangents, trailers, quotients of quotients, derivatives.
    let ids = ["eq-21", "group-law", "trailer-breaks", "trailer-recursion", "viscous-disk", "car-RT2"];
    let files = files_of(&made, &ids);
    let accepted = answers(&folder("accepted"), &files);
    assert!(accepted.len() == ids.len() && accepted.iter().all(|line| line.starts_with("accepted ")), "{accepted:#?}");
    let changed: Vec<(String, String)> = files
        .into_iter()
        .map(|(name, text)| {
            let shared = ["Creepage.v", "Brackets.v", "check.sh"].contains(&name.as_str());
            (name, if !shared { false_by_one(&text) } else { text })
        })
        .collect();
    let refused = answers(&folder("refused"), &changed);
    assert_eq!(refused.len(), ids.len());
    assert!(refused.iter().all(|line| line.starts_with("REFUSED ")), "{refused:#?}");
}

/// A file with the growth vector of a wheel behind an axle and a trailer, as the kernel is given it.
fn growth_of_two() -> Proofs {
    let claim = claims::all().into_iter().find(|c| c.id == "growth-trailers").unwrap();
    let made = proofs(&[claim]);
    assert_eq!(made.claims[0].left_out, Vec::<String>::new());
    made
}

#[test]
fn a_growth_vector_is_data_of_which_the_kernel_counts_the_brackets() {
    let made = growth_of_two();
    let file = &made.claims[0];
    assert_eq!(file.theorems, 15);
    assert!(file.text.contains("\nRequire Import Brackets.\nRequire Import Creepage.\n"));
    let axle = "\
(* regular_0: coordinates 0 x, 1 y, 2 phi *)
Open Scope polynomial_scope.
Definition regular_0 := {|
  coordinates := 3;
  rows := [
    [sine 2; (- (cosine 2)); number 0]];
  fields := [
    [cosine 2; sine 2; number 0];
    [number 0; number 0; number 1]];
  integrals := [];
  configuration := [Length 0; Length 0; Angle (4 # 5) (3 # 5)]
|}.
Close Scope polynomial_scope.
Theorem regular_0_growth :
  has_growth regular_0 1 [2; 3]%nat.
Proof. growth. Qed.
";
    assert!(file.text.contains(axle), "{}", file.text);
}

#[test]
fn what_has_no_theorem_says_why() {
    let all = claims::all();
    let reason = |id: &str| {
        let claim = all.iter().find(|c| c.id == id).unwrap().clone();
        let made = proofs(&[claim]);
        made.claims[0].left_out.concat()
    };
    assert!(reason("growth-table").ends_with("(of ackermann a coefficient is a root)"));
    assert!(reason("E21").ends_with("(the constraints of a list are counted by their type)"));
    assert!(reason("growth-platforms").ends_with("(a signature is found among all sets of rows, by the rank of each)"));
}

/// The kernel's answers to the first distribution of a file with something in it changed.
fn answer_to(folder_name: &str, change: impl Fn(&str) -> String) -> String {
    let made = growth_of_two();
    let files: Vec<(String, String)> = made
        .files()
        .into_iter()
        .map(|(name, text)| match name.as_str() {
            "growth_trailers.v" => {
                // Two distributions are enough.
                let end = text.match_indices("Qed.").nth(1).unwrap().0 + "Qed.".len();
                (name, change(&text[..end]))
            }
            _ => (name, text),
        })
        .collect();
    let answers = answers(&folder(folder_name), &files);
    assert_eq!(answers.len(), 1);
    answers[0].split_whitespace().next().unwrap().to_string()
}

#[test]
fn the_kernel_refuses_a_growth_vector_of_other_fields_rows_integrals_or_places() {
    if version().is_none() {
        eprintln!("coqc is not installed: nothing was put to the kernel");
        return;
    }
    assert_eq!(answer_to("growth", str::to_string), "accepted");
    let changes = [
        // A field that is no motion; a dimension; the rank; an integral that is none; a place on no circle.
        ("[cosine 2; sine 2; number 0]", "[cosine 2; sine 2; number 1]", "accepted"),
        ("[cosine 2; sine 2; number 0]", "[cosine 2; cosine 2; number 0]", "REFUSED"),
        ("has_growth regular_1 2 [2; 3; 4]", "has_growth regular_1 2 [2; 4]", "REFUSED"),
        ("has_growth regular_1 2 [2; 3; 4]", "has_growth regular_1 3 [2; 3; 4]", "REFUSED"),
        ("integrals := []", "integrals := [coordinate 2]", "REFUSED"),
        ("Angle (4 # 5) (3 # 5)", "Angle (4 # 5) (4 # 5)", "REFUSED"),
        ("[number 0; number 0; number 1]", "[number 0; number 0; number 0]", "REFUSED"),
    ];
    for (i, (from, to, answer)) in changes.into_iter().enumerate() {
        let change = |text: &str| {
            assert!(text.contains(from), "{from}");
            text.replacen(from, to, 1)
        };
        assert_eq!(answer_to(&format!("growth-{i}"), change), answer, "{from} as {to}");
    }
}
