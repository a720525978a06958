//! The journal of a sweep: rows beside the output, with a checksum, from which a later run goes on after a kill.

use super::table::Format;
use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How often the state is noted, at most; what was done since is done again after a kill.
const NOTE_INTERVAL: Duration = Duration::from_millis(100);

/// Rows already computed, and how far they can be trusted.
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    state: State,
    checksum: crc32fast::Hasher,
    noted: Instant,
    /// Cases that were there when the journal was opened.
    pub found: usize,
}

/// What is true of the first bytes of the journal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct State {
    identity: String,
    cases: usize,
    bytes: u64,
    checksum: u32,
    undefined: usize,
    not_converged: usize,
}

impl Journal {
    /// Opens the journal of an output, and goes on with it when it is of the same sweep and part.
    pub fn open(out: &Path, identity: &str, header: &[u8]) -> Result<Self> {
        let path = beside(out, ".partial");
        let wrong = |e: &io::Error| unwritable(&path, e);
        let file = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
        let mut file = file.map_err(|e| wrong(&e))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                return Err(Error::input("is being written by another sweep").at_file(&path).help("wait for it"));
            }
            // A file system without locks.
            Err(TryLockError::Error(_)) => {}
        }
        let state = kept(&path, &mut file, identity).map_err(|e| wrong(&e))?;
        let (state, checksum) = state.unwrap_or_else(|| (State::new(identity), crc32fast::Hasher::new()));
        file.set_len(state.bytes).and_then(|()| file.seek(SeekFrom::End(0))).map_err(|e| wrong(&e))?;
        let found = state.cases;
        let mut journal = Self { path, file, state, checksum, noted: Instant::now(), found };
        if journal.state.bytes == 0 {
            journal.append(header, 0, [0; 2])?;
        }
        Ok(journal)
    }

    /// Cases that are in it.
    pub fn cases(&self) -> usize {
        self.state.cases
    }

    /// How many cases are undefined, and how many have not converged.
    pub fn troubles(&self) -> [usize; 2] {
        [self.state.undefined, self.state.not_converged]
    }

    /// Adds the rows of the next cases.
    pub fn append(&mut self, bytes: &[u8], cases: usize, [undefined, not_converged]: [usize; 2]) -> Result<()> {
        self.file.write_all(bytes).map_err(|e| unwritable(&self.path, &e))?;
        self.checksum.update(bytes);
        self.state.bytes += bytes.len() as u64;
        self.state.cases += cases;
        self.state.undefined += undefined;
        self.state.not_converged += not_converged;
        if self.noted.elapsed() >= NOTE_INTERVAL {
            self.note()?;
        }
        Ok(())
    }

    /// Notes how far the file is good.
    pub fn note(&mut self) -> Result<()> {
        self.state.checksum = self.checksum.clone().finalize();
        let text = serde_json::to_string(&self.state).map_err(|e| Error::run(e.to_string()))?;
        let (path, new) = (note_of(&self.path), beside(&note_of(&self.path), ".new"));
        fs::write(&new, text).and_then(|()| fs::rename(&new, &path)).map_err(|e| unwritable(&path, &e))?;
        self.noted = Instant::now();
        Ok(())
    }

    /// Puts the finished table in its place.
    pub fn finish(mut self, out: &Path, format: Format, columns: &[String]) -> Result<()> {
        self.note()?;
        self.file.sync_all().map_err(|e| unwritable(&self.path, &e))?;
        match format {
            Format::Csv => crate::files::put_in_place(&self.path, out)?,
            Format::Parquet => {
                finish_parquet(&mut self.file, out, columns)?;
                fs::remove_file(&self.path).map_err(|e| unwritable(&self.path, &e))?;
            }
        }
        drop(fs::remove_file(note_of(&self.path)));
        Ok(())
    }
}

#[cfg(feature = "parquet")]
fn finish_parquet(journal: &mut File, out: &Path, columns: &[String]) -> Result<()> {
    journal.seek(SeekFrom::Start(0)).map_err(|e| unwritable(out, &e))?;
    super::parquet::write(journal, out, columns)
}

#[cfg(not(feature = "parquet"))]
fn finish_parquet(_: &mut File, out: &Path, _: &[String]) -> Result<()> {
    Format::of(out).map(|_| ())
}

impl State {
    fn new(identity: &str) -> Self {
        Self { identity: identity.into(), cases: 0, bytes: 0, checksum: 0, undefined: 0, not_converged: 0 }
    }
}

/// The state of a journal whose bytes are what it says; none where there is nothing to go on with.
fn kept(path: &Path, file: &mut File, identity: &str) -> io::Result<Option<(State, crc32fast::Hasher)>> {
    let Ok(text) = fs::read_to_string(note_of(path)) else { return Ok(None) };
    let Ok(state) = serde_json::from_str::<State>(&text) else { return Ok(None) };
    if state.identity != identity || file.metadata()?.len() < state.bytes {
        return Ok(None);
    }
    let (mut checksum, mut left) = (crc32fast::Hasher::new(), state.bytes);
    let mut buffer = vec![0; 1 << 16];
    file.seek(SeekFrom::Start(0))?;
    while left > 0 {
        let most = buffer.len().min(usize::try_from(left).unwrap_or(usize::MAX));
        let read = file.read(&mut buffer[..most])?;
        if read == 0 {
            return Ok(None);
        }
        checksum.update(&buffer[..read]);
        left -= read as u64;
    }
    let good = checksum.clone().finalize() == state.checksum;
    Ok(good.then_some((state, checksum)))
}

fn note_of(path: &Path) -> PathBuf {
    beside(path, ".json")
}

fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(suffix);
    name.into()
}

fn unwritable(path: &Path, why: &io::Error) -> Error {
    crate::files::unwritable(path, why)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What was counted before a kill is counted after it.
    #[test]
    fn counts_add_up_over_kills() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("table.csv");
        let mut cases = 0;
        for (rows, troubles) in [("a\nb\nc\n", [1, 2]), ("d\n", [0, 1]), ("e\nf\n", [2, 0])] {
            let mut journal = Journal::open(&out, "this sweep", b"header\n").unwrap();
            assert_eq!((journal.found, journal.cases()), (cases, cases));
            cases += rows.lines().count();
            journal.append(rows.as_bytes(), rows.lines().count(), troubles).unwrap();
            journal.note().unwrap();
        }
        let last = Journal::open(&out, "this sweep", b"header\n").unwrap();
        assert_eq!((last.cases(), last.troubles()), (6, [3, 3]));
        drop(last);
        let other = Journal::open(&out, "another sweep", b"header\n").unwrap();
        assert_eq!((other.cases(), other.troubles()), (0, [0, 0]));
    }
}
