//! The runs to choose from: the model's own and those that its machine allows.

use crate::study::SetupError;
use trunnion_codegen::algebra::PolyVector;
use trunnion_codegen::basis::Coordinate;
use trunnion_codegen::identify::{DeriveError, derive};
use trunnion_codegen::ids::{AxisId, FunctionId, RunId};
use trunnion_codegen::model::{AxisKind, Draft, DraftBall, DraftReading, DraftRun, Model, ReadingKind, candidates};

/// Runs to choose from.
#[derive(Clone, Debug)]
pub struct Choices {
    /// As they would stand in a model file.
    pub runs: Vec<DraftRun>,
    /// The machine with all of them.
    pub model: Model,
    /// Those of the model that each is: displacements in all three directions are three.
    pub members: Vec<Vec<RunId>>,
    /// Which of the distinct placings of the two balls each needs.
    pub placings: Vec<usize>,
}

impl Choices {
    /// Only the model's own runs.
    ///
    /// # Errors
    /// [`SetupError`] where they make no model.
    pub fn own(draft: &Draft) -> Result<Self, SetupError> {
        Self::of(draft, draft.runs.clone())
    }

    /// The model's own runs and those that the machine allows for the axes of `functions`, each of which can be derived.
    ///
    /// # Errors
    /// [`SetupError`] where they make no model.
    pub fn all(draft: &Draft, model: &Model, functions: &[FunctionId]) -> Result<Self, SetupError> {
        let mut axes: Vec<AxisId> = Vec::new();
        for (axis, _) in functions.iter().filter_map(|f| model.axis_of_function(*f)) {
            if !axes.contains(&axis) && model.axis(axis).is_some_and(|a| a.kind == AxisKind::Rotary) {
                axes.push(axis);
            }
        }
        let refused = |e| SetupError::derivation(model, &DeriveError::Algebra(e));
        let mut runs = draft.runs.clone();
        let mut known: Vec<Measurement> = draft.runs.iter().filter_map(|run| measurement(draft, run)).collect();
        for run in candidates(model, &axes).map_err(refused)? {
            let Some(own) = measurement(draft, &run) else { continue };
            if !known.contains(&own) {
                known.push(own);
                let name = free(&run.name.value, &runs);
                runs.push(DraftRun { name: name.into(), ..run });
            }
        }
        Self::of(draft, runs)
    }

    fn of(draft: &Draft, runs: Vec<DraftRun>) -> Result<Self, SetupError> {
        let model = with_runs(draft, &runs).build().map_err(SetupError::Description)?;
        let mut next = model.runs.keys();
        let member = |run: &DraftRun| next.by_ref().take(if reads_all(run) { 3 } else { 1 }).collect();
        let members = runs.iter().map(member).collect();
        // By name: where a set-up error is written does not matter.
        let names = |ball: &DraftBall| ball.setup.iter().map(|text| text.value.clone()).collect::<Vec<String>>();
        let mut placed: Vec<[Vec<String>; 2]> = Vec::new();
        let mut placings = Vec::new();
        for run in &runs {
            let balls = [&run.workpiece_ball, &run.tool_ball].map(names);
            placings.push(placed.iter().position(|other| *other == balls).unwrap_or_else(|| {
                placed.push(balls);
                placed.len() - 1
            }));
        }
        Ok(Self { model, members, placings, runs })
    }
}

/// The machine with these runs and no others.
#[must_use]
pub fn with_runs(draft: &Draft, runs: &[DraftRun]) -> Draft {
    // What the order names these runs may not see.
    Draft { runs: runs.to_vec(), order: Vec::new(), ..draft.clone() }
}

fn free(name: &str, runs: &[DraftRun]) -> String {
    let taken = |name: &String| runs.iter().any(|run| run.name.value == *name);
    let names = std::iter::once(name.to_owned()).chain((2..).map(|n| format!("{name}-{n}")));
    names.into_iter().find(|name| !taken(name)).unwrap_or_default()
}

/// Whether a run of a file is three of the model, one for each direction.
fn reads_all(run: &DraftRun) -> bool {
    matches!(&run.reading, DraftReading::Displacement(along) if along.iter().any(|text| text.value == "xyz"))
}

/// What a run is, whatever it and its set-up are called.
type Measurement = (Vec<Coordinate>, [PolyVector; 2], ReadingKind);

/// A run by itself on the machine; `None` where it has no measurement model.
fn measurement(draft: &Draft, run: &DraftRun) -> Option<Measurement> {
    let alone = Draft { assume: Vec::new(), ..with_runs(draft, std::slice::from_ref(run)) };
    let model = alone.build().ok()?;
    derive(&model).ok()?;
    let run = model.runs.first()?;
    Some((run.at.raw.clone(), [run.workpiece_ball.at.clone(), run.tool_ball.at.clone()], run.reading.clone()))
}
