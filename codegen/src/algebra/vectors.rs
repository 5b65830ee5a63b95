//! Nominal vectors, in normal form.

use super::{AlgebraError, Alphabet, Order, Poly, PolyVector};

fn each(f: impl FnMut(usize) -> Result<Poly, AlgebraError>) -> Result<PolyVector, AlgebraError> {
    let [x, y, z] = [0, 1, 2].map(f);
    Ok([x?, y?, z?])
}

/// `a + b`
pub fn sum(a: &PolyVector, b: &PolyVector) -> Result<PolyVector, AlgebraError> {
    each(|i| a[i].plus(&b[i]))
}

/// `by · vector`, in normal form.
pub fn scaled(by: &Poly, vector: &PolyVector, alphabet: &Alphabet) -> Result<PolyVector, AlgebraError> {
    each(|i| by.times(&vector[i], Order::NOMINAL)?.normal(alphabet))
}

/// `a · b`, in normal form.
pub fn dot(a: &PolyVector, b: &PolyVector, alphabet: &Alphabet) -> Result<Poly, AlgebraError> {
    super::dot(a, b, Order::NOMINAL)?.normal(alphabet)
}

/// `a × b`, in normal form.
pub fn cross(a: &PolyVector, b: &PolyVector, alphabet: &Alphabet) -> Result<PolyVector, AlgebraError> {
    let times = |i: usize, k: usize| a[i].times(&b[k], Order::NOMINAL);
    each(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        times(j, k)?.minus(&times(k, j)?)?.normal(alphabet)
    })
}
