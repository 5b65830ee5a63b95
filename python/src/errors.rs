//! What the library refuses, as exceptions that keep file and line.

use pyo3::prelude::*;
use std::fmt::Display;
use trunnion::data::{FileError, ObservationsError, SourceError};
use trunnion::exechon::{MachineFileError, PointError};
use trunnion::study::{EstimateError, FactorError, Failed, SetupError};
use trunnion_codegen::model::{Model, Problem};
use trunnion_codegen::problems::{Colour, Described};

/// A class of `trunnion._errors`.
#[derive(Clone, Copy)]
pub enum Class {
    /// A description that makes no model.
    Model,
    /// Arrays or files that are no measurement.
    Data,
    /// Data that give no estimate.
    Estimate,
    /// A factor that cannot be read or merged.
    Factor,
    /// A place where the parallel machine cannot be.
    Pose,
}

impl Class {
    fn name(self) -> &'static str {
        match self {
            Self::Model => "ModelError",
            Self::Data => "DataError",
            Self::Estimate => "EstimateError",
            Self::Factor => "FactorError",
            Self::Pose => "PoseError",
        }
    }

    /// With where it is wrong: file, line of it, sample or row counted from 0.
    pub fn placed(self, message: impl Display, file: Option<String>, line: Option<u64>, row: Option<usize>) -> PyErr {
        Python::attach(|py| {
            let made = py.import("trunnion._errors").and_then(|errors| errors.getattr(self.name()));
            match made.and_then(|class| class.call1((message.to_string(), file, line, row))) {
                Ok(error) => PyErr::from_value(error),
                Err(error) => error,
            }
        })
    }

    /// Of no place.
    pub fn error(self, message: impl Display) -> PyErr {
        self.placed(message, None, None, None)
    }
}

/// Problems of a description, the first one's place.
pub fn problems(described: &Described, problems: &[Problem]) -> PyErr {
    let first = problems.iter().min_by_key(|problem| problem.span.start);
    let place = first.map(|problem| described.place(problem));
    let (file, line) = place.map(|(file, line, _)| (file.to_owned(), line as u64)).unzip();
    Class::Model.placed(described.render(problems, Colour::Off).trim_end(), file, line, None)
}

pub fn setup(described: &Described, error: SetupError) -> PyErr {
    match error {
        SetupError::Description(found) => problems(described, &found),
        SetupError::NoValue(name) => {
            Class::Model.error(format!("the constant {name} has no value\n  expected its length in mm, {name}=150.0"))
        }
        other => Class::Model.error(other),
    }
}

pub fn estimate(error: &EstimateError) -> PyErr {
    Class::Estimate.error(error)
}

pub fn unknown_run(model: &Model, name: &str) -> PyErr {
    let runs: Vec<&str> = model.runs.iter().map(|run| run.name.as_str()).collect();
    Class::Data.error(format!("the model has no run `{name}`\n  expected {}", runs.join(", ")))
}

pub fn source(error: &SourceError) -> PyErr {
    let (file, line) = error.place();
    let line = line.and_then(|line| line.try_into().ok());
    Class::Model.placed(error, file.map(|file| file.display().to_string()), line, None)
}

pub fn file(error: &FileError) -> PyErr {
    Class::Data.placed(error, Some(error.file.display().to_string()), error.line(), None)
}

pub fn observations(error: &ObservationsError) -> PyErr {
    match error {
        ObservationsError::File(error) => file(error),
        ObservationsError::RunMissing(run) => Class::Data.error(format!(
            "run `{run}` is not given\n  expected all runs of the model; Setup.subset makes a set-up of fewer"
        )),
        other => Class::Data.error(other),
    }
}

pub fn factor(error: &FactorError) -> PyErr {
    match error {
        FactorError::Estimate(error) => estimate(error),
        other => Class::Factor.error(other),
    }
}

pub fn pose(error: &PointError, row: usize) -> PyErr {
    let message = format!("row {row}: {error}\n  {}", error.remedy());
    Class::Pose.placed(message, None, None, Some(row))
}

pub fn machine(name: &str, error: &MachineFileError) -> PyErr {
    Class::Model.placed(format!("{name}: {error}"), Some(name.to_owned()), error.line(), None)
}

/// Arrays are always there.
pub fn of_arrays<Why>(failed: Failed<core::convert::Infallible, Why>) -> Why {
    match failed {
        Failed::Estimate(why) => why,
        Failed::Recording(never) => match never {},
    }
}
