//! What wrong lengths of the set-up do: the rows are evaluated at other places than the balls are.

use super::parts::Parts;
use crate::study::fit::{Fit, Observation, Sample};
use crate::study::seen::Seen;
use crate::study::setup::Setup;
use nalgebra::DVector;

/// Each length with a stated limit, off by its standard uncertainty.
pub(super) struct Lengths {
    changed: Vec<Setup>,
    /// What each does to the base parameters.
    responses: Parts,
}

impl Lengths {
    pub fn new(setup: &Setup, observations: &[Observation], fit: &Fit) -> Self {
        let off = |&(constant, limit): &(_, f64)| {
            let name = setup.model.alphabet.nominal_name(constant);
            setup.with_constant(constant, setup.constant(&name) + limit / 3f64.sqrt())
        };
        let changed: Vec<Setup> = setup.model.limits.constants.iter().map(off).collect();
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
        Self { changed, responses }
    }

    /// Standard uncertainty of a combination of base parameters; with a function at a coordinate, of that.
    pub fn std(&self, fit: &Fit, functional: &DVector<f64>, function: Option<(&Seen, f64)>) -> f64 {
        let moved = self.responses.tr_mul(functional);
        let one = |(moved, changed): (&f64, &Setup)| {
            let basis = function.map_or(0.0, |(seen, x)| {
                let other = Seen::new(changed, seen.determination.clone());
                (fit.functional_of(changed, &other, x) - functional).dot(&fit.values)
            });
            (moved + basis).powi(2)
        };
        moved.iter().zip(&self.changed).map(one).sum::<f64>().sqrt()
    }
}
