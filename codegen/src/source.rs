//! Texts and where they stand.

use core::ops::Range;

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
