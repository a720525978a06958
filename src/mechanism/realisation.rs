//! The sets of creep coefficients that realise a motion, given what is measured: the signature RᵏTᵐ by exact ranks.

use super::exact_linear_algebra::{Echelon, dot};
use super::{Mechanism, Point, Row, rank};
use crate::error::{Error, Result};
use crate::formula::{BigRational, Expr, Symbol};

/// The most smallest sets that are listed; their number grows as a binomial coefficient.
const MAX_SETS: usize = 1000;

/// The sets of coefficients that realise the motion of a mechanism near an ideal motion.
///
/// | symbol | meaning |
/// |---|---|
/// | u | velocities that are not measured: twist, trailer rates, castor rates |
/// | S | a set of constraints, each with its coefficient eᵢ |
/// | A_S,u | their rows of the Pfaffian matrix, columns u |
///
/// S realises the motion when A_S,u is regular and each coefficient acts, ∂(row·q̇)/∂eᵢ ≠ 0: then e_S ↦ u is one to one
/// near e = 0, and every other coefficient is a function of e_S and the measured rates. A wheel whose own rate is not
/// measured turns as it must: its rolling constraint gives that rate and no coefficient.
/// Valid near e = 0 at the point, for a general ideal motion. Source: THEOREM of the paper with E17–E21 of the errata.
///
/// ```
/// use creepage::formula::Exact;
/// use creepage::mechanism::Point;
/// use creepage::{model::mechanism, vehicles};
/// let robot = mechanism(vehicles::named("differential-drive").unwrap(), 0);
/// let lengths = [("a", 3, 4), ("r_1", 1, 3), ("r_2", 1, 3)];
/// let at = lengths.iter().fold(Point::default(), |p, (s, a, b)| p.with(*s, Exact::ratio(*a, *b)));
/// let at = at.with("phi", Exact::half_tangent(1, 2));
/// let found = robot.realisation(&["theta_1'".into(), "theta_2'".into()], &at).unwrap();
/// assert_eq!(found.signature(), "R^2T");
/// ```
#[derive(Clone, Debug)]
pub struct Realisation {
    /// u.
    pub unknown: Vec<Symbol>,
    /// All smallest sets S by the places of their constraints, the canonical one first: R before T before others, each in the order
    /// of the description, taken while independent.
    pub sets: Vec<Vec<usize>>,
    /// Whether every smallest set is listed.
    pub is_complete: bool,
    /// Constraints outside the canonical set whose coefficient acts: it follows from the canonical ones.
    pub passive: Vec<usize>,
    letters: Vec<char>,
}

impl Realisation {
    /// The canonical set.
    pub fn canonical(&self) -> &[usize] {
        self.sets.first().map_or(&[], Vec::as_slice)
    }

    /// How many of each letter are in the canonical set, in the order of signatures.
    pub fn letters(&self) -> Vec<(char, usize)> {
        counted(self.canonical().iter().map(|r| self.letters[*r]))
    }

    /// k and m of the canonical set: coefficients of type R, and all others.
    pub fn counts(&self) -> (usize, usize) {
        let rolling = self.canonical().iter().filter(|r| self.letters[**r] == 'R').count();
        (rolling, self.canonical().len() - rolling)
    }

    /// `R^kT^m` of the canonical set, exponents of one left out.
    pub fn signature(&self) -> String {
        let power = |(letter, n): (char, usize)| match n {
            1 => letter.to_string(),
            _ => format!("{letter}^{n}"),
        };
        self.letters().into_iter().map(power).collect()
    }
}

/// How many there are of each letter, in the order of signatures.
pub(crate) fn counted(letters: impl Iterator<Item = char>) -> Vec<(char, usize)> {
    let mut counts = std::collections::BTreeMap::new();
    letters.for_each(|letter| *counts.entry((rank(letter), letter)).or_insert(0) += 1);
    counts.into_iter().map(|((_, letter), n)| (letter, n)).collect()
}

