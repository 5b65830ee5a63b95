//! Files of many lines, read one at a time.

use crate::data::FieldProblem;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// What is wrong with a file and where; shown as `file:line: what` with the remedy on the next line.
#[derive(Debug, thiserror::Error)]
#[error("{}{}: {problem}", .file.display(), .line.map_or(String::new(), |line| format!(":{line}")))]
pub struct TableError {
    /// The file; `-` is standard input.
    pub file: PathBuf,
    /// The line, counted from 1, if it is in one.
    pub line: Option<u64>,
    /// What is wrong.
    pub problem: Problem,
}

/// What is wrong with a file.
#[derive(Debug, thiserror::Error)]
pub enum Problem {
    /// It cannot be read.
    #[error("cannot be read: {0}\n  expected a CSV file with the columns {1}")]
    Unreadable(io::ErrorKind, String),
    /// No header.
    #[error("no header line\n  expected the columns {0}")]
    Empty(String),
    /// No line of numbers.
    #[error("no lines of numbers\n  expected at least {needed} below the header")]
    NoLines {
        /// How many are needed.
        needed: usize,
    },
    /// A column that has to be there is not.
    #[error("missing column {name}\n  expected the columns {expected}; found {found}")]
    Missing {
        /// The column.
        name: &'static str,
        /// All that are expected.
        expected: String,
        /// What is there.
        found: String,
    },
    /// A column nobody asked for, or one that is there twice.
    #[error("column {name:?} is unknown or there twice\n  expected the columns {expected}")]
    Unknown {
        /// The column.
        name: String,
        /// All that are expected.
        expected: String,
    },
    /// A field that is no number, or a line with too few or too many.
    #[error(transparent)]
    Field(#[from] FieldProblem),
    /// Numbers that cannot be used.
    #[error("{0}\n  {1}")]
    Refused(String, &'static str),
}

/// A line of numbers: the required columns, and the optional ones that the file has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<const N: usize, const M: usize> {
    /// Counted from 1.
    pub line: u64,
    /// The required columns' values, as in the file.
    pub values: [f64; N],
    /// The optional columns' values, where the file has them.
    pub optional: [Option<f64>; M],
}

/// The lines of a file, one at a time.
pub struct Rows<const N: usize, const M: usize> {
    file: PathBuf,
    names: [&'static str; N],
    reader: Box<dyn BufRead>,
    /// Which value the field at each place is.
    places: Vec<usize>,
    present: [bool; M],
    line: u64,
    buffer: String,
}

/// Opens a file (`-`: standard input) with a header of these columns, in any order. Lines are read in constant memory.
///
/// # Errors
/// [`TableError`].
pub fn rows<const N: usize, const M: usize>(
    file: &Path,
    names: [&'static str; N],
    optional: [&'static str; M],
) -> Result<Rows<N, M>, TableError> {
    let expected = names.join(",") + &optional.map(|name| format!("[,{name}]")).concat();
    let fail = |line, problem| TableError { file: file.to_owned(), line, problem };
    let refused = |e: io::Error| fail(None, Problem::Unreadable(e.kind(), expected.clone()));
    let source: Box<dyn Read> = match file.to_str() {
        Some("-") => Box::new(io::stdin()),
        _ => Box::new(File::open(file).map_err(refused)?),
    };
    let reader = Box::new(BufReader::with_capacity(1 << 16, source));
    let mut rows = Rows {
        file: file.to_owned(),
        names,
        reader,
        places: Vec::new(),
        present: [false; M],
        line: 0,
        buffer: String::new(),
    };
    if !rows.next_line(&expected)? {
        return Err(fail(None, Problem::Empty(expected)));
    }
    let header: Vec<String> =
        rows.buffer.trim_start_matches('\u{feff}').split(',').map(|f| f.trim().to_owned()).collect();
    for name in &header {
        let required = names.iter().position(|n| n == name);
        let place = required.or_else(|| optional.iter().position(|n| n == name).map(|at| N + at));
        let fresh = place.filter(|place| !rows.places.contains(place));
        let Some(place) = fresh else {
            if header.iter().all(|field| field.parse::<f64>().is_ok()) {
                return Err(fail(Some(rows.line), Problem::Empty(expected)));
            }
            return Err(fail(Some(rows.line), Problem::Unknown { name: name.clone(), expected }));
        };
        rows.places.push(place);
    }
    for (at, name) in names.iter().enumerate() {
        if !rows.places.contains(&at) {
            let problem = Problem::Missing { name, expected, found: header.join(",") };
            return Err(fail(Some(rows.line), problem));
        }
    }
    for (at, present) in rows.present.iter_mut().enumerate() {
        *present = rows.places.contains(&(N + at));
    }
    Ok(rows)
}

/// Reads a file of at least `least` lines whole.
///
/// # Errors
/// [`TableError`].
pub fn read_rows<const N: usize, const M: usize>(
    file: &Path,
    names: [&'static str; N],
    optional: [&'static str; M],
    least: usize,
) -> Result<Vec<Row<N, M>>, TableError> {
    let rows = rows(file, names, optional)?.collect::<Result<Vec<_>, _>>()?;
    match rows.len() >= least {
        true => Ok(rows),
        false => Err(TableError { file: file.to_owned(), line: None, problem: Problem::NoLines { needed: least } }),
    }
}

impl<const N: usize, const M: usize> Rows<N, M> {
    /// An error on a line of this file.
    pub fn refuse(&self, line: u64, what: String, remedy: &'static str) -> TableError {
        TableError { file: self.file.clone(), line: Some(line), problem: Problem::Refused(what, remedy) }
    }

    /// Puts the next line that says something into the buffer; false at the end.
    fn next_line(&mut self, expected: &str) -> Result<bool, TableError> {
        loop {
            self.buffer.clear();
            let read = self.reader.read_line(&mut self.buffer).map_err(|e| TableError {
                file: self.file.clone(),
                line: Some(self.line + 1),
                problem: Problem::Unreadable(e.kind(), expected.to_owned()),
            })?;
            if read == 0 {
                return Ok(false);
            }
            self.line += 1;
            let text = self.buffer.trim();
            if !(text.is_empty() || text.starts_with('#')) {
                return Ok(true);
            }
        }
    }

    fn parse(&self) -> Result<Row<N, M>, FieldProblem> {
        let mut row = Row { line: self.line, values: [0.0; N], optional: [None; M] };
        let expected = self.places.len();
        let text = self.buffer.trim_end_matches(['\n', '\r']);
        let mut fields = text.split(',');
        for (at, &place) in self.places.iter().enumerate() {
            let Some(field) = fields.next() else {
                return Err(FieldProblem::Count { found: at, expected });
            };
            let column = || self.names.get(place).map_or_else(|| "spindle_deg".to_owned(), |name| (*name).to_owned());
            let field = field.trim();
            let value = match field.parse::<f64>() {
                Ok(value) if value.is_finite() => value,
                Ok(_) => return Err(FieldProblem::NotFinite { column: column(), text: field.to_owned() }),
                Err(_) if field.is_empty() => return Err(FieldProblem::Blank { column: column() }),
                Err(_) => {
                    return Err(FieldProblem::Text { column: column(), text: field.chars().take(24).collect() });
                }
            };
            match place.checked_sub(N) {
                None => row.values[place] = value,
                Some(at) => row.optional[at] = Some(value),
            }
        }
        match fields.count() {
            0 => Ok(row),
            more if more == expected => Err(FieldProblem::DecimalCommas { found: expected + more, expected }),
            more => Err(FieldProblem::Count { found: expected + more, expected }),
        }
    }
}

impl<const N: usize, const M: usize> Iterator for Rows<N, M> {
    type Item = Result<Row<N, M>, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        match self.next_line("") {
            Ok(false) => None,
            Ok(true) => Some(self.parse().map_err(|problem| TableError {
                file: self.file.clone(),
                line: Some(self.line),
                problem: problem.into(),
            })),
            Err(error) => Some(Err(error)),
        }
    }
}
