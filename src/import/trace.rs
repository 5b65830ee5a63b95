//! What is read of an instrument's file: runs with what is known of them.

use std::fmt;
use std::ops::Range;

use super::arc::Arc;
use super::error::{ImportProblem, Wrong};
use super::feed::doubtful;
use crate::circular::{Direction, Plane};
use trunnion_codegen::quantity::Unit;

/// What is stated where the file does not say it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stated {
    /// The unit of the readings.
    pub unit: Option<Unit>,
    /// The ends of the arc, degrees; samples beyond them are trimmed.
    pub ends_deg: Option<(f64, f64)>,
    /// How far the readings go beyond either end, degrees, where they have no angles.
    pub overshoot_deg: f64,
    /// The plane of the test.
    pub plane: Option<Plane>,
}

/// A measurement in an instrument's file.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// What the file says of it.
    pub about: About,
    /// Its runs, in the order of the file.
    pub traces: Vec<Trace>,
}

/// What a file says of its measurement, in its words; nothing of what it does not say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// The test's name.
    pub test: Option<String>,
    /// Maker and model of the instrument.
    pub instrument: Option<String>,
    /// Its serial number.
    pub serial: Option<String>,
    /// When it was calibrated.
    pub calibrated: Option<String>,
    /// The machine.
    pub machine: Option<String>,
    /// Who measured.
    pub operator: Option<String>,
    /// When the test began.
    pub started: Option<String>,
    /// When it ended.
    pub completed: Option<String>,
    /// The plane.
    pub plane: Option<Plane>,
    /// Nominal length of the bar, mm.
    pub bar_mm: Option<f64>,
    /// Programmed feed, mm/min.
    pub feed: Option<f64>,
    /// What the instrument's program found.
    pub features: Vec<Feature>,
}

/// By how much of itself the bar's length in an instrument's file may differ from another: a bar is known by its calibration.
const BAR: f64 = 0.01;

impl About {
    /// Whether its bar may be one of a length, mm.
    ///
    /// # Errors
    /// [`ImportProblem`] where it is another.
    pub fn fits(&self, bar_mm: f64) -> Result<(), ImportProblem> {
        match self.bar_mm.filter(|found_mm| (found_mm - bar_mm).abs() > BAR * bar_mm) {
            Some(found_mm) => Err(Wrong::OtherBar { found_mm, bar_mm }.of_all()),
            None => Ok(()),
        }
    }

    /// What it says, line by line: what each is called, and its words.
    pub fn lines(&self) -> Vec<(&'static str, String)> {
        let number = |value: Option<f64>, unit: &str| value.map(|value| format!("{value} {unit}"));
        let own = [
            ("test", self.test.clone()),
            ("instrument", self.instrument.clone()),
            ("serial number", self.serial.clone()),
            ("calibrated", self.calibrated.clone()),
            ("machine", self.machine.clone()),
            ("operator", self.operator.clone()),
            ("started", self.started.clone()),
            ("completed", self.completed.clone()),
            ("plane", self.plane.map(|plane| plane.to_string())),
            ("nominal length", number(self.bar_mm, "mm")),
            ("programmed feed", number(self.feed, "mm/min")),
        ];
        own.into_iter().filter_map(|(name, words)| Some((name, words?))).collect()
    }
}

/// A number that the instrument's program found, as it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// Its name, `AF_CIRCULARITY`.
    pub name: String,
    /// Its unit, `UT_LENGTH_MM`.
    pub unit: String,
    /// Its value.
    pub value: f64,
    /// The line of the file it stands on, counted from 1.
    pub line: u64,
}

/// One pass along the circle.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Every sample in the order of time.
    pub samples: Vec<TraceSample>,
    /// Those that are trimmed.
    pub cut: Cut,
    /// Which way it goes; none of samples in no order in time.
    pub direction: Option<Direction>,
    /// The unit of the readings in the file.
    pub unit: Unit,
    /// Where it is from.
    pub unit_from: UnitFrom,
    /// Where the angles are from.
    pub angles_from: AnglesFrom,
    /// What the instrument's program found in it.
    pub features: Vec<Feature>,
}

/// A sample as it was taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceSample {
    /// The swept angle, rad.
    pub angle_rad: f64,
    /// The radial deviation, mm.
    pub reading_mm: f64,
    /// The line of the file it stands on, counted from 1.
    pub line: u64,
}

/// Samples that are trimmed, at the beginning and at the end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cut {
    /// While the bar is on its way to the circle, and from it.
    pub feed: [usize; 2],
    /// Beyond the ends of the arc.
    pub overshoot: [usize; 2],
    /// Whether the first and the last of what is kept are so far off its circle that they may be a way to it: that cannot be
    /// decided, and nothing is trimmed for it.
    pub doubtful: [bool; 2],
}

/// Where the unit of readings is from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum UnitFrom {
    /// The header of their column, or what is stated with its name.
    Header,
    /// It was stated.
    Stated,
    /// It is that in which they are as round as the instrument's program says.
    Circularity {
        /// How round they are, mm.
        readings_mm: f64,
        /// How round they are said to be, mm.
        told_mm: f64,
    },
    /// It is that of another run of the same file.
    OtherRun,
}

