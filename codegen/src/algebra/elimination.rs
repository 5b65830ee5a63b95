//! Exact Gauss–Jordan elimination over the field of [`Fraction`]s.

use super::{AlgebraError, Alphabet, Fraction};
use typed_index_collections::{TiSlice, TiVec};

/// A row of a matrix, or a vector with an entry for each of its columns `C`.
pub type Row<C> = TiVec<C, Fraction>;

/// A matrix in reduced row echelon form with respect to a given order of its columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reduced<C: From<usize>> {
    /// Pivot column and row, in the order the columns were offered; the row is 1 at its own pivot, 0 at the others'.
    pub rows: Vec<(C, Row<C>)>,
}

/// Reduces `rows`; a column listed earlier in `order` is preferred as pivot, one not listed is never a pivot.
pub fn reduce<C>(
    mut rows: Vec<Row<C>>,
    order: impl IntoIterator<Item = C>,
    alphabet: &Alphabet,
) -> Result<Reduced<C>, AlgebraError>
where
    C: Copy + PartialEq + From<usize>,
    usize: From<C>,
{
    let mut done: Vec<(C, Row<C>)> = Vec::new();
    for column in order {
        let sparsest = |row: &&Row<C>| row.iter().filter(|f| !f.is_zero()).count();
        let candidates = rows.iter().enumerate().filter(|(_, row)| !row[column].is_zero());
        let Some(at) = candidates.min_by_key(|(_, row)| sparsest(row)).map(|(i, _)| i) else { continue };
        let mut pivot = rows.swap_remove(at);
        let inverse = pivot[column].recip(alphabet)?;
        for f in &mut pivot {
            *f = f.times(&inverse, alphabet)?;
        }
        for row in rows.iter_mut().chain(done.iter_mut().map(|(_, row)| row)) {
            subtract(row, &pivot, column, alphabet)?;
        }
        done.push((column, pivot));
    }
    Ok(Reduced { rows: done })
}

/// Takes `row[column]` times `pivot` from `row` and returns that factor; `pivot[column]` is 1.
pub fn subtract<C>(
    row: &mut TiSlice<C, Fraction>,
    pivot: &TiSlice<C, Fraction>,
    column: C,
    alphabet: &Alphabet,
) -> Result<Fraction, AlgebraError>
where
    C: Copy + PartialEq + From<usize>,
    usize: From<C>,
{
    let factor = core::mem::replace(&mut row[column], Fraction::zero());
    if !factor.is_zero() {
        for ((j, r), p) in row.iter_mut_enumerated().zip(pivot) {
            if j != column && !p.is_zero() {
                *r = r.minus_product(&factor, p, alphabet)?;
            }
        }
    }
    Ok(factor)
}

impl<C> Reduced<C>
where
    C: Copy + PartialEq + From<usize>,
    usize: From<C>,
{
    /// The kernel of a matrix of `width` columns: for every free column the vector that is 1 there and 0 at the other free
    /// ones.
    pub fn kernel(&self, width: usize) -> Vec<Row<C>> {
        let zeros: Row<C> = vec![Fraction::zero(); width].into();
        let free = zeros.keys().filter(|c| self.rows.iter().all(|(pivot, _)| pivot != c));
        free.map(|f| {
            let mut vector = zeros.clone();
            vector[f] = Fraction::one();
            for (pivot, row) in &self.rows {
                vector[*pivot] = row[f].negated();
            }
            vector
        })
        .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::Poly;
    use super::*;

    #[test]
    fn the_declared_order_chooses_the_pivots_and_the_kernel_is_the_kernel() {
        let mut alphabet = Alphabet::default();
        let r = Poly::nominal(alphabet.constant("R").unwrap());
        let whole = |p: &Poly| Fraction::whole(p.clone());
        let (zero, one) = (Fraction::zero(), Fraction::one());
        let matrix: [Row<usize>; 2] = [[whole(&r), one.clone(), zero.clone()], [whole(&r), one.clone(), whole(&r)]]
            .map(|row| row.to_vec().into());
        let reduced = reduce(matrix.to_vec(), [1, 2, 0], &alphabet).unwrap();
        assert_eq!(reduced.rows.iter().map(|r| r.0).collect::<Vec<_>>(), [1, 2]);
        let kernel = reduced.kernel(3);
        assert_eq!(kernel, [Row::from(vec![one, whole(&r.negated()), zero.clone()])]);
        for row in &matrix {
            let step = |sum: Fraction, (a, b): (&Fraction, &Fraction)| sum.minus_product(a, b, &alphabet).unwrap();
            assert_eq!(row.iter().zip(&kernel[0]).fold(zero.clone(), step), zero);
        }
    }
}
