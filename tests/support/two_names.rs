//! A log of a binary format under two names.

use creepage::Result;
use creepage::files::{ModelFile, Run};
use sha2::{Digest, Sha256};

/// Reads it under a name of its format and under one of another: it is known by its name in any case, and by its first
/// bytes.
pub fn read_under_two_names(name: &str, bytes: &[u8], model: &ModelFile) -> Result<Run> {
    let folder = tempfile::tempdir().unwrap();
    let [named, unnamed] = [name, "log.csv"].map(|name| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        Run::read(&path, model)
    });
    if let (Ok(a), Ok(b)) = (&named, &unnamed) {
        let sha256 = format!("{:x}", Sha256::digest(bytes));
        assert_eq!((&a.sha256, &b.sha256), (&sha256, &sha256));
        assert_eq!((&a.x, &a.inputs), (&b.x, &b.inputs));
    }
    assert_eq!(named.is_ok(), unnamed.is_ok());
    named
}
