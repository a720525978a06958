//! Numbers in a text, rounded so that they stand still.

/// A text whose numbers with a decimal point have four digits; those too small to matter are zero without a sign.
pub fn in_four_digits(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(|c: char| c.is_ascii_digit()) {
        let (before, from) = rest.split_at(at);
        let number = &from[..length(from)];
        out.push_str(before);
        rest = &from[number.len()..];
        // Digits of a name or of a version stay as they are.
        let own = !before.ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '.') && !rest.starts_with('.');
        match number.parse::<f64>() {
            Ok(x) if own && number.contains('.') => {
                if x < 1e-9 && out.ends_with('-') {
                    out.pop();
                }
                let x = if x < 1e-9 { 0.0 } else { x };
                out.push_str(&format!("{x:.3e}").parse::<f64>().unwrap().to_string());
            }
            _ => out.push_str(number),
        }
    }
    out + rest
}

/// How many bytes of a text are a number that it begins with.
fn length(text: &str) -> usize {
    let digits = |from: usize| from + text[from..].bytes().take_while(u8::is_ascii_digit).count();
    let whole = digits(0);
    let part = match text[whole..].strip_prefix('.') {
        Some(_) if digits(whole + 1) > whole + 1 => digits(whole + 1),
        _ => whole,
    };
    let Some(power) = text[part..].strip_prefix('e') else { return part };
    let from = part + 1 + usize::from(power.starts_with('-'));
    if digits(from) > from { digits(from) } else { part }
}
