//! Base parameters by exact rank factorisation: T(7) and T(9), and what the runs cannot tell apart.
//!
//! After this room a run's reading is `Σ regressor · base parameter + Σ coefficient · known function`, and the base
//! parameters are exactly what all runs together determine.

mod columns;
mod derivation;
mod derive;
mod factor;
mod groups;
mod parameter;

pub use derivation::{BaseParameter, Derivation, DeriveError, DerivedRun};
pub use derive::derive;
pub use groups::Group;
pub use parameter::{Coefficient, Origin, Parameter};
