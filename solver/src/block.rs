//! Rows of a block: what generated code calculates many at a time with.

use crate::Real;
use crate::lstsq::{Column, ROWS};
use core::array;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// What generated functions calculate with: a [`Real`], or one of many.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The value nearest to `x`.
    fn of(x: f64) -> Self;

    /// As [`Real::whole_turns`].
    fn whole_turns(self) -> Self;

    /// Sine and cosine of an angle in rad.
    fn sine_cosine(self) -> (Self, Self);

    /// The square root.
    fn sqrt(self) -> Self;
}

impl<T: Real> Number for T {
    #[inline(always)]
    fn of(x: f64) -> Self {
        Real::of(x)
    }

    #[inline(always)]
    fn whole_turns(self) -> Self {
        Real::whole_turns(self)
    }

    #[inline(always)]
    fn sine_cosine(self) -> (Self, Self) {
        Real::sine_cosine(self)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        num_traits::Float::sqrt(self)
    }
}

/// One of many values, whose sine takes no branch: no number where its angle is far.
#[derive(Clone, Copy, Debug)]
pub struct Near<T>(pub T);

macro_rules! operators {
    ($($operator:ident, $method:ident, $sign:tt;)*) => {$(
        impl<T: Real> $operator for Near<T> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $sign other.0)
            }
        }
    )*};
}
operators! {
    Add, add, +;
    Sub, sub, -;
    Mul, mul, *;
    Div, div, /;
}

impl<T: Real> Neg for Near<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<T: Real> Number for Near<T> {
    #[inline(always)]
    fn of(x: f64) -> Self {
        Self(Real::of(x))
    }

    #[inline(always)]
    fn whole_turns(self) -> Self {
        Self(self.0.whole_turns())
    }

    #[inline(always)]
    fn sine_cosine(self) -> (Self, Self) {
        let (sin, cos) = self.0.near_sine_cosine();
        (Self(sin), Self(cos))
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(num_traits::Float::sqrt(self.0))
    }
}

/// Writes the results of each row of a block, of what it has of the `inputs`, into a column each: those of `near`, or of `exact` for all
/// rows where one has no number among them.
#[inline(always)]
pub fn rows<T: Real, const M: usize, const N: usize>(
    inputs: [&Column<T>; M],
    columns: &mut [Column<T>; N],
    near: impl Fn([Near<T>; M]) -> [Near<T>; N],
    exact: impl Fn([T; M]) -> [T; N],
) {
    let mut sound = true;
    for i in 0..ROWS {
        let results = near(array::from_fn(|m| Near(inputs[m][i])));
        let mut sums = [T::zero(); 4];
        for n in 0..N {
            columns[n][i] = results[n].0;
            sums[n % 4] += results[n].0;
        }
        sound &= ((sums[0] + sums[1]) + (sums[2] + sums[3])).is_finite();
    }
    if sound {
        return;
    }
    for i in 0..ROWS {
        let results = exact(array::from_fn(|m| inputs[m][i]));
        for n in 0..N {
            columns[n][i] = results[n];
        }
    }
}

/// Two results as one.
#[inline(always)]
pub fn joined<T: Copy, const K: usize, const L: usize, const N: usize>((first, second): ([T; K], [T; L])) -> [T; N] {
    const { assert!(K + L == N, "as many as both") };
    array::from_fn(|n| if n < K { first[n] } else { second[n - K] })
}
