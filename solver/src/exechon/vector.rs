//! Three numbers.

use crate::Real;

/// A point or direction: x, y, z.
pub type Vector<T> = [T; 3];

pub(super) fn dot<T: Real>([a, b, c]: &Vector<T>, [x, y, z]: &Vector<T>) -> T {
    *a * *x + *b * *y + *c * *z
}

pub(super) fn cross<T: Real>([a, b, c]: &Vector<T>, [x, y, z]: &Vector<T>) -> Vector<T> {
    [*b * *z - *c * *y, *c * *x - *a * *z, *a * *y - *b * *x]
}

pub(super) fn norm<T: Real>(v: &Vector<T>) -> T {
    dot(v, v).sqrt()
}

/// `a + k b`.
pub(super) fn plus<T: Real>([a, b, c]: &Vector<T>, k: T, [x, y, z]: &Vector<T>) -> Vector<T> {
    [*a + k * *x, *b + k * *y, *c + k * *z]
}

/// `x a + y b + z c` of the axes a, b, c.
pub(super) fn combine<T: Real>([a, b, c]: &[Vector<T>; 3], [x, y, z]: &Vector<T>) -> Vector<T> {
    plus(&plus(&a.map(|a| a * *x), *y, b), *z, c)
}

/// Components of v along the axes.
pub(super) fn components<T: Real>(axes: &[Vector<T>; 3], v: &Vector<T>) -> Vector<T> {
    axes.map(|axis| dot(&axis, v))
}

/// Whether all three are finite.
pub(super) fn finite<T: Real>([x, y, z]: &Vector<T>) -> bool {
    x.is_finite() && y.is_finite() && z.is_finite()
}
