//! A model with numbers for its constants, ready to evaluate.

use super::limits::ErrorLimits;
use core::fmt;
use std::collections::BTreeSet;
use trunnion_codegen::algebra::{ErrorId, Fraction, Nominal, NominalId, Poly, at, nominal_value};
use trunnion_codegen::catalogue;
use trunnion_codegen::emit;
use trunnion_codegen::emit::model::motion;
use trunnion_codegen::graph::{BlockEvaluator, Evaluator, Tape, Unbound};
use trunnion_codegen::identify::{BaseParameter, Coefficient, Derivation, DeriveError, Origin, derive};
use trunnion_codegen::ids::{BaseId, FunctionId, ParameterId, RunId, TermId};
use trunnion_codegen::model::{self, Axis, AxisKind, Model, Problem, ReadingKind};
use trunnion_codegen::problems::of_derivation;
use trunnion_codegen::quantity::Quantity;
use typed_index_collections::TiVec;

/// A model, its derivation, and the lengths of the set-up in mm.
#[derive(Clone, Debug)]
pub struct Setup {
    /// The description.
    pub model: Model,
    /// What follows from it.
    pub derivation: Derivation,
    /// Values of the constants, in the order of the alphabet, mm.
    constants: Vec<f64>,
    runs: TiVec<RunId, Tape>,
    /// What each run's row takes behind the sweep.
    motion: TiVec<RunId, Vec<NominalId>>,
}

/// Why a model cannot be put to work.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SetupError {
    /// No such model in the catalogue.
    NotInCatalogue(String),
    /// What is wrong with the description, or keeps its runs from having a measurement model.
    Description(Vec<Problem>),
    /// A constant has no value.
    NoValue(String),
    /// A value is not a positive finite length: name, mm.
    NotALength(String, f64),
    /// A value for a constant that the model does not have.
    NotAConstant {
        /// The name given.
        name: String,
        /// The constants of the model.
        constants: Vec<String>,
    },
    /// A generated row depends on something that is neither constant nor sweep: a defect of the derivation.
    Unbound(Unbound),
}

impl fmt::Display for SetupError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotInCatalogue(name) => {
                let names: Vec<&str> = catalogue::MODELS.iter().map(|(name, _)| *name).collect();
                write!(f, "no model `{name}` in the catalogue\n  expected one of {}", names.join(", "))
            }
            Self::Description(problems) => {
                for (at, problem) in problems.iter().enumerate() {
                    let between = if at > 0 { "\n" } else { "" };
                    write!(f, "{between}{}", problem.kind)?;
                    if let Some(help) = problem.kind.help() {
                        write!(f, "\n  {help}")?;
                    }
                }
                Ok(())
            }
            Self::NoValue(name) => write!(f, "the constant {name} has no value\n  expected its length in mm"),
            Self::NotALength(name, value) => {
                write!(f, "{name} = {value} mm is not a length\n  expected a positive number of mm")
            }
            Self::NotAConstant { name, constants } => {
                write!(f, "the model has no constant `{name}`\n  expected {}", constants.join(", "))
            }
            Self::Unbound(e) => write!(f, "the derived row is wrong: {e}"),
        }
    }
}

impl core::error::Error for SetupError {}

impl SetupError {
    /// A failed derivation of a model.
    pub fn derivation(model: &Model, error: &DeriveError) -> Self {
        Self::Description(of_derivation(model, error))
    }
}

impl From<Unbound> for SetupError {
    fn from(e: Unbound) -> Self {
        Self::Unbound(e)
    }
}

impl Setup {
    /// Derives `model` and gives its constants their values, mm; those of which none is given take the model's usual one.
    ///
    /// # Errors
    /// [`SetupError`]
    pub fn new(model: Model, values: &[(&str, f64)]) -> Result<Self, SetupError> {
        let derivation = derive(&model).map_err(|e| SetupError::derivation(&model, &e))?;
        if let Some((name, _)) = values.iter().find(|(name, _)| model.alphabet.find_constant(name).is_none()) {
            let constants = model.alphabet.constants().map(str::to_owned).collect();
            return Err(SetupError::NotAConstant { name: (*name).to_owned(), constants });
        }
        let usual = |name: &str| {
            let id = model.alphabet.find_constant(name);
            model.lengths.iter().find(|(of, _)| Some(*of) == id).map(|(_, mm)| *mm)
        };
        let given = |name: &str| values.iter().find(|(n, _)| *n == name).map(|(_, mm)| *mm);
        let value = |name: &str| match given(name).or_else(|| usual(name)) {
            None => Err(SetupError::NoValue(name.to_owned())),
            Some(v) if v.is_finite() && v > 0.0 => Ok(v),
            Some(v) => Err(SetupError::NotALength(name.to_owned(), v)),
        };
        let constants = model.alphabet.constants().map(value).collect::<Result<Vec<_>, _>>()?;
        let tape = |run| Ok(Tape::new(emit::model::run(&model, &derivation, run)?.program()));
        let runs = model.runs.keys().map(tape).collect::<Result<TiVec<_, _>, Unbound>>()?;
        let motion = model.runs.keys().map(|run| motion(&model, run)).collect();
        Ok(Self { model, derivation, constants, runs, motion })
    }

