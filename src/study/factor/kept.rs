//! What is kept of a run's samples beside what they add to the triangle: of constant size, and a sum, too.

use super::cells::Cells;
use super::reader::{BytesError, Reader};
use super::squares::{Squares, Squaring};
use crate::study::fit::Fit;
use crate::study::misfit::Look;
use crate::study::observation::Observation;
use crate::study::setup::Setup;
use trunnion_codegen::ids::RunId;

/// What is kept of the samples of a run that have one weight.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    pub run: RunId,
    pub weight: f64,
    pub cells: Cells,
    pub squares: Squares,
}

impl Kept {
    /// Of a recording that was gone through.
    pub fn new(run: RunId, weight: f64, mut cells: Cells, squaring: Squaring) -> Self {
        cells.close();
        Self { run, weight, cells, squares: squaring.squares() }
    }

    /// Puts it to others.
    pub fn put_to(&self, all: &mut Vec<Self>) {
        match all.iter_mut().find(|own| own.place() == self.place()) {
            Some(own) => {
                own.cells.merge(&self.cells);
                own.squares.merge(&self.squares);
            }
            None => {
                all.push(self.clone());
                all.sort_by_key(Self::place);
            }
        }
    }

    /// Positive numbers are in the order of their bits.
    fn place(&self) -> (RunId, u64) {
        (self.run, self.weight.to_bits())
    }

    /// What the residuals of a fit look like.
    pub fn look(&self, setup: &Setup, fit: &Fit) -> Look {
        let places = fit.places(setup, self.run);
        let values: Vec<f64> = places.into_iter().map(|at| at.map_or(0.0, |at| fit.values[at])).collect();
        let [squares, neighbours] = self.squares.residuals(&values);
        Look::of_sums(self.cells.samples() as usize, squares, neighbours)
    }

    /// An observation that stands for all samples; its readings are what a fit makes of them.
    pub fn observation(&self, setup: &Setup, fit: &Fit) -> Observation {
        let samples = self.cells.standing(setup.derivation.runs[self.run].known.len());
        let each = self.cells.samples() as f64 / samples.len().max(1) as f64;
        let mut observation = Observation { run: self.run, weight: self.weight * each, samples };
        let predicted = fit.residuals(setup, &observation);
        observation.samples.iter_mut().zip(predicted).for_each(|(sample, residual)| sample.reading = -residual);
        observation
    }

    /// Whether it can be of a run of `setup`.
    pub fn is_of(&self, setup: &Setup) -> bool {
        let fits = |regressors: usize, known: usize| regressors == self.squares.regressors() && self.cells.knows(known);
        setup.derivation.runs.get(self.run).is_some_and(|run| fits(run.regressors.len(), run.known.len()))
    }

    /// As bytes.
    pub fn write(&self, out: &mut Vec<u8>) {
        out.push(usize::from(self.run).to_le_bytes()[0]);
        out.extend(self.weight.to_le_bytes());
        self.squares.write(out);
        self.cells.write(out);
    }

    /// From bytes.
    pub fn read(bytes: &mut Reader<'_>) -> Result<Self, BytesError> {
        let (run, weight) = (RunId::from(bytes.byte()?), bytes.number()?);
        if !(weight.is_finite() && weight > 0.0) {
            return Err(BytesError::Damaged);
        }
        let squares = Squares::read(bytes)?;
        Ok(Self { run, weight, cells: Cells::read(bytes)?, squares })
    }
}

/// As bytes: how many, and each.
pub fn write_all(all: &[Kept], out: &mut Vec<u8>) {
    out.extend((all.len() as u32).to_le_bytes());
    all.iter().for_each(|kept| kept.write(out));
}

/// From bytes.
pub fn read_all(bytes: &mut Reader<'_>) -> Result<Vec<Kept>, BytesError> {
    let mut all: Vec<Kept> = Vec::new();
    for _ in 0..bytes.count()? {
        let kept = Kept::read(bytes)?;
        if all.last().is_some_and(|last| last.place() >= kept.place()) {
            return Err(BytesError::Damaged);
        }
        all.push(kept);
    }
    Ok(all)
}
