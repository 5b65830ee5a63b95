//! What wrong lengths of the set-up do: the rows are evaluated at other places than the balls are.

use super::input::{Of, Part};
use super::parts::Parts;
use super::source::Source;
use super::term::Term;
use crate::study::fit::{Fit, Observation, Sample};
use crate::study::seen::Seen;
use crate::study::setup::Setup;
use nalgebra::DVector;
use trunnion_codegen::algebra::NominalId;

/// Each length with a stated limit, off by its standard uncertainty.
pub(super) struct Lengths {
    stds: Vec<(NominalId, f64)>,
    changed: Vec<Setup>,
    /// What each does to the base parameters.
    responses: Parts,
}

impl Lengths {
    pub fn new(setup: &Setup, observations: &[Observation], fit: &Fit) -> Self {
        let stated = setup.model.limits.constants.iter();
        let stds: Vec<(NominalId, f64)> = stated.map(|&(length, limit)| (length, limit / 3f64.sqrt())).collect();
        let off = |&(length, std): &(NominalId, f64)| {
            let name = setup.model.alphabet.nominal_name(length);
            setup.with_constant(length, setup.constant(&name) + std)
        };
        let changed: Vec<Setup> = stds.iter().map(off).collect();
        let predicted = |s: &Setup, o: &Observation, sample: &Sample| {
            let mut row = s.row(o.run);
            let (regressors, factors) = row.at(sample.sweep, sample.direction);
            let places = fit.places(s, o.run);
            let base: f64 = regressors.iter().zip(places).filter_map(|(x, at)| Some(x * fit.values[at?])).sum();
            base + factors.iter().zip(&sample.known).map(|(f, k)| f * k).sum::<f64>()
        };
        let responses = fit.responses(setup, observations, changed.len(), |d, by| {
            let o = &observations[d.observation];
            let own = predicted(setup, o, d.sample);
            // The readings stay: what the row makes more of them, the base parameters make less.
            by.iter_mut().zip(&changed).for_each(|(b, other)| *b = own - predicted(other, o, d.sample));
        });
        Self { stds, changed, responses }
    }

    /// What each puts into a combination of base parameters; with functions at coordinates, into their sum.
    pub fn parts(&self, fit: &Fit, functional: &DVector<f64>, terms: &[Term]) -> Vec<Part> {
        let moved = self.responses.tr_mul(functional);
        let one = |((moved, changed), &(length, std)): ((&f64, &Setup), &(NominalId, f64))| {
            let changed = terms.iter().map(|term| {
                let other = Seen::new(changed, term.seen.determination.clone());
                fit.functional_of(changed, &other, term.at).dot(&fit.values) * term.factor
            });
            let basis = if terms.is_empty() { 0.0 } else { changed.sum::<f64>() - functional.dot(&fit.values) };
            Part { source: Source::Lengths, of: Of::Length(length), std, contribution: (moved + basis).abs() }
        };
        moved.iter().zip(&self.changed).zip(&self.stds).map(one).collect()
    }
}
