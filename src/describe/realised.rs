//! The coefficients of creep that make the motion of a model, given what it measures.

use super::Signature;
use super::found::Found;
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Mechanism, Point, Realisation};
use crate::model::{Model, trailer_heading};

/// The number of other smallest sets that are shown.
const SHOWN_SETS: usize = 5;
/// The largest set for which passive coefficients are solved for: determinants of larger ones fill pages.
const MAX_SOLVED_SET: usize = 8;
/// The longest formula of a passive coefficient that is shown, in characters: about four lines.
const MAX_FORMULA_LENGTH: usize = 400;

/// The signature RᵏTᵐ by ranks, with the sets of coefficients that realise the motion.
///
/// | part | meaning |
/// |---|---|
/// | measured | rates that the logged inputs give and that occur in a constraint |
/// | unknown | rates that the constraints have to give |
/// | canonical | coefficients of a smallest set that makes them so: R before T before others, in the order of the constraints |
/// | passive | coefficients outside it that act: they follow from it |
///
/// Valid near zero creep at a general configuration. Source: THEOREM of the paper, see
/// [`Realisation`](crate::mechanism::Realisation).
///
/// ```
/// use creepage::{describe::Structure, model::Model};
/// let robot = Model::new("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.5)]).unwrap();
/// let found = Structure::of(&robot).unwrap().realisation.unwrap();
/// assert_eq!(found.signature.to_string(), "R^2 T");
/// assert_eq!(found.canonical, ["e_rc_1".into(), "e_rc_2".into(), "e_tc".into()]);
/// ```
#[derive(Clone, Debug)]
pub struct Realised {
    /// Rates that are measured.
    pub measured: Vec<Symbol>,
    /// Rates that are not.
    pub unknown: Vec<Symbol>,
    /// k and m of the canonical set.
    pub signature: Signature,
    /// The canonical set.
    pub canonical: Vec<Symbol>,
    /// The first of the other smallest sets.
    pub others: Vec<Vec<Symbol>>,
    /// How many other smallest sets were found.
    pub other_count: usize,
    /// Whether these are all.
    pub is_complete: bool,
    /// Passive coefficients, with their formula where it is short and nothing is pulled.
    pub passive: Vec<(Symbol, Option<Expr>)>,
}

impl Realised {
    /// The same sets at two configurations, or in words why there are none.
    pub(super) fn of(model: &Model, mechanism: &Mechanism, points: &[Point; 2], also: &[Symbol]) -> Found<Self> {
        let mut measured = measured(model, mechanism);
        measured.extend(also.iter().filter(|s| !measured.contains(s)).cloned().collect::<Vec<_>>());
        let at = |p: &Point| mechanism.realisation(&measured, p).map_err(|e| e.message().to_string());
        let (first, second) = (at(&points[0])?, at(&points[1])?);
        let same = first.sets == second.sets && first.passive == second.passive;
        match same && first.is_complete == second.is_complete {
            true => Ok(Self::named(mechanism, measured, &first)),
            false => Err(format!(
                "two general configurations differ, with signatures {} and {}",
                counted(&first),
                counted(&second)
            )),
        }
    }

    fn named(mechanism: &Mechanism, measured: Vec<Symbol>, found: &Realisation) -> Self {
        let creep = |r: &usize| mechanism.constraints[*r].creep.clone();
        let names = |set: &[usize]| set.iter().map(creep).collect::<Vec<_>>();
        let is_train = mechanism.coordinates.contains(&trailer_heading(1));
        let formula = |r: &usize| {
            let is_small = found.canonical().len() <= MAX_SOLVED_SET && !is_train;
            let formula = is_small.then(|| mechanism.passive_coefficient_ahead(found, *r)).flatten()?;
            Some(formula).filter(|f| f.to_string().len() <= MAX_FORMULA_LENGTH)
        };
        Self {
            measured,
            unknown: found.unknown.clone(),
            signature: counted(found),
            canonical: names(found.canonical()),
            others: found.sets.iter().skip(1).take(SHOWN_SETS).map(|s| names(s)).collect(),
            other_count: found.sets.len().saturating_sub(1),
            is_complete: found.is_complete,
            passive: found.passive.iter().map(|r| (creep(r), formula(r))).collect(),
        }
    }
}

fn counted(found: &Realisation) -> Signature {
    Signature { counts: found.letters() }
}

/// The rates in the rows that logged inputs give: of wheels, of angles that are steered, of the yaw where it is logged.
fn measured(model: &Model, mechanism: &Mechanism) -> Vec<Symbol> {
    let vehicle = &model.vehicle;
    let is_logged = |role: &str| model.inputs.iter().any(|i| i == role);
    let given = |s: &Symbol| {
        let symbols = vehicle.define.get(s).map(|d| d.formula.symbols()).unwrap_or_default();
        let inputs: Vec<_> = symbols.iter().filter_map(|s| vehicle.inputs.get_key_value(s.as_str())).collect();
        let instead = |i: &crate::vehicles::Input| i.instead.as_ref().is_some_and(|o| is_logged(&o.role));
        !inputs.is_empty() && inputs.iter().all(|(role, input)| is_logged(role) || instead(input))
    };
    let rows = mechanism.rows();
    let occurs = |rate: &Symbol| rows.iter().any(|r| r.rates().any(|q| q == rate));
    let known = mechanism.coordinates.iter().filter(|q| given(q) || given(&q.rate()));
    known.map(Symbol::rate).filter(occurs).collect()
}
