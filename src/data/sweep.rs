//! One run of the ball-bar.

use std::collections::HashSet;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use super::columns::{SWEEP, Wanted, deviation};
use super::error::{BadLines, FieldProblem, FileError, FileProblem, LineProblem, Need};
use super::limits::SAMPLES;
use super::lines::Lines;
use super::output::{WriteError, WriteProblem, write_atomically};
use super::radius::Radius;
use super::written::written;
use trunnion_codegen::quantity::{Quantity, Unit};

/// A reading whose size is beyond this is none a ball-bar gives: twice its stroke, mm.
const BEYOND_STROKE_MM: f64 = 2.0;

/// An angle beyond this many turns is none of a run.
const MOST_TURNS: f64 = 10.0;

/// The readings' column without its unit.
const READING: &str = "dr";

/// One sample of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweepSample {
    /// The swept angle, rad.
    pub angle_rad: f64,
    /// The radial deviation ΔR: bar length less the radius, mm.
    pub reading_mm: f64,
    /// The line of the file it stands on, counted from 1.
    pub line: u64,
}

/// The samples of one run, in the file's order.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    file: PathBuf,
    samples: Vec<SweepSample>,
}

/// What a run's file has to hold.
#[derive(Clone, Copy)]
pub(super) struct RunColumns<'a> {
    /// The swept angle's column without its unit.
    pub angle: &'a str,
    /// The readings' column without its unit.
    pub reading: &'a str,
    /// Other lengths that have to be there.
    pub others: &'a [&'a str],
    /// Nominal length of the bar, mm; none where displacements are read.
    pub bar_mm: Option<f64>,
    /// Samples needed.
    pub least: usize,
    /// Samples that can be kept.
    pub most: usize,
}

impl Sweep {
    /// Reads a run: columns `<angle>_deg|_rad` and `dr_um|_mm`, `angle` being the swept angle's symbol (`"a"`).
    ///
    /// `least` is the number of samples needed (that of the coefficients to fit), `radius` the bar's nominal length.
    ///
    /// # Errors
    /// [`FileError`] where the file cannot be read or is no such file; where an angle is beyond ten
    /// turns; where there are fewer than `least` angles, or more than [`SAMPLES`]; where the readings are absolute lengths or
    /// otherwise beyond a ball-bar's stroke (median, or a single one, beyond 2 mm).
    pub fn read(file: &Path, angle: &str, radius: Radius, least: usize) -> Result<Self, FileError> {
        Self::read_as(
            file,
            &RunColumns { angle, reading: READING, others: &[], bar_mm: Some(radius.mm()), least, most: SAMPLES },
        )
    }

    /// As [`Sweep::read`] with other columns, perhaps without a bar.
    pub(super) fn read_as(file: &Path, expected: &RunColumns) -> Result<Self, FileError> {
        let RunColumns { angle, reading, others, bar_mm, least, most } = *expected;
        let length = |name| Wanted::new(name, deviation(Quantity::Length));
        let wanted: Vec<Wanted> = [Wanted::new(angle, SWEEP), length(reading)]
            .into_iter()
            .chain(others.iter().map(|name| length(name)))
            .collect();
        let lines = Lines::open(file, &wanted)?;
        let mut names = lines.columns().iter().map(|column| column.name().to_owned());
        let names = [names.next(), names.next()].map(Option::unwrap_or_default);
        let samples: Vec<SweepSample> = lines.all(most, Need::Coefficients, |line| match line.values.as_slice() {
            [angle, reading, ..] => Some(SweepSample { angle_rad: *angle, reading_mm: *reading, line: line.line }),
            _ => None,
        })?;
        match check(&samples, bar_mm, least, names) {
            Some(problem) => Err(FileError { file: file.to_owned(), problem }),
            None => Ok(Self { file: file.to_owned(), samples }),
        }
    }

