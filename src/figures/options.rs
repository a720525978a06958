//! The options a figure is drawn with.

use crate::energy_rule::Reading;
use crate::error::{Error, Result};

/// Coefficients and the reading of Fig. 7.
///
/// | symbol | unit | meaning |
/// |---|---|---|
/// | e_rc | 1 | coefficient of rotation creep (8), below 1 |
/// | e_tc | 1 | coefficient of traverse creep (17) |
///
/// Figures have values of their own, larger than real ones, so that an angle can be seen; those given here take their
/// place. Fig. 7 has the paper's four cases and takes none.
///
/// ```
/// use creepage::figures::Options;
/// let options = Options::new(Some(0.1), None, "A").unwrap();
/// assert_eq!((options.e_rc, options.e_tc), (Some(0.1), None));
/// assert_eq!(Options::new(Some(1.5), None, "A").unwrap_err().exit_code(), 2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Rotation creep.
    pub e_rc: Option<f64>,
    /// Traverse creep.
    pub e_tc: Option<f64>,
    /// Reading of "conservative" in Fig. 7.
    pub reading: Reading,
}

impl Default for Options {
    fn default() -> Self {
        Self { e_rc: None, e_tc: None, reading: Reading::A }
    }
}

/// Creep beyond this would leave the paper.
const MAX_CREEP: f64 = 0.6;

impl Options {
    /// Options as they are typed.
    ///
    /// # Errors
    /// When a coefficient is not a number within ±0.6, or no reading has that name.
    pub fn new(e_rc: Option<f64>, e_tc: Option<f64>, reading: &str) -> Result<Self> {
        for (name, e) in [("e_rc", e_rc), ("e_tc", e_tc)] {
            if e.is_some_and(|e| !e.is_finite() || e.abs() > MAX_CREEP) {
                return Err(Error::input(format!("{name} has to lie within −{MAX_CREEP} and {MAX_CREEP}"))
                    .help("the figures are drawn for creep, not for sliding; try 0.2"));
            }
        }
        Ok(Self { e_rc, e_tc, reading: reading_named(reading)? })
    }

    /// Rotation creep, or a figure's own.
    pub fn rotation(&self, own: f64) -> f64 {
        self.e_rc.unwrap_or(own)
    }

    /// Traverse creep, or a figure's own.
    pub fn traverse(&self, own: f64) -> f64 {
        self.e_tc.unwrap_or(own)
    }
}

/// A reading of "conservative" by its name; the one without a rule is drawn anyway.
fn reading_named(name: &str) -> Result<Reading> {
    let readings = || Reading::ALL.into_iter().filter(|r| *r != Reading::NonConservative);
    readings().find(|r| r.name().eq_ignore_ascii_case(name)).ok_or_else(|| {
        let names: Vec<&str> = readings().map(Reading::name).collect();
        Error::input(format!("no reading of \"conservative\" is called {:?}", crate::files::shown(name)))
            .help(crate::files::advice(name, "readings", &names))
    })
}
