//! Texts and where they stand.

use crate::limits::SHOWN;
use core::ops::Range;
use std::borrow::Cow;

/// A place in the source text, in bytes.
pub type Span = Range<usize>;

/// A text and where it stands (an empty span where it does not come from a file).
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Text {
    /// The text.
    pub value: String,
    /// Its place in the source, quotes included.
    pub span: Span,
}

impl<T: Into<String>> From<T> for Text {
    fn from(value: T) -> Self {
        Self { value: value.into(), span: 0..0 }
    }
}

impl Text {
    /// A place inside it as a place in the source.
    pub(crate) fn place(&self, within: &Span) -> Span {
        // Not counting the opening quote.
        let start = if self.span.is_empty() { 0 } else { self.span.start + 1 };
        start + within.start..start + within.end
    }
}

/// Whether a character is not seen where it is printed but does something there: controls, ends of lines, marks of direction.
fn is_unseen(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

/// A text in one line in which everything is seen, for comments and messages: an escape character is `\u{1b}`, a line's end `\n`.
#[must_use]
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(is_unseen) {
        return text.into();
    }
    text.chars()
        .fold(String::new(), |text, c| {
            if is_unseen(c) { text + &c.escape_default().to_string() } else { text + c.encode_utf8(&mut [0; 4]) }
        })
        .into()
}

/// What a message shows of a text: all of it made visible, or its beginning.
#[must_use]
pub fn shown(text: &str) -> Cow<'_, str> {
    match text.char_indices().nth(SHOWN) {
        None => visible(text),
        Some((end, _)) => format!("{}…", visible(&text[..end])).into(),
    }
}

/// A text of the same length and the same lines in which everything is seen: places in it stay what they are.
#[must_use]
pub(crate) fn in_place(text: &str) -> String {
    // One, two and three bytes of UTF-8, as long as what they stand for.
    let stand_in = |c: char| match c.len_utf8() {
        1 => '?',
        2 => '·',
        _ => '\u{fffd}',
    };
    let text = text.replace("\r\n", " \n");
    text.chars().map(|c| if is_unseen(c) && c != '\n' && c != '\t' { stand_in(c) } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_is_seen() {
        assert_eq!(visible("ΔR\u{1b}[31m\n\u{9b}\u{202e}x"), "ΔR\\u{1b}[31m\\n\\u{9b}\\u{202e}x");
        let awkward = "a\r\nb\t\u{1b}\u{9b}\u{202e}\r";
        assert_eq!(in_place(awkward), "a \nb\t?·\u{fffd}?");
        assert_eq!(in_place(awkward).len(), awkward.len());
    }
}
