//! The uncertainty of a result as a budget: a line for each source, combined by the GUM.
//!
//! Lines are standard uncertainties and uncorrelated. Noise is of type A, with the degrees of freedom of the residuals; all others
//! are of type B and taken as exactly known. A limit stands for a rectangular distribution.

mod assumed;
mod bound;
mod confounding;
mod effects;
mod gum;
mod input;
mod instrument;
mod lengths;
mod linearisation;
mod parts;
mod propagated;
mod source;
mod term;

pub(super) use effects::without_table;
pub use gum::{COVERAGE, Combined, Contribution, combine, coverage_factor};
pub use input::{Detail, Distribution, Input};
pub use instrument::Instrument;
pub(super) use parts::any_shape;
pub(crate) use propagated::{covering, student};
pub use source::{Line, Source};
pub use term::Term;

use super::dependence::Dependence;
use super::factors::Factors;
use super::fit::{Fit, Observation};
use super::limits::ErrorLimits;
use super::misfit::alike;
use super::seen::Seen;
use super::setup::Setup;
use assumed::{Assumptions, zeros};
use confounding::{Limited, Sum};
use effects::{Instrumental, Tables, instrumental, tables};
use input::{Of, Part, lines};
use lengths::Lengths;
use linearisation::{Dropped, linearisation};
use nalgebra::DVector;
use parts::{Ignored, std};
use trunnion_codegen::algebra::ErrorId;
use trunnion_codegen::identify::Origin;
use trunnion_codegen::ids::BaseId;
use trunnion_codegen::quantity::Unit;
use trunnion_solver::lstsq::Step;

/// What an estimate's uncertainty is made of; each result's budget follows from it.
pub struct Sources<'a> {
    setup: &'a Setup,
    fit: &'a Fit,
    dependence: Dependence<'a>,
    limited: Limited<'a>,
    instrument: Instrumental,
    tables: Tables,
    without_table: Ignored,
    lengths: Lengths,
    assumptions: Assumptions<'a>,
    zeros: Ignored,
    linearisation: Dropped,
    /// How many readings stand for an independent one.
    alike: f64,
    /// Standard deviation of a reading of weight one, as the residuals have it, mm.
    scatter: f64,
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

impl<'a> Sources<'a> {
    /// The sources of an estimate from `observations`, for errors within `limits`; `no_table` says that the known functions
    /// were taken as zero.
    pub fn new(
        setup: &'a Setup,
        observations: &[Observation],
        fit: &'a Fit,
        limits: ErrorLimits,
        instrument: &Instrument,
        no_table: bool,
    ) -> Self {
        Self {
            setup,
            fit,
            dependence: Dependence::new(setup, observations, fit),
            limited: Limited::new(setup, observations, limits),
            instrument: instrumental(setup, observations, fit, instrument),
            tables: tables(setup, observations, fit),
            without_table: if no_table { without_table(setup, observations) } else { Vec::new() },
            lengths: Lengths::new(setup, observations, fit),
            assumptions: Assumptions::new(setup, observations, fit),
            zeros: zeros(setup, observations),
            linearisation: linearisation(setup, observations, fit, limits),
            alike: alike(fit),
            scatter: scatter(observations, fit),
        }
    }

    /// What linearisation drops from each run's readings, all orders: not more on 95 % of the machines within the limits, mm.
    pub fn dropped(&self) -> &[f64] {
        &self.linearisation.usual
    }

    /// The machines that say so.
    pub(super) fn machines(&self) -> &Factors {
        &self.linearisation.machines
    }