impl Mechanism {
    /// The sets of coefficients that realise the motion when these rates are measured.
    ///
    /// # Errors
    /// When a constraint has no exact value at the point, two constraints share a coefficient, or the constraints do
    /// not determine the velocities that are not measured.
    pub fn realisation(&self, measured: &[Symbol], at: &Point) -> Result<Realisation> {
        let candidates = self.candidates(measured);
        let unknown = self.unknown(measured, &candidates);
        let acting = self.acting(at)?;
        let rows = self.ideal_rows();
        let values = at.matrix(&rows, &unknown)?;
        let mut order: Vec<usize> = candidates.into_iter().filter(|r| acting[*r]).collect();
        order.sort_by_key(|r| (rank(self.constraints[*r].letter()), *r));
        let (sets, is_complete) = bases(&order, &values, unknown.len());
        let Some(canonical) = sets.first() else { return Err(not_determined(&unknown)) };
        let passive = (0..rows.len()).filter(|r| order.contains(r) && !canonical.contains(r)).collect();
        let letters = self.constraints.iter().map(super::Constraint::letter).collect();
        Ok(Realisation { unknown, is_complete, passive, letters, sets })
    }

    /// Constraints with a coefficient to choose: all but the rolling of wheels whose rate is not measured.
    fn candidates(&self, measured: &[Symbol]) -> Vec<usize> {
        let turns_as_it_must = |r: &usize| self.constraints[*r].form.gives().is_some_and(|q| !measured.contains(q));
        (0..self.constraints.len()).filter(|r| !turns_as_it_must(r)).collect()
    }

    /// The rates in these constraints that are not measured.
    fn unknown(&self, measured: &[Symbol], candidates: &[usize]) -> Vec<Symbol> {
        let rows = self.rows();
        let occurs = |q: &Symbol| candidates.iter().any(|r| rows[*r].rates().any(|rate| rate == q));
        self.rates().into_iter().filter(|q| occurs(q) && !measured.contains(q)).collect()
    }

    /// For each constraint, whether its coefficient changes its row at a general ideal motion.
    fn acting(&self, at: &Point) -> Result<Vec<bool>> {
        if let Some(shared) = self.shared_coefficient() {
            return Err(Error::input(format!("two constraints have the coefficient {shared}"))
                .help("give every constraint a coefficient of its own"));
        }
        let rates = self.rates();
        let ideal = Echelon::of(rates.len(), &at.matrix(&self.ideal_rows(), &rates)?);
        let motions = ideal.null_space();
        let slopes = at.matrix(&self.slopes(), &rates)?;
        // A linear form that vanishes on every ideal motion vanishes on a general one, and only then.
        let acts = |slope: &Vec<BigRational>| motions.iter().any(|motion| !dot(slope, motion).is_zero());
        Ok(slopes.iter().map(acts).collect())
    }

    fn shared_coefficient(&self) -> Option<&Symbol> {
        let mut met = std::collections::HashSet::new();
        self.constraints.iter().map(|c| &c.creep).find(|e| !met.insert(*e))
    }

    /// The part of each row that its coefficient multiplies; a row is linear in it.
    pub(crate) fn slopes(&self) -> Vec<Row> {
        let slope = |c: &super::Constraint| {
            let at = |e: i64| c.row().substitute(&|s| (*s == c.creep).then(|| Expr::int(e)));
            at(1).plus(&Expr::int(-1), &at(0))
        };
        self.constraints.iter().map(slope).collect()
    }
}

fn not_determined(unknown: &[Symbol]) -> Error {
    let names: Vec<String> = unknown.iter().map(Symbol::to_string).collect();
    Error::input(format!("the constraints do not determine {} at this point", names.join(", ")))
        .help("measure more rates, or choose a point where no wheel is at rest")
}

/// All sets of `size` independent rows in the order given, the first ones first, and whether these are all.
fn bases(order: &[usize], rows: &[Vec<BigRational>], size: usize) -> (Vec<Vec<usize>>, bool) {
    let mut found = Vec::new();
    extend(&Echelon::new(size), &[], order, rows, &mut found);
    let is_complete = found.len() <= MAX_SETS;
    found.truncate(MAX_SETS);
    (found, is_complete)
}

/// Adds to `found` every set that begins with `chosen` and goes on with rows from `rest`.
fn extend(known: &Echelon, chosen: &[usize], rest: &[usize], rows: &[Vec<BigRational>], found: &mut Vec<Vec<usize>>) {
    if known.is_full() {
        found.push(chosen.to_vec());
        return;
    }
    for (i, r) in rest.iter().enumerate() {
        let (mut grown, later) = (known.clone(), &rest[i + 1..]);
        if found.len() > MAX_SETS || !grown.insert(&rows[*r]) {
            continue;
        }
        // Only ways that lead to a set are gone.
        let mut reach = grown.clone();
        later.iter().for_each(|r| {
            reach.insert(&rows[*r]);
        });
        if reach.is_full() {
            extend(&grown, &[chosen, &[*r]].concat(), later, rows, found);
        }
    }
}
