//! What runs together tell of a function: its value, its value up to named terms, or nothing.
//!
//! The base parameters' definitions are reduced once more, all runs together and with the function's own coefficients as the
//! first pivots, each row beside the combination of base parameters that it is. So every coefficient c becomes
//! `c + Σ factor · other = Σ factor · base parameter`, and no `other` could be taken out by what else the runs see. A
//! coefficient that an assumption makes up of others is the sum of what these become.

use super::derivation::{BaseParameter, Derivation, Determination, SeenTerm};
use super::parameter::{Assumed, Parameter};
use crate::algebra::{AlgebraError, Alphabet, Fraction, Reduced, Row, reduce};
use crate::ids::{BaseId, FunctionId, ParameterId, TermId};
use crate::model::{Coefficient, Model, Origin};
use typed_index_collections::TiSlice;

/// What the definitions of `base` tell of every estimated function.
pub(super) fn determined(
    model: &Model,
    parameters: &TiSlice<ParameterId, Parameter>,
    assumed: &[Assumed],
    base: &[(BaseId, &BaseParameter)],
) -> Result<Vec<Determination>, AlgebraError> {
    let rows = Rows { model, parameters, assumed, base };
    let estimated = model.functions.keys().filter(|f| model.functions[*f].estimate);
    estimated.map(|function| rows.one(function)).collect()
}

impl Derivation {
    /// What some of the base parameters, such as those that part of the runs see, tell of every estimated function.
    ///
    /// # Errors
    /// [`AlgebraError`] where an exact computation fails.
    pub fn determined_by(&self, model: &Model, base: &[BaseId]) -> Result<Vec<Determination>, AlgebraError> {
        if base.len() == self.base.len() {
            return Ok(self.functions.clone());
        }
        let base: Vec<_> = base.iter().filter_map(|b| Some((*b, self.base.get(*b)?))).collect();
        determined(model, &self.parameters, &self.assumed, &base)
    }
}

struct Rows<'a> {
    model: &'a Model,
    parameters: &'a TiSlice<ParameterId, Parameter>,
    assumed: &'a [Assumed],
    base: &'a [(BaseId, &'a BaseParameter)],
}

impl Rows<'_> {
    fn one(&self, function: FunctionId) -> Result<Determination, AlgebraError> {
        let terms = self.model.functions[function].basis.functions().keys();
        let alone = |term: TermId| {
            let own = Some(Coefficient { function, term });
            let (id, _) = self.base.iter().find(|(_, b)| b.estimates == own && b.definition.len() == 1)?;
            Some(SeenTerm { term, base: vec![(*id, Fraction::one())], others: Vec::new() })
        };
        // Nearly always: each coefficient is a base parameter and nothing else, and no other row can change that.
        if let Some(seen) = terms.clone().map(alone).collect::<Option<Vec<_>>>() {
            return Ok(Determination { function, seen, missing: Vec::new() });
        }
        let own = terms.clone().map(|term| Origin::Coefficient(Coefficient { function, term }));
        let first: Vec<usize> = own.filter_map(|origin| self.place(origin)).collect();
        let reduced = self.reduced(&first)?;
        let mut found = Determination { function, seen: Vec::new(), missing: Vec::new() };
        for term in terms {
            match self.seen(term, Origin::Coefficient(Coefficient { function, term }), &reduced)? {
                Some(seen) => found.seen.push(seen),
                None => found.missing.push(term),
            }
        }
        Ok(found)
    }

    fn place(&self, origin: Origin) -> Option<usize> {
        self.parameters.position(|p| p.origin == origin).map(usize::from)
    }

    /// The definitions with these parameters as the first pivots, each row beside the base parameters it is made of.
    fn reduced(&self, first: &[usize]) -> Result<Reduced<usize>, AlgebraError> {
        let width = self.parameters.len();
        let rows = self.base.iter().enumerate().map(|(i, (_, b))| {
            let mut row: Row<usize> = vec![Fraction::zero(); width + self.base.len()].into();
            b.definition.iter().for_each(|(j, f)| row[usize::from(*j)] = f.clone());
            row[width + i] = Fraction::one();
            row
        });
        let order = first.iter().copied().chain((0..width).filter(|j| !first.contains(j)));
        reduce(rows.collect(), order, &self.model.alphabet)
    }

    /// A coefficient as it is seen; `None` where it is not.
    fn seen(&self, term: TermId, origin: Origin, reduced: &Reduced<usize>) -> Result<Option<SeenTerm>, AlgebraError> {
        let (width, alphabet) = (self.parameters.len(), &self.model.alphabet);
        let sum = match self.assumed.iter().find(|a| a.origin == origin) {
            Some(assumed) => assumed.is.iter().map(|(o, p)| (*o, Fraction::whole(p.clone()))).collect(),
            None => vec![(origin, Fraction::one())],
        };
        let replaced = sum.is_empty();
        let mut total: Row<usize> = vec![Fraction::zero(); width + self.base.len()].into();
        let mut any = replaced;
        for (of, factor) in &sum {
            // Never seen, and so in no reading: it cannot be told what it adds.
            let Some(place) = self.place(*of) else { return Ok(None) };
            match reduced.rows.iter().find(|(pivot, _)| *pivot == place) {
                Some((_, row)) => {
                    any = true;
                    add(&mut total, row, factor, alphabet)?;
                    total[place] = total[place].minus_product(factor, &Fraction::one(), alphabet)?;
                }
                None => total[place] = total[place].minus_product(factor, &Fraction::one(), alphabet)?,
            }
        }
        if !any {
            return Ok(None);
        }
        let (in_parameters, in_base) = total.raw.split_at(width);
        let others = in_parameters.iter().enumerate().filter(|(_, f)| !f.is_zero());
        let summed = self.base.iter().zip(in_base).filter(|(_, f)| !f.is_zero());
        Ok(Some(SeenTerm {
            term,
            base: summed.map(|((b, _), f)| (*b, f.clone())).collect(),
            others: others.map(|(j, f)| (j.into(), f.clone())).collect(),
        }))
    }
}

/// Adds `factor · row`.
fn add(total: &mut Row<usize>, row: &Row<usize>, factor: &Fraction, alphabet: &Alphabet) -> Result<(), AlgebraError> {
    let minus = factor.negated();
    for (t, r) in total.iter_mut().zip(row).filter(|(_, r)| !r.is_zero()) {
        *t = t.minus_product(&minus, r, alphabet)?;
    }
    Ok(())
}
