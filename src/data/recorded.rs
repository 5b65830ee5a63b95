//! A run's file that was found good, to be gone through again and again.

use super::error::{FileError, FileProblem};
use super::known::KnownAlong;
use super::limits::{KEPT, SAMPLES};
use super::lines::{Line, Lines};
use super::stamp::Stamp;
use super::sweep::{RunColumns, check};
use crate::circular::Axis;
use crate::import::{About, ImportProblem, Trace, TraceSample, Wrong};
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
    /// The run as an instrument's file has it.
    trace: Option<Trace>,
    /// What that file says of the test, line by line.
    about: Vec<(&'static str, String)>,
    known: KnownAlong,
    headings: Headings,
    samples: usize,
    stamp: Stamp,
}

/// What the columns of a run of an instrument's file are called in messages.
const IMPORTED: [&str; 2] = ["the arc", "READINGS"];

/// What is gone through.
enum Contents {
    /// The samples' sweeps and readings.
    Kept(Vec<[f64; 2]>),
    /// More than are kept: the file is read again.
    File,
}

impl Contents {
    /// Keeps a sample, or goes over to a file that can be read again.
    fn add(&mut self, sample: [f64; 2], again: bool) {
        match self {
            Self::Kept(samples) if samples.len() < KEPT || !again => samples.push(sample),
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
        let (lines, stamping) = Lines::stamped(file, &columns.wanted())?;
        Self::of(setup, run, (file, lines), columns, (known, None), || stamping.stamp())
    }

    /// A run of an instrument's file.
    pub(super) fn imported(
        setup: &'a Setup,
        run: RunId,
        (file, about, trace): (&Path, &About, Trace),
        stamp: &Stamp,
        columns: RunColumns<'a>,
        known: KnownAlong,
    ) -> Result<Self, FileError> {
        let fail = |problem: ImportProblem| FileError { file: file.to_owned(), problem: problem.into() };
        if !columns.others.is_empty() {
            return Err(fail(Wrong::NoDisplacements.of_all()));
        }
        columns.bar_mm.map_or(Ok(()), |bar_mm| about.fits(bar_mm)).map_err(fail)?;
        if let Some(found) = about.plane
            && let Some(axes) = setup.other_plane(run, [Axis::First, Axis::Second].map(|axis| found.axis(axis)))
        {
            return Err(fail(Wrong::RunPlane { found, axes: axes.join(" and ") }.of_all()));
        }
        let line = |s: &TraceSample| Line { line: s.line, values: vec![s.angle_rad, s.reading_mm] };
        let lines = Lines::given(file, &IMPORTED, trace.kept().iter().map(line).collect());
        let recorded = Self::of(setup, run, (file, lines), columns, (known, Some(trace)), || stamp.clone())?;
        Ok(Self { about: about.lines(), ..recorded })
    }

    fn of(
        setup: &'a Setup,
        run: RunId,
        (file, lines): (&Path, Lines),
        columns: RunColumns<'a>,
        (known, trace): (KnownAlong, Option<Trace>),
        stamp: impl FnOnce() -> Stamp,
    ) -> Result<Self, FileError> {
        let mut contents = Contents::Kept(Vec::new());
        let most = if trace.is_some() { usize::MAX } else { most(file) };
        let again = trace.is_none() && most == usize::MAX;
        let (mut headings, mut outside, mut samples) = (Headings::default(), Vec::new(), 0);
        check(lines, &columns, most, |sample| {
            contents.add([sample.angle_rad, sample.reading_mm], again);
            headings.add(sample.angle_rad);
            if !known.covers(sample.angle_rad) && outside.len() < SAMPLES {
                outside.push((sample.line, sample.angle_rad));
            }
            samples += 1;
        })?;
        let file = file.to_owned();
        match known.outside(outside) {
            Some(problem) => Err(FileError { file, problem }),
            None => {
                let stamp = stamp();
                let (weight, about) = (1.0, Vec::new());
                Ok(Self { setup, run, weight, file, columns, contents, trace, about, known, headings, samples, stamp })
            }
        }
    }

    /// The file and the run in it, where it is an instrument's.
    pub fn trace(&self) -> Option<(&Path, &Trace)> {
        self.trace.as_ref().map(|trace| (self.file.as_path(), trace))
    }

    /// The file.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// What an instrument's file says of the test, line by line: what each is called, and its words.
    pub fn about(&self) -> &[(&'static str, String)] {
        &self.about
    }

    /// What was read of it.
    pub fn stamp(&self) -> &Stamp {
        &self.stamp
    }

    /// What was read of the table of the known functions, where there is one and the run sees them.
    pub fn table(&self) -> Option<&Stamp> {
        self.known.stamp()
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
