//! Several files written into a folder together: all of them are renamed into their places, or none stays.

use super::atomic_write::{buffered, builder, prepared};
use super::output_path::{folder_of, is_link, target, unwritable};
use crate::error::{Error, Result};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use tempfile::{NamedTempFile, TempPath};

/// Writes several files into a folder, which is made when missing: all of them, or none.
///
/// The names are plain file names. Every file is first written beside its place; when one of the
/// final renames fails, those already done are undone. Only a crash between two renames can leave a
/// mixture, and even then every single file is whole.
///
/// # Errors
/// As [`write_whole`](crate::files::write_whole), for the folder and each of the files; the folder is then as it was before.
///
/// ```
/// use creepage::files::write_all_or_nothing;
/// # let dir = std::env::temp_dir().join("creepage-write-all-or-nothing");
/// write_all_or_nothing(&dir, &[("one", b"1"), ("two", b"2")]).unwrap();
/// assert!(write_all_or_nothing(&dir, &[("one", b"new"), ("no/such/folder", b"")]).is_err());
/// assert_eq!(std::fs::read(dir.join("one")).unwrap(), b"1");
/// ```
pub fn write_all_or_nothing(dir: impl AsRef<Path>, files: &[(&str, &[u8])]) -> Result<()> {
    let dir = dir.as_ref();
    let made = make_dir(dir)?;
    let written = put_all(dir, files);
    if written.is_err() {
        // Only folders made here, innermost first; `remove_dir` leaves one that is not empty.
        made.iter().for_each(|dir| drop(fs::remove_dir(dir)));
    }
    written
}

/// A file about to be put in its place: where, the new file, and a second name of the older one.
type Ready = (PathBuf, NamedTempFile<File>, Option<TempPath>);

fn put_all(dir: &Path, files: &[(&str, &[u8])]) -> Result<()> {
    let mut all = Vec::new();
    for (name, bytes) in files {
        let path = dir.join(name);
        let target = target(&path)?;
        let new = ready(&target, &path, bytes)?;
        let old = keep_old(&target).map_err(|e| unwritable(&path, &e))?;
        all.push((target, new, old));
    }
    install(all)
}

/// Renames every file into its place; when one fails, those before it are undone.
fn install(ready: Vec<Ready>) -> Result<()> {
    let mut done: Vec<(PathBuf, Option<TempPath>)> = Vec::new();
    for (target, new, old) in ready {
        if let Err(e) = new.persist(&target) {
            undo(done);
            return Err(unwritable(&target, &e.error));
        }
        done.push((target, old));
    }
    Ok(())
}

/// Puts back what the targets held before.
fn undo(done: Vec<(PathBuf, Option<TempPath>)>) {
    for (target, old) in done.into_iter().rev() {
        // The first error is already on its way to the user; a second one cannot be mended here.
        match old {
            Some(old) => drop(old.persist(&target)),
            None => drop(fs::remove_file(&target)),
        }
    }
}

/// A second name of the older file, gone when dropped; a copy where the file system knows no links.
fn keep_old(target: &Path) -> io::Result<Option<TempPath>> {
    if !target.exists() {
        return Ok(None);
    }
    let link = |path: &Path| fs::hard_link(target, path).or_else(|_| fs::copy(target, path).map(drop));
    Ok(Some(builder(target).make_in(folder_of(target), link)?.into_temp_path()))
}

/// Bytes in a finished file beside the target, gone when dropped; errors name the path that was asked for.
fn ready(target: &Path, path: &Path, bytes: &[u8]) -> Result<NamedTempFile<File>> {
    prepared(target, path, |file| buffered(file, |to| to.write_all(bytes)).map_err(|e| unwritable(path, &e)))
}

/// Makes the folder; gives those that were missing, innermost first.
fn make_dir(dir: &Path) -> Result<Vec<PathBuf>> {
    if dir.exists() && !dir.is_dir() {
        return Err(Error::input("is a file, not a folder").help("choose another output folder").at_file(dir));
    }
    if !dir.exists() && is_link(dir) {
        return Err(Error::input("is a link that leads to nothing")
            .help("remove the link or make its target")
            .at_file(dir));
    }
    let missing = dir.ancestors().filter(|d| !d.as_os_str().is_empty()).take_while(|d| !d.exists());
    let missing: Vec<PathBuf> = missing.map(Path::to_path_buf).collect();
    fs::create_dir_all(dir).map_err(|e| unwritable(dir, &e))?;
    Ok(missing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::atomic_write::names;

    #[test]
    fn several_files_are_written_together_or_not_at_all() {
        let top = tempfile::tempdir().unwrap();
        let dir = top.path().join("a/b");
        write_all_or_nothing(&dir, &[("one", b"1"), ("two", b"2")]).unwrap();
        assert_eq!(names(&dir), ["one", "two"]);
        fs::create_dir(dir.join("three")).unwrap();
        let error = write_all_or_nothing(&dir, &[("one", b"new"), ("three", b"3")]).unwrap_err();
        assert_eq!(error.exit_code(), 2);
        assert_eq!(names(&dir), ["one", "three", "two"]);
        assert_eq!(fs::read(dir.join("one")).unwrap(), b"1");
    }

    #[test]
    fn folders_made_for_nothing_are_removed() {
        let top = tempfile::tempdir().unwrap();
        write_all_or_nothing(top.path().join("a/b"), &[("no/folder", b"")]).unwrap_err();
        assert_eq!(names(top.path()), Vec::<String>::new());
    }

    #[test]
    fn a_failed_rename_restores_those_before_it() {
        let dir = tempfile::tempdir().unwrap();
        let [old, new, folder] = ["old", "new", "folder"].map(|name| dir.path().join(name));
        fs::write(&old, b"old").unwrap();
        fs::create_dir(&folder).unwrap();
        let ready = |target: &Path| (target.to_path_buf(), super::ready(target, target, b"changed").unwrap());
        let with = |(target, file): (PathBuf, _), kept| (target, file, kept);
        let kept = keep_old(&old).unwrap();
        let all = vec![with(ready(&old), kept), with(ready(&new), None), with(ready(&folder), None)];
        install(all).unwrap_err();
        assert_eq!(fs::read(&old).unwrap(), b"old");
        assert_eq!(names(dir.path()), ["folder", "old"]);
    }
}
