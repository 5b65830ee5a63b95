//! What generated code speaks to: one module, so that a model of one's own and the built-in one are the same code.
//!
//! Not part of the public interface: it changes with the generator of the same version.

pub use crate::Real;
pub use crate::block::{Near, Number, joined, rows};
pub use crate::lstsq::{Column, Condition, Factor, Order, Rejected, Solution, SolveError, TwoStepError};
pub use crate::model::{ImpossibleLength, MergeError, NotFinite};

use nalgebra::SVector;

/// A run's row among all columns of a factor: `positions[i]` is the column of `row[i]`.
#[inline]
pub fn scattered<T: Real, const N: usize, const P: usize>(positions: &[usize; N], row: &[T; N]) -> SVector<T, P> {
    let mut all = [T::zero(); P];
    for (&at, &value) in positions.iter().zip(row) {
        if let Some(place) = all.get_mut(at) {
            *place = value;
        }
    }
    SVector::from(all)
}

/// A reading less what the known functions put into it.
#[inline]
pub fn without<T: Real, const K: usize>(reading: T, factors: &[T; K], known: &[T; K]) -> T {
    factors.iter().zip(known).fold(reading, |reading, (&factor, &known)| reading - factor * known)
}

/// Refuses a length of the set-up that is none.
///
/// # Errors
/// [`ImpossibleLength`] by its name.
#[inline]
pub fn length<T: Real>(name: &'static str, mm: T) -> Result<(), ImpossibleLength> {
    if mm > T::zero() && mm.is_finite() { Ok(()) } else { Err(ImpossibleLength::of(name)) }
}

/// Value and standard deviation of `Σ basis[i] · coefficient`, the coefficients being those at `positions`.
///
/// # Errors
/// [`NotFinite`]
#[inline]
pub fn value<T: Real, const P: usize, const N: usize>(
    solution: &Solution<T, P>,
    positions: &[usize; N],
    basis: &[T; N],
) -> Result<(T, T), NotFinite> {
    let zero = T::zero();
    let [coefficients] = &solution.coefficients.data.0;
    let at = |column: &[T; P], i: usize| column.get(i).copied().unwrap_or(zero);
    let terms = || positions.iter().zip(basis);
    let value = terms().fold(zero, |sum, (&i, &b)| sum + b * at(coefficients, i));
    let variance = terms().fold(zero, |sum, (&i, &b)| {
        let column = solution.covariance.data.0.get(i);
        let inner = terms().fold(zero, |sum, (&j, &c)| sum + c * column.map_or(zero, |column| at(column, j)));
        sum + b * inner
    });
    // Rounding can take a vanishing variance below zero.
    let std = variance.max(zero).sqrt();
    if (value + variance).is_finite() { Ok((value, std)) } else { Err(NotFinite) }
}
