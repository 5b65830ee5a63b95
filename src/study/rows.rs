//! Rows of a run, many at a time.

use super::observation::{Observation, Sample};
use super::recording::Recording;
use super::setup::Setup;
use thiserror::Error;
use trunnion_codegen::graph::{BlockEvaluator, LANES, Lanes};
use trunnion_codegen::ids::RunId;
use trunnion_codegen::kinematics::directions;
use trunnion_solver::sized::{Work, vectorised};

/// What is told of a sample with its residual.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Taken {
    /// The sweep, rad.
    pub sweep: f64,
    /// Which way it goes.
    pub direction: f64,
    /// The reading, mm.
    pub reading: f64,
}

/// A block of samples with their rows.
pub(super) struct Rows<'a> {
    setup: &'a Setup,
    run: RunId,
    evaluator: BlockEvaluator<'a>,
    regressors: usize,
    samples: usize,
    taken: [Taken; LANES],
    /// Values of each known function.
    known: Vec<Lanes>,
    /// One sample's inputs.
    inputs: Vec<f64>,
}

/// Runs the tape on whatever the processor has.
pub(super) struct Evaluate<'a, 'b>(pub &'a mut BlockEvaluator<'b>);

impl Work for Evaluate<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn work(self) {
        self.0.evaluate();
    }
}

impl<'a> Rows<'a> {
    pub fn new(setup: &'a Setup, run: RunId) -> Self {
        let derived = &setup.derivation.runs[run];
        let mut evaluator = setup.block_evaluator(run);
        let inputs = setup.inputs(run);
        for (lanes, &input) in evaluator.inputs().iter_mut().zip(&inputs) {
            lanes.fill(input);
        }
        Self {
            setup,
            run,
            evaluator,
            regressors: derived.regressors.len(),
            samples: 0,
            taken: [Taken::default(); LANES],
            known: vec![[0.0; LANES]; derived.known.len()],
            inputs,
        }
    }

    /// Samples in the block.
    pub fn samples(&self) -> usize {
        self.samples
    }

    /// The samples in the block.
    pub fn taken(&self) -> &[Taken] {
        &self.taken[..self.samples]
    }

    /// The regressors of the base parameters that the run sees, in the derivation's order, each at every sample.
    pub fn regressors(&self) -> impl Iterator<Item = &Lanes> {
        (0..self.regressors).filter_map(|at| self.evaluator.output(at))
    }

    /// Each sample's reading less what the known functions put into it.
    pub fn explained(&self) -> Lanes {
        let mut explained = self.taken.map(|taken| taken.reading);
        for (at, known) in self.known.iter().enumerate() {
            let Some(factors) = self.evaluator.output(self.regressors + at) else { continue };
            for (y, (factor, known)) in explained.iter_mut().zip(factors.iter().zip(known)) {
                *y -= factor * known;
            }
        }
        explained
    }

    fn take(&mut self, sample: &Sample) {
        let lane = self.samples;
        self.setup.place(self.run, &mut self.inputs, sample.sweep, sample.direction);
        let first = self.setup.lengths();
        for (lanes, &input) in self.evaluator.inputs().iter_mut().zip(&self.inputs).skip(first) {
            lanes[lane] = input;
        }
        self.taken[lane] = Taken { sweep: sample.sweep, direction: sample.direction, reading: sample.reading };
        for (lanes, &known) in self.known.iter_mut().zip(&sample.known) {
            lanes[lane] = known;
        }
        self.samples += 1;
    }

    fn evaluate(&mut self) {
        vectorised(Evaluate(&mut self.evaluator));
    }
}

/// Why rows cannot be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "room for {found} numbers where {expected} are written\n  expected one for each sample and each base parameter of the run"
)]
pub struct RowsError {
    /// How many there is room for.
    pub found: usize,
    /// How many there are.
    pub expected: usize,
}

impl Setup {
    /// A run's rows at values of its sweep (rad), in the order in which they are visited: the regressors of the base parameters that
    /// the run sees, in the order of its derivation, each a column of `out`, column after column.
    ///
    /// # Errors
    /// [`RowsError`] where `out` is of another size than samples times regressors.
    pub fn rows(&self, run: RunId, sweeps: &[f64], out: &mut [f64]) -> Result<(), RowsError> {
        let count = sweeps.len();
        let expected = count * self.derivation.runs[run].regressors.len();
        if out.len() != expected {
            return Err(RowsError { found: out.len(), expected });
        }
        let (mut rows, known) = (Rows::new(self, run), vec![0.0; self.derivation.runs[run].known.len()]);
        let mut sample = Sample { sweep: 0.0, direction: 0.0, reading: 0.0, known, known_std: Vec::new() };
        let samples: Vec<(f64, f64)> = sweeps.iter().copied().zip(directions(sweeps)).collect();
        for (block, samples) in samples.chunks(LANES).enumerate() {
            rows.samples = 0;
            for &(sweep, direction) in samples {
                (sample.sweep, sample.direction) = (sweep, direction);
                rows.take(&sample);
            }
            rows.evaluate();
            for (column, values) in out.chunks_mut(count).zip(rows.regressors()) {
                let own = &mut column[block * LANES..][..samples.len()];
                own.copy_from_slice(&values[..samples.len()]);
            }
        }
        Ok(())
    }
}

/// Calls `each` for every sample of an observation, with the regressors of the base parameters that its run sees, and with the factors of the
/// run's known functions.
pub(super) fn each_row(setup: &Setup, observation: &Observation, mut each: impl FnMut(&Sample, &[f64], &[f64])) {
    let (mut samples, mut row) = (observation.samples.iter(), Vec::new());
    let Ok(()) = blocks(
        setup,
        observation,
        |_| {},
        |rows| {
            for (lane, sample) in (0..rows.samples).zip(&mut samples) {
                row.clear();
                row.extend((0..).map_while(|at| Some(rows.evaluator.output(at)?[lane])));
                let (regressors, factors) = row.split_at(rows.regressors);
                each(sample, regressors, factors);
            }
        },
    );
}

/// Calls `on_sample` for every sample of a recording, and `each` for the rows of every block of them, in order.
pub(super) fn blocks<R: Recording>(
    setup: &Setup,
    recording: &R,
    mut on_sample: impl FnMut(&Sample),
    mut each: impl FnMut(&Rows),
) -> Result<(), R::Error> {
    let mut rows = Rows::new(setup, recording.run());
    recording.each(&mut |sample| {
        on_sample(sample);
        rows.take(sample);
        if rows.samples == LANES {
            rows.evaluate();
            each(&rows);
            rows.samples = 0;
        }
    })?;
    if rows.samples > 0 {
        rows.evaluate();
        each(&rows);
    }
    Ok(())
}
