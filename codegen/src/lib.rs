//! Exact derivation of machine-tool measurement models, and printers for them.

pub mod algebra;
pub mod basis;
pub mod build;
pub mod catalogue;
pub mod emit;
pub mod exechon;
pub mod graph;
pub mod identify;
pub mod ids;
pub mod kinematics;
pub mod measurement;
pub mod model;
pub mod problems;
pub mod quantity;
