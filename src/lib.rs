//! Facade of the workspace: what the command line and other programs use.

pub mod data;
pub mod exechon;
pub mod plot;
pub mod study;
