//! All that is said of a model's runs before anything is measured: what they would give with one bar or another, over one range or
//! another, and without some; which are enough; what they confound, and which runs of the catalogue would help.

use super::added::{Addition, additions};
use super::comparison::{Compared, Comparison, compare};
use super::design::{Measured, Recommended, recommended};
use crate::study::{ErrorLimits, Instrument, SetupError};
use trunnion_codegen::catalogue;
use trunnion_codegen::emit::equations;
use trunnion_codegen::identify::Derivation;
use trunnion_codegen::model::{Draft, Model};
use trunnion_codegen::problems::derivation;
use trunnion_codegen::quantity::Unit;

/// Lengths of the bar that are compared where none is given, mm.
pub const RADII: [f64; 3] = [100.0, 150.0, 300.0];
/// Ranges of the sweeps that are compared where none is given, degrees.
pub const RANGES_DEG: [(f64, f64); 3] = [(0.0, 360.0), (-20.0, 200.0), (-90.0, 90.0)];

/// All there is to say.
#[derive(Clone, Debug)]
pub struct Overview<'a> {
    /// The model.
    pub model: &'a Model,
    /// What follows from it.
    pub derivation: Derivation,
    /// What was compared.
    pub comparison: &'a Comparison,
    /// Every combination of it.
    pub compared: Vec<Compared>,
    /// The confounded groups in words.
    pub described: Vec<String>,
    /// The fewest runs for each function, with the first of what is compared.
    pub recommended: Vec<Recommended>,
    /// How many runs of the catalogue fit the machine.
    pub tried: usize,
    /// Those of them that tell something new.
    pub added: Vec<Addition>,
}

impl<'a> Overview<'a> {
    /// Of a model; `draft` is its own, `measured` how the recommended runs would be measured.
    ///
    /// # Errors
    /// [`SetupError`]
    pub fn new(
        draft: &Draft,
        model: &'a Model,
        comparison: &'a Comparison,
        measured: &Measured,
    ) -> Result<Self, SetupError> {
        let derivation = derivation(model).map_err(SetupError::Description)?;
        let compared = compare(model, comparison)?;
        let (tried, added) = additions(draft, model, &derivation, catalogue::MODELS);
        let described = derivation.groups().iter().map(|g| equations::group(model, &derivation, g)).collect();
        let recommended = recommended(draft, model, measured)?;
        Ok(Self { model, derivation, comparison, compared, described, recommended, tried, added })
    }
}

impl Comparison {
    /// The runs of a model left out, each in turn, after none of them.
    pub fn each_run(model: &Model) -> Vec<Vec<String>> {
        let one = model.runs.iter().map(|run| vec![run.name.clone()]).filter(|_| model.runs.len() > 1);
        std::iter::once(Vec::new()).chain(one).collect()
    }

    /// How the first of what is compared is measured, for a recommendation by noise alone; `lengths` are all of the set-up's.
    pub fn first(&self, lengths: Vec<(String, f64)>, limits: ErrorLimits) -> Measured {
        let (from, to) = self.ranges_deg.first().copied().unwrap_or(RANGES_DEG[0]);
        Measured {
            lengths,
            samples: self.samples,
            range: (Unit::Deg.to_inner(from), Unit::Deg.to_inner(to)),
            sigma: self.sigma,
            limits,
            // Of given runs the comparison is one of noise.
            instrument: Instrument::default(),
        }
    }
}
