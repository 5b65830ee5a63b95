//! How a file is written: which sign divides its fields, and on which line the table begins.

use csv::{ReaderBuilder, StringRecord};

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
}

impl Dialect {
    /// Of a file that begins like this. The header is the first line that has all the columns wanted; without one, the line
    /// above the first that looks most like numbers, so that what is wrong with it can be told; without that, the first line.
    pub fn of(head: &[u8], wanted: &[Wanted]) -> Result<Self, FileProblem> {
        let lines = said(head);
        let header = |line: &(u64, String)| {
            let is = |separator: &Separator| {
                let fields = divided(&line.1, *separator);
                let there = |wanted: &Wanted| fields.iter().any(|field| wanted.is(field));
                wanted.iter().filter(|wanted| wanted.absent.is_none()).all(there)
            };
            Separator::ALL.into_iter().find(is).map(|separator| Self { separator, header: line.0 })
        };
        match lines.iter().find_map(header) {
            Some(dialect) => Ok(dialect),
            None => Self::by_numbers(&lines),
        }
    }

    fn by_numbers(lines: &[(u64, String)]) -> Result<Self, FileProblem> {
        let mut best: Option<(usize, Self)> = None;
        let mut rival = None;
        for ((line, header), (_, numbers)) in lines.iter().zip(lines.iter().skip(1)) {
            for separator in Separator::ALL {
                let (header, numbers) = (divided(header, separator), divided(numbers, separator));
                let count = |fields: &StringRecord| fields.iter().filter(|field| numeral(field).is_some()).count();
                let table = header.len() == numbers.len() && header.len() > 1 && count(&header) < header.len();
                let (count, own) = (count(&numbers), Self { separator, header: *line });
                match best {
                    _ if !table || count == 0 => {}
                    Some((most, first)) if count == most && first.header == *line => rival = Some(separator),
                    Some((most, _)) if count <= most => {}
                    _ => (best, rival) = (Some((count, own)), None),
                }
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
                Ok(Self { separator, header: line })
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
