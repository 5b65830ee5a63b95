//! The factorisation: run after run, row reduction in the declared order.
//!
//! A run's matrix has a row per trigonometric monomial and a column per parameter. What earlier base parameters explain
//! is taken out first; the reduced rows of the rest are the definitions of new base parameters, and a base parameter's
//! regressor is its pivot's own column of that rest.

use super::columns::Columns;
use super::derivation::{BaseParameter, Derivation, DeriveError, DerivedRun};
use super::determined::determined;
use super::parameter::Parameter;
use crate::algebra::{AlgebraError, Alphabet, Fraction, Monomial, Order, Poly, Row, integer, reduce, subtract};
use crate::ids::{BaseId, ParameterId, RunId};
use crate::model::Model;
use crate::model::Origin;
use typed_index_collections::{TiSlice, TiVec, ti_vec};

/// A base parameter while its regressors are being found.
struct Base {
    pivot: ParameterId,
    run: RunId,
    definition: Row<ParameterId>,
    regressors: TiVec<RunId, Fraction>,
}

/// A finished base parameter with its regressors.
type Named = (BaseParameter, TiVec<RunId, Fraction>);

pub(super) fn factor(model: &Model, readings: TiVec<RunId, Poly>, columns: Columns) -> Result<Derivation, DeriveError> {
    let alphabet = &model.alphabet;
    let order = || columns.parameters.keys();
    let mut base: Vec<Base> = Vec::new();
    for (run, raw) in columns.raw.iter_enumerated() {
        let (monomials, mut rows) = matrix(raw, alphabet)?;
        for b in &mut base {
            let mut factors = Vec::with_capacity(rows.len());
            for row in &mut rows {
                factors.push(subtract(row, &b.definition, b.pivot, alphabet)?);
            }
            b.regressors.push(regressor(&monomials, factors.iter(), &raw[b.pivot], alphabet)?);
        }
        for (pivot, definition) in reduce(rows.clone(), order(), alphabet)?.rows {
            let mut regressors = ti_vec![Fraction::zero(); run.into()];
            regressors.push(regressor(&monomials, rows.iter().map(|row| &row[pivot]), &raw[pivot], alphabet)?);
            base.push(Base { pivot, run, definition, regressors });
        }
    }
    let rows = base.iter().map(|b| b.definition.clone()).collect();
    let kernel = reduce(rows, order(), alphabet)?.kernel(columns.parameters.len());
    let base = name(model, &columns.parameters, base);
    let defined: Vec<(BaseId, &BaseParameter)> = base.iter_enumerated().map(|(id, (b, _))| (id, b)).collect();
    Ok(Derivation {
        functions: determined(model, &columns.parameters, &columns.assumed, &defined)?,
        runs: runs(model, readings, &columns, &base),
        base: base.into_iter().map(|(b, _)| b).collect(),
        parameters: columns.parameters,
        kernel: kernel.into_iter().map(sparse).collect(),
        unseen: columns.unseen,
        assumed: columns.assumed,
    })
}

/// The rows of a run's matrix, with the trigonometric monomial each stands for.
fn matrix(
    raw: &TiSlice<ParameterId, Poly>,
    alphabet: &Alphabet,
) -> Result<(Vec<Monomial>, Vec<Row<ParameterId>>), AlgebraError> {
    // Dividing all by what any divides by keeps what depends on what.
    let divisor = Poly::divisor(raw, alphabet);
    let (whole, back) = (Poly::term(divisor, integer(1)), divisor.recip()?);
    let mut rows: std::collections::BTreeMap<Monomial, Row<ParameterId>> = Default::default();
    for (j, column) in raw.iter_enumerated() {
        for (monomial, entry) in column.times(&whole, Order::NOMINAL)?.normal(alphabet)?.by_motion(alphabet) {
            rows.entry(monomial).or_insert_with(|| ti_vec![Fraction::zero(); raw.len()])[j] = Fraction::whole(entry);
        }
    }
    let mut divided = (Vec::with_capacity(rows.len()), Vec::with_capacity(rows.len()));
    for (monomial, row) in rows {
        divided.0.extend(monomial.times(&back, 0)?);
        divided.1.push(row);
    }
    Ok(divided)
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
fn name(model: &Model, parameters: &TiSlice<ParameterId, Parameter>, base: Vec<Base>) -> TiVec<BaseId, Named> {
    // What the model calls so itself stays the only one of that name.
    let taken = |name: &String| model.alphabet.has_name(name) || parameters.iter().any(|p| p.name == *name);
    let mut lumped = (1..).map(|n| format!("k{n}")).filter(|name| !taken(name));
    let finish = |b: Base| {
        let parameter = &parameters[b.pivot];
        let estimates = match parameter.origin {
            Origin::Coefficient(c) if model.functions[c.function].estimate => Some(c),
            _ => None,
        };
        let own = || parameter.name.clone();
        let with_the_feed = matches!(parameter.origin, Origin::Constant(error) if model.is_nuisance(error));
        // A location error has a value of its own: a sum that it stands in is not called so.
        let sum = estimates.is_some_and(|c| model.functions[c.function].is_location())
            && b.definition.iter().filter(|f| !f.is_zero()).count() > 1;
        let named = (estimates.is_some() && !sum) || with_the_feed;
        let name = if named { own() } else { lumped.next().unwrap_or_else(own) };
        let leading = b.regressors[b.run].numerator().printed().first().map(|(_, c)| c.is_negative());
        let flip = !named && leading == Some(true);
        let signed = |f: Fraction| if flip { f.negated() } else { f };
        let definition = sparse(b.definition).into_iter().map(|(j, f)| (j, signed(f))).collect();
        let regressors = b.regressors.into_iter().map(signed).collect();
        (BaseParameter { name, lumped: !named, pivot: b.pivot, definition, estimates, run: b.run }, regressors)
    };
    base.into_iter().map(finish).collect()
}

fn runs(
    model: &Model,
    readings: TiVec<RunId, Poly>,
    columns: &Columns,
    base: &TiSlice<BaseId, Named>,
) -> TiVec<RunId, DerivedRun> {
    let seen = |run: RunId| {
        let regressors = base.iter_enumerated().map(move |(b, (_, regressors))| (b, regressors[run].clone()));
        regressors.filter(|(_, r)| !r.is_zero()).collect()
    };
    let run = |(i, reading): (RunId, Poly)| DerivedRun {
        name: model.runs[i].name.clone(),
        reading,
        regressors: seen(i),
        known: columns.known[i].clone(),
    };
    readings.into_iter_enumerated().map(run).collect()
}

fn sparse(vector: Row<ParameterId>) -> Vec<(ParameterId, Fraction)> {
    vector.into_iter_enumerated().filter(|(_, f)| !f.is_zero()).collect()
}
