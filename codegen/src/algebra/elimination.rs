//! Exact Gauss–Jordan elimination over the field of [`Fraction`]s.

use super::{AlgebraError, Alphabet, Fraction};

/// A matrix in reduced row echelon form with respect to a given order of its columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Reduced {
    /// Pivot column and row, in the order the columns were offered; the row is 1 at its own pivot, 0 at the others'.
    pub rows: Vec<(usize, Vec<Fraction>)>,
}

/// Reduces `rows`; a column listed earlier in `order` is preferred as pivot, one not listed is never a pivot.
pub fn reduce(mut rows: Vec<Vec<Fraction>>, order: &[usize], alphabet: &Alphabet) -> Result<Reduced, AlgebraError> {
    let mut done: Vec<(usize, Vec<Fraction>)> = Vec::new();
    for &column in order {
        let sparsest = |row: &&Vec<Fraction>| row.iter().filter(|f| !f.is_zero()).count();
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
pub fn subtract(
    row: &mut [Fraction],
    pivot: &[Fraction],
    column: usize,
    alphabet: &Alphabet,
) -> Result<Fraction, AlgebraError> {
    let factor = core::mem::replace(&mut row[column], Fraction::zero());
    if !factor.is_zero() {
        for (j, (r, p)) in row.iter_mut().zip(pivot).enumerate() {
            if j != column && !p.is_zero() {
                *r = r.minus_product(&factor, p, alphabet)?;
            }
        }
    }
    Ok(factor)
}

impl Reduced {
    /// The kernel: for every free column in `columns` the vector that is 1 there and 0 at the other free ones.
    pub fn kernel(&self, columns: impl Iterator<Item = usize>, width: usize) -> Vec<(usize, Vec<Fraction>)> {
        let free = columns.filter(|c| self.rows.iter().all(|(pivot, _)| pivot != c));
        free.map(|f| {
            let mut vector = vec![Fraction::zero(); width];
            vector[f] = Fraction::one();
            for (pivot, row) in &self.rows {
                vector[*pivot] = row[f].negated();
            }
            (f, vector)
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
        let matrix = vec![vec![whole(&r), one.clone(), zero.clone()], vec![whole(&r), one.clone(), whole(&r)]];
        let reduced = reduce(matrix.clone(), &[1, 2, 0], &alphabet).unwrap();
        assert_eq!(reduced.rows.iter().map(|r| r.0).collect::<Vec<_>>(), [1, 2]);
        let kernel = reduced.kernel(0..3, 3);
        assert_eq!(kernel, [(0, vec![one, whole(&r.negated()), zero.clone()])]);
        for row in &matrix {
            let step = |sum: Fraction, (a, b): (&Fraction, &Fraction)| sum.minus_product(a, b, &alphabet).unwrap();
            assert_eq!(row.iter().zip(&kernel[0].1).fold(zero.clone(), step), zero);
        }
    }
}
