//! One run of the ball-bar.

use std::collections::HashSet;
use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use super::called::{Columns, NATIVE};
use super::columns::{SWEEP, Wanted, deviation};
use super::error::{BadLines, FieldProblem, FileError, FileProblem, LineProblem, Need};
use super::limits::SAMPLES;
use super::lines::{Line, Lines};
use super::output::{WriteError, WriteProblem, write_atomically};
use super::radius::Radius;
use super::written::written;
use crate::study::{BEYOND_STROKE_MM, MOST_TURNS};
use trunnion_codegen::quantity::{Quantity, Unit};

/// The readings' column without its unit.
pub(super) const READING: &str = "dr";

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
    /// The swept angle's column without its unit; none if it may have any name.
    pub angle: Option<&'a str>,
    /// The readings' column without its unit.
    pub reading: &'a str,
    /// Other lengths that have to be there.
    pub others: &'a [&'a str],
    /// What its columns are called in the file.
    pub names: &'a Columns,
    /// Nominal length of the bar, mm; none where displacements are read.
    pub bar_mm: Option<f64>,
    /// Samples needed.
    pub least: usize,
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
        let bar_mm = Some(radius.mm());
        let expected = RunColumns { angle: Some(angle), reading: READING, others: &[], names: &NATIVE, bar_mm, least };
        let mut samples = Vec::new();
        let lines = Lines::open(file, &expected.wanted())?;
        check(lines, &expected, SAMPLES, |sample| samples.push(sample))?;
        Ok(Self { file: file.to_owned(), samples })
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
        let columns = columns(angle, angle_unit, length_unit);
        let lines = self.samples.iter().map(|sample| vec![sample.angle_rad, sample.reading_mm]);
        written(&columns, lines)
    }
}

/// The columns of a run's file as it is written.
pub(super) fn columns(angle: &str, angle_unit: Unit, length_unit: Unit) -> [(Wanted<'_>, Unit); 2] {
    [(Wanted::new(angle, SWEEP), angle_unit), (Wanted::new(READING, deviation(Quantity::Length)), length_unit)]
}

impl<'a> RunColumns<'a> {
    /// The columns, the angle's and the readings' first.
    pub fn wanted(&self) -> Vec<Wanted<'a>> {
        let length = |name| Wanted::new(name, deviation(Quantity::Length));
        let others = self.others.iter().map(|name| length(name));
        let angle = self.angle.map_or(Wanted::any("a", SWEEP), |name| Wanted::new(name, SWEEP));
        let wanted = [angle, length(self.reading)].into_iter().chain(others);
        wanted.map(|wanted| wanted.in_files(self.names)).collect()
    }

    /// The sample on a line of these columns.
    pub fn sample(line: &Line) -> Option<SweepSample> {
        match line.values.as_slice() {
            [angle, reading, ..] => Some(SweepSample { angle_rad: *angle, reading_mm: *reading, line: line.line }),
            _ => None,
        }
    }
}

/// Goes through the samples of a run, `most` of them at most, and refuses what no ball-bar gives.
pub(super) fn check(
    lines: Lines,
    expected: &RunColumns,
    most: usize,
    mut each: impl FnMut(SweepSample),
) -> Result<(), FileError> {
    let file = lines.file().to_owned();
    let fail = |problem| FileError { file: file.clone(), problem };
    let mut names = lines.columns().iter().map(|column| column.name().to_owned());
    let [angle, reading] = [names.next(), names.next()].map(Option::unwrap_or_default);
    let mut seen = Seen::default();
    for line in lines {
        let Some(sample) = RunColumns::sample(&line?) else { continue };
        if seen.samples == most {
            return Err(fail(FileProblem::TooMany { most, of: Need::Coefficients }));
        }
        seen.add(sample, expected.least);
        each(sample);
    }
    seen.problem(expected, angle, reading).map_or(Ok(()), |problem| Err(fail(problem)))
}

/// Sizes of readings that are kept for their median, at most.
const SIZES: usize = 1 << 12;

/// What was seen of a run's samples, in constant memory.
#[derive(Default)]
struct Seen {
    samples: usize,
    farthest: f64,
    /// Different angles, until there are enough.
    angles: HashSet<u64>,
    /// Readings within twice the stroke.
    within: usize,
    stray: Option<BadLines>,
    /// Sizes of every so many-th reading.
    sizes: Vec<f64>,
    step: usize,
}

impl Seen {
    fn add(&mut self, sample: SweepSample, least: usize) {
        self.farthest = self.farthest.max(sample.angle_rad.abs());
        // Repeated angles are data, but tell nothing more of the shape. Adding zero makes one of the two zeros.
        if self.angles.len() < least {
            self.angles.insert((sample.angle_rad + 0.0).to_bits());
        }
        let size = sample.reading_mm.abs();
        if size <= BEYOND_STROKE_MM {
            self.within += 1;
        } else {
            let problem = FieldProblem::BeyondStroke { reading_mm: sample.reading_mm };
            let problem = LineProblem { line: sample.line, problem };
            match &mut self.stray {
                None => self.stray = Some(BadLines::new(problem)),
                Some(stray) => stray.add(problem),
            }
        }
        self.step = self.step.max(1);
        if self.sizes.len() == SIZES {
            let mut position = 0;
            self.sizes.retain(|_| {
                position += 1;
                position % 2 == 1
            });
            self.step *= 2;
        }
        if self.samples.is_multiple_of(self.step) {
            self.sizes.push(size);
        }
        self.samples += 1;
    }

    fn problem(self, expected: &RunColumns, angle: String, reading: String) -> Option<FileProblem> {
        let RunColumns { bar_mm, least, .. } = *expected;
        if self.farthest > MOST_TURNS * TAU {
            return Some(FileProblem::ManyTurns { angle_rad: self.farthest, most: MOST_TURNS, column: angle });
        }
        if self.angles.len() < least {
            return Some(FileProblem::TooFew { present: self.angles.len(), needed: least, why: Need::Coefficients });
        }
        // The median, the upper one of two, is within the stroke.
        if self.within > self.samples / 2 {
            return self.stray.map(FileProblem::Lines);
        }
        let median_mm = median(self.sizes)?;
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
