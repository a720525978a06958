//! The links of a document, and whether they lead somewhere.

use super::documents::{Document, in_folder, root};
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use std::collections::BTreeMap;

/// Every target of a link or an image.
pub fn of(document: &Document) -> impl Iterator<Item = String> {
    Parser::new_ext(&document.text, Options::ENABLE_TABLES).filter_map(|event| match event {
        Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => Some(dest_url.to_string()),
        _ => None,
    })
}

/// Whether a link leaves the project.
pub fn is_external(link: &str) -> bool {
    link.contains("://") || link.starts_with("mailto:")
}

/// What is wrong with the links of a document.
pub fn faults(document: &Document) -> Vec<String> {
    of(document).filter(|l| !is_external(l)).filter_map(|link| fault(document, &link)).collect()
}

fn fault(document: &Document, link: &str) -> Option<String> {
    let (path, anchor) = link.split_once('#').map_or((link, None), |(path, anchor)| (path, Some(anchor)));
    let target = match path {
        "" => document.path(),
        _ => document.path().parent()?.join(path),
    };
    let at = |what: &str| Some(format!("{}: ({link}) {what}", document.name));
    if !target.exists() {
        return at("leads nowhere");
    }
    let anchor = anchor?;
    let text = std::fs::read_to_string(&target).unwrap_or_default();
    if anchors(&text).contains(&anchor.to_string()) { None } else { at("has no such heading") }
}

/// The anchors of a document's headings, as GitHub and mdBook make them.
fn anchors(text: &str) -> Vec<String> {
    let mut found = vec![];
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    let mut heading: Option<String> = None;
    for event in Parser::new(text) {
        match event {
            Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
            Event::Text(t) | Event::Code(t) => heading.iter_mut().for_each(|h| h.push_str(&t)),
            Event::End(TagEnd::Heading(_)) => {
                let slug = slug(&heading.take().unwrap_or_default());
                let count = seen.entry(slug.clone()).or_default();
                found.push(if *count == 0 { slug } else { format!("{slug}-{count}") });
                *count += 1;
            }
            _ => {}
        }
    }
    found
}

fn slug(heading: &str) -> String {
    let kept = heading.to_lowercase().chars().collect::<Vec<_>>();
    let letter = |c: char| match c {
        ' ' => Some('-'),
        c if c.is_alphanumeric() || c == '-' || c == '_' => Some(c),
        _ => None,
    };
    kept.into_iter().filter_map(letter).collect()
}

/// What is wrong with the book: chapters it leaves out, links that leave it.
pub fn book() -> Vec<String> {
    let summary = Document::read("book/src/SUMMARY.md");
    let listed: Vec<String> = of(&summary).collect();
    let chapters =
        || ["guide", "theory", "development"].into_iter().flat_map(|part| in_folder(&format!("book/src/{part}")));
    let left_out = chapters().filter_map(|c| {
        let name = c.strip_prefix("book/src/")?.to_string();
        (!listed.contains(&name)).then(|| format!("SUMMARY.md leaves {name} out"))
    });
    // Through the book's own folder the theory's links must stay inside it, too.
    let leaving = chapters().flat_map(|page| {
        let away = |l: &String| !is_external(l) && !stays(&page, l);
        let links: Vec<String> = of(&Document::read(&page)).filter(away).collect();
        links.into_iter().map(|l| format!("{page}: ({l}) leaves the book")).collect::<Vec<_>>()
    });
    left_out.chain(leaving).collect()
}

/// Whether a link from a page of the book ends in the book, where it is put together: `theory` there is a folder.
fn stays(page: &str, link: &str) -> bool {
    let path = link.split('#').next().unwrap_or_default();
    let mut place: Vec<&str> = page.split('/').collect();
    if path.is_empty() {
        return true;
    }
    place.pop();
    for part in path.split('/') {
        match part {
            ".." => drop(place.pop()),
            part => place.push(part),
        }
    }
    place.starts_with(&["book", "src"]) && root().join(place.join("/")).exists()
}

/// Chapters of the theory whose module, which their links become in rustdoc, is not there.
pub fn modules() -> Vec<String> {
    let modules = std::fs::read_to_string(root().join("src/theory.rs")).unwrap();
    let module = |file: &String| {
        let stem = file.strip_prefix("theory/").unwrap().strip_suffix(".md").unwrap();
        let name = stem.split_once('-').filter(|(n, _)| n.starts_with(|c: char| c.is_ascii_digit()));
        name.map_or(stem, |(_, rest)| rest).to_lowercase().replace('-', "_")
    };
    let missing = |file: &String| {
        let entry = format!("#[doc = include_str!(\"../{file}\")]\npub mod {} {{}}", module(file));
        !modules.contains(&entry)
    };
    in_folder("theory")
        .into_iter()
        .filter(missing)
        .map(|file| format!("src/theory.rs has no module {}", module(&file)))
        .collect()
}
