//! The factorisation: run after run, row reduction in the declared order.
//!
//! A run's matrix has a row per trigonometric monomial and a column per parameter. What earlier base parameters explain
//! is taken out first; the reduced rows of the rest are the definitions of new base parameters, and a base parameter's
//! regressor is its pivot's own column of that rest.

use super::columns::{Columns, Origin};
use super::{BaseParameter, Derivation, DeriveError, DerivedRun};
use crate::algebra::{AlgebraError, Alphabet, Fraction, Monomial, Poly, integer, reduce, subtract};
use crate::model::Model;

/// A base parameter while its regressors are being found.
struct Base {
    pivot: usize,
    run: usize,
    definition: Vec<Fraction>,
    /// Per run, once seen.
    regressors: Vec<Fraction>,
}

pub(super) fn factor(model: &Model, readings: Vec<Poly>, columns: Columns) -> Result<Derivation, DeriveError> {
    let alphabet = &model.alphabet;
    let order: Vec<usize> = (0..columns.parameters.len()).collect();
    let mut base: Vec<Base> = Vec::new();
    for (run, raw) in columns.raw.iter().enumerate() {
        let (monomials, mut rows) = matrix(raw, alphabet)?;
        for b in &mut base {
            let mut factors = Vec::with_capacity(rows.len());
            for row in &mut rows {
                factors.push(subtract(row, &b.definition, b.pivot, alphabet)?);
            }
            b.regressors.push(regressor(&monomials, factors.iter(), &raw[b.pivot], alphabet)?);
        }
        for (pivot, definition) in reduce(rows.clone(), &order, alphabet)?.rows {
            let mut regressors = vec![Fraction::zero(); run];
            regressors.push(regressor(&monomials, rows.iter().map(|row| &row[pivot]), &raw[pivot], alphabet)?);
            base.push(Base { pivot, run, definition, regressors });
        }
    }
    let rows = base.iter().map(|b| b.definition.clone()).collect();
    let kernel = reduce(rows, &order, alphabet)?.kernel(order.iter().copied(), order.len());
    let base = name(model, &columns, base);
    Ok(Derivation {
        runs: runs(model, readings, &columns, &base),
        base: base.into_iter().map(|(b, _)| b).collect(),
        parameters: columns.parameters,
        kernel: kernel.into_iter().map(|(_, vector)| sparse(vector)).collect(),
        unseen: columns.unseen,
    })
}

/// The rows of a run's matrix, with the trigonometric monomial each stands for.
fn matrix(raw: &[Poly], alphabet: &Alphabet) -> Result<(Vec<Monomial>, Vec<Vec<Fraction>>), AlgebraError> {
    let constants = |m: &Monomial, keep: bool| {
        let ids = alphabet.nominals().filter(|(id, _)| alphabet.is_constant(*id) != keep);
        ids.fold(*m, |m, (id, _)| m.with_exponent(id, 0))
    };
    let mut rows: std::collections::BTreeMap<Monomial, Vec<Fraction>> = Default::default();
    for (j, column) in raw.iter().enumerate() {
        for (monomial, entry) in column.normal(alphabet)?.group(|m| constants(m, false), |m| constants(m, true)) {
            rows.entry(monomial).or_insert_with(|| vec![Fraction::zero(); raw.len()])[j] = Fraction::whole(entry);
        }
    }
    Ok(rows.into_iter().unzip())
}

/// `Σ monomial · entry`; as the pivot's own column, with its products as they stand, where that is the same.
fn regressor<'a>(
    monomials: &[Monomial],
    entries: impl Iterator<Item = &'a Fraction>,
    raw: &Poly,
    alphabet: &Alphabet,
) -> Result<Fraction, AlgebraError> {
    let mut sum = Fraction::zero();
    for (monomial, entry) in monomials.iter().zip(entries).filter(|(_, e)| !e.is_zero()) {
        let minus = Fraction::whole(Poly::term(*monomial, integer(-1)));
        sum = sum.minus_product(&minus, entry, alphabet)?;
    }
    let same = sum.as_poly().is_some_and(|p| raw.normal(alphabet).as_ref() == Ok(p));
    Ok(if same { Fraction::whole(raw.clone()) } else { sum })
}

/// Names the base parameters and chooses their signs: a regressor's leading coefficient is positive where it is first seen.
fn name(model: &Model, columns: &Columns, base: Vec<Base>) -> Vec<(BaseParameter, Vec<Fraction>)> {
    let mut lumped = 0;
    let finish = |b: Base| {
        let parameter = &columns.parameters[b.pivot];
        let estimates = match parameter.origin {
            Origin::Coefficient(f, k) if model.functions[f].estimate => Some((f, k)),
            _ => None,
        };
        let leading = b.regressors[b.run].numerator().printed().first().map(|(_, c)| *c);
        let flip = estimates.is_none() && leading.is_some_and(|c| c < integer(0));
        let signed = |f: Fraction| if flip { f.negated() } else { f };
        lumped += usize::from(estimates.is_none());
        let name = if estimates.is_some() { parameter.name.clone() } else { format!("k{lumped}") };
        let definition = sparse(b.definition).into_iter().map(|(j, f)| (j, signed(f))).collect();
        let regressors = b.regressors.into_iter().map(signed).collect();
        (BaseParameter { name, pivot: b.pivot, definition, estimates, run: b.run }, regressors)
    };
    base.into_iter().map(finish).collect()
}

fn runs(
    model: &Model,
    readings: Vec<Poly>,
    columns: &Columns,
    base: &[(BaseParameter, Vec<Fraction>)],
) -> Vec<DerivedRun> {
    let seen = |run: usize| {
        let regressors = base.iter().enumerate().map(move |(i, (_, regressors))| (i, regressors[run].clone()));
        regressors.filter(|(_, r)| !r.is_zero()).collect()
    };
    let run = |(i, reading): (usize, Poly)| DerivedRun {
        name: model.runs[i].name.clone(),
        reading,
        regressors: seen(i),
        known: columns.known[i].clone(),
    };
    readings.into_iter().enumerate().map(run).collect()
}

fn sparse(vector: Vec<Fraction>) -> Vec<(usize, Fraction)> {
    vector.into_iter().enumerate().filter(|(_, f)| !f.is_zero()).collect()
}
