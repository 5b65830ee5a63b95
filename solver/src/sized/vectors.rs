//! Columns on the vector instructions that the processor at hand has, found when the program runs.

use crate::lstsq::{Column, Kernel, Portable};
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

/// The processor's vectors; where there are none, [`Portable`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Vectors<S>(pub S);

/// Sums are kept in so many vectors, which do not wait for each other.
const PARTS: usize = 4;

impl<S: Simd> Vectors<S> {
    #[inline(always)]
    fn parts(column: &Column<f64>) -> &[[S::f64s; PARTS]] {
        S::as_simd_f64s(column).0.as_chunks().0
    }

    #[inline(always)]
    fn parts_mut(column: &mut Column<f64>) -> &mut [[S::f64s; PARTS]] {
        S::as_mut_simd_f64s(column).0.as_chunks_mut().0
    }

    #[inline(always)]
    fn total(self, [a, b, c, d]: [S::f64s; PARTS]) -> f64 {
        let Self(simd) = self;
        simd.reduce_sum_f64s(simd.add_f64s(simd.add_f64s(a, c), simd.add_f64s(b, d)))
    }
}

impl<S: Simd> Kernel<f64> for Vectors<S> {
    #[inline(always)]
    fn dot(self, a: &Column<f64>, b: &Column<f64>) -> f64 {
        if S::IS_SCALAR {
            return Portable.dot(a, b);
        }
        let Self(simd) = self;
        let mut sums = [simd.splat_f64s(0.0); PARTS];
        for (a, b) in Self::parts(a).iter().zip(Self::parts(b)) {
            for l in 0..PARTS {
                sums[l] = simd.mul_add_e_f64s(a[l], b[l], sums[l]);
            }
        }
        self.total(sums)
    }

    #[inline(always)]
    fn add(self, column: &mut Column<f64>, factor: f64, own: &Column<f64>) {
        if S::IS_SCALAR {
            return Portable.add(column, factor, own);
        }
        let Self(simd) = self;
        let factor = simd.splat_f64s(factor);
        for (x, v) in S::as_mut_simd_f64s(column).0.iter_mut().zip(S::as_simd_f64s(own).0) {
            *x = simd.mul_add_e_f64s(factor, *v, *x);
        }
    }

    #[inline(always)]
    fn add_and_dot(self, column: &mut Column<f64>, factor: f64, own: &Column<f64>, next: &Column<f64>) -> f64 {
        if S::IS_SCALAR {
            return Portable.add_and_dot(column, factor, own, next);
        }
        let Self(simd) = self;
        let factor = simd.splat_f64s(factor);
        let mut sums = [simd.splat_f64s(0.0); PARTS];
        for ((x, v), u) in Self::parts_mut(column).iter_mut().zip(Self::parts(own)).zip(Self::parts(next)) {
            for l in 0..PARTS {
                x[l] = simd.mul_add_e_f64s(factor, v[l], x[l]);
                sums[l] = simd.mul_add_e_f64s(x[l], u[l], sums[l]);
            }
        }
        self.total(sums)
    }

    #[inline(always)]
    fn add_and_dot_both(
        self,
        [a, b]: &mut [Column<f64>; 2],
        [of_a, of_b]: [f64; 2],
        own: &Column<f64>,
        next: &Column<f64>,
    ) -> [f64; 2] {
        if S::IS_SCALAR {
            return [Portable.add_and_dot(a, of_a, own, next), Portable.add_and_dot(b, of_b, own, next)];
        }
        let Self(simd) = self;
        let (of_a, of_b) = (simd.splat_f64s(of_a), simd.splat_f64s(of_b));
        let (mut sums_a, mut sums_b) = ([simd.splat_f64s(0.0); PARTS], [simd.splat_f64s(0.0); PARTS]);
        let columns = Self::parts_mut(a).iter_mut().zip(Self::parts_mut(b));
        for (((a, b), v), u) in columns.zip(Self::parts(own)).zip(Self::parts(next)) {
            for l in 0..PARTS {
                a[l] = simd.mul_add_e_f64s(of_a, v[l], a[l]);
                sums_a[l] = simd.mul_add_e_f64s(a[l], u[l], sums_a[l]);
                b[l] = simd.mul_add_e_f64s(of_b, v[l], b[l]);
                sums_b[l] = simd.mul_add_e_f64s(b[l], u[l], sums_b[l]);
            }
        }
        [self.total(sums_a), self.total(sums_b)]
    }
}
