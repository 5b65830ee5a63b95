//! Runs to choose from, with what each tells: a set of them is weighed by adding matrices.
//!
//! Each run is derived by itself, as it is on the machine with all of them. Parameters count in units of what is known of them
//! before: that of their limit, times `beyond`. A run's information is then `Σ rows rowsᵀ / σ²`, and after a set S of runs a
//! combination φ of parameters has the variance `φᵀ (1 + Σ_S)⁻¹ φ`: of what the runs determine it comes from noise, of what they
//! don't from the limits. What the instrument keeps through a run is a parameter, too; an estimate that takes it as none is less
//! certain, so this is the least that a set can reach. Directions of which all runs together say nothing are split off first.

use super::choices::Choices;
use crate::study::observation::Observation;
use crate::study::plan::{subset, uniform_std};
use crate::study::rows::each_row;
use crate::study::slow::{SLOW, slow};
use crate::study::visited::{between, visited};
use crate::study::{ErrorLimits, Instrument, Setup, SetupError};
use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};
use std::collections::BTreeMap;
use trunnion_codegen::algebra::{Poly, at};
use trunnion_codegen::identify::{Origin, name};
use trunnion_codegen::ids::{FunctionId, RunId, TermId};
use trunnion_codegen::model::Coefficient;
use typed_index_collections::TiVec;

/// Coordinates at which a function is looked at, ends included.
const STEPS: usize = 12;
/// Information below this share of what is known before is none.
const NOTHING: f64 = 1e-6;

/// How the runs would be measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Lengths of the set-up that differ from the model's usual ones, mm.
    pub lengths: Vec<(String, f64)>,
    /// Samples of each run.
    pub samples: usize,
    /// The sweeps, rad: runs go as far as the axes' ranges let them.
    pub range: (f64, f64),
    /// Standard deviation of a reading, mm.
    pub sigma: f64,
    /// Limits of the machine's errors.
    pub limits: ErrorLimits,
    /// What is known of the instrument.
    pub instrument: Instrument,
}

/// The runs to choose from, weighed.
#[derive(Clone, Debug)]
pub struct Pool {
    /// Which placing of the balls each needs.
    placings: Vec<usize>,
    information: Vec<DMatrix<f64>>,
    functions: BTreeMap<FunctionId, Vec<Target>>,
}

/// A function at a coordinate.
#[derive(Clone, Debug)]
struct Target {
    /// Variance that no run can lower.
    open: f64,
    seen: DVector<f64>,
}

/// What is known of a parameter before: the limit of its error, and the largest value of its term.
struct Before {
    column: usize,
    limit: f64,
    size: f64,
}

/// An error of the instrument that stays the same through a run, or all of them, and is a parameter like others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Instrumental {
    /// What is slow, by its functions.
    Slow(usize),
    /// The bar's length.
    Bar,
    /// Its temperature.
    Temperature,
}

/// Names of parameters, and those of the instrument, with their columns.
#[derive(Default)]
struct Parameters {
    machine: BTreeMap<String, Before>,
    instrument: BTreeMap<Instrumental, usize>,
}

impl Parameters {
    fn len(&self) -> usize {
        self.machine.len() + self.instrument.len()
    }

    fn see(&mut self, name: String, limit: f64, size: f64) {
        let column = self.len();
        let own = self.machine.entry(name).or_insert(Before { column, limit, size });
        own.size = own.size.max(size);
    }

    /// Those of the instrument of which something is stated.
    fn see_instrument(&mut self, instrument: &Instrument) {
        let slow = (0..SLOW).map(Instrumental::Slow).filter(|_| instrument.constant > 0.0);
        let bar = (instrument.bar_length > 0.0).then_some(Instrumental::Bar);
        let temperature = (instrument.temperature * instrument.expansion > 0.0).then_some(Instrumental::Temperature);
        for of in slow.chain(bar).chain(temperature) {
            let column = self.len();
            self.instrument.entry(of).or_insert(column);
        }
    }

    /// Column and standard deviation, `beyond` times that of the limit.
    fn of(&self, name: &str, beyond: f64) -> Option<(usize, f64)> {
        let own = self.machine.get(name)?;
        Some((own.column, beyond * uniform_std(own.limit) / own.size))
    }
}

/// A run with its model and where it would be measured.
struct Single {
    setup: Setup,
    run: RunId,
    sweeps: Vec<f64>,
}

