//! Base parameters by exact rank factorisation: T(7) and T(9), and what the runs cannot tell apart.
//!
//! After this room a run's reading is `Σ regressor · base parameter + Σ coefficient · known function`, and the base
//! parameters are exactly what all runs together determine.

mod assume;
mod columns;
mod derivation;
mod derive;
mod determined;
mod factor;
mod groups;
mod parameter;
mod rest;

pub use crate::model::{Coefficient, Origin};
pub use derivation::{BaseParameter, Derivation, DeriveError, DerivedRun, Determination, Extent, SeenTerm};
pub use derive::derive;
pub use groups::Group;
pub use parameter::{Assumed, Parameter, name};
pub use rest::settle;