    /// A run that comes from elsewhere (a simulation), with lines as [`Sweep::write`] gives them; pairs of angle in rad
    /// and reading in mm, which are not checked here. `file` is where it will stand.
    pub fn new(file: impl Into<PathBuf>, samples: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let samples =
            (2..).zip(samples).map(|(line, (angle_rad, reading_mm))| SweepSample { angle_rad, reading_mm, line });
        Self { file: file.into(), samples: samples.collect() }
    }

    /// Where it was read from.
    pub fn file(&self) -> &Path {
        &self.file
    }

    /// The samples in the file's order.
    pub fn samples(&self) -> &[SweepSample] {
        &self.samples
    }

    /// Smallest and largest angle, rad; none without samples.
    pub fn range_rad(&self) -> Option<(f64, f64)> {
        let first = self.samples.first()?.angle_rad;
        let widen =
            |(low, high): (f64, f64), sample: &SweepSample| (low.min(sample.angle_rad), high.max(sample.angle_rad));
        Some(self.samples.iter().fold((first, first), widen))
    }

    /// Writes the run to [`Sweep::file`], its angle in `angle_unit` (degrees or radians) and its readings in
    /// `length_unit` (µm or mm), so that reading gives back the same run.
    ///
    /// # Errors
    /// [`WriteError`] where the file cannot be written, a value is not finite, or a unit is not one of those named.
    pub fn write(&self, angle: &str, angle_unit: Unit, length_unit: Unit) -> Result<(), WriteError> {
        let contents = self.contents(angle, angle_unit, length_unit);
        let contents = contents.map_err(|problem| WriteError { file: self.file.clone(), problem })?;
        write_atomically(&self.file, &contents)
    }

    /// What [`Sweep::write`] writes.
    pub(super) fn contents(&self, angle: &str, angle_unit: Unit, length_unit: Unit) -> Result<Vec<u8>, WriteProblem> {
        let columns =
            [(Wanted::new(angle, SWEEP), angle_unit), (Wanted::new(READING, deviation(Quantity::Length)), length_unit)];
        let lines = self.samples.iter().map(|sample| vec![sample.angle_rad, sample.reading_mm]);
        written(&columns, lines)
    }
}

fn check(
    samples: &[SweepSample],
    bar_mm: Option<f64>,
    least: usize,
    [angle, reading]: [String; 2],
) -> Option<FileProblem> {
    let angle_rad = samples.iter().map(|sample| sample.angle_rad.abs()).fold(0.0, f64::max);
    if angle_rad > MOST_TURNS * TAU {
        return Some(FileProblem::ManyTurns { angle_rad, most: MOST_TURNS, column: angle });
    }
    // Repeated angles are data, but tell nothing more of the shape. Adding zero makes one of the two zeros.
    let angles: HashSet<u64> = samples.iter().map(|sample| (sample.angle_rad + 0.0).to_bits()).collect();
    if angles.len() < least {
        return Some(FileProblem::TooFew { present: angles.len(), needed: least, why: Need::Coefficients });
    }
    let median_mm = median(samples.iter().map(|sample| sample.reading_mm.abs()).collect())?;
    if median_mm <= BEYOND_STROKE_MM {
        let stray = samples.iter().filter(|sample| sample.reading_mm.abs() > BEYOND_STROKE_MM).map(|sample| {
            LineProblem { line: sample.line, problem: FieldProblem::BeyondStroke { reading_mm: sample.reading_mm } }
        });
        BadLines::of(stray).map(FileProblem::Lines)
    } else {
        let near = |mm: &f64| (median_mm - mm).abs() <= BEYOND_STROKE_MM.max(mm / 100.0);
        Some(match bar_mm.filter(near) {
            Some(radius_mm) => FileProblem::AbsoluteLengths { median_mm, near_mm: median_mm.round(), radius_mm },
            None => FileProblem::BeyondStroke { median_mm, column: reading, radius_mm: bar_mm },
        })
    }
}

/// The middle value, the upper one of two.
fn median(mut values: Vec<f64>) -> Option<f64> {
    let middle = values.len() / 2;
    values.sort_by(f64::total_cmp);
    values.get(middle).copied()
}
