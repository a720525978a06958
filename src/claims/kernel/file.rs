//! The files of all theorems: one of each claim, what they share, and the script that puts them to the kernel.

use super::distribution::Distribution;
use super::growth::growth_theorem;
use super::theorem::theorem;
use crate::claims::proved::{Proved, recorded};
use crate::claims::{Claim, Evidence, Gives, Ledger, Sampling, Statement};
use rayon::prelude::*;
use std::fmt::Write;

/// The definitions and tactics that every file rests on.
pub(super) const SHARED: &str = include_str!("Creepage.v");

/// Polynomials, brackets and growth vectors, for the files that count them.
pub(super) const BRACKETS: &str = include_str!("Brackets.v");

/// The script that runs the kernel on every file.
const CHECK: &str = include_str!("check.sh");

/// The theorems of a claim.
#[derive(Clone, Debug, PartialEq)]
pub struct ClaimFile {
    /// The claim.
    pub claim: String,
    /// How many theorems the file holds.
    pub theorems: usize,
    /// The file.
    pub text: String,
    /// Proofs of the claim of which no theorem is written, by what they show.
    pub left_out: Vec<String>,
}

/// Files for an independent kernel.
#[derive(Clone, Debug)]
pub struct Proofs {
    /// The theorems of each claim that proves anything.
    pub claims: Vec<ClaimFile>,
}

impl ClaimFile {
    /// The name of the file without its ending.
    pub fn stem(&self) -> String {
        self.claim.replace('-', "_")
    }

    /// Adds what was proved as a theorem; why not, where none is written.
    fn add(&mut self, proved: &Proved) -> Result<(), String> {
        let text = match proved {
            Proved::Identity(identity) => {
                let name = format!("{}_{}", self.stem(), self.theorems + 1);
                theorem(&name, identity).ok_or("a function has no counterpart in Coq")?
            }
            Proved::Growth(counted) => {
                // Every number of an example rests on the same theorem.
                let name = counted.name.replace('-', "_");
                if self.text.contains(&format!("Definition {name} :=")) {
                    return Ok(());
                }
                let distribution = Distribution::of(counted).and_then(|of| growth_theorem(&name, &of));
                distribution.ok_or_else(|| format!("of {name} a coefficient is a root"))?
            }
            Proved::WithoutTheorem(why) => return Err(why.to_string()),
        };
        let _ = write!(self.text, "\n{text}");
        self.theorems += 1;
        Ok(())
    }
}

impl Proofs {
    /// Name and content of every file.
    pub fn files(&self) -> Vec<(String, String)> {
        let with_theorems = self.claims.iter().filter(|c| c.theorems > 0);
        let shared = [("Creepage.v", SHARED), ("Brackets.v", BRACKETS), ("check.sh", CHECK)];
        let shared = shared.map(|(name, text)| (name.to_string(), text.to_string()));
        with_theorems.map(|c| (format!("{}.v", c.stem()), c.text.clone())).chain(shared).collect()
    }
}

/// Runs the proofs of claims and writes each identity that they rest on as a theorem.
pub fn proofs<'a>(claims: impl IntoParallelIterator<Item = &'a Claim>) -> Proofs {
    let files: Vec<ClaimFile> = claims.into_par_iter().map(claim_file).collect();
    Proofs { claims: files.into_iter().filter(|c| c.theorems > 0 || !c.left_out.is_empty()).collect() }
}

/// The theorems of all claims of a ledger.
pub fn proofs_of(ledger: &Ledger) -> Proofs {
    proofs(ledger.entries.par_iter().map(|e| &e.claim))
}

/// The file of a claim, from what its proofs rest on.
fn claim_file(claim: &Claim) -> ClaimFile {
    let mut file = ClaimFile { claim: claim.id.clone(), theorems: 0, text: String::new(), left_out: vec![] };
    for evidence in claim.evidence.iter().filter(|e| e.gives == Gives::Proof) {
        let _ = writeln!(file.text, "\n(* {} *)", comment(&evidence.shows));
        let found = found_by(evidence);
        let mut why: Vec<String> = found.iter().filter_map(|proved| file.add(proved).err()).collect();
        why.dedup();
        match why.is_empty() {
            true if found.is_empty() => file.left_out.push(evidence.shows.clone()),
            true => {}
            false => file.left_out.push(format!("{} ({})", evidence.shows, why.join("; "))),
        }
    }
    let brackets = if file.text.contains("has_growth") { "Require Import Brackets.\n" } else { "" };
    let head = format!("(* {}: {} *)\n\n{brackets}Require Import Creepage.\n", claim.id, comment(&claim.says));
    file.text.insert_str(0, &head);
    file
}

/// What the check of a proof proves on its way, each identity once.
fn found_by(proof: &Evidence) -> Vec<Proved> {
    let Ok(statement) = Statement::parse(&proof.equations) else { return vec![] };
    let sampling = Sampling { cases: 1, seed: 0, shrink: false };
    let (_, found) = recorded(|| (proof.check)(&statement, &sampling));
    let mut once: Vec<Proved> = vec![];
    for proved in found {
        let known = |other: &Proved| matches!((other, &proved), (Proved::Identity(a), Proved::Identity(b)) if a == b);
        if !once.iter().any(known) {
            once.push(proved);
        }
    }
    once
}

/// Text that does not end its comment.
fn comment(text: &str) -> String {
    text.replace("(*", "( *").replace("*)", "* )")
}
