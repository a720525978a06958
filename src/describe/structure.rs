//! The structure of a model: its holonomic and nonholonomic part, and its signature by ranks.

use super::Signature;
use super::found::Found;
use super::general::General;
use super::holonomy::{Holonomy, vector};
use super::realised::Realised;
use crate::error::{Error, Result};
use crate::formula::{Expr, Symbol};
use crate::model::{Model, mechanism, trailer_heading};

/// As many trailers as brackets are taken for: each further one costs several times as much.
const TRAILERS_OF_GROWTH: usize = 5;
/// As many trailers as the ranks of sets are taken for: about a second for the last.
const TRAILERS_OF_RANKS: usize = 20;

/// The holonomic and nonholonomic part of a model, and its RT signature by ranks.
///
/// | part | of | up to |
/// |---|---|---|
/// | holonomy | ideal constraints, creep zero | 5 trailers |
/// | realisation | constraints with creep near zero, logged inputs known | 20 trailers |
///
/// Both are computed in exact arithmetic at two general configurations with the lengths of the model, effects on
/// lengths included, and stand only where the two agree. Longer trains and configurations without exact values are
/// answered in words. Source: the two theorems of section 4 of the paper with its errata.
///
/// ```
/// use creepage::{describe::Structure, model::{Model, Trailer}};
/// let car = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.6)]).unwrap();
/// let structure = Structure::of(&car).unwrap();
/// assert_eq!(structure.holonomy.unwrap().growth, [2, 3, 4, 5]);
/// assert_eq!(structure.realisation.unwrap().signature.to_string(), "R T^2");
/// let train = car.with_trailers(&[Trailer { length: 3.0, hitch: 0.0 }; 6]);
/// assert!(Structure::of(&train).unwrap().holonomy.is_err());
/// ```
#[derive(Clone, Debug)]
pub struct Structure {
    /// Coordinates, the angles that are steered or free among them.
    pub coordinates: Vec<Symbol>,
    /// Parameters that the model leaves open; some value was put in.
    pub open: Vec<Symbol>,
    /// What is holonomic and what is not.
    pub holonomy: Found<Holonomy>,
    /// Which coefficients make the motion.
    pub realisation: Found<Realised>,
}

/// A line of the section on the structure, for every format.
pub(super) enum Line {
    /// What is said in words.
    Words(String),
    /// A list of names after its label.
    Names(String, Vec<Symbol>),
    /// Lists of names after their label.
    Sets(String, Vec<Vec<Symbol>>),
    /// A signature after its label.
    Signature(&'static str, Signature),
    /// name = formula
    Formula(Symbol, Expr),
}

impl Structure {
    /// The structure of a model.
    ///
    /// # Errors
    /// When an effect does not apply, or formulas use each other in a circle.
    pub fn of(model: &Model) -> Result<Self> {
        Self::of_measuring(model, &[])
    }

    /// The structure where some rates are measured beside those that the logged inputs give: the signature is a function of
    /// what is measured.
    ///
    /// ```
    /// use creepage::describe::Structure;
    /// use creepage::model::{Model, Trailer};
    /// let trailers = [Trailer { length: 1.2, hitch: 0.1 }, Trailer { length: 0.8, hitch: 0.0 }];
    /// let train = Model::new("unicycle", &[("wheel_radius", 0.5)]).unwrap().with_trailers(&trailers);
    /// let of = |measured: &[&str]| {
    ///     let measured: Vec<_> = measured.iter().map(|s| (*s).into()).collect();
    ///     Structure::of_measuring(&train, &measured).unwrap().realisation.unwrap().signature.to_string()
    /// };
    /// assert_eq!([of(&[]), of(&["phi_1'"]), of(&["phi_1'", "phi_2'"])], ["R T^3", "R T^2", "R T"]);
    /// ```
    ///
    /// # Errors
    /// As [`Structure::of`]; when a name is no rate of a coordinate.
    pub fn of_measuring(model: &Model, also: &[Symbol]) -> Result<Self> {
        let trailers = model.trailer_count();
        if trailers > TRAILERS_OF_RANKS {
            // The rows of a long train take long to write down and are not needed.
            let mut coordinates = mechanism(&model.vehicle, 0).coordinates;
            coordinates.extend((model.vehicle.trailers.len() + 1..=trailers).map(trailer_heading));
            let [holonomy, ranks] = [TRAILERS_OF_GROWTH, TRAILERS_OF_RANKS].map(|most| too_long(most, trailers));
            return Ok(Self { coordinates, open: vec![], holonomy: Err(holonomy), realisation: Err(ranks) });
        }
        let mechanism = mechanism(&model.vehicle, model.trailers.len());
        let coordinates = mechanism.coordinates.clone();
        let General { points, open } = General::of(model, &mechanism)?;
        let holonomy = match trailers <= TRAILERS_OF_GROWTH {
            true => Holonomy::of(&mechanism, &points),
            false => Err(too_long(TRAILERS_OF_GROWTH, trailers)),
        };
        let is_rate = |s: &&Symbol| coordinates.iter().any(|q| q.rate() == **s);
        if let Some(other) = also.iter().find(|s| !is_rate(s)) {
            let rates: Vec<String> = coordinates.iter().map(|q| q.rate().to_string()).collect();
            return Err(Error::input(format!("{other} is no rate of the model that could be measured"))
                .help(format!("write one of {}", rates.join(", "))));
        }
        let realisation = Realised::of(model, &mechanism, &points, also);
        Ok(Self { coordinates, open, holonomy, realisation })
    }