impl Pool {
    /// `choices` weighed for `functions`; `beyond` 1 takes the limits as they are, more asks of the runs that they determine
    /// what is wanted by themselves.
    ///
    /// # Errors
    /// [`SetupError`]
    pub fn new(
        choices: &Choices,
        functions: &[FunctionId],
        measured: &Measured,
        beyond: f64,
    ) -> Result<Self, SetupError> {
        let lengths: Vec<(&str, f64)> = measured.lengths.iter().map(|(name, mm)| (name.as_str(), *mm)).collect();
        let single = |run: RunId| -> Result<Single, SetupError> {
            let part = subset(&choices.model, &[run]).map_err(|e| SetupError::derivation(&choices.model, &e))?;
            let (setup, run) = (Setup::new(part, &lengths)?, RunId::from(0));
            let sweeps = setup.swept(run, measured.samples, measured.range);
            Ok(Single { setup, run, sweeps })
        };
        let singles: TiVec<RunId, Single> = choices.model.runs.keys().map(single).collect::<Result<_, _>>()?;
        let mut parameters = Parameters::default();
        let mut ranges: BTreeMap<FunctionId, (f64, f64)> = BTreeMap::new();
        for single in &singles {
            single.see(&mut parameters, measured.limits);
            for &function in functions {
                let Some((low, high)) = single.visited(function) else { continue };
                let range = ranges.entry(function).or_insert((low, high));
                *range = (range.0.min(low), range.1.max(high));
            }
        }
        parameters.see_instrument(&measured.instrument);
        let nothing = || DMatrix::zeros(parameters.len(), parameters.len());
        let rows = |runs: &Vec<RunId>| {
            let own = runs.iter().map(|run| singles[*run].information(measured, &parameters, beyond));
            own.fold(nothing(), |sum, own| sum + own)
        };
        let whole: Vec<DMatrix<f64>> = choices.members.iter().map(rows).collect();
        let all = whole.iter().fold(nothing(), |sum, own| sum + own);
        let space = told(all);
        let targets = |function: FunctionId| -> Vec<Target> {
            let points = ranges.get(&function).into_iter().flat_map(|&range| between(range, STEPS));
            points.filter_map(|x| Some(singles.first()?.target(function, x, &parameters, beyond, &space))).collect()
        };
        Ok(Self {
            placings: choices.placings.clone(),
            information: whole.iter().map(|own| space.tr_mul(own) * &space).collect(),
            functions: functions.iter().map(|&f| (f, targets(f))).collect(),
        })
    }

    /// Positions of the runs.
    pub fn runs(&self) -> core::ops::Range<usize> {
        0..self.placings.len()
    }

    /// Which placing of the balls a run needs.
    pub fn placing(&self, run: usize) -> usize {
        self.placings[run]
    }

    /// Placings there are.
    pub fn placings(&self) -> usize {
        self.placings.iter().map(|at| at + 1).max().unwrap_or(0)
    }

    /// What a set of runs knows together.
    pub fn known(&self, set: impl IntoIterator<Item = usize>) -> DMatrix<f64> {
        let size = self.information.first().map_or(0, DMatrix::nrows);
        set.into_iter().fold(DMatrix::identity(size, size), |sum, i| sum + &self.information[i])
    }

    /// Adds a run to what a set knows.
    pub fn add(&self, known: &DMatrix<f64>, run: usize) -> DMatrix<f64> {
        known + &self.information[run]
    }

    /// The largest standard uncertainty of functions over their ranges, mm or rad.
    pub fn uncertainties(
        &self,
        known: &DMatrix<f64>,
        functions: impl Iterator<Item = FunctionId>,
    ) -> Option<BTreeMap<FunctionId, f64>> {
        let factor = Cholesky::new(known.clone())?;
        let lower = factor.l_dirty();
        let variance =
            |t: &Target| t.open + lower.solve_lower_triangular(&t.seen).map_or(f64::INFINITY, |y| y.norm_squared());
        let largest = |targets: &Vec<Target>| targets.iter().map(variance).fold(0.0, f64::max).sqrt();
        Some(functions.filter_map(|f| Some((f, largest(self.functions.get(&f)?)))).collect())
    }
}

impl Single {
    fn visited(&self, function: FunctionId) -> Option<(f64, f64)> {
        visited(&self.setup, function, [(self.run, &self.sweeps)])
    }

