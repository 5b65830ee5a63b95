//! From a file to its lines of numbers, in mm and rad, one at a time.

use std::f64::consts::TAU;
use std::fs::File;
use std::io::{self, Cursor, Read};
use std::path::{Path, PathBuf};
use std::vec::IntoIter;

use super::called::joined;
use super::columns::{Column, Wanted, listed, resolve};
use super::decoded::decoded;
use super::dialect::Dialect;
use super::error::{BadLines, FieldProblem, FileError, FileProblem, LineProblem, Need};
use super::limits::LINE;
use super::numeral::{Numerals, shown};
use super::records::{Record, Records};
use super::separator::Separator;
use super::stamp::Stamping;
use trunnion_codegen::quantity::Unit;

/// Lines before the last one that must agree in their number of decimals before a shorter last one counts as cut.
const STEADY: usize = 10;

/// No length of a machine, in mm, and no angle of a measurement, in rad, are as large as these: a hundred metres, a thousand turns.
const LONGEST: f64 = 1e5;
const FARTHEST: f64 = 1e3 * TAU;

/// A line of numbers.
pub(crate) struct Line {
    /// Counted from 1.
    pub line: u64,
    /// One for each wanted column, in mm or rad, or as it stands where the column has no unit.
    pub values: Vec<f64>,
}

/// The wanted columns of a file.
pub(crate) struct Lines {
    file: PathBuf,
    columns: Vec<Column>,
    source: Source,
}

/// Where lines come from.
enum Source {
    /// A text, read in constant memory.
    Text(Box<Text>),
    /// What was read otherwise.
    Given(IntoIter<Line>),
}

/// A text with a header.
struct Text {
    records: Records,
    separator: Separator,
    header: Vec<String>,
    numerals: Numerals,
    decimals: Decimals,
}

impl Lines {
    /// Opens a file with a header of these columns, in any order; `-` is standard input.
    pub fn open(file: &Path, wanted: &[Wanted]) -> Result<Self, FileError> {
        Self::from(file, source(file), wanted)
    }

    /// As [`Lines::open`], stamped while it is read: whole once the last line was.
    pub fn stamped(file: &Path, wanted: &[Wanted]) -> Result<(Self, Stamping), FileError> {
        let stamping = Stamping::default();
        let source = source(file).map(|source| Box::new(stamping.reader(source)) as Box<dyn Read>);
        Ok((Self::from(file, source, wanted)?, stamping))
    }

    /// As [`Lines::open`], of what was opened already.
    pub fn from(file: &Path, source: io::Result<Box<dyn Read>>, wanted: &[Wanted]) -> Result<Self, FileError> {
        let opened = source.map_err(FileProblem::from).and_then(|source| Text::read(source, wanted));
        match opened {
            Ok((text, columns)) => Ok(Self { file: file.to_owned(), columns, source: Source::Text(Box::new(text)) }),
            Err(problem) => Err(FileError { file: file.to_owned(), problem: unreadable(problem, wanted) }),
        }
    }

    /// Lines that were read otherwise, under columns of these names.
    pub fn given(file: &Path, names: &[&str], lines: Vec<Line>) -> Self {
        let column = |(at, name): (usize, &&str)| Column::Present { name: (*name).to_owned(), unit: None, at };
        let columns = names.iter().enumerate().map(column).collect();
        Self { file: file.to_owned(), columns, source: Source::Given(lines.into_iter()) }
    }

    /// The column that gives each wanted one.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Its name in messages.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// All lines at once, or every bad one; `most` of what they are can be kept.
    pub fn all<T>(self, most: usize, of: Need, keep: impl Fn(Line) -> Option<T>) -> Result<Vec<T>, FileError> {
        let file = self.file.clone();
        let mut kept = Vec::new();
        for line in self {
            let line = line?;
            if kept.len() == most {
                return Err(FileError { file, problem: FileProblem::TooMany { most, of } });
            }
            kept.extend(keep(line));
        }
        Ok(kept)
    }

    /// Every bad line from the first one on.
    fn bad_lines(&mut self, first: LineProblem) -> Result<BadLines, FileError> {
        let mut bad = BadLines::new(first);
        while let Some(line) = self.next_line()? {
            line.err().into_iter().for_each(|problem| bad.add(problem));
        }
        Ok(bad)
    }

    /// The next line, or what is wrong with it; none at the end.
    fn next_line(&mut self) -> Result<Option<Result<Line, LineProblem>>, FileError> {
        match &mut self.source {
            Source::Text(text) => {
                text.next_line(&self.columns).map_err(|problem| FileError { file: self.file.clone(), problem })
            }
            Source::Given(lines) => Ok(lines.next().map(Ok)),
        }
    }
}

impl Text {
    /// A text up to its header, and the columns in it.
    fn read(source: Box<dyn Read>, wanted: &[Wanted]) -> Result<(Self, Vec<Column>), FileProblem> {
        let mut source = decoded(source)?;
        let mut head = Vec::new();
        source.by_ref().take(LINE as u64).read_to_end(&mut head)?;
        if is_xml(&head) {
            return Err(FileProblem::Xml { columns: listed(wanted) });
        }
        let dialect = Dialect::of(&head, wanted)?;
        let mut records = Records::new(Box::new(Cursor::new(head).chain(source)), dialect.separator);
        records.go_to(dialect.header)?;
        let Some(Record { line, fields, .. }) = records.next()? else {
            return Err(FileProblem::Empty { columns: listed(wanted) });
        };
        let mut header: Vec<String> = fields.into_iter().map(str::to_owned).collect();
        let units = if dialect.units { records.next()? } else { None };
        for (name, unit) in header.iter_mut().zip(units.map_or(Vec::new(), |units| units.fields)) {
            *name = joined(name, unit);
        }
        let columns = resolve(&header, wanted).map_err(|problems| FileProblem::Header { line, problems })?;
        let (numerals, decimals) = (Numerals::default(), Decimals::default());
        Ok((Self { records, separator: dialect.separator, header, numerals, decimals }, columns))
    }

