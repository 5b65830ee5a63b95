//! A run in arrays, as a program has it.

use super::observation::{BEYOND_STROKE_MM, MOST_TURNS, Sample};
use super::recording::Recording;
use super::setup::Setup;
use super::weigh::Weighed;
use core::convert::Infallible;
use core::f64::consts::TAU;
use thiserror::Error;
use trunnion_codegen::emit::model::known_name;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::kinematics::Headings;
use trunnion_codegen::quantity::Unit;

/// Numbers in a unit.
#[derive(Clone, Copy, Debug)]
pub struct Column<'a> {
    /// The numbers.
    pub values: &'a [f64],
    /// Their unit.
    pub unit: Unit,
}

impl Column<'_> {
    /// All zero; of no length of its own.
    const ZERO: Self = Self { values: &[], unit: Unit::Mm };

    fn at(&self, i: usize) -> f64 {
        self.values.get(i).map_or(0.0, |value| self.unit.to_inner(*value))
    }
}

/// A known function at the samples of a run.
#[derive(Clone, Copy, Debug)]
pub struct KnownColumn<'a> {
    /// Its name as in a table: `dya`.
    pub name: &'a str,
    /// Its values.
    pub values: Column<'a>,
    /// Their standard uncertainties, where they are stated.
    pub std: Option<Column<'a>>,
}

/// A run, sample after sample in the order in which they were taken.
#[derive(Clone, Debug)]
pub struct Arrays<'a> {
    run: RunId,
    weight: f64,
    sweep: Column<'a>,
    reading: Column<'a>,
    /// Values of the run's known functions and their standard uncertainties.
    known: Vec<[Column<'a>; 2]>,
    headings: Headings,
}

/// Why arrays are no run.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ArrayError {
    /// Arrays of one run that differ in length.
    #[error("run `{run}`: {column} has {found} values where the sweep has {expected}\n  expected one for each sample")]
    Lengths {
        /// The run.
        run: String,
        /// Which.
        column: String,
        /// Its length.
        found: usize,
        /// The sweep's.
        expected: usize,
    },
    /// NaN or infinite.
    #[error(
        "run `{run}`: {column} is {value} at sample {at}, counted from 0\n  expected finite numbers: leave the sample out"
    )]
    NotFinite {
        /// The run.
        run: String,
        /// Which.
        column: String,
        /// Where, counted from 0.
        at: usize,
        /// What is there.
        value: f64,
    },
    /// Degrees where radians belong.
    #[error(
        "run `{run}`: the sweep is {turns:.1} turns at sample {at}, counted from 0\n  expected at most {MOST_TURNS}: is the angle in rad, or named with its unit (a_deg)?"
    )]
    ManyTurns {
        /// The run.
        run: String,
        /// Where, counted from 0.
        at: usize,
        /// How many.
        turns: f64,
    },
    /// Lengths where deviations belong, or µm where mm do.
    #[error(
        "run `{run}`: the reading is {reading_mm} mm at sample {at}, counted from 0, beyond the stroke of a ball-bar\n  expected deviations from the nominal length in mm, or named with their unit (dr_um)"
    )]
    BeyondStroke {
        /// The run.
        run: String,
        /// Where, counted from 0.
        at: usize,
        /// The reading, mm.
        reading_mm: f64,
    },
    /// Not one of the run's known functions.
    #[error("run `{run}` has no known function `{name}`\n  expected {}", if .known.is_empty() { "none".to_owned() } else { .known.join(", ") })]
    NotKnown {
        /// The run.
        run: String,
        /// The name given.
        name: String,
        /// Those there are.
        known: Vec<String>,
    },
    /// A negative uncertainty.
    #[error(
        "run `{run}`: the uncertainty of {name} is negative at sample {at}, counted from 0\n  expected a standard uncertainty, 0 or above"
    )]
    Negative {
        /// The run.
        run: String,
        /// The known function.
        name: String,
        /// Where, counted from 0.
        at: usize,
    },
}

impl<'a> Arrays<'a> {
    /// A run's sweep (an angle) and readings (a length); known functions that are not given are taken as zero.
    ///
    /// # Errors
    /// [`ArrayError`], as a file of such samples would be refused.
    pub fn new(
        setup: &Setup,
        run: RunId,
        sweep: Column<'a>,
        reading: Column<'a>,
        known: &[KnownColumn<'a>],
    ) -> Result<Self, ArrayError> {
        let name = || setup.model.runs[run].name.clone();
        let count = sweep.values.len();
        let check = |column: Column, what: &str| {
            let found = column.values.len();
            if found != count {
                return Err(ArrayError::Lengths { run: name(), column: what.to_owned(), found, expected: count });
            }
            match column.values.iter().position(|value| !value.is_finite()) {
                Some(at) => {
                    let value = column.values[at];
                    Err(ArrayError::NotFinite { run: name(), column: what.to_owned(), at, value })
                }
                None => Ok(()),
            }
        };
        check(sweep, "the sweep")?;
        check(reading, "the reading")?;
        let mut headings = Headings::default();
        for at in 0..count {
            let (angle, reading_mm) = (sweep.at(at), reading.at(at));
            if angle.abs() > MOST_TURNS * TAU {
                return Err(ArrayError::ManyTurns { run: name(), at, turns: angle / TAU });
            }
            if reading_mm.abs() > BEYOND_STROKE_MM {
                return Err(ArrayError::BeyondStroke { run: name(), at, reading_mm });
            }
            headings.add(angle);
        }
        let of_run: Vec<String> =
            setup.derivation.runs[run].known.iter().map(|(f, _)| known_name(&setup.model, *f)).collect();
        let mut own = vec![[Column::ZERO; 2]; of_run.len()];
        for given in known {
            let Some(place) = of_run.iter().position(|name| name == given.name) else {
                return Err(ArrayError::NotKnown { run: name(), name: given.name.to_owned(), known: of_run });
            };
            check(given.values, given.name)?;
            own[place] = [given.values, given.std.unwrap_or(Column::ZERO)];
            if let Some(std) = given.std {
                check(std, &format!("u_{}", given.name))?;
                if let Some(at) = std.values.iter().position(|std| *std < 0.0) {
                    return Err(ArrayError::Negative { run: name(), name: given.name.to_owned(), at });
                }
            }
        }
        Ok(Self { run, weight: 1.0, sweep, reading, known: own, headings })
    }
}

impl Weighed for Arrays<'_> {
    fn weigh(&mut self, weight: f64) {
        self.weight = weight;
    }
}

impl Recording for Arrays<'_> {
    type Error = Infallible;

    fn run(&self) -> RunId {
        self.run
    }

    fn weight(&self) -> f64 {
        self.weight
    }

    fn is_ordered(&self) -> bool {
        self.headings.start().is_known()
    }

    fn each(&self, each: &mut dyn FnMut(&Sample)) -> Result<(), Infallible> {
        let mut heading = self.headings.start();
        let zeros = || vec![0.0; self.known.len()];
        let mut sample = Sample { sweep: 0.0, direction: 0.0, reading: 0.0, known: zeros(), known_std: zeros() };
        for at in 0..self.sweep.values.len() {
            (sample.sweep, sample.reading) = (self.sweep.at(at), self.reading.at(at));
            sample.direction = heading.at(sample.sweep);
            let places = sample.known.iter_mut().zip(&mut sample.known_std);
            for ((value, std), [values, stds]) in places.zip(&self.known) {
                (*value, *std) = (values.at(at), stds.at(at));
            }
            each(&sample);
        }
        Ok(())
    }
}
