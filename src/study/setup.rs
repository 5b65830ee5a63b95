//! A model with numbers for its constants, ready to evaluate.

use trunnion_codegen::algebra::{Fraction, Poly, at};
use trunnion_codegen::emit;
use trunnion_codegen::graph::{Evaluator, Tape, Unbound};
use trunnion_codegen::identify::{BaseParameter, Coefficient, Derivation, DeriveError, derive};
use trunnion_codegen::ids::{BaseId, FunctionId, ParameterId, RunId, TermId};
use trunnion_codegen::model::{Component, Model};
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
}

/// Why a model cannot be put to work.
#[derive(Clone, Debug, PartialEq)]
pub enum SetupError {
    /// It has no measurement model.
    Derive(DeriveError),
    /// A constant has no value.
    NoValue(String),
    /// A value is not a positive finite length: name, mm.
    NotALength(String, f64),
    /// A value for a constant that the model does not have.
    NotAConstant(String),
    /// A generated row depends on something that is neither constant nor sweep: a defect of the derivation.
    Unbound(Unbound),
}

impl From<Unbound> for SetupError {
    fn from(e: Unbound) -> Self {
        Self::Unbound(e)
    }
}

impl Setup {
    /// Derives `model` and gives its constants their values, mm.
    ///
    /// # Errors
    /// [`SetupError`]
    pub fn new(model: Model, values: &[(&str, f64)]) -> Result<Self, SetupError> {
        let derivation = derive(&model).map_err(SetupError::Derive)?;
        if let Some((name, _)) = values.iter().find(|(name, _)| model.alphabet.find_constant(name).is_none()) {
            return Err(SetupError::NotAConstant((*name).to_owned()));
        }
        let value = |name: &str| match values.iter().find(|(n, _)| *n == name) {
            None => Err(SetupError::NoValue(name.to_owned())),
            Some((_, v)) if v.is_finite() && *v > 0.0 => Ok(*v),
            Some((_, v)) => Err(SetupError::NotALength(name.to_owned(), *v)),
        };
        let constants = model.alphabet.constants().map(value).collect::<Result<Vec<_>, _>>()?;
        let tape = |run| Ok(Tape::new(emit::model::run(&model, &derivation, run)?.program()));
        let runs = model.runs.keys().map(tape).collect::<Result<TiVec<_, _>, Unbound>>()?;
        Ok(Self { model, derivation, constants, runs })
    }

    /// Value of a constant, mm.
    pub fn constant(&self, name: &str) -> f64 {
        self.model.alphabet.constants().zip(&self.constants).find(|(n, _)| *n == name).map_or(f64::NAN, |(_, v)| *v)
    }

    /// The run with a name.
    pub fn run(&self, name: &str) -> Option<RunId> {
        self.model.runs.position(|r| r.name == name)
    }

    /// Evaluates a run's row.
    pub fn row(&self, run: RunId) -> Row<'_> {
        let inputs = self.constants.iter().copied().chain([0.0]).collect();
        Row {
            evaluator: self.runs[run].evaluator(),
            inputs,
            outputs: vec![0.0; self.runs[run].outputs()],
            split: self.derivation.runs[run].regressors.len(),
        }
    }

    /// The estimated functions.
    pub fn estimated(&self) -> impl Iterator<Item = FunctionId> {
        self.model.functions.iter_enumerated().filter(|(_, f)| f.estimate).map(|(i, _)| i)
    }

    /// A function's basis at a coordinate, each value with the base parameter whose coefficient it is.
    pub fn basis(&self, function: FunctionId, x: f64) -> Vec<(BaseId, f64)> {
        let values = self.model.functions[function].basis.values(x, &self.model.alphabet, &|n| self.constant(n));
        let carries = |term| self.derivation.base.position(|b| b.estimates == Some(Coefficient { function, term }));
        values.into_iter().enumerate().filter_map(|(k, v)| Some((carries(TermId::from(k))?, v))).collect()
    }

    /// Definitions of the base parameters with the constants' values put in: parameter and factor.
    pub fn definitions(&self) -> TiVec<BaseId, Vec<(ParameterId, f64)>> {
        let number = |p: &Poly| at(p, &self.model.alphabet, 0.0, |n| self.constant(n));
        let factor = |f: &Fraction| number(f.numerator()) / f.denominator().map_or(1.0, number);
        let definition = |b: &BaseParameter| b.definition.iter().map(|(j, f)| (*j, factor(f))).collect();
        self.derivation.base.iter().map(definition).collect()
    }

    /// Name of a function in reports: `eps_xa`.
    pub fn function_name(&self, function: FunctionId) -> String {
        self.model.notation.function(self.model.alphabet.error_name(self.model.functions[function].error))
    }

    /// Which of the six components of its axis' errors a function is.
    pub fn component(&self, function: FunctionId) -> Option<Component> {
        self.model.axis_of(self.model.functions[function].error).map(|(_, c)| c)
    }
}

/// A run's row at a value of its sweep.
#[derive(Debug)]
pub struct Row<'a> {
    evaluator: Evaluator<'a>,
    inputs: Vec<f64>,
    outputs: Vec<f64>,
    split: usize,
}

impl Row<'_> {
    /// Regressors of the base parameters that the run sees, and factors of its known functions, at `sweep` (rad).
    pub fn at(&mut self, sweep: f64) -> (&[f64], &[f64]) {
        if let Some(last) = self.inputs.last_mut() {
            *last = sweep;
        }
        let evaluated = self.evaluator.evaluate(&self.inputs, &mut self.outputs);
        debug_assert_eq!(evaluated, Ok(()), "the row was made for this tape");
        self.outputs.split_at(self.split)
    }
}
