//! Functions of a coordinate put in for motion errors: T(6) and T(10).

mod assumption;
mod conditions;
mod coordinate;
mod function;
mod univariate;

pub use assumption::{Basis, Functions};
pub use conditions::{LinearCondition, NoBasis, satisfying};
pub use coordinate::Coordinate;
pub use function::{Arithmetic, BasisFunction};
pub use univariate::Univariate;
