//! From the samples of a recording to a factor.

use super::fit::{Failure, FitError};
use super::observation::Sample;
use super::recording::Recording;
use super::rows::{Rows, blocks};
use super::setup::Setup;
use trunnion_codegen::graph::{LANES, Lanes};
use trunnion_codegen::ids::{BaseId, RunId};
use trunnion_solver::lstsq::{Rejected, Step};
use trunnion_solver::sized::{Block, Column, Estimate, ROWS};

/// Where the rows of a recording go.
pub(super) struct Target<'a> {
    /// The step that its run belongs to.
    pub step: Step,
    /// Base parameters of the problem.
    pub base: &'a [BaseId],
    /// Columns of the step: positions in `base`.
    pub columns: &'a [usize],
    /// What takes them.
    pub problem: &'a mut dyn Estimate,
}

/// Takes the samples of a recording, a block at a time; `on_sample` is called for each, `on_rows` for the rows of every block.
pub(super) fn fill<R: Recording>(
    setup: &Setup,
    recording: &R,
    into: Target<'_>,
    on_sample: impl FnMut(&Sample),
    mut on_rows: impl FnMut(&Rows),
) -> Result<(), Failure<R::Error>> {
    let Target { step, base, columns, problem } = into;
    let places = places(setup, recording.run(), base, columns);
    let mut block = Collected::new(columns.len());
    let mut refused = false;
    blocks(setup, recording, on_sample, |rows| {
        on_rows(rows);
        block.take(rows, &places, None);
        if block.is_full() {
            refused |= block.push(step, recording.weight(), problem).is_err();
        }
    })
    .map_err(Failure::Recording)?;
    refused |= block.push(step, recording.weight(), problem).is_err();
    if refused { Err(FitError::NotFinite.into()) } else { Ok(()) }
}

/// The column of each of a run's regressors; columns beyond `base` are none of theirs.
pub(super) fn places(setup: &Setup, run: RunId, base: &[BaseId], columns: &[usize]) -> Vec<Option<usize>> {
    let regressors = setup.derivation.runs[run].regressors.iter();
    regressors.map(|(b, _)| columns.iter().position(|&c| base.get(c) == Some(b))).collect()
}

/// Rows on their way into a factor.
pub(super) struct Collected {
    columns: Vec<Column<f64>>,
    y: Column<f64>,
    rows: usize,
}

impl Collected {
    pub fn new(columns: usize) -> Self {
        Self { columns: vec![[0.0; ROWS]; columns], y: [0.0; ROWS], rows: 0 }
    }

    /// Takes a block of rows, each with its own weight beside that of all.
    pub fn take(&mut self, rows: &Rows, places: &[Option<usize>], weights: Option<&Lanes>) {
        let (from, count) = (self.rows, rows.samples());
        let scales = weights.map(|weights| weights.map(f64::sqrt));
        let put = |to: &mut Column<f64>, values: &Lanes| {
            let to = &mut to[from..from + count];
            to.copy_from_slice(&values[..count]);
            if let Some(scales) = &scales {
                to.iter_mut().zip(scales).for_each(|(to, scale)| *to *= scale);
            }
        };
        for (x, place) in rows.regressors().zip(places) {
            if let Some(at) = place {
                put(&mut self.columns[*at], x);
            }
        }
        put(&mut self.y, &rows.explained());
        self.rows += count;
    }

    /// Whether there is no room for another block of rows.
    pub fn is_full(&self) -> bool {
        self.rows + LANES > ROWS
    }

    /// Hands the block on and is empty.
    pub fn push(&mut self, step: Step, weight: f64, problem: &mut dyn Estimate) -> Result<(), Rejected> {
        let rows = core::mem::take(&mut self.rows);
        let pushed = problem.push(step, Block { columns: &mut self.columns, y: &mut self.y }, rows, weight);
        self.columns.iter_mut().for_each(|column| column.fill(0.0));
        pushed
    }
}