    /// The integrals and the formulas of passive coefficients.
    pub(super) fn formulas(&self) -> Vec<Expr> {
        let integrals = self.holonomy.iter().flat_map(|h| h.integrals.clone());
        let passive = self.realisation.iter().flat_map(|r| r.passive.iter().filter_map(|(_, f)| f.clone()));
        integrals.chain(passive).collect()
    }

    /// How the section is to be read.
    pub(super) fn reading(&self) -> String {
        let mut said = "Exact, at general configurations with the lengths of the model. A holonomic constraint is the \
                        derivative of an integral and restricts where the vehicle can go; a nonholonomic one \
                        restricts only how it gets there. Both are counted for ideal constraints, without creep."
            .to_string();
        if !self.open.is_empty() {
            let names: Vec<String> = self.open.iter().map(ToString::to_string).collect();
            said += &format!(" The model leaves {} open; some value was put in.", names.join(", "));
        }
        said
    }

    /// The lines on the holonomic and nonholonomic part.
    pub(super) fn holonomy_lines(&self) -> Vec<Line> {
        let mut lines = vec![Line::Names("coordinates".into(), self.coordinates.clone())];
        match &self.holonomy {
            Err(why) => lines.push(Line::Words(format!("holonomic part and growth vector: not computed; {why}"))),
            Ok(h) => lines.extend(holonomy_lines(h)),
        }
        lines
    }

    /// The lines on the signature by ranks.
    pub(super) fn realisation_lines(&self) -> Vec<Line> {
        match &self.realisation {
            Err(why) => vec![Line::Words(format!("RT signature by ranks: not computed; {why}"))],
            Ok(r) => realisation_lines(r),
        }
    }
}

fn too_long(most: usize, trailers: usize) -> String {
    format!("this is done for at most {most} trailers, and the model has {trailers}")
}

fn holonomy_lines(h: &Holonomy) -> Vec<Line> {
    let mut lines = vec![
        Line::Words(format!(
            "independent constraints: {}, of which holonomic: {}, nonholonomic: {}",
            h.rank, h.holonomic, h.nonholonomic
        )),
        Line::Words(format!("growth vector: {}; degree of nonholonomy: {}", vector(&h.growth), h.degree)),
    ];
    let missing = h.holonomic.saturating_sub(h.integrals.len());
    lines.push(Line::Words(match (h.integrals.len(), missing) {
        (0, 0) => "integrals: none".into(),
        (_, 0) => "integrals, constant in every motion without creep:".into(),
        (found, _) => format!("integrals: {found} found, {missing} more exist and are not written as a formula"),
    }));
    let named = h.integrals.iter().enumerate();
    lines.extend(named.map(|(k, f)| Line::Formula(Symbol::new(&format!("h_{}", k + 1)), f.clone())));
    lines
}

fn realisation_lines(r: &Realised) -> Vec<Line> {
    let mut lines = vec![
        Line::Names("measured rates in the rows".into(), r.measured.clone()),
        Line::Names("rates in the rows that are not measured".into(), r.unknown.clone()),
        Line::Signature("RT signature by ranks", r.signature.clone()),
        Line::Names("its coefficients, the canonical set".into(), r.canonical.clone()),
    ];
    let at_least = if r.is_complete { "" } else { "at least " };
    let first = if r.others.len() < r.other_count { ", the first of them" } else { "" };
    lines.push(match r.other_count {
        0 => Line::Words("other smallest sets: none".into()),
        n => Line::Sets(format!("other smallest sets: {at_least}{n}{first}"), r.others.clone()),
    });
    let passive = r.passive.iter().map(|(e, _)| e.clone()).collect();
    lines.push(Line::Names("passive coefficients, which follow from the canonical set".into(), passive));
    let formula = |(e, f): &(Symbol, Option<Expr>)| Some(Line::Formula(e.clone(), f.clone()?));
    lines.extend(r.passive.iter().filter_map(formula));
    lines
}
