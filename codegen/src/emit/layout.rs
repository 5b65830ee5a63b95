//! Lines that a person can read: words, lists and expressions cut to a width.

/// The longest line of generated source.
pub(super) const WIDTH: usize = 100;

/// Words in lines of at most `width` characters, unless a word alone is longer.
pub(super) fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut().filter(|line| line.chars().count() + 1 + word.chars().count() <= width) {
            Some(line) => {
                line.push(' ');
                line.push_str(word);
            }
            None => lines.push(word.to_owned()),
        }
    }
    lines
}

/// `head`, the items between commas, `tail`: on one line if that fits, else the items on lines of their own, each
/// indented by `indent`, and `tail` by four less.
pub(super) fn listed(head: &str, items: &[String], tail: &str, indent: usize) -> String {
    let joined = items.join(", ");
    let line = format!("{head}{joined}{tail}");
    if longest(&line) <= WIDTH || items.is_empty() {
        return line;
    }
    let (inner, outer) = (" ".repeat(indent), " ".repeat(indent.saturating_sub(4)));
    let rows = wrapped(&joined, WIDTH - indent);
    let rows: String = rows.iter().map(|row| format!("{inner}{row}\n")).collect();
    format!("{head}\n{rows}{outer}{tail}")
}

fn longest(text: &str) -> usize {
    text.lines().map(|line| line.chars().count()).max().unwrap_or(0)
}

/// An expression's text cut before the operators that stand in no parentheses: one term a line, and a term too long for a
/// line one factor a line. `room` is what the first line has.
pub(super) fn terms(expression: &str, room: usize) -> Vec<String> {
    if expression.len() <= room {
        return vec![expression.to_owned()];
    }
    let cut = |text: &str, operators: [&str; 2]| {
        let (mut depth, mut start, mut parts) = (0_i32, 0, Vec::new());
        for (at, c) in text.char_indices() {
            match c {
                '(' | '[' => depth += 1,
                ')' | ']' => depth -= 1,
                ' ' if depth == 0 && at > start && operators.iter().any(|o| text[at..].starts_with(o)) => {
                    parts.push(text[start..at].to_owned());
                    start = at + 1;
                }
                _ => {}
            }
        }
        parts.push(text[start..].to_owned());
        parts
    };
    let sum = cut(expression, [" + ", " - "]);
    sum.into_iter().flat_map(|term| if term.len() > WIDTH - 8 { cut(&term, [" * ", " / "]) } else { vec![term] }).collect()
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
    }

    #[test]
    fn lists_fit_or_are_cut() {
        let items: Vec<String> = (0..60).map(|i| i.to_string()).collect();
        assert_eq!(listed("[", &items[..3], "]", 4), "[0, 1, 2]");
        let long = listed("[", &items, "]", 4);
        assert!(long.lines().all(|line| line.len() <= WIDTH) && long.lines().count() == 5, "{long}");
    }
}
