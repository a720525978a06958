//! What a discovery gives to its caller: the report, the patched model, and the page.

use super::model::Model;
use crate::discrepancy::rendering::html::html;
use crate::discrepancy::rendering::summary::summary_text;
use crate::discrepancy::report::{Pictures, Report};
use crate::error::Result;

/// The answer of [`discover`](crate::discover).
///
/// ```
/// # use creepage::{Model, Run};
/// # let model = Model::read("examples/runs/cornering/model.toml")?;
/// # let eights = Run::read("examples/runs/cornering/eights.csv", &model)?;
/// let found: creepage::Discovery = creepage::discover(&model, &[eights])?;
/// assert!(found.text().contains("cornering-creep") && found.html().ends_with("</html>\n"));
/// assert!(found.model.text().contains("mass_over_bT"));
/// # Ok::<(), creepage::Error>(())
/// ```
pub struct Discovery {
    /// Verdict, effects, gaps and all else of `report.json`.
    pub report: Report,
    /// The model with what was found added to it.
    pub model: Model,
    pub(super) pictures: Pictures,
}

impl Discovery {
    /// The report as JSON, the bytes of the command's `report.json`.
    ///
    /// # Errors
    /// When a number of the report has no JSON.
    pub fn json(&self) -> Result<String> {
        self.report.json()
    }

    /// The report as a page that needs no other file.
    pub fn html(&self) -> String {
        html(&self.report, &self.pictures)
    }

    /// The report on one screen.
    pub fn text(&self) -> String {
        summary_text(&self.report)
    }
}
