//! Compensation tables: what a control makes of them, and what then remains of the error.

mod commands;
mod cross;
mod machine;
mod pages;
#[path = "../program/mod.rs"]
mod program;
mod properties;
mod readers;
mod signs;
mod told;
mod written;
