//! A run's file that was found good, to be gone through again and again.

use super::error::{FileError, FileProblem};
use super::known::KnownAlong;
use super::limits::{KEPT, SAMPLES};
use super::lines::Lines;
use super::sweep::{RunColumns, check};
use crate::study::{Recording, Sample, Setup, Weighed};
use std::path::{Path, PathBuf};
use trunnion_codegen::ids::RunId;
use trunnion_codegen::kinematics::Headings;

/// A measured run in a file that was found good, with its known functions.
pub struct Recorded<'a> {
    setup: &'a Setup,
    run: RunId,
    weight: f64,
    file: PathBuf,
    columns: RunColumns<'a>,
    contents: Contents,
    known: KnownAlong,
    headings: Headings,
    samples: usize,
}

/// What is gone through.
enum Contents {
    /// The samples' sweeps and readings.
    Kept(Vec<[f64; 2]>),
    /// More than are kept: the file is read again.
    File,
}

impl Contents {
    fn add(&mut self, sample: [f64; 2]) {
        match self {
            Self::Kept(samples) if samples.len() < KEPT => samples.push(sample),
            Self::Kept(_) => *self = Self::File,
            Self::File => {}
        }
    }
}

/// Samples that a file may have: as many as are kept where there is no second time, as of a pipe, a device, standard input.
fn most(file: &Path) -> usize {
    match file.metadata() {
        Ok(metadata) if metadata.is_file() && file.to_str() != Some("-") => usize::MAX,
        _ => KEPT,
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
        let lines = Lines::open(file, &columns.wanted())?;
        let mut contents = Contents::Kept(Vec::new());
        let (mut headings, mut outside, mut samples) = (Headings::default(), Vec::new(), 0);
        check(lines, &columns, most(file), |sample| {
            contents.add([sample.angle_rad, sample.reading_mm]);
            headings.add(sample.angle_rad);
            if !known.covers(sample.angle_rad) && outside.len() < SAMPLES {
                outside.push((sample.line, sample.angle_rad));
            }
            samples += 1;
        })?;
        match known.outside(outside) {
            Some(problem) => Err(FileError { file: file.to_owned(), problem }),
            None => {
                Ok(Self { setup, run, weight: 1.0, file: file.to_owned(), columns, contents, known, headings, samples })
            }
        }
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
        let mut take = |[sweep, reading]: [f64; 2]| {
            (sample.sweep, sample.reading) = (sweep, reading);
            sample.direction = heading.at(sweep);
            self.known.write(sweep, &mut sample);
            each(&sample);
        };
        if let Contents::Kept(kept) = &self.contents {
            kept.iter().copied().for_each(take);
            return Ok(());
        }
        let mut samples = 0;
        for line in Lines::open(&self.file, &self.columns.wanted())? {
            let Some(read) = RunColumns::sample(&line?) else { continue };
            take([read.angle_rad, read.reading_mm]);
            samples += 1;
        }
        match samples == self.samples {
            true => Ok(()),
            false => Err(FileError { file: self.file.clone(), problem: FileProblem::Changed }),
        }
    }
}
