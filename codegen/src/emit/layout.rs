//! Lines that a person can read: words, lists and expressions cut to a width.

/// The longest line of generated source.
pub(super) const WIDTH: usize = 100;

/// Words in lines of at most `width` characters, unless a word alone is longer.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    filled(text.split(' ').map(str::to_owned), width)
}

/// Parts with blanks between them in lines of at most `width` characters, unless a part alone is longer.
fn filled(parts: impl Iterator<Item = String>, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for part in parts {
        match lines.last_mut().filter(|line| line.chars().count() + 1 + part.chars().count() <= width) {
            Some(line) => {
                line.push(' ');
                line.push_str(&part);
            }
            None => lines.push(part),
        }
    }
    lines
}

/// `head`, the items between commas, `tail`: on one line if that fits, else the items on lines of their own, indented by
/// `indent`, and `tail` by four less.
pub(super) fn listed(head: &str, items: &[String], tail: &str, indent: usize) -> String {
    let line = format!("{head}{}{tail}", items.join(", "));
    if longest(&line) <= WIDTH || items.is_empty() {
        return line;
    }
    let (inner, outer) = (" ".repeat(indent), " ".repeat(indent.saturating_sub(4)));
    let last = items.len() - 1;
    let parts = items.iter().enumerate().map(|(at, item)| format!("{item}{}", if at < last { "," } else { "" }));
    let rows = filled(parts, WIDTH - indent);
    let rows: String = rows.iter().map(|row| format!("{inner}{row}\n")).collect();
    format!("{head}\n{rows}{outer}{tail}")
}

fn longest(text: &str) -> usize {
    text.lines().map(|line| line.chars().count()).max().unwrap_or(0)
}

/// An expression's text cut before the operators that stand in no brackets, one term a line; a term too long for a line is
/// cut before its factors, or within its brackets. `room` is what the first line has.
pub(super) fn terms(expression: &str, room: usize) -> Vec<String> {
    if expression.chars().count() <= room {
        return vec![expression.to_owned()];
    }
    cut(expression, 0, &[" + ", " - ", " − "]).into_iter().flat_map(|term| shorter(term, 0)).collect()
}

/// A term in lines that fit, cut deeper and deeper.
fn shorter(term: String, depth: i32) -> Vec<String> {
    const DEEPEST: i32 = 4;
    if term.chars().count() <= WIDTH - 8 || depth > DEEPEST {
        return vec![term];
    }
    let factors = cut(&term, depth, &[" * ", " / "]);
    let parts = if factors.len() > 1 { factors } else { cut(&term, depth + 1, &[" + ", " - ", " − "]) };
    let inner = if parts.len() > 1 { depth } else { depth + 1 };
    let mut lines = parts.into_iter().flat_map(|part| shorter(part, inner + 1));
    let first = lines.next();
    first.into_iter().chain(lines.map(|line| format!("  {line}"))).collect()
}

/// Cuts before the operators that stand in at most `depth` brackets.
fn cut(text: &str, depth: i32, operators: &[&str]) -> Vec<String> {
    let (mut open, mut start, mut parts) = (0_i32, 0, Vec::new());
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' | '{' => open += 1,
            ')' | ']' | '}' => open -= 1,
            ' ' if open <= depth && at > start && operators.iter().any(|o| text[at..].starts_with(o)) => {
                parts.push(text[start..at].to_owned());
                start = at + 1;
            }
            _ => {}
        }
    }
    parts.push(text[start..].to_owned());
    parts
}

/// `start` and an expression, one term a line where it does not fit into one; further lines are indented by `indent`.
pub(super) fn equation(start: &str, expression: &str, indent: usize) -> String {
    let lines = terms(expression, WIDTH.saturating_sub(start.chars().count()));
    format!("{start}{}", lines.join(&format!("\n{}", " ".repeat(indent))))
}

/// `start` and words, in lines that fit; further lines are indented by `indent`.
pub(super) fn prose(start: &str, words: &str, indent: usize) -> String {
    wrapped(&format!("{start}{words}"), WIDTH).join(&format!("\n{}", " ".repeat(indent)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_cut_between_their_terms() {
        let text = "a * (b + c) - d / e";
        assert_eq!(terms(text, 100), [text]);
        assert_eq!(terms(text, 10), ["a * (b + c)", "- d / e"]);
        assert_eq!(terms(&format!("-x + {}", ["yy"; 40].join(" * ")), 10).len(), 41);
        let long = format!("a·({})", ["bbbb"; 30].join(" − "));
        assert!(terms(&long, 10).iter().all(|line| line.chars().count() <= WIDTH), "{:?}", terms(&long, 10));
    }

    #[test]
    fn lists_fit_or_are_cut() {
        let items: Vec<String> = (0..60).map(|i| i.to_string()).collect();
        assert_eq!(listed("[", &items[..3], "]", 4), "[0, 1, 2]");
        let long = listed("[", &items, "]", 4);
        assert!(long.lines().all(|line| line.len() <= WIDTH) && long.lines().count() == 5, "{long}");
    }
}
