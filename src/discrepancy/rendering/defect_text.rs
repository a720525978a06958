//! Defects of rows in words.

use crate::discrepancy::preprocessing::row_defects::{DefectKind, RowDefect};
use crate::number_format::significant;
use crate::wording::listed_to;

/// Places that are listed.
const PLACES: usize = 4;

/// A defect as a sentence, with its place and how many rows have it.
pub fn sentence(of: &RowDefect) -> String {
    let run = &of.run;
    match &of.kind {
        DefectKind::Held { rows, all, every } => format!(
            "{run}: {rows} of {all} rows repeat the measured pose of the row before while the inputs say motion: it is measured \
             every {} s and filled forward; it is left out of these rows",
            significant(*every, 2)
        ),
        DefectKind::Repeated { rows: 1, first } => {
            format!(
                "{run}: the row at {first:.1} s repeats the one before it, inputs and pose, in motion; it is left out"
            )
        }
        DefectKind::Repeated { rows, first } => format!(
            "{run}: {rows} rows repeat the one before them, inputs and pose, in motion, the first at {first:.1} s; they are left \
             out"
        ),
        DefectKind::Spikes { role, at } => {
            let places: Vec<String> = at.iter().map(|t| format!("{t:.1} s")).collect();
            let (rows, verb) =
                if at.len() == 1 { ("1 row", "it is") } else { (&*format!("{} rows", at.len()), "they are") };
            format!(
                "{run}: {role} has spikes of one row that the vehicle did not follow, in {rows}, at {}; {verb} read as if not there",
                listed_to(&places, PLACES)
            )
        }
        DefectKind::Clipped { role, value, rows, times } => format!(
            "{run}: {role} stands at its {} value, {}, in {rows} rows, {times} times for a while, and the vehicle does more there: \
             was it cut off before it was logged?",
            if *value < 0.0 { "least" } else { "largest" },
            significant(*value, 3)
        ),
        DefectKind::Stands([from, to]) => format!(
            "{run}: the inputs say motion and the measured pose stands still between {from:.1} and {to:.1} s: was the vehicle \
             lifted, or do its wheels spin? This stretch is left out"
        ),
        DefectKind::Carried([from, to]) => format!(
            "{run}: the measured pose moves and the inputs say none between {from:.1} and {to:.1} s: was the vehicle carried, or \
             are inputs missing? This stretch is left out"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_and_counts_are_said() {
        let says = |kind| sentence(&RowDefect { run: "a.csv".into(), kind });
        let spikes = |n: i32| {
            says(DefectKind::Spikes { role: "speed".into(), at: (0..n).map(|i| 1.5 + f64::from(i)).collect() })
        };
        assert!(spikes(1).contains("in 1 row, at 1.5 s; it is read"), "{}", spikes(1));
        assert!(spikes(6).contains("in 6 rows, at 1.5 s, 2.5 s, 3.5 s, 4.5 s and 2 more; they are"), "{}", spikes(6));
        let repeated = |rows| says(DefectKind::Repeated { rows, first: 2.0 });
        assert!(repeated(1).contains("the row at 2.0 s repeats") && repeated(4).contains("4 rows repeat the one"));
        let clipped = |value| says(DefectKind::Clipped { role: "speed".into(), value, rows: 90, times: 4 });
        assert!(
            clipped(1.25).contains("speed stands at its largest value, 1.25, in 90 rows, 4 times"),
            "{}",
            clipped(1.25)
        );
        assert!(clipped(-1.25).contains("its least value, −1.25"), "{}", clipped(-1.25));
    }
}
