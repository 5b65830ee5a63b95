//! What each source of uncertainty does to the base parameters.

use super::input::{Of, Part};
use super::instrument::Instrument;
use super::parts::{Ignored, Parts, std as size};
use super::source::Source;
use crate::study::fit::{Fit, Observation};
use crate::study::rows::each_row;
use crate::study::setup::Setup;
use crate::study::slow::{SLOW, slow};
use nalgebra::DVector;
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::ids::FunctionId;

/// The instrument's parts by source: what stays the same from reading to reading and from run to run, what is proportional to
/// the reading, the bar's length, its temperature.
pub(super) struct Instrumental {
    stated: Instrument,
    constant: Parts,
    proportional: Parts,
    bar_length: Parts,
    temperature: Parts,
}

impl Instrumental {
    /// What each puts into a combination of base parameters.
    pub fn parts(&self, functional: &DVector<f64>) -> [Part; 4] {
        let part = |source, of, std, parts| Part { source, of, std, contribution: size(parts, functional) };
        let Self { stated, constant, proportional, bar_length, temperature } = self;
        [
            part(Source::Instrument, Of::Constant, stated.constant, constant),
            part(Source::Proportional, Of::Proportional, stated.proportional, proportional),
            part(Source::BarLength, Of::BarLength, stated.bar_length, bar_length),
            part(Source::Temperature, Of::Temperature, stated.temperature, temperature),
        ]
    }
}

pub(super) fn instrumental(
    setup: &Setup,
    observations: &[Observation],
    fit: &Fit,
    instrument: &Instrument,
) -> Instrumental {
    let constant = fit.responses(setup, observations, SLOW, |d, by| {
        slow(d.sample.sweep, by);
        by.iter_mut().for_each(|x| *x *= instrument.constant);
    });
    let one = |of: &dyn Fn(usize, f64) -> f64| {
        fit.responses(setup, observations, 1, |d, by| by[0] = of(d.observation, d.sample.reading))
    };
    let bar = |at: usize| observations.get(at).and_then(|o| setup.bar(o.run)).unwrap_or(0.0);
    let has_bar = |at: usize| if bar(at) > 0.0 { 1.0 } else { 0.0 };
    Instrumental {
        stated: *instrument,
        constant,
        proportional: one(&|_, reading| reading * instrument.proportional),
        bar_length: one(&|at, _| has_bar(at) * instrument.bar_length),
        temperature: one(&|at, _| bar(at) * instrument.expansion * instrument.temperature),
    }
}

/// The known functions that the runs see.
fn known(setup: &Setup, observations: &[Observation]) -> Vec<FunctionId> {
    setup.known(observations.iter().map(|o| o.run))
}

/// The tables of known functions, as uncertain as their columns say.
pub(super) struct Tables {
    /// Each function with the root mean square of its standard uncertainty over the readings.
    stds: Vec<(ErrorId, f64)>,
    parts: Parts,
}

impl Tables {
    /// What each puts into a combination of base parameters.
    pub fn parts<'a>(&'a self, functional: &'a DVector<f64>) -> impl Iterator<Item = Part> + 'a {
        self.stds.iter().enumerate().map(|(at, &(error, std))| {
            let own = self.parts.columns(at * SLOW, SLOW);
            let contribution = own.tr_mul(functional).norm();
            Part { source: Source::Tables, of: Of::Table(error), std, contribution }
        })
    }
}

pub(super) fn tables(setup: &Setup, observations: &[Observation], fit: &Fit) -> Tables {
    let known = known(setup, observations);
    let places = |o: &Observation| -> Vec<Option<usize>> {
        let own = setup.derivation.runs[o.run].known.iter();
        own.map(|(f, _)| known.binary_search(f).ok()).collect()
    };
    let places: Vec<Vec<Option<usize>>> = observations.iter().map(places).collect();
    let mut shape = [0.0; SLOW];
    let mut squares = vec![(0.0, 0.0); known.len()];
    let parts = fit.responses(setup, observations, known.len() * SLOW, |d, by| {
        slow(d.sample.sweep, &mut shape);
        // What is taken off the reading is wrong by as much.
        for ((factor, std), place) in d.factors.iter().zip(&d.sample.known_std).zip(&places[d.observation]) {
            let Some(at) = place else { continue };
            let (sum, count) = &mut squares[*at];
            (*sum, *count) = (*sum + std * std, *count + 1.0);
            by[at * SLOW..(at + 1) * SLOW].iter_mut().zip(&shape).for_each(|(b, s)| *b += factor * std * s);
        }
    });
    let rms = |(&function, (sum, count)): (&FunctionId, (f64, f64))| {
        (setup.model.functions[function].error, (sum / f64::max(count, 1.0)).sqrt())
    };
    Tables { stds: known.iter().zip(squares).map(rms).collect(), parts }
}

/// The known functions that the runs see and that were taken as zero, with their factors in every reading.
pub(in crate::study) fn without_table(setup: &Setup, observations: &[Observation]) -> Ignored {
    let of = |function: FunctionId| {
        let factors = |o: &Observation| {
            let at = setup.derivation.runs[o.run].known.iter().position(|(f, _)| *f == function);
            let mut along = Vec::with_capacity(o.samples.len());
            each_row(setup, o, |_, _, factors| along.push(at.and_then(|at| factors.get(at).copied()).unwrap_or(0.0)));
            along
        };
        (setup.model.functions[function].error, observations.iter().map(factors).collect())
    };
    known(setup, observations).into_iter().map(of).collect()
}
