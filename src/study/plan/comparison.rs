//! Intended runs compared: bars, ranges, and runs left out.

use super::prediction::{Intended, Prediction, predict};
use super::subset::subset;
use crate::study::{EstimateError, Estimator, Setup, SetupError, bars};
use core::fmt;
use trunnion_codegen::ids::RunId;
use trunnion_codegen::model::Model;
use trunnion_codegen::quantity::Unit;

/// What is compared: every combination of bar, runs left out, and range.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Lengths of the bar, mm. Where no run has one the first stands for all.
    pub radii: Vec<f64>,
    /// The other lengths of the set-up, mm.
    pub lengths: Vec<(String, f64)>,
    /// Ranges of the sweeps, degrees.
    pub ranges_deg: Vec<(f64, f64)>,
    /// Names of the runs that are left out together.
    pub without: Vec<Vec<String>>,
    /// Samples of each run.
    pub samples: usize,
    /// Standard deviation of a reading, mm.
    pub sigma: f64,
    /// How the runs are combined.
    pub estimator: Estimator,
}

/// One combination.
#[derive(Clone, Debug)]
pub struct Compared {
    /// Length of the bar, mm; none where no run has one.
    pub radius: Option<f64>,
    /// Range of the sweeps, degrees.
    pub range_deg: (f64, f64),
    /// The runs left out.
    pub without: Vec<String>,
    /// What the others would give, or why nothing.
    pub outcome: Result<(Setup, Prediction), Refusal>,
}

/// Why a combination gives nothing.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refusal {
    /// All runs are left out.
    NoRun,
    /// The runs left have no measurement model.
    Setup(SetupError),
    /// Such samples give no estimate.
    Estimate(EstimateError),
}

/// In one line.
impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoRun => f.write_str("no run is left"),
            Self::Setup(error) => error.fmt(f),
            Self::Estimate(EstimateError::Confounded { coefficients, .. }) => {
                write!(f, "cannot tell {} apart", coefficients.join(", "))
            }
            Self::Estimate(error) => f.write_str(&error.to_string().replace("\n ", ";")),
        }
    }
}

impl core::error::Error for Refusal {}

/// Predicts every combination.
///
/// # Errors
/// [`SetupError`] for lengths that the model does not have or lacks.
pub fn compare(model: &Model, comparison: &Comparison) -> Result<Vec<Compared>, SetupError> {
    let bars = bars(model);
    let radii = if bars.is_empty() { comparison.radii.get(..1).unwrap_or_default() } else { &comparison.radii };
    let mut compared = Vec::new();
    for &radius in radii {
        let bar = bars.iter().map(|name| (name.as_str(), radius));
        let values: Vec<(&str, f64)> =
            comparison.lengths.iter().map(|(name, mm)| (name.as_str(), *mm)).chain(bar).collect();
        for without in &comparison.without {
            let setup = without_runs(model, without, &values)?;
            for &range_deg in &comparison.ranges_deg {
                let outcome = setup.clone().and_then(|setup| {
                    let range = (Unit::Deg.to_inner(range_deg.0), Unit::Deg.to_inner(range_deg.1));
                    let intended = Intended { samples: comparison.samples, range, sigma: comparison.sigma };
                    let prediction = predict(&setup, intended, comparison.estimator).map_err(Refusal::Estimate)?;
                    Ok((setup, prediction))
                });
                let radius = (!bars.is_empty()).then_some(radius);
                compared.push(Compared { radius, range_deg, without: without.clone(), outcome });
            }
        }
    }
    Ok(compared)
}

/// The model with some of its runs; why not, if these have no measurement model.
fn without_runs(
    model: &Model,
    without: &[String],
    values: &[(&str, f64)],
) -> Result<Result<Setup, Refusal>, SetupError> {
    let kept: Vec<RunId> =
        model.runs.iter_enumerated().filter(|(_, run)| !without.contains(&run.name)).map(|(id, _)| id).collect();
    if kept.is_empty() {
        return Ok(Err(Refusal::NoRun));
    }
    match subset(model, &kept) {
        Ok(part) => Setup::new(part, values).map(Ok),
        Err(error) => Ok(Err(Refusal::Setup(SetupError::derivation(model, &error)))),
    }
}
