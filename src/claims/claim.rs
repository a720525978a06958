//! A claim of the paper with its status, its place and its evidence.

use super::{Correction, Outcome, Sampling, Statement, Status};
use std::fmt;
use std::sync::Arc;

/// Something that is said to be true, where it is said, and how one finds out.
///
/// ```
/// use creepage::claims::{prove, Claim, DerivedFormulas, Options, Status, verify};
/// let claim = Claim::new("eq-24", Status::Proved, "the speed of a creeping wheel")
///     .at("section 4, (24)")
///     .under("the wheel rate is measured")
///     .proof("the derived row gives it", &[("v_l", "r*theta'*(1 - e_rc)")], |s, _| prove(&DerivedFormulas::of("unicycle"), s));
/// let ledger = verify(&[claim], &Options::default(), &|_| std::ops::ControlFlow::Continue(()))?;
/// assert!(ledger.all_earned());
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Claim {
    /// Its name.
    pub id: String,
    /// What it says, in words and formula.
    pub says: String,
    /// Where it stands: section and equation of the paper, row of the errata.
    pub place: String,
    /// Numbered equations of the paper it is about.
    pub equations: Vec<u8>,
    /// What must hold for it to be true.
    pub hypotheses: String,
    /// What is wrong in the paper and why, if anything is.
    pub remark: String,
    /// The status its author states.
    pub stated: Status,
    /// Of a corrected or refuted statement in which way it is wrong.
    pub correction: Option<Correction>,
    /// The claim of whose statement this one is a part, by id; the statement is counted once.
    pub part_of: String,
    /// How one finds out: every part must do what it says.
    pub evidence: Vec<Evidence>,
    /// Source files that carry what it speaks of.
    pub code: Vec<String>,
    /// Tests that exercise the same outside the ledger, as file or file::function.
    pub tests: Vec<String>,
    /// The chapter of `theory/` that derives it.
    pub chapter: String,
}

/// What a piece of evidence gives when it holds.
///
/// ```
/// use creepage::claims::{self, Gives};
/// let proofs = claims::all().iter().flat_map(|claim| &claim.evidence).filter(|e| e.gives == Gives::Proof).count();
/// assert!(proofs > 50);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gives {
    /// True for all values, in exact arithmetic.
    Proof,
    /// True in every generated case.
    Sample,
    /// A proof's echo in another part of the program: must hold, and does not weaken a proof.
    Confirmation,
    /// A counterexample to what is printed.
    Refutation,
}

/// How the two sides of an equation of a piece of evidence belong together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Relation {
    /// left = right.
    #[default]
    Equal,
    /// left is undefined exactly where right = 0.
    UndefinedWhereZero,
}

/// A check: what became of a statement.
pub type Check = Arc<dyn Fn(&Statement, &Sampling) -> Outcome + Send + Sync>;

/// A statement and the check it is put to.
///
/// ```
/// use creepage::claims::{self, Evidence};
/// let all: Vec<Evidence> = claims::all().into_iter().flat_map(|claim| claim.evidence).collect();
/// assert!(all.len() > 100);
/// ```
#[derive(Clone)]
pub struct Evidence {
    /// What it shows.
    pub shows: String,
    /// What it gives.
    pub gives: Gives,
    /// The equations; of a refutation, the false ones.
    pub equations: Vec<(String, String)>,
    /// How their sides belong together.
    pub relation: Relation,
    /// The check.
    pub check: Check,
    /// Sabotage made by hand, where a slip in a formula would not be a false statement: these must not hold.
    pub sabotage: Option<Vec<Vec<(String, String)>>>,
    /// The sabotage of a refutation: nearby true equations that the same check must not refute.
    pub truth: Option<(Vec<(String, String)>, Check)>,
}

fn owned(equations: &[(&str, &str)]) -> Vec<(String, String)> {
    equations.iter().map(|(l, r)| ((*l).to_string(), (*r).to_string())).collect()
}

impl Claim {
    /// A claim without evidence.
    pub fn new(id: &str, stated: Status, says: &str) -> Self {
        Self {
            id: id.into(),
            says: says.into(),
            place: String::new(),
            equations: vec![],
            hypotheses: String::new(),
            remark: String::new(),
            stated,
            correction: None,
            part_of: String::new(),
            evidence: vec![],
            code: vec![],
            tests: vec![],
            chapter: String::new(),
        }
    }

    /// Where it stands.
    pub fn at(mut self, place: &str) -> Self {
        self.place = place.into();
        self
    }

    /// The numbered equations it is about.
    pub fn about(mut self, equations: &[u8]) -> Self {
        self.equations = equations.to_vec();
        self
    }

    /// What must hold for it to be true.
    pub fn under(mut self, hypotheses: &str) -> Self {
        self.hypotheses = hypotheses.into();
        self
    }

