//! Mutation testing with every mutant in one build, chosen when a test is run. See book/src/development/mutants.md.

mod build;
mod listed;
mod places;
mod reach;
mod rewrite;
mod run;
mod table;
mod units;

use std::path::PathBuf;

/// Where everything lies.
pub struct Places {
    /// The package under test.
    pub root: PathBuf,
    /// A folder outside it: the copy, its build and the results.
    pub scratch: PathBuf,
    /// Beginnings of the paths of the files that are mutated; none for all.
    pub files: Vec<String>,
    /// Which of how many parts of the mutants.
    pub shard: (u64, u64),
}

impl Places {
    /// The rewritten copy of the package.
    pub fn copy(&self) -> PathBuf {
        self.scratch.join("copy")
    }

    /// A file of results.
    pub fn file(&self, name: &str) -> PathBuf {
        self.scratch.join(name)
    }

    /// The text of a file of results, empty when there is none.
    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.file(name)).unwrap_or_default()
    }
}

const USAGE: &str = "usage: mutation [--files PATH,PATH] [--shard I/N] \
                     [build | reach [TESTS] | run SECONDS PART OF | table]";

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (files, words) = match words[..] {
        ["--files", files, ..] => (files.split(',').map(String::from).collect(), &words[2..]),
        _ => (Vec::new(), &words[..]),
    };
    let (shard, words) = match *words {
        ["--shard", shard, ..] => (listed::shard(shard).expect("--shard I/N with I < N"), &words[2..]),
        _ => ((0, 1), words),
    };
    let scratch = std::env::var("MUTATION_SCRATCH").unwrap_or_else(|_| "/tmp/creepage-mutation".into());
    let root = std::fs::canonicalize(std::env::var("MUTATION_ROOT").unwrap_or_else(|_| ".".into())).unwrap();
    let at = Places { root, scratch: scratch.into(), files, shard };
    match *words {
        [] => {
            build::make(&at);
            reach::measure(&at, &[]);
            run::ROUNDS.into_iter().for_each(|seconds| run::run(&at, seconds, 0, 1));
            table::print(&at);
        }
        ["build"] => build::make(&at),
        ["reach", ref only @ ..] => reach::measure(&at, only),
        ["run", seconds, part, of] => {
            run::run(&at, seconds.parse().unwrap(), part.parse().unwrap(), of.parse().unwrap());
        }
        ["table"] => table::print(&at),
        _ => eprintln!("{USAGE}"),
    }
}
