//! The quantities that a result depends on, one by one: the rows of a budget as the GUM has them (JCGM 100, 8 and table H.1).

use super::gum::Contribution;
use super::source::{Line, Source};
use crate::study::setup::Setup;
use core::fmt;
use trunnion_codegen::algebra::{ErrorId, NominalId};
use trunnion_codegen::quantity::{Quantity, Unit};

/// What a quantity is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Of {
    /// A reading, as residuals scatter.
    Scatter,
    /// The instrument's constant error.
    Constant,
    /// Its error in proportion to the reading.
    Proportional,
    BarLength,
    Temperature,
    /// A length of the set-up.
    Length(NominalId),
    /// A function in a table.
    Table(ErrorId),
    /// An error within its limit.
    Error(ErrorId),
    /// Products of errors.
    Dropped,
}

/// A quantity's part in a result, in the units inside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Part {
    pub source: Source,
    pub of: Of,
    /// Standard uncertainty of the quantity: u(x).
    pub std: f64,
    /// What that makes of the result's: |c|·u(x).
    pub contribution: f64,
}

impl Part {
    /// An error that changes the result by at most `effect` times its size, which is anywhere within a limit (GUM 4.3.7).
    pub fn within(source: Source, error: ErrorId, effect: f64, limit: f64) -> Self {
        let std = limit / 3f64.sqrt();
        Self { source, of: Of::Error(error), std, contribution: effect.abs() * std }
    }
}

/// The lines that parts make, those of one source together; they are uncorrelated.
pub(super) fn lines(parts: &[Part], degrees_of_freedom: u32) -> Vec<Line> {
    let mut lines: Vec<Line> = Vec::new();
    for &Part { source, contribution: std, .. } in parts {
        match lines.last_mut().filter(|line| line.source == source) {
            Some(line) => line.contribution.std = line.contribution.std.hypot(std),
            None => {
                let degrees_of_freedom = (source == Source::Noise).then_some(degrees_of_freedom);
                lines.push(Line { source, contribution: Contribution { std, degrees_of_freedom } });
            }
        }
    }
    lines.retain(|line| line.source == Source::Noise || line.contribution.std > 0.0);
    lines
}

/// How a quantity is distributed about its estimate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distribution {
    /// Student's t with the degrees of freedom: known from repeated readings.
    Student,
    /// Normal.
    Normal,
    /// Anywhere within ± a bound alike.
    Rectangular,
    /// A bound that holds at each reading, of an error that is a sum of slow waves over the sweep: what it makes of a result is
    /// near normal.
    Waves,
    /// As it comes out on drawn machines.
    Drawn,
}

impl Distribution {
    /// What a stated half width is divided by for a standard uncertainty; none where none is stated.
    pub fn divisor(self) -> Option<f64> {
        matches!(self, Self::Rectangular | Self::Waves).then(|| 3f64.sqrt())
    }
}

impl fmt::Display for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Student => "Student's t",
            Self::Normal => "normal",
            Self::Rectangular => "rectangular",
            Self::Waves => "rectangular, in waves",
            Self::Drawn => "drawn",
        })
    }
}

/// A row of a budget: a quantity, how well it is known, and what that does to the result.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// The line that it is in.
    pub source: Source,
    /// Its name: of an error or a length as the model has it.
    pub quantity: String,
    /// How it is distributed.
    pub distribution: Distribution,
    /// Half width of its distribution, where that is stated.
    pub bound: Option<f64>,
    /// Its standard uncertainty.
    pub std: f64,
    /// Unit of both: `um`, `urad`, `K`, `1`.
    pub unit: &'static str,
    /// By how much the result changes with it, units of the result to its own. Of what changes from reading to reading or with
    /// the coordinate it is the largest, or the root of the sum of squares: the factor that makes the contribution of `std`.
    pub sensitivity: f64,
    /// The product of both.
    pub contribution: Contribution,
}

/// All rows of a budget.
#[derive(Clone, Debug, PartialEq)]
pub struct Detail {
    /// The rows, those of one source together.
    pub inputs: Vec<Input>,
    /// What linearisation adds to the result on drawn machines.
    pub(super) drawn: Vec<f64>,
}

impl Detail {
    /// The parts in the unit of the result.
    pub(super) fn new(setup: &Setup, parts: &[Part], degrees_of_freedom: u32, drawn: Vec<f64>, unit: Unit) -> Self {
        let input = |part: &Part| {
            let (own, suffix) = of_unit(setup, part.of, unit);
            let (std, contribution) = (own(part.std), unit.from_inner(part.contribution));
            let distribution = match part.of {
                Of::Scatter => Distribution::Student,
                Of::Constant => Distribution::Waves,
                Of::Table(_) => Distribution::Normal,
                Of::Dropped => Distribution::Drawn,
                _ => Distribution::Rectangular,
            };
            let degrees_of_freedom = (part.of == Of::Scatter).then_some(degrees_of_freedom);
            Input {
                source: part.source,
                quantity: name(setup, part.of),
                distribution,
                bound: distribution.divisor().map(|divisor| std * divisor),
                std,
                unit: suffix,
                sensitivity: if std > 0.0 { contribution / std } else { 0.0 },
                contribution: Contribution { std: contribution, degrees_of_freedom },
            }
        };
        let shown = |part: &&Part| part.of == Of::Scatter || part.contribution > 0.0;
        let inputs = parts.iter().filter(shown).map(input).collect();
        Self { inputs, drawn: drawn.into_iter().map(|x| unit.from_inner(x)).collect() }
    }
}

type Conversion = fn(f64) -> f64;

/// From inside to the unit of a quantity, and its name.
fn of_unit(setup: &Setup, of: Of, result: Unit) -> (Conversion, &'static str) {
    const UM: (Conversion, &str) = (|mm| Unit::Um.from_inner(mm), "um");
    const URAD: (Conversion, &str) = (|rad| Unit::Urad.from_inner(rad), "urad");
    match of {
        Of::Scatter | Of::Constant | Of::BarLength | Of::Length(_) => UM,
        Of::Proportional => (|share| share, "1"),
        Of::Temperature => (|kelvin| kelvin, "K"),
        Of::Table(error) | Of::Error(error) => match setup.model.alphabet.error_quantity(error) {
            Quantity::Length => UM,
            Quantity::Angle => URAD,
        },
        Of::Dropped if result == Unit::Urad => URAD,
        Of::Dropped => UM,
    }
}

fn name(setup: &Setup, of: Of) -> String {
    let error = |error: ErrorId| setup.model.alphabet.error_name(error);
    match of {
        Of::Scatter => "a reading".to_owned(),
        Of::Constant => "error of all readings".to_owned(),
        Of::Proportional => "share of the reading".to_owned(),
        Of::BarLength => "bar length".to_owned(),
        Of::Temperature => "bar temperature".to_owned(),
        Of::Length(length) => setup.model.alphabet.nominal_name(length),
        Of::Table(of) => format!("table of {}", error(of)),
        Of::Error(of) => error(of).to_owned(),
        Of::Dropped => "products of errors".to_owned(),
    }
}