    /// The parameters that it sees, and those of functions that its axes go through.
    fn see(&self, parameters: &mut Parameters, limits: ErrorLimits) {
        let setup = &self.setup;
        for p in &setup.derivation.parameters {
            if let Origin::Constant(error) = p.origin {
                parameters.see(p.name.clone(), setup.limit(error, limits), 1.0);
            }
        }
        for (function, described) in setup.model.functions.iter_enumerated() {
            let limit = setup.limit(described.error, limits);
            let values = self.visited(function).into_iter().flat_map(|range| between(range, STEPS));
            let mut sizes: TiVec<TermId, f64> = TiVec::new();
            for values in values.map(|x| setup.basis(function, x)) {
                sizes.resize(values.len(), 0.0);
                sizes.iter_mut().zip(&values).for_each(|(size, v)| *size = size.max(v.abs()));
            }
            for (term, &size) in sizes.iter_enumerated().filter(|(_, size)| **size > 0.0) {
                let own = Origin::Coefficient(Coefficient { function, term });
                parameters.see(name(&setup.model, own), limit, size);
            }
        }
    }

    /// `Σ rows rowsᵀ / σ²`.
    fn information(&self, measured: &Measured, parameters: &Parameters, beyond: f64) -> DMatrix<f64> {
        let setup = &self.setup;
        let regressors = &setup.derivation.runs[self.run].regressors;
        let width = regressors.len() + parameters.instrument.len();
        let mut own = DMatrix::zeros(width, width);
        let (mut values, mut shape) = (DVector::zeros(width), [0.0; SLOW]);
        let (bar, instrument) = (setup.bar(self.run), &measured.instrument);
        each_row(setup, &Observation::zero(setup, self.run, &self.sweeps), |sample, row, _| {
            slow(sample.sweep, &mut shape);
            // One standard deviation of each error of the instrument.
            let instrumental = parameters.instrument.keys().map(|of| match of {
                Instrumental::Slow(k) => shape[*k] * instrument.constant,
                Instrumental::Bar => bar.map_or(0.0, |_| instrument.bar_length),
                Instrumental::Temperature => bar.unwrap_or(0.0) * instrument.expansion * instrument.temperature,
            });
            let all = row.iter().copied().chain(instrumental);
            values.iter_mut().zip(all).for_each(|(value, own)| *value = own);
            own.ger(measured.sigma.powi(-2), &values, &values, 1.0);
        });
        let definitions = setup.definitions();
        let mut across = DMatrix::zeros(width, parameters.len());
        for (at, column) in parameters.instrument.values().enumerate() {
            across[(regressors.len() + at, *column)] = 1.0;
        }
        for (at, (base, _)) in regressors.iter().enumerate() {
            for (j, factor) in &definitions[*base] {
                if let Some((column, std)) = parameters.of(&setup.derivation.parameters[*j].name, beyond) {
                    across[(at, column)] = factor * std;
                }
            }
        }
        across.tr_mul(&own) * across
    }

    fn target(
        &self,
        function: FunctionId,
        x: f64,
        parameters: &Parameters,
        beyond: f64,
        space: &DMatrix<f64>,
    ) -> Target {
        let mut whole = DVector::zeros(parameters.len());
        let mut add = |origin: Origin, factor: f64| {
            if let Some((column, std)) = parameters.of(&name(&self.setup.model, origin), beyond) {
                whole[column] += factor * std;
            }
        };
        for (term, value) in self.setup.basis(function, x).iter_enumerated() {
            let own = Origin::Coefficient(Coefficient { function, term });
            match self.setup.derivation.assumed.iter().find(|a| a.origin == own) {
                Some(assumed) => {
                    let number = |p: &Poly| at(p, &self.setup.model.alphabet, 0.0, |n| self.setup.constant(n));
                    assumed.is.iter().for_each(|(origin, factor)| add(*origin, value * number(factor)));
                }
                None => add(own, *value),
            }
        }
        let seen = space.tr_mul(&whole);
        Target { open: (&whole - space * &seen).norm_squared(), seen }
    }
}

/// The directions of which runs together tell something.
fn told(information: DMatrix<f64>) -> DMatrix<f64> {
    let eigen = SymmetricEigen::new(information);
    let kept: Vec<_> = (0..eigen.eigenvalues.len()).filter(|&i| eigen.eigenvalues[i] > NOTHING).collect();
    eigen.eigenvectors.select_columns(&kept)
}
