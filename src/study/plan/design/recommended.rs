//! Of given runs, the fewest that do nearly as well as all of them.

use super::choices::Choices;
use super::pool::{Measured, Pool};
use super::proposal::{COVERAGE_FACTOR, NEAR, UNKNOWN};
use super::search::{Next, Within, fewest};
use crate::study::SetupError;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::model::{Draft, Model};

/// The fewest runs for one function; expanded uncertainties of 95 % from noise, mm or rad.
#[derive(Clone, Debug, PartialEq)]
pub struct Recommended {
    /// The function.
    pub function: FunctionId,
    /// What all runs together give.
    pub best: f64,
    /// Names of the fewest that give no more than a tenth over that.
    pub runs: Vec<String>,
    /// What these give.
    pub u95: f64,
}

/// For each estimated function that the model's runs determine, the fewest of them.
///
/// # Errors
/// [`SetupError`]
pub fn recommended(draft: &Draft, model: &Model, measured: &Measured) -> Result<Vec<Recommended>, SetupError> {
    let functions: Vec<FunctionId> =
        model.functions.iter_enumerated().filter(|(_, f)| f.estimate).map(|(f, _)| f).collect();
    let choices = Choices::own(draft)?;
    let pool = Pool::new(&choices, &functions, measured, UNKNOWN)?;
    let known = pool.known(pool.runs());
    let mut recommended = Vec::new();
    for function in functions {
        let best = pool.uncertainties(&known, [function].into_iter()).and_then(|all| all.get(&function).copied());
        let limit = measured.limits.of_error(model, model.functions[function].error);
        // Of what they do not determine the limits are all that is known.
        let Some(best) = best.filter(|best| *best < limit) else { continue };
        let within = Within::from([(function, NEAR * best)]);
        fewest(&pool, &within, &|_| {}, &mut |set| {
            recommended.push(Recommended {
                function,
                best: COVERAGE_FACTOR * best,
                runs: set.runs.iter().map(|&i| choices.runs[i].name.value.clone()).collect(),
                u95: COVERAGE_FACTOR * set.share * NEAR * best,
            });
            Next::Enough
        });
    }
    Ok(recommended)
}
