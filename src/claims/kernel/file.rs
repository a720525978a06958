//! The files of all theorems: one of each claim, what they share, and the script that puts them to the kernel.

use super::theorem::theorem;
use crate::claims::identities::{Identity, recorded};
use crate::claims::{Claim, Evidence, Gives, Ledger, Sampling, Statement};
use rayon::prelude::*;
use std::fmt::Write;

/// The definitions and tactics that every file rests on.
const SHARED: &str = include_str!("Creepage.v");

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

    /// Adds a theorem; false where the identity is none.
    fn add(&mut self, identity: &Identity) -> bool {
        let Some(theorem) = theorem(&format!("{}_{}", self.stem(), self.theorems + 1), identity) else { return false };
        let _ = write!(self.text, "\n{theorem}");
        self.theorems += 1;
        true
    }
}

impl Proofs {
    /// Name and content of every file.
    pub fn files(&self) -> Vec<(String, String)> {
        let with_theorems = self.claims.iter().filter(|c| c.theorems > 0);
        let shared = [("Creepage.v".to_string(), SHARED.to_string()), ("check.sh".into(), CHECK.into())];
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

/// The file of a claim, from the identities that its proofs rest on.
fn claim_file(claim: &Claim) -> ClaimFile {
    let mut file = ClaimFile {
        claim: claim.id.clone(),
        theorems: 0,
        text: format!("(* {}: {} *)\n\nRequire Import Creepage.\n", claim.id, comment(&claim.says)),
        left_out: vec![],
    };
    for evidence in claim.evidence.iter().filter(|e| e.gives == Gives::Proof) {
        let _ = writeln!(file.text, "\n(* {} *)", comment(&evidence.shows));
        let written: Vec<bool> = identities(evidence).iter().map(|identity| file.add(identity)).collect();
        if written.is_empty() || written.contains(&false) {
            file.left_out.push(evidence.shows.clone());
        }
    }
    file
}

/// What the check of a proof proves on its way, each identity once.
fn identities(proof: &Evidence) -> Vec<Identity> {
    let Ok(statement) = Statement::parse(&proof.equations) else { return vec![] };
    let sampling = Sampling { cases: 1, seed: 0, shrink: false };
    let (_, found) = recorded(|| (proof.check)(&statement, &sampling));
    let mut once: Vec<Identity> = vec![];
    for identity in found {
        if !once.contains(&identity) {
            once.push(identity);
        }
    }
    once
}

/// Text that does not end its comment.
fn comment(text: &str) -> String {
    text.replace("(*", "( *").replace("*)", "* )")
}
