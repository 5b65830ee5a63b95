//! Location errors that were estimated, and sums of them.

use crate::study::{Fit, Seen, Setup, Sources, Term};
use trunnion_codegen::identify::Extent;
use trunnion_codegen::quantity::Quantity;

/// A location error, or a sum of some, as it was estimated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// A length or an angle.
    pub quantity: Quantity,
    /// mm or rad.
    pub value: f64,
    /// Its combined standard uncertainty.
    pub std: f64,
    /// Its expanded uncertainty, 95 %.
    pub u95: f64,
}

impl Estimate {
    /// `-80.60 +- 1.49 urad`
    pub fn words(&self) -> String {
        let unit = self.quantity.deviation();
        let [value, u95] = [self.value, self.u95].map(|x| unit.from_inner(x));
        format!("{value:.2} +- {u95:.2} {}", unit.suffix())
    }
}

/// The location errors that are estimated and determined.
pub struct Located<'a> {
    setup: &'a Setup,
    sources: &'a Sources<'a>,
    /// Each with its ISO 230-1 name.
    errors: Vec<(String, &'a Seen)>,
}

impl<'a> Located<'a> {
    /// Those of a fit, with the sources of its uncertainty.
    pub fn new(setup: &'a Setup, fit: &'a Fit, sources: &'a Sources<'a>) -> Self {
        let determined = fit.functions().iter().filter(|seen| seen.extent() == Extent::Determined);
        let named =
            |seen: &'a Seen| Some((setup.model.iso_location(setup.model.functions[seen.function()].error)?, seen));
        Self { setup, sources, errors: determined.filter_map(named).collect() }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.errors.is_empty()
    }

    /// Each by its name.
    pub fn each(&self) -> impl Iterator<Item = (&str, Estimate)> {
        self.errors.iter().filter_map(|(name, _)| Some((name.as_str(), self.sum([(name.as_str(), 1.0)])?)))
    }

    /// Whether one was found.
    pub fn has(&self, name: &str) -> bool {
        self.errors.iter().any(|(own, _)| own == name)
    }

    /// The sum of some, each times its factor, with what is common to their uncertainties; none if one was not found, and of none.
    pub fn sum<'b>(&self, sum: impl IntoIterator<Item = (&'b str, f64)>) -> Option<Estimate> {
        let find = |name: &str| self.errors.iter().find(|(own, _)| own == name).map(|(_, seen)| *seen);
        let term = |(name, factor): (&str, f64)| Some(Term { factor, seen: find(name)?, at: 0.0 });
        let terms: Vec<Term> = sum.into_iter().map(term).collect::<Option<_>>()?;
        let quantity = self.setup.quantity(terms.first()?.seen.function());
        let combined = self.sources.sum(&terms).combined;
        Some(Estimate { quantity, value: self.sources.value(&terms), std: combined.std, u95: combined.expanded })
    }
}
