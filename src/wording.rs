//! English phrases that several rooms need: lists of names, the reason of rows left out.

use std::borrow::Borrow;

/// Why rows are left out whose measured pose is grossly wrong.
pub(crate) const GROSS: &str = "gross error of a measurement";

/// Why rows are left out around a jump of the reference.
pub(crate) const JUMPED: &str = "the reference jumps";

/// Why rows are left out whose pose is that of the row before.
pub(crate) const HELD: &str = "the measured pose repeats";

/// Why rows are left out in which something else moves the vehicle, or nothing.
pub(crate) const LIFTED: &str = "the vehicle is lifted or carried";

/// A count with its noun, such as "1 run" or "3 runs".
pub(crate) fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

/// Names as a phrase: "a", "a and b", "a, b and c".
pub(crate) fn listed<S: Borrow<str>>(names: impl IntoIterator<Item = S>) -> String {
    let names: Vec<S> = names.into_iter().collect();
    match names.split_last() {
        None => "an effect".into(),
        Some((last, [])) => last.borrow().into(),
        Some((last, rest)) => format!("{} and {}", rest.join(", "), last.borrow()),
    }
}

/// The first names as a phrase, and how many more there are.
pub(crate) fn listed_to(names: &[String], most: usize) -> String {
    let more = names.len().saturating_sub(most);
    let rest = (more > 0).then(|| format!("{more} more"));
    listed(names.iter().take(most).chain(&rest).map(String::as_str))
}
