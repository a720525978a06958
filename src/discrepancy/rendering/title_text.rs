//! The title of an effect: its id, with the input it acts on, its scope and its course.

use crate::discrepancy::report::Named;

/// The id, with the input, the scope and the course in brackets where there are such.
pub(crate) fn title(effect: &Named) -> String {
    let course = effect.parameters.iter().filter_map(|(name, p)| Some((name, p.course.as_ref()?)));
    let course = course.map(|(name, c)| match c.per_s {
        Some(_) => format!("{name} moving with time"),
        None => format!("{name} walking at random"),
    });
    let scope = effect.scope.as_ref().map(|s| s.says.clone());
    let all: Vec<String> = effect.on.clone().into_iter().chain(scope).chain(course).collect();
    if all.is_empty() { effect.id.clone() } else { format!("{} ({})", effect.id, all.join(", ")) }
}
