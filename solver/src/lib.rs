//! Fixed-size, allocation-free least squares for the generated measurement models.
#![no_std]

pub mod circle;
pub mod exechon;
pub mod lstsq;
pub mod probe;
pub mod tilting;
pub mod trig;

pub use lstsq::Real;
