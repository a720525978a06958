//! The fenced blocks of a document.

use super::documents::Document;
use pulldown_cmark::{CodeBlockKind, Event, Parser, Tag, TagEnd};

/// A fenced block.
pub struct Fence {
    /// The word behind the fence: `sh`, `console`, `toml` …
    pub language: String,
    /// Its lines.
    pub text: String,
    /// The line of the document at which it begins, from 1.
    pub line: usize,
}

/// All fenced blocks of a document.
pub fn of(document: &Document) -> Vec<Fence> {
    let mut found: Vec<Fence> = vec![];
    let mut inside = false;
    for (event, range) in Parser::new(&document.text).into_offset_iter() {
        match event {
            Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(language))) => {
                let line = document.text[..range.start].matches('\n').count() + 1;
                found.push(Fence { language: language.to_string(), text: String::new(), line });
                inside = true;
            }
            Event::End(TagEnd::CodeBlock) => inside = false,
            Event::Text(text) if inside => {
                if let Some(fence) = found.last_mut() {
                    fence.text.push_str(&text);
                }
            }
            _ => {}
        }
    }
    found
}
