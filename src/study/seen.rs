//! An estimated function as the base parameters give it, in numbers.

use super::setup::Setup;
use trunnion_codegen::algebra::Fraction;
use trunnion_codegen::identify::{Coefficient, Determination, Extent};
use trunnion_codegen::ids::{BaseId, FunctionId, ParameterId, TermId};
use typed_index_collections::TiSlice;

/// What is seen of a function: `Σ term · (coefficient + Σ factor · other parameter)`, its value where there are no others.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The same exactly.
    pub determination: Determination,
    terms: Vec<Term>,
}

/// One term of its basis.
#[derive(Clone, Debug)]
struct Term {
    term: TermId,
    base: Vec<(BaseId, f64)>,
    others: Vec<(ParameterId, f64)>,
}

impl Seen {
    /// With the values of the set-up's constants put in.
    pub(super) fn new(setup: &Setup, determination: Determination) -> Self {
        let number = |f: &Fraction| setup.number(f);
        let terms = determination.seen.iter().map(|s| Term {
            term: s.term,
            base: s.base.iter().map(|(b, f)| (*b, number(f))).collect(),
            others: s.others.iter().map(|(j, f)| (*j, number(f))).collect(),
        });
        Self { terms: terms.collect(), determination }
    }

    /// Which function.
    pub fn function(&self) -> FunctionId {
        self.determination.function
    }

    /// How far it is determined.
    pub fn extent(&self) -> Extent {
        self.determination.extent()
    }

    /// The functions of its basis that are seen, at a coordinate (mm or rad).
    pub fn basis(&self, setup: &Setup, x: f64) -> Vec<f64> {
        let values = setup.basis(self.function(), x);
        self.terms.iter().map(|t| values.get(t.term).copied().unwrap_or(0.0)).collect()
    }

    /// The base parameters that make up the coefficient of each, with their factors.
    pub fn combinations(&self) -> impl Iterator<Item = &[(BaseId, f64)]> {
        self.terms.iter().map(|t| t.base.as_slice())
    }

    /// What other parameters add to it at a coordinate: each with its factor.
    pub fn others(&self, setup: &Setup, x: f64) -> Vec<(ParameterId, f64)> {
        let basis = self.basis(setup, x);
        let scaled = |(t, value): (&Term, f64)| t.others.iter().map(move |(j, f)| (*j, f * value)).collect::<Vec<_>>();
        self.terms.iter().zip(basis).flat_map(scaled).collect()
    }

    /// Its own coefficients that are not seen, each with its function of the basis at a coordinate.
    pub fn missing(&self, setup: &Setup, x: f64) -> Vec<(Coefficient, f64)> {
        let (function, values) = (self.function(), setup.basis(self.function(), x));
        let own = |&term: &TermId| Some((Coefficient { function, term }, *values.get(term)?));
        self.determination.missing.iter().filter_map(own).collect()
    }

    /// What is seen of each of these functions' coefficients on a machine: its own, and the others in its sum.
    pub fn coefficients<'a>(
        &'a self,
        own: &'a [f64],
        parameters: &'a TiSlice<ParameterId, f64>,
    ) -> impl Iterator<Item = f64> + 'a {
        let of = |t: &Term| own.get(usize::from(t.term)).copied().unwrap_or(0.0);
        self.terms.iter().map(move |t| of(t) + t.others.iter().map(|(j, f)| f * parameters[*j]).sum::<f64>())
    }

    /// What is seen on a machine with these base parameters, at a coordinate.
    pub fn truth(&self, setup: &Setup, base: &TiSlice<BaseId, f64>, x: f64) -> f64 {
        let sums = self.terms.iter().map(|t| t.base.iter().map(|(b, f)| base[*b] * f).sum::<f64>());
        sums.zip(self.basis(setup, x)).map(|(sum, value)| sum * value).sum()
    }
}