    /// How the base parameters depend on each reading.
    pub(super) fn dependence(&self) -> &Dependence<'a> {
        &self.dependence
    }

    /// Of a base parameter, in the units inside.
    pub fn coefficient(&self, base: BaseId) -> Budget {
        self.budget(&self.parts(&self.fit.coefficient(base), &[]))
    }

    /// Of a function at a coordinate, mm or rad.
    pub fn function(&self, seen: &Seen, x: f64) -> Budget {
        self.sum(&[Term { factor: 1.0, seen, at: x }])
    }

    /// Of a sum of functions, correlations included.
    pub fn sum(&self, terms: &[Term]) -> Budget {
        self.budget(&self.parts(&self.functional(terms), terms))
    }

    /// The value of a sum of functions, mm or rad.
    pub fn value(&self, terms: &[Term]) -> f64 {
        self.functional(terms).dot(&self.fit.values)
    }

    /// The same, quantity by quantity, in a unit.
    pub fn detail(&self, seen: &Seen, x: f64, unit: Unit) -> Detail {
        let terms = [Term { factor: 1.0, seen, at: x }];
        let functional = self.functional(&terms);
        let parts = self.parts(&functional, &terms);
        let drawn = self.linearisation.on_machines(&functional);
        Detail::new(self.setup, &parts, self.degrees_of_freedom(), drawn, unit)
    }

    fn functional(&self, terms: &[Term]) -> DVector<f64> {
        let own = |term: &Term| self.fit.functional_of(self.setup, term.seen, term.at) * term.factor;
        terms.iter().map(own).fold(DVector::zeros(self.fit.base.len()), |sum, own| sum + own)
    }

    fn budget(&self, parts: &[Part]) -> Budget {
        Budget::new(lines(parts, self.degrees_of_freedom()))
    }

    fn degrees_of_freedom(&self) -> u32 {
        (f64::from(self.fit.degrees_of_freedom) / self.alike).max(1.0) as u32
    }

    /// What each quantity puts into a result, source after source: a combination of base parameters, and of which functions it is the
    /// sum, if it is one.
    fn parts(&self, functional: &DVector<f64>, terms: &[Term]) -> Vec<Part> {
        let noise = (&self.fit.covariance * functional).dot(functional).max(0.0).sqrt() * self.alike.sqrt();
        let scatter = self.scatter * self.alike.sqrt();
        let dropped = std(&self.linearisation.parts, functional);
        let part = |source, of, std, contribution| Part { source, of, std, contribution };
        let within = |source| {
            move |(error, effect): (ErrorId, f64)| Part::within(source, error, effect, self.limited.limit(error))
        };
        let ignored = |errors| self.ignored(errors, functional);
        let assumed = self.limited.largest(&self.assumptions.sum(functional, terms));
        let confounded = self.limited.largest(&terms.iter().flat_map(|term| self.confounded(term)).collect());
        [part(Source::Noise, Of::Scatter, scatter, noise)]
            .into_iter()
            .chain(self.instrument.parts(functional))
            .chain(self.lengths.parts(self.fit, functional, terms))
            .chain(self.tables.parts(functional))
            .chain(ignored(&self.without_table).into_iter().map(within(Source::Tables)))
            .chain(assumed.into_iter().chain(ignored(&self.zeros)).map(within(Source::Assumptions)))
            .chain([part(Source::Linearisation, Of::Dropped, dropped, dropped)])
            .chain(confounded.into_iter().map(within(Source::Confounding)))
            .collect()
    }

    /// What stands between a function and the sum it is seen in.
    fn confounded(&self, &Term { factor, seen, at: x }: &Term) -> Sum {
        let parameters = &self.setup.derivation.parameters;
        let others = seen.others(self.setup, x).into_iter().map(|(j, f)| (parameters[j].origin, f));
        let missing = seen.missing(self.setup, x).into_iter().map(|(c, f)| (Origin::Coefficient(c), f));
        others.chain(missing).map(|(origin, f)| (origin, factor * f)).collect()
    }

    /// Motion errors that were left out, each with the most that a unit of it adds, of whatever shape is worst.
    fn ignored(&self, ignored: &Ignored, functional: &DVector<f64>) -> Vec<(ErrorId, f64)> {
        if ignored.is_empty() {
            return Vec::new();
        }
        let weights = self.dependence.weights(functional);
        ignored.iter().map(|(error, factors)| (*error, any_shape(&weights, factors))).collect()
    }
}

/// Of the readings that set the scale of the estimated functions' uncertainty: those of the last step.
fn scatter(observations: &[Observation], fit: &Fit) -> f64 {
    let last = (0..observations.len()).map(|at| fit.step(at)).fold(Step::First, |last, step| match step {
        Step::Second => step,
        Step::First => last,
    });
    let square = |(at, o): (usize, &Observation)| {
        let of_last = fit.step(at) == last;
        fit.rms.get(at).filter(|_| of_last).map_or(0.0, |rms| rms * rms * o.weight * o.samples.len() as f64)
    };
    let sum: f64 = observations.iter().enumerate().map(square).sum();
    (sum / f64::from(fit.degrees_of_freedom.max(1))).sqrt()
}
