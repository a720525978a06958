//! A contact with the ground: its slip, and the law of its force.

use super::law::Law;
use crate::error::Error;
use crate::formula::{Expr, Symbol};
use crate::mechanism::{Constraint, Part, Row};

/// A contact of a wheel or an axle with the ground, in one of its two senses: rolling or direction.
#[derive(Clone, Debug)]
pub struct Contact {
    /// What it is called in model files: `rear-axle-rolling`, `trailer-1-direction`.
    pub name: String,
    /// `R` for rolling, `T` for a direction.
    pub letter: char,
    /// The slip as a linear form in the rates, m/s: v_A = v_l − r·ω, or v_t to the left.
    pub slip: Row,
    /// The speed of the contact along the wheel, m/s.
    pub speed: Row,
    /// Its law with the values of the parameters in their order; `None` where it is ideal.
    pub law: Option<(Law, Vec<f64>)>,
}

/// A constraint's name as a key: lower case, `-` between the words.
pub(crate) fn slug(name: &str) -> String {
    let words = name.split(|c: char| !c.is_alphanumeric()).filter(|w| !w.is_empty());
    words.map(str::to_lowercase).collect::<Vec<_>>().join("-")
}

impl Contact {
    /// The contact of a constraint, ideal.
    pub(super) fn of(constraint: &Constraint) -> Self {
        let ideal = |s: &Symbol| (*s == constraint.creep).then(|| Expr::int(0));
        let form = &constraint.form;
        let factor = |slot: &str| form.slot(slot).map_or_else(|| Expr::int(0), Part::expr);
        let rates = |slot: &str| match form.slot(slot) {
            Some(Part::Rates(row)) => row.clone(),
            _ => Row::default(),
        };
        // v_t counts to the left, the row of a direction to the right.
        let (slip, speed) = match form.kind().id.as_str() {
            "direction" => {
                let along = rates("q1'").times(&factor("p")).plus(&factor("s"), &rates("q3'"));
                (constraint.ideal_row().times(&Expr::int(-1)), along)
            }
            _ => (constraint.ideal_row(), rates("pi'")),
        };
        let speed = speed.substitute(&ideal);
        Self { name: slug(&constraint.name), letter: constraint.letter(), slip, speed, law: None }
    }

    /// The force along the slip as a formula of rates, states and symbols of the law; `None` where it is ideal.
    pub(crate) fn force(&self, number: usize) -> Option<Expr> {
        self.law.as_ref().map(|(law, _)| law.written(&law.force, number, &self.by_rates(number)))
    }

    /// The state of its law, and the state's rate.
    pub(crate) fn memory(&self, number: usize) -> Option<(Symbol, Expr)> {
        let (law, _) = self.law.as_ref()?;
        let rate = law.written(law.rate.as_ref()?, number, &self.by_rates(number));
        Some((Law::symbol("deflection", number), rate))
    }

    /// Slip and speed as linear forms in the rates.
    fn by_rates(&self, number: usize) -> impl Fn(&str) -> Expr {
        move |name| match name {
            "slip" => self.slip.expr(),
            "speed" => self.speed.expr(),
            _ => Expr::sym(Law::symbol(name, number)),
        }
    }

    /// What a steering that swings an ideal contact is refused with.
    pub(crate) fn swung_error(&self) -> Error {
        Error::input(format!("{} is swung by the steering, whose acceleration is not known", self.name))
            .help("give this contact a law of friction")
    }

    /// Symbols and values of its law.
    pub(super) fn values(&self, number: usize) -> Vec<(Symbol, f64)> {
        let Some((law, values)) = &self.law else { return vec![] };
        let named = law.parameters.iter().zip(values);
        named.map(|(p, v)| (Law::symbol(&p.name, number), *v)).collect()
    }
}
