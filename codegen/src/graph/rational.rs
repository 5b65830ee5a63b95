//! Exact constants. Every operation says when it would overflow, and the graph then leaves the constant unfolded.

use num_traits::{CheckedAdd, CheckedMul, One, Zero};

pub use crate::algebra::{Rational, to_f64};

/// Lowest terms with a positive denominator, or `None` for a denominator of zero or an unrepresentable sign change.
pub(super) fn reduced(r: Rational) -> Option<Rational> {
    let (numer, denom) = (*r.numer(), *r.denom());
    if denom == 1 {
        return representable(r);
    }
    if denom == 0 || denom == i128::MIN || numer == i128::MIN {
        return None;
    }
    Some(Rational::new(numer, denom))
}

/// `i128::MIN` has no negative: it counts as an overflow everywhere.
fn representable(r: Rational) -> Option<Rational> {
    (*r.numer() != i128::MIN).then_some(r)
}

pub(super) fn times(a: &Rational, b: &Rational) -> Option<Rational> {
    let product = if a.is_one() {
        *b
    } else if b.is_one() {
        *a
    } else if a.is_integer() && b.is_integer() {
        Rational::new_raw(a.numer().checked_mul(b.numer())?, 1)
    } else {
        a.checked_mul(b)?
    };
    representable(product)
}

pub(super) fn plus(a: &Rational, b: &Rational) -> Option<Rational> {
    let sum = if a.is_integer() && b.is_integer() {
        Rational::new_raw(a.numer().checked_add(b.numer())?, 1)
    } else {
        a.checked_add(b)?
    };
    representable(sum)
}

/// `None` also for a negative power of zero.
pub(super) fn power(r: &Rational, exponent: i32) -> Option<Rational> {
    if exponent < 0 && r.is_zero() {
        return None;
    }
    let mut square = if exponent < 0 { r.recip() } else { *r };
    let mut result = Rational::one();
    let mut left = exponent.unsigned_abs();
    loop {
        if left & 1 == 1 {
            result = times(&result, &square)?;
        }
        left >>= 1;
        if left == 0 {
            return Some(result);
        }
        square = times(&square, &square)?;
    }
}

/// The rational square root of a rational square.
pub(super) fn exact_root(r: &Rational) -> Option<Rational> {
    if *r.numer() < 0 {
        return None;
    }
    let root = |n: i128| {
        let root = n.isqrt();
        (root * root == n).then_some(root)
    };
    Some(Rational::new_raw(root(*r.numer())?, root(*r.denom())?))
}
