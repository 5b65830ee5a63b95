//! Messages that quote what a person gave.

use trunnion_codegen::problems::visible;

/// Characters of a line: more is a name or a list that somebody gave, and the rest of it says nothing.
const LINE: usize = 400;

/// Lines for a terminal, which obeys no character of theirs and is not filled by them.
pub fn seen(text: &str) -> String {
    let line = |line: &str| match line.char_indices().nth(LINE) {
        None => visible(line).into_owned(),
        Some((end, _)) => format!("{}…", visible(&line[..end])),
    };
    text.split('\n').map(line).collect::<Vec<_>>().join("\n")
}
