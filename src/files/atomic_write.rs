//! Atomic writes: a temporary file is renamed into its place, so that the new file is there whole or the older one still is.

use super::output_path::{folder_of, is_device, target, unwritable};
use crate::error::Result;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::Path;
use tempfile::{Builder, NamedTempFile};

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
    prepared(&target, path, write)?.persist(&target).map_err(|e| failed(&e.error))?;
    Ok(())
}

/// A finished file beside the target, gone when dropped; errors name the path that was asked for.
pub(super) fn prepared(
    target: &Path,
    path: &Path,
    write: impl FnOnce(&File) -> Result<()>,
) -> Result<NamedTempFile<File>> {
    let failed = |e: &io::Error| unwritable(path, e);
    let file = builder(target).tempfile_in(folder_of(target)).map_err(|e| failed(&e))?;
    write(file.as_file())?;
    file.as_file().sync_all().map_err(|e| failed(&e))?;
    Ok(file)
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

pub(super) fn buffered(file: &File, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut to = BufWriter::new(file);
    write(&mut to)?;
    // Dropping the buffer would lose what the disk said to its last bytes.
    to.flush()
}

/// Temporary files with the permissions of the file they replace, or those of any new file.
pub(super) fn builder(target: &Path) -> Builder<'static, 'static> {
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

/// The names in a folder, sorted.
#[cfg(test)]
pub(super) fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::output_path::is_link;
    use crate::files::write_all_or_nothing;
    use std::path::PathBuf;

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
}
