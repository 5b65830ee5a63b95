//! Newton's iteration for three equations in the platform's position.

use super::vector::{cross, dot, finite, norm, plus};
use super::{KinematicsError, Singularity, Vector};
use crate::Real;

/// Far more than any pose of the workspace needs.
const MOST: u32 = 40;

/// What an iteration ends with.
pub(super) struct Root<T> {
    pub at: Vector<T>,
    pub iterations: u32,
}

/// Finds where `equations` (residual, Jacobian by rows) vanish, from `start`. Steps are held to `reach`, mm: the
/// equations' own length.
///
/// The iteration ends once a step is so short that the next, which is of the order of its square over `reach`, would
/// be lost in rounding.
#[inline]
pub(super) fn solve<T: Real>(
    start: &Vector<T>,
    reach: T,
    equations: impl Fn(&Vector<T>) -> (Vector<T>, [Vector<T>; 3]),
) -> Result<Root<T>, KinematicsError<T>> {
    let small = T::epsilon().sqrt() * reach * T::of(1.0 / 64.0);
    let (mut at, mut size) = (*start, T::infinity());
    for iterations in 1..=MOST {
        let (residual, jacobian) = equations(&at);
        let Some(step) = divide(&residual, &jacobian) else {
            return Err(KinematicsError::Singular(Singularity::Jacobian));
        };
        size = norm(&step);
        let held = if size > reach { reach / size } else { T::one() };
        at = plus(&at, -held, &step);
        if !finite(&at) {
            break;
        }
        if size <= small {
            return Ok(Root { at, iterations });
        }
    }
    Err(KinematicsError::NoConvergence { iterations: MOST, step: size })
}

/// J⁻¹ f by cofactors; none if J has no inverse worth the name.
#[inline]
fn divide<T: Real>(f: &Vector<T>, [a, b, c]: &[Vector<T>; 3]) -> Option<Vector<T>> {
    let (bc, ca, ab) = (cross(b, c), cross(c, a), cross(a, b));
    let determinant = dot(a, &bc);
    let bound = dot(a, a) * dot(b, b) * dot(c, c);
    let tiny = T::epsilon() * T::of(16.0);
    // NaN is no inverse either.
    let regular = determinant * determinant > tiny * tiny * bound;
    let [x, y, z] = f;
    let sum = plus(&plus(&bc.map(|v| v * *x), *y, &ca), *z, &ab);
    let inverse = determinant.recip();
    regular.then(|| sum.map(|v| v * inverse))
}
