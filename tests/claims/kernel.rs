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
            let theorem = name.ends_with(".v") && name != "Creepage.v";
            (name, if theorem { false_by_one(&text) } else { text })
        })
        .collect();
    let refused = answers(&folder("refused"), &changed);
    assert_eq!(refused.len(), ids.len());
    assert!(refused.iter().all(|line| line.starts_with("REFUSED ")), "{refused:#?}");
}
