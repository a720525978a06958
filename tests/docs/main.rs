//! The documents hold: their links lead somewhere, their commands run and print what is shown.

mod arrows;
mod commands;
mod declared;
mod documents;
mod fences;
mod groups;
mod links;
mod public_names;
mod sandbox;
mod sentences;

use documents::{Document, all};

/// Faults of all documents, one a line.
fn none(faults: Vec<String>) {
    assert!(faults.is_empty(), "\n{}\n", faults.join("\n"));
}

#[test]
fn stages_import_one_way() {
    let sources = arrows::Sources::read(&documents::root().join("src"));
    none([sources.homeless(), sources.upward(), sources.circles()].concat());
}

#[test]
fn every_relative_link_and_anchor_resolves() {
    let documents = all();
    let checked: usize = documents.iter().map(|d| links::of(d).count()).sum();
    assert!(checked > 100, "only {checked} links were found");
    none(documents.iter().flat_map(links::faults).collect());
}

#[test]
fn external_links_are_listed() {
    let documents = all();
    let mut external: Vec<String> = documents.iter().flat_map(links::of).filter(|l| links::is_external(l)).collect();
    external.sort();
    external.dedup();
    external.iter().for_each(|link| println!("{link}"));
    none(external.into_iter().filter(|l| !l.starts_with("https://")).collect());
}

#[test]
fn the_book_has_every_chapter_and_leads_nowhere_else() {
    none(links::book());
}

#[test]
fn every_chapter_of_the_theory_is_a_module() {
    none(links::modules());
}

#[test]
fn every_file_of_tests_is_run() {
    none(groups::left_out());
}

#[test]
fn every_command_is_marked_as_one() {
    none(all().iter().flat_map(commands::unmarked).collect());
}

/// Runs the commands of one document in a folder of their own, in their order.
fn runs(name: &str) {
    let document = Document::read(name);
    let commands = commands::of(&document);
    assert!(!commands.is_empty(), "{name} has no command");
    let sandbox = sandbox::Sandbox::new();
    none(commands.iter().flat_map(|c| sandbox.faults(c)).map(|fault| format!("{name}: {fault}")).collect());
}

#[test]
fn commands_of_the_readme_run() {
    runs("README.md");
}

#[test]
fn commands_of_the_examples_run() {
    runs("examples/README.md");
}

#[test]
fn commands_of_installation_run() {
    runs("book/src/guide/install.md");
}

#[test]
fn commands_of_the_first_discovery_run() {
    runs("book/src/guide/first.md");
}

#[test]
fn commands_of_the_guide_run() {
    for page in ["own-log", "describe", "report", "effects", "vehicles"] {
        runs(&format!("book/src/guide/{page}.md"));
    }
}

#[test]
fn commands_of_daily_use_run() {
    for page in ["init", "check", "clocks", "formats", "sweep", "fleet", "plan"] {
        runs(&format!("book/src/guide/{page}.md"));
    }
}

#[test]
fn commands_of_the_theory_run() {
    for page in ["verify", "figures", "forces", "measured"] {
        runs(&format!("book/src/guide/{page}.md"));
    }
}

#[test]
fn no_document_with_commands_is_left_out() {
    let tested = [
        "README.md",
        "examples/README.md",
        "book/src/guide/install.md",
        "book/src/guide/first.md",
        "book/src/guide/own-log.md",
        "book/src/guide/describe.md",
        "book/src/guide/report.md",
        "book/src/guide/effects.md",
        "book/src/guide/vehicles.md",
        "book/src/guide/init.md",
        "book/src/guide/check.md",
        "book/src/guide/fit.md",
        "book/src/guide/export.md",
        "book/src/guide/fleet.md",
        "book/src/guide/plan.md",
        "book/src/guide/clocks.md",
        "book/src/guide/formats.md",
        "book/src/guide/sweep.md",
        "book/src/guide/verify.md",
        "book/src/guide/figures.md",
        "book/src/guide/forces.md",
        "book/src/guide/measured.md",
    ];
    let left: Vec<String> = all()
        .iter()
        .filter(|d| !tested.contains(&d.name.as_str()) && !commands::of(d).is_empty())
        .map(|d| d.name.clone())
        .collect();
    none(left);
}
