//! Printers.

pub mod equations;