/// Where angles are from.
#[derive(Clone, Debug, PartialEq)]
pub enum AnglesFrom {
    /// The file.
    Column,
    /// Even steps along an arc that was stated.
    Stated(Arc),
    /// Even steps along the arc in the test's name.
    Name(Arc),
}

impl Trace {
    /// The samples that are no feed-in or feed-out and lie within the arc.
    pub fn kept(&self) -> &[TraceSample] {
        self.samples.get(self.range()).unwrap_or_default()
    }

    /// Their places.
    pub fn range(&self) -> Range<usize> {
        let [begin, end] = [0, 1].map(|at| self.cut.feed[at] + self.cut.overshoot[at]);
        begin..self.samples.len().saturating_sub(end)
    }

    /// Trims what is beyond the ends of an arc, degrees, where it has any, and looks at what is left.
    pub(super) fn trim(&mut self, ends_deg: Option<(f64, f64)>) -> Result<(), ImportProblem> {
        ends_deg.map_or(Ok(()), |ends| self.trim_to(ends))?;
        if self.direction.is_some() {
            self.cut.doubtful = doubtful(self.kept().iter().map(|sample| (sample.angle_rad, sample.reading_mm)));
        }
        Ok(())
    }

    fn trim_to(&mut self, (from_deg, to_deg): (f64, f64)) -> Result<(), ImportProblem> {
        let arc = Arc { from_deg, to_deg, overshoot_deg: 0.0 };
        let line = self.samples.first().map_or(1, |sample| sample.line);
        let [begin, end] = self.cut.feed;
        let fed = self.samples.get(begin..self.samples.len().saturating_sub(end)).unwrap_or_default();
        let inside = |sample: &TraceSample| arc.has(sample.angle_rad);
        let (Some(first), Some(last)) = (fed.iter().position(inside), fed.iter().rposition(inside)) else {
            return Err(Wrong::Outside { from_deg, to_deg }.at(line));
        };
        self.cut.overshoot = [first, fed.len() - 1 - last];
        Ok(())
    }

    /// What it is in a few words: which way, from where to where, the unit and the angles and where they are from, what was
    /// trimmed.
    pub fn told(&self) -> Vec<(&'static str, String)> {
        let way = self.direction.map_or_else(|| "in no order in time".to_owned(), |way| way.short().to_owned());
        let kept = self.kept();
        let ends = kept.first().zip(kept.last());
        let degrees = |angle: f64| format!("{}°", Unit::Deg.decimal(angle + 0.0).trim_end_matches(".0"));
        let ends = ends.map(|(first, last)| format!(", {} to {}", degrees(first.angle_rad), degrees(last.angle_rad)));
        vec![
            ("run", format!("{way}{}, {} samples", ends.unwrap_or_default(), kept.len())),
            ("unit of the readings", format!("{}, {}", self.unit.symbol(), self.unit_from)),
            ("angles", self.angles_from.to_string()),
            ("trimmed", self.cut.to_string()),
        ]
    }

    /// The same in one line.
    pub fn in_words(&self) -> String {
        let told = self.told().into_iter().map(|(what, words)| format!("{what}: {words}"));
        told.collect::<Vec<_>>().join("; ")
    }
}

impl fmt::Display for UnitFrom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Header => f.write_str("as the header says"),
            Self::Stated => f.write_str("as stated"),
            Self::OtherRun => f.write_str("as in another run of this file"),
            Self::Circularity { readings_mm, told_mm } => {
                write!(f, "which makes their circularity {readings_mm:.4} mm, where AF_CIRCULARITY is {told_mm} mm")
            }
        }
    }
}

impl fmt::Display for AnglesFrom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (arc, whence) = match self {
            Self::Column => return f.write_str("as in the file"),
            Self::Stated(arc) => (arc, "stated"),
            Self::Name(arc) => (arc, "of the test's name"),
        };
        write!(f, "even steps along the arc {whence}, {}° to {}°", arc.from_deg, arc.to_deg)?;
        match arc.overshoot_deg {
            0.0 => Ok(()),
            overshoot => write!(f, ", and {overshoot}° beyond either end"),
        }
    }
}

impl fmt::Display for Cut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { feed: [fed_in, fed_out], overshoot: [before, after], doubtful } = self;
        let parts =
            [(fed_in, "of the feed-in"), (before, "before the arc"), (after, "after it"), (fed_out, "of the feed-out")];
        let parts = parts.iter().filter(|(count, _)| **count > 0).map(|(count, what)| format!("{count} {what}"));
        match parts.collect::<Vec<_>>().join(", ").as_str() {
            "" => f.write_str("nothing")?,
            parts => write!(f, "{parts} (samples)")?,
        }
        let where_ = match doubtful {
            [false, false] => return Ok(()),
            [true, false] => "at the beginning",
            [false, true] => "at the end",
            [true, true] => "at both ends",
        };
        write!(
            f,
            "; what is kept {where_} is far off the circle: whether it is a feed-in cannot be decided, see the picture"
        )
    }
}
