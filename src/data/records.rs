//! From bytes to the fields of one line at a time, in constant memory.

use std::io::{BufRead, BufReader, Read};

use csv_core::ReadRecordResult;

use super::decoded::latin;
use super::error::FileProblem;
use super::limits::{LINE, LINES};
use super::separator::Separator;

/// Bytes read at once.
const BLOCK: usize = 1 << 16;

/// The lines of a CSV file that say something: those that are neither empty nor a comment.
pub(crate) struct Records {
    source: BufReader<Box<dyn Read>>,
    parser: csv_core::Reader,
    /// The line as it stands, without its end.
    raw: Vec<u8>,
    /// Its fields' text, one behind the other.
    text: Vec<u8>,
    /// Where each field ends in the text.
    ends: Vec<usize>,
    /// Lines taken from the source.
    taken: u64,
    /// Whether the last of them had a line end.
    ended: bool,
}

/// A line divided into its fields.
pub(crate) struct Record<'a> {
    /// Counted from 1; the first one where a field in quotes goes over several.
    pub line: u64,
    /// The fields without the blanks around them.
    pub fields: Vec<&'a str>,
    /// False of a last line that has no line end.
    pub ended: bool,
}

impl Records {
    pub fn new(source: Box<dyn Read>, separator: Separator) -> Self {
        Self {
            source: BufReader::with_capacity(BLOCK, source),
            parser: csv_core::ReaderBuilder::new().delimiter(separator.sign()).build(),
            raw: Vec::new(),
            text: Vec::new(),
            ends: Vec::new(),
            taken: 0,
            ended: true,
        }
    }

    /// Passes over what stands above a line.
    pub fn go_to(&mut self, line: u64) -> Result<(), FileProblem> {
        while self.taken + 1 < line && self.take_line()? {}
        Ok(())
    }

    /// The next line; none at the end.
    pub fn next(&mut self) -> Result<Option<Record<'_>>, FileProblem> {
        loop {
            if !self.take_line()? {
                return Ok(None);
            }
            let text = self.raw.trim_ascii();
            // A spreadsheet puts a comment with a comma in it between quotes.
            if !text.is_empty() && !text.strip_prefix(b"\"").unwrap_or(text).starts_with(b"#") {
                break;
            }
        }
        let line = self.taken;
        let count = self.divide()?;
        let mut from = 0;
        let field = |end: &usize| {
            let field = self.text.get(std::mem::replace(&mut from, *end)..*end).unwrap_or_default();
            str::from_utf8(field).unwrap_or_default().trim()
        };
        let fields = self.ends.iter().take(count).map(field).collect();
        Ok(Some(Record { line, fields, ended: self.ended }))
    }

    /// Divides the line taken, and those that a quote leads on to; the number of its fields.
    fn divide(&mut self) -> Result<usize, FileProblem> {
        let (mut written, mut count) = (0, 0);
        let first = self.taken;
        loop {
            self.raw.push(b'\n');
            if written + self.raw.len() > LINE {
                return Err(FileProblem::LongLine { line: first });
            }
            self.text.resize(written + self.raw.len(), 0);
            self.ends.resize(count + self.raw.len(), 0);
            let (text, ends) = (&mut self.text[written..], &mut self.ends[count..]);
            let (result, _, bytes, fields) = self.parser.read_record(&self.raw, text, ends);
            (written, count) = (written + bytes, count + fields);
            if result == ReadRecordResult::Record {
                return Ok(count);
            }
            if !self.take_line()? {
                // Nothing more to read closes the quote.
                let (.., fields) = self.parser.read_record(&[], &mut self.text, &mut self.ends[count..]);
                return Ok(count + fields);
            }
        }
    }

    /// Takes a line from the source; false at its end. Lines end with LF, CR or both.
    fn take_line(&mut self) -> Result<bool, FileProblem> {
        if self.taken == LINES {
            return Err(FileProblem::ManyLines);
        }
        self.raw.clear();
        let mut ended = false;
        while !ended {
            let block = self.source.fill_buf()?;
            if block.is_empty() {
                break;
            }
            let end = block.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
            let carriage = end.is_some_and(|at| block[at] == b'\r');
            self.raw.extend_from_slice(&block[..end.unwrap_or(block.len())]);
            let used = end.map_or(block.len(), |at| at + 1);
            self.source.consume(used);
            if self.raw.len() >= LINE {
                return Err(FileProblem::LongLine { line: self.taken + 1 });
            }
            if carriage && self.source.fill_buf()?.first() == Some(&b'\n') {
                self.source.consume(1);
            }
            ended = end.is_some();
        }
        if self.raw.is_empty() && !ended {
            return Ok(false);
        }
        self.ended = ended;
        self.taken += 1;
        if self.taken == 1 && self.raw.starts_with("\u{feff}".as_bytes()) {
            self.raw.drain(..3);
        }
        if self.raw.contains(&0) {
            return Err(FileProblem::NotText { line: self.taken });
        }
        // Numbers are the same in both; a letter that is wrong in UTF-8 is one in Latin-1.
        if str::from_utf8(&self.raw).is_err() {
            self.raw = latin(&self.raw).into_bytes();
        }
        Ok(true)
    }
}
