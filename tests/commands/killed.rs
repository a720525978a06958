//! Commands that are killed at any moment: every output is the older one or the new one whole, and nothing is lost.
#![cfg(unix)]

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// What a folder holds.
type Files = BTreeMap<String, Vec<u8>>;

const MODEL: &str = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.5\n";

/// A log of some rows at a wheel rate.
fn log(rows: usize, rate: f64) -> String {
    let row = |i: usize| format!("{0},{0},0,0,{rate},0.1\n", i as f64 * 0.1);
    format!("time,x,y,heading,wheel_rate,yaw_rate\n{}", (0..rows).map(row).collect::<String>())
}

/// A command that writes, with arguments for an older and for a new result.
struct Writer {
    name: &'static str,
    older: &'static [&'static str],
    newer: &'static [&'static str],
}

/// Every command that writes into `out`; one that is added to the program belongs here.
const WRITERS: [Writer; 5] = [
    Writer {
        name: "discover",
        older: &["discover", "short.csv", "--model", "model.toml", "--out", "out"],
        newer: &["discover", "short.csv", "--model", "other.toml", "--out", "out"],
    },
    Writer {
        name: "simulate",
        older: &["simulate", "model.toml", "--inputs", "older.csv", "--out", "out/path.csv"],
        newer: &["simulate", "model.toml", "--inputs", "newer.csv", "--out", "out/path.csv"],
    },
    Writer {
        name: "figures",
        older: &["figures", "fig1", "fig2", "fig3", "fig5", "--out", "out"],
        newer: &["figures", "fig1", "fig2", "fig3", "fig5", "--e-rc=0.05", "--e-tc=-0.03", "--out", "out"],
    },
    Writer {
        name: "plan",
        older: &["plan", "model.toml", "--goal", "1,0,0", "--pieces", "6", "--out", "out/plan.csv"],
        newer: &["plan", "other.toml", "--goal", "1,0,0", "--pieces", "6", "--out", "out/plan.csv"],
    },
    Writer {
        name: "fleet",
        older: &["fleet", "join", "older-rows", "--out", "out"],
        newer: &["fleet", "join", "newer-rows", "--out", "out"],
    },
];

/// The rows that `fleet join` reads.
const ROWS: [(&str, &str); 2] = [("older-rows", "older-fleet.csv"), ("newer-rows", "newer-fleet.csv")];

