//! Text files in UTF-8, read whole, with their SHA-256 and errors that say what is in the way.

use crate::error::{Error, Result};
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// The largest text file, in bytes: a model file has a few kilobytes, and a device may have no end.
const MAX_BYTES: u64 = 16 << 20;
/// The byte order mark some editors put in front of UTF-8.
pub(crate) const BOM: &str = "\u{feff}";

/// The text of a file, without byte order mark.
///
/// # Errors
/// When there is no such file, it cannot be read, or it is no text in UTF-8: empty, binary, too large.
///
/// ```
/// use creepage::files::read_text;
/// # let path = std::env::temp_dir().join("creepage-read-text");
/// std::fs::write(&path, "\u{feff}a = 1\n").unwrap();
/// assert_eq!(read_text(&path).unwrap(), "a = 1\n");
/// assert!(read_text("no/such/file").unwrap_err().to_string().contains("no such file"));
/// ```
pub fn read_text(path: impl AsRef<Path>) -> Result<String> {
    Ok(read_hashed(path.as_ref())?.0)
}

/// The text of a file, and the SHA-256 of its bytes in hexadecimal.
pub(crate) fn read_hashed(path: &Path) -> Result<(String, String)> {
    let mut bytes = Vec::new();
    open(path)?.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(|e| unreadable(path, &e))?;
    let text = decode(&bytes).map_err(|e| e.at_file(path))?;
    Ok((text, hex(&Sha256::digest(&bytes))))
}

/// Opens a file for reading; a folder is an error on every system.
pub(crate) fn open(path: &Path) -> Result<File> {
    let file = File::open(path).map_err(|e| unreadable(path, &e))?;
    match file.metadata() {
        Ok(data) if data.is_dir() => Err(is_folder(path)),
        _ => Ok(file),
    }
}

/// The error of a file that cannot be read.
pub(crate) fn unreadable(path: &Path, why: &std::io::Error) -> Error {
    let error = match why.kind() {
        ErrorKind::NotFound => Error::input("no such file").help("check the path"),
        ErrorKind::PermissionDenied => Error::input("permission denied").help("make the file readable"),
        ErrorKind::IsADirectory => return is_folder(path),
        _ => Error::input(format!("cannot be read: {why}")).help("check the path and the file"),
    };
    error.at_file(path)
}

/// The error of a folder where a file is meant.
pub(crate) fn is_folder(path: &Path) -> Error {
    Error::input("is a folder, not a file").help("name a file inside it").at_file(path)
}

/// The error of a file that is not text.
pub(crate) fn not_text(bytes: &[u8]) -> Error {
    let utf16 = bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff");
    match utf16 {
        true => Error::input("is UTF-16, not UTF-8").help("save it again as UTF-8"),
        false => Error::input("is a binary file, not text").help("give a text file in UTF-8"),
    }
}

fn decode(bytes: &[u8]) -> Result<String> {
    if bytes.len() as u64 > MAX_BYTES {
        return Err(Error::input("is larger than 16 MiB").help("check that this is the file you meant"));
    }
    if bytes.contains(&0) || bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(not_text(bytes));
    }
    let text = std::str::from_utf8(bytes).map_err(|e| {
        let (line, column) = place(&String::from_utf8_lossy(&bytes[..e.valid_up_to()]), usize::MAX);
        not_utf8(line, column)
    })?;
    let text = text.strip_prefix(BOM).unwrap_or(text);
    if text.trim().is_empty() {
        return Err(Error::input("is empty").help("check that this is the file you meant"));
    }
    Ok(text.to_string())
}

/// The error of bytes that are text in another encoding.
pub(crate) fn not_utf8(line: usize, column: usize) -> Error {
    Error::input("is not UTF-8 text").at(line, column).help("save it again as UTF-8")
}

/// Line and column, both from one and in characters, of a byte offset; past the end means the end.
pub(crate) fn place(text: &str, offset: usize) -> (usize, usize) {
    let mut end = offset.min(text.len());
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let before = &text[..end];
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    (before.matches('\n').count() + 1, before[start..].chars().count() + 1)
}

/// Bytes in lower-case hexadecimal.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|b| format!("{b:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_characters() {
        assert_eq!(place("ab\nçd", 0), (1, 1));
        assert_eq!(place("ab\nçd", 5), (2, 2));
        assert_eq!(place("ab\nçd", 4), (2, 1), "inside a character means that character");
        assert_eq!(place("ab\n", 99), (2, 1));
    }

    #[test]
    fn the_hash_is_of_the_bytes_and_the_text_has_no_mark() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a.txt");
        std::fs::write(&path, b"\xef\xbb\xbfabc\r\n").unwrap();
        let (text, hash) = read_hashed(&path).unwrap();
        assert_eq!(text, "abc\r\n");
        assert_eq!(hash, hex(&Sha256::digest(b"\xef\xbb\xbfabc\r\n")));
        assert_eq!(hex(&Sha256::digest(b"abc"))[..8], *"ba7816bf");
    }

    #[test]
    fn a_text_may_be_as_large_as_is_said() {
        let mut bytes = vec![b'a'; MAX_BYTES as usize];
        assert!(decode(&bytes).is_ok());
        bytes.push(b'a');
        assert!(decode(&bytes).is_err());
    }

    /// The error names what stands in the way of a file; the administrator, who may read all files, never meets some of them.
    #[test]
    fn what_cannot_be_read_is_told_by_its_kind() {
        for (kind, said) in [
            (ErrorKind::NotFound, "p: no such file; check the path"),
            (ErrorKind::PermissionDenied, "p: permission denied; make the file readable"),
            (ErrorKind::IsADirectory, "p: is a folder, not a file; name a file inside it"),
            (ErrorKind::TimedOut, "p: cannot be read: timed out; check the path and the file"),
        ] {
            assert_eq!(unreadable(Path::new("p"), &kind.into()).to_string(), said);
        }
    }
}
