//! Disks that are full, paths that are no files, files that change while they are read.
#![cfg(unix)]

use std::ffi::{OsStr, OsString};
use std::fs;
use std::os::unix::ffi::OsStringExt;
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use tempfile::TempDir;

const MODEL: &str = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n";
const HEADER: &str = "time,x,y,heading,wheel_rate,yaw_rate\n";

fn rows(n: usize) -> String {
    (0..n).map(|i| format!("{0},{0},0,0,1,0.1\n", 0.001 * i as f64)).collect()
}

fn folder() -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("model.toml"), MODEL).unwrap();
    fs::write(dir.path().join("run.csv"), format!("{HEADER}{}", rows(60))).unwrap();
    dir
}

fn creepage<S: AsRef<OsStr>>(dir: &Path, arguments: &[S]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_creepage"));
    command.current_dir(dir).args(arguments).stdin(Stdio::null()).output().unwrap()
}

/// A shell runs the command; `{}` stands for it.
fn shell(dir: &Path, line: &str) -> Output {
    let line = line.replace("{}", env!("CARGO_BIN_EXE_creepage"));
    Command::new("sh").current_dir(dir).args(["-c", &line]).stdin(Stdio::null()).output().unwrap()
}

/// The one message of a failure, with the exit code it must have.
fn refused(output: &Output, code: i32) -> String {
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(code), "{message}");
    assert_eq!(message.trim_end().lines().count(), 1, "{message}");
    assert!(message.starts_with("creepage: "), "{message}");
    message
}

fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

const SIMULATE: &str = "{} simulate model.toml --inputs run.csv --out path.csv";

#[test]
fn a_full_disk_leaves_the_older_result_and_nothing_else() {
    let writers = [
        (SIMULATE, "path.csv"),
        ("{} figures fig2 --out .", "fig2.svg"),
        ("{} discover run.csv --model model.toml --out .", "report.html"),
    ];
    for (line, file) in writers {
        let dir = folder();
        fs::write(dir.path().join(file), "older").unwrap();
        let before = names(dir.path());
        // A file may not grow beyond a kilobyte; the signal that would end the process is ignored.
        let message = refused(&shell(dir.path(), &format!("trap '' XFSZ; ulimit -f 1; exec {line}")), 1);
        assert!(message.contains("cannot be written") && message.contains("nothing was changed"), "{message}");
        assert_eq!(fs::read_to_string(dir.path().join(file)).unwrap(), "older");
        assert_eq!(names(dir.path()), before, "{line}");
    }
}

#[test]
fn a_full_disk_behind_standard_output_is_told() {
    let dir = folder();
    for line in ["describe model.toml", "vehicles", "effects", "claims", "effects --vehicle car", SIMULATE] {
        let line = line.trim_start_matches("{} ");
        let message = refused(&shell(dir.path(), &format!("{{}} {line} > /dev/full")), 1);
        assert!(message.contains("standard output cannot be written"), "{line}: {message}");
    }
    // A reader that has seen enough is no error.
    let output = shell(dir.path(), "{ {} claims; echo $? >&2; } | head -n 1");
    assert_eq!(String::from_utf8_lossy(&output.stderr), "0\n");
}

#[test]
fn a_full_disk_behind_standard_error_leaves_the_exit_code() {
    let dir = folder();
    assert_eq!(shell(dir.path(), "{} describe none.toml 2> /dev/full").status.code(), Some(2));
    assert_eq!(shell(dir.path(), "{} verify nothing 2> /dev/full").status.code(), Some(2));
}

#[test]
fn threads_that_cannot_be_started_are_told() {
    let dir = folder();
    for kilobytes in [400_000, 1_000_000, 1_500_000] {
        let line =
            format!("ulimit -v {kilobytes}; exec {{}} discover run.csv --model model.toml --out report --threads 1024");
        let message = refused(&shell(dir.path(), &line), 1);
        assert!(message.contains("no threads could be started"), "{message}");
    }
    assert!(!dir.path().join("report").exists());
}

