//! Atomic writes: a temporary file is renamed into its place, so that the new file is there whole or the older one still is.

use crate::error::{Error, Result};
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile, TempPath};

/// Writes a file in one step: whatever fails, `path` holds the new bytes whole or what it held before.
///
/// # Errors
/// When the path cannot be written: a folder, a read-only file, no folder to be in, a link that leads to nothing, a full
/// disk.
///
/// ```
/// use creepage::files::write_whole;
/// # let path = std::env::temp_dir().join("creepage-write-whole");
/// write_whole(&path, b"old").unwrap();
/// write_whole(&path, b"new").unwrap();
/// assert_eq!(std::fs::read(&path).unwrap(), b"new");
/// assert!(write_whole(std::env::temp_dir(), b"").unwrap_err().to_string().contains("is a folder"));
/// ```
pub fn write_whole(path: impl AsRef<Path>, bytes: &[u8]) -> Result<()> {
    write_whole_by(path, |to| to.write_all(bytes))
}

/// As [`write_whole`], of bytes that are written piece by piece and never held together.
///
/// # Errors
/// As [`write_whole`], and what `write` gives.
///
/// ```
/// use creepage::files::write_whole_by;
/// # let path = std::env::temp_dir().join("creepage-write-whole-by");
/// write_whole_by(&path, |to| (1..=3).try_for_each(|i| writeln!(to, "{i}"))).unwrap();
/// assert_eq!(std::fs::read_to_string(&path).unwrap(), "1\n2\n3\n");
/// ```
pub fn write_whole_by(path: impl AsRef<Path>, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<()> {
    let path = path.as_ref();
    write_whole_with(path, |file| buffered(file, write).map_err(|e| unwritable(path, &e)))
}

/// As [`write_whole_by`], by what needs the open file itself.
pub(crate) fn write_whole_with(path: &Path, write: impl FnOnce(&File) -> Result<()>) -> Result<()> {
    let target = target(path)?;
    let failed = |e: &io::Error| unwritable(path, e);
    if is_device(&target) {
        // A pipe or /dev/null takes bytes as they come; renaming a file over it would destroy it.
        return write(&OpenOptions::new().write(true).open(&target).map_err(|e| failed(&e))?);
    }
    let new = builder(&target).tempfile_in(folder_of(&target)).map_err(|e| failed(&e))?;
    write(new.as_file())?;
    new.as_file().sync_all().map_err(|e| failed(&e))?;
    new.persist(&target).map_err(|e| failed(&e.error))?;
    Ok(())
}

/// Where a file is made that is to be put at a path: no folder, not read-only, in a folder that exists. A link is
/// followed, for what lies beside it may be on another disk than what it leads to.
pub(crate) fn check_target(path: &Path) -> Result<PathBuf> {
    let target = target(path)?;
    if !folder_of(&target).is_dir() {
        return Err(unwritable(path, &ErrorKind::NotFound.into()));
    }
    Ok(if is_link(path) && !is_device(&target) { target } else { path.into() })
}

/// Puts a finished file from the same folder in the place of another, in one step, with the permissions of the other.
pub(crate) fn put_in_place(finished: &Path, path: &Path) -> Result<()> {
    let target = target(path)?;
    let put = || {
        if is_device(&target) {
            io::copy(&mut File::open(finished)?, &mut OpenOptions::new().write(true).open(&target)?)?;
            return fs::remove_file(finished);
        }
        if let Ok(older) = fs::metadata(&target) {
            fs::set_permissions(finished, older.permissions())?;
        }
        fs::rename(finished, &target)
    };
    put().map_err(|e| unwritable(path, &e))
}

/// Writes several files into a folder, which is made when missing: all of them, or none.
///
/// The names are plain file names. Every file is first written beside its place; when one of the
/// final renames fails, those already done are undone. Only a crash between two renames can leave a
/// mixture, and even then every single file is whole.
///
/// # Errors
/// As [`write_whole`], for the folder and each of the files; the folder is then as it was before.
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
    let mut ready = Vec::new();
    for (name, bytes) in files {
        let path = dir.join(name);
        let target = target(&path)?;
        let new = prepare(&target, |to| to.write_all(bytes)).map_err(|e| unwritable(&path, &e))?;
        let old = keep_old(&target).map_err(|e| unwritable(&path, &e))?;
        ready.push((target, new, old));
    }
    install(ready)
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

/// The file to replace: a link is followed, a folder or a read-only file refused.
fn target(path: &Path) -> Result<PathBuf> {
    let refuse = |why: &str, advice: &str| Err(Error::input(why).help(advice).at_file(path));
    match fs::metadata(path) {
        Ok(data) if data.is_dir() => refuse("is a folder, not a file", "choose another output path"),
        Ok(data) if data.permissions().readonly() => {
            refuse("is read-only", "choose another output path or make it writable")
        }
        Ok(_) => Ok(fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf())),
        Err(_) if path.file_name().is_none() => refuse("is not a file name", "choose another output path"),
        // Renaming a file over the link would lose where it points to.
        Err(_) if is_link(path) => refuse("is a link that leads to nothing", "remove the link or make its target"),
        Err(_) => Ok(path.to_path_buf()),
    }
}

