//! Where the runs of a set-up are best stopped.

use crate::arguments::{Ranges, ranged, size, within};
use crate::errors::{self, Class};
use pyo3::prelude::*;
use serde_json::Value;
use trunnion::document;
use trunnion::study::Setup;
use trunnion::study::plan::design::estimated;
use trunnion::study::plan::positions::{Asked, Count, PositionsError, propose};
use trunnion::study::plan::uniform_std;
use trunnion_codegen::ids::FunctionId;
use trunnion_codegen::quantity::Unit;

/// What is asked, as it is given in Python.
pub struct Wanted {
    pub count: Option<usize>,
    pub in_all: bool,
    pub functions: Option<Vec<String>>,
    pub within: Option<Vec<f64>>,
    pub step_deg: f64,
    pub noise_um: f64,
    pub ranges: Option<Ranges>,
}

impl Wanted {
    fn count(&self, setup: &Setup, functions: &[FunctionId]) -> PyResult<Count> {
        let refused = |told: &str| Err(Class::Data.error(told));
        match (self.count, &self.within) {
            (Some(count), None) if self.in_all => Ok(Count::InAll(count)),
            (Some(count), None) => Ok(Count::Each(count)),
            (None, Some(_)) if self.in_all => refused("in_all: of no use with within, which counts all runs together"),
            (None, Some(numbers)) => {
                numbers.iter().try_for_each(|own| within("within", *own, 1e-9..=1e6).map(drop))?;
                Count::fewest(setup, functions, numbers).ok_or_else(|| {
                    let (given, wanted) = (numbers.len(), functions.len());
                    let told =
                        format!("within: {given} numbers for {wanted} functions\n  expected one, or one for each");
                    Class::Data.error(told)
                })
            }
            _ => refused("positions: no count, or two\n  expected how many, or within"),
        }
    }

    /// What is proposed, as `trunnion plan --positions --json` prints it.
    pub fn propose(&self, py: Python<'_>, setup: &Setup) -> PyResult<Value> {
        let mut reaching = setup.clone();
        reaching.model = ranged(&setup.model, self.ranges.clone())?.into_owned();
        let setup = &reaching;
        let functions = match &self.functions {
            None => setup.estimated().collect(),
            Some(names) => {
                let named = names.iter().map(|name| estimated(&setup.model, name));
                named.collect::<Result<Vec<FunctionId>, _>>().map_err(|e| Class::Data.error(e))?
            }
        };
        let asked = Asked {
            count: self.count(setup, &functions)?,
            functions,
            step_deg: within("step_deg", self.step_deg, 0.1..=90.0)?,
            sigma: uniform_std(size("noise_um", self.noise_um)? * Unit::Um.factor()),
        };
        let found = py.detach(|| propose(setup, &asked)).map_err(|refused| match refused {
            PositionsError::Estimate(e) => errors::estimate(&e),
            other => Class::Data.error(other),
        })?;
        Ok(document::positions(setup, &asked, &found))
    }
}
