//! The tests that were built, and how one process with some of them is run.

use crate::Places;
use crate::build::{cargo, command};
use serde_json::Value;
use std::fs::Permissions;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// Beginnings of the paths of the three layers below the rest.
const BELOW: [&str; 3] = ["src/formula", "src/mechanism", "src/claims"];

/// Beginnings of the tests, `binary::test`, that hardly concern the three layers and take long.
const LEFT_OUT: [&str; 9] = [
    "discovery::fit_statistics",
    "discovery::laws",
    "discovery::names",
    "discovery::next_experiment",
    "discovery::simulator_laws",
    "discovery::trust_small",
    "discovery::unnamed",
    "motion::sensitivity",
    "reports::html",
];

/// The same for the layers above: what takes minutes.
const LEFT_OUT_ABOVE: [&str; 3] = ["claims::ledger", "discovery::trust_small", "motion::cost_of_trailers"];

/// The variable that says which share of its cases a property tries.
pub const ONE_IN: &str = "MUTATION_ONE_IN";

/// What stands for a binary of tests where a claim is verified: `creepage verify` exits as the ledger's test does.
pub const CLAIM: &str = "claim";

/// What stands for a binary of tests where the examples of the documentation are run, and for all of them.
pub const DOCTESTS: &str = "doctests";

/// The tests beside what they test.
const LIBRARY: &str = "creepage";

/// The same in the program: both targets have one name.
const PROGRAM: &str = "program";

/// The seed and cases of `every_stated_status_is_earned_and_every_sabotage_noticed`.
const AS_IN_THE_LEDGER_TEST: [&str; 6] = ["verify", "--quiet", "--cases", "40", "--seed", "3"];

/// How a process ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    Passed,
    Failed,
    TooLong,
}

/// Builds the tests, or only the binaries that some tests are in: names and paths of the binaries.
pub fn binaries(at: &Places, only: &[&str]) -> Vec<(String, String)> {
    let only: Vec<&str> = only.iter().map(|o| o.split("::").next().unwrap()).collect();
    let mut wanted = vec!["test".to_string(), "--no-run".into()];
    for (name, target) in [(LIBRARY, "--lib"), (PROGRAM, "--bins")] {
        wanted.extend((only.is_empty() || only.contains(&name)).then(|| target.into()));
    }
    let folder = std::fs::read_dir(at.root.join("tests")).unwrap().map(|f| f.unwrap().path());
    let mut names: Vec<String> = folder
        .filter(|f| f.extension().is_some_and(|e| e == "rs") || f.join("main.rs").is_file())
        .map(|f| f.file_stem().unwrap().to_str().unwrap().to_string())
        .filter(|name| only.is_empty() || only.contains(&name.as_str()))
        .collect();
    names.sort();
    wanted.extend(names.iter().map(|name| format!("--test={name}")));
    if wanted.len() == 2 {
        // Without a name cargo would build them all.
        return vec![];
    }
    let made = cargo(at, &wanted.iter().map(String::as_str).collect::<Vec<_>>());
    let lines = String::from_utf8(made.stdout).unwrap();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    let binary = |v: Value| {
        let name = if v["target"]["kind"][0] == "bin" { PROGRAM } else { v["target"]["name"].as_str()? };
        (v["profile"]["test"] == true).then_some((name.to_string(), v["executable"].as_str()?.to_string()))
    };
    lines.lines().filter_map(|l| binary(serde_json::from_str(l).ok()?)).collect()
}

/// Whether a test, `binary::test`, is asked about these mutants; one that is named is asked in any case.
pub fn is_asked(at: &Places, only: &[&str], test: &str) -> bool {
    if !only.is_empty() {
        return is_one_of(test, only);
    }
    let left_out: &[&str] = if is_below(at) { &LEFT_OUT } else { &LEFT_OUT_ABOVE };
    !is_one_of(test, left_out)
}

/// Whether a test is one of some, or in a module or binary of them.
pub fn is_one_of(test: &str, some: &[&str]) -> bool {
    some.iter().any(|s| test.strip_prefix(s).is_some_and(|rest| rest.is_empty() || rest.starts_with("::")))
}

/// Whether only layers are mutated that the claims are about.
fn is_below(at: &Places) -> bool {
    at.files.iter().all(|f| BELOW.iter().any(|b| f.starts_with(b)))
}

