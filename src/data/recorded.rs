//! A run's file that is gone through again and again instead of being kept.

use super::error::{FileError, FileProblem};
use super::known::KnownAlong;
use super::limits::{KEPT, SAMPLES};
use super::lines::{Lines, source};
use super::stamp::Stamp;
use super::sweep::{RunColumns, check};
use crate::study::{Recording, Sample, Setup, Weighed};
use std::cell::RefCell;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::rc::Rc;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::kinematics::Headings;

/// A measured run in a file that was found good, with its known functions.
pub struct Recorded<'a> {
    setup: &'a Setup,
    run: RunId,
    weight: f64,
    columns: RunColumns<'a>,
    contents: Contents,
    known: KnownAlong,
    headings: Headings,
    samples: usize,
}

/// Where the lines come from each time.
#[derive(Clone)]
enum Contents {
    File(PathBuf),
    /// What can be read only once, and was.
    Kept(PathBuf, Rc<RefCell<Vec<u8>>>),
}

impl Contents {
    fn of(file: &Path) -> Self {
        // A pipe, a device, standard input: there is no second time.
        match file.metadata() {
            Ok(metadata) if metadata.is_file() && file.to_str() != Some("-") => Self::File(file.to_owned()),
            _ => Self::Kept(file.to_owned(), Rc::default()),
        }
    }

    fn file(&self) -> &Path {
        match self {
            Self::File(file) | Self::Kept(file, _) => file,
        }
    }

    /// Samples that can be gone through.
    fn most(&self) -> usize {
        match self {
            Self::File(_) => usize::MAX,
            Self::Kept(..) => SAMPLES,
        }
    }

    /// The first time.
    fn first(&self) -> io::Result<Box<dyn Read>> {
        match self {
            Self::File(file) => source(file),
            Self::Kept(file, bytes) => Ok(Box::new(Keeping { source: source(file)?, bytes: Rc::clone(bytes) })),
        }
    }

    fn again(&self) -> io::Result<Box<dyn Read>> {
        match self {
            Self::File(file) => source(file),
            Self::Kept(_, bytes) => Ok(Box::new(io::Cursor::new(bytes.borrow().clone()))),
        }
    }
}

/// Keeps what it reads.
struct Keeping {
    source: Box<dyn Read>,
    bytes: Rc<RefCell<Vec<u8>>>,
}

impl Read for Keeping {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.source.read(buffer)?;
        let mut bytes = self.bytes.borrow_mut();
        if bytes.len() + read > KEPT {
            return Err(io::ErrorKind::FileTooLarge.into());
        }
        bytes.extend_from_slice(&buffer[..read]);
        Ok(read)
    }
}

impl<'a> Recorded<'a> {
    /// A file of a run that was gone through once.
    pub(super) fn open(
        setup: &'a Setup,
        run: RunId,
        file: &Path,
        columns: RunColumns<'a>,
        known: KnownAlong,
    ) -> Result<Self, FileError> {
        let contents = Contents::of(file);
        let lines = Lines::from(file, contents.first(), &columns.wanted())?;
        let (mut headings, mut outside, mut samples) = (Headings::default(), Vec::new(), 0);
        check(lines, &columns, contents.most(), |sample| {
            headings.add(sample.angle_rad);
            if !known.covers(sample.angle_rad) && outside.len() < SAMPLES {
                outside.push((sample.line, sample.angle_rad));
            }
            samples += 1;
        })?;
        match known.outside(outside) {
            Some(problem) => Err(FileError { file: file.to_owned(), problem }),
            None => Ok(Self { setup, run, weight: 1.0, columns, contents, known, headings, samples }),
        }
    }

    /// The file.
    pub fn file(&self) -> &Path {
        self.contents.file()
    }

    /// Which bytes it has.
    ///
    /// # Errors
    /// It cannot be read again.
    pub fn stamp(&self) -> Result<Stamp, FileError> {
        let stamp = self.contents.again().and_then(Stamp::of);
        stamp.map_err(|e| FileError { file: self.file().to_owned(), problem: e.into() })
    }

    /// Samples in it.
    pub fn samples(&self) -> usize {
        self.samples
    }
}

impl Weighed for Recorded<'_> {
    fn weigh(&mut self, weight: f64) {
        self.weight = weight;
    }
}

impl Recording for Recorded<'_> {
    type Error = FileError;

    fn run(&self) -> RunId {
        self.run
    }

    fn weight(&self) -> f64 {
        self.weight
    }

    fn is_ordered(&self) -> bool {
        self.headings.start().is_known()
    }

    fn each(&self, each: &mut dyn FnMut(&Sample)) -> Result<(), FileError> {
        let known = self.setup.derivation.runs[self.run].known.len();
        let mut heading = self.headings.start();
        let mut sample =
            Sample { sweep: 0.0, direction: 0.0, reading: 0.0, known: vec![0.0; known], known_std: vec![0.0; known] };
        let mut samples = 0;
        for line in Lines::from(self.contents.file(), self.contents.again(), &self.columns.wanted())? {
            let Some(read) = RunColumns::sample(&line?) else { continue };
            (sample.sweep, sample.reading) = (read.angle_rad, read.reading_mm);
            sample.direction = heading.at(read.angle_rad);
            self.known.write(read.angle_rad, &mut sample);
            each(&sample);
            samples += 1;
        }
        match samples == self.samples {
            true => Ok(()),
            false => Err(FileError { file: self.contents.file().to_owned(), problem: FileProblem::Changed }),
        }
    }
}
