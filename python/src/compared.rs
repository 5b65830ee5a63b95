//! Bars, ranges and runs left out, compared before anything is measured.

use crate::arguments::{range, size, within};
use crate::errors::{self, Class};
use pyo3::prelude::*;
use serde_json::Value;
use std::collections::BTreeMap;
use trunnion::data::Radius;
use trunnion::document;
use trunnion::study::plan::{Comparison, Overview, RADII, RANGES_DEG, uniform_std};
use trunnion::study::{ErrorLimits, Estimator, bars, write_ranges};
use trunnion_codegen::model::Model;
use trunnion_codegen::problems::Described;
use trunnion_codegen::quantity::Unit;

/// What is compared, as it is given in Python.
pub struct Compared {
    pub radius: Option<Vec<f64>>,
    pub lengths: BTreeMap<String, f64>,
    pub range_deg: Option<Vec<(f64, f64)>>,
    pub without: Option<Vec<Vec<String>>>,
    pub samples: usize,
    pub noise_um: f64,
    pub estimator: Estimator,
    pub limits: ErrorLimits,
}

impl Compared {
    /// All that is said of it, as `trunnion plan --json` prints it.
    pub fn overview(self, py: Python<'_>, described: &Described, model: &Model) -> PyResult<Value> {
        let some = |what: &str| Class::Data.error(format!("{what}: empty\n  expected at least one"));
        let checked = |mm: f64| Radius::new(mm).map(Radius::mm).map_err(|e| Class::Data.error(e));
        let given =
            self.radius.map(|radii| radii.into_iter().map(checked).collect::<PyResult<Vec<f64>>>()).transpose()?;
        let first = given.as_ref().map(|radii| radii.first().copied().ok_or_else(|| some("radius"))).transpose()?;
        let ranges = self.range_deg.map(|all| all.into_iter().map(range).collect::<PyResult<Vec<_>>>()).transpose()?;
        let ranges_deg = ranges.unwrap_or_else(|| RANGES_DEG.to_vec());
        if ranges_deg.is_empty() {
            return Err(some("range_deg"));
        }
        let bars = bars(model);
        let lengths: Vec<(String, f64)> = self.lengths.into_iter().collect();
        if let Some((bar, _)) = lengths.iter().find(|(name, _)| bars.contains(name)) {
            let told = format!("lengths: {bar} is the length of the bar\n  expected it as radius alone");
            return Err(Class::Data.error(told));
        }
        let known = |name: &String| model.runs.iter().any(|run| run.name == *name);
        if let Some(name) = self.without.iter().flatten().flatten().find(|name| !known(name)) {
            return Err(errors::unknown_run(model, name));
        }
        let left_out = self.without.map(|all| std::iter::once(Vec::new()).chain(all).collect());
        let comparison = Comparison {
            radii: given.unwrap_or_else(|| RADII.to_vec()),
            lengths: lengths.clone(),
            ranges_deg,
            without: left_out.unwrap_or_else(|| Comparison::each_run(model)),
            samples: within("samples", self.samples, 2..=100_000)?,
            sigma: uniform_std(size("noise_um", self.noise_um)? * Unit::Um.factor()),
            estimator: self.estimator,
        };
        let bar = first.into_iter().flat_map(|radius| bars.iter().map(move |name| (name.clone(), radius)));
        let measured = comparison.first(lengths.into_iter().chain(bar).collect(), self.limits);
        let mut draft = described.draft().unwrap_or_default();
        write_ranges(model, &mut draft);
        let found = py.detach(|| {
            let found = Overview::new(&draft, model, &comparison, &measured)?;
            Ok(document::overview(&found, self.noise_um))
        });
        found.map_err(|e| errors::setup(described, e))
    }
}