#[test]
fn outputs_that_are_no_files_are_refused_and_kept() {
    let dir = folder();
    let at = |name: &str| dir.path().join(name);
    fs::create_dir_all(at("folder/report.json")).unwrap();
    fs::create_dir(at("plain")).unwrap();
    symlink("ring", at("ring")).unwrap();
    symlink("none", at("broken")).unwrap();
    let before = names(dir.path());
    for (out, says) in [
        ("plain", "is a folder"),
        ("ring", "a link that leads to nothing"),
        ("broken", "a link that leads to nothing"),
        ("none/path.csv", "its folder does not exist"),
        ("run.csv/path.csv", "a part of its path is not a folder"),
    ] {
        let message =
            refused(&creepage(dir.path(), &["simulate", "model.toml", "--inputs", "run.csv", "--out", out]), 2);
        assert!(message.contains(says), "{out}: {message}");
    }
    for (out, says) in [
        ("folder", "is a folder"),
        ("ring", "a link that leads to nothing"),
        ("broken", "a link that leads to nothing"),
        ("run.csv", "is a file, not a folder"),
    ] {
        let message =
            refused(&creepage(dir.path(), &["discover", "run.csv", "--model", "model.toml", "--out", out]), 2);
        assert!(message.contains(says), "{out}: {message}");
    }
    assert_eq!(names(dir.path()), before);
    assert_eq!(names(&at("folder")), ["report.json"]);
}

#[test]
fn inputs_that_are_no_files_are_refused() {
    let dir = folder();
    symlink("ring", dir.path().join("ring")).unwrap();
    for bad in ["ring", "/dev/zero", "/dev/null", ".", "none"] {
        for line in [
            &["simulate", bad, "--inputs", "run.csv", "--out", "o"][..],
            &["simulate", "model.toml", "--inputs", bad, "--out", "o"],
            &["discover", bad, "--model", "model.toml", "--out", "o"],
            &["describe", bad],
            &["effects", "--effects", bad],
            &["verify", "--claims", bad],
        ] {
            let message = refused(&creepage(dir.path(), line), 2);
            assert!(message.contains(&format!("{bad}: ")), "{line:?}: {message}");
        }
    }
    assert_eq!(names(dir.path()), ["model.toml", "ring", "run.csv"]);
}

#[test]
fn pipes_are_read_and_written() {
    let dir = folder();
    let plain = shell(dir.path(), SIMULATE);
    assert!(plain.status.success(), "{plain:?}");
    let piped = shell(
        dir.path(),
        "mkfifo in out && (cat run.csv > in &) && (cat out > got.csv &) && {} simulate model.toml --inputs in --out out \
         && rm in out && sleep 0.5",
    );
    assert!(piped.status.success(), "{piped:?}");
    let read = |name: &str| fs::read_to_string(dir.path().join(name)).unwrap();
    assert_eq!(read("path.csv"), read("got.csv"));
}

#[test]
fn paths_need_not_be_unicode() {
    let dir = folder();
    let odd = |name: &str| OsString::from_vec([name.as_bytes(), b"\xff"].concat());
    fs::rename(dir.path().join("model.toml"), dir.path().join(odd("model"))).unwrap();
    fs::rename(dir.path().join("run.csv"), dir.path().join(odd("run"))).unwrap();
    let plain = |word: &str| OsString::from(word);
    let simulate = [plain("simulate"), odd("model"), plain("--inputs"), odd("run"), plain("--out"), odd("path")];
    let discover = [plain("discover"), odd("run"), plain("--model"), odd("model"), plain("--out"), odd("report")];
    for arguments in [&simulate, &discover] {
        let output = creepage(dir.path(), arguments);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
    }
    assert!(dir.path().join(odd("path")).is_file() && dir.path().join(odd("report")).join("report.json").is_file());
    let output = creepage(dir.path(), &[plain("describe"), odd("nothing")]);
    refused(&output, 2);
}

/// Another process writes the log anew, cuts it off and removes it, again and again.
#[test]
fn a_log_that_changes_while_it_is_read_is_read_or_refused() {
    let dir = folder();
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let path = dir.path().join("run.csv");
            let whole = format!("{HEADER}{}", rows(4000));
            for i in 0.. {
                let cut = (i * 7919) % whole.len();
                fs::write(&path, &whole).unwrap();
                fs::write(&path, &whole.as_bytes()[..cut]).unwrap();
                if i % 3 == 0 {
                    fs::remove_file(&path).unwrap();
                }
                if stop.load(Ordering::Relaxed) {
                    return;
                }
            }
        });
        let (mut good, mut bad) = (0, 0);
        for _ in 0..20 {
            let output = shell(dir.path(), SIMULATE);
            match output.status.code() {
                Some(0) => good += 1,
                _ => {
                    let message = refused(&output, 2);
                    assert!(message.contains("run.csv"), "{message}");
                    bad += 1;
                }
            }
        }
        stop.store(true, Ordering::Relaxed);
        println!("read {good} times, refused {bad} times");
        assert!(bad > 0, "the file was never seen half written");
    });
}
