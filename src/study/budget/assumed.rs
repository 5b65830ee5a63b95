//! What the model's assumptions ignore: parameters that are put in as others, and functions that are taken as zero.

use super::confounding::Sum;
use super::parts::{Ignored, Parts};
use super::term::Term;
use crate::study::fit::{Fit, Observation};
use crate::study::setup::Setup;
use nalgebra::DVector;
use trunnion_codegen::algebra::{ErrorId, Monomial, Poly, at};
use trunnion_codegen::basis::Basis;
use trunnion_codegen::identify::{Coefficient, Origin};

/// What deviations from the assumptions do.
pub(super) struct Assumptions<'a> {
    setup: &'a Setup,
    /// Of each assumed parameter, what one unit beside what it is taken as adds to the base parameters.
    responses: Parts,
}

impl<'a> Assumptions<'a> {
    pub fn new(setup: &'a Setup, observations: &[Observation], fit: &Fit) -> Self {
        let assumed = &setup.derivation.assumed;
        let number = |p: &Poly, sweep: f64| at(p, &setup.model.alphabet, sweep, |n| setup.constant(n));
        let responses = fit.responses(setup, observations, assumed.len(), |d, by| {
            let run = observations[d.observation].run;
            by.iter_mut().zip(assumed).for_each(|(b, a)| *b = number(&a.by_run[run], d.sample.sweep));
        });
        Self { setup, responses }
    }

    /// What they add to a combination of base parameters, and with functions at coordinates to what these are short of: in
    /// parameters.
    pub fn sum(&self, functional: &DVector<f64>, terms: &[Term]) -> Sum {
        let mut sum = Sum::new();
        let moved = self.responses.tr_mul(functional);
        for (assumed, moved) in self.setup.derivation.assumed.iter().zip(moved.iter()) {
            let own = |of: &Term| match assumed.origin {
                Origin::Coefficient(Coefficient { function, term }) if function == of.seen.function() => {
                    self.setup.basis(function, of.at).get(term).map(|value| of.factor * value)
                }
                _ => None,
            };
            let factor = moved - terms.iter().filter_map(own).sum::<f64>();
            sum.push((assumed.origin, factor));
            let number = |p: &Poly| at(p, &self.setup.model.alphabet, 0.0, |n| self.setup.constant(n));
            sum.extend(assumed.is.iter().map(|(origin, p)| (*origin, -factor * number(p))));
        }
        sum
    }
}

/// Motion errors taken as zero of which the model states a limit, with their factors in the readings.
pub(super) fn zeros(setup: &Setup, observations: &[Observation]) -> Ignored {
    let stated = setup.model.functions.iter().filter(|f| f.basis == Basis::Zero);
    let stated = stated.map(|f| f.error).filter(|e| setup.model.limits.of(*e).is_some());
    let factors = |error: ErrorId| {
        let run = |o: &Observation| {
            let reading = setup.derivation.runs[o.run].reading.by_errors();
            let own = |(m, _): &(Monomial, Poly)| m.errors().next() == Some(error);
            let factor = reading.into_iter().find(own).map_or(Poly::ZERO, |(_, p)| p);
            let number = |sweep| at(&factor, &setup.model.alphabet, sweep, |n| setup.constant(n));
            o.samples.iter().map(|s| number(s.sweep)).collect()
        };
        (error, observations.iter().map(run).collect())
    };
    stated.map(factors).collect()
}
