//! Sums over whole columns of a block, and columns added to columns, with any kernel. A column that is read for two others is read
//! once.

use super::{Column, Kernel, Real};

/// Vectors that are worked on at once: they do not wait for each other.
const PARTS: usize = 4;

#[inline(always)]
fn parts<T, K: Kernel<T>>(column: &Column<T>) -> &[[K::Vector; PARTS]] {
    K::vectors(column).as_chunks().0
}

#[inline(always)]
fn parts_mut<T, K: Kernel<T>>(column: &mut Column<T>) -> &mut [[K::Vector; PARTS]] {
    K::vectors_mut(column).as_chunks_mut().0
}

#[inline(always)]
fn total<T, K: Kernel<T>>(kernel: K, [a, b, c, d]: [K::Vector; PARTS]) -> T {
    kernel.sum(kernel.add(kernel.add(a, c), kernel.add(b, d)))
}

/// Product of two columns.
#[inline(always)]
pub(super) fn dot<T: Real, K: Kernel<T>>(kernel: K, a: &Column<T>, b: &Column<T>) -> T {
    let mut sums = [kernel.splat(T::zero()); PARTS];
    for (a, b) in parts::<T, K>(a).iter().zip(parts::<T, K>(b)) {
        for l in 0..PARTS {
            sums[l] = kernel.mul_add(a[l], b[l], sums[l]);
        }
    }
    total(kernel, sums)
}

/// Products of each of some columns with each of others.
#[inline(always)]
pub(super) fn dots<T: Real, K: Kernel<T>, const M: usize, const N: usize>(
    kernel: K,
    a: [&Column<T>; M],
    b: [&Column<T>; N],
) -> [[T; N]; M] {
    let mut sums = [[kernel.splat(T::zero()); N]; M];
    for v in 0..K::vectors(a[0]).len() {
        for m in 0..M {
            for n in 0..N {
                sums[m][n] = kernel.mul_add(K::vectors(a[m])[v], K::vectors(b[n])[v], sums[m][n]);
            }
        }
    }
    let mut products = [[T::zero(); N]; M];
    for m in 0..M {
        for n in 0..N {
            products[m][n] = kernel.sum(sums[m][n]);
        }
    }
    products
}

/// `column + factor · own`
#[inline(always)]
pub(super) fn add<T: Real, K: Kernel<T>>(kernel: K, column: &mut Column<T>, factor: T, own: &Column<T>) {
    let factor = kernel.splat(factor);
    for (x, &v) in K::vectors_mut(column).iter_mut().zip(K::vectors(own)) {
        *x = kernel.mul_add(factor, v, *x);
    }
}

/// [`add`] to each of some columns, and the products of what comes out with `next`.
#[inline(always)]
pub(super) fn add_and_dot<T: Real, K: Kernel<T>, const N: usize>(
    kernel: K,
    columns: &mut [Column<T>; N],
    factors: [T; N],
    own: &Column<T>,
    next: &Column<T>,
) -> [T; N] {
    let mut sums = [[kernel.splat(T::zero()); PARTS]; N];
    for (at, (v, u)) in parts::<T, K>(own).iter().zip(parts::<T, K>(next)).enumerate() {
        for n in 0..N {
            let factor = kernel.splat(factors[n]);
            let x = &mut parts_mut::<T, K>(&mut columns[n])[at];
            for l in 0..PARTS {
                x[l] = kernel.mul_add(factor, v[l], x[l]);
                sums[n][l] = kernel.mul_add(x[l], u[l], sums[n][l]);
            }
        }
    }
    let mut products = [T::zero(); N];
    for n in 0..N {
        products[n] = total(kernel, sums[n]);
    }
    products
}

/// Columns of a row's solution by a triangle: `out[n] = scales[n] · (columns[n] + Σⱼ factors[n][j] · xⱼ)`, with x the columns that
/// are `done` and then those of `out` itself.
#[inline(always)]
pub(super) fn substitute<T: Real, K: Kernel<T>, const N: usize>(
    kernel: K,
    columns: [&Column<T>; N],
    factors: [&[T]; N],
    scales: [T; N],
    done: &[Column<T>],
    out: &mut [Column<T>; N],
) {
    for at in 0..parts::<T, K>(columns[0]).len() {
        let mut sums = [[kernel.splat(T::zero()); PARTS]; N];
        for n in 0..N {
            sums[n] = parts::<T, K>(columns[n])[at];
        }
        for (j, done) in done.iter().enumerate() {
            let x = parts::<T, K>(done)[at];
            for n in 0..N {
                let factor = kernel.splat(factors[n][j]);
                for l in 0..PARTS {
                    sums[n][l] = kernel.mul_add(factor, x[l], sums[n][l]);
                }
            }
        }
        for n in 0..N {
            for m in 0..n {
                let factor = kernel.splat(factors[n][done.len() + m]);
                for l in 0..PARTS {
                    sums[n][l] = kernel.mul_add(factor, sums[m][l], sums[n][l]);
                }
            }
            for l in 0..PARTS {
                sums[n][l] = kernel.mul(kernel.splat(scales[n]), sums[n][l]);
            }
            parts_mut::<T, K>(&mut out[n])[at] = sums[n];
        }
    }
}
