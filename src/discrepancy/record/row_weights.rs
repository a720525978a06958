//! Weights of rows whose standard deviations a log gives.

use super::local_polynomial::median;
use crate::files::Run;
use crate::model::observation::{BODY_HEADING, PLACE};

/// The weight of each row of each measured column, σ̄/σᵢ.
///
/// The variance of a component of the measurement noise is that of a row with the usual deviation, and of row i it is
/// multiplied by (σᵢ/σ̄)²: what a log says of its rows is taken as relative, and the data say how large the noise is.
///
/// | symbol | meaning |
/// |---|---|
/// | σᵢ | deviation of row i by the log; the usual one where the log gives none |
/// | σ̄ | the usual deviation, the median over the rows |
///
/// A row counts at most as one of a tenth of the usual deviation: below it no pose is right that a model is wrong by.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RowWeights {
    /// Column by column; none where all rows count alike.
    columns: Vec<Option<Vec<f64>>>,
}

/// The largest weight of a row.
const LARGEST: f64 = 10.0;

impl RowWeights {
    /// The weights of columns; none where all rows of one count alike.
    pub fn new(columns: Vec<Option<Vec<f64>>>) -> Self {
        Self { columns }
    }

    /// By the deviations that a run has of its pose.
    pub fn of_run(run: &Run) -> Self {
        let (x, y, heading) = (PLACE[0], PLACE[1], BODY_HEADING);
        let given = [(x, &run.deviations.x), (y, &run.deviations.y), (heading, &run.deviations.heading)];
        let measured = given.into_iter().filter(|(column, _)| *column != heading || run.heading.is_some());
        let columns = measured.map(|(_, deviations)| deviations.as_deref().and_then(relative)).collect();
        Self::new(columns)
    }

    /// The weights of the rows of a column; none where all count alike.
    #[inline(always)]
    pub fn of(&self, column: usize) -> Option<&[f64]> {
        self.columns.get(column)?.as_deref()
    }

    /// The deviation of a row of a column in units of the usual one.
    pub fn deviation(&self, column: usize, row: usize) -> f64 {
        self.of(column).map_or(1.0, |weights| 1.0 / weights[row])
    }

    /// Those of some rows.
    pub fn keeping(&self, pick: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        Self { columns: self.columns.iter().map(|c| c.as_deref().map(&pick)).collect() }
    }
}

/// σ̄/σᵢ row by row; none where they are all alike, or no row has a deviation.
fn relative(deviations: &[f64]) -> Option<Vec<f64>> {
    let mut given: Vec<f64> = deviations.iter().copied().filter(|d| d.is_finite()).collect();
    let usual = median(&mut given)?;
    let weight = |d: &f64| if d.is_finite() { (usual / d).min(LARGEST) } else { 1.0 };
    let weights: Vec<f64> = deviations.iter().map(weight).collect();
    weights.iter().any(|w| *w != 1.0).then_some(weights)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::unicycle_file;
    use crate::discrepancy::record::run_record::Record;

    #[test]
    fn rows_count_by_their_deviations() {
        assert_eq!(relative(&[0.02; 5]), None);
        assert_eq!(relative(&[f64::NAN; 3]), None);
        let weights = relative(&[0.5, 1.0, f64::NAN, 1.0, 4.0, 1e-9, 1.0]).unwrap();
        assert_eq!(weights, [2.0, 1.0, 1.0, 1.0, 0.25, LARGEST, 1.0]);
    }

    /// The deviations of a log are those of its columns, and stay with their rows.
    #[test]
    fn a_record_has_the_weights_of_its_log() {
        let file = unicycle_file("[columns]\nsigma_y = \"s\"\nsigma_heading = { column = \"h\", unit = \"deg\" }\n");
        let log = |heading: &str, cell: &str| {
            let head = format!("time,x,y,wheel_rate,yaw_rate,s,h{heading}\n");
            let rows = ["0,0,0,1,0,1,2", "1,1,0,1,0,1,2", "2,2,0,1,0,4,1"];
            head + &rows.map(|row| format!("{row}{cell}\n")).concat()
        };
        let record = |log: &str| Record::of_run(&Run::parse("run.csv", log, &file).unwrap(), file.input_timing, 0);
        let whole = record(&log(",heading", ",0"));
        assert_eq!([0, 1, 2].map(|c| whole.weights.of(c).is_some()), [false, true, true]);
        assert_eq!([0, 1, 2].map(|i| whole.weights.deviation(1, i)), [1.0, 1.0, 4.0]);
        assert!((whole.weights.deviation(2, 2) - 0.5).abs() < 1e-12);
        let kept = whole.keeping(|i| i > 0);
        assert_eq!([0, 1].map(|i| kept.weights.deviation(1, i)), [1.0, 4.0]);
        let places = record(&log("", ""));
        assert!(places.weights.of(1).is_some() && places.weights.of(2).is_none());
    }
}
