//! "Did you mean": the known name nearest to an unknown one, by edit distance (Levenshtein).

/// Names listed in one piece of advice; a CSV may have hundreds of columns.
const LISTED: usize = 16;
/// The most characters a message shows of a name: it stays on one line of a terminal.
const MAX_SHOWN_CHARACTERS: usize = 40;
/// Characters of a library's reason that are shown.
#[cfg(any(feature = "parquet", feature = "mcap"))]
const MAX_REASON_CHARACTERS: usize = 200;
/// The longest word that is compared, in characters: the distance takes quadratic time, and no id is longer.
const MAX_COMPARED_CHARACTERS: usize = 64;

/// Advice for an unknown `word`: the nearest candidate, and what there is.
pub(crate) fn advice(word: &str, noun: &str, candidates: &[&str]) -> String {
    let there = format!("{noun}: {}", list(candidates));
    match nearest(word, candidates) {
        Some(near) => format!("did you mean \"{}\"? {there}", shown(near)),
        None => there,
    }
}

/// The names with commas, cut short when there are many.
pub(crate) fn list(names: &[&str]) -> String {
    let mut text = names.iter().take(LISTED).map(|name| shown(name)).collect::<Vec<_>>().join(", ");
    if names.len() > LISTED {
        text.push_str(&format!(", … ({} in all)", names.len()));
    }
    if text.is_empty() { "none".into() } else { text }
}

/// A text from a file as a message may show it: one line, not too long, nothing that moves the cursor.
pub(crate) fn shown(text: &str) -> String {
    let mut chars = text.chars().map(|c| if c.is_control() { ' ' } else { c });
    let start: String = chars.by_ref().take(MAX_SHOWN_CHARACTERS).collect();
    if chars.next().is_some() { start + "…" } else { start }
}

/// Why a library cannot read a file, as a message may show it: one line, longer than a name.
#[cfg(any(feature = "parquet", feature = "mcap"))]
pub(crate) fn reason(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).take(MAX_REASON_CHARACTERS).collect()
}

/// The candidate nearest to `word`, if one is near enough to be meant.
pub(crate) fn nearest<'a>(word: &str, candidates: &[&'a str]) -> Option<&'a str> {
    let word = plain(word);
    if word.is_empty() || word.len() > MAX_COMPARED_CHARACTERS {
        return None;
    }
    let slips = |candidate: &&str| {
        let candidate = plain(candidate);
        (candidate.len() <= MAX_COMPARED_CHARACTERS).then(|| strsim::generic_levenshtein(&word, &candidate))
    };
    let close = candidates.iter().filter_map(|c| slips(c).map(|d| (d, *c))).min_by_key(|(d, _)| *d);
    match close {
        Some((d, candidate)) if d <= word.len() / 3 => Some(candidate),
        _ => candidates.iter().copied().find(|c| holds(&plain(c), &word) || shortens(&word, &plain(c))),
    }
}

/// The parts of one name begin those of the other, as `diff-drive` does `differential-drive`.
fn shortens(short: &[char], long: &[char]) -> bool {
    let parts = |name: &[char]| name.split(|c| *c == '_').map(<[char]>::to_vec).collect::<Vec<_>>();
    let (short, long) = (parts(short), parts(long));
    short.len() == long.len() && short.iter().zip(&long).all(|(s, l)| s.len() >= 3 && l.starts_with(s))
}

/// One name is a part of the other, and long enough for that to mean something.
fn holds(a: &[char], b: &[char]) -> bool {
    let (short, long) = if a.len() < b.len() { (a, b) } else { (b, a) };
    short.len() >= 3 && long.len() <= MAX_COMPARED_CHARACTERS && long.windows(short.len()).any(|w| w == short)
}

/// Lower case, with every separator alike.
fn plain(word: &str) -> Vec<char> {
    let same = |c: char| if matches!(c, '-' | ' ' | '.') { '_' } else { c };
    word.chars().take(MAX_COMPARED_CHARACTERS + 1).flat_map(char::to_lowercase).map(same).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_known() {
        let d = |a: &str, b: &str| strsim::generic_levenshtein(&plain(a), &plain(b));
        assert_eq!(d("kitten", "sitting"), 3);
        assert_eq!(d("", "abc"), 3);
        assert_eq!(d("Wheel-Rate", "wheel_rate"), 0);
    }

    #[test]
    fn only_a_near_name_is_meant() {
        let keys = ["wheel_radius", "wheelbase", "x"];
        assert_eq!(nearest("wheel_raduis", &keys), Some("wheel_radius"));
        assert_eq!(nearest("radius", &keys), Some("wheel_radius"));
        assert_eq!(nearest("X", &keys), Some("x"));
        assert_eq!(nearest("y", &keys), None);
        let vehicles = ["unicycle", "differential-drive", "differential-drive-castor", "n-trailer"];
        assert_eq!(nearest("diff_drive", &vehicles), Some("differential-drive"));
        assert_eq!(nearest("di-dr", &vehicles), None);
        assert_eq!(nearest("temperature", &keys), None);
        assert_eq!(nearest(&"w".repeat(1_000_000), &keys), None);
    }

    #[test]
    fn advice_sends_nothing_to_the_terminal() {
        let said = advice("yaw_rate", "columns", &["yaw_rate\u{1b}[2J", "x"]);
        assert!(said.starts_with("did you mean \"yaw_rate [2J\"?") && !said.contains('\u{1b}'), "{said:?}");
    }

    /// Words up to a length are compared; a list shows sixteen names, and says how many there are beyond.
    #[test]
    fn lengths_have_their_bounds() {
        let [most, more] = [64, 65].map(|n| "w".repeat(n));
        assert_eq!(nearest(&most, &[&most]), Some(most.as_str()));
        for (word, candidate) in [(&more, &more), (&more, &most)] {
            assert_eq!(nearest(word, &[candidate]), None);
        }
        let names: Vec<String> = (0..17).map(|i| format!("n{i}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        assert!(list(&names[..16]).ends_with(", n15"));
        assert!(list(&names).ends_with(", n15, … (17 in all)"));
    }
}
