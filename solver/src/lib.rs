//! Fixed-size, allocation-free least squares for the generated measurement models.
#![no_std]

pub mod lstsq;
pub mod tilting;
pub mod trig;

pub use lstsq::Real;
