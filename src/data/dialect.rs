//! How a file is written: which sign divides its fields, and on which line the table begins.

use csv::{ReaderBuilder, StringRecord};

use super::called::{are_units, joined};
use super::columns::Wanted;
use super::decoded::latin;
use super::error::FileProblem;
use super::limits::PREAMBLE;
use super::numeral::numeral;
use super::separator::Separator;

/// How a file is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dialect {
    /// Between its fields.
    pub separator: Separator,
    /// The line of the header, counted from 1: above it are texts.
    pub header: u64,
    /// Whether the line below it has the columns' units.
    pub units: bool,
}

/// What looks like the header of a table.
struct Header {
    dialect: Dialect,
    /// The columns' names, with their units.
    names: Vec<String>,
    /// The fields of the line below it.
    below: StringRecord,
}

impl Header {
    /// Of the line at a place, as one sign divides it.
    fn at(lines: &[(u64, String)], at: usize, separator: Separator) -> Self {
        let line = |at: usize| lines.get(at).map_or_else(StringRecord::new, |(_, line)| divided(line, separator));
        let (fields, next) = (line(at), line(at + 1));
        let header = lines.get(at).map_or(1, |(number, _)| *number);
        if fields.len() == next.len() && are_units(next.iter()) {
            let names = fields.iter().zip(next.iter()).map(|(name, unit)| joined(name, unit)).collect();
            return Self { dialect: Dialect { separator, header, units: true }, names, below: line(at + 2) };
        }
        let names = fields.iter().map(str::to_owned).collect();
        Self { dialect: Dialect { separator, header, units: false }, names, below: next }
    }

    fn has(&self, wanted: &Wanted) -> bool {
        self.names.iter().any(|name| wanted.is(name))
    }

    /// How many numbers are below it; none where it is no header.
    fn numbers(&self) -> Option<usize> {
        let count = |fields: &mut dyn Iterator<Item = &str>| fields.filter(|field| numeral(field).is_some()).count();
        let columns = self.names.len();
        let texts = columns > 1 && count(&mut self.names.iter().map(String::as_str)) < columns;
        let numbers = count(&mut self.below.iter());
        (texts && self.below.len() == columns && numbers > 0).then_some(numbers)
    }
}

impl Dialect {
    /// Of a file that begins like this. The header is the first line that has all the columns wanted; without one, the line
    /// above the first that looks most like numbers, so that what is wrong with it can be told; without that, the first line.
    pub fn of(head: &[u8], wanted: &[Wanted]) -> Result<Self, FileProblem> {
        let lines = said(head);
        let headers = || {
            let of = |at| Separator::ALL.map(|separator| Header::at(&lines, at, separator));
            (0..lines.len()).flat_map(of)
        };
        let needed = || wanted.iter().filter(|wanted| wanted.absent.is_none());
        match headers().find(|header| needed().all(|wanted| header.has(wanted))) {
            Some(header) => Ok(header.dialect),
            None => Self::by_numbers(headers(), &lines),
        }
    }

    fn by_numbers(headers: impl Iterator<Item = Header>, lines: &[(u64, String)]) -> Result<Self, FileProblem> {
        let mut best: Option<(usize, Self)> = None;
        let mut rival = None;
        for header in headers {
            let (Some(count), own) = (header.numbers(), header.dialect) else { continue };
            match best {
                Some((most, first)) if count == most && first.header == own.header => rival = Some(own.separator),
                Some((most, _)) if count <= most => {}
                _ => (best, rival) = (Some((count, own)), None),
            }
        }
        match (best, rival) {
            (Some((_, first)), Some(second)) => {
                Err(FileProblem::Ambiguous { line: first.header, first: first.separator, second })
            }
            (Some((_, only)), None) => Ok(only),
            (None, _) => {
                let (line, text) = lines.first().map_or((1, ""), |(line, text)| (*line, text));
                let fields = |separator: &Separator| divided(text, *separator).len();
                // The first one of those with most fields.
                let separator = Separator::ALL.into_iter().rev().max_by_key(fields).unwrap_or(Separator::Comma);
                Ok(Self { separator, header: line, units: false })
            }
        }
    }
}

/// The first lines that are neither empty nor comments, with their numbers.
fn said(head: &[u8]) -> Vec<(u64, String)> {
    let mut lines = Vec::new();
    let (mut number, mut rest) = (0, head);
    while !rest.is_empty() && lines.len() < PREAMBLE {
        let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
        let (line, after) = rest.split_at(end);
        rest = after.strip_prefix(b"\r\n").or(after.get(1..)).unwrap_or_default();
        number += 1;
        let text = str::from_utf8(line).map_or_else(|_| latin(line), str::to_owned);
        let text = text.trim_start_matches('\u{feff}').trim_matches(' ');
        if !text.trim().is_empty() && !text.trim_start_matches('"').starts_with('#') {
            lines.push((number, text.to_owned()));
        }
    }
    lines
}

/// The fields of a line by itself.
fn divided(line: &str, separator: Separator) -> StringRecord {
    let mut reader = ReaderBuilder::new();
    let reader = reader.has_headers(false).delimiter(separator.sign()).buffer_capacity(line.len().max(1));
    let mut fields = StringRecord::new();
    // A text has no other faults than those of encoding.
    let _ = reader.from_reader(line.as_bytes()).read_record(&mut fields);
    fields.trim();
    fields
}