    /// What is wrong in the paper and why.
    pub fn remark(mut self, remark: &str) -> Self {
        self.remark = remark.into();
        self
    }

    /// In which way the statement is wrong.
    pub fn corrects(mut self, kind: Correction) -> Self {
        self.correction = Some(kind);
        self
    }

    /// The claim of whose statement this is a part.
    pub fn part_of(mut self, claim: &str) -> Self {
        self.part_of = claim.into();
        self
    }

    /// Source files that carry it.
    pub fn code(mut self, files: &[&str]) -> Self {
        self.code = files.iter().map(ToString::to_string).collect();
        self
    }

    /// Tests that exercise it outside the ledger.
    pub fn tests(mut self, tests: &[&str]) -> Self {
        self.tests = tests.iter().map(ToString::to_string).collect();
        self
    }

    /// The chapter that derives it.
    pub fn chapter(mut self, chapter: &str) -> Self {
        self.chapter = chapter.into();
        self
    }

    /// Adds equations that hold for all values.
    pub fn proof(
        self,
        shows: &str,
        equations: &[(&str, &str)],
        check: impl Fn(&Statement, &Sampling) -> Outcome + Send + Sync + 'static,
    ) -> Self {
        self.with(Gives::Proof, shows, equations, Arc::new(check))
    }

    /// Adds equations that hold in every generated case.
    pub fn sample(
        self,
        shows: &str,
        equations: &[(&str, &str)],
        check: impl Fn(&Statement, &Sampling) -> Outcome + Send + Sync + 'static,
    ) -> Self {
        self.with(Gives::Sample, shows, equations, Arc::new(check))
    }

    /// Adds equations that show what is proved in another part of the program, such as a simulated motion.
    pub fn confirmation(
        self,
        shows: &str,
        equations: &[(&str, &str)],
        check: impl Fn(&Statement, &Sampling) -> Outcome + Send + Sync + 'static,
    ) -> Self {
        self.with(Gives::Confirmation, shows, equations, Arc::new(check))
    }

    /// Adds equations as printed, which are false, and the true ones that the same check must let pass.
    pub fn refutation(
        self,
        shows: &str,
        printed: &[(&str, &str)],
        truth: &[(&str, &str)],
        check: impl Fn(&Statement, &Sampling) -> Outcome + Send + Sync + 'static,
    ) -> Self {
        let check: Check = Arc::new(check);
        self.refutation_by(shows, printed, check.clone(), truth, check)
    }

    /// As [`Claim::refutation`], where what is true needs another check, such as one over fewer cases.
    pub fn refutation_by(
        mut self,
        shows: &str,
        printed: &[(&str, &str)],
        check: Check,
        truth: &[(&str, &str)],
        truth_check: Check,
    ) -> Self {
        let truth = Some((owned(truth), truth_check));
        self.evidence.push(Evidence {
            shows: shows.into(),
            gives: Gives::Refutation,
            equations: owned(printed),
            relation: Relation::Equal,
            check,
            sabotage: None,
            truth,
        });
        self
    }

    /// Gives the last piece of evidence false statements made by hand, each of which its check must notice, in place
    /// of the mechanical ones.
    pub fn sabotaged_by(mut self, statements: &[&[(&str, &str)]]) -> Self {
        if let Some(last) = self.evidence.last_mut() {
            last.sabotage = Some(statements.iter().map(|s| owned(s)).collect());
        }
        self
    }

    /// The left sides of all evidence so far are said to be undefined exactly where the right sides vanish.
    pub fn on_domains(mut self) -> Self {
        self.evidence.iter_mut().for_each(|e| e.relation = Relation::UndefinedWhereZero);
        self
    }

    fn with(mut self, gives: Gives, shows: &str, equations: &[(&str, &str)], check: Check) -> Self {
        let equations = owned(equations);
        self.evidence.push(Evidence {
            shows: shows.into(),
            gives,
            equations,
            relation: Relation::Equal,
            check,
            sabotage: None,
            truth: None,
        });
        self
    }
}

impl Evidence {
    /// What it states, an equation an item, formulas written by a function.
    pub fn statements(&self, formula: impl Fn(&str) -> String) -> Vec<String> {
        let statement = |(left, right): &(String, String)| match self.relation {
            Relation::Equal => formula(&format!("{left} = {right}")),
            Relation::UndefinedWhereZero => {
                format!("{} is undefined exactly where {}", formula(left), formula(&format!("{right} = 0")))
            }
        };
        self.equations.iter().map(statement).collect()
    }
}

impl Gives {
    /// What the evidence is called.
    pub fn name(self) -> &'static str {
        match self {
            Gives::Proof => "proof",
            Gives::Sample => "sample",
            Gives::Confirmation => "confirmation",
            Gives::Refutation => "refutation",
        }
    }
}

impl fmt::Debug for Evidence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Evidence").field("shows", &self.shows).field("gives", &self.gives).finish_non_exhaustive()
    }
}