    /// A model of the catalogue with values for its constants, mm.
    ///
    /// # Errors
    /// [`SetupError`]
    pub fn from_catalogue(name: &str, values: &[(&str, f64)]) -> Result<Self, SetupError> {
        let model = catalogue::model(name).ok_or_else(|| SetupError::NotInCatalogue(name.to_owned()))?;
        Self::new(model.map_err(SetupError::Description)?, values)
    }

    /// A model file's text with values for its constants, mm.
    ///
    /// # Errors
    /// [`SetupError`]
    pub fn from_description(text: &str, values: &[(&str, f64)]) -> Result<Self, SetupError> {
        Self::new(model::read(text).map_err(SetupError::Description)?, values)
    }

    /// Value of a constant, mm.
    pub fn constant(&self, name: &str) -> f64 {
        self.model.alphabet.constants().zip(&self.constants).find(|(n, _)| *n == name).map_or(f64::NAN, |(_, v)| *v)
    }

    /// The run with a name.
    pub fn run(&self, name: &str) -> Option<RunId> {
        self.model.runs.position(|r| r.name == name)
    }

    /// Nominal length of the bar that a run reads, mm; none of a run that reads displacements.
    pub fn bar(&self, run: RunId) -> Option<f64> {
        bar(&self.model, &self.model.runs[run].reading).map(|name| self.constant(&name))
    }

    /// Nominal length of the first bar that a run reads, mm; none where all read displacements.
    pub fn radius(&self) -> Option<f64> {
        self.model.runs.keys().find_map(|run| self.bar(run))
    }

