//! From a file to its lines of numbers, in mm and rad.

use std::fs;
use std::io;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};

use super::columns::{Column, Wanted, listed, resolve};
use super::error::{FieldProblem, FileError, LineProblem, Problem, Separator};

/// Lines before the last one that must agree in their number of decimals before a shorter last one counts as cut.
const STEADY: usize = 10;

/// A line of numbers.
pub(crate) struct Line {
    /// Counted from 1.
    pub line: u64,
    /// One for each wanted column, in mm or rad.
    pub values: Vec<f64>,
}

/// The wanted columns of a file and its lines.
pub(crate) struct Lines {
    pub columns: Vec<Column>,
    pub lines: Vec<Line>,
}

/// Reads the wanted columns of a file.
pub(crate) fn read(file: &Path, wanted: &[Wanted]) -> Result<Lines, FileError> {
    text(file, wanted)
        .and_then(|text| parse(&text, wanted))
        .map_err(|problem| FileError { file: file.to_owned(), problem })
}

fn text(file: &Path, wanted: &[Wanted]) -> Result<String, Problem> {
    let bytes = fs::read(file).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => Problem::Missing { columns: listed(wanted) },
        io::ErrorKind::IsADirectory => Problem::Directory { columns: listed(wanted) },
        kind => Problem::Unreadable(kind),
    })?;
    let utf16 = bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]);
    let text = String::from_utf8(bytes).map_err(|error| {
        let good = error.as_bytes().iter().take(error.utf8_error().valid_up_to());
        Problem::NotUtf8 { line: 1 + good.filter(|byte| **byte == b'\n').count() as u64, utf16 }
    })?;
    Ok(text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text))
}

fn parse(text: &str, wanted: &[Wanted]) -> Result<Lines, Problem> {
    let mut records = records(text)?.into_iter();
    let Some((line, header)) = records.next() else {
        return Err(Problem::Empty { columns: listed(wanted) });
    };
    if let [only] = header.as_slice() {
        let other = [(';', Separator::Semicolon), ('\t', Separator::Tab)];
        if let Some((_, separator)) = other.into_iter().find(|(sign, _)| only.contains(*sign)) {
            return Err(Problem::Separator { line, separator });
        }
    }
    let columns = resolve(&header, wanted).map_err(|problems| Problem::Header { line, problems })?;
    let records: Vec<_> = records.collect();
    let cut = cut_short(text, &header, &records);
    let mut bad = Vec::new();
    let mut lines = Vec::with_capacity(records.len());
    for (line, fields) in &records {
        match numbers(&header, &columns, fields) {
            Ok(values) => lines.push(Line { line: *line, values }),
            Err(problem) => bad.push(LineProblem { line: *line, problem }),
        }
    }
    if let Some(cut) = cut {
        bad.retain(|problem| problem.line != cut.line);
        bad.push(cut);
    }
    if bad.is_empty() { Ok(Lines { columns, lines }) } else { Err(Problem::Lines(bad)) }
}

type Record = (u64, Vec<String>);

fn records(text: &str) -> Result<Vec<Record>, Problem> {
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(Trim::All)
        .from_reader(text.as_bytes());
    let mut record = StringRecord::new();
    let mut records = Vec::new();
    while reader.read_record(&mut record).map_err(|_| Problem::Unreadable(io::ErrorKind::InvalidData))? {
        let first = record.get(0).unwrap_or_default();
        if first.starts_with('#') || record.iter().all(str::is_empty) && record.len() == 1 {
            continue;
        }
        let line = record.position().map_or(0, |position| {
            // The position is where the reader began to look: before the comments and empty lines it skipped.
            let skipped = text.get(position.byte() as usize..).unwrap_or_default().lines();
            let skipped = skipped.take_while(|line| line.is_empty() || line.starts_with('#')).count();
            position.line() + skipped as u64
        });
        records.push((line, record.iter().map(str::to_owned).collect()));
    }
    Ok(records)
}

fn numbers(header: &[String], columns: &[Column], fields: &[String]) -> Result<Vec<f64>, FieldProblem> {
    let (found, expected) = (fields.len(), header.len());
    if found == 2 * expected {
        return Err(FieldProblem::DecimalCommas { found, expected });
    }
    if found != expected {
        return Err(FieldProblem::Count { found, expected });
    }
    columns.iter().map(|column| number(column, fields.get(column.at).map_or("", String::as_str))).collect()
}

fn number(column: &Column, text: &str) -> Result<f64, FieldProblem> {
    let name = column.name.clone();
    let shown = || text.chars().take(24).collect::<String>();
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(column.unit.to_inner(value)),
        Ok(_) => Err(FieldProblem::NotFinite { column: name, text: shown() }),
        Err(_) if text.is_empty() => Err(FieldProblem::Blank { column: name }),
        Err(_) if text.replacen(',', ".", 1).parse::<f64>().is_ok() => {
            Err(FieldProblem::DecimalComma { column: name, text: shown() })
        }
        Err(_) => Err(FieldProblem::Text { column: name, text: shown() }),
    }
}

/// A last line that has no line end and too little in it: fields missing, or fewer decimals than all the others have.
fn cut_short(text: &str, header: &[String], records: &[Record]) -> Option<LineProblem> {
    let ((line, last), before) = records.split_last()?;
    if text.ends_with(['\n', '\r']) {
        return None;
    }
    let decimals =
        |fields: &[String]| fields.last().and_then(|field| field.split_once('.')).map_or(0, |(_, d)| d.len());
    let usual = before.first().map(|(_, fields)| decimals(fields))?;
    let steady = before.len() >= STEADY && before.iter().all(|(_, fields)| decimals(fields) == usual);
    let blank = last.last().is_some_and(String::is_empty);
    let short = last.len() < header.len() || blank || steady && decimals(last) < usual;
    let column = header.get(last.len().checked_sub(1)?)?.clone();
    short.then_some(LineProblem { line: *line, problem: FieldProblem::CutShort { column } })
}
