//! What the errors of many machines are combinations of.

use super::draw::SimulatedMachine;
use super::setup::Setup;
use super::shape::parts;
use rayon::prelude::*;
use trunnion_codegen::algebra::ErrorId;

/// Machine by machine and error by error, the factors of the functions that the error is a combination of.
pub(super) struct Factors {
    /// Of each error, where its own end.
    ends: Vec<usize>,
    all: Vec<f64>,
}

/// Of one machine.
#[derive(Clone, Copy)]
pub(super) struct OfMachine<'a> {
    ends: &'a [usize],
    all: &'a [f64],
}

impl Factors {
    /// Room for so many machines.
    pub fn room(setup: &Setup, machines: usize) -> Self {
        let mut width = 0;
        let end = |error: ErrorId| {
            width += parts(setup, error).len();
            width
        };
        let ends: Vec<usize> = setup.model.alphabet.errors().map(|(error, ..)| error).map(end).collect();
        Self { ends, all: vec![0.0; machines * width] }
    }

    fn width(&self) -> usize {
        self.ends.last().copied().unwrap_or(0).max(1)
    }

    /// Room of each machine, to be filled.
    pub fn machines_mut(&mut self) -> impl IndexedParallelIterator<Item = &mut [f64]> {
        let width = self.width();
        self.all.par_chunks_mut(width)
    }

    /// Every machine.
    pub fn machines(&self) -> impl Iterator<Item = OfMachine<'_>> {
        self.all.chunks(self.width()).map(|all| OfMachine { ends: &self.ends, all })
    }
}

impl<'a> OfMachine<'a> {
    /// Of an error.
    pub fn of(self, error: ErrorId) -> &'a [f64] {
        let at = error.index();
        let start = at.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.all[start..self.ends[at]]
    }
}

impl SimulatedMachine {
    /// Writes the factors of all errors.
    pub(super) fn write_factors(&self, setup: &Setup, to: &mut [f64]) {
        let all = setup.model.alphabet.errors().flat_map(|(error, ..)| self.factors(error));
        to.iter_mut().zip(all).for_each(|(to, factor)| *to = *factor);
    }
}
