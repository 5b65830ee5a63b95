//! From places in a description back to tokens: every text of the macro gets a stretch of offsets of its own.

use proc_macro2::Span;
use trunnion_codegen::model::{Problem, Text};

/// The tokens that texts came from, by offset.
pub struct Places {
    /// Start of each stretch, and its token.
    stretches: Vec<(usize, Span)>,
    end: usize,
}

impl Places {
    /// `whole` is where a problem of no particular text is shown.
    pub fn new(whole: Span) -> Self {
        Self { stretches: vec![(0, whole)], end: 1 }
    }

    /// A text with a place.
    pub fn text(&mut self, value: &str, span: Span) -> Text {
        let start = self.end;
        // As long as the text in its quotes, so that a place inside it stays in its stretch.
        self.end += value.len() + 3;
        self.stretches.push((start, span));
        Text { value: value.to_owned(), span: start..self.end - 1 }
    }

    /// A problem at its token; where it concerns a part of the text, with its column.
    pub fn error(&self, problem: &Problem) -> syn::Error {
        let at = self.stretches.partition_point(|(start, _)| *start <= problem.span.start).saturating_sub(1);
        let (start, span) = self.stretches.get(at).copied().unwrap_or((0, Span::call_site()));
        let mut message = problem.kind.to_string();
        if problem.span.start > start {
            message += &format!(" (at column {} of this text)", problem.span.start - start);
        }
        if let Some(help) = problem.kind.help() {
            message += &format!("\n  = help: {help}");
        }
        syn::Error::new(span, message)
    }
}
