//! Columns on the vector instructions that the processor at hand has, found when the program runs.

use crate::lstsq::{Column, Kernel};
use pulp::Simd;

/// Work that is worth vector instructions.
pub trait Work {
    /// What it gives.
    type Output;
    /// Does it; to be inlined, with all that it calls.
    fn work(self) -> Self::Output;
}

/// Does work with the widest vector instructions there are: loops in it are compiled once for each.
#[inline]
pub fn vectorised<W: Work>(work: W) -> W::Output {
    pulp::Arch::new().dispatch(Vectorised(work))
}

struct Vectorised<W>(W);

impl<W: Work> pulp::NullaryFnOnce for Vectorised<W> {
    type Output = W::Output;

    #[inline(always)]
    fn call(self) -> W::Output {
        self.0.work()
    }
}

/// The processor's vectors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vectors<S>(pub S);

impl<S: Simd> Kernel<f64> for Vectors<S> {
    type Vector = S::f64s;

    #[inline(always)]
    fn vectors(column: &Column<f64>) -> &[S::f64s] {
        S::as_simd_f64s(column).0
    }

    #[inline(always)]
    fn vectors_mut(column: &mut Column<f64>) -> &mut [S::f64s] {
        S::as_mut_simd_f64s(column).0
    }

    #[inline(always)]
    fn splat(self, value: f64) -> S::f64s {
        self.0.splat_f64s(value)
    }

    #[inline(always)]
    fn add(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.0.add_f64s(a, b)
    }

    #[inline(always)]
    fn mul(self, a: S::f64s, b: S::f64s) -> S::f64s {
        self.0.mul_f64s(a, b)
    }

    #[inline(always)]
    fn mul_add(self, a: S::f64s, b: S::f64s, c: S::f64s) -> S::f64s {
        self.0.mul_add_e_f64s(a, b, c)
    }

    #[inline(always)]
    fn sum(self, a: S::f64s) -> f64 {
        self.0.reduce_sum_f64s(a)
    }
}
