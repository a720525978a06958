//! The path of an output: the file it leads to, or why none can be written there.

use crate::error::{Error, Result};
use std::fs;
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// Where a file is made that is to be put at a path: no folder, not read-only, in a folder that exists. A link is
/// followed, for what lies beside it may be on another disk than what it leads to.
pub(crate) fn check_target(path: &Path) -> Result<PathBuf> {
    let target = target(path)?;
    if !folder_of(&target).is_dir() {
        return Err(unwritable(path, &ErrorKind::NotFound.into()));
    }
    Ok(if is_link(path) && !is_device(&target) { target } else { path.into() })
}

/// The file to replace: a link is followed, a folder or a read-only file refused.
pub(super) fn target(path: &Path) -> Result<PathBuf> {
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

pub(super) fn is_link(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|data| data.is_symlink())
}

pub(super) fn is_device(target: &Path) -> bool {
    fs::metadata(target).is_ok_and(|data| !data.is_file())
}

pub(super) fn folder_of(target: &Path) -> &Path {
    target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
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
