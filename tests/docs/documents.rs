//! The documents of the project.

use std::path::{Path, PathBuf};

/// A Markdown file.
pub struct Document {
    /// Its path from the top of the repository.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// The top of the repository.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

impl Document {
    /// Reads a document by its path from the top.
    pub fn read(name: &str) -> Self {
        let text = std::fs::read_to_string(root().join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        Self { name: name.into(), text }
    }

    /// Where it lies.
    pub fn path(&self) -> PathBuf {
        root().join(&self.name)
    }
}

/// Folders with documents.
const FOLDERS: [&str; 8] =
    ["", "examples", "paper", "theory", "book", "book/src", "book/src/guide", "book/src/development"];

/// Every document, those of the book through its own folders.
pub fn all() -> Vec<Document> {
    FOLDERS.iter().flat_map(|folder| in_folder(folder)).map(|name| Document::read(&name)).collect()
}

/// The Markdown files of a folder, in order.
pub fn in_folder(folder: &str) -> Vec<String> {
    let entries = std::fs::read_dir(root().join(folder)).unwrap_or_else(|e| panic!("{folder}: {e}"));
    let names = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).filter(|n| n.ends_with(".md"));
    let mut found: Vec<String> = names.map(|n| if folder.is_empty() { n } else { format!("{folder}/{n}") }).collect();
    found.sort();
    found
}