    /// Evaluates a run's row.
    pub fn row(&self, run: RunId) -> RunRow<'_> {
        RunRow {
            setup: self,
            run,
            evaluator: self.runs[run].evaluator(),
            inputs: self.inputs(run),
            outputs: vec![0.0; self.runs[run].outputs()],
            split: self.derivation.runs[run].regressors.len(),
        }
    }

    /// Evaluates a run's rows by blocks.
    pub(super) fn block_evaluator(&self, run: RunId) -> BlockEvaluator<'_> {
        self.runs[run].block_evaluator()
    }

    /// How many of a row's inputs are lengths; the sweep and how things move there come behind them.
    pub(super) fn lengths(&self) -> usize {
        self.constants.len()
    }

    /// What a run's row takes: the lengths, and room for the sweep and how things move there.
    pub(super) fn inputs(&self, run: RunId) -> Vec<f64> {
        let mut inputs = self.constants.clone();
        inputs.resize(self.constants.len() + 1 + self.motion[run].len(), 0.0);
        inputs
    }

    /// Writes the sweep, and how things move there, to the end of a run's inputs.
    pub(super) fn place(&self, run: RunId, inputs: &mut [f64], sweep: f64, direction: f64) {
        let length = |name: &str| self.constant(name);
        let value = |&id: &NominalId| {
            let value = nominal_value(id, &self.model.alphabet, sweep, &length);
            if matches!(self.model.alphabet.nominal(id), Nominal::Sense { .. }) { direction * value } else { value }
        };
        let values = [sweep].into_iter().chain(self.motion[run].iter().map(value));
        inputs.iter_mut().skip(self.constants.len()).zip(values).for_each(|(input, value)| *input = value);
    }

    /// The estimated functions.
    pub fn estimated(&self) -> impl Iterator<Item = FunctionId> {
        self.model.functions.iter_enumerated().filter(|(_, f)| f.estimate).map(|(i, _)| i)
    }

    /// The known functions that runs see, ascending.
    pub fn known(&self, runs: impl Iterator<Item = RunId>) -> Vec<FunctionId> {
        let mut known: Vec<FunctionId> =
            runs.flat_map(|run| self.derivation.runs[run].known.iter().map(|(f, _)| *f)).collect();
        known.sort_unstable();
        known.dedup();
        known
    }

    /// The functions of a basis at a coordinate, mm or rad.
    pub fn basis(&self, function: FunctionId, x: f64) -> TiVec<TermId, f64> {
        self.model.functions[function].basis.values(x, &self.model.alphabet, &|n| self.constant(n))
    }

    /// The parameter that is a coefficient of a function, if a run sees it.
    pub fn coefficient(&self, function: FunctionId, term: TermId) -> Option<ParameterId> {
        let own = Origin::Coefficient(Coefficient { function, term });
        self.derivation.parameters.position(|p| p.origin == own)
    }

    /// A quotient of constants as a number.
    pub fn number(&self, f: &Fraction) -> f64 {
        let number = |p: &Poly| at(p, &self.model.alphabet, 0.0, |n| self.constant(n));
        number(f.numerator()) / f.denominator().map_or(1.0, number)
    }

    /// Definitions of the base parameters with the constants' values put in: parameter and factor.
    pub fn definitions(&self) -> TiVec<BaseId, Vec<(ParameterId, f64)>> {
        let definition = |b: &BaseParameter| b.definition.iter().map(|(j, f)| (*j, self.number(f))).collect();
        self.derivation.base.iter().map(definition).collect()
    }

    /// The largest size of an error, mm or rad: its own of the model, or that of its kind.
    pub fn limit(&self, error: ErrorId, limits: ErrorLimits) -> f64 {
        limits.of_error(&self.model, error)
    }

    /// The same with another value for one of its constants, mm.
    pub(super) fn with_constant(&self, constant: NominalId, mm: f64) -> Self {
        let name = self.model.alphabet.nominal_name(constant);
        let mut changed = self.clone();
        let names: Vec<String> = self.model.alphabet.constants().map(str::to_owned).collect();
        let own = changed.constants.iter_mut().zip(names).filter(|(_, n)| *n == name);
        own.for_each(|(value, _)| *value = mm);
        changed
    }

    /// Name of a function in reports: `eps_xa`.
    pub fn function_name(&self, function: FunctionId) -> String {
        self.model.notation.function(self.model.alphabet.error_name(self.model.functions[function].error))
    }

    /// What a function measures.
    pub fn quantity(&self, function: FunctionId) -> Quantity {
        self.model.alphabet.error_quantity(self.model.functions[function].error)
    }

    /// The axis whose coordinate a function depends on.
    pub fn axis(&self, function: FunctionId) -> Option<&Axis> {
        self.model.axis_of_function(function).map(|(_, axis)| axis)
    }
}

/// The constants that are lengths of bars.
pub fn bars(model: &Model) -> Vec<String> {
    let mut bars: Vec<String> = model.runs.iter().filter_map(|run| bar(model, &run.reading)).collect();
    let mut seen = BTreeSet::new();
    bars.retain(|bar| seen.insert(bar.clone()));
    bars
}

fn bar(model: &Model, reading: &ReadingKind) -> Option<String> {
    match reading {
        ReadingKind::BarLength(id) => Some(model.alphabet.nominal_name(*id)),
        ReadingKind::Displacement(_) => None,
    }
}

/// What an axis' coordinate measures.
pub fn coordinate(axis: &Axis) -> Quantity {
    match axis.kind {
        AxisKind::Rotary => Quantity::Angle,
        AxisKind::Linear => Quantity::Length,
    }
}

/// A run's row at a value of its sweep.
#[derive(Debug)]
pub struct RunRow<'a> {
    setup: &'a Setup,
    run: RunId,
    evaluator: Evaluator<'a>,
    inputs: Vec<f64>,
    outputs: Vec<f64>,
    split: usize,
}

impl RunRow<'_> {
    /// Regressors of the base parameters that the run sees, and factors of its known functions, at `sweep` (rad), reached in
    /// `direction`: 1 increasing, −1 decreasing.
    pub fn at(&mut self, sweep: f64, direction: f64) -> (&[f64], &[f64]) {
        self.setup.place(self.run, &mut self.inputs, sweep, direction);
        let evaluated = self.evaluator.evaluate(&self.inputs, &mut self.outputs);
        debug_assert_eq!(evaluated, Ok(()), "the row was made for this tape");
        self.outputs.split_at(self.split)
    }
}
