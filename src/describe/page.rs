//! Text for a terminal: headings, paragraphs, tables and formulas, wrapped.

/// Widest line, unless a single name is wider.
pub(super) const WIDTH: usize = 96;
const INDENT: &str = "    ";

/// A text that grows; formulas stand four columns in, so that Markdown leaves them alone.
#[derive(Default)]
pub(super) struct Page(String);

impl Page {
    /// The text, ending in one line end.
    pub fn finished(self) -> String {
        format!("{}\n", self.0.trim())
    }

    /// A heading of some depth with blank lines around it.
    pub fn heading(&mut self, depth: usize, text: &str) {
        let start = if self.0.is_empty() || self.0.ends_with("\n\n") { "" } else { "\n" };
        self.0 += &format!("{start}{} {text}\n\n", "#".repeat(depth));
    }

    /// A paragraph.
    pub fn paragraph(&mut self, text: &str) {
        self.0 += &format!("{}\n\n", wrapped(text, "", ""));
    }

    /// A line, followed by formulas without a blank line between.
    pub fn line(&mut self, text: &str) {
        self.0 += &format!("{}\n", wrapped(text, "", "  "));
    }

    /// An entry of a list.
    pub fn entry(&mut self, text: &str) {
        self.0 += &format!("{}\n", wrapped(text, "- ", "  "));
    }

    /// A formula on its own lines.
    pub fn formula(&mut self, text: &str) {
        self.0 += &format!("{}\n", broken(text));
    }

    /// A blank line, if there is none yet.
    pub fn gap(&mut self) {
        if !self.0.ends_with("\n\n") {
            self.0.push('\n');
        }
    }

    /// Rows of cells in columns; the last column wraps.
    pub fn table(&mut self, header: &[&str], rows: &[Vec<String>]) {
        let last = header.len() - 1;
        let longest = |k: usize| rows.iter().map(|r| r[k].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..last).map(|k| longest(k).max(header[k].chars().count())).collect();
        let before: usize = widths.iter().map(|w| w + 2).sum();
        let mut line = |cells: &[&str]| {
            let start: String = cells[..last].iter().zip(&widths).map(|(c, w)| format!("{c:<w$}  ")).collect();
            let text = wrapped(cells[last], &start, &" ".repeat(before));
            self.0 += &format!("{}\n", text.trim_end());
        };
        line(header);
        let rules: Vec<String> =
            widths.iter().map(|w| "-".repeat(*w)).chain(["-".repeat(header[last].len())]).collect();
        line(&rules.iter().map(String::as_str).collect::<Vec<_>>());
        rows.iter().for_each(|r| line(&r.iter().map(String::as_str).collect::<Vec<_>>()));
        self.gap();
    }
}

/// Words in lines no wider than the page.
fn wrapped(text: &str, first: &str, later: &str) -> String {
    let mut lines = vec![first.to_string()];
    let mut empty = true;
    for word in text.split_whitespace() {
        let line = lines.last_mut().map_or(0, |l| l.chars().count());
        if !empty && line + 1 + word.chars().count() > WIDTH {
            lines.push(later.to_string());
            empty = true;
        }
        if let Some(line) = lines.last_mut() {
            if !empty {
                line.push(' ');
            }
            line.push_str(word);
        }
        empty = false;
    }
    lines.join("\n")
}

/// A formula broken before operators, outside parentheses where it can be.
fn broken(text: &str) -> String {
    let mut lines = Vec::new();
    let (mut rest, mut indent) = (text, INDENT.to_string());
    while indent.len() + rest.chars().count() > WIDTH {
        let room = WIDTH - indent.len();
        let Some([end, next]) = break_at(rest, room).or_else(|| break_in_product(rest, room)) else { break };
        lines.push(format!("{indent}{}", rest[..end].trim_end()));
        rest = &rest[next..];
        indent = INDENT.repeat(2);
    }
    lines.push(format!("{indent}{rest}"));
    lines.join("\n")
}

/// Behind the last `*` that a line has room for, of a term longer than a line.
fn break_in_product(text: &str, room: usize) -> Option<[usize; 2]> {
    let fitting = text.char_indices().take(room);
    fitting.filter(|(_, c)| *c == '*').last().map(|(i, _)| [i + 1; 2])
}

/// The blank where a formula is best broken, its place and that behind it: before `+` or `-` or after a comma, least nested,
/// then last.
fn break_at(text: &str, room: usize) -> Option<[usize; 2]> {
    let mut depth = 0i32;
    let mut best: Option<(i32, usize)> = None;
    for (column, (i, c)) in text.char_indices().enumerate() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            ' ' if column > 0 && column <= room => {
                let operator = text[i + 1..].starts_with(['+', '-']) || text[..i].ends_with(',');
                if operator && best.is_none_or(|(d, _)| depth <= d) {
                    best = Some((depth, i));
                }
            }
            _ => {}
        }
    }
    best.map(|(_, i)| [i, i + 1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_is_broken_where_it_is_least_nested() {
        let term = "sin(a + b)*x'";
        let long = vec![term; 20].join(" + ");
        for line in broken(&long).lines() {
            assert!(line.len() <= WIDTH, "{line}");
            assert!(line.trim().trim_start_matches("+ ").starts_with("sin(a + b)"), "{line}");
        }
        assert_eq!(broken("a + b"), "    a + b");
        let product = ["a_long_name"; 20].join("*");
        let lines = broken(&product);
        assert!(lines.lines().count() == 3 && lines.lines().all(|l| l.len() <= WIDTH), "{lines}");
        assert_eq!(lines.split_whitespace().collect::<String>(), product);
    }

    #[test]
    fn nothing_is_lost_by_wrapping() {
        let words = "one two three ".repeat(40);
        let text = wrapped(&words, "- ", "  ");
        assert!(text.lines().all(|l| l.chars().count() <= WIDTH));
        assert_eq!(
            text.replacen("- ", "", 1).split_whitespace().collect::<Vec<_>>(),
            words.split_whitespace().collect::<Vec<_>>()
        );
    }
}
