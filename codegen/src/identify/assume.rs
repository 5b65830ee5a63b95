//! Assumptions put in: a parameter that others make up is taken out of the columns before they are factored.

use super::derivation::DeriveError;
use super::parameter::{Assumed, Column};
use crate::algebra::{Alphabet, Fraction, Order, Poly, Row, reduce};
use crate::model::{Assumption, Origin};

/// Solves the assumptions for one parameter each, those that they name first, and puts these in.
pub(super) fn assume(
    assumptions: &[Assumption],
    found: &mut Vec<Column>,
    runs: usize,
    alphabet: &Alphabet,
) -> Result<Vec<Assumed>, DeriveError> {
    let mut origins: Vec<Origin> = Vec::new();
    let named = assumptions.iter().flat_map(|a| a.terms.iter().take(a.left).rev());
    for (origin, _) in named.chain(assumptions.iter().flat_map(|a| &a.terms)) {
        if !origins.contains(origin) {
            origins.push(*origin);
        }
    }
    let mut rows: Vec<Row<usize>> = Vec::new();
    for (i, assumption) in assumptions.iter().enumerate() {
        // Beside the condition stands which one it is, so that a row tells what it was made of.
        let mut row: Row<usize> = vec![Fraction::zero(); origins.len() + assumptions.len()].into();
        for (origin, factor) in &assumption.terms {
            let at = origins.iter().position(|o| o == origin).unwrap_or(0);
            let minus = Fraction::whole(factor.negated());
            row[at] = row[at].minus_product(&minus, &Fraction::one(), alphabet)?;
        }
        row[origins.len() + i] = Fraction::one();
        rows.push(row);
    }
    let mut assumed = Vec::new();
    for (pivot, row) in reduce(rows, 0..origins.len(), alphabet)?.rows {
        let (in_origins, made_of) = row.raw.split_at(origins.len());
        let mut sum = Vec::new();
        for (origin, factor) in origins.iter().zip(in_origins).filter(|(o, f)| **o != origins[pivot] && !f.is_zero()) {
            let factor = factor.as_poly().ok_or_else(|| DeriveError::AssumptionDivides(texts(assumptions, made_of)))?;
            sum.push((*origin, factor.negated()));
        }
        let at = found.iter().position(|c| c.origin == origins[pivot]);
        let column = at.map(|at| found.swap_remove(at).by_run).unwrap_or_else(|| vec![Poly::ZERO; runs].into());
        for (origin, factor) in &sum {
            for (run, own) in column.iter_enumerated().filter(|(_, own)| !own.is_zero()) {
                let added = own.times(factor, Order::NOMINAL)?;
                let at = found.iter().position(|c| c.origin == *origin).unwrap_or_else(|| {
                    found.push(Column { origin: *origin, by_run: vec![Poly::ZERO; runs].into() });
                    found.len() - 1
                });
                let whole = found[at].by_run[run].plus(&added)?;
                found[at].by_run[run] = whole;
            }
        }
        let (origin, texts) = (origins[pivot], texts(assumptions, made_of));
        assumed.push(Assumed { origin, is: sum, by_run: column, texts });
    }
    Ok(assumed)
}

/// The assumptions that a row was made of.
fn texts(assumptions: &[Assumption], made_of: &[Fraction]) -> Vec<String> {
    let used = assumptions.iter().zip(made_of).filter(|(_, f)| !f.is_zero());
    used.map(|(a, _)| a.text.clone()).collect()
}
