//! What whole columns of a block are worked on with: vectors of some rows each, as the processor has them.

use super::Real;

/// Rows of a block.
pub const ROWS: usize = 128;

/// A column of a block.
pub type Column<T> = [T; ROWS];

/// A processor's vectors.
pub trait Kernel<T>: Copy {
    /// Some rows of a column.
    type Vector: Copy;

    /// A column's vectors: all of its rows. Four divides how many they are.
    fn vectors(column: &Column<T>) -> &[Self::Vector];

    /// The same, to be written.
    fn vectors_mut(column: &mut Column<T>) -> &mut [Self::Vector];

    /// The value in each row.
    fn splat(self, value: T) -> Self::Vector;

    /// `a + b`
    fn add(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;

    /// `a · b`
    fn mul(self, a: Self::Vector, b: Self::Vector) -> Self::Vector;

    /// `a · b + c`, rounded once or twice.
    fn mul_add(self, a: Self::Vector, b: Self::Vector, c: Self::Vector) -> Self::Vector;

    /// The sum of the rows.
    fn sum(self, a: Self::Vector) -> T;
}

/// Plain arithmetic, for any processor.
#[derive(Clone, Copy, Debug)]
pub struct Portable;

impl<T: Real> Kernel<T> for Portable {
    type Vector = [T; 2];

    #[inline(always)]
    fn vectors(column: &Column<T>) -> &[[T; 2]] {
        column.as_chunks().0
    }

    #[inline(always)]
    fn vectors_mut(column: &mut Column<T>) -> &mut [[T; 2]] {
        column.as_chunks_mut().0
    }

    #[inline(always)]
    fn splat(self, value: T) -> [T; 2] {
        [value; 2]
    }

    #[inline(always)]
    fn add(self, a: [T; 2], b: [T; 2]) -> [T; 2] {
        [a[0] + b[0], a[1] + b[1]]
    }

    #[inline(always)]
    fn mul(self, a: [T; 2], b: [T; 2]) -> [T; 2] {
        [a[0] * b[0], a[1] * b[1]]
    }

    #[inline(always)]
    fn mul_add(self, a: [T; 2], b: [T; 2], c: [T; 2]) -> [T; 2] {
        [a[0] * b[0] + c[0], a[1] * b[1] + c[1]]
    }

    #[inline(always)]
    fn sum(self, [a, b]: [T; 2]) -> T {
        a + b
    }
}