    fn next_line(&mut self, columns: &[Column]) -> Result<Option<Result<Line, LineProblem>>, FileProblem> {
        let Some(record) = self.records.next()? else { return Ok(None) };
        let line = record.line;
        let values = match self.decimals.cut_short(&record, &self.header) {
            Some(problem) => Err(problem),
            None => numbers(columns, &mut self.numerals, &record.fields, (self.header.len(), self.separator)),
        };
        Ok(Some(values.map(|values| Line { line, values }).map_err(|problem| LineProblem { line, problem })))
    }
}

/// Whether a text begins as XML does.
pub(super) fn is_xml(head: &[u8]) -> bool {
    let text = head.strip_prefix("\u{feff}".as_bytes()).unwrap_or(head);
    text.trim_ascii_start().starts_with(b"<")
}

impl Iterator for Lines {
    /// A line; at a bad one, every bad line of the file.
    type Item = Result<Line, FileError>;

    fn next(&mut self) -> Option<Self::Item> {
        let line = self.next_line().transpose()?.and_then(|line| match line {
            Ok(line) => Ok(line),
            Err(first) => {
                let problem = FileProblem::Lines(self.bad_lines(first)?);
                Err(FileError { file: self.file.clone(), problem })
            }
        });
        Some(line)
    }
}

/// Opens a file; `-` is standard input.
pub(super) fn source(file: &Path) -> io::Result<Box<dyn Read>> {
    match file.to_str() {
        Some("-") => Ok(Box::new(io::stdin())),
        _ => Ok(Box::new(File::open(file)?)),
    }
}

/// What could not be opened, with what should be there.
fn unreadable(problem: FileProblem, wanted: &[Wanted]) -> FileProblem {
    match problem {
        FileProblem::Unreadable(io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) => {
            FileProblem::Missing { columns: listed(wanted) }
        }
        FileProblem::Unreadable(io::ErrorKind::IsADirectory) => FileProblem::Directory { columns: listed(wanted) },
        other => other,
    }
}

fn numbers(
    columns: &[Column],
    numerals: &mut Numerals,
    fields: &[&str],
    (expected, separator): (usize, Separator),
) -> Result<Vec<f64>, FieldProblem> {
    // Some end each line with the sign that stands between fields.
    let fields = fields.strip_suffix(&[""]).filter(|fields| fields.len() == expected).unwrap_or(fields);
    let found = fields.len();
    // Numbers may be words, too: nan.
    let is_word = |field: &&str| field.chars().any(char::is_alphabetic) && field.parse::<f64>().is_err();
    let no_number = |field: &&str| is_word(field) && !field.contains(|c: char| c.is_ascii_digit()) || field.is_empty();
    if fields.iter().any(is_word) && fields.iter().all(no_number) {
        return Err(FieldProblem::Words(shown(fields.iter().find(|field| is_word(field)).unwrap_or(&"")), expected));
    }
    if found == 2 * expected && separator == Separator::Comma {
        return Err(FieldProblem::DecimalCommas { found, expected });
    }
    if found != expected {
        return Err(FieldProblem::Count { found, expected, separator });
    }
    let value = |column: &Column| match column {
        Column::Absent(value) => Ok(*value),
        Column::Present { name, unit, at } => {
            let text = fields.get(*at).copied().unwrap_or_default();
            let value = numerals.number(name, text)?;
            let Some(unit) = unit else { return Ok(value) };
            let most = match unit {
                Unit::Um | Unit::Mm => LONGEST,
                Unit::Deg | Unit::Rad | Unit::Urad => FARTHEST,
            };
            let inner = unit.to_inner(value);
            let problem =
                || FieldProblem::Absurd { column: name.clone(), text: shown(text), most: unit.from_inner(most) };
            if inner.abs() <= most { Ok(inner) } else { Err(problem()) }
        }
    };
    columns.iter().map(value).collect()
}

/// How many decimals the lines so far end with.
#[derive(Default)]
struct Decimals {
    lines: usize,
    usual: usize,
    differ: bool,
}

impl Decimals {
    /// A last line that has no line end and too little in it: fields missing, or fewer decimals than all the others have.
    fn cut_short(&mut self, record: &Record, header: &[String]) -> Option<FieldProblem> {
        let last = record.fields.last()?;
        let decimals = last.split_once(['.', ',']).map_or(0, |(_, decimals)| decimals.len());
        if record.ended || self.lines == 0 {
            if self.lines == 0 {
                self.usual = decimals;
            }
            self.lines += 1;
            self.differ |= decimals != self.usual;
            return None;
        }
        let steady = self.lines >= STEADY && !self.differ;
        let short = record.fields.len() < header.len() || last.is_empty() || steady && decimals < self.usual;
        let column = header.get(record.fields.len() - 1).filter(|_| short)?.clone();
        Some(FieldProblem::CutShort { column })
    }
}
