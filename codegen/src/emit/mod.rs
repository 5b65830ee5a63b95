//! Printers: equations for people from the exact polynomials ([`equations`]), source for compilers from the graph ([`rust`],
//! [`c`], [`c99`], [`hal`], [`numpy`]).
//!
//! A printed function does exactly the operations of its
//! [`Program`](crate::graph::Program), in that order, so that all languages round alike but for their sine and cosine.

pub mod c;
pub mod c99;
pub mod equations;
mod function;
pub mod hal;
mod header;
mod infix;
mod layout;
pub mod model;
mod names;
pub mod numpy;
pub mod rust;
#[cfg(test)]
mod tests;

pub use function::{Function, Input, Output};
pub use header::header;
