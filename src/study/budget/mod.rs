//! The uncertainty of a result as a budget: a line for each source, combined by the GUM.
//!
//! Lines are standard uncertainties and uncorrelated. Noise is of type A, with the degrees of freedom of the residuals; all others
//! are of type B and taken as exactly known. A limit stands for a rectangular distribution.

mod assumed;
mod bound;
mod confounding;
mod effects;
mod gum;
mod instrument;
mod lengths;
mod linearisation;
mod parts;
mod source;

pub(super) use effects::without_table;
pub use gum::{COVERAGE, Combined, Contribution, combine};
pub use instrument::Instrument;
pub(super) use parts::any_shape;
pub use source::{Line, Source};

use super::fit::{Fit, Observation};
use super::limits::ErrorLimits;
use super::misfit::alike;
use super::seen::Seen;
use super::setup::Setup;
use assumed::{Assumptions, zeros};
use confounding::{Limited, Sum};
use effects::{Instrumental, instrumental, tables};
use lengths::Lengths;
use linearisation::{Dropped, linearisation};
use nalgebra::DVector;
use parts::{Ignored, Parts, std};
use trunnion_codegen::identify::Origin;
use trunnion_codegen::ids::BaseId;

/// What an estimate's uncertainty is made of; each result's budget follows from it.
pub struct Sources<'a> {
    setup: &'a Setup,
    observations: &'a [Observation],
    fit: &'a Fit,
    limited: Limited<'a>,
    instrument: Instrumental,
    tables: Parts,
    without_table: Ignored,
    lengths: Lengths,
    assumptions: Assumptions<'a>,
    zeros: Ignored,
    linearisation: Dropped,
    /// How many readings stand for an independent one.
    alike: f64,
}

/// The uncertainty of one number.
#[derive(Clone, Debug, PartialEq)]
pub struct Budget {
    /// A line for each source, standard uncertainties in the number's own unit.
    pub lines: Vec<Line>,
    /// All of them.
    pub combined: Combined,
}

impl Budget {
    fn new(lines: Vec<Line>) -> Self {
        let combined = combine(lines.iter().map(|line| line.contribution), COVERAGE);
        Self { lines, combined }
    }

    /// In another unit: times `factor`.
    #[must_use]
    pub fn times(mut self, factor: f64) -> Self {
        self.lines.iter_mut().for_each(|line| line.contribution.std *= factor);
        self.combined.std *= factor;
        self.combined.expanded *= factor;
        self
    }

    /// Without what tells a function from the sum it is seen in: of the sum itself.
    #[must_use]
    pub fn of_the_sum(&self) -> Self {
        self.without(Source::Confounding)
    }

    /// Without one of its sources.
    #[must_use]
    pub fn without(&self, source: Source) -> Self {
        Self::new(self.lines.iter().filter(|line| line.source != source).copied().collect())
    }
}

/// A result: a combination of base parameters, or a function at a coordinate.
type Function<'a> = Option<(&'a Seen, f64)>;

impl<'a> Sources<'a> {
    /// The sources of an estimate from `observations`, for errors within `limits`; `no_table` says that the known functions
    /// were taken as zero.
    pub fn new(
        setup: &'a Setup,
        observations: &'a [Observation],
        fit: &'a Fit,
        limits: ErrorLimits,
        instrument: &Instrument,
        no_table: bool,
    ) -> Self {
        Self {
            setup,
            observations,
            fit,
            limited: Limited::new(setup, observations, limits),
            instrument: instrumental(setup, observations, fit, instrument),
            tables: tables(setup, observations, fit),
            without_table: if no_table { without_table(setup, observations) } else { Vec::new() },
            lengths: Lengths::new(setup, observations, fit),
            assumptions: Assumptions::new(setup, observations, fit),
            zeros: zeros(setup, observations),
            linearisation: linearisation(setup, observations, fit, limits),
            alike: alike(fit),
        }
    }

    /// What linearisation drops from each run's readings, all orders: not more on 95 % of the machines within the limits, mm.
    pub fn dropped(&self) -> &[f64] {
        &self.linearisation.usual
    }

    /// Of a base parameter, in the units inside.
    pub fn coefficient(&self, base: BaseId) -> Budget {
        Budget::new(self.lines(&self.fit.coefficient(base), None))
    }

    /// Of a function at a coordinate, mm or rad.
    pub fn function(&self, seen: &Seen, x: f64) -> Budget {
        Budget::new(self.lines(&self.fit.functional(self.setup, seen.function(), x), Some((seen, x))))
    }

    fn lines(&self, functional: &DVector<f64>, function: Function) -> Vec<Line> {
        let noise = (&self.fit.covariance * functional).dot(functional).max(0.0).sqrt();
        let degrees_of_freedom = (f64::from(self.fit.degrees_of_freedom) / self.alike).max(1.0) as u32;
        let noise = Contribution { std: noise * self.alike.sqrt(), degrees_of_freedom: Some(degrees_of_freedom) };
        let Instrumental { constant, proportional, bar_length, temperature } = &self.instrument;
        let ignored = self.limited.std(&self.assumptions.sum(functional, function));
        let exact = [
            (Source::Instrument, std(constant, functional)),
            (Source::Proportional, std(proportional, functional)),
            (Source::BarLength, std(bar_length, functional)),
            (Source::Temperature, std(temperature, functional)),
            (Source::Lengths, self.lengths.std(self.fit, functional, function)),
            (Source::Tables, std(&self.tables, functional).hypot(self.ignored(&self.without_table, functional))),
            (Source::Assumptions, ignored.hypot(self.ignored(&self.zeros, functional))),
            (Source::Linearisation, std(&self.linearisation.parts, functional)),
            (Source::Confounding, function.map_or(0.0, |(seen, x)| self.limited.std(&self.confounded(seen, x)))),
        ];
        let exact = exact
            .into_iter()
            .filter(|(_, std)| *std > 0.0)
            .map(|(source, std)| Line { source, contribution: Contribution { std, degrees_of_freedom: None } });
        [Line { source: Source::Noise, contribution: noise }].into_iter().chain(exact).collect()
    }

    /// What stands between a function and the sum it is seen in.
    fn confounded(&self, seen: &Seen, x: f64) -> Sum {
        let parameters = &self.setup.derivation.parameters;
        let others = seen.others(self.setup, x).into_iter().map(|(j, f)| (parameters[j].origin, f));
        let missing = seen.missing(self.setup, x).into_iter().map(|(c, f)| (Origin::Coefficient(c), f));
        others.chain(missing).collect()
    }

    /// Motion errors that were left out, each within its limit and of whatever shape is worst.
    fn ignored(&self, ignored: &Ignored, functional: &DVector<f64>) -> f64 {
        if ignored.is_empty() {
            return 0.0;
        }
        let weights = self.fit.weights(self.setup, self.observations, functional);
        let largest = ignored.iter().map(|(error, factors)| any_shape(&weights, factors) * self.limited.limit(*error));
        (largest.map(|l| l * l).sum::<f64>() / 3.0).sqrt()
    }
}
