//! Problems as messages: the line, a pointer, what would have been right.

use crate::limits::{PROBLEMS, SHOWN};
use crate::model::Problem;
use crate::source::{Span, in_place, shown};
use ariadne::{Config, IndexType, Label, Report, ReportKind, Source};

/// Whether a message may use a terminal's colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// For a terminal.
    On,
    /// For files and pipes.
    Off,
}

/// The problems of the description `source`, which people know as `path`, in the order of their places: the first ones
/// ([`PROBLEMS`]), and how many more there are. Of a text that is quoted no more is shown than [`SHOWN`] characters.
pub fn render(path: &str, source: &str, problems: &[Problem], colour: Colour) -> String {
    let mut sorted: Vec<&Problem> = problems.iter().collect();
    sorted.sort_by_key(|p| p.span.start);
    let (path, source) = (&*shown(path), &*in_place(source));
    let messages = sorted.into_iter().take(PROBLEMS).map(|p| message(path, source, p, colour));
    let more = problems.len().checked_sub(PROBLEMS).filter(|more| *more > 0);
    messages.chain(more.map(|more| format!("… and {more} more\n"))).collect::<Vec<_>>().join("\n")
}

fn message(path: &str, source: &str, problem: &Problem, colour: Colour) -> String {
    let text = problem.kind.to_string();
    let help = problem.kind.help().map(|help| shown(&help).into_owned());
    let remedy = help.as_ref().map_or_else(String::new, |h| format!("  Help: {h}\n"));
    if problem.span.is_empty() && (problem.span.start == 0 || source.is_empty()) {
        return format!("Error: {path}: {text}\n{remedy}");
    }
    // A pointer needs whole characters, and at least one: the end of a file has its last.
    let last = source.char_indices().next_back().map_or(0, |(at, _)| at);
    let whole = |at: &usize| source.is_char_boundary(*at);
    let start = (0..=problem.span.start.min(last)).rev().find(whole).unwrap_or(0);
    let end = (problem.span.end.max(start + 1)..source.len()).find(whole).unwrap_or(source.len());
    let span = start..end.max(start);
    if let Some(Place { line, column, excerpt }) = in_long_line(source, &span) {
        return format!("Error: {path}:{line}:{column}: {text}\n  in: {excerpt}\n{remedy}");
    }
    let config = Config::default().with_color(colour == Colour::On).with_index_type(IndexType::Byte);
    let label = Label::new((path, span.clone())).with_message(problem.kind.pointer());
    let mut report =
        Report::build(ReportKind::Error, (path, span)).with_config(config).with_message(text).with_label(label);
    if let Some(help) = help {
        report = report.with_help(help);
    }
    let mut out = Vec::new();
    match report.finish().write((path, Source::from(source)), &mut out) {
        Ok(()) => String::from_utf8_lossy(&out).lines().map(|line| format!("{}\n", line.trim_end())).collect(),
        Err(e) => format!("Error: {path}: {}: {e}\n", problem.kind),
    }
}

/// A place in a line of which only a part is shown; both numbers count from 1.
struct Place {
    line: usize,
    column: usize,
    excerpt: String,
}

/// Where a place is, if there is too much in its lines to show them.
fn in_long_line(source: &str, span: &Span) -> Option<Place> {
    let start = source[..span.start].rfind('\n').map_or(0, |at| at + 1);
    let end = source[span.end..].find('\n').map_or(source.len(), |at| span.end + at);
    source[start..end].lines().any(|line| line.chars().nth(SHOWN).is_some()).then_some(())?;
    let before = source[start..span.start].chars().count();
    let skipped = before.saturating_sub(SHOWN / 4);
    let first = source[start..].lines().next().unwrap_or_default();
    let part: String = first.chars().skip(skipped).take(SHOWN).collect();
    let [cut, more] = [skipped > 0, first.chars().nth(skipped + SHOWN).is_some()].map(|cut| if cut { "…" } else { "" });
    let line = source[..start].matches('\n').count() + 1;
    Some(Place { line, column: before + 1, excerpt: format!("{cut}{part}{more}") })
}
