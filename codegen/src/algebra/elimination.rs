//! Exact Gauss–Jordan elimination over the field of [`Fraction`]s.
//!
//! A row stands for all its multiples until it is done: as polynomials with nothing in common. So no step works on fractions,
//! whose every sum would be searched for common divisors.

use super::fraction::{by_root2, conjugate, lowest};
use super::gcd::{exact, gcd};
use super::{AlgebraError, Alphabet, Fraction, Monomial, Order, Poly, Rational, rational};
use crate::limits::ELIMINATION;
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
    rows: Vec<Row<C>>,
    order: impl IntoIterator<Item = C>,
    alphabet: &Alphabet,
) -> Result<Reduced<C>, AlgebraError>
where
    C: Copy + PartialEq + From<usize>,
    usize: From<C>,
{
    let mut rows = rows.iter().map(whole).collect::<Result<Vec<_>, _>>()?;
    let mut work = Work::default();
    let mut done: Vec<(C, TiVec<C, Poly>)> = Vec::new();
    for column in order {
        let size = |row: &TiVec<C, Poly>| {
            let terms = row.iter().map(|p| p.terms().len());
            (terms.clone().filter(|n| *n > 0).count(), terms.sum::<usize>())
        };
        let candidates = rows.iter().enumerate().filter(|(_, row)| !row[column].is_zero());
        let Some(at) = candidates.min_by_key(|(_, row)| size(row)).map(|(i, _)| i) else { continue };
        let mut pivot = rows.swap_remove(at);
        if pivot[column].has_root2() {
            let conjugate = conjugate(&pivot[column])?;
            for p in &mut pivot {
                *p = p.times(&conjugate, Order::NOMINAL)?.normal_root2()?;
            }
            make_primitive(&mut pivot)?;
        }
        for row in rows.iter_mut().chain(done.iter_mut().map(|(_, row)| row)).filter(|row| !row[column].is_zero()) {
            eliminate(row, &pivot, column, &mut work)?;
        }
        done.push((column, pivot));
    }
    let over = |(column, row): (C, TiVec<C, Poly>)| {
        let entry = |p: &Poly| {
            if p.is_zero() { Ok(Fraction::zero()) } else { Fraction::new(p.clone(), row[column].clone(), alphabet) }
        };
        Ok((column, row.iter().map(entry).collect::<Result<_, AlgebraError>>()?))
    };
    Ok(Reduced { rows: done.into_iter().map(over).collect::<Result<_, AlgebraError>>()? })
}

/// The multiple of a row without denominators: first without those of its numbers, then without those of several terms.
fn whole<C>(row: &Row<C>) -> Result<TiVec<C, Poly>, AlgebraError> {
    let apart = |f: &Fraction| match f.denominator() {
        None => Ok((f.numerator().clone(), Poly::one())),
        Some(d) => {
            let number = content([d]);
            Ok((f.numerator().over(Monomial::ONE, &number)?, d.over(Monomial::ONE, &number)?))
        }
    };
    let parts = row.iter().map(apart).collect::<Result<Vec<(Poly, Poly)>, AlgebraError>>()?;
    let number = content(parts.iter().map(|(above, _)| above));
    let mut common = Poly::one();
    for (_, below) in parts.iter().filter(|(_, below)| below.terms().len() > 1) {
        common = common.times(&exact(below, &gcd(&common, below)?)?, Order::NOMINAL)?;
    }
    let over = |(above, below): &(Poly, Poly)| {
        above.over(Monomial::ONE, &number)?.times(&exact(&common, below)?, Order::NOMINAL)
    };
    let mut row = parts.iter().map(over).collect::<Result<TiVec<C, Poly>, _>>()?;
    make_primitive(&mut row)?;
    Ok(row)
}

/// What the numbers of polynomials have in common.
fn content<'a>(polys: impl IntoIterator<Item = &'a Poly>) -> Rational {
    rational::content(polys.into_iter().flat_map(Poly::terms).map(|(_, c)| c))
}