fn start(dir: &Path, arguments: &[&str]) -> Child {
    let mut command = Command::new(env!("CARGO_BIN_EXE_creepage"));
    command.current_dir(dir).args(arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

fn files(dir: &Path) -> Files {
    let entries = fs::read_dir(dir).unwrap().map(Result::unwrap);
    entries.filter_map(|e| Some((e.file_name().into_string().unwrap(), fs::read(e.path()).ok()?))).collect()
}

/// The lengths of the files in a folder.
fn lengths(dir: &Path) -> BTreeMap<std::ffi::OsString, u64> {
    let entries = fs::read_dir(dir).unwrap().flatten();
    entries.filter_map(|e| Some((e.file_name(), e.metadata().ok()?.len()))).collect()
}

fn put(dir: &Path, files: &Files) {
    drop(fs::remove_dir_all(dir));
    fs::create_dir(dir).unwrap();
    files.iter().for_each(|(name, bytes)| fs::write(dir.join(name), bytes).unwrap());
}

/// A folder with inputs, and what the command leaves in `out` before and after.
struct Bench {
    dir: tempfile::TempDir,
    older: Files,
    newer: Files,
    took: Duration,
}

impl Bench {
    fn of(writer: &Writer) -> Self {
        let dir = tempfile::tempdir().unwrap();
        let inputs = [
            ("model.toml", MODEL.to_string()),
            ("other.toml", MODEL.replace("0.5", "0.6")),
            ("short.csv", log(12, 1.0)),
            ("older.csv", log(20_000, 1.0)),
            ("newer.csv", log(20_000, 2.0)),
            ("older-fleet.csv", "robot,log,model\na,short.csv,model.toml\n".into()),
            ("newer-fleet.csv", "robot,log,model\na,short.csv,model.toml\nb,short.csv,other.toml\n".into()),
        ];
        inputs.iter().for_each(|(name, text)| fs::write(dir.path().join(name), text).unwrap());
        for (rows, manifest) in ROWS.iter().filter(|_| writer.name == "fleet") {
            assert!(start(dir.path(), &["fleet", "map", manifest, "--out", rows]).wait().unwrap().success());
        }
        let out = dir.path().join("out");
        fs::create_dir(&out).unwrap();
        assert!(start(dir.path(), writer.older).wait().unwrap().success(), "{}", writer.name);
        let older = files(&out);
        let begin = Instant::now();
        assert!(start(dir.path(), writer.newer).wait().unwrap().success(), "{}", writer.name);
        let (newer, took) = (files(&out), begin.elapsed());
        assert!(older.keys().eq(newer.keys()) && older != newer);
        Self { dir, older, newer, took }
    }

    /// Panics unless every file is whole, and the older ones are somewhere. Says whether any file is new.
    fn check(&self, name: &str) -> bool {
        let found = files(&self.dir.path().join("out"));
        for (file, older) in &self.older {
            let bytes = found.get(file).unwrap_or_else(|| panic!("{name}: {file} is gone"));
            let whole = bytes == older || *bytes == self.newer[file];
            assert!(whole, "{name}: {file} is neither the older nor the new one, {} bytes", bytes.len());
        }
        let new = |file: &String| found[file] == self.newer[file];
        let done = self.older.keys().all(new);
        // A mixture comes only of a kill between two renames; then the older files still have their second names.
        let kept = self.older.values().all(|older| found.values().any(|bytes| bytes == older));
        assert!(done || kept, "{name}: a part of the older result is lost");
        self.older.keys().any(|file| new(file) && self.older[file] != self.newer[file])
    }
}

/// Kills the command at moments drawn from a seed, over and over.
#[test]
fn a_kill_at_any_moment_leaves_whole_files() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    for writer in &WRITERS {
        let bench = Bench::of(writer);
        let (mut killed, mut replaced) = (0, 0);
        for _ in 0..25 {
            put(&bench.dir.path().join("out"), &bench.older);
            let mut child = start(bench.dir.path(), writer.newer);
            std::thread::sleep(bench.took.mul_f64(rng.random_range(0.0..1.1)));
            drop(child.kill());
            killed += u32::from(child.wait().unwrap().code().is_none());
            replaced += u32::from(bench.check(writer.name));
        }
        println!("{}: killed {killed} of 25 times, the new result was there {replaced} times", writer.name);
        assert!(killed > 0, "{}: it was always faster than the kill", writer.name);
    }
}

/// Kills the command as soon as something changes in the folder: while it writes.
#[test]
fn a_kill_while_writing_leaves_whole_files() {
    for writer in &WRITERS {
        let bench = Bench::of(writer);
        let out = bench.dir.path().join("out");
        let mut while_writing = 0;
        for round in 0..12u32 {
            put(&out, &bench.older);
            let before = lengths(&out);
            let mut child = start(bench.dir.path(), writer.newer);
            // From the first change of a name or a length on, a little later each time.
            while lengths(&out) == before && child.try_wait().unwrap().is_none() {}
            let begin = Instant::now();
            while begin.elapsed() < Duration::from_micros(u64::from(round) * 60) {}
            drop(child.kill());
            while_writing += u32::from(child.wait().unwrap().code().is_none());
            bench.check(writer.name);
        }
        println!("{}: killed while writing {while_writing} of 12 times", writer.name);
        assert!(while_writing > 0, "{}: it was always faster than the kill", writer.name);
    }
}

/// The next run is not hurt by what a killed one left behind.
#[test]
fn what_a_kill_leaves_behind_hurts_no_later_run() {
    let writer = &WRITERS[1];
    let bench = Bench::of(writer);
    let out = bench.dir.path().join("out");
    put(&out, &bench.older);
    fs::write(out.join(".creepage-left"), b"half").unwrap();
    assert!(start(bench.dir.path(), writer.newer).wait().unwrap().success());
    assert_eq!(files(&out)["path.csv"], bench.newer["path.csv"]);
}
