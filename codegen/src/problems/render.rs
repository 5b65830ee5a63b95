//! Problems as messages: the line, a pointer, what would have been right.

use crate::model::Problem;
use crate::source::{in_place, visible};
use ariadne::{Config, IndexType, Label, Report, ReportKind, Source};

/// Whether a message may use a terminal's colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// For a terminal.
    On,
    /// For files and pipes.
    Off,
}

/// All problems of the description `source`, which people know as `path`, in the order of their places.
pub fn render(path: &str, source: &str, problems: &[Problem], colour: Colour) -> String {
    let mut sorted: Vec<&Problem> = problems.iter().collect();
    sorted.sort_by_key(|p| p.span.start);
    let (path, source) = (&*visible(path), &*in_place(source));
    let messages: Vec<String> = sorted.into_iter().map(|p| message(path, source, p, colour)).collect();
    messages.join("\n")
}

fn message(path: &str, source: &str, problem: &Problem, colour: Colour) -> String {
    let text = problem.kind.to_string();
    let help = problem.kind.help().map(|help| visible(&help).into_owned());
    if problem.span.is_empty() && (problem.span.start == 0 || source.is_empty()) {
        let help = help.map_or_else(String::new, |h| format!("  Help: {h}\n"));
        return format!("Error: {path}: {text}\n{help}");
    }
    // A pointer needs whole characters, and at least one: the end of a file has its last.
    let last = source.char_indices().next_back().map_or(0, |(at, _)| at);
    let whole = |at: &usize| source.is_char_boundary(*at);
    let start = (0..=problem.span.start.min(last)).rev().find(whole).unwrap_or(0);
    let end = (problem.span.end.max(start + 1)..source.len()).find(whole).unwrap_or(source.len());
    let span = start..end.max(start);
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