/// Products of terms there have been.
#[derive(Default)]
struct Work(usize);

impl Work {
    fn add(&mut self, a: &Poly, b: &Poly) -> Result<(), AlgebraError> {
        self.0 += a.terms().len() * b.terms().len();
        if self.0 > ELIMINATION { Err(AlgebraError::TooLong) } else { Ok(()) }
    }
}

/// Makes `row[column]` zero: `(p·row − f·pivot) / gcd(p, f)`; p has no √2.
fn eliminate<C>(
    row: &mut TiVec<C, Poly>,
    pivot: &TiVec<C, Poly>,
    column: C,
    work: &mut Work,
) -> Result<(), AlgebraError>
where
    C: Copy + From<usize>,
    usize: From<C>,
{
    let common = common(pivot[column].clone(), &row[column])?;
    let (p, f) = (exact(&pivot[column], &common)?, over(&row[column], &common)?);
    let number = content([&p, &f]);
    let (p, f) = (p.over(Monomial::ONE, &number)?, f.over(Monomial::ONE, &number)?);
    for (r, own) in row.iter_mut().zip(pivot) {
        work.add(r, &p)?;
        work.add(own, &f)?;
        *r = r.times(&p, Order::NOMINAL)?;
        if !own.is_zero() {
            *r = r.minus(&own.times(&f, Order::NOMINAL)?)?.normal_root2()?;
        }
    }
    make_primitive(row)
}

/// Divides a row by all that its entries have in common: numbers, powers of constants, polynomials.
fn make_primitive<C>(row: &mut TiVec<C, Poly>) -> Result<(), AlgebraError> {
    let present = || row.iter().filter(|p| !p.is_zero());
    let Some(low) = present().map(lowest).reduce(|a, b| a.lower(&b)) else { return Ok(()) };
    let number = content(present());
    if low != Monomial::ONE || !number.is_one() {
        for p in row.iter_mut() {
            *p = p.over(low, &number)?;
        }
    }
    let mut by_size: Vec<&Poly> = row.iter().filter(|p| !p.is_zero()).collect();
    by_size.sort_by_key(|p| p.terms().len());
    let mut divisor = Poly::ZERO;
    for p in by_size {
        divisor = common(divisor, p)?;
        if divisor.as_number().is_some() {
            return Ok(());
        }
    }
    for p in row.iter_mut() {
        *p = over(p, &divisor)?;
    }
    Ok(())
}

/// What divides a polynomial without √2 and both parts of another.
fn common(mut divisor: Poly, p: &Poly) -> Result<Poly, AlgebraError> {
    for (_, part) in by_root2(p) {
        divisor = gcd(&divisor, &part)?;
    }
    Ok(divisor)
}

/// The quotient by a divisor of both parts.
fn over(p: &Poly, divisor: &Poly) -> Result<Poly, AlgebraError> {
    let mut quotient = Poly::ZERO;
    for (root, part) in by_root2(p) {
        quotient =
            quotient.plus(&exact(&part, divisor)?.times(&Poly::term(root, rational::integer(1)), Order::NOMINAL)?)?;
    }
    Ok(quotient)
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

    #[test]
    fn coefficients_that_grow_beyond_use_are_refused() {
        let mut alphabet = Alphabet::default();
        let lengths = ["A", "B", "C", "D"].map(|name| Poly::nominal(alphabet.constant(name).unwrap()));
        let entry = |i: i128, j: i128| {
            let scaled = lengths.iter().zip([3 * i + j * j, 2 * j + i * i, 7 * i * j + 1, i + 5 * j]);
            let terms = scaled.map(|(l, n)| l.scaled(&Rational::from(n % 11 + 1)).unwrap());
            Fraction::whole(terms.fold(Poly::one(), |sum, term| sum.plus(&term).unwrap()))
        };
        let rows = (0..12).map(|i| (0..13).map(|j| entry(i, j)).collect::<Row<usize>>()).collect();
        assert_eq!(reduce(rows, 0..13, &alphabet).err(), Some(AlgebraError::TooLong));
    }
}
