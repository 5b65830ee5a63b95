//! What generated functions ask of their scalar, had by every [`Real`]: so that code generic over [`Real`] can call
//! them without bounds of its own.

use crate::Real;

pub use num_traits::Float;

/// Numbers such as π. The equations use none, so nothing is asked.
pub trait FloatConst {}

impl<T: Real> FloatConst for T {}

/// Conversion of a literal.
pub trait AsPrimitive<T> {
    /// The nearest value.
    fn as_(self) -> T;
}

impl<T: Real> AsPrimitive<T> for f64 {
    #[inline]
    fn as_(self) -> T {
        T::of(self)
    }
}
