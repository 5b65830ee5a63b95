//! Printers over one graph: expressions for people ([`text`], [`latex`]), functions for compilers ([`rust`], [`c`],
//! [`numpy`]).
//!
//! A printed expression is the graph's normal form. A printed function does exactly the operations of its
//! [`Program`](crate::graph::Program), in that order, so that all languages round alike but for their sine and cosine.

pub mod c;
pub mod c99;
mod code;
pub mod equations;
mod function;
mod header;
pub mod latex;
pub mod model;
mod names;
pub mod numpy;
mod parts;
pub mod rust;
#[cfg(test)]
mod tests;
pub mod text;

pub use function::{Function, Output};
pub use header::header;