fn is_link(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|data| data.is_symlink())
}

fn is_device(target: &Path) -> bool {
    fs::metadata(target).is_ok_and(|data| !data.is_file())
}

/// What is written in a finished file beside the target, gone when dropped.
fn prepare(target: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<NamedTempFile<File>> {
    let file = builder(target).tempfile_in(folder_of(target))?;
    buffered(file.as_file(), write)?;
    file.as_file().sync_all()?;
    Ok(file)
}

fn buffered(file: &File, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut to = BufWriter::new(file);
    write(&mut to)?;
    // Dropping the buffer would lose what the disk said to its last bytes.
    to.flush()
}

/// Temporary files with the permissions of the file they replace, or those of any new file.
fn builder(target: &Path) -> Builder<'static, 'static> {
    let mut builder = Builder::new();
    builder.prefix(".creepage-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let fresh = fs::Permissions::from_mode(0o666);
        builder.permissions(fs::metadata(target).map_or(fresh, |data| data.permissions()));
    }
    builder
}

fn folder_of(target: &Path) -> &Path {
    target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
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

/// The error of a path that cannot be written: the user's choice of path is input, a full disk a failed run.
pub(crate) fn unwritable(path: &Path, why: &io::Error) -> Error {
    let error = match why.kind() {
        ErrorKind::NotFound => {
            Error::input("cannot be written: its folder does not exist").help("make the folder first")
        }
        ErrorKind::NotADirectory => {
            Error::input("cannot be written: a part of its path is not a folder").help("choose another output path")
        }
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            Error::input("cannot be written: permission denied").help("choose another output path")
        }
        ErrorKind::IsADirectory | ErrorKind::InvalidInput | ErrorKind::InvalidFilename => {
            Error::input(format!("cannot be written: {why}")).help("choose another output path")
        }
        _ => Error::run(format!("cannot be written: {why}")).help("nothing was changed; free space and try again"),
    };
    error.at_file(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(dir: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_replaced_and_nothing_else_is_left() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("out.json");
        write_whole(&path, b"old").unwrap();
        write_whole(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(dir.path()), ["out.json"]);
    }

    #[test]
    fn unusable_paths_are_input_errors() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("file");
        write_whole(&file, b"kept").unwrap();
        let refused = [dir.path().to_path_buf(), dir.path().join("none/out"), file.join("out"), PathBuf::new()];
        for path in refused {
            assert_eq!(write_whole(&path, b"x").unwrap_err().exit_code(), 2, "{}", path.display());
        }
        assert_eq!(write_all_or_nothing(&file, &[]).unwrap_err().exit_code(), 2);
        assert_eq!(fs::read(&file).unwrap(), b"kept");
    }

    #[test]
    fn a_read_only_file_is_kept() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("out");
        write_whole(&path, b"kept").unwrap();
        let mut rights = fs::metadata(&path).unwrap().permissions();
        rights.set_readonly(true);
        fs::set_permissions(&path, rights).unwrap();
        assert!(write_whole(&path, b"x").unwrap_err().to_string().contains("read-only"));
        assert_eq!(fs::read(&path).unwrap(), b"kept");
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_pipes_survive() {
        let dir = tempfile::tempdir().unwrap();
        let (real, link) = (dir.path().join("real"), dir.path().join("link"));
        write_whole(&real, b"old").unwrap();
        std::os::unix::fs::symlink(&real, &link).unwrap();
        write_whole(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&real).unwrap(), b"new");
        // A pipe stands for devices: of those none may be lost where this fails.
        let pipe = dir.path().join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let (sender, read) = std::sync::mpsc::channel();
        let from = pipe.clone();
        std::thread::spawn(move || sender.send(fs::read(from).unwrap()));
        write_whole(&pipe, b"gone").unwrap();
        assert!(std::os::unix::fs::FileTypeExt::is_fifo(&fs::symlink_metadata(&pipe).unwrap().file_type()));
        assert_eq!(read.recv_timeout(std::time::Duration::from_secs(60)).unwrap(), b"gone");
    }

    /// What is made beside a link would be on the wrong disk; what is made beside a device, in a system's folder.
    #[cfg(unix)]
    #[test]
    fn a_file_is_made_where_its_link_leads() {
        use std::os::unix::fs::symlink;
        let [here, there] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
        let (link, real) = (here.path().join("link"), there.path().join("real"));
        fs::write(&real, b"old").unwrap();
        symlink(&real, &link).unwrap();
        assert_eq!(check_target(&link).unwrap(), fs::canonicalize(&real).unwrap());
        assert_eq!(check_target(&real).unwrap(), real);
        let null = here.path().join("null");
        symlink("/dev/null", &null).unwrap();
        assert_eq!(check_target(&null).unwrap(), null);
    }

    #[cfg(unix)]
    #[test]
    fn links_that_lead_nowhere_are_refused_and_kept() {
        let dir = tempfile::tempdir().unwrap();
        let (broken, ring) = (dir.path().join("broken"), dir.path().join("ring"));
        std::os::unix::fs::symlink("none", &broken).unwrap();
        std::os::unix::fs::symlink("ring", &ring).unwrap();
        for link in [&broken, &ring] {
            let refused = [write_whole(link, b"x"), write_all_or_nothing(link, &[("one", b"1")])];
            for error in refused.map(Result::unwrap_err) {
                assert!(error.exit_code() == 2 && error.message().contains("link that leads to nothing"), "{error}");
            }
            assert!(is_link(link));
        }
        assert_eq!(names(dir.path()), ["broken", "ring"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_new_file_has_the_rights_of_any_new_file() {
        use std::os::unix::fs::PermissionsExt;
        let dir = tempfile::tempdir().unwrap();
        let mode = |name: &str| fs::metadata(dir.path().join(name)).unwrap().permissions().mode();
        fs::write(dir.path().join("plain"), b"").unwrap();
        write_whole(dir.path().join("ours"), b"").unwrap();
        assert_eq!(mode("ours"), mode("plain"));
    }

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
        let ready = |target: &Path| (target.to_path_buf(), prepare(target, |to| to.write_all(b"changed")).unwrap());
        let with = |(target, file): (PathBuf, _), kept| (target, file, kept);
        let kept = keep_old(&old).unwrap();
        let all = vec![with(ready(&old), kept), with(ready(&new), None), with(ready(&folder), None)];
        install(all).unwrap_err();
        assert_eq!(fs::read(&old).unwrap(), b"old");
        assert_eq!(names(dir.path()), ["folder", "old"]);
    }

    /// A wrong path is wrong input; what may come right by itself is a failed run.
    #[test]
    fn what_cannot_be_written_is_told_by_its_kind() {
        for (kind, code, said) in [
            (ErrorKind::NotFound, 2, "its folder does not exist; make the folder first"),
            (ErrorKind::NotADirectory, 2, "a part of its path is not a folder; choose another output path"),
            (ErrorKind::PermissionDenied, 2, "permission denied; choose another output path"),
            (ErrorKind::ReadOnlyFilesystem, 2, "permission denied; choose another output path"),
            (ErrorKind::IsADirectory, 2, "is a directory; choose another output path"),
            (ErrorKind::InvalidFilename, 2, "invalid filename; choose another output path"),
            (ErrorKind::StorageFull, 1, "no storage space; nothing was changed; free space and try again"),
        ] {
            let error = unwritable(Path::new("p"), &kind.into());
            assert_eq!((error.exit_code(), error.to_string()), (code, format!("p: cannot be written: {said}")));
        }
    }
}