/// The program itself, and the claims it knows.
pub fn claims(at: &Places) -> (String, Vec<String>) {
    let path = at.file("target/schemata/creepage").to_str().unwrap().to_string();
    let made = Command::new(&path).args(["claims", "--format", "json"]).current_dir(at.copy()).output().unwrap();
    let listed: Value = serde_json::from_slice(&made.stdout).expect("creepage claims --format json");
    let listed = listed["claims"].as_array().or(listed.as_array()).unwrap();
    (path, listed.iter().map(|c| c["id"].as_str().unwrap().to_string()).collect())
}

/// The examples of the documentation in one program, kept instead of run.
///
/// Keeping it is unstable; the variable that allows it is for rustdoc alone, else all that is below would be built anew.
pub fn doctests(at: &Places) -> (String, Vec<String>) {
    let (script, folder) = (at.file("rustdoc"), at.file(DOCTESTS));
    let text = format!(
        "#!/bin/sh\nRUSTC_BOOTSTRAP=1 exec rustdoc \"$@\" -Zunstable-options --no-run --persist-doctests '{}'\n",
        folder.display()
    );
    std::fs::write(&script, text).unwrap();
    std::fs::set_permissions(&script, Permissions::from_mode(0o755)).unwrap();
    std::fs::create_dir_all(&folder).unwrap();
    let made = command(at, &["test", "--doc"]).env("RUSTDOC", script).output().unwrap();
    assert!(made.status.success(), "{}", String::from_utf8_lossy(&made.stderr));
    // Those that could not be in one program with the others would lie beside it.
    let programs: Vec<_> = std::fs::read_dir(folder).unwrap().map(|f| f.unwrap().path().join("rust_out")).collect();
    assert_eq!(programs.len(), 1, "{programs:?}");
    (programs[0].to_str().unwrap().to_string(), vec!["all".into()])
}

/// The tests of a binary that are not ignored.
pub fn tests(at: &Places, path: &str) -> Vec<String> {
    let made = Command::new(path).args(["--list", "--format=terse"]).current_dir(at.copy()).output().unwrap();
    let text = String::from_utf8(made.stdout).unwrap();
    text.lines().filter_map(|l| l.strip_suffix(": test").map(String::from)).collect()
}

/// Runs some tests of a binary or verifies claims, with a limit of processor time in seconds; says how long it took.
pub fn run(at: &Places, path: &str, tests: &[&str], variables: &[(&str, &str)], seconds: u64) -> (End, Duration) {
    let (how, tests): (&[&str], &[&str]) = match path {
        _ if path.ends_with("/creepage") => (&AS_IN_THE_LEDGER_TEST, tests),
        _ if path.ends_with("/rust_out") => (&[], &[]),
        _ => (&["--exact"], tests),
    };
    // Limits of memory (KiB) and processor time: what loops for ever is stopped, on a busy machine no earlier.
    let limits = format!("ulimit -v 4000000; ulimit -t {seconds}; exec \"$@\"");
    let mut command = Command::new("sh");
    command.args(["-c", &limits, "sh", path]).args(how).args(tests).current_dir(at.copy());
    command.env_remove("MUTANT").env_remove("MUTANT_REACH").envs(variables.iter().copied());
    command.env("INSTA_UPDATE", "no").env("INSTA_WORKSPACE_ROOT", at.copy()).env("RAYON_NUM_THREADS", "2");
    command.env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "1").env("RUST_BACKTRACE", "0");
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).process_group(0);
    let started = Instant::now();
    let mut child = command.spawn().unwrap();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait().unwrap() {
            return (end(status), started.elapsed());
        }
        // On a machine that is busy a process may get a hundredth of a core: real time says nothing before this.
        if started.elapsed() > Duration::from_secs(400 * seconds) {
            let _ = Command::new("kill").args(["-9", "--", &format!("-{}", child.id())]).status();
            let _ = child.wait();
            return (End::TooLong, started.elapsed());
        }
        std::thread::sleep(pause);
        pause = (pause * 5 / 4).min(Duration::from_millis(40));
    }
}

fn end(status: ExitStatus) -> End {
    const KILLED: i32 = 9;
    const TOO_LONG: i32 = 24;
    match (status.success(), status.signal()) {
        (true, _) => End::Passed,
        (_, Some(KILLED | TOO_LONG)) => End::TooLong,
        _ => End::Failed,
    }
}
