//! Exact derivation of machine-tool measurement models, and printers for them.

pub mod emit;
pub mod graph;
