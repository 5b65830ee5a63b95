//! Fixed-size, allocation-free least squares for the generated measurement models.
#![no_std]

pub mod circle;
pub mod exechon;
#[doc(hidden)]
pub mod generated;
pub mod lstsq;
pub mod model;
pub mod probe;
pub mod tilting;
mod trig;

pub use lstsq::Real;
/// The crates that generated code and its callers speak in.
pub use {nalgebra, num_traits};

/// Derives the measurement model of a user's own machine.
#[cfg(feature = "derive")]
pub use trunnion_derive::Machine;
