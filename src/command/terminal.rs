//! The terminal: how wide it is, and colours where it has them.

use crate::discrepancy::rendering::patched_state::State;
use console::{Style, Term};

/// Columns of what is no terminal, and the most that text is set in: longer lines are hard to read.
const COLUMNS: [usize; 2] = [80, 120];

/// Columns for text on standard output.
pub fn columns() -> usize {
    let of = Term::stdout().size_checked().map(|(_, columns)| usize::from(columns));
    of.map_or(COLUMNS[0], |c| c.clamp(COLUMNS[0], COLUMNS[1]))
}

/// A text whose first words, up to the colon, have the colour of a state; as it is where there are no colours, or NO_COLOR
/// is set.
pub fn headed(text: &str, state: State) -> String {
    let style = match state {
        State::Good => Style::new().green(),
        State::Doubtful => Style::new().yellow(),
        State::NotUsable => Style::new().red(),
    };
    match text.split_once(':') {
        Some((name, rest)) => format!("{}:{rest}", style.bold().apply_to(name)),
        None => text.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_stand_around_the_first_words_alone_and_only_where_there_are_any() {
        console::set_colors_enabled(true);
        let told = headed("Missing effect: creep: 1\n", State::Good);
        console::set_colors_enabled(false);
        assert!(told.starts_with("\u{1b}[") && told.ends_with("m: creep: 1\n"), "{told:?}");
        assert!(told.contains("Missing effect"));
        assert_eq!(headed("Missing effect: creep: 1\n", State::Doubtful), "Missing effect: creep: 1\n");
        assert_eq!(headed("no colon", State::NotUsable), "no colon");
        assert!((80..=120).contains(&columns()));
    }
}
